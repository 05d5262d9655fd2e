//! What each case adds to a fit: from this follow the jackknife, robust errors and the first step of a refit.

use nalgebra::{DMatrix, DVector};

use super::binary::{BinaryLikelihood, Derivatives};
use super::design_matrix::{DesignMatrix, dot};
use super::newton::{Along, newton_step};

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

    /// Of a binary regression at these coefficients.
    pub fn of_likelihood(likelihood: &BinaryLikelihood, coefficients: &DVector<f64>) -> Influence {
        let cases = likelihood.design.rows().zip(likelihood.events);
        let of = |(row, &event): (&[f64], &bool)| {
            let ln_p = likelihood.link.ln_probability(dot(row, coefficients.as_slice()), event);
            (ln_p.score, ln_p.curvature)
        };
        let (score, curvature) = cases.map(of).unzip();
        Influence { score, curvature }
    }

    /// The change of the coefficients in one Newton step where each case counts `weights` times: exact for least
    /// squares. None if the weighted cases do not determine them.
    pub fn step(&self, design: &DesignMatrix, weights: &[f64]) -> Option<DVector<f64>> {
        let mut sums = Derivatives::new(design.columns());
        for (((row, score), curvature), &weight) in
            design.rows().zip(&self.score).zip(&self.curvature).zip(weights)
        {
            if weight > 0.0 {
                sums.add(row, weight * score, weight * curvature);
            }
        }
        newton_step(&sums.objective(), Along::All)
    }

    /// The change of the coefficients without each case in turn, of which `bread` is the inverse information: exact for
    /// least squares, one Newton step for a likelihood (Pregibon 1981, Logistic regression diagnostics, Ann. Stat. 9).
    pub fn without_each(&self, design: &DesignMatrix, bread: &DMatrix<f64>) -> Vec<DVector<f64>> {
        let cases = design.rows().zip(&self.score).zip(&self.curvature);
        let change = |((row, score), curvature): ((&[f64], &f64), &f64)| {
            let row = DVector::from_column_slice(row);
            let direction = bread * &row;
            let leverage = curvature * row.dot(&direction);
            direction * (-score / (1.0 - leverage))
        };
        cases.map(change).collect()
    }
}
