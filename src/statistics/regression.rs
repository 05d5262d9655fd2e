//! Ordinary least squares.

use nalgebra::{DMatrix, DVector};

use super::design::{Dependence, dependence, is_constant};
use super::distribution::t_quantile;
use super::estimate::Estimate;
use crate::statistics::FitStatus;

/// A linear regression with an intercept.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearFit {
    /// The intercept, then a slope for each predictor; 95 % limits by Student's t.
    pub coefficients: Vec<Estimate>,
    /// Of the coefficients.
    pub covariance: DMatrix<f64>,
    /// Coefficient of determination.
    pub r2: f64,
    /// Residual standard deviation, with n - k degrees of freedom for k coefficients.
    pub residual_sd: f64,
    /// Residual sum of squares.
    pub rss: f64,
    /// Sum of squares about the mean.
    pub tss: f64,
    /// Cases.
    pub n: usize,
}

impl LinearFit {
    /// The same fit with the limits of the coefficients at this confidence.
    pub fn at_confidence(mut self, confidence: f64) -> LinearFit {
        let degrees = self.n - self.coefficients.len();
        let quantile = t_quantile(0.5 * (1.0 + confidence), degrees as f64);
        for estimate in &mut self.coefficients {
            *estimate = Estimate::symmetric(estimate.value, estimate.standard_error, quantile);
        }
        self
    }

    /// Whether the response grows with the first predictor.
    pub fn status(&self) -> FitStatus {
        if self.coefficients[1].value > 0.0 { FitStatus::Ok } else { FitStatus::Falling }
    }

    /// The values of the coefficients.
    pub fn values(&self) -> DVector<f64> {
        DVector::from_iterator(self.coefficients.len(), self.coefficients.iter().map(|b| b.value))
    }
}

/// Why there is no regression.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum RegressionError {
    /// Fewer cases than coefficients plus one.
    #[error("{cases} cases; expected {needed} or more")]
    TooFewCases {
        /// How many there are.
        cases: usize,
        /// How many are needed.
        needed: usize,
    },
    /// A predictor or the response does not vary.
    #[error("a predictor or the response does not vary")]
    Constant,
    /// A predictor is a combination of the others.
    #[error("the predictors do not vary independently")]
    Collinear,
}

/// Ordinary least squares of `y` on an intercept and `predictors`, each as long as `y`, by QR decomposition.
///
/// # Errors
/// If there are too few cases, something does not vary, or the predictors are collinear.
pub fn least_squares(predictors: &[&[f64]], y: &[f64]) -> Result<LinearFit, RegressionError> {
    let (n, k) = (y.len(), predictors.len() + 1);
    if n <= k {
        return Err(RegressionError::TooFewCases { cases: n, needed: k + 1 });
    }
    match dependence(predictors) {
        Some(Dependence::Constant) => return Err(RegressionError::Constant),
        Some(Dependence::Collinear) => return Err(RegressionError::Collinear),
        None if is_constant(y) => return Err(RegressionError::Constant),
        None => {}
    }
    let design =
        DMatrix::from_fn(n, k, |row, column| if column == 0 { 1.0 } else { predictors[column - 1][row] });
    let response = DVector::from_column_slice(y);
    let qr = design.clone().qr();
    let r = qr.r();
    let inverse = r.clone().try_inverse().ok_or(RegressionError::Collinear)?;
    let coefficients = &inverse * (qr.q().transpose() * &response);
    let residuals = &response - design * &coefficients;
    let rss = residuals.norm_squared();
    let mean = response.mean();
    let tss = response.add_scalar(-mean).norm_squared();
    let degrees = (n - k) as f64;
    let variance = rss / degrees;
    let quantile = t_quantile(0.975, degrees);
    // (X'X)^-1 = R^-1 R^-T.
    let covariance = &inverse * inverse.transpose() * variance;
    let estimate = |j: usize| Estimate::symmetric(coefficients[j], covariance[(j, j)].sqrt(), quantile);
    Ok(LinearFit {
        coefficients: (0..k).map(estimate).collect(),
        covariance,
        r2: 1.0 - rss / tss,
        residual_sd: variance.sqrt(),
        rss,
        tss,
        n,
    })
}
