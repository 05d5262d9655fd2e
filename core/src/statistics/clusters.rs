//! Standard errors and cross-validation for dependent cases in clusters: earthquakes, or cells of magnitude
//! and distance.

use std::collections::BTreeSet;

use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

use super::fit::Fit;

/// With fewer clusters the standard errors are too small (Cameron & Miller 2015, section VI): they only widen
/// the model's own.
pub const MIN_CLUSTERS: usize = 10;
const FOLDS: usize = 10;

/// Sums `k` terms over the cases of each cluster that has any; `add` adds a case to a sum.
fn cluster_sums(clusters: &[u32], k: usize, add: impl Fn(usize, &mut [f64])) -> Vec<Vec<f64>> {
    let count = clusters.iter().max().map_or(0, |&last| last as usize + 1);
    let mut sums: Vec<Option<Vec<f64>>> = vec![None; count];
    for (case, &cluster) in clusters.iter().enumerate() {
        add(case, sums[cluster as usize].get_or_insert_with(|| vec![0.0; k]));
    }
    sums.into_iter().flatten().collect()
}

/// Computes the sandwich covariance of coefficients (k x k), with the factor G/(G - 1) (n - 1)/(n - k) for G
/// clusters (Cameron & Miller 2015, A practitioner's guide to cluster-robust inference, J. Human Resources
/// 50, 317-372), and G. `x` are the columns of predictors, `scores` the derivatives of the log-likelihood
/// with respect to z of each case, `bread` the inverse information. Not finite for one cluster.
pub fn sandwich(
    x: &[&[f64]],
    scores: &[f64],
    bread: &DMatrix<f64>,
    clusters: &[u32],
) -> (DMatrix<f64>, usize) {
    let (n, k) = (scores.len() as f64, x.len() + 1);
    let sums = cluster_sums(clusters, k, |case, sum| {
        sum[0] += scores[case];
        sum[1..].iter_mut().zip(x).for_each(|(sum, x)| *sum += scores[case] * x[case]);
    });
    let g = sums.len() as f64;
    let meat = sums
        .into_iter()
        .map(DVector::from_vec)
        .fold(DMatrix::zeros(k, k), |meat, sum| meat + &sum * sum.transpose());
    let factor = g / (g - 1.0) * (n - 1.0) / (n - k as f64);
    (bread * meat * bread * factor, g as usize)
}

/// Widens the model's covariance (k x k) to that of few clusters, times the square of the ratio of their
/// quantiles, in the directions in which this is larger: L Q max(1, D) Q' L', where the model's is L L' and
/// that of the clusters is L Q D Q' L'. None where the model's is not definite.
pub fn widened(model: &DMatrix<f64>, clustered: DMatrix<f64>) -> Option<DMatrix<f64>> {
    let factor = model.clone().cholesky()?.unpack();
    let inverse = factor.clone().try_inverse()?;
    let ratio = (&inverse * clustered * inverse.transpose()).symmetric_eigen();
    let errors = factor * ratio.eigenvectors;
    let larger = DMatrix::from_diagonal(&ratio.eigenvalues.map(|ratio| ratio.max(1.0)));
    Some(&errors * larger * errors.transpose())
}

/// Computes the standard error of the mean, sqrt(C/(C - 1) sum (S_c - n_c mean)^2) / n for C clusters, where
/// S_c is the sum of the n_c values of a cluster.
pub fn clustered_error_of_mean(values: &[f64], clusters: &[u32]) -> f64 {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let sums = cluster_sums(clusters, 1, |case, sum| sum[0] += values[case] - mean);
    let (g, squares) = (sums.len() as f64, sums.iter().map(|sum| sum[0] * sum[0]).sum::<f64>());
    (g / (g - 1.0) * squares).sqrt() / n
}

/// Predicts the z of each case by a fit without its fold. Clusters are dealt in turn, so that neighbours are
/// apart, to at most ten folds, since motions of one earthquake, or of one magnitude and distance, are alike
/// (Roberts et al. 2017, Ecography 40, 913-929). `fit` takes the columns and `y` of some cases, and gives
/// what else predicts: z comes with it. None for one cluster, or if a fold has no fit.
pub fn held_out<Y: Copy + Sync, With: Copy + Send>(
    x: &[&[f64]],
    y: &[Y],
    clusters: &[u32],
    fit: impl Fn(&[Vec<f64>], &[Y]) -> Option<(Fit, With)> + Sync,
) -> Option<Vec<(f64, With)>> {
    let distinct: Vec<u32> = clusters.iter().copied().collect::<BTreeSet<u32>>().into_iter().collect();
    let count = distinct.len().min(FOLDS);
    if count < 2 {
        return None;
    }
    let places = clusters.iter().map(|cluster| distinct.partition_point(|other| other < cluster));
    let folds: Vec<usize> = places.map(|place| place % count).collect();
    let predicted = (0..count).into_par_iter().map(|fold| {
        let (left_out, kept): (Vec<usize>, Vec<usize>) =
            (0..folds.len()).partition(|&case| folds[case] == fold);
        let columns: Vec<Vec<f64>> = x.iter().map(|x| kept.iter().map(|&case| x[case]).collect()).collect();
        let (Fit { coefficients: b, .. }, with) =
            fit(&columns, &kept.iter().map(|&case| y[case]).collect::<Vec<Y>>())?;
        let z = |case: usize| b[0] + b.iter().skip(1).zip(x).map(|(b, x)| b * x[case]).sum::<f64>();
        Some(left_out.into_iter().map(|case| (case, (z(case), with))).collect())
    });
    let mut predicted = predicted.collect::<Option<Vec<Vec<_>>>>()?.concat();
    predicted.sort_unstable_by_key(|(case, _)| *case);
    Some(predicted.into_iter().map(|(_, predicted)| predicted).collect())
}
