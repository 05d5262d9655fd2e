//! Cross-validation that leaves out whole clusters, since the motions of an earthquake, or of a magnitude and
//! distance, resemble each other (Roberts et al. 2017, Ecography 40, 913-929).

use std::collections::BTreeSet;

/// Which cases are left out together.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Folds {
    /// The fold of each case.
    of: Vec<usize>,
    pub count: usize,
}

impl Folds {
    /// Deals the clusters of the cases to at most `most` folds, in turn, so that neighbouring clusters fall
    /// into different folds. None where all cases share one cluster.
    pub fn new(clusters: &[u32], most: usize) -> Option<Folds> {
        let distinct: Vec<u32> = clusters.iter().copied().collect::<BTreeSet<u32>>().into_iter().collect();
        let count = distinct.len().min(most);
        let fold = |cluster: &u32| distinct.partition_point(|other| other < cluster) % count;
        (count > 1).then(|| Folds { of: clusters.iter().map(fold).collect(), count })
    }

    /// Returns the cases that are kept without a fold, and those that are left out.
    pub fn split(&self, fold: usize) -> (Vec<usize>, Vec<usize>) {
        (0..self.of.len()).partition(|&case| self.of[case] != fold)
    }
}
