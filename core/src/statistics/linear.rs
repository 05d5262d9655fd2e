//! Ordinary least squares (Eqs. 16 and 17).

use nalgebra::DVector;

use super::clusters::sandwich;
use super::design::{DesignMatrix, mean_and_sd};
use super::fit::{Fit, FitStatus, predict};

/// A linear regression y = b0 + b1 x1 + ... with normal errors.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearFit {
    pub fit: Fit,
    /// Sums of squares: of the residuals, and about the mean of y.
    pub rss: f64,
    pub tss: f64,
}

impl LinearFit {
    pub fn r2(&self) -> f64 {
        1.0 - self.rss / self.tss
    }

    /// Computes the residual standard deviation, with n - k degrees of freedom.
    pub fn residual_sd(&self) -> f64 {
        (self.rss / self.fit.degrees_of_freedom).sqrt()
    }
}

/// Fits `y`, of length n, on an intercept and the columns of `x`, each of length n, by least squares.
///
/// # Errors
/// [`FitStatus::Degenerate`] where the cases do not determine the coefficients, or `y` does not vary.
pub fn least_squares(x: &[impl AsRef<[f64]>], y: &[f64]) -> Result<LinearFit, FitStatus> {
    let design = DesignMatrix::new(x)?;
    let (mean, _) = mean_and_sd(y).ok_or(FitStatus::Degenerate)?;
    let y = DVector::from_column_slice(y);
    let inverse = design.x.tr_mul(&design.x).cholesky().ok_or(FitStatus::Degenerate)?.inverse();
    let mut b = &inverse * design.x.tr_mul(&y);
    // One step of iterative refinement removes rounding errors.
    b += &inverse * design.x.tr_mul(&(&y - &design.x * &b));
    let rss = (&y - &design.x * &b).norm_squared();
    let degrees_of_freedom = (y.len() - b.len()) as f64;
    let fit = Fit::new(design.to_given(&b, &(inverse * (rss / degrees_of_freedom))), degrees_of_freedom);
    Ok(LinearFit { fit, rss, tss: y.add_scalar(-mean).norm_squared() })
}

/// Fits as [`least_squares`] and adds the clustered covariance. `clusters` has the cluster of each case.
pub fn clustered_least_squares(x: &[&[f64]], y: &[f64], clusters: &[u32]) -> Result<LinearFit, FitStatus> {
    let mut linear = least_squares(x, y)?;
    let fitted = predict(linear.fit.coefficients.as_slice(), x);
    let residuals: Vec<f64> = y.iter().zip(fitted).map(|(y, fitted)| y - fitted).collect();
    let bread = &linear.fit.covariance * (linear.fit.degrees_of_freedom / linear.rss);
    linear.fit.note_clusters(sandwich(x, &residuals, &bread, clusters));
    Ok(linear)
}
