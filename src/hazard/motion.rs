//! Probabilities of the limit states under one motion, of which both peaks or one are known.

use super::budget::{Budgets, Part, Unknown};
use super::pgv_pga::{PgvPgaRatio, magnitude};
use crate::fragility::{GivenPeak, Model, Peak, Probability, Scenarios, Z_95, limit_states_at};
use crate::rocking::Structure;
use crate::statistics::Limits;

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

/// Probabilities of LS1, LS2 and LS3, and the errors of the logits of the last two.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct MotionProbabilities {
    pub states: [Probability; 3],
    pub budgets: Budgets,
}

impl Motion {
    /// PGA and PGV (m/s2 and m/s); the one that is not known is the median.
    pub fn peaks(&self, model: &Model) -> [f64; 2] {
        let ratio = |peak: Peak, intensity: f64| {
            let velocity = PgvPgaRatio::of_model(model, peak, self.vs30_m_s);
            velocity.at(magnitude(self.mw).0, 0.0).ratio(intensity, 0.0)
        };
        match (self.pga_m_s2, self.pgv_m_s) {
            (Some(pga), Some(pgv)) => [pga, pgv],
            (Some(pga), None) => [pga, pga * ratio(Peak::Pga, pga)],
            (None, Some(pgv)) => [pgv / ratio(Peak::Pgv, pgv), pgv],
            (None, None) => [0.0; 2],
        }
    }

    /// The probabilities for an object in its directions, of which there is one or more, averaged over the peak
    /// that is not known. `unknowns` are its uncertain inputs: the same directions with one of them at its
    /// quantiles.
    pub fn probabilities(
        &self,
        directions: &[(Structure, Model)],
        unknowns: &[Unknown<Vec<(Structure, Model)>>],
    ) -> MotionProbabilities {
        let model = &directions[0].1;
        let (mw, of_magnitude) = magnitude(self.mw);
        let velocity = |peak: Peak| PgvPgaRatio::of_model(model, peak, self.vs30_m_s);
        let one = match (self.pga_m_s2, self.pgv_m_s) {
            (Some(_), Some(_)) => None,
            (Some(pga), None) => Some((Peak::Pga, pga, velocity(Peak::Pga))),
            (None, pgv) => Some((Peak::Pgv, pgv.unwrap_or(0.0), velocity(Peak::Pgv))),
        };
        let states = |directions: &[(Structure, Model)], mw: f64, ln: f64, scenarios: Scenarios| {
            let Some((peak, intensity, velocity)) = one else {
                let peaks = [self.pga_m_s2, self.pgv_m_s].map(Option::unwrap_or_default);
                return limit_states_at(directions, peaks, self.mw, scenarios);
            };
            let (ratio, mw) = (velocity.at(mw, ln), velocity.magnitude(self.mw, mw));
            GivenPeak { directions, peak, ratio, mw }.limit_states(intensity, scenarios)
        };
        let logits = |directions: &[(Structure, Model)], mw: f64, ln: f64| {
            let [_, failure, overturning] = states(directions, mw, ln, Scenarios::Many);
            [failure, overturning].map(|p| logit(p.value))
        };
        let [of_one, of_many] =
            [Scenarios::One, Scenarios::Many].map(|scenarios| states(directions, mw, 0.0, scenarios));
        let fit = [of_many[1], of_many[2]].map(sd_of_limits);
        let mut budgets = Budgets::about(logits(directions, mw, 0.0));
        budgets.add(Part::Fit, fit.map(|sd| [sd, sd]));
        // Of a motion whose peaks are both known, what magnitude adds is beside tau in its own limits.
        if let Some((.., velocity)) = one {
            if model.depends_on_magnitude() && self.mw.is_none() {
                budgets.vary(&of_magnitude, |mw| logits(directions, *mw, 0.0));
            }
            budgets.vary(&velocity.unknown(), |ln| logits(directions, mw, *ln));
        }
        for unknown in unknowns {
            budgets.vary(unknown, |directions| logits(directions, mw, 0.0));
        }
        let tau = [0, 1].map(|k| (sd_of_limits(of_one[k + 1]).powi(2) - fit[k] * fit[k]).max(0.0).sqrt());
        let [rocking, failure, overturning] = of_many;
        let limited = |p: Probability, limits: Limits| match p.value > 0.0 && p.value < 1.0 {
            true => Probability { low: limits.low, high: limits.high.min(rocking.value), ..p },
            false => p,
        };
        let of_failure = budgets.failure.limits_of_probability(failure.value, tau[0]);
        let of_overturning = budgets.overturning.limits_of_probability(overturning.value, tau[1]);
        MotionProbabilities {
            states: [rocking, limited(failure, of_failure), limited(overturning, of_overturning)],
            budgets,
        }
    }
}

fn logit(p: f64) -> f64 {
    (p / (1.0 - p)).ln()
}

/// The standard deviation of a logit by its 95 % limits.
fn sd_of_limits(p: Probability) -> f64 {
    let sd = (logit(p.high) - logit(p.low)) / (2.0 * Z_95);
    if sd.is_finite() { sd } else { 0.0 }
}
