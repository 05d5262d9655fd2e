//! The lognormal distribution of capacities, some of which are only known to lie above or below an intensity.

use nalgebra::{DMatrix, DVector};

use super::probability::Z_95;
use super::slice::Lognormal;
use crate::normal::{inverse_mills, ln_cdf};
use crate::statistics::FitStatus;
use crate::statistics::distribution::{chi_squared_quantile, t_quantile};
use crate::statistics::estimate::Limits;
use crate::statistics::newton::{Along, Objective, maximise};

/// What is known of a capacity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum KnownCapacity {
    /// It is this.
    At(f64),
    /// It is less.
    Below(f64),
    /// It is more.
    Above(f64),
}

/// A lognormal distribution of capacities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CapacityFit {
    /// Median and dispersion.
    pub lognormal: Lognormal,
    /// 95 % limits of the median.
    pub theta_limits: Limits,
    /// 95 % limits of the dispersion.
    pub beta_limits: Limits,
}

/// The upper level of 95 % limits.
const UPPER_95: f64 = 0.975;
/// The gain at which the search ends.
const TOLERANCE: f64 = 1e-14;

/// The lognormal distribution of capacities. Where each is known, that of mean and standard deviation of their logarithms (divisor n - 1),
/// with the exact limits of a normal sample, by Student's t and chi squared. Else that of maximum likelihood; capacities above or below an intensity count with the probability of that
/// (Baker 2015, Efficient analytical fragility function fitting using dynamic structural analysis, Earthquake Spectra 31,
/// 579-599, Eqs. 1-7), and limits are those of the information in the logarithms of both parameters, which are too narrow for few.
///
/// # Errors
/// The status, if fewer than two capacities are known, or all are the same.
pub fn fit_capacities(capacities: &[KnownCapacity]) -> Result<CapacityFit, FitStatus> {
    let known: Vec<f64> = capacities.iter().filter_map(KnownCapacity::exact).map(libm::log).collect();
    if known.len() < 2 {
        return Err(FitStatus::TooFewEvents);
    }
    let middle = known.iter().sum::<f64>() / known.len() as f64;
    let squares: f64 = known.iter().map(|x| (x - middle).powi(2)).sum();
    let variance = squares / known.len() as f64;
    if variance <= 1e-24 {
        return Err(FitStatus::Constant);
    }
    if known.len() == capacities.len() {
        return Ok(of_sample(known.len(), middle, squares));
    }
    let start = DVector::from_vec(vec![1.0 / variance.sqrt(), 0.0]);
    let likelihood = |at: &DVector<f64>| log_likelihood(capacities, middle, at);
    let maximum = maximise(likelihood, &start, Along::All, TOLERANCE).ok_or(FitStatus::NotConverged)?;
    let (per_beta, shift) = (maximum.at[0], maximum.at[1]);
    let covariance = likelihood(&maximum.at).information.try_inverse().ok_or(FitStatus::NotConverged)?;
    let of_mu = DVector::from_vec(vec![-shift / (per_beta * per_beta), 1.0 / per_beta]);
    let se_ln_theta = (&covariance * &of_mu).dot(&of_mu).sqrt();
    let se_ln_beta = covariance[(0, 0)].sqrt() / per_beta;
    let lognormal = Lognormal { theta: libm::exp(middle + shift / per_beta), beta: 1.0 / per_beta };
    let limits = |value: f64, se_ln: f64| Limits {
        low: value * libm::exp(-Z_95 * se_ln),
        high: value * libm::exp(Z_95 * se_ln),
    };
    Ok(CapacityFit {
        lognormal,
        theta_limits: limits(lognormal.theta, se_ln_theta),
        beta_limits: limits(lognormal.beta, se_ln_beta),
    })
}

/// The distribution of a sample of n capacities whose logarithms have this mean and sum of squared deviations.
fn of_sample(n: usize, mean: f64, squares: f64) -> CapacityFit {
    let degrees = n - 1;
    let beta = (squares / degrees as f64).sqrt();
    let half_width = t_quantile(UPPER_95, degrees as f64) * beta / (n as f64).sqrt();
    let beta_at = |level| (squares / chi_squared_quantile(level, degrees)).sqrt();
    CapacityFit {
        lognormal: Lognormal { theta: libm::exp(mean), beta },
        theta_limits: Limits { low: libm::exp(mean - half_width), high: libm::exp(mean + half_width) },
        beta_limits: Limits { low: beta_at(UPPER_95), high: beta_at(1.0 - UPPER_95) },
    }
}

/// In 1/beta and (mu - middle)/beta, in which it is concave (Olsen 1978, Note on the uniqueness of the maximum likelihood
/// estimator for the Tobit model, Econometrica 46, 1211-1215).
fn log_likelihood(capacities: &[KnownCapacity], middle: f64, at: &DVector<f64>) -> Objective {
    let (per_beta, shift) = (at[0], at[1]);
    let mut value = 0.0;
    let mut gradient = DVector::zeros(2);
    let mut information = DMatrix::zeros(2, 2);
    for capacity in capacities {
        let (x, censored) = match capacity {
            KnownCapacity::At(x) => (x, None),
            KnownCapacity::Below(x) => (x, Some(1.0)),
            KnownCapacity::Above(x) => (x, Some(-1.0)),
        };
        let x = libm::log(*x) - middle;
        let index = per_beta * x - shift;
        let slope = DVector::from_vec(vec![x, -1.0]);
        let weight = match censored {
            None => {
                value += libm::log(per_beta) - 0.5 * index * index;
                gradient[0] += 1.0 / per_beta;
                information[(0, 0)] += 1.0 / (per_beta * per_beta);
                gradient -= &slope * index;
                1.0
            }
            Some(sign) => {
                let mills = inverse_mills(sign * index);
                value += ln_cdf(sign * index);
                gradient += &slope * (sign * mills);
                mills * (mills + sign * index)
            }
        };
        information += &slope * slope.transpose() * weight;
    }
    // Below zero there is no dispersion.
    let value = if per_beta > 0.0 { value } else { f64::NEG_INFINITY };
    Objective { value, gradient, information }
}

impl KnownCapacity {
    fn exact(&self) -> Option<f64> {
        match self {
            KnownCapacity::At(x) => Some(*x),
            KnownCapacity::Below(_) | KnownCapacity::Above(_) => None,
        }
    }
}
