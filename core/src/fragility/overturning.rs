//! P_ro: the probability of overturning given rocking, as a lognormal curve of one measure or of a hybrid of
//! two (section 2.3.3, Eqs. 19 to 24). The likelihood and its maximum are in `statistics::binary`.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::cases::{Cases, Event, Group, MeasureRanges};
use super::measure_names::{Measure, Predictors, design_row, values};
use super::parameter::{Parameter, ParameterRow, quantile};
use crate::motion::IntensityMeasures;
use crate::rocking::Structure;
use crate::statistics::scores::{auc, brier_score};
use crate::statistics::{FitStatus, Interval, held_out, independent_errors, normal};
use crate::statistics::{clustered_probit, delta_variance, predict, probit};

/// P_ro at the intensity `im`: Phi((ln IM - mu) / beta) (Eq. 20; Eq. 24 with the hybrid measure).
pub fn p_overturning(im: f64, mu: f64, beta: f64) -> f64 {
    normal::cdf((im.ln() - mu) / beta)
}

/// The hybrid measure IMx^(lambda/(1 + lambda)) IMy^(1/(1 + lambda)) (Eq. 23).
pub fn hybrid_measure(im_x: f64, im_y: f64, lambda: f64) -> f64 {
    im_x.powf(lambda / (1.0 + lambda)) * im_y.powf(1.0 / (1.0 + lambda))
}

/// Fits the curve of one measure, or of the hybrid of two, by maximum likelihood, to `Event::Overturning` or
/// `Event::Rocking`. The likelihood of overturning is the product over the cases that rocked of P_ro where
/// the structure overturned and 1 - P_ro where it did not (Eq. 19). Its logarithm ([`log_likelihood`], Eq.
/// 21) is concave in b0, b1 and b2 of (ln IM - mu) / beta = b0 + b1 ln IMx + b2 ln IMy; from its maximum (Eq.
/// 22) follow [`lambda`], [`mu`] and [`beta`].
///
/// # Panics
/// Of the other events, which need a limit state: a curve has none.
///
/// [`log_likelihood`]: crate::statistics::log_likelihood
pub fn fit_curve(cases: &Cases, event: Event, im_x: Measure, im_y: Option<Measure>) -> CurveFit {
    assert!(matches!(event, Event::Overturning | Event::Rocking), "{event} needs a limit state");
    let measures: Vec<Measure> = std::iter::once(&im_x).chain(&im_y).cloned().collect();
    let sample = cases.sample(&measures, |case| event.happened(case.outcome, f64::INFINITY));
    let tried = clustered_probit(&sample.x(), &sample.y, &sample.clusters);
    let fitted = tried.as_ref().ok();
    let limiting = fitted.map(|probit| probit.fit.limiting_covariance());
    let coefficients = fitted.map_or(Vec::new(), |probit| probit.fit.coefficients.as_slice().to_vec());
    let z = fitted.map_or(Vec::new(), |_| predict(&coefficients, &sample.x()));
    let probabilities: Vec<f64> = z.into_iter().map(normal::cdf).collect();
    let without = |x: &[Vec<f64>], events: &[bool]| Some((probit(x, events).ok()?.fit, ()));
    let held_out = fitted.and_then(|_| held_out(&sample.x(), &sample.y, &sample.clusters, without));
    let held_out: Option<Vec<f64>> = held_out.map(|cases| cases.into_iter().map(|(z, ())| z).collect());
    let falling = im_x.falling(im_y.as_ref());
    CurveFit {
        suite: cases.suite.clone(),
        structure: cases.structure.clone(),
        event,
        im_x,
        im_y,
        covariance: limiting.map_or(Vec::new(), |(covariance, _)| covariance.as_slice().to_vec()),
        is_clustered: fitted.is_some_and(|probit| probit.fit.clustered.is_some()),
        n_clusters: fitted.map_or(0, |probit| probit.fit.clusters as i64),
        degrees: limiting.map(|(_, degrees)| degrees).filter(|degrees| degrees.is_finite()),
        n: sample.y.len() as i64,
        n_events: sample.y.iter().filter(|happened| **happened).count() as i64,
        log_likelihood: fitted.map(|probit| probit.log_likelihood),
        auc: fitted.map(|_| auc(&probabilities, &sample.y)),
        brier: fitted.map(|_| brier_score(&probabilities, &sample.y)),
        held_out_log_score: held_out.as_ref().map(|z| {
            let scores =
                z.iter().zip(&sample.y).map(|(&z, &event)| normal::ln_cdf(if event { z } else { -z }));
            scores.sum::<f64>() / z.len() as f64
        }),
        calibration_slope: held_out.and_then(|z| Some(probit(&[z], &sample.y).ok()?.fit.coefficients[1])),
        ranges: sample.ranges(),
        largest_difference: fitted.and_then(|probit| probit.largest_difference),
        status: match &tried {
            Ok(_) if slope(&coefficients) <= 0.0 => falling,
            Ok(probit) => probit.status,
            Err(status) => *status,
        },
        coefficients,
    }
}

/// The slope of z on ln IM, b1 of one measure and b1 + b2 of a hybrid.
fn slope(b: &[f64]) -> f64 {
    b[1..].iter().sum()
}

/// A function of the coefficients b with its gradient by them, for the delta method.
#[derive(Debug, Clone, PartialEq)]
pub struct DeltaEstimate {
    pub value: f64,
    pub gradient: Vec<f64>,
}

/// The exponent of the first measure of a hybrid, b1/b2 (Eq. 23).
pub fn lambda(b: &[f64]) -> DeltaEstimate {
    DeltaEstimate { value: b[1] / b[2], gradient: vec![0.0, 1.0 / b[2], -b[1] / (b[2] * b[2])] }
}

/// The logarithm of the median, -b0/slope.
pub fn mu(b: &[f64]) -> DeltaEstimate {
    let slope = slope(b);
    let by_slopes = vec![b[0] / (slope * slope); b.len() - 1];
    DeltaEstimate { value: -b[0] / slope, gradient: [vec![-1.0 / slope], by_slopes].concat() }
}

/// The dispersion, 1/slope.
pub fn beta(b: &[f64]) -> DeltaEstimate {
    let slope = slope(b);
    let by_slopes = vec![-1.0 / (slope * slope); b.len() - 1];
    DeltaEstimate { value: 1.0 / slope, gradient: [vec![0.0], by_slopes].concat() }
}

/// Fits the curves of [`Event::Overturning`] or [`Event::Rocking`]: of IM4 and IM5 or, if `all`, of all six
/// measures of Eq. 13 and of both hybrids of Figure 12, then of what is `asked` for.
pub fn fit_curves(cases: &Cases, event: Event, asked: &[Predictors], all: bool) -> Vec<CurveFit> {
    let single = if all { Measure::SCALAR.to_vec() } else { vec![Measure::Im4, Measure::Im5] };
    let hybrids = [Measure::Im4, Measure::Im5].map(|im_x| Predictors::two([im_x, Measure::Im3Inverse]));
    let usual = single.into_iter().map(Predictors::one).chain(hybrids.into_iter().filter(|_| all));
    let predictors = Predictors::without_repeats(usual.collect(), asked);
    predictors.into_par_iter().map(|Predictors { im_x, im_y }| fit_curve(cases, event, im_x, im_y)).collect()
}

/// A fragility curve: a row of pro.parquet. What a [`DemandFit`](super::DemandFit) has too is as there.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CurveFit {
    pub suite: Option<String>,
    pub structure: Structure,
    pub event: Event,
    pub im_x: Measure,
    pub im_y: Option<Measure>,
    /// b0, b1 and, of a hybrid, b2; empty without a fit.
    pub coefficients: Vec<f64>,
    pub covariance: Vec<f64>,
    pub is_clustered: bool,
    pub n_clusters: i64,
    /// Degrees of freedom of limits, clusters - 1; `None` for normal ones.
    pub degrees: Option<f64>,
    pub n: i64,
    pub n_events: i64,
    pub log_likelihood: Option<f64>,
    /// Area under the receiver operating characteristic, on the fitted cases like the Brier score.
    pub auc: Option<f64>,
    pub brier: Option<f64>,
    pub held_out_log_score: Option<f64>,
    /// Slope of the probit of the events on z by a fit to the others: 1 is best, below it the curve is too
    /// steep (Cox 1958, Biometrika 45, 562-565).
    pub calibration_slope: Option<f64>,
    pub ranges: MeasureRanges,
    /// Largest difference of the probability from the share of events in bins of cases, beyond chance.
    pub largest_difference: Option<f64>,
    pub status: FitStatus,
}

impl CurveFit {
    pub fn group(&self) -> Group<'_> {
        Group::of(&self.suite, &self.structure.name)
    }

    pub fn predictors(&self) -> Predictors {
        Predictors { im_x: self.im_x.clone(), im_y: self.im_y.clone() }
    }

    /// The probability of the event (Eqs. 20 and 24), with limits by the delta method on the scale of ln IM -
    /// mu. None without a fit, or where a measure is missing.
    pub fn probability(&self, measures: &IntensityMeasures, confidence: f64) -> Option<Interval> {
        let ims = values(&self.im_x, self.im_y.as_ref(), measures)?;
        (!self.coefficients.is_empty()).then(|| self.probability_at(&ims, confidence))
    }

    /// The same at IMx and, of a hybrid, IMy.
    ///
    /// # Panics
    /// Without a fit.
    pub fn probability_at(&self, ims: &[f64], confidence: f64) -> Interval {
        let b = &self.coefficients;
        let (mu, beta) = (mu(b).value, beta(b).value);
        let error = beta.abs() * delta_variance(&self.covariance, &design_row(ims)).sqrt();
        let half_width = quantile(confidence, self.degrees) * error;
        let towards = beta.signum();
        let im = self.measure_at(ims);
        Interval::shifted(half_width, |shift| p_overturning(im, mu - towards * shift, beta))
    }

    /// The measure of the curve at IMx and, of a hybrid, IMy (Eq. 23).
    pub fn measure_at(&self, ims: &[f64]) -> f64 {
        match *ims {
            [im_x, im_y] => hybrid_measure(im_x, im_y, lambda(&self.coefficients).value),
            _ => ims[0],
        }
    }

    /// The curve with each independent error of its coefficients at the limits of confidence.
    pub(super) fn at_quantiles(&self, confidence: f64) -> Vec<[CurveFit; 2]> {
        let away = quantile(confidence, self.degrees);
        let errors = independent_errors(&self.coefficients, &self.covariance, away).into_iter();
        errors
            .map(|at_quantiles| at_quantiles.map(|coefficients| CurveFit { coefficients, ..self.clone() }))
            .collect()
    }

    pub fn covers(&self, measures: &IntensityMeasures) -> bool {
        let ranges = [(Some(&self.im_x), self.ranges.im_x), (self.im_y.as_ref(), self.ranges.im_y)];
        ranges.into_iter().all(|(measure, range)| {
            let value = measure.and_then(|measure| measure.value_of(measures));
            value.is_none_or(|value| range.has(value, 1.0))
        })
    }

    /// lambda (of a hybrid), mu, beta and theta, with errors by the delta method; none without a fit. beta of
    /// a falling curve is that over the inverse.
    pub fn parameters(&self, confidence: f64) -> Vec<ParameterRow> {
        if self.coefficients.is_empty() {
            return Vec::new();
        }
        let b = &self.coefficients;
        let hybrid = self.im_y.as_ref().map(|_| (Parameter::Lambda, lambda(b)));
        let estimates = hybrid.into_iter().chain([(Parameter::Mu, mu(b)), (Parameter::Beta, beta(b))]);
        let rows = estimates.map(|(parameter, DeltaEstimate { value, gradient })| {
            let value = if parameter == Parameter::Beta { value.abs() } else { value };
            let standard_error = delta_variance(&self.covariance, &gradient).sqrt();
            let half_width = quantile(confidence, self.degrees) * standard_error;
            ParameterRow {
                suite: self.suite.clone(),
                structure: self.structure.name.clone(),
                model: self.event.to_string(),
                im_x: self.im_x.clone(),
                im_y: self.im_y.clone(),
                range_low: None,
                parameter,
                value,
                standard_error,
                low: parameter.around(value, half_width).low,
                high: parameter.around(value, half_width).high,
                confidence,
                status: self.status,
            }
        });
        let mut rows: Vec<ParameterRow> = rows.collect();
        let theta = rows.iter().find(|row| row.parameter == Parameter::Mu).map(ParameterRow::exp);
        rows.extend(theta);
        rows
    }
}
