//! Fitted curves of overturning, seen over one measure and scored on other cases.

use crate::fragility::{Cases, CurveFit, Event, Measure, hybrid_measure, lambda};
use crate::motion::IntensityMeasures;
use crate::statistics::scores::log_score;

/// A probability counts as no nearer to 0 or 1 than this where its logarithm is needed.
const LEAST: f64 = 1e-12;
/// Of the limits, which are not used.
const CONFIDENCE: f64 = 0.95;

/// Computes the measure of a curve, or the hybrid of its two (Eq. 23); none where one is missing.
pub fn measure_of(fit: &CurveFit, measures: &IntensityMeasures) -> Option<f64> {
    let x = fit.im_x.value_of(measures)?;
    let Some(im_y) = fit.im_y else { return Some(x) };
    Some(hybrid_measure(x, im_y.value_of(measures)?, lambda(&fit.coefficients).0))
}

/// Computes the measures of a motion of this IM3 at which the measure of a curve of IM4, IM5 or the hybrid of
/// IM4 and 1/IM3 has a value: the inverse of [`measure_of`].
pub fn motion_at(fit: &CurveFit, value: f64, im3: f64) -> IntensityMeasures {
    let im4 = match (fit.im_x, &fit.coefficients[..]) {
        (_, [_, b1, b2]) => (((b1 + b2) * value.ln() + b2 * im3.ln()) / b1).exp(),
        (Measure::Im5, _) => value * im3,
        _ => value,
    };
    IntensityMeasures::of_peaks(im4, im4 / im3)
}

/// Computes the mean log score of a curve of overturning on the cases of any structure that rocked.
pub fn log_score_on(fit: &CurveFit, cases: &Cases) -> f64 {
    let scored = |case: usize| {
        let happened = cases.happened(case, Event::Overturning, f64::INFINITY)?;
        let p = fit.probability(&cases.measures(case), CONFIDENCE)?.value;
        Some((p.clamp(LEAST, 1.0 - LEAST), happened))
    };
    let (p, events): (Vec<f64>, Vec<bool>) = (0..cases.len()).filter_map(scored).unzip();
    log_score(&p, &events)
}
