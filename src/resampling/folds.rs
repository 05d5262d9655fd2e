//! Cross-validation that respects the design: whole clusters are left out, since the motions of a magnitude-distance cell, or of an
//! earthquake, resemble each other (Roberts et al. 2017, Cross-validation strategies for data with temporal, spatial,
//! hierarchical, or phylogenetic structure, Ecography 40, 913-929).

use std::collections::{BTreeMap, BTreeSet};

/// The most folds where no other number is asked for.
pub const MOST_FOLDS: usize = 10;

/// Which cases are left out together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Folds {
    /// The fold of each case.
    pub of: Vec<usize>,
    /// How many there are.
    pub count: usize,
}

impl Folds {
    /// Of the clusters of the cases, up to `most`: neighbouring clusters fall into different folds, so that what is left out
    /// lies within what is kept. None where all cases share one cluster, so that nothing can be left out.
    pub fn new(clusters: &[usize], most: usize) -> Option<Folds> {
        let distinct: BTreeSet<usize> = clusters.iter().copied().collect();
        let count = distinct.len().min(most);
        let fold: BTreeMap<usize, usize> = distinct.into_iter().zip((0..count).cycle()).collect();
        (count > 1).then(|| Folds { of: clusters.iter().map(|cluster| fold[cluster]).collect(), count })
    }

    /// How often each case counts without a fold: once, or not at all.
    pub fn without(&self, fold: usize) -> Vec<f64> {
        self.of.iter().map(|&of| if of == fold { 0.0 } else { 1.0 }).collect()
    }

    /// What the fit without its fold says of each case; none if one of the fits does not exist. `fit` gets a fold and how
    /// often each case counts without it.
    pub fn leave_out<T, Fitted: Fn(usize) -> T>(
        &self,
        fit: impl Fn(usize, &[f64]) -> Option<Fitted>,
    ) -> Option<Vec<T>> {
        let fits = (0..self.count).map(|fold| fit(fold, &self.without(fold)));
        let fits = fits.collect::<Option<Vec<Fitted>>>()?;
        Some(self.of.iter().enumerate().map(|(case, &fold)| fits[fold](case)).collect())
    }
}

/// By how much one forecast is better than another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gain {
    /// Mean difference of their log scores.
    pub value: f64,
    /// Its standard error, where cases of one cluster may depend on each other.
    pub standard_error: f64,
}

/// The gain of forecasts with these log scores over a reference, paired case by case. Its error follows from the sums over the
/// clusters: C / (C - 1) sum (S_c - n_c mean)^2 / n^2 for C clusters.
pub fn gain(log_scores: &[f64], reference: &[f64], clusters: &[usize]) -> Gain {
    let n = log_scores.len() as f64;
    let differences = || log_scores.iter().zip(reference).map(|(score, other)| score - other);
    let mean = differences().sum::<f64>() / n;
    let mut sums: BTreeMap<usize, f64> = BTreeMap::new();
    for (difference, &cluster) in differences().zip(clusters) {
        *sums.entry(cluster).or_default() += difference - mean;
    }
    let count = sums.len() as f64;
    let squares: f64 = sums.values().map(|sum| sum * sum).sum();
    Gain { value: mean, standard_error: (count / (count - 1.0) * squares).sqrt() / n }
}
