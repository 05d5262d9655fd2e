//! Probabilities of the limit states under one motion, of which both peaks or one are known.

use super::budget::Budget;
use super::pgv_pga::{PgvPgaRatio, magnitude};
use crate::fragility::{Direction, GivenPeak, Level, LimitStates, Model, Peak, ReadyObject, Scenarios, Z_95};
use crate::motion::Peaks;
use crate::object::{Part, Subject, Unknown};
use crate::statistics::Estimate;

/// A motion: its peaks, and the magnitude of the earthquake if it is known.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// PGA, m/s2.
    pub pga_m_s2: Option<f64>,
    /// PGV, m/s.
    pub pgv_m_s: Option<f64>,
    /// Moment magnitude.
    pub mw: Option<f64>,
    /// Vs30 of the site, m/s.
    pub vs30_m_s: Option<f64>,
}

/// Probabilities of the limit states, with limits.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct MotionProbabilities {
    pub states: LimitStates<Estimate>,
    /// Standard deviations of the logit of the probability of overturning, by what is not known.
    pub errors: Budget,
}

impl Motion {
    /// Both peaks; the one that is not known is the median.
    pub fn peaks(&self, model: &Model) -> Peaks {
        let ratio = |peak: Peak, intensity: f64| {
            let velocity = PgvPgaRatio::of_model(model, peak, self.vs30_m_s);
            velocity.at(magnitude(self.mw, None).0, 0.0).ratio(intensity, 0.0)
        };
        let (pga_m_s2, pgv_m_s) = match (self.pga_m_s2, self.pgv_m_s) {
            _ if self.is_still() => (0.0, 0.0),
            (Some(pga), Some(pgv)) => (pga, pgv),
            (Some(pga), None) => (pga, pga * ratio(Peak::Pga, pga)),
            (None, Some(pgv)) => (pgv / ratio(Peak::Pgv, pgv), pgv),
            (None, None) => (0.0, 0.0),
        };
        Peaks { pga_m_s2, pgv_m_s }
    }

    /// Whether the ground stands still: a peak of 0.
    pub fn is_still(&self) -> bool {
        self.pga_m_s2 == Some(0.0) || self.pgv_m_s == Some(0.0)
    }

    /// Computes the probabilities for an object, averaged over the peak that is not known.
    pub fn probabilities(&self, subject: &Subject) -> MotionProbabilities {
        if self.is_still() {
            let states = LimitStates::all(Estimate::exact(0.0));
            return MotionProbabilities { states, errors: Budget::default() };
        }
        let (directions, model) = (&subject.directions[..], &subject.directions[0].model);
        let (mw, magnitude) = magnitude(self.mw, None);
        let velocity = self.given().map(|(peak, _)| PgvPgaRatio::of_model(model, peak, self.vs30_m_s));
        let states = |directions: &[Direction], mw: f64, ln: f64| {
            self.states(directions, velocity.map(|velocity| (velocity, mw, ln)), Scenarios::Many)
        };
        let many = states(directions, mw, 0.0);
        let one = self.states(directions, velocity.map(|velocity| (velocity, mw, 0.0)), Scenarios::One);
        let mut ends: Vec<Unknown<LimitStates<Estimate>>> = Vec::new();
        // Of a motion whose peaks are both known, what magnitude adds is beside tau in its own limits.
        if let Some(velocity) = velocity {
            if model.depends_on_magnitude() && self.mw.is_none() {
                ends.push(magnitude.map(|mw| states(directions, *mw, 0.0)));
            }
            ends.push(velocity.unknown().map(|ln| states(directions, mw, *ln)));
        }
        let unknowns = subject.unknowns.iter();
        ends.extend(unknowns.map(|unknown| unknown.map(|change| states(&subject.changed(change), mw, 0.0))));
        let failure = Budget::new(&many, &ends, |states| logit(states.failure.value));
        let overturning = Budget::new(&many, &ends, |states| logit(states.overturning.value));
        let rocking = many.rocking;
        let (failure, _) = limited(many.failure, one.failure, failure, rocking.value);
        let (overturning, errors) = limited(many.overturning, one.overturning, overturning, rocking.value);
        MotionProbabilities { states: LimitStates { rocking, failure, overturning }, errors }
    }

    /// The peak that is given alone, and its value; none where both are given.
    fn given(&self) -> Option<(Peak, f64)> {
        match (self.pga_m_s2, self.pgv_m_s) {
            (Some(_), Some(_)) => None,
            (Some(pga), None) => Some((Peak::Pga, pga)),
            (None, pgv) => Some((Peak::Pgv, pgv.unwrap_or(0.0))),
        }
    }

    /// The probabilities in these directions; of one peak with this PGV / PGA, of a magnitude and off by a
    /// factor.
    fn states(
        &self,
        directions: &[Direction],
        velocity: Option<(PgvPgaRatio, f64, f64)>,
        scenarios: Scenarios,
    ) -> LimitStates<Estimate> {
        match self.given().zip(velocity) {
            None => {
                let [pga_m_s2, pgv_m_s] = [self.pga_m_s2, self.pgv_m_s].map(Option::unwrap_or_default);
                let (ready, peaks) = (ReadyObject::new(directions, self.mw), Peaks { pga_m_s2, pgv_m_s });
                Level::limit_states(scenarios, |level| ready.limit_states(peaks, level))
            }
            Some(((peak, intensity), (velocity, mw, ln))) => {
                let (ratio, mw) = (velocity.at(mw, ln), velocity.magnitude(self.mw, mw));
                GivenPeak::new(directions, peak, ratio, mw).estimates(intensity, scenarios)
            }
        }
    }
}

/// Gives a probability under many motions the limits of one, which are never above the probability of
/// rocking; and adds the error of the fit to the others.
fn limited(many: Estimate, one: Estimate, mut errors: Budget, rocking: f64) -> (Estimate, Budget) {
    let fit = sd_of_limits(many);
    errors.add(Part::Fit, [fit, fit]);
    let tau = (sd_of_limits(one).powi(2) - fit * fit).max(0.0).sqrt();
    if !(many.value > 0.0 && many.value < 1.0) {
        return (many, errors);
    }
    let p = errors.limit_probability(many.value, tau);
    (Estimate { high: p.high.min(rocking), ..p }, errors)
}

fn logit(p: f64) -> f64 {
    (p / (1.0 - p)).ln()
}

/// The standard deviation of a logit by its 95 % limits.
fn sd_of_limits(p: Estimate) -> f64 {
    let sd = (logit(p.high) - logit(p.low)) / (2.0 * Z_95);
    if sd.is_finite() { sd } else { 0.0 }
}
