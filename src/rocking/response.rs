//! The outcome, the demand, and free rocking after the record in closed form.

use std::f64::consts::FRAC_PI_2;

use super::taylor::State;
use crate::keyword::keywords;

keywords! {
    /// The outcome of one structure under one ground motion (Figure 6).
    pub enum Outcome {
        /// The structure stays on its base.
        NoRocking = "no_rocking",
        /// It rocks and comes to rest.
        SafeRocking = "safe_rocking",
        /// Its rotation reaches pi/2, in the record or, by its energy, after it.
        Overturning = "overturning",
    }
}

/// The response of one structure to one ground motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response {
    /// Whether it rocked, and overturned.
    pub outcome: Outcome,
    /// Engineering demand parameter |theta|max / alpha (Eq. 7); pi / (2 alpha) if it overturns.
    pub edp: f64,
    /// Number of impacts during the record.
    pub impacts: u32,
}

impl Response {
    pub(super) const NO_ROCKING: Response = Response { outcome: Outcome::NoRocking, edp: 0.0, impacts: 0 };

    /// Computes the response of a structure of slenderness `alpha` (rad) that rocks, from the largest
    /// rotation `peak` (rad) and the number of impacts during the record, and the free rocking after it. The
    /// demand is |theta|max / alpha (Eq. 7).
    pub(super) fn of_rocking(tail: Tail, peak: f64, alpha: f64, impacts: u32) -> Response {
        let (outcome, peak) = match tail {
            Tail::Overturns => (Outcome::Overturning, FRAC_PI_2),
            Tail::Settles(later) => (Outcome::SafeRocking, peak.max(later)),
        };
        Response { outcome, edp: peak / alpha, impacts }
    }
}

/// The end of free rocking after the record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tail {
    Overturns,
    /// It comes to rest, after this largest rotation, rad.
    Settles(f64),
}

/// Finds the end of free rocking by energy, for a structure of slenderness `alpha` (rad) and restitution
/// `eta` in `state` at the end of the record.
///
/// On still ground v^2/2 + cos(alpha - r) is constant between impacts, with a barrier of height 1 at
/// r = alpha. Each impact removes the fraction 1 - eta^2 of the kinetic energy, so that only the first peak
/// and the one after the first impact can be the largest.
pub fn free_rocking(state: State, alpha: f64, eta: f64) -> Tail {
    let State { rotation, velocity } = state;
    let kinetic = 0.5 * velocity * velocity;
    // Energy above rest: cos(alpha - r) - cos(alpha), without cancellation.
    let potential = 2.0 * (alpha - 0.5 * rotation).sin() * (0.5 * rotation).sin();
    let energy = kinetic + potential;
    let escapes = |energy: f64| energy > barrier(alpha);
    // Beyond the tipping point it overturns, unless it moves back with enough energy to pass that point.
    if rotation > alpha && (velocity >= 0.0 || !escapes(energy)) {
        return Tail::Overturns;
    }
    // If it moves back to its base, the energy after the impact decides.
    let energy = if velocity >= 0.0 { energy } else { eta * eta * energy };
    if escapes(energy) { Tail::Overturns } else { Tail::Settles(peak(energy, alpha)) }
}

/// Computes the energy from rest to the tipping point: 1 - cos(alpha).
fn barrier(alpha: f64) -> f64 {
    2.0 * (0.5 * alpha).sin().powi(2)
}

/// Computes the rotation r (rad) at which `energy`, at most the barrier, is all potential:
/// cos(alpha - r) - cos(alpha) = energy, as a difference of two inverse sines, precise for small rotations.
fn peak(energy: f64, alpha: f64) -> f64 {
    let a = (0.5 * alpha).sin();
    let b = (a * a - 0.5 * energy).max(0.0).sqrt();
    let difference = 0.5 * energy / (a * (1.0 - b * b).sqrt() + b * (1.0 - a * a).sqrt());
    2.0 * difference.min(1.0).asin()
}
