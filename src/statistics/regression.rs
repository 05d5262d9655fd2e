//! Ordinary least squares.

use nalgebra::{DMatrix, DVector};

use super::design::{Dependence, Design, Moments, Rows, columns_of, dot};
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

/// Ordinary least squares of `y` on an intercept and `predictors`, each as long as `y`.
///
/// # Errors
/// If there are too few cases, something does not vary, or the predictors are collinear.
pub fn least_squares(predictors: &[&[f64]], y: &[f64]) -> Result<LinearFit, RegressionError> {
    let columns = columns_of(predictors, y.to_vec());
    regress(&Design::new(&columns, predictors.len()))
}

/// The same of a design, by the normal equations of deviations from the means, and a step more that takes away their rounding.
///
/// # Errors
/// As there.
pub fn regress(design: &Design) -> Result<LinearFit, RegressionError> {
    let (n, k) = (design.cases(), design.coefficients());
    if n <= k {
        return Err(RegressionError::TooFewCases { cases: n, needed: k + 1 });
    }
    let moments = Moments::of(design);
    match moments.dependence() {
        Some(Dependence::Constant) => return Err(RegressionError::Constant),
        Some(Dependence::Collinear) => return Err(RegressionError::Collinear),
        None if moments.is_constant(k - 1) => return Err(RegressionError::Constant),
        None => {}
    }
    // Slopes follow from the deviations, the intercept from the means.
    let products = DMatrix::from_fn(k - 1, k - 1, |i, j| moments.product(i, j));
    let of_deviations = products.cholesky().ok_or(RegressionError::Collinear)?;
    let slopes = of_deviations.solve(&DVector::from_fn(k - 1, |i, _| moments.product(i, k - 1)));
    let means = DVector::from_column_slice(&moments.means[..k - 1]);
    let intercept = moments.means[k - 1] - means.dot(&slopes);
    let mut coefficients = slopes.insert_row(0, intercept);
    // (X'X)^-1 of the design itself.
    let from_deviations = DMatrix::from_fn(k, k, |i, j| match (i, j) {
        (1.., 0) => -means[i - 1],
        _ => f64::from(u8::from(i == j)),
    });
    let mut inverse = of_deviations.inverse().insert_row(0, 0.0).insert_column(0, 0.0);
    inverse[(0, 0)] = 1.0 / n as f64;
    let inverse = from_deviations.tr_mul(&inverse.tr_mul(&from_deviations));
    let of_residuals = |rows: &Rows| {
        let mut residuals = rows.indices(coefficients.as_slice());
        residuals.iter_mut().zip(rows.y).for_each(|(fitted, y)| *fitted = y - *fitted);
        let on_each = |x: &&[f64]| dot(x, &residuals);
        (rows.x.iter().map(on_each).collect::<Vec<f64>>(), dot(&residuals, &residuals))
    };
    let (on_each, rss) = design.fold(0, of_residuals, |(on_each, rss), (more, squares)| {
        on_each.iter_mut().zip(more).for_each(|(sum, more)| *sum += more);
        *rss += squares;
    });
    let on_each = DVector::from_vec(on_each);
    let step = &inverse * &on_each;
    let rss = rss - step.dot(&on_each);
    coefficients += step;
    let tss = moments.product(k - 1, k - 1);
    let degrees = (n - k) as f64;
    let variance = rss / degrees;
    let quantile = t_quantile(0.975, degrees);
    let covariance = inverse * variance;
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
