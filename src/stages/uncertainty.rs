//! How uncertain the fits are: the options that fit-pex and fit-pro share, checked.

use super::sample_scenarios::DEFAULT_SEED;
use crate::pipeline::console::Progress;
use crate::pipeline::options::check;
use crate::resampling::{Resamples, Strata, TOGETHER, bootstrap_each};

/// More than this is a slip of the finger.
const MOST_REPLICATES: usize = 1_000_000;

/// The limits that are asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Uncertainty {
    /// How many resamples.
    pub replicates: usize,
    /// Probability with which limits hold the truth.
    pub confidence: f64,
    /// Seed of the resamples.
    pub seed: u64,
}

impl Uncertainty {
    /// Of the options.
    ///
    /// # Errors
    /// If one is out of range.
    pub fn new(replicates: usize, confidence: f64, seed: Option<u64>) -> anyhow::Result<Uncertainty> {
        check(replicates <= MOST_REPLICATES, "bootstrap", replicates, "up to 1,000,000 replicates")?;
        let possible = (0.5..1.0).contains(&confidence);
        check(possible, "confidence", confidence, "a probability from 0.5 to below 1")?;
        Ok(Uncertainty { replicates, confidence, seed: seed.unwrap_or(DEFAULT_SEED) })
    }

    /// The steps of progress of a group: a fit, and each refit of it.
    pub fn steps(&self) -> u64 {
        1 + self.replicates.next_multiple_of(TOGETHER) as u64
    }

    /// The replicates of each group; the groups have the same cells, within which they are resampled. `refit` is given what it
    /// needs to know of a group.
    ///
    /// # Errors
    /// If whoever follows wants it to stop.
    pub fn bootstrap<G: Sync, T: Send>(
        &self,
        cells: &[usize],
        groups: &[G],
        progress: &Progress,
        refit: impl Fn(&G, &Resamples) -> [T; TOGETHER] + Sync,
    ) -> anyhow::Result<Vec<Vec<T>>> {
        bootstrap_each(&Strata::new(cells), self.replicates, self.seed, groups, |group, resamples| {
            progress.inc(TOGETHER as u64)?;
            Ok(refit(group, resamples))
        })
    }
}
