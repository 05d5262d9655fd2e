//! What all fits of a group of cases share: the cases, the limits that are asked for, and progress.

use std::convert::Infallible;

use rayon::prelude::*;

use super::case::Case;
use crate::resampling::{Resamples, Strata, TOGETHER, bootstrap_each};

/// The cases of one structure under one suite of motions.
#[derive(Debug, Clone, Copy)]
pub struct CaseGroup<'a> {
    pub cases: &'a [Case],
    /// The number of the cell of magnitude and distance of each, within which the bootstrap resamples.
    pub cells: &'a [usize],
    /// The number of the cluster of each: cases of one cluster may depend on each other.
    pub clusters: &'a [usize],
}

/// Limits of confidence and the bootstrap behind them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Uncertainty {
    /// Number of resamples; without any there are no bootstrap limits.
    pub replicates: usize,
    /// Probability with which limits hold the truth.
    pub confidence: f64,
    /// Seed of the resamples.
    pub seed: u64,
}

/// Is told how many further steps are done; its error stops the fits.
pub type Progress<'a, E> = &'a (dyn Fn(u64) -> Result<(), E> + Sync);

/// The [`Progress`] of fits that nobody watches or stops.
///
/// # Errors
/// None.
pub fn unwatched(_steps: u64) -> Result<(), Infallible> {
    Ok(())
}

impl Uncertainty {
    /// The steps of progress of a group: its fits, and each resample.
    pub fn steps(&self) -> u64 {
        1 + self.replicates.next_multiple_of(TOGETHER) as u64
    }

    /// The replicates of each group; the groups have the same cells, within which they are resampled. `refit` is given what it
    /// needs to know of a group.
    pub(super) fn bootstrap<G: Sync, T: Send, E: Send>(
        &self,
        cells: &[usize],
        groups: &[G],
        progress: Progress<E>,
        refit: impl Fn(&G, &Resamples) -> [T; TOGETHER] + Sync,
    ) -> Result<Vec<Vec<T>>, E> {
        bootstrap_each(&Strata::new(cells), self.replicates, self.seed, groups, |group, resamples| {
            progress(TOGETHER as u64)?;
            Ok(refit(group, resamples))
        })
    }
}

/// Groups that are resampled jointly, at most: what is known of all their cases is held at once.
const JOINTLY: usize = 8;

/// Fits all groups. `fit` is given groups that follow each other and have the same cells: they have the same resamples, which
/// need be drawn only once.
pub(super) fn fit_jointly<'a, T: Send, E: Send>(
    groups: &[CaseGroup<'a>],
    fit: impl Fn(&[CaseGroup<'a>]) -> Result<Vec<T>, E> + Sync + Send,
) -> Result<Vec<T>, E> {
    let alike = groups.chunk_by(|a, b| a.cells == b.cells);
    let jointly: Vec<&[CaseGroup]> = alike.flat_map(|alike| alike.chunks(JOINTLY)).collect();
    let fitted = jointly.into_par_iter().map(fit).collect::<Result<Vec<Vec<T>>, E>>()?;
    Ok(fitted.into_iter().flatten().collect())
}
