//! Maximum likelihood of binary outcomes, and Firth's penalised likelihood, which has a maximum even where a measure separates the
//! outcomes, and less bias where events are few.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use crate::keyword::keywords;
use crate::statistics::derivatives::{Scores, derivatives, sum};
use crate::statistics::design::DesignMatrix;
use crate::statistics::link::Link;
use crate::statistics::newton::{Along, Maximum, Objective, maximise};

/// A binary regression with an intercept: P(event) = F(b0 + b1 x1 + ...).
#[derive(Debug, Clone, PartialEq)]
pub struct BinaryFit {
    /// F.
    pub link: Link,
    /// What was maximised.
    pub estimator: Estimator,
    /// Intercept first.
    pub coefficients: DVector<f64>,
    /// Inverse of the information: observed of the likelihood, expected of Firth's.
    pub covariance: DMatrix<f64>,
    /// Of the coefficients, without a penalty.
    pub log_likelihood: f64,
    /// What was maximised: the log-likelihood, with the penalty if there is one.
    pub objective: f64,
}

impl BinaryFit {
    /// b0 + b1 x1 + ... of each case.
    pub fn indices(&self, design: &DesignMatrix) -> Vec<f64> {
        design.indices(self.coefficients.as_slice())
    }
}

/// Why Newton's iterations found no maximum.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the likelihood has no maximum that Newton's iterations reach")]
pub struct BinaryError;

/// Maximises the Bernoulli likelihood of `events` (true: it happened), or as `estimator` says Firth's of them, by Newton's
/// method. `predictors` are each as long as `events`. Under separation the likelihood has no maximum, and the iterations
/// may still stop, far out where it is flat: [`is_separated`](crate::statistics::is_separated) must be asked first.
///
/// # Errors
/// If the iterations do not converge, or the predictors are collinear.
pub fn binary_regression(
    predictors: &[&[f64]],
    events: &[bool],
    link: Link,
    estimator: Estimator,
) -> Result<BinaryFit, BinaryError> {
    let design = DesignMatrix::new(predictors, events.len());
    let weights = vec![1.0; events.len()];
    let likelihood = BinaryLikelihood { design: &design, events, weights: &weights, link, estimator };
    let start = DVector::zeros(design.columns().len());
    let Maximum { at, objective, .. } = likelihood.maximise(&start, Along::All, 0.0).ok_or(BinaryError)?;
    let information = match estimator {
        Estimator::Ml => objective.information,
        Estimator::Firth => penalty(&likelihood, &at).ok_or(BinaryError)?.information,
    };
    let covariance = information.cholesky().ok_or(BinaryError)?.inverse();
    let log_likelihood = BinaryLikelihood { estimator: Estimator::Ml, ..likelihood }.at(&at).value;
    Ok(BinaryFit {
        link,
        estimator,
        coefficients: at,
        covariance,
        log_likelihood,
        objective: objective.value,
    })
}

/// The likelihood of outcomes as a function of the coefficients.
#[derive(Clone, Copy)]
pub struct BinaryLikelihood<'a> {
    pub design: &'a DesignMatrix,
    /// Whether it happened in each.
    pub events: &'a [bool],
    /// How often each counts.
    pub weights: &'a [f64],
    /// F.
    pub link: Link,
    /// Whether it is penalised.
    pub estimator: Estimator,
}

impl BinaryLikelihood<'_> {
    /// The maximum from `start`, to within `tolerance` of the log-likelihood.
    pub fn maximise(&self, start: &DVector<f64>, along: Along, tolerance: f64) -> Option<Maximum> {
        maximise(|coefficients| self.at(coefficients), start, along, tolerance)
    }

    /// Value and derivatives at these coefficients. The second derivatives are those of the likelihood alone, for which
    /// it is concave; with a penalty, which changes them by some n-th part, Newton's steps converge linearly.
    pub fn at(&self, coefficients: &DVector<f64>) -> Objective {
        let mut objective = self.derivatives_at(coefficients);
        objective.value = self.log_likelihood(coefficients);
        if self.estimator == Estimator::Firth {
            match penalty(self, coefficients) {
                Some(penalty) => {
                    objective.value += penalty.value;
                    objective.gradient += penalty.gradient;
                }
                None => objective.value = f64::NEG_INFINITY,
            }
        }
        objective
    }

    fn log_likelihood(&self, coefficients: &DVector<f64>) -> f64 {
        sum(
            self.design,
            coefficients.as_slice(),
            #[inline(always)]
            |cases, values| {
                self.link.ln_probabilities(&self.events[cases.clone()], values);
                values.iter_mut().zip(&self.weights[cases]).for_each(|(value, &weight)| count(value, weight));
            },
        )
    }

    /// Derivatives of the likelihood alone, its value left at zero: all that plain Newton steps need, in a fraction of the
    /// time.
    pub fn derivatives_at(&self, coefficients: &DVector<f64>) -> Objective {
        derivatives(
            self.design,
            coefficients.as_slice(),
            #[inline(always)]
            |cases, mut scores| {
                self.link.scores(&self.events[cases.clone()], scores.reborrow());
                for ((slope, curvature), &weight) in scores.iter_mut().zip(&self.weights[cases]) {
                    count(slope, weight);
                    count(curvature, weight);
                }
            },
        )
    }
}

/// Lets a value count so often. Where it does not it need not be finite.
#[inline(always)]
fn count(value: &mut f64, weight: f64) {
    *value = if weight > 0.0 { weight * *value } else { 0.0 };
}

/// What is maximised.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Estimator {
    /// The likelihood.
    #[default]
    Ml,
    /// The likelihood times the root of the determinant of the expected information (Firth 1993, Biometrika 80, 27-38;
    /// Heinze & Schemper 2002, Statistics in Medicine 21, 2409-2419).
    Firth,
}

keywords!(Estimator { Ml = "ml", Firth = "firth" });

/// The logarithm of Firth's factor.
pub struct Penalty {
    /// Half the logarithm of the determinant of the expected information.
    pub value: f64,
    /// Its first derivatives.
    pub gradient: DVector<f64>,
    /// The expected information.
    pub information: DMatrix<f64>,
}

/// Firth's penalty at these coefficients; none where the information is singular.
pub fn penalty(likelihood: &BinaryLikelihood, coefficients: &DVector<f64>) -> Option<Penalty> {
    let BinaryLikelihood { design, weights, link, .. } = likelihood;
    let indices = design.indices(coefficients.as_slice());
    let of_cases: Vec<_> = indices.iter().map(|&index| link.information(index)).collect();
    let expected = |cases: Range<usize>, scores: Scores| {
        let counted = of_cases[cases.clone()].iter().zip(&weights[cases]);
        for (curvature, (of_case, &weight)) in scores.curvature.iter_mut().zip(counted) {
            *curvature = if weight > 0.0 { weight * of_case.weight } else { 0.0 };
        }
        scores.slope.fill(0.0);
    };
    let information = derivatives(design, &[], expected).information;
    let factor = information.clone().cholesky()?;
    let inverse = factor.inverse();
    let mut gradient = DVector::zeros(coefficients.len());
    let cases = design.rows().zip(&of_cases).zip(*weights).filter(|(_, weight)| **weight > 0.0);
    for ((row, of_case), weight) in cases {
        let leverage = weight * of_case.weight * (&inverse * &row).dot(&row);
        gradient += row * (0.5 * leverage * of_case.ln_weight_slope);
    }
    Some(Penalty { value: factor.l().diagonal().map(f64::ln).sum(), gradient, information })
}
