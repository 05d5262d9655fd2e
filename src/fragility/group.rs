//! What all fits of a group of cases share: the limits that are asked for, and progress.

use std::convert::Infallible;
use std::sync::OnceLock;

use rayon::prelude::*;

use super::case::Case;
use super::cases::CaseTable;
use crate::resampling::{Draws, Resamples, Sizes, Strata, TOGETHER};

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

    /// The replicates of each group; the groups have the same cells, within which they are resampled. What is summed over cases is
    /// summed block by block, of many resamples at once.
    pub(super) fn bootstrap<R: Refits, E: Send>(
        &self,
        groups: &[&CaseTable],
        sizes: &Sizes,
        refits: &[R],
        progress: Progress<E>,
    ) -> Result<Vec<Vec<R::Refit>>, E> {
        let blocks = groups[0].blocks();
        let strata = |block: usize| Strata::new(&groups[0].cells_of(block));
        let firsts: Vec<usize> = (0..self.replicates).step_by(TOGETHER).collect();
        let mut done: Vec<Vec<R::Refit>> = refits.iter().map(|_| Vec::new()).collect();
        for firsts in firsts.chunks((MOST_SUMS / groups.len()).max(1)) {
            let none = |&first: &usize| {
                (Draws::new(sizes, self.seed, first), refits.iter().map(R::none).collect::<Vec<_>>())
            };
            let mut batches: Vec<(Draws, Vec<R::Sums>)> = firsts.iter().map(none).collect();
            for block in 0..blocks {
                let strata = strata(block);
                let of_group = |(refits, group): (&R, &&CaseTable)| refits.terms(&group.block(block));
                let terms: Vec<R::Terms> = refits.par_iter().zip(groups).map(of_group).collect();
                batches.par_iter_mut().for_each(|(draws, sums)| {
                    let resamples = draws.next(&strata);
                    let of_groups = refits.iter().zip(&terms).zip(sums);
                    of_groups.for_each(|((refits, terms), sums)| refits.add(terms, &resamples, sums));
                });
            }
            let refitted = |((_, sums), &first): ((Draws, Vec<R::Sums>), &usize)| {
                // Only refits whose sums are not precise enough ask for these.
                let whole = OnceLock::new();
                let whole = || -> &Resamples {
                    whole.get_or_init(|| {
                        let mut draws = Draws::new(sizes, self.seed, first);
                        let counts = (0..blocks).flat_map(|block| draws.next(&strata(block)).counts);
                        Resamples { counts: counts.collect() }
                    })
                };
                let of_group = |(refits, sums): (&R, R::Sums)| {
                    progress(TOGETHER as u64)?;
                    Ok(refits.refits(sums, &whole))
                };
                refits.iter().zip(sums).map(of_group).collect::<Result<Vec<_>, E>>()
            };
            let batches = batches.into_par_iter().zip(firsts).map(refitted).collect::<Result<Vec<_>, E>>()?;
            for of_groups in batches {
                done.iter_mut().zip(of_groups).for_each(|(done, refits)| done.extend(refits));
            }
        }
        done.iter_mut().for_each(|done| done.truncate(self.replicates));
        Ok(done)
    }
}

/// Batches of resamples, times groups, whose sums are held at once.
const MOST_SUMS: usize = 512;

/// The fits of a group, to be made anew in resamples of its cases.
pub(super) trait Refits: Sync {
    /// What is summed of the cases of a block.
    type Terms: Send + Sync;
    /// Their sums, in each of some resamples.
    type Sums: Send;
    /// All fits of one resample.
    type Refit: Send;

    fn terms(&self, cases: &[Case]) -> Self::Terms;

    /// The sums over no cases.
    fn none(&self) -> Self::Sums;

    fn add(&self, terms: &Self::Terms, resamples: &Resamples, sums: &mut Self::Sums);

    /// What follows from the sums over all cases; `whole` tells how often each of all cases is drawn.
    fn refits<'w>(
        &self,
        sums: Self::Sums,
        whole: &(dyn Fn() -> &'w Resamples + 'w),
    ) -> [Self::Refit; TOGETHER];
}

/// Groups that are resampled jointly, at most: what is known of all their cases is held at once.
const JOINTLY: usize = 4;

/// Fits all groups. `fit` is given groups that follow each other, and how many cases each cell has; if they are to be resampled, all have
/// the same cells and so the same resamples, which need be drawn only once. Groups of many cases come one after the other, so that only
/// the samples of one are held.
pub(super) fn fit_jointly<T: Send, E: Send>(
    groups: &[&CaseTable],
    uncertainty: &Uncertainty,
    fit: impl Fn(&[&CaseTable], &Sizes) -> Result<Vec<T>, E> + Sync + Send,
) -> Result<Vec<T>, E> {
    let alike = |a: &&CaseTable, b: &&CaseTable| uncertainty.replicates > 0 && a.has_cells_of(b);
    let jointly: Vec<&[&CaseTable]> =
        groups.chunk_by(alike).flat_map(|alike| alike.chunks(JOINTLY)).collect();
    let fit = |groups: &[&CaseTable]| fit(groups, &groups[0].cell_sizes());
    let fitted = if groups.iter().all(|group| group.is_small()) {
        jointly.into_par_iter().map(fit).collect::<Result<Vec<Vec<T>>, E>>()
    } else {
        jointly.into_iter().map(fit).collect()
    };
    Ok(fitted?.into_iter().flatten().collect())
}
