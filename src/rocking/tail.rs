//! Free rocking after the ground has come to rest, in closed form by its energy.

use super::taylor::State;

/// What becomes of a structure that rocks on after the record.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tail {
    /// It overturns.
    Overturns,
    /// It comes to rest; the largest rotation (rad) still to come.
    Settles { peak: f64 },
}

/// The fate of a structure of slenderness `alpha` (rad) and restitution `eta` that leaves the record in `state`.
///
/// Between impacts v^2/2 + cos(alpha - r) is constant, with a barrier of height 1 at r = alpha. Each impact takes
/// the share 1 - eta^2 of the kinetic energy, so only the first peak and the one after the first impact can be the
/// largest.
pub fn free_rocking(state: State, alpha: f64, eta: f64) -> Tail {
    let State { rotation, velocity } = state;
    let kinetic = 0.5 * velocity * velocity;
    // The energy above that at rest: cos(alpha - r) - cos(alpha), without cancellation.
    let potential = 2.0 * libm::sin(alpha - 0.5 * rotation) * libm::sin(0.5 * rotation);
    let energy = kinetic + potential;
    let escapes = energy > barrier(alpha);
    if rotation > alpha && (velocity >= 0.0 || !escapes) {
        return Tail::Overturns;
    }
    if velocity >= 0.0 {
        return if escapes { Tail::Overturns } else { Tail::Settles { peak: peak(energy, alpha) } };
    }
    let energy_after_impact = eta * eta * energy;
    if energy_after_impact > barrier(alpha) {
        return Tail::Overturns;
    }
    Tail::Settles { peak: peak(energy_after_impact, alpha) }
}

/// The energy that carries the structure over its tipping point: 1 - cos(alpha).
fn barrier(alpha: f64) -> f64 {
    2.0 * libm::sin(0.5 * alpha).powi(2)
}

/// The rotation at which `energy`, not above the barrier, is all potential: cos(alpha - r) - cos(alpha) = energy,
/// solved as a difference of two inverse sines so that a small rotation keeps its precision.
fn peak(energy: f64, alpha: f64) -> f64 {
    let a = libm::sin(0.5 * alpha);
    let b = (a * a - 0.5 * energy).max(0.0).sqrt();
    let difference = 0.5 * energy / (a * (1.0 - b * b).sqrt() + b * (1.0 - a * a).sqrt());
    2.0 * libm::asin(difference.min(1.0))
}
