//! The fragility of an object: the probabilities of its limit states at each intensity of one peak, averaged
//! over the motions that have it.

use super::budget::Budget;
use super::conditional_motions::ConditionalMotions;
use super::ground_motion::logit;
use super::site::{Hazard, Site, strongest};
use crate::fragility::{
    AssumedMagnitude, GivenPeak, LimitState, LimitStates, ModelPoint, Peak, RockingDirection,
};
use crate::motion::Peaks;
use crate::object::{LowHigh, RockingObject};
use crate::statistics::numerics::{bisect_first_true, equal_ratios};
use crate::statistics::{Interval, least_squares, normal};

/// Motions as recorded at generic sites, conditional on one peak, and what narrows the other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GenericSites {
    pub over: Peak,
    pub mw: Option<f64>,
    pub vs30_m_s: Option<f64>,
    /// PGV / PGA of all motions, s.
    pub ratio_s: Option<f64>,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Fragility {
    pub over: Peak,
    /// From the least intensity that uplifts the object to the strongest ever recorded.
    pub points: Vec<FragilityPoint>,
    /// A demand above the limit state, or overturning.
    pub failure: Lognormal,
    pub overturning: Lognormal,
    /// Standard deviations of the logit of P(overturning), by source, where P is nearest to one half.
    pub budget: Budget,
    /// The median motion there.
    pub motion: Peaks,
    pub magnitude: Option<AssumedMagnitude>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FragilityPoint {
    /// PGA (m/s2) or PGV (m/s).
    pub intensity: f64,
    /// Shares of the motions of this intensity, with limits; empty where the model has none.
    pub p: LimitStates<Interval<Option<f64>>>,
}

/// Intensities (m/s2 or m/s), and the curve Phi(ln(intensity / theta) / beta), of a fragility.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Lognormal {
    /// Intensities at which 16, 50 and 84 % of the motions have the effect; none beyond the last point.
    #[serde(rename = "_16")]
    pub at_16: Interval<Option<f64>>,
    #[serde(rename = "_theta")]
    pub theta: Interval<Option<f64>>,
    #[serde(rename = "_84")]
    pub at_84: Interval<Option<f64>>,
    /// Inverse least-squares slope of the probit over ln intensity, for P from .05 to .95 or the last point.
    #[serde(rename = "_beta")]
    pub beta: Option<f64>,
    /// Largest error of the lognormal curve over the same P.
    #[serde(rename = "_error")]
    pub largest_error: Option<f64>,
}

const STEPS: usize = 119;
/// The least intensity over the strongest.
const LEAST: f64 = 1e-3;
/// Probabilities between which the slope is fitted, and steps between them.
const LEAST_FITTED: f64 = 0.05;
const MOST_FITTED: f64 = 0.95;
const STEPS_FITTED: usize = 39;

impl GenericSites {
    pub fn fragility(&self, object: &RockingObject) -> Fragility {
        Fragility::new(&self.motions(&object.directions), object)
    }

    pub fn given_peak<'a>(&self, directions: &'a [RockingDirection]) -> GivenPeak<'a> {
        self.motions(directions).given(directions, 0.0)
    }

    fn motions(&self, directions: &[RockingDirection]) -> ConditionalMotions {
        ConditionalMotions::as_recorded(&directions[0].model, *self)
    }
}

impl Site {
    /// Over the peak of the hazard curve, averaged over the motions of the site: the integral over the curve
    /// is the rate. None for a joint hazard.
    pub fn fragility(&self, object: &RockingObject) -> Option<Fragility> {
        match &self.hazard {
            Hazard::Curve(hazard) => Some(Fragility::new(&self.motions(hazard, object), object)),
            Hazard::Joint(_) => None,
        }
    }
}

impl Fragility {
    /// From points alone, such as those of a file: without error budget, motion and magnitude.
    pub fn from_points(over: Peak, points: Vec<FragilityPoint>) -> Fragility {
        let [failure, overturning] =
            [LimitState::Failure, LimitState::Overturning].map(|state| Lognormal::between(&points, state));
        let (budget, motion) = (Budget::default(), Peaks::default());
        Fragility { over, points, failure, overturning, budget, motion, magnitude: None }
    }

    fn new(motions: &ConditionalMotions, object: &RockingObject) -> Fragility {
        let middle = motions.given(&object.directions, 0.0);
        let end = strongest(motions.peak);
        let start = middle.uplift().least.clamp(LEAST * end, 0.5 * end);
        let intensities: Vec<f64> = equal_ratios(start, end, STEPS).collect();
        let model_points = ModelPoint::at_errors(&object.directions);
        let by_point = probabilities(&middle, &intensities, &model_points);
        let mut at_quantiles = motions
            .at_quantiles(object, |given, point| probabilities(given, &intensities, &[point]).remove(0));
        at_quantiles.extend(LowHigh::from_fit_errors(&by_point));
        let values = &by_point[0];
        let budget = |k: usize, state: LimitState| {
            Budget::new(values, &at_quantiles, |states: &Vec<LimitStates<Option<f64>>>| {
                states[k].get(state).map(logit)
            })
        };
        let points = intensities.iter().zip(values).enumerate().map(|(k, (&intensity, p))| {
            let [failure, overturning] = [LimitState::Failure, LimitState::Overturning]
                .map(|state| Some(budget(k, state).limit_probability(p.get(state)?, p.rocking?, 0.0)));
            let rocking = p.rocking.map(Interval::exact);
            let p = LimitStates { rocking, failure, overturning }.map(Interval::from);
            FragilityPoint { intensity, p }
        });
        let points: Vec<FragilityPoint> = points.collect();
        let is_half = |p: &LimitStates<Option<f64>>| p.overturning.is_some_and(|p| p >= 0.5);
        let median = values.iter().position(is_half).unwrap_or(intensities.len() - 1);
        let motion = middle.peaks(intensities[median], 0.0);
        Fragility {
            over: motions.peak,
            failure: Lognormal::new(&middle, &points, LimitState::Failure),
            overturning: Lognormal::new(&middle, &points, LimitState::Overturning),
            budget: budget(median, LimitState::Overturning),
            motion,
            magnitude: motions.magnitude(&object.directions[0].model, motion),
            points,
        }
    }
}

impl Lognormal {
    /// By interpolation, without a dispersion.
    fn between(points: &[FragilityPoint], state: LimitState) -> Lognormal {
        let [at_16, theta, at_84] = [0.16, 0.5, 0.84].map(|level| Interval {
            value: crossing(points, level, |point| point.p.get(state).value),
            low: crossing(points, level, |point| point.p.get(state).high),
            high: crossing(points, level, |point| point.p.get(state).low),
        });
        Lognormal { at_16, theta, at_84, ..Lognormal::default() }
    }

    fn new(given: &GivenPeak, points: &[FragilityPoint], state: LimitState) -> Lognormal {
        let mut lognormal = Lognormal::between(points, state);
        [lognormal.at_16.value, lognormal.theta.value, lognormal.at_84.value] =
            [0.16, 0.5, 0.84].map(|level| reaching(given, points, state, level));
        let least = reaching(given, points, state, LEAST_FITTED);
        let Some((from, median)) = least.zip(lognormal.theta.value) else {
            return lognormal;
        };
        let end = points[points.len() - 1].intensity;
        let to = reaching(given, points, state, MOST_FITTED).unwrap_or(end);
        let intensities: Vec<f64> = equal_ratios(from, to, STEPS_FITTED).collect();
        let p: Option<Vec<f64>> = intensities.iter().map(|im| given.limit_states(*im).get(state)).collect();
        let Some(p) = p else { return lognormal };
        let x: Vec<f64> = intensities.iter().map(|intensity| intensity.ln()).collect();
        let z: Vec<f64> = p.iter().map(|p| normal::quantile(*p)).collect();
        let Ok(line) = least_squares(&[&x], &z) else { return lognormal };
        let beta = 1.0 / line.fit.coefficients[1];
        let errors = x.iter().zip(&p).map(|(x, p)| (normal::cdf((x - median.ln()) / beta) - p).abs());
        Lognormal { beta: Some(beta), largest_error: Some(errors.fold(0.0, f64::max)), ..lognormal }
    }
}

fn probabilities(
    given: &GivenPeak,
    intensities: &[f64],
    model_points: &[ModelPoint],
) -> Vec<Vec<LimitStates<Option<f64>>>> {
    let by_intensity: Vec<_> = intensities.iter().map(|im| given.at_points(*im, model_points)).collect();
    (0..model_points.len()).map(|point| by_intensity.iter().map(|states| states[point]).collect()).collect()
}

/// The intensity from which on a probability is at least `level`, sought beside the first such point.
fn reaching(given: &GivenPeak, points: &[FragilityPoint], state: LimitState, level: f64) -> Option<f64> {
    let reaches = |p: Option<f64>| p.is_some_and(|p| p >= level);
    let after = points.iter().position(|point| reaches(point.p.get(state).value))?;
    let [low, high] = [after.saturating_sub(1), after].map(|k| points[k].intensity.ln());
    Some(bisect_first_true(low, high, |ln| reaches(given.limit_states(ln.exp()).get(state))).exp())
}

/// The intensity at which a limit passes `level`: between points its probit is linear in ln intensity.
fn crossing(
    points: &[FragilityPoint],
    level: f64,
    p: impl Fn(&FragilityPoint) -> Option<f64>,
) -> Option<f64> {
    let after = points.iter().position(|point| p(point).is_some_and(|p| p >= level))?;
    let [low, high] = [&points[after.saturating_sub(1)], &points[after]];
    let probit = |point| Some(normal::quantile(p(point)?.clamp(1e-12, 1.0 - 1e-12)));
    let (Some(a), Some(b)) = (probit(low), probit(high)) else { return Some(high.intensity) };
    if b <= a {
        return Some(high.intensity);
    }
    let share = (normal::quantile(level) - a) / (b - a);
    Some(low.intensity * (high.intensity / low.intensity).powf(share))
}
