use std::f64::consts::FRAC_PI_2;

use super::tail::Tail;
use crate::keyword::keywords;

/// How a structure came through a ground motion.
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
    /// Which branch of the tree of Figure 6 it took.
    pub outcome: Outcome,
    /// Engineering demand parameter |theta|max / alpha (Eq. 7); where it overturns, pi / (2 alpha).
    pub edp: f64,
    /// Impacts within the duration of the record.
    pub impacts: u32,
}

impl Response {
    pub(super) const NO_ROCKING: Response = Response { outcome: Outcome::NoRocking, edp: 0.0, impacts: 0 };

    /// Of a structure of slenderness `alpha` that rocked up to `peak` (rad) until the end of the record, and has a tail.
    pub(super) fn of_rocking(tail: Tail, peak: f64, alpha: f64, impacts: u32) -> Response {
        let (outcome, peak) = match tail {
            Tail::Overturns => (Outcome::Overturning, FRAC_PI_2),
            Tail::Settles { peak: later } => (Outcome::SafeRocking, peak.max(later)),
        };
        Response { outcome, edp: peak / alpha, impacts }
    }
}
