//! The fragility of an object at a site: probabilities given one peak, averaged over the other as at this site.

use super::budget::Budget;
use super::site::{Hazard, Site};
use crate::fragility::{Direction, GivenPeak, LimitStates};
use crate::object::{Subject, Unknown};
use crate::statistics::Estimate;

impl Site {
    /// Finds the probabilities of the limit states at intensities of the peak of the hazard curve (m/s2 or m/s), with
    /// limits; none of a hazard of pairs of peaks. Integrated over the curve, their values are its rates.
    pub fn fragility(&self, subject: &Subject, intensities: &[f64]) -> Option<Vec<LimitStates<Estimate>>> {
        let Hazard::Curve(hazard) = &self.hazard else { return None };
        let (directions, motions) = (&subject.directions[..], self.motions(hazard, subject));
        let all = subject.model_errors().into_iter().chain(subject.unknowns.iter().cloned());
        let changed: Vec<Unknown<Vec<Direction>>> =
            all.map(|unknown| unknown.map(|change| subject.changed(change))).collect();
        let middle = motions.given(directions, 0.0, None);
        let mut ends: Vec<Unknown<GivenPeak>> = Vec::new();
        if directions[0].model.depends_on_magnitude() && middle.mw.is_some() {
            ends.push(motions.unknown.map(|mw| motions.given(directions, 0.0, Some(*mw))));
        }
        ends.push(motions.velocity.unknown().map(|ln| motions.given(directions, *ln, None)));
        for Unknown { part, low, high } in &changed {
            let [low, high] = [low, high].map(|directions| motions.given(directions, 0.0, None));
            ends.push(Unknown { part: *part, low, high });
        }
        let at = |intensity: f64| {
            let states = |given: &GivenPeak| given.limit_states(intensity);
            let value = states(&middle);
            let ends: Vec<_> = ends.iter().map(|unknown| unknown.map(states)).collect();
            let limited = |of: fn(&LimitStates<f64>) -> f64| match of(&value) {
                p if p > 0.0 && p < 1.0 => {
                    let estimate =
                        Budget::new(&value, &ends, |states| logit(of(states))).limit_probability(p, 0.0);
                    Estimate { high: estimate.high.min(value.rocking), ..estimate }
                }
                p => Estimate::exact(p),
            };
            LimitStates {
                rocking: Estimate::exact(value.rocking),
                failure: limited(|states| states.failure),
                overturning: limited(|states| states.overturning),
            }
        };
        Some(intensities.iter().map(|intensity| at(*intensity)).collect())
    }
}

fn logit(p: f64) -> f64 {
    (p / (1.0 - p)).ln()
}
