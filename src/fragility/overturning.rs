//! P_ro: the probability of overturning given rocking, as a lognormal curve (Eqs. 19-24).

use std::array::from_fn;

use nalgebra::DVector;

use super::FitStatus;
use super::case::{Case, Measure};
use super::probit::{ProbitFit, probit};
use super::regression::{Estimate, range};
use super::separation::is_separated;
use super::skill::{auc, brier_score};
use crate::normal;

/// Standard errors to a 95 % limit of confidence.
pub const Z_95: f64 = 1.959_963_984_540_054;

/// A curve from fewer events, or non-events, would be an opinion.
const LEAST_EVENTS: usize = 5;

/// A fitted fragility curve Phi((ln IM - mu) / beta).
///
/// Of two measures IM is the hybrid IMx^(lambda/(1 + lambda)) IMy^(1/(1 + lambda)) (Eq. 22), so that with the probit
/// index b0 + b1 ln IMx + b2 ln IMy: lambda = b1/b2, beta = 1/(b1 + b2), mu = -b0/(b1 + b2).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OverturningFit {
    /// Exponent of the first measure; of two only.
    pub lambda: Option<Estimate>,
    /// Mean of ln IM at overturning.
    pub mu: Estimate,
    /// Dispersion.
    pub beta: Estimate,
    /// Median exp(mu); its limits are those of mu.
    pub theta: Estimate,
    /// At the maximum.
    pub log_likelihood: f64,
    /// Akaike's criterion.
    pub aic: f64,
    /// Bayesian criterion.
    pub bic: f64,
    /// Area under the receiver operating characteristic.
    pub auc: f64,
    /// Brier score.
    pub brier: f64,
    /// Cases used.
    pub n: usize,
    /// Those in which the event happened.
    pub events: usize,
    /// Covariance of the probit coefficients b0, b1, b2; of one measure without the last row and column, which are 0.
    pub covariance: [[f64; 3]; 3],
    /// Least and largest ln IM of each measure; of one measure the second is 0.
    pub ranges: [[f64; 2]; 2],
}

/// The cases of a fit: logarithms of their measures, and whether the event happened.
pub struct EventSample {
    ln_im: Vec<Vec<f64>>,
    /// In each case.
    pub happened: Vec<bool>,
}

impl EventSample {
    /// Of the cases that have all the measures; `event` says whether it happened, or that the case does not count.
    pub fn new(cases: &[Case], measures: &[Measure], event: impl Fn(&Case) -> Option<bool>) -> EventSample {
        let mut sample = EventSample { ln_im: vec![Vec::new(); measures.len()], happened: Vec::new() };
        for case in cases {
            let values = measures.iter().map(|measure| measure.of(case)).collect::<Option<Vec<f64>>>();
            if let (Some(values), Some(happened)) = (values, event(case)) {
                sample.happened.push(happened);
                for (column, value) in sample.ln_im.iter_mut().zip(values) {
                    column.push(value.ln());
                }
            }
        }
        sample
    }

    /// In how many cases the event happened.
    pub fn events(&self) -> usize {
        self.happened.iter().filter(|&&happened| happened).count()
    }
}

/// Fits the curve of one measure, or of the hybrid of two, by maximum likelihood (Eq. 20).
///
/// # Errors
/// With the status that says why there is no curve: too few events, separation, no convergence.
pub fn fit_overturning(sample: &EventSample) -> Result<OverturningFit, FitStatus> {
    let (n, events) = (sample.happened.len(), sample.events());
    if events < LEAST_EVENTS || n - events < LEAST_EVENTS {
        return Err(FitStatus::TooFewEvents);
    }
    let predictors: Vec<&[f64]> = sample.ln_im.iter().map(Vec::as_slice).collect();
    if is_separated(&predictors, &sample.happened) {
        return Err(FitStatus::Separated);
    }
    let fit = probit(&predictors, &sample.happened).map_err(|_| FitStatus::NotConverged)?;
    let index = |row: usize| {
        let slopes = fit.coefficients.iter().skip(1).zip(&predictors);
        fit.coefficients[0] + slopes.map(|(b, x)| b * x[row]).sum::<f64>()
    };
    let scores: Vec<f64> = (0..n).map(index).collect();
    let probabilities: Vec<f64> = scores.iter().map(|&z| normal::cdf(z)).collect();
    let parameters = fit.coefficients.len() as f64;
    let Curve { lambda, mu, beta } = Curve::of(&fit);
    let covariance = |i: usize, j: usize| *fit.covariance.get((i, j)).unwrap_or(&0.0);
    Ok(OverturningFit {
        lambda,
        mu,
        beta,
        theta: Estimate {
            value: mu.value.exp(),
            standard_error: mu.value.exp() * mu.standard_error,
            low: mu.low.exp(),
            high: mu.high.exp(),
        },
        log_likelihood: fit.log_likelihood,
        aic: 2.0 * parameters - 2.0 * fit.log_likelihood,
        bic: parameters * (n as f64).ln() - 2.0 * fit.log_likelihood,
        auc: auc(&scores, &sample.happened),
        brier: brier_score(&probabilities, &sample.happened),
        n,
        events,
        covariance: from_fn(|i| from_fn(|j| covariance(i, j))),
        ranges: from_fn(|k| predictors.get(k).map_or([0.0; 2], |values| range(values))),
    })
}

struct Curve {
    lambda: Option<Estimate>,
    mu: Estimate,
    beta: Estimate,
}

impl Curve {
    /// From the coefficients of the probit; standard errors by the delta method.
    fn of(fit: &ProbitFit) -> Curve {
        let b = &fit.coefficients;
        let slope: f64 = b.iter().skip(1).sum();
        let estimate = |value: f64, gradient: Vec<f64>| {
            let gradient = DVector::from_vec(gradient);
            let variance = (gradient.transpose() * &fit.covariance * &gradient)[(0, 0)];
            Estimate::symmetric(value, variance.sqrt(), Z_95)
        };
        let slopes = b.len() - 1;
        let mu_gradient = [vec![-1.0 / slope], vec![b[0] / (slope * slope); slopes]].concat();
        let beta_gradient = [vec![0.0], vec![-1.0 / (slope * slope); slopes]].concat();
        let lambda =
            (slopes == 2).then(|| estimate(b[1] / b[2], vec![0.0, 1.0 / b[2], -b[1] / (b[2] * b[2])]));
        Curve { lambda, mu: estimate(-b[0] / slope, mu_gradient), beta: estimate(1.0 / slope, beta_gradient) }
    }
}
