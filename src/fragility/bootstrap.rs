//! Resampling that respects the design: rows are drawn anew within each cell.

use std::convert::Infallible;

use rand::{Rng, RngExt};
use rayon::prelude::*;

use crate::random::{Purpose, stream};

/// Resamples that are worked on together: as many as the widest register has numbers.
pub const TOGETHER: usize = 8;

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

    /// Draws as many rows from each stratum as it has, with replacement.
    fn draw(&mut self, resample: usize, strata: &Strata, random: &mut impl Rng) {
        for rows in &strata.members {
            let size = rows.len() as u32;
            for _ in rows {
                self.counts[rows[random.random_range(0..size) as usize]][resample] += 1.0;
            }
        }
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
    let refit = |resamples: &Resamples| Ok::<_, Infallible>(refit(resamples));
    let Ok(refits) = try_bootstrap(strata, replicates, seed, refit);
    refits
}

/// [`bootstrap`] that ends with the first error of `refit`.
///
/// # Errors
/// Those of `refit`.
pub fn try_bootstrap<T: Send, E: Send>(
    strata: &Strata,
    replicates: usize,
    seed: u64,
    refit: impl Fn(&Resamples) -> Result<[T; TOGETHER], E> + Sync,
) -> Result<Vec<T>, E> {
    let together = |batch: usize| {
        let mut resamples = Resamples { counts: vec![[0.0; TOGETHER]; strata.rows] };
        for resample in 0..TOGETHER {
            let number = (batch * TOGETHER + resample) as u64;
            resamples.draw(resample, strata, &mut stream(seed, Purpose::Bootstrap, number));
        }
        refit(&resamples)
    };
    let batches = (0..replicates.div_ceil(TOGETHER)).into_par_iter().map(together);
    let batches = batches.collect::<Result<Vec<[T; TOGETHER]>, E>>()?;
    Ok(batches.into_iter().flatten().take(replicates).collect())
}
