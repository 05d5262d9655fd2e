//! A curve fitted again to resampled cases, from where the fit itself ended.

use nalgebra::DVector;

use super::binary::{BinaryFit, BinaryLikelihood};
use super::bootstrap::Strata;
use super::curve_parameter::CurveParameter;
use super::design_matrix::DesignMatrix;
use super::event_sample::EventSample;
use super::influence::Influence;
use super::limits::acceleration;
use super::newton::{Along, Maximum};
use super::separation::is_separated;

/// What the last step may gain in log-likelihood. It then moves the coefficients by some 1e-4 of their standard errors, and
/// Newton's convergence squares that.
const TOLERANCE: f64 = 1e-8;
/// Newton's method, so started, needs fewer steps than this; more raise the suspicion that there is no maximum.
const SUSPICIOUS_STEPS: usize = 6;

/// A curve, ready to be fitted again.
pub struct CurveRefit<'a> {
    sample: &'a EventSample,
    fit: &'a BinaryFit,
    design: DesignMatrix,
    influence: Influence,
}

impl<'a> CurveRefit<'a> {
    /// Of a curve and the sample it was fitted to.
    pub fn new(sample: &'a EventSample, fit: &'a BinaryFit) -> CurveRefit<'a> {
        let design = sample.design();
        let weights = vec![1.0; sample.happened.len()];
        let likelihood =
            BinaryLikelihood { design: &design, events: &sample.happened, weights: &weights, link: fit.link };
        let influence = Influence::of_likelihood(&likelihood, &fit.coefficients);
        CurveRefit { sample, fit, design, influence }
    }

    /// The coefficients where each of all cases counts so often; none without a maximum of the likelihood.
    pub fn coefficients(&self, counts: &[f64]) -> Option<DVector<f64>> {
        let weights: Vec<f64> = self.sample.rows.iter().map(|&row| counts[row]).collect();
        let (design, events) = (&self.design, self.sample.happened.as_slice());
        let likelihood = BinaryLikelihood { design, events, weights: &weights, link: self.fit.link };
        let start = &self.fit.coefficients + self.influence.step(design, &weights)?;
        let Maximum { at, steps, .. } = likelihood.maximise(&start, Along::All, TOLERANCE)?;
        (steps < SUSPICIOUS_STEPS || !self.separated(&weights)).then_some(at)
    }

    /// The parameters of the curve.
    pub fn curve_parameters(&self) -> &'static [CurveParameter] {
        CurveParameter::of_curve(self.fit.coefficients.len())
    }

    /// A parameter of the fit itself.
    pub fn fitted(&self, parameter: CurveParameter) -> f64 {
        parameter.value(self.fit.link, &self.fit.coefficients)
    }

    /// A parameter in each of these refits; none where there is no fit or its slope has the other sign.
    pub fn parameters(&self, parameter: CurveParameter, refits: &[Option<DVector<f64>>]) -> Vec<Option<f64>> {
        let value = |b: &DVector<f64>| parameter.refitted(self.fit.link, b, &self.fit.coefficients);
        refits.iter().map(|b| b.as_ref().and_then(value)).collect()
    }

    /// The acceleration of a parameter for BCa limits.
    pub fn acceleration(&self, parameter: CurveParameter, strata: &Strata) -> f64 {
        let (link, fitted) = (self.fit.link, &self.fit.coefficients);
        let mut without_each = vec![self.fitted(parameter); strata.rows()];
        let changes = self.influence.without_each(&self.design, &self.fit.covariance);
        for (&row, change) in self.sample.rows.iter().zip(changes) {
            without_each[row] = parameter.value(link, &(fitted + change));
        }
        acceleration(&without_each, strata)
    }

    fn separated(&self, weights: &[f64]) -> bool {
        let drawn = |values: &[f64]| -> Vec<f64> {
            values.iter().zip(weights).filter(|(_, weight)| **weight > 0.0).map(|(x, _)| *x).collect()
        };
        let columns: Vec<Vec<f64>> = self.sample.predictors().into_iter().map(drawn).collect();
        let events = self.sample.happened.iter().zip(weights).filter(|(_, weight)| **weight > 0.0);
        let events: Vec<bool> = events.map(|(event, _)| *event).collect();
        is_separated(&columns.iter().map(Vec::as_slice).collect::<Vec<_>>(), &events)
    }
}
