//! Resampling that respects the design: rows are drawn anew within each cell.

use rand::{Rng, RngExt};
use rayon::prelude::*;

use crate::random::{Purpose, stream};

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

    /// How often each row is drawn when as many are drawn from each stratum as it has, with replacement.
    pub fn resample(&self, random: &mut impl Rng) -> Vec<f64> {
        let mut counts = vec![0.0; self.rows];
        for rows in &self.members {
            for _ in rows {
                counts[rows[random.random_range(0..rows.len())]] += 1.0;
            }
        }
        counts
    }
}

/// Refits in that many resamples. Each has random numbers of its own, so that replicate 17 is the same on any number of
/// threads, and in all fits of the same rows: they can be taken jointly.
pub fn bootstrap<T: Send>(
    strata: &Strata,
    replicates: usize,
    seed: u64,
    refit: impl Fn(&[f64]) -> T + Sync,
) -> Vec<T> {
    let replicate = |row: usize| refit(&strata.resample(&mut stream(seed, Purpose::Bootstrap, row as u64)));
    (0..replicates).into_par_iter().map(replicate).collect()
}
