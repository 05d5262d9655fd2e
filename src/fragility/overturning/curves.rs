//! P_ro: the probability of overturning given rocking, as a lognormal curve (Eqs. 19-24).

use crate::fragility::overturning::parameter::CurveParameter;
use crate::fragility::overturning::sample::EventSample;
use crate::normal;
use crate::statistics::FitStatus;
use crate::statistics::binary::{BinaryFit, Estimator, binary_regression};
use crate::statistics::design::{Dependence, dependence, natural_spline};
use crate::statistics::estimate::Estimate;
use crate::statistics::goodness::{Test, auc, brier_score, hosmer_lemeshow};
use crate::statistics::link::Link;
use crate::statistics::separation::is_separated;

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
    /// Area under the receiver operating characteristic.
    pub auc: f64,
    /// Brier score.
    pub brier: f64,
    /// Hosmer and Lemeshow's test of the probabilities, where there are cases enough.
    pub hosmer_lemeshow: Option<Test>,
    /// Least and largest index of the cases.
    pub index_range: [f64; 2],
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
        let [least, largest] = self.index_range;
        (self.beta.value * least.max(-largest)).exp().max(1.0)
    }
}

/// Fits the curve of one measure, or of the hybrid of two, by maximum likelihood (Eqs. 19 and 22).
///
/// # Errors
/// With the status that says why there is no curve: too few events, measures that do not vary, separation, no convergence.
pub fn fit_overturning(sample: &EventSample, model: &CurveModel) -> Result<OverturningFit, FitStatus> {
    let (n, events) = (sample.happened.len(), sample.events());
    let least = if model.estimator == Estimator::Firth { 1 } else { LEAST_EVENTS };
    if events < least || n - events < least {
        return Err(FitStatus::TooFewEvents);
    }
    let predictors = sample.predictors();
    match dependence(&predictors) {
        Some(Dependence::Constant) => return Err(FitStatus::Constant),
        Some(Dependence::Collinear) => return Err(FitStatus::Collinear),
        None => {}
    }
    if model.estimator == Estimator::Ml && is_separated(&predictors, &sample.happened) {
        return Err(FitStatus::Separated);
    }
    let regression = binary_regression(&predictors, &sample.happened, model.link, model.estimator)
        .map_err(|_| FitStatus::NotConverged)?;
    let scores = regression.indices(&sample.design());
    let probabilities: Vec<f64> = scores.iter().map(|&score| model.link.probability(score)).collect();
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
        bic: parameters * (n as f64).ln() - 2.0 * log_likelihood,
        auc: auc(&scores, &sample.happened),
        brier: brier_score(&probabilities, &sample.happened),
        hosmer_lemeshow: hosmer_lemeshow(&probabilities, &sample.happened),
        index_range: [
            scores.iter().copied().fold(f64::INFINITY, f64::min),
            scores.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        ],
        n,
        events,
        regression,
    })
}

/// The index bends with the first measure, as a natural cubic spline of its logarithm.
///
/// # Errors
/// With the status that says why there is none.
pub fn fit_with_spline(sample: &EventSample, model: &CurveModel) -> Result<BinaryFit, FitStatus> {
    fit_with(sample, &natural_spline(sample.predictors()[0]), model)
}

/// The slope on one measure depends on the other: a product of their logarithms; of a single measure its square.
///
/// # Errors
/// With the status that says why there is none.
pub fn fit_with_interaction(sample: &EventSample, model: &CurveModel) -> Result<BinaryFit, FitStatus> {
    let predictors = sample.predictors();
    let pairs = predictors[0].iter().zip(predictors[predictors.len() - 1]);
    fit_with(sample, &[pairs.map(|(x, y)| x * y).collect()], model)
}

fn fit_with(sample: &EventSample, terms: &[Vec<f64>], model: &CurveModel) -> Result<BinaryFit, FitStatus> {
    let predictors: Vec<&[f64]> =
        sample.predictors().into_iter().chain(terms.iter().map(Vec::as_slice)).collect();
    if dependence(&predictors).is_some() {
        return Err(FitStatus::Collinear);
    }
    binary_regression(&predictors, &sample.happened, model.link, model.estimator)
        .map_err(|_| FitStatus::NotConverged)
}
