//! What each case adds to a fit: from this follow the jackknife, robust errors and the first step of a refit.

use std::collections::BTreeMap;
use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::binary::BinaryFit;
use super::derivatives::{Scores, derivatives};
use super::design::DesignMatrix;
use super::newton::{Along, newton_step};
use crate::wide::widest;

/// The derivatives of a log-likelihood (or of half the negative residual sum of squares) with respect to the index of
/// each case, at the fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Influence {
    /// First derivative.
    score: Vec<f64>,
    /// The negative of the second derivative.
    curvature: Vec<f64>,
}

impl Influence {
    /// Of a least-squares fit with these residuals.
    pub fn of_residuals(residuals: Vec<f64>) -> Influence {
        Influence { curvature: vec![1.0; residuals.len()], score: residuals }
    }

    /// Of a binary regression.
    pub fn of_regression(fit: &BinaryFit, design: &DesignMatrix, events: &[bool]) -> Influence {
        let (mut score, mut curvature) = (fit.indices(design), vec![0.0; events.len()]);
        widest(
            #[inline(always)]
            || fit.link.scores(events, Scores { slope: &mut score, curvature: &mut curvature }),
        );
        Influence { score, curvature }
    }

    /// The change of the coefficients in one Newton step where each case counts `weights` times: exact for least
    /// squares. None if the weighted cases do not determine them.
    pub fn step(&self, design: &DesignMatrix, weights: &[f64]) -> Option<DVector<f64>> {
        let weighted = |cases: Range<usize>, mut scores: Scores| {
            let of_cases = self.score[cases.clone()].iter().zip(&self.curvature[cases.clone()]);
            let weighted = of_cases.zip(&weights[cases]);
            for ((slope, curvature), ((of_score, of_curvature), weight)) in scores.iter_mut().zip(weighted) {
                (*slope, *curvature) = (weight * of_score, weight * of_curvature);
            }
        };
        newton_step(&derivatives(design, &[], weighted), Along::All)
    }

    /// The covariance of the coefficients where cases of one cluster may depend on each other and none need have the
    /// variance of the model: the sandwich, with the usual factor G/(G - 1) (n - 1)/(n - k) for G clusters (Cameron &
    /// Miller 2015, A practitioner's guide to cluster-robust inference, J. Human Resources 50, 317-372). `bread` is the
    /// inverse information. Where all cases share one cluster, each counts as its own.
    pub fn clustered_covariance(
        &self,
        design: &DesignMatrix,
        bread: &DMatrix<f64>,
        clusters: &[usize],
    ) -> DMatrix<f64> {
        let (n, k) = (clusters.len() as f64, design.columns().len());
        let one_cluster = clusters.iter().all(|cluster| *cluster == clusters[0]);
        let mut totals: BTreeMap<usize, DVector<f64>> = BTreeMap::new();
        for (case, (row, score)) in design.rows().zip(&self.score).enumerate() {
            let cluster = if one_cluster { case } else { clusters[case] };
            *totals.entry(cluster).or_insert_with(|| DVector::zeros(k)) += row * *score;
        }
        let g = totals.len() as f64;
        let meat = totals.values().fold(DMatrix::zeros(k, k), |sum, total| sum + total * total.transpose());
        bread * meat * bread * (g / (g - 1.0) * (n - 1.0) / (n - k as f64))
    }

    /// The change of the coefficients without each case in turn, of which `bread` is the inverse information: exact for
    /// least squares, one Newton step for a likelihood (Pregibon 1981, Logistic regression diagnostics, Ann. Stat. 9).
    pub fn without_each(&self, design: &DesignMatrix, bread: &DMatrix<f64>) -> Vec<DVector<f64>> {
        let cases = design.rows().zip(&self.score).zip(&self.curvature);
        let change = |((row, score), curvature): ((DVector<f64>, &f64), &f64)| {
            let direction = bread * &row;
            let leverage = curvature * row.dot(&direction);
            direction * (-score / (1.0 - leverage))
        };
        cases.map(change).collect()
    }
}
