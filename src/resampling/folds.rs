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

/// The log scores of forecasts, summed over clusters.
#[derive(Debug, Clone, PartialEq)]
pub struct Scores {
    n: f64,
    sum: f64,
    /// The sum of each cluster, and its cases.
    by_cluster: Vec<(f64, f64)>,
}

impl Scores {
    /// Of these, case by case.
    pub fn of(log_scores: &[f64], clusters: &[usize]) -> Scores {
        let mut by_cluster: BTreeMap<usize, (f64, f64)> = BTreeMap::new();
        for (score, &cluster) in log_scores.iter().zip(clusters) {
            let (sum, cases) = by_cluster.entry(cluster).or_default();
            (*sum, *cases) = (*sum + score, *cases + 1.0);
        }
        let by_cluster = by_cluster.into_values().collect();
        Scores { n: log_scores.len() as f64, sum: log_scores.iter().sum(), by_cluster }
    }

    /// The mean of all.
    pub fn mean(&self) -> f64 {
        self.sum / self.n
    }

    /// The gain over a reference for the same cases. Its error follows from the sums over the clusters:
    /// C / (C - 1) sum (S_c - n_c mean)^2 / n^2 for C clusters.
    pub fn gain(&self, reference: &Scores) -> Gain {
        let mean = (self.sum - reference.sum) / self.n;
        let count = self.by_cluster.len() as f64;
        let of_cluster = |((sum, cases), (other, _)): (&(f64, f64), &(f64, f64))| sum - other - cases * mean;
        let sums = self.by_cluster.iter().zip(&reference.by_cluster).map(of_cluster);
        let squares: f64 = sums.map(|sum| sum * sum).sum();
        Gain { value: mean, standard_error: (count / (count - 1.0) * squares).sqrt() / self.n }
    }
}

/// The gain of forecasts with these log scores over a reference, case by case.
pub fn gain(log_scores: &[f64], reference: &[f64], clusters: &[usize]) -> Gain {
    Scores::of(log_scores, clusters).gain(&Scores::of(reference, clusters))
}
