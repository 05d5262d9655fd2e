//! The fragility of an object: the probabilities of its limit states at each intensity of one peak, averaged
//! over the motions that have it.

use super::budget::Budget;
use super::pgv_pga::{PgvPgaRatio, magnitude};
use super::site::{Hazard, Motions, Site, strongest};
use crate::fragility::{GivenPeak, LimitState, LimitStates, Peak};
use crate::motion::Peaks;
use crate::number::{Limited, plain, significant};
use crate::object::{Subject, Unknown};
use crate::statistics::numerics::first;
use crate::statistics::{Estimate, normal};

/// Motions of sites in general, of which one peak is given, and what narrows the other.
///
/// ```
/// use rockfrag::fragility::{Kind, Peak};
/// use rockfrag::hazard::SitesInGeneral;
/// use rockfrag::object::{Object, Subject};
///
/// let cabinet = Subject::shipped(&Object::block("cabinet", 0.5, 2.0), Kind::Recorded, 0.10)?;
/// let sites = SitesInGeneral { over: Peak::Pga, mw: Some(6.5), vs30_m_s: None, ratio_s: None };
/// let fragility = sites.fragility(&cabinet);
/// // The PGA at which half of the motions overturn it, m/s2; and how well a lognormal curve describes it.
/// assert!(fragility.overturning.theta.value.is_some_and(|pga| pga > 5.0));
/// assert!(fragility.overturning.largest_error.is_some_and(|error| error < 0.1));
/// for point in &fragility.points {
///     assert!(point.p.overturning.value <= point.p.failure.value + 1e-12);
/// }
/// # Ok::<(), rockfrag::object::Reason>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SitesInGeneral {
    /// The peak that is given.
    pub over: Peak,
    /// Magnitude.
    pub mw: Option<f64>,
    /// Vs30, m/s.
    pub vs30_m_s: Option<f64>,
    /// PGV / PGA of all motions, s.
    pub ratio_s: Option<f64>,
}

/// The fragility of an object.
#[derive(Debug, Clone, PartialEq)]
pub struct Fragility {
    /// The peak that is given.
    pub over: Peak,
    /// From the least intensity that uplifts the object to the strongest that was ever recorded.
    pub points: Vec<FragilityPoint>,
    /// Of a demand above the limit state, or overturning.
    pub failure: Lognormal,
    /// Of overturning.
    pub overturning: Lognormal,
    /// Standard deviations of the logit of the probability of overturning, by what is not known, where it is
    /// nearest to one half.
    pub errors: Budget,
    /// PGA and PGV (m/s2 and m/s) there.
    pub motion: Peaks,
}

/// The probabilities at an intensity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FragilityPoint {
    /// PGA (m/s2) or PGV (m/s).
    pub intensity: f64,
    /// Shares of the motions of this intensity, with limits.
    pub p: LimitStates<Estimate>,
}

/// What a fragility comes to: intensities (m/s2 or m/s), and the lognormal curve Phi(ln(intensity / theta) /
/// beta).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Lognormal {
    /// Where 16, 50 and 84 % of the motions have the effect; none beyond the last point.
    pub at_16: Limited,
    /// Median.
    pub theta: Limited,
    /// See `at_16`.
    pub at_84: Limited,
    /// Least-squares slope of the probit over ln intensity, inverted, where P is .05 to .95 as far as that
    /// is reached.
    pub beta: Option<f64>,
    /// Largest error of a probability by theta and beta there.
    pub largest_error: Option<f64>,
}

/// Points of a curve.
const POINTS: i32 = 120;
/// The least intensity over the strongest.
const LEAST: f64 = 1e-3;
/// Probabilities between which the slope is fitted, and at how many intensities.
const FITTED: [f64; 2] = [0.05, 0.95];
const STEPS: i32 = 40;

impl SitesInGeneral {
    /// Computes the fragility of an object.
    pub fn fragility(&self, subject: &Subject) -> Fragility {
        let of_model = || PgvPgaRatio::of_model(&subject.directions[0].model, self.over, self.vs30_m_s);
        let velocity = self.ratio_s.map_or_else(of_model, PgvPgaRatio::given);
        let (median, unknown) = magnitude(self.mw, Some(0.0));
        let (peak, given) = (self.over, self.mw);
        Fragility::new(&Motions { peak, velocity, given, above: 0.0, median, unknown }, subject)
    }
}

impl Site {
    /// Computes the fragility of an object over the peak of the hazard curve, averaged over the motions of
    /// the site: its integral over the curve is the rate. None for a joint hazard.
    pub fn fragility(&self, subject: &Subject) -> Option<Fragility> {
        match &self.hazard {
            Hazard::Curve(hazard) => Some(Fragility::new(&self.motions(hazard, subject), subject)),
            Hazard::Joint(_) => None,
        }
    }
}

impl Fragility {
    fn new(motions: &Motions, subject: &Subject) -> Fragility {
        let directions = &subject.directions[..];
        let middle = motions.given(directions, 0.0, None);
        let end = strongest(motions.peak);
        let start = middle.uplift()[0].clamp(LEAST * end, 0.5 * end);
        let step = |k: i32| start * (end / start).powf(f64::from(k) / f64::from(POINTS - 1));
        let intensities: Vec<f64> = (0..POINTS).map(step).collect();
        let values = probabilities(&middle, &intensities);
        let mut ends: Vec<Unknown<Vec<LimitStates<f64>>>> = Vec::new();
        if directions[0].model.depends_on_magnitude() && middle.mw.is_some() {
            let at = |mw: &f64| probabilities(&motions.given(directions, 0.0, Some(*mw)), &intensities);
            ends.push(motions.unknown.map(at));
        }
        let velocity = motions.velocity.unknown();
        ends.push(velocity.map(|ln| probabilities(&motions.given(directions, *ln, None), &intensities)));
        for unknown in subject.model_errors().iter().chain(&subject.unknowns) {
            ends.push(unknown.map(|change| {
                let directions = subject.changed(change);
                probabilities(&motions.given(&directions, 0.0, None), &intensities)
            }));
        }
        let budget = |k: usize, state: LimitState| {
            Budget::new(&values, &ends, |states: &Vec<LimitStates<f64>>| logit(states[k].get(state)))
        };
        let limited = |k: usize, state: LimitState| match values[k].get(state) {
            p if p > 0.0 && p < 1.0 => {
                let p = budget(k, state).limit_probability(p, 0.0);
                Estimate { high: p.high.min(values[k].rocking.max(p.value)), ..p }
            }
            p => Estimate::exact(p),
        };
        let point = |k: usize| FragilityPoint {
            intensity: intensities[k],
            p: LimitStates {
                rocking: Estimate::exact(values[k].rocking),
                failure: limited(k, LimitState::Failure),
                overturning: limited(k, LimitState::Overturning),
            },
        };
        let points: Vec<FragilityPoint> = (0..intensities.len()).map(point).collect();
        let median = values.iter().position(|p| p.overturning >= 0.5).unwrap_or(intensities.len() - 1);
        Fragility {
            over: motions.peak,
            failure: Lognormal::new(&middle, &points, LimitState::Failure),
            overturning: Lognormal::new(&middle, &points, LimitState::Overturning),
            errors: budget(median, LimitState::Overturning),
            motion: middle.peaks(intensities[median], 0.0),
            points,
        }
    }
}

impl Lognormal {
    fn new(given: &GivenPeak, points: &[FragilityPoint], state: LimitState) -> Lognormal {
        let end = points[points.len() - 1].intensity;
        let reached = |level: f64| Limited {
            value: reaching(given, points, state, level),
            low: crossing(points, level, |point| point.p.get(state).high),
            high: crossing(points, level, |point| point.p.get(state).low),
        };
        let theta = reached(0.5);
        let mut lognormal =
            Lognormal { at_16: reached(0.16), theta, at_84: reached(0.84), ..Lognormal::default() };
        let Some((from, median)) = reaching(given, points, state, FITTED[0]).zip(theta.value) else {
            return lognormal;
        };
        let to = reaching(given, points, state, FITTED[1]).unwrap_or(end);
        let sample = |k: i32| {
            let intensity = from * (to / from).powf(f64::from(k) / f64::from(STEPS - 1));
            (intensity.ln(), given.limit_states(intensity).get(state))
        };
        let sampled: Vec<(f64, f64)> = (0..STEPS).map(sample).collect();
        let mean = |of: fn(&(f64, f64)) -> f64| sampled.iter().map(of).sum::<f64>() / f64::from(STEPS);
        let (x, z) = (mean(|point| point.0), mean(|point| normal::quantile(point.1)));
        let squares: f64 = sampled.iter().map(|point| (point.0 - x).powi(2)).sum();
        let products: f64 = sampled.iter().map(|point| (point.0 - x) * (normal::quantile(point.1) - z)).sum();
        let beta = squares / products;
        let error = |point: &(f64, f64)| (normal::cdf((point.0 - median.ln()) / beta) - point.1).abs();
        lognormal.beta = Some(beta);
        lognormal.largest_error = Some(sampled.iter().map(error).fold(0.0, f64::max));
        lognormal
    }
}

/// An intensity (m/s2 or m/s) with its unit; that which is beyond all that was recorded by that.
pub fn intensity_in_words(over: Peak, intensity: Option<f64>) -> String {
    let (_, unit, symbol) = over.words();
    match intensity {
        Some(value) => format!("{} {symbol}", significant(value / unit, 2)),
        None => format!("> {} {symbol}", plain(strongest(over) / unit)),
    }
}

fn probabilities(given: &GivenPeak, intensities: &[f64]) -> Vec<LimitStates<f64>> {
    intensities.iter().map(|intensity| given.limit_states(*intensity)).collect()
}

/// The intensity from which on a probability is at least `level`, sought beside the first point that has it.
fn reaching(given: &GivenPeak, points: &[FragilityPoint], state: LimitState, level: f64) -> Option<f64> {
    let after = points.iter().position(|point| point.p.get(state).value >= level)?;
    let [low, high] = [after.saturating_sub(1), after].map(|k| points[k].intensity.ln());
    Some(first(low, high, |ln| given.limit_states(ln.exp()).get(state) >= level).exp())
}

/// The intensity at which a limit passes `level`: between points its probit is linear in ln intensity.
fn crossing(points: &[FragilityPoint], level: f64, of: impl Fn(&FragilityPoint) -> f64) -> Option<f64> {
    let after = points.iter().position(|point| of(point) >= level)?;
    let [low, high] = [&points[after.saturating_sub(1)], &points[after]];
    let [a, b] = [of(low), of(high)].map(|p| normal::quantile(p.clamp(1e-12, 1.0 - 1e-12)));
    if b <= a {
        return Some(high.intensity);
    }
    let share = (normal::quantile(level) - a) / (b - a);
    Some(low.intensity * (high.intensity / low.intensity).powf(share))
}

fn logit(p: f64) -> f64 {
    (p / (1.0 - p)).ln()
}
