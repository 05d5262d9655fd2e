use nalgebra::{DMatrix, DVector};

use super::student::t_quantile;

/// A number with its uncertainty.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The best estimate.
    pub value: f64,
    /// Its standard error.
    pub standard_error: f64,
    /// Its lower 95 % limit of confidence.
    pub low: f64,
    /// Its upper 95 % limit of confidence.
    pub high: f64,
}

impl Estimate {
    /// With limits `quantile` standard errors away.
    pub fn symmetric(value: f64, standard_error: f64, quantile: f64) -> Estimate {
        let half_width = quantile * standard_error;
        Estimate { value, standard_error, low: value - half_width, high: value + half_width }
    }
}

/// A linear regression with an intercept.
#[derive(Debug, Clone, PartialEq)]
pub struct LinearFit {
    /// The intercept, then a slope for each predictor; limits by Student's t.
    pub coefficients: Vec<Estimate>,
    /// Covariance of the coefficients.
    pub covariance: DMatrix<f64>,
    /// Least and largest value of each predictor.
    pub ranges: Vec<[f64; 2]>,
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
    /// A predictor is constant or a combination of the others.
    #[error("the predictors do not vary independently")]
    Singular,
}

/// Ordinary least squares of `y` on an intercept and `predictors`, each as long as `y`, by QR decomposition.
///
/// # Errors
/// If there are too few cases or the predictors are collinear.
pub fn least_squares(predictors: &[&[f64]], y: &[f64]) -> Result<LinearFit, RegressionError> {
    let (n, k) = (y.len(), predictors.len() + 1);
    if n <= k {
        return Err(RegressionError::TooFewCases { cases: n, needed: k + 1 });
    }
    let design =
        DMatrix::from_fn(n, k, |row, column| if column == 0 { 1.0 } else { predictors[column - 1][row] });
    let response = DVector::from_column_slice(y);
    let qr = design.clone().qr();
    let r = qr.r();
    let largest = r.diagonal().amax();
    if !r.diagonal().iter().all(|pivot| pivot.abs() > 1e-12 * largest) {
        return Err(RegressionError::Singular);
    }
    let inverse = r.clone().try_inverse().ok_or(RegressionError::Singular)?;
    let coefficients = &inverse * (qr.q().transpose() * &response);
    let residuals = &response - design * &coefficients;
    let rss = residuals.norm_squared();
    let mean = response.mean();
    let tss = response.add_scalar(-mean).norm_squared();
    let degrees = (n - k) as f64;
    let variance = rss / degrees;
    let quantile = t_quantile(0.975, degrees);
    // (X'X)^-1 = R^-1 R^-T: its diagonal holds the squared lengths of the rows of R^-1.
    let estimate =
        |j: usize| Estimate::symmetric(coefficients[j], inverse.row(j).norm() * variance.sqrt(), quantile);
    Ok(LinearFit {
        coefficients: (0..k).map(estimate).collect(),
        covariance: variance * &inverse * inverse.transpose(),
        ranges: predictors.iter().map(|values| range(values)).collect(),
        r2: 1.0 - rss / tss,
        residual_sd: variance.sqrt(),
        rss,
        tss,
        n,
    })
}

/// Least and largest of the values.
pub(super) fn range(values: &[f64]) -> [f64; 2] {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let largest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    [least, largest]
}
