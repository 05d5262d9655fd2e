//! What a regression gives: coefficients with their uncertainty, and one word that says whether it can be
//! used.

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use super::clusters::sandwich;
use crate::keyword::keywords;

/// Whether there is a fit that can be used, and if not, why.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FitStatus {
    Ok,
    /// Squares and products of the predictors add to it (p < 0.01).
    PoorFit,
    /// Demand or probability falls as the measure grows.
    WrongSign,
    /// The predictors tell events and others apart: the likelihood has no maximum.
    Separated,
    /// Fewer than five events, or fewer than five others.
    TooFewEvents,
    /// A measure is constant, or a combination of others, or there are fewer cases than coefficients.
    Degenerate,
    /// The iterations did not come to an end.
    NotConverged,
}

keywords!(FitStatus {
    Ok = "ok",
    PoorFit = "poor_fit",
    WrongSign = "wrong_sign",
    Separated = "separated",
    TooFewEvents = "too_few_events",
    Degenerate = "degenerate",
    NotConverged = "not_converged",
});

impl FitStatus {
    /// Whether the fit can answer.
    pub fn is_usable(self) -> bool {
        matches!(self, FitStatus::Ok | FitStatus::PoorFit)
    }
}

/// A fit whose test has a smaller probability is poor.
const POOR_FIT: f64 = 0.01;

/// Limits of confidence.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Limits {
    pub low: f64,
    pub high: f64,
}

/// A number with its standard error and limits of confidence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    pub value: f64,
    pub standard_error: f64,
    pub low: f64,
    pub high: f64,
}

impl Estimate {
    /// Makes an estimate whose limits are `quantile` standard errors away.
    pub fn new(value: f64, standard_error: f64, quantile: f64) -> Estimate {
        let half_width = quantile * standard_error;
        Estimate { value, standard_error, low: value - half_width, high: value + half_width }
    }

    /// Takes the exponential: the error by the delta method, the limits those of this estimate.
    pub fn exp(self) -> Estimate {
        let value = self.value.exp();
        let standard_error = value * self.standard_error;
        Estimate { value, standard_error, low: self.low.exp(), high: self.high.exp() }
    }
}

/// A linear predictor z = b0 + b1 x1 + ..., by least squares or maximum likelihood.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Intercept first.
    pub coefficients: DVector<f64>,
    /// Covariance of the coefficients if the cases are independent and the model holds.
    pub covariance: DMatrix<f64>,
    /// Covariance that allows for dependence within clusters; none of too few clusters.
    pub clustered: Option<DMatrix<f64>>,
    /// Number of clusters; 0 where none were given.
    pub clusters: usize,
    /// Degrees of freedom of the model's limits: n - k of least squares, infinite of a likelihood.
    pub degrees: f64,
    /// Number of cases.
    pub n: usize,
    /// Probability of what squares and products of the predictors add by chance; none where it was not
    /// tested, or they do not vary.
    pub misfit_p: Option<f64>,
    /// [`FitStatus::Ok`], or what speaks against the fit.
    pub status: FitStatus,
}

impl Fit {
    /// Adds the covariance that allows for dependence within clusters. `scores` are the derivatives of the
    /// log-likelihood with respect to z of each case, `bread` the inverse information.
    pub(super) fn allow_for_clusters(
        &mut self,
        x: &[&[f64]],
        scores: &[f64],
        bread: &DMatrix<f64>,
        clusters: &[u32],
    ) {
        (self.clustered, self.clusters) = sandwich(x, scores, bread, clusters);
    }

    /// Notes the outcome of the test of the form.
    pub(super) fn note_misfit(&mut self, p: Option<f64>) {
        self.misfit_p = p;
        if p.is_some_and(|p| p < POOR_FIT) {
            self.status = FitStatus::PoorFit;
        }
    }

    /// Returns the covariance that limits rest on, the clustered one if there is one, and its degrees of
    /// freedom.
    pub fn limiting_covariance(&self) -> (&DMatrix<f64>, f64) {
        match &self.clustered {
            Some(clustered) => (clustered, self.clusters as f64 - 1.0),
            None => (&self.covariance, self.degrees),
        }
    }
}

/// Computes z = b0 + b1 x1 + ... of each case.
pub fn predict(coefficients: &[f64], x: &[&[f64]]) -> Vec<f64> {
    let mut z = vec![coefficients[0]; x.first().map_or(0, |x| x.len())];
    for (b, x) in coefficients[1..].iter().zip(x) {
        z.iter_mut().zip(*x).for_each(|(z, x)| *z += b * x);
    }
    z
}

/// Computes the sum of products of two vectors.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Computes g' C g, the variance of a function with the gradient `g` by the delta method; `covariance` is row
/// by row.
pub fn variance(covariance: &[f64], gradient: &[f64]) -> f64 {
    let rows = covariance.chunks_exact(gradient.len());
    rows.zip(gradient).map(|(row, g)| g * dot(row, gradient)).sum()
}
