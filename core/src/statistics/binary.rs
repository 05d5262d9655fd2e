//! Probit regression of events by maximum likelihood: likelihood and maximum of Eqs. 19 to 22.

use nalgebra::{DMatrix, DVector};

use super::clusters::sandwich;
use super::design::DesignMatrix;
use super::fit::{Fit, FitStatus, predict};
use super::newton::{Maximum, Objective, maximise};
use super::normal;
use super::scores::largest_difference;

/// A fit needs this many events, and this many cases without an event.
const LEAST_EVENTS: usize = 5;
/// With fewer events, or fewer other cases, the limits are too narrow.
pub const FEW_EVENTS: usize = 10;
/// With a larger standard error of z the likelihood has no maximum.
const SEPARATION_SE: f64 = 1e3;

/// A probit regression P(event) = Phi(z), z = b0 + b1 x1 + ...
#[derive(Debug, Clone, PartialEq)]
pub struct ProbitFit {
    pub fit: Fit,
    /// Logarithm of the likelihood at the maximum (Eq. 21).
    pub log_likelihood: f64,
    /// Of the probability from the share of events; none if not compared, or of too few cases.
    pub largest_difference: Option<f64>,
    /// A usable one.
    pub status: FitStatus,
}

/// Computes the log-likelihood (Eq. 21): the sum of ln Phi(z) over events (overturning) and ln(1 - Phi(z))
/// over other cases, z = X b being (ln IM - mu) / beta of Eqs. 20 and 24. `x` is n x k, `b` has k elements.
pub fn log_likelihood(x: &DMatrix<f64>, events: &[bool], b: &DVector<f64>) -> f64 {
    let z = x * b;
    z.iter().zip(events).map(|(&z, &event)| normal::ln_cdf(if event { z } else { -z })).sum()
}

/// Computes [`log_likelihood`] with its gradient and information matrix.
fn derivatives(x: &DMatrix<f64>, events: &[bool], b: &DVector<f64>) -> Objective {
    let k = b.len();
    let z = x * b;
    Objective::sum(events.len(), k, |case, sum| {
        let sign = if events[case] { 1.0 } else { -1.0 };
        let (ln_p, mills) = normal::ln_cdf_and_slope(sign * z[case]);
        let curvature = mills * (mills + sign * z[case]);
        sum.value += ln_p;
        for i in 0..k {
            sum.gradient[i] += sign * mills * x[(case, i)];
            for j in 0..k {
                sum.information[(i, j)] += curvature * x[(case, i)] * x[(case, j)];
            }
        }
    })
}

fn maximum(x: &DMatrix<f64>, events: &[bool]) -> Maximum {
    let share = events.iter().filter(|event| **event).count() as f64 / events.len() as f64;
    let mut start = DVector::zeros(x.ncols());
    start[0] = normal::quantile(share);
    maximise(|b| derivatives(x, events, b), start)
}

/// Fits the probability of `events` on the columns of `x`, each of length n, by maximum likelihood.
///
/// # Errors
/// [`FitStatus::TooFewEvents`], [`FitStatus::Degenerate`], [`FitStatus::Separated`] or
/// [`FitStatus::NotConverged`].
pub fn probit(x: &[impl AsRef<[f64]>], events: &[bool]) -> Result<ProbitFit, FitStatus> {
    let count = events.iter().filter(|event| **event).count();
    if count.min(events.len() - count) < LEAST_EVENTS {
        return Err(FitStatus::TooFewEvents);
    }
    let design = DesignMatrix::new(x)?;
    let Maximum { at, objective, converged } = maximum(&design.x, events);
    let inverse = objective.information.cholesky().map(|factors| factors.inverse());
    let inverse = inverse.filter(|inverse| !is_separated(&design.x, events, &at, inverse));
    let inverse = inverse.ok_or(FitStatus::Separated)?;
    if !converged {
        return Err(FitStatus::NotConverged);
    }
    let fit = Fit::new(design.to_given(&at, &inverse), f64::INFINITY);
    let log_likelihood = log_likelihood(&design.x, events, &at);
    Ok(ProbitFit { fit, log_likelihood, largest_difference: None, status: FitStatus::Ok })
}

/// Whether events and other cases do not overlap in z, or the standard error of some z is so large that the
/// likelihood has no maximum.
fn is_separated(x: &DMatrix<f64>, events: &[bool], b: &DVector<f64>, covariance: &DMatrix<f64>) -> bool {
    let z = x * b;
    // Least and largest z of other cases, and of events.
    let mut ends = [(f64::INFINITY, f64::NEG_INFINITY); 2];
    for (&z, &event) in z.iter().zip(events) {
        let (least, largest) = &mut ends[usize::from(event)];
        (*least, *largest) = (least.min(z), largest.max(z));
    }
    // They may touch. Where z is the same for all cases, it separates nothing.
    let [(least_other, largest_other), (least_event, largest_event)] = ends;
    let do_not_overlap = largest_other <= least_event && least_other < largest_event;
    let largest_variance = (x * covariance).component_mul(x).column_sum().max();
    do_not_overlap || largest_variance > SEPARATION_SE * SEPARATION_SE
}

/// Fits as [`probit`], adds the clustered covariance, and compares the probability with the share of events.
/// `clusters` has the cluster of each case.
pub fn clustered_probit(x: &[&[f64]], events: &[bool], clusters: &[u32]) -> Result<ProbitFit, FitStatus> {
    let mut probit = probit(x, events)?;
    let z = predict(probit.fit.coefficients.as_slice(), x);
    let signs = events.iter().map(|&event| if event { 1.0 } else { -1.0 });
    let scores: Vec<f64> =
        z.iter().zip(signs).map(|(&z, sign)| sign * normal::ln_cdf_and_slope(sign * z).1).collect();
    let probabilities: Vec<f64> = z.into_iter().map(normal::cdf).collect();
    probit.largest_difference = largest_difference(&probabilities, events);
    let count = events.iter().filter(|event| **event).count();
    probit.status = match count.min(events.len() - count) {
        0..FEW_EVENTS => FitStatus::FewEvents,
        _ => FitStatus::by_difference(probit.largest_difference),
    };
    probit.fit.note_clusters(sandwich(x, &scores, &probit.fit.covariance, clusters));
    Ok(probit)
}
