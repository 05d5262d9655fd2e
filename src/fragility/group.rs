//! What all fits of a group of cases share: the limits that are asked for, and progress.

use std::convert::Infallible;

use rayon::prelude::*;

use super::cases::CaseTable;
use crate::resampling::{Resamples, Strata, TOGETHER, bootstrap_each};

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

/// Fits all groups. `fit` is given groups that follow each other, and the cells of their cases if they are to be resampled: these
/// are the same, and so are the resamples, which need be drawn only once. Groups of many cases come one after the other, so that only
/// the samples of one are held.
pub(super) fn fit_jointly<T: Send, E: Send>(
    groups: &[&CaseTable],
    uncertainty: &Uncertainty,
    fit: impl Fn(&[&CaseTable], &[usize]) -> Result<Vec<T>, E> + Sync + Send,
) -> Result<Vec<T>, E> {
    let cells = |group: &&CaseTable| if uncertainty.replicates > 0 { group.cells() } else { Vec::new() };
    let cells: Vec<Vec<usize>> = groups.iter().map(cells).collect();
    let mut jointly: Vec<(&[&CaseTable], &[usize])> = Vec::new();
    let mut first = 0;
    for alike in cells.chunk_by(|a, b| a == b && uncertainty.replicates > 0) {
        let (of_alike, cells) = (&groups[first..first + alike.len()], &alike[0]);
        jointly.extend(of_alike.chunks(JOINTLY).map(|groups| (groups, &cells[..])));
        first += alike.len();
    }
    let fitted = if groups.iter().all(|group| group.is_small()) {
        jointly.into_par_iter().map(|(groups, cells)| fit(groups, cells)).collect::<Result<Vec<Vec<T>>, E>>()
    } else {
        jointly.into_iter().map(|(groups, cells)| fit(groups, cells)).collect()
    };
    Ok(fitted?.into_iter().flatten().collect())
}
