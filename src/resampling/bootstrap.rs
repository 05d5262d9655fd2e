//! Resampling that respects the design: rows are drawn anew within each cell.

use std::collections::BTreeMap;
use std::convert::Infallible;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::random::{Purpose, binomial, stream};

/// Resamples that are worked on together: as many as the widest register has numbers.
pub const TOGETHER: usize = 8;
/// How often rows are drawn, at most, before the refits are made: 32 MiB of counts.
const MOST_DRAWS: usize = 1 << 22;

/// How many rows each stratum has, by its number.
pub type Sizes = BTreeMap<usize, u64>;

/// The rows of a sample by the stratum they were drawn in.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Strata {
    /// The number of that of each row.
    of: Vec<usize>,
    /// The number of each.
    labels: Vec<usize>,
    members: Vec<Vec<usize>>,
}

impl Strata {
    /// Of the number of the stratum of each row.
    pub fn new(labels: &[usize]) -> Strata {
        let strata = labels.iter().max().map_or(0, |last| last + 1);
        let mut members = vec![Vec::new(); strata];
        for (row, &label) in labels.iter().enumerate() {
            members[label].push(row);
        }
        let labels_in_use = (0..strata).filter(|&label| !members[label].is_empty()).collect();
        members.retain(|rows| !rows.is_empty());
        Strata { of: labels.to_vec(), labels: labels_in_use, members }
    }

    /// How many rows each has.
    pub fn sizes(&self) -> Sizes {
        self.labels.iter().zip(&self.members).map(|(&label, rows)| (label, rows.len() as u64)).collect()
    }

    /// How many rows there are.
    pub fn rows(&self) -> usize {
        self.of.len()
    }

    /// The number of the stratum of a row.
    pub fn label_of(&self, row: usize) -> usize {
        self.of[row]
    }

    /// The number of each stratum.
    pub fn labels(&self) -> &[usize] {
        &self.labels
    }

    /// The rows of each stratum.
    pub fn members(&self) -> &[Vec<usize>] {
        &self.members
    }
}

/// How often each row is drawn in each of some resamples.
#[derive(Debug, Clone, PartialEq)]
pub struct Resamples {
    /// Of each row.
    pub counts: Vec<[f64; TOGETHER]>,
}

impl Resamples {
    /// In which each row counts so often, in all alike.
    pub fn alike(counts: &[f64]) -> Resamples {
        Resamples { counts: counts.iter().map(|&count| [count; TOGETHER]).collect() }
    }

    /// How often each of these rows is drawn in one of the resamples.
    pub fn of(&self, resample: usize, rows: &[usize]) -> Vec<f64> {
        rows.iter().map(|&row| self.counts[row][resample]).collect()
    }
}

/// Draws [`TOGETHER`] resamples of rows that come in blocks: of each stratum as many rows as it has in all, with replacement. Of those of
/// a stratum a block gets a number that is binomial.
pub struct Draws<'a> {
    sizes: &'a Sizes,
    random: [ChaCha8Rng; TOGETHER],
    /// Rows and draws that are left of strata of which a block had some.
    left: [Sizes; TOGETHER],
    left_to_draw: [Sizes; TOGETHER],
}

impl Draws<'_> {
    /// Of replicates from `first` on; each has random numbers of its own.
    pub fn new(sizes: &Sizes, seed: u64, first: usize) -> Draws<'_> {
        let random = |resample: usize| stream(seed, Purpose::Bootstrap, (first + resample) as u64);
        let (left, left_to_draw) = Default::default();
        Draws { sizes, random: std::array::from_fn(random), left, left_to_draw }
    }

    /// How often each row of the next block is drawn.
    pub fn next(&mut self, strata: &Strata) -> Resamples {
        let mut counts = vec![[0.0; TOGETHER]; strata.rows()];
        let of_strata = self.left.iter_mut().zip(&mut self.left_to_draw);
        for (resample, (random, (left, left_to_draw))) in self.random.iter_mut().zip(of_strata).enumerate() {
            for (label, rows) in strata.labels.iter().zip(&strata.members) {
                let size = self.sizes.get(label).copied().unwrap_or(rows.len() as u64);
                let rows_left = left.remove(label).unwrap_or(size);
                let to_draw = left_to_draw.remove(label).unwrap_or(size);
                let (here, mut draws) = (rows.len() as u64, to_draw);
                if here < rows_left {
                    let share = here as f64 / rows_left as f64;
                    draws = binomial(to_draw, share, random);
                    left.insert(*label, rows_left - here);
                    left_to_draw.insert(*label, to_draw - draws);
                }
                for _ in 0..draws {
                    counts[rows[random.random_range(0..here as u32) as usize]][resample] += 1.0;
                }
            }
        }
        Resamples { counts }
    }
}

/// Refits in that many resamples, of which `refit` is given [`TOGETHER`] at once. Each has random numbers of its own, so
/// that replicate 17 is the same on any number of threads, and in all fits of the same rows: they can be taken jointly.
pub fn bootstrap<T: Send>(
    strata: &Strata,
    replicates: usize,
    seed: u64,
    refit: impl Fn(&Resamples) -> [T; TOGETHER] + Sync,
) -> Vec<T> {
    let refit = |(): &(), resamples: &Resamples| Ok::<_, Infallible>(refit(resamples));
    let Ok(refits) = bootstrap_each(strata, replicates, seed, &[()], refit);
    refits.into_iter().flatten().collect()
}

/// [`bootstrap`] of several samples with the same strata, each in the same resamples, of which `refit` is given one. Ends
/// with its first error.
///
/// # Errors
/// Those of `refit`.
pub fn bootstrap_each<S: Sync, T: Send, E: Send>(
    strata: &Strata,
    replicates: usize,
    seed: u64,
    samples: &[S],
    refit: impl Fn(&S, &Resamples) -> Result<[T; TOGETHER], E> + Sync,
) -> Result<Vec<Vec<T>>, E> {
    let sizes = strata.sizes();
    let at_once = MOST_DRAWS / (strata.rows().max(1) * TOGETHER) + 1;
    let firsts: Vec<usize> = (0..replicates).step_by(TOGETHER).collect();
    let mut refits: Vec<Vec<T>> = samples.iter().map(|_| Vec::with_capacity(replicates)).collect();
    for firsts in firsts.chunks(at_once) {
        let draws: Vec<Resamples> =
            firsts.par_iter().map(|&first| Draws::new(&sizes, seed, first).next(strata)).collect();
        for (sample, refits) in samples.iter().zip(&mut refits) {
            let together = |resamples: &Resamples| refit(sample, resamples);
            let batches = draws.par_iter().map(together).collect::<Result<Vec<[T; TOGETHER]>, E>>()?;
            refits.extend(batches.into_iter().flatten());
        }
    }
    refits.iter_mut().for_each(|refits| refits.truncate(replicates));
    Ok(refits)
}
