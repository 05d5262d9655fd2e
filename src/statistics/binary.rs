//! Probit regression of events by maximum likelihood.

use nalgebra::{DMatrix, DVector};

use super::design::{Design, with_squares};
use super::distributions::chi_squared_upper_tail;
use super::fit::{Fit, FitStatus, predict};
use super::newton::{Maximum, Objective, maximise};
use super::normal;

/// A curve from fewer events, or fewer others, would be an opinion.
pub const LEAST_EVENTS: usize = 5;
/// A standard error of z beyond this belongs to a likelihood that rises without end.
const ENDLESS: f64 = 1e3;

/// A probit regression P(event) = Phi(z), z = b0 + b1 x1 + ...
#[derive(Debug, Clone, PartialEq)]
pub struct ProbitFit {
    pub fit: Fit,
    pub log_likelihood: f64,
    /// Cases in which the event happened.
    pub events: usize,
}

impl ProbitFit {
    /// Akaike's criterion.
    pub fn aic(&self) -> f64 {
        2.0 * self.fit.coefficients.len() as f64 - 2.0 * self.log_likelihood
    }

    /// Bayesian criterion.
    pub fn bic(&self) -> f64 {
        self.fit.coefficients.len() as f64 * (self.fit.n as f64).ln() - 2.0 * self.log_likelihood
    }
}

/// Computes the log-likelihood (Eq. 21): the sum of ln Phi(z) where the structure overturned and of ln(1 -
/// Phi(z)) where it did not, z = X b being (ln IM - mu) / beta (Eqs. 20 and 24).
pub fn log_likelihood(x: &DMatrix<f64>, overturned: &[bool], b: &DVector<f64>) -> f64 {
    let z = x * b;
    let term = |(&z, &overturned): (&f64, &bool)| match overturned {
        true => normal::ln_cdf(z),
        false => normal::ln_cdf(-z),
    };
    z.iter().zip(overturned).map(term).sum()
}

/// Computes [`log_likelihood`] with its derivatives.
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

/// Finds the coefficients of greatest likelihood (Eq. 22).
fn maximum(x: &DMatrix<f64>, events: &[bool]) -> Maximum {
    let share = events.iter().filter(|event| **event).count() as f64 / events.len() as f64;
    let mut start = DVector::zeros(x.ncols());
    start[0] = normal::quantile(share);
    maximise(|b| derivatives(x, events, b), start)
}

/// Fits the probability of `events` on the columns of `x` by maximum likelihood.
///
/// # Errors
/// With the status that says why there is no fit.
pub fn probit(x: &[&[f64]], events: &[bool]) -> Result<ProbitFit, FitStatus> {
    let count = events.iter().filter(|event| **event).count();
    if count.min(events.len() - count) < LEAST_EVENTS {
        return Err(FitStatus::TooFewEvents);
    }
    let design = Design::new(x)?;
    let Maximum { at, objective, converged } = maximum(&design.x, events);
    let inverse = objective.information.cholesky().map(|factors| factors.inverse());
    let inverse = inverse.filter(|inverse| !is_separated(&design.x, events, &at, inverse));
    let inverse = inverse.ok_or(FitStatus::Separated)?;
    if !converged {
        return Err(FitStatus::NotConverged);
    }
    let (coefficients, covariance) = design.of_given(&at, &inverse);
    let fit = Fit {
        coefficients,
        covariance,
        clustered: None,
        clusters: 0,
        degrees: f64::INFINITY,
        n: events.len(),
        misfit_p: None,
        status: FitStatus::Ok,
    };
    Ok(ProbitFit { fit, log_likelihood: log_likelihood(&design.x, events, &at), events: count })
}

/// Whether events and others do not overlap in z, or z of some case is so unsure that the likelihood rises
/// without end.
fn is_separated(x: &DMatrix<f64>, events: &[bool], b: &DVector<f64>, covariance: &DMatrix<f64>) -> bool {
    let z = x * b;
    let of = |event: bool| z.iter().zip(events).filter(move |(_, of)| **of == event).map(|(z, _)| *z);
    let least = |event| of(event).fold(f64::INFINITY, f64::min);
    let largest = |event| of(event).fold(f64::NEG_INFINITY, f64::max);
    // They may touch; where z is the same for all, it parts nothing.
    let do_not_overlap = largest(false) <= least(true) && least(false) < largest(true);
    let largest_variance = (x * covariance).component_mul(x).column_sum().max();
    do_not_overlap || largest_variance > ENDLESS * ENDLESS
}

/// Fits as [`probit`], adds the clustered covariance, and tests the form: likelihood-ratio test of the
/// squares and products of the predictors.
///
/// # Errors
/// As [`probit`].
pub fn tested_probit(x: &[&[f64]], events: &[bool], clusters: &[u32]) -> Result<ProbitFit, FitStatus> {
    let mut probit = probit(x, events)?;
    let z = predict(probit.fit.coefficients.as_slice(), x);
    let score = |(&z, &event): (&f64, &bool)| {
        let sign = if event { 1.0 } else { -1.0 };
        sign * normal::ln_cdf_and_slope(sign * z).1
    };
    let scores: Vec<f64> = z.iter().zip(events).map(score).collect();
    let bread = probit.fit.covariance.clone();
    probit.fit.allow_for_clusters(x, &scores, &bread, clusters);
    probit.fit.note_misfit(misfit(&probit, x, events));
    Ok(probit)
}

/// Computes the probability of what squares and products add by chance; none where they do not vary on their
/// own.
fn misfit(probit: &ProbitFit, x: &[&[f64]], events: &[bool]) -> Option<f64> {
    let columns = with_squares(x)?;
    let wider = Design::new(&columns.iter().map(Vec::as_slice).collect::<Vec<_>>()).ok()?;
    // Where the wider curve separates the outcomes, its likelihood is larger still.
    let gained = maximum(&wider.x, events).objective.value - probit.log_likelihood;
    Some(chi_squared_upper_tail(2.0 * gained.max(0.0), (columns.len() - x.len()) as f64))
}
