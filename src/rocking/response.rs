//! What a structure does in the end: the outcome, the demand, and free rocking after the record in closed form.

use std::f64::consts::FRAC_PI_2;

use super::taylor::State;
use crate::keyword::keywords;

/// The branch of the tree of Figure 6 that a structure takes in a ground motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// It never left its base.
    NoRocking,
    /// It rocked and came back.
    SafeRocking,
    /// Its rotation reached pi/2, or will after the record by its energy.
    Overturning,
}

keywords!(Outcome {
    NoRocking = "no_rocking",
    SafeRocking = "safe_rocking",
    Overturning = "overturning",
});

/// The response of one structure to one ground motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response {
    pub outcome: Outcome,
    /// Engineering demand parameter |theta|max / alpha (Eq. 7); where it overturns, pi / (2 alpha).
    pub edp: f64,
    /// Number of impacts during the record.
    pub impacts: u32,
}

impl Response {
    pub(super) const NO_ROCKING: Response = Response { outcome: Outcome::NoRocking, edp: 0.0, impacts: 0 };

    /// Makes the response of a structure of slenderness `alpha` that rocked up to `peak` (rad) during the record, and after it as
    /// `tail` says.
    pub(super) fn of_rocking(tail: Tail, peak: f64, alpha: f64, impacts: u32) -> Response {
        let (outcome, peak) = match tail {
            Tail::Overturns => (Outcome::Overturning, FRAC_PI_2),
            Tail::Settles { peak: later } => (Outcome::SafeRocking, peak.max(later)),
        };
        Response { outcome, edp: peak / alpha, impacts }
    }
}

/// How a structure that rocks at the end of the record ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tail {
    Overturns,
    /// It comes to rest; the largest rotation (rad) still to come.
    Settles {
        peak: f64,
    },
}

/// Decides by energy what follows the record for a structure of slenderness `alpha` (rad) and restitution `eta` in `state`.
///
/// The ground is at rest: between impacts v^2/2 + cos(alpha - r) is constant, with a barrier of height 1 at r = alpha. Each impact
/// takes the fraction 1 - eta^2 of the kinetic energy, so only the first peak and the one after the first impact can be the largest.
pub fn free_rocking(state: State, alpha: f64, eta: f64) -> Tail {
    let State { rotation, velocity } = state;
    let kinetic = 0.5 * velocity * velocity;
    // The energy above that at rest: cos(alpha - r) - cos(alpha), without cancellation.
    let potential = 2.0 * (alpha - 0.5 * rotation).sin() * (0.5 * rotation).sin();
    let energy = kinetic + potential;
    let escapes = energy > barrier(alpha);
    // Beyond the tipping point gravity overturns it, unless it swings back with enough energy to pass that point again.
    if rotation > alpha && (velocity >= 0.0 || !escapes) {
        return Tail::Overturns;
    }
    if velocity >= 0.0 {
        return if escapes { Tail::Overturns } else { Tail::Settles { peak: peak(energy, alpha) } };
    }
    // It swings back to its base: what is left after the impact decides.
    let energy_after_impact = eta * eta * energy;
    if energy_after_impact > barrier(alpha) {
        return Tail::Overturns;
    }
    Tail::Settles { peak: peak(energy_after_impact, alpha) }
}

/// Returns the energy that carries the structure over its tipping point: 1 - cos(alpha).
fn barrier(alpha: f64) -> f64 {
    2.0 * (0.5 * alpha).sin().powi(2)
}

/// Finds the rotation at which `energy`, not above the barrier, is all potential: cos(alpha - r) - cos(alpha) = energy,
/// solved as a difference of two inverse sines so that a small rotation keeps its precision.
fn peak(energy: f64, alpha: f64) -> f64 {
    let a = (0.5 * alpha).sin();
    let b = (a * a - 0.5 * energy).max(0.0).sqrt();
    let difference = 0.5 * energy / (a * (1.0 - b * b).sqrt() + b * (1.0 - a * a).sqrt());
    2.0 * difference.min(1.0).asin()
}
