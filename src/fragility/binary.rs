//! Maximum likelihood of binary outcomes.

use nalgebra::{DMatrix, DVector};

use super::design_matrix::{DesignMatrix, dot};
use super::firth::{Estimator, penalty};
use super::link::Link;
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
        design.rows().map(|row| dot(row, self.coefficients.as_slice())).collect()
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
    let start = DVector::zeros(design.columns());
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
        for (row, event, weight) in self.cases() {
            let index = dot(row, coefficients.as_slice());
            objective.value += weight * self.link.ln_probability(index, event);
        }
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

    /// Derivatives of the likelihood alone, its value left at zero: all that plain Newton steps need, in half the time.
    pub fn derivatives_at(&self, coefficients: &DVector<f64>) -> Objective {
        let mut sums = Derivatives::new(coefficients.len());
        for (row, event, weight) in self.cases() {
            let score = self.link.score(dot(row, coefficients.as_slice()), event);
            sums.add(row, weight * score.slope, weight * score.curvature);
        }
        sums.objective()
    }

    /// Row of the design, outcome and weight of each case that counts.
    fn cases(&self) -> impl Iterator<Item = (&[f64], bool, f64)> {
        let cases = self.design.rows().zip(self.events).zip(self.weights);
        cases.map(|((row, &event), &weight)| (row, event, weight)).filter(|(.., weight)| *weight > 0.0)
    }
}

/// Derivatives with respect to the coefficients, summed from those with respect to the indices.
pub struct Derivatives {
    gradient: Vec<f64>,
    /// The lower triangle row by row.
    information: Vec<f64>,
}

impl Derivatives {
    /// Of nothing yet.
    pub fn new(coefficients: usize) -> Derivatives {
        let triangle = coefficients * (coefficients + 1) / 2;
        Derivatives { gradient: vec![0.0; coefficients], information: vec![0.0; triangle] }
    }

    /// Adds a case with this row of the design.
    pub fn add(&mut self, row: &[f64], score: f64, curvature: f64) {
        let mut place = 0;
        for (i, x) in row.iter().enumerate() {
            self.gradient[i] += score * x;
            let scaled = curvature * x;
            for y in &row[..=i] {
                self.information[place] += scaled * y;
                place += 1;
            }
        }
    }

    /// The sums, with no value.
    pub fn objective(self) -> Objective {
        let k = self.gradient.len();
        let entry = |i: usize, j: usize| self.information[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
        let information = DMatrix::from_fn(k, k, entry);
        Objective { value: 0.0, gradient: DVector::from_vec(self.gradient), information }
    }
}
