//! What each case adds to a fit: from this follow the jackknife, robust errors and the first step of a refit.

use std::collections::BTreeMap;
use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use super::binary::BinaryFit;
use super::derivatives::{Scores, derivatives};
use super::design::{Design, Rows};
use super::link::Link;
use super::newton::{Along, newton_step};
use crate::wide::widest_on;

/// How many labels cases have by which they may be clusters.
const LABELS: usize = 2;

/// The derivatives of a log-likelihood (or of half the negative residual sum of squares) with respect to the index of
/// each case, at the fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Influence {
    coefficients: DVector<f64>,
    /// Of a likelihood; none of least squares.
    link: Option<Link>,
}

impl Influence {
    /// Of a least-squares fit with these coefficients.
    pub fn of_least_squares(coefficients: DVector<f64>) -> Influence {
        Influence { coefficients, link: None }
    }

    /// Of a binary regression.
    pub fn of_regression(fit: &BinaryFit) -> Influence {
        Influence { coefficients: fit.coefficients.clone(), link: Some(fit.link) }
    }

    /// Replaces the indices of some cases by their derivatives.
    #[inline(always)]
    fn score(&self, y: &[f64], mut scores: Scores) {
        match self.link {
            Some(link) => link.scores(y, scores),
            None => {
                for ((slope, curvature), y) in scores.iter_mut().zip(y) {
                    (*slope, *curvature) = (y - *slope, 1.0);
                }
            }
        }
    }

    /// First derivatives, and the negative of the second ones, of a block.
    fn scores(&self, rows: &Rows) -> (Vec<f64>, Vec<f64>) {
        let (mut slope, mut curvature) =
            (rows.indices(self.coefficients.as_slice()), vec![0.0; rows.count()]);
        widest_on(
            Scores { slope: &mut slope, curvature: &mut curvature },
            #[inline(always)]
            |scores| self.score(rows.y, scores),
        );
        (slope, curvature)
    }

    /// The change of the coefficients in one Newton step where each case counts `weights` times: exact for least
    /// squares. None if the weighted cases do not determine them.
    pub fn step(&self, design: &Design, weights: &[f64]) -> Option<DVector<f64>> {
        let objective = derivatives(
            design,
            self.coefficients.as_slice(),
            #[inline(always)]
            |rows, cases, mut scores| {
                self.score(&rows.y[cases.clone()], scores.reborrow());
                for ((slope, curvature), weight) in scores.iter_mut().zip(&weights[rows.first..][cases]) {
                    (*slope, *curvature) = (weight * *slope, weight * *curvature);
                }
            },
        );
        newton_step(&objective, Along::All)
    }

    /// The covariance of the coefficients where cases of one cluster may depend on each other and none need have the
    /// variance of the model: the sandwich, with the usual factor G/(G - 1) (n - 1)/(n - k) for G clusters (Cameron &
    /// Miller 2015, A practitioner's guide to cluster-robust inference, J. Human Resources 50, 317-372). `bread` is the
    /// inverse information, `cluster` tells that of a case from its labels. Where all cases share one cluster, each counts as its own.
    pub fn clustered_covariance(
        &self,
        design: &Design,
        bread: &DMatrix<f64>,
        cluster: impl Fn(&Rows, usize) -> usize + Sync,
    ) -> DMatrix<f64> {
        let (n, k) = (design.cases() as f64, design.coefficients());
        let of_block = |rows: &Rows| {
            let mut totals: BTreeMap<usize, DVector<f64>> = BTreeMap::new();
            let (score, _) = self.scores(rows);
            for (case, score) in score.into_iter().enumerate() {
                let total = totals.entry(cluster(rows, case)).or_insert_with(|| DVector::zeros(rows.x.len()));
                total.iter_mut().zip(&rows.x).for_each(|(total, x)| *total += x[case] * score);
            }
            totals
        };
        let totals = design.fold(LABELS, of_block, |totals, part| {
            for (cluster, more) in part {
                *totals.entry(cluster).or_insert_with(|| DVector::zeros(k)) += more;
            }
        });
        let (g, meat) = if totals.len() == 1 {
            let squares = |rows: &Rows, cases: Range<usize>, mut scores: Scores| {
                self.score(&rows.y[cases], scores.reborrow());
                scores.iter_mut().for_each(|(slope, curvature)| *curvature = *slope * *slope);
            };
            (n, derivatives(design, self.coefficients.as_slice(), squares).information)
        } else {
            let square = |sum, total: &DVector<f64>| sum + total * total.transpose();
            (totals.len() as f64, totals.values().fold(DMatrix::zeros(k, k), square))
        };
        bread.tr_mul(&meat.tr_mul(bread)) * (g / (g - 1.0) * (n - 1.0) / (n - k as f64))
    }

    /// The change of the coefficients without each of some cases in turn, of which `bread` is the inverse information: exact for
    /// least squares, one Newton step for a likelihood (Pregibon 1981, Logistic regression diagnostics, Ann. Stat. 9).
    pub fn without_each(&self, rows: &Rows, bread: &DMatrix<f64>) -> Vec<DVector<f64>> {
        let (score, curvature) = self.scores(rows);
        let change = |((row, score), curvature): ((DVector<f64>, f64), f64)| {
            let direction = bread * &row;
            let leverage = curvature * row.dot(&direction);
            direction * (-score / (1.0 - leverage))
        };
        rows.each().zip(score).zip(curvature).map(change).collect()
    }
}
