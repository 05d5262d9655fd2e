//! The design matrix of a regression.

use nalgebra::{DMatrix, DVector};

use super::fit::FitStatus;

/// Values that vary by less than this share of their mean are constant.
const ROUNDING: f64 = 1e-12;
/// A predictor with less than this share left, after regression on the others, is a combination of them.
const LEAST_SHARE: f64 = 1e-7;

/// An intercept and standardised predictors: n x k.
pub struct DesignMatrix {
    pub x: DMatrix<f64>,
    /// Transforms coefficients of `x` to those of the original predictors, k x k.
    to_given: DMatrix<f64>,
}

/// Computes the mean and the standard deviation; `None` for constant values.
pub fn mean_and_sd(values: &[f64]) -> Option<(f64, f64)> {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let sd = (values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / n).sqrt();
    (sd > ROUNDING * mean.abs()).then_some((mean, sd))
}

impl DesignMatrix {
    /// Makes the design matrix of predictors, each a column of length n.
    ///
    /// # Errors
    /// [`FitStatus::Degenerate`] if a predictor is constant or a combination of others, or n <= k.
    pub fn new(columns: &[impl AsRef<[f64]>]) -> Result<DesignMatrix, FitStatus> {
        let (n, k) = (columns.first().map_or(0, |x| x.as_ref().len()), columns.len() + 1);
        if n <= k {
            return Err(FitStatus::Degenerate);
        }
        let mut x = DMatrix::from_element(n, k, 1.0);
        let mut to_given = DMatrix::identity(k, k);
        for (j, values) in columns.iter().map(AsRef::as_ref).enumerate() {
            let (mean, sd) = mean_and_sd(values).ok_or(FitStatus::Degenerate)?;
            x.column_mut(j + 1).iter_mut().zip(values).for_each(|(x, value)| *x = (value - mean) / sd);
            to_given[(0, j + 1)] = -mean / sd;
            to_given[(j + 1, j + 1)] = 1.0 / sd;
        }
        let correlation = x.tr_mul(&x) / n as f64;
        let shares = correlation.cholesky().ok_or(FitStatus::Degenerate)?.l().diagonal();
        if shares.min() < LEAST_SHARE { Err(FitStatus::Degenerate) } else { Ok(DesignMatrix { x, to_given }) }
    }

    pub fn to_given(&self, b: &DVector<f64>, covariance: &DMatrix<f64>) -> (DVector<f64>, DMatrix<f64>) {
        (&self.to_given * b, &self.to_given * covariance * self.to_given.transpose())
    }
}
