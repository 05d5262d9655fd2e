//! P_ro: the probability of overturning given rocking, as a lognormal curve (Eqs. 19-24).

use crate::fragility::overturning::parameter::CurveParameter;
use crate::fragility::sample::Sample;
use crate::normal;
use crate::statistics::FitStatus;
use crate::statistics::binary::{BinaryFit, Estimator, regress};
use crate::statistics::design::{Dependence, Further, Moments, Spline};
use crate::statistics::estimate::Estimate;
use crate::statistics::goodness::Goodness;
use crate::statistics::link::Link;
use crate::statistics::separation::is_separable;

/// A curve from fewer events, or non-events, would be an opinion; Firth's needs one, and says in its limits how little it
/// knows.
pub const LEAST_EVENTS: usize = 5;

/// With fewer events, or non-events, for each coefficient, limits by the standard errors of lambda, mu and beta are too narrow, and so
/// are those of small probabilities by resamples; those by the profile likelihood, and of probabilities by the delta method, are not
/// (`tests/fits/coverage.rs`).
const EVENTS_A_COEFFICIENT: usize = 10;

/// Whether so few of `n` cases are events, or are not, that some limits of a curve of so many measures are too narrow.
pub fn has_few_events(events: usize, n: usize, measures: usize) -> bool {
    events.min(n - events) < EVENTS_A_COEFFICIENT * (1 + measures)
}

/// How a curve is fitted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CurveModel {
    /// How the index becomes a probability.
    pub link: Link,
    /// What is maximised.
    pub estimator: Estimator,
    /// Probability with which the limits hold the truth.
    pub confidence: f64,
}

impl Default for CurveModel {
    fn default() -> CurveModel {
        CurveModel { link: Link::Probit, estimator: Estimator::Ml, confidence: 0.95 }
    }
}

/// A median that lies outside of the data by a larger factor than this says little.
const FAR: f64 = 3.0;

/// A fitted fragility curve: Phi((ln IM - mu) / beta), or with another link as [`CurveParameter`] says. Errors by the
/// delta method, limits by the normal distribution.
#[derive(Debug, Clone, PartialEq)]
pub struct OverturningFit {
    /// The regression behind it.
    pub regression: BinaryFit,
    /// Exponent of the first measure; of two only.
    pub lambda: Option<Estimate>,
    /// ln of the median.
    pub mu: Estimate,
    /// Dispersion.
    pub beta: Estimate,
    /// Median exp(mu); its limits are those of mu.
    pub theta: Estimate,
    /// Akaike's criterion.
    pub aic: f64,
    /// Bayesian criterion.
    pub bic: f64,
    /// How it does on its cases.
    pub goodness: Goodness,
    /// Cases used.
    pub n: usize,
    /// Those in which the event happened.
    pub events: usize,
}

impl OverturningFit {
    /// Whether the probability grows with the measure, and its median lies among the data or not far from them.
    pub fn status(&self) -> FitStatus {
        match self.beta.value {
            beta if beta <= 0.0 => FitStatus::Falling,
            _ if self.factor_of_median() > FAR => FitStatus::FarMedian,
            _ => FitStatus::Ok,
        }
    }

    /// By which factor of the measure the median lies outside of the data; 1 inside.
    pub fn factor_of_median(&self) -> f64 {
        let [least, largest] = self.goodness.index_range;
        libm::exp(self.beta.value * least.max(-largest)).max(1.0)
    }
}

/// Fits the curve of one measure, or of the hybrid of two, by maximum likelihood (Eqs. 19 and 22).
///
/// # Errors
/// With the status that says why there is no curve: too few events, measures that do not vary, separation, no convergence.
pub fn fit_overturning(sample: &Sample, model: &CurveModel) -> Result<OverturningFit, FitStatus> {
    let (n, events, design) = (sample.cases(), sample.events(), sample.design());
    let least = if model.estimator == Estimator::Firth { 1 } else { LEAST_EVENTS };
    if events < least || n - events < least {
        return Err(FitStatus::TooFewEvents);
    }
    match Moments::of(&design).dependence() {
        Some(Dependence::Constant) => return Err(FitStatus::Constant),
        Some(Dependence::Collinear) => return Err(FitStatus::Collinear),
        None => {}
    }
    if model.estimator == Estimator::Ml && is_separable(&design) {
        return Err(FitStatus::Separated);
    }
    let regression = regress(design, model.link, model.estimator).map_err(|_| FitStatus::NotConverged)?;
    let goodness = Goodness::of(&design, &regression);
    let log_likelihood = regression.log_likelihood;
    let b = &regression.coefficients;
    let quantile = normal::quantile(0.5 * (1.0 + model.confidence));
    let estimate = |parameter: CurveParameter| {
        let error = parameter.standard_error(model.link, b, &regression.covariance);
        Estimate::symmetric(parameter.value(model.link, b), error, quantile)
    };
    let (parameters, mu) = (b.len() as f64, estimate(CurveParameter::Mu));
    Ok(OverturningFit {
        lambda: (b.len() == 3).then(|| estimate(CurveParameter::Lambda)),
        mu,
        beta: estimate(CurveParameter::Beta),
        theta: mu.exp(),
        aic: 2.0 * parameters - 2.0 * log_likelihood,
        bic: parameters * libm::log(n as f64) - 2.0 * log_likelihood,
        goodness,
        n,
        events,
        regression,
    })
}

/// The index bends with the first measure, as a natural cubic spline of its logarithm.
///
/// # Errors
/// With the status that says why there is none.
pub fn fit_with_spline(sample: &Sample, model: &CurveModel) -> Result<BinaryFit, FitStatus> {
    let spline = Spline::of(&sample.design());
    fit_with(sample, 2, &|x| spline.columns(x[0]), model)
}

/// The slope on one measure depends on the other: a product of their logarithms; of a single measure its square.
///
/// # Errors
/// With the status that says why there is none.
pub fn fit_with_interaction(sample: &Sample, model: &CurveModel) -> Result<BinaryFit, FitStatus> {
    let product = |x: &[&[f64]]| x[0].iter().zip(x[x.len() - 1]).map(|(x, y)| x * y).collect();
    fit_with(sample, 1, &|x| vec![product(x)], model)
}

fn fit_with(
    sample: &Sample,
    count: usize,
    terms: Further,
    model: &CurveModel,
) -> Result<BinaryFit, FitStatus> {
    let design = sample.design().with(count, terms);
    if Moments::of(&design).dependence().is_some() {
        return Err(FitStatus::Collinear);
    }
    regress(design, model.link, model.estimator).map_err(|_| FitStatus::NotConverged)
}
