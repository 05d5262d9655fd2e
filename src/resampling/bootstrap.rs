//! Resampling that respects the design: rows are drawn anew within each cell.

use std::convert::Infallible;

use rand::{Rng, RngExt};
use rayon::prelude::*;

use crate::random::{Purpose, stream};

/// Resamples that are worked on together: as many as the widest register has numbers.
pub const TOGETHER: usize = 8;
/// How often rows are drawn, at most, before the refits are made: 32 MiB of counts.
const MOST_DRAWS: usize = 1 << 24;

/// The rows of a sample by the stratum they were drawn in.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Strata {
    rows: usize,
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
        members.retain(|rows| !rows.is_empty());
        Strata { rows: labels.len(), members }
    }

    /// How many rows there are.
    pub fn rows(&self) -> usize {
        self.rows
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

/// The same in little room.
struct Draws(Vec<[u16; TOGETHER]>);

impl Draws {
    fn new(strata: &Strata, seed: u64, first: usize) -> Draws {
        let mut draws = Draws(vec![[0; TOGETHER]; strata.rows]);
        for resample in 0..TOGETHER {
            draws.draw(resample, strata, &mut stream(seed, Purpose::Bootstrap, (first + resample) as u64));
        }
        draws
    }

    /// As many rows from each stratum as it has, with replacement.
    fn draw(&mut self, resample: usize, strata: &Strata, random: &mut impl Rng) {
        for rows in &strata.members {
            let size = rows.len() as u32;
            for _ in rows {
                self.0[rows[random.random_range(0..size) as usize]][resample] += 1;
            }
        }
    }

    fn resamples(&self) -> Resamples {
        Resamples { counts: self.0.iter().map(|counts| counts.map(f64::from)).collect() }
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
    let at_once = MOST_DRAWS / (strata.rows.max(1) * TOGETHER) + 1;
    let firsts: Vec<usize> = (0..replicates).step_by(TOGETHER).collect();
    let mut refits: Vec<Vec<T>> = samples.iter().map(|_| Vec::with_capacity(replicates)).collect();
    for firsts in firsts.chunks(at_once) {
        let draws: Vec<Draws> = firsts.par_iter().map(|&first| Draws::new(strata, seed, first)).collect();
        for (sample, refits) in samples.iter().zip(&mut refits) {
            let together = |draws: &Draws| refit(sample, &draws.resamples());
            let batches = draws.par_iter().map(together).collect::<Result<Vec<[T; TOGETHER]>, E>>()?;
            refits.extend(batches.into_iter().flatten());
        }
    }
    refits.iter_mut().for_each(|refits| refits.truncate(replicates));
    Ok(refits)
}
