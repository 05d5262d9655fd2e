//! The outcome, the demand, and free rocking after the record in closed form.

use super::taylor::RockingState;

/// The outcome of one structure under one ground motion (Figure 6).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outcome {
    NoRocking,
    /// The structure rocks and comes to rest. The demand is |theta|max / alpha (Eq. 7).
    SafeRocking(f64),
    /// Its rotation reaches pi/2, in the record or, by its energy, after it.
    Overturned,
}

impl Outcome {
    /// Returns the demand |theta|max / alpha (Eq. 7): 0 without rocking, none after overturning.
    pub fn demand(self) -> Option<f64> {
        match self {
            Outcome::NoRocking => Some(0.0),
            Outcome::SafeRocking(demand) => Some(demand),
            Outcome::Overturned => None,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response {
    pub outcome: Outcome,
    /// Number of impacts during the record and, where one is traced, the still time after it.
    pub impacts: u32,
}

impl Response {
    pub(super) const NO_ROCKING: Response = Response { outcome: Outcome::NoRocking, impacts: 0 };

    /// Computes the response of a structure of slenderness `alpha` (rad) that rocks, from the largest
    /// rotation `peak` (rad) and the number of impacts, and the largest rotation `later` (rad) in the
    /// free rocking after the record; none if it overturns.
    pub(super) fn after_rocking(later: Option<f64>, peak: f64, alpha: f64, impacts: u32) -> Response {
        let safe = later.map(|later| Outcome::SafeRocking(peak.max(later) / alpha));
        Response { outcome: safe.unwrap_or(Outcome::Overturned), impacts }
    }
}

/// Finds the largest rotation (rad) in free rocking after the record by energy, for a structure of
/// slenderness `alpha` (rad) and restitution `eta` in `state` at the end of the record; none if it overturns.
///
/// On still ground v^2/2 + cos(alpha - r) is constant between impacts, with a barrier of height 1 at
/// r = alpha. Each impact removes the fraction 1 - eta^2 of the kinetic energy, so that only the first peak
/// and the one after the first impact can be the largest.
pub fn free_rocking(state: RockingState, alpha: f64, eta: f64) -> Option<f64> {
    let RockingState { rotation, velocity } = state;
    let kinetic = 0.5 * velocity * velocity;
    // Energy above rest: cos(alpha - r) - cos(alpha), without cancellation.
    let potential = 2.0 * (alpha - 0.5 * rotation).sin() * (0.5 * rotation).sin();
    let energy = kinetic + potential;
    // The energy from rest to the tipping point: 1 - cos(alpha).
    let barrier = 2.0 * (0.5 * alpha).sin().powi(2);
    // Beyond the tipping point it overturns, unless it moves back with enough energy to pass that point.
    if rotation > alpha && (velocity >= 0.0 || energy <= barrier) {
        return None;
    }
    // If it moves back to its base, the energy after the impact decides.
    let energy = if velocity >= 0.0 { energy } else { eta * eta * energy };
    (energy <= barrier).then(|| peak(energy, alpha))
}

/// Computes the rotation r (rad) at which `energy`, at most the barrier, is all potential:
/// cos(alpha - r) - cos(alpha) = energy, as a difference of two inverse sines, precise for small rotations.
fn peak(energy: f64, alpha: f64) -> f64 {
    let a = (0.5 * alpha).sin();
    let b = (a * a - 0.5 * energy).max(0.0).sqrt();
    let difference = 0.5 * energy / (a * (1.0 - b * b).sqrt() + b * (1.0 - a * a).sqrt());
    2.0 * difference.min(1.0).asin()
}
