//! Probabilities of the limit states under one motion, of which both peaks or one are known.

use super::budget::Budget;
use super::conditional_motions::ConditionalMotions;
use super::fragility_curve::GenericSites;
use crate::fragility::{
    AssumedMagnitude, LimitState, LimitStates, MagnitudeSource, Model, ModelPoint, Peak, ReadyObject, Tau,
};
use crate::motion::Peaks;
use crate::object::{LowHigh, RockingObject, UncertaintySource};
use crate::statistics::Interval;
use crate::statistics::normal::Z_95;

/// A motion: its peaks, and the magnitude of the earthquake if it is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GroundMotion {
    pub pga_m_s2: Option<f64>,
    pub pgv_m_s: Option<f64>,
    pub mw: Option<f64>,
    pub vs30_m_s: Option<f64>,
}

/// With limits; empty where the model has no probability.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionProbabilities {
    pub states: LimitStates<Interval<Option<f64>>>,
    /// Standard deviations of the logit of the probability of overturning, by source.
    pub budget: Budget,
    pub magnitude: Option<AssumedMagnitude>,
}

impl GroundMotion {
    /// A peak that is not known is the median.
    pub fn peaks(&self, model: &Model) -> Peaks {
        match self.given_peak(model) {
            _ if self.is_still() => Peaks::default(),
            Some((motions, intensity)) => motions.given(&[], 0.0).peaks(intensity, 0.0),
            None => {
                let [pga_m_s2, pgv_m_s] = [self.pga_m_s2, self.pgv_m_s].map(Option::unwrap_or_default);
                Peaks { pga_m_s2, pgv_m_s }
            }
        }
    }

    /// Whether a peak is 0.
    pub fn is_still(&self) -> bool {
        self.pga_m_s2 == Some(0.0) || self.pgv_m_s == Some(0.0)
    }

    /// Averaged over the peak that is not known.
    pub fn probabilities(&self, object: &RockingObject) -> MotionProbabilities {
        if self.is_still() {
            let states = LimitStates::all(Interval::exact(0.0).into());
            return MotionProbabilities { states, budget: Budget::default(), magnitude: None };
        }
        let directions = &object.directions[..];
        let model = &directions[0].model;
        let taus = [Tau::Averaged, Tau::Included];
        let peaks = self.peaks(model);
        let (at_quantiles, [averaged, included], magnitude) = match self.given_peak(model) {
            None => {
                let ready = ReadyObject::new(directions, self.mw);
                let mut at_quantiles = object.at_quantiles(|directions| {
                    ReadyObject::new(directions, self.mw).limit_states(peaks, &[ModelPoint::Estimate])[0]
                });
                let inferred = model.inferred_magnitude(peaks);
                let magnitude = inferred.map(|inferred| self.mw.map_or(inferred, AssumedMagnitude::given));
                let unknown = magnitude.filter(|magnitude| magnitude.sd > 0.0);
                at_quantiles.extend(unknown.map(|AssumedMagnitude { sd, .. }| {
                    LowHigh::normal(UncertaintySource::Magnitude, sd)
                        .map(|off| ready.limit_states(peaks, &[ModelPoint::Magnitude(*off)])[0])
                }));
                (at_quantiles, taus.map(|tau| ready.estimates(peaks, tau)), magnitude)
            }
            Some((motions, intensity)) => {
                let given = motions.given(directions, 0.0);
                let at_quantiles =
                    motions.at_quantiles(object, |given, point| given.at_points(intensity, &[point])[0]);
                let magnitude = motions.magnitude(model, peaks);
                (at_quantiles, taus.map(|tau| given.estimates(intensity, tau)), magnitude)
            }
        };
        let is_inferred = magnitude.is_some_and(|magnitude| magnitude.source == MagnitudeSource::Inferred);
        let sensitivity = ProbabilitySensitivity { averaged, included, at_quantiles, is_inferred };
        let (_, failure) = sensitivity.limited(LimitState::Failure);
        let (budget, overturning) = sensitivity.limited(LimitState::Overturning);
        let rocking = sensitivity.averaged.rocking;
        MotionProbabilities {
            states: LimitStates { rocking, failure, overturning }.map(Interval::from),
            budget,
            magnitude,
        }
    }

    /// The motions of the only peak that is given, and its value; none where both are given.
    fn given_peak(&self, model: &Model) -> Option<(ConditionalMotions, f64)> {
        let (peak, intensity) = match (self.pga_m_s2, self.pgv_m_s) {
            (Some(_), Some(_)) => return None,
            (Some(pga), None) => (Peak::Pga, pga),
            (None, pgv) => (Peak::Pgv, pgv?),
        };
        let sites = GenericSites { over: peak, mw: self.mw, vs30_m_s: self.vs30_m_s, ratio_s: None };
        Some((ConditionalMotions::as_recorded(model, sites), intensity))
    }
}

/// Probabilities with limits, and their other uncertainty.
struct ProbabilitySensitivity {
    /// Limits by the parameters of the model.
    averaged: LimitStates<Option<Interval>>,
    /// Limits by these and by the standard deviation between earthquakes, tau.
    included: LimitStates<Option<Interval>>,
    /// With each other source at its quantiles.
    at_quantiles: Vec<LowHigh<LimitStates<Option<f64>>>>,
    /// Whether `included` includes the uncertainty of a magnitude that is inferred.
    is_inferred: bool,
}

impl ProbabilitySensitivity {
    /// The error budget of the logit, without tau; the probability with limits by all errors and tau.
    fn limited(&self, state: LimitState) -> (Budget, Option<Interval>) {
        let (values, [averaged, included]) =
            (self.averaged.map(|p| p.map(|p| p.value)), [self.averaged, self.included].map(|p| p.get(state)));
        let mut budget = Budget::new(&values, &self.at_quantiles, |states| states.get(state).map(logit));
        let Some((averaged, included)) = averaged.zip(included) else { return (budget, None) };
        let [fit, in_all] = [averaged, included].map(sd_of_limits);
        budget.add(LowHigh { source: UncertaintySource::Fit, low: -fit, high: fit });
        let inferred = budget.source_sd(UncertaintySource::Magnitude).filter(|_| self.is_inferred);
        let between = (in_all.powi(2) - fit * fit - inferred.unwrap_or(0.0).powi(2)).max(0.0).sqrt();
        match (averaged.value, values.rocking) {
            (p, Some(rocking)) if p > 0.0 && p < 1.0 => {
                let limits = budget.limit_probability(p, rocking, between);
                (budget, Some(limits))
            }
            _ => (budget, Some(averaged)),
        }
    }
}

pub(super) fn logit(p: f64) -> f64 {
    (p / (1.0 - p)).ln()
}

fn sd_of_limits(p: Interval) -> f64 {
    let sd = (logit(p.high) - logit(p.low)) / (2.0 * Z_95);
    if sd.is_finite() { sd } else { 0.0 }
}
