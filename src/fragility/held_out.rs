//! How a curve does on clusters of cases that it has not seen, and by how much these differ from it.

use nalgebra::DVector;

use crate::resampling::folds::{Folds, MOST_FOLDS};
use crate::statistics::design::DesignMatrix;
use crate::statistics::link::Link;

/// What cases tell that were left out, each cluster of magnitude and distance (or earthquake) as a whole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeldOut {
    /// Mean logarithm of the probability of what happened.
    pub log_score: f64,
    /// Standard deviation of the index between clusters, of greatest likelihood.
    pub spread: f64,
}

/// Shifts of the index of a whole cluster, over which its likelihood is integrated.
const STEP: f64 = 0.1;
const STEPS_EACH_SIDE: i32 = 30;
/// Standard deviations that are tried: steps of a twelfth, up to where the shifts end twice away.
const LEAST_SPREAD: f64 = 0.05;
const SPREADS: i32 = 42;
const RATIO: f64 = 1.085;

impl HeldOut {
    /// Of cases with this design; `refit` gets how often each case counts, and makes the coefficients. None where nothing can be left
    /// out, where each case is a cluster of its own (so that nothing tells clusters from cases), or where a fit does not exist.
    pub fn new(
        design: &DesignMatrix,
        happened: &[bool],
        clusters: &[usize],
        link: Link,
        refit: impl Fn(&[f64]) -> Option<DVector<f64>>,
    ) -> Option<HeldOut> {
        let folds = Folds::new(clusters, MOST_FOLDS)?;
        let mut indices = vec![0.0; happened.len()];
        for fold in 0..folds.count {
            let of_fold = design.indices(refit(&folds.without(fold))?.as_slice());
            for (case, index) in indices.iter_mut().enumerate().filter(|(case, _)| folds.of[*case] == fold) {
                *index = of_fold[case];
            }
        }
        HeldOut::of_indices(&indices, happened, clusters, link)
    }

    /// Of indices that come from other clusters each.
    pub fn of_indices(indices: &[f64], happened: &[bool], clusters: &[usize], link: Link) -> Option<HeldOut> {
        let mut distinct: Vec<usize> = clusters.to_vec();
        distinct.sort_unstable();
        distinct.dedup();
        if distinct.len() == clusters.len() || distinct.len() < 2 {
            return None;
        }
        let at: Vec<usize> =
            clusters.iter().map(|cluster| distinct.partition_point(|other| other < cluster)).collect();
        // The log-likelihood of each cluster, its index shifted so far.
        let shifts: Vec<f64> = (-STEPS_EACH_SIDE..=STEPS_EACH_SIDE).map(|k| STEP * f64::from(k)).collect();
        let mut likelihoods = vec![vec![0.0; shifts.len()]; distinct.len()];
        let mut log_score = 0.0;
        for (k, shift) in shifts.iter().enumerate() {
            let mut values: Vec<f64> = indices.iter().map(|index| index + shift).collect();
            link.ln_probabilities(happened, &mut values);
            for (value, &cluster) in values.iter().zip(&at) {
                likelihoods[cluster][k] += value;
            }
            if *shift == 0.0 {
                log_score = values.iter().sum::<f64>();
            }
        }
        let integrated = |spread: f64| -> f64 {
            let weights: Vec<f64> =
                shifts.iter().map(|u| (-0.5 * (u / spread) * (u / spread)).exp()).collect();
            let total: f64 = weights.iter().sum();
            let of_cluster = |values: &Vec<f64>| {
                let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                let sum: f64 = values.iter().zip(&weights).map(|(value, w)| w * (value - most).exp()).sum();
                most + (sum / total).ln()
            };
            likelihoods.iter().map(of_cluster).sum()
        };
        let tried =
            (0..SPREADS).map(|k| LEAST_SPREAD * RATIO.powi(k)).map(|spread| (integrated(spread), spread));
        let best = std::iter::once((log_score, 0.0)).chain(tried).max_by(|a, b| a.0.total_cmp(&b.0));
        let spread = best.map_or(0.0, |(_, spread)| spread);
        Some(HeldOut { log_score: log_score / happened.len() as f64, spread })
    }
}
