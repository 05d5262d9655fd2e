//! The lognormal distribution of the capacities of an incremental dynamic analysis, some of which are only
//! known to lie above or below an intensity.

use std::collections::BTreeSet;

use nalgebra::DVector;

use crate::statistics::clusters::clustered_error_of_mean;
use crate::statistics::distributions::{chi_squared_quantile, t_quantile};
use crate::statistics::newton::{Objective, maximise};
use crate::statistics::normal::ln_cdf_and_slope;
use crate::statistics::{FitStatus, Interval};

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum KnownCapacity {
    At(f64),
    Below(f64),
    Above(f64),
}

/// Median theta, in the unit of the capacities, and dispersion beta, lognormal, with 95 % limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CapacityFit {
    pub theta: Interval,
    pub beta: Interval,
}

/// Exact capacities alone are fitted by mean and standard deviation of their logarithms (divisor n - 1), with
/// the exact limits of a normal sample. Others are fitted by maximum likelihood (Baker 2015, Efficient
/// analytical fragility function fitting using dynamic structural analysis, Earthquake Spectra 31, 579-599),
/// with limits from the information in ln theta and ln beta, and t quantiles by the number of exact ones.
/// Motions of one cluster (`clusters`, one number per capacity) may depend on each other: limits widen by the
/// ratio of the clustered to the unclustered standard error of the mean, each times its t quantile.
///
/// # Errors
/// The status, if fewer than two capacities are known, or all are the same.
pub fn fit_capacities(capacities: &[KnownCapacity], clusters: &[u32]) -> Result<CapacityFit, FitStatus> {
    let known = capacities.iter().zip(clusters).filter_map(|(capacity, &cluster)| match capacity {
        KnownCapacity::At(x) => Some((x.ln(), cluster)),
        _ => None,
    });
    let (ln_x, clusters): (Vec<f64>, Vec<u32>) = known.unzip();
    let fit = fit_independent(capacities, &ln_x)?;
    let alone: Vec<u32> = (0..ln_x.len() as u32).collect();
    let half_width = |clusters: &[u32]| {
        let distinct = clusters.iter().collect::<BTreeSet<&u32>>().len();
        clustered_error_of_mean(&ln_x, clusters) * t_quantile(0.975, distinct as f64 - 1.0)
    };
    let wider = (half_width(&clusters) / half_width(&alone)).max(1.0);
    // The responses to one earthquake say nothing about others.
    let wider = if wider.is_finite() { wider } else { 1.0 };
    let [theta, beta] = [fit.theta, fit.beta]
        .map(|estimate| estimate.map(|x| estimate.value * (x / estimate.value).powf(wider)));
    Ok(CapacityFit { theta, beta })
}

/// For capacities that do not depend on each other; `known` are the logarithms of the exact ones.
fn fit_independent(capacities: &[KnownCapacity], known: &[f64]) -> Result<CapacityFit, FitStatus> {
    if known.len() < 2 {
        return Err(FitStatus::TooFewEvents);
    }
    let n = known.len() as f64;
    let mean = known.iter().sum::<f64>() / n;
    let squares: f64 = known.iter().map(|x| (x - mean).powi(2)).sum();
    if squares / n <= 1e-24 {
        return Err(FitStatus::Degenerate);
    }
    if known.len() < capacities.len() {
        return censored(capacities, mean, (squares / n).sqrt(), t_quantile(0.975, n - 1.0));
    }
    let beta = (squares / (n - 1.0)).sqrt();
    let half_width = t_quantile(0.975, n - 1.0) * beta / n.sqrt();
    let [low, high] = [0.975, 0.025].map(|share| (squares / chi_squared_quantile(share, n - 1.0)).sqrt());
    let theta = Interval::around(mean, half_width).map(f64::exp);
    Ok(CapacityFit { theta, beta: Interval { value: beta, low, high } })
}

/// Maximises the likelihood in 1/beta and (mu - mean)/beta, in which its logarithm is concave (Olsen 1978,
/// Note on the uniqueness of the maximum likelihood estimator for the Tobit model, Econometrica 46,
/// 1211-1215).
fn censored(
    capacities: &[KnownCapacity],
    mean: f64,
    sd: f64,
    quantile: f64,
) -> Result<CapacityFit, FitStatus> {
    let likelihood = |at: &DVector<f64>| {
        let per_beta = at[0];
        let mut likelihood = Objective::sum(capacities.len(), 2, |case, sum| {
            let (x, sign) = match capacities[case] {
                KnownCapacity::At(x) => (x, 0.0),
                KnownCapacity::Below(x) => (x, 1.0),
                KnownCapacity::Above(x) => (x, -1.0),
            };
            let slope = DVector::from_column_slice(&[x.ln() - mean, -1.0]);
            let z = slope.dot(at);
            let curvature = if sign == 0.0 {
                sum.value += per_beta.ln() - 0.5 * z * z;
                sum.gradient += DVector::from_column_slice(&[1.0 / per_beta, 0.0]) - &slope * z;
                sum.information[(0, 0)] += 1.0 / (per_beta * per_beta);
                1.0
            } else {
                let (ln_p, mills) = ln_cdf_and_slope(sign * z);
                sum.value += ln_p;
                sum.gradient += &slope * (sign * mills);
                mills * (mills + sign * z)
            };
            sum.information += &slope * slope.transpose() * curvature;
        });
        // Below zero there is no dispersion.
        if per_beta <= 0.0 {
            likelihood.value = f64::NEG_INFINITY;
        }
        likelihood
    };
    let maximum = maximise(likelihood, DVector::from_column_slice(&[1.0 / sd, 0.0]));
    let covariance = maximum.objective.information.try_inverse().filter(|_| maximum.converged);
    let covariance = covariance.ok_or(FitStatus::NotConverged)?;
    let (per_beta, shift) = (maximum.at[0], maximum.at[1]);
    let by_mu = DVector::from_column_slice(&[-shift / (per_beta * per_beta), 1.0 / per_beta]);
    let theta_factor = (quantile * (&covariance * &by_mu).dot(&by_mu).sqrt()).exp();
    let beta_factor = (quantile * covariance[(0, 0)].sqrt() / per_beta).exp();
    let (theta, beta) = ((mean + shift / per_beta).exp(), 1.0 / per_beta);
    Ok(CapacityFit {
        theta: Interval { value: theta, low: theta / theta_factor, high: theta * theta_factor },
        beta: Interval { value: beta, low: beta / beta_factor, high: beta * beta_factor },
    })
}
