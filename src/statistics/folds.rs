//! Cross-validation by cluster, since motions of one earthquake, or of one magnitude and distance, are alike
//! (Roberts et al. 2017, Ecography 40, 913-929).

use std::collections::BTreeSet;

/// Assignment of cases to folds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Folds {
    /// Fold of each case.
    of: Vec<usize>,
    /// Number of folds.
    pub count: usize,
}

impl Folds {
    /// Deals the clusters to at most `most` folds in turn, so that neighbours are apart. None for one
    /// cluster.
    pub fn new(clusters: &[u32], most: usize) -> Option<Folds> {
        let distinct: Vec<u32> = clusters.iter().copied().collect::<BTreeSet<u32>>().into_iter().collect();
        let count = distinct.len().min(most);
        let fold = |cluster: &u32| distinct.partition_point(|other| other < cluster) % count;
        (count > 1).then(|| Folds { of: clusters.iter().map(fold).collect(), count })
    }

    /// Returns the cases to fit, and those left out, for a fold.
    pub fn split(&self, fold: usize) -> (Vec<usize>, Vec<usize>) {
        (0..self.of.len()).partition(|&case| self.of[case] != fold)
    }
}
