//! Maximum likelihood of binary outcomes.

use nalgebra::{DMatrix, DVector};

use super::derivatives::{Score, derivatives, sum};
use super::design_matrix::DesignMatrix;
use super::firth::{Estimator, penalty};
use super::link::{Link, cloglog_score, logit_score, probit_ln_probability, probit_score};
use super::newton::{Along, Maximum, Objective, maximise};

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
/// may still stop, far out where it is flat: [`is_separated`](super::is_separated) must be asked first.
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
    /// The cases.
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

    #[expect(
        clippy::redundant_closure,
        reason = "a function passed along is called in a way that need not be inlined"
    )]
    fn log_likelihood(&self, coefficients: &DVector<f64>) -> f64 {
        match self.link {
            Link::Probit => self.total(
                coefficients,
                #[inline(always)]
                |index, event| probit_ln_probability(index, event),
            ),
            link => self.total(coefficients, |index, event| link.ln_probability(index, event)),
        }
    }

    fn total(&self, coefficients: &DVector<f64>, ln_probability: impl Fn(f64, bool) -> f64) -> f64 {
        sum(
            self.design,
            coefficients.as_slice(),
            #[inline(always)]
            |cases, values| {
                let counted = self.events[cases.clone()].iter().zip(&self.weights[cases]);
                for (value, (&event, &weight)) in values.iter_mut().zip(counted) {
                    let ln_probability = ln_probability(*value, event);
                    *value = if weight > 0.0 { weight * ln_probability } else { 0.0 };
                }
            },
        )
    }

    /// Derivatives of the likelihood alone, its value left at zero: all that plain Newton steps need, in a fraction of the
    /// time.
    #[expect(
        clippy::redundant_closure,
        reason = "a function passed along is called in a way that need not be inlined"
    )]
    pub fn derivatives_at(&self, coefficients: &DVector<f64>) -> Objective {
        match self.link {
            Link::Probit => self.sum(
                coefficients,
                #[inline(always)]
                |index, event| probit_score(index, event),
            ),
            Link::Logit => self.sum(
                coefficients,
                #[inline(always)]
                |index, event| logit_score(index, event),
            ),
            Link::Cloglog => self.sum(
                coefficients,
                #[inline(always)]
                |index, event| cloglog_score(index, event),
            ),
        }
    }

    fn sum(&self, coefficients: &DVector<f64>, score: impl Fn(f64, bool) -> Score) -> Objective {
        derivatives(
            self.design,
            coefficients.as_slice(),
            #[inline(always)]
            |cases, mut scores| {
                let counted = self.events[cases.clone()].iter().zip(&self.weights[cases]);
                for ((slope, curvature), (&event, &weight)) in scores.iter_mut().zip(counted) {
                    let score = score(*slope, event);
                    // Where a case does not count its derivatives need not be finite.
                    *slope = if weight > 0.0 { weight * score.slope } else { 0.0 };
                    *curvature = if weight > 0.0 { weight * score.curvature } else { 0.0 };
                }
            },
        )
    }
}
