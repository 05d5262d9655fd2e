//! Callbacks for the events of a simulation, and the side to which a structure leans.

use super::taylor::State;

/// Callbacks for the events of a simulation. Times are in s from the start of the record, angles in rad.
pub trait Observer {
    /// Called when a structure at rest uplifts towards `side`.
    fn uplift(&mut self, _time_s: f64, _side: Side) {}
    /// Called when it strikes its base with the velocity `before` (rad, per unit of p t) and leaves it with `after`.
    fn impact(&mut self, _time_s: f64, _side: Side, _before: f64, _after: f64) {}
    /// Called when it stays on its base after an impact.
    fn rest(&mut self, _time_s: f64) {}
    /// Called when it has turned by pi/2, at `velocity`.
    fn overturn(&mut self, _time_s: f64, _side: Side, _velocity: f64) {}
    /// Called with the state at each sample of the record; `None` is rest.
    fn sample(&mut self, _index: usize, _rocking: Option<(Side, State)>) {}
}

/// The direction in which the structure leans.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// theta > 0.
    Positive,
    /// theta < 0.
    Negative,
}

impl Side {
    /// Returns +1 or -1, the sign of theta.
    pub fn sign(self) -> f64 {
        match self {
            Side::Positive => 1.0,
            Side::Negative => -1.0,
        }
    }

    pub fn other(self) -> Side {
        match self {
            Side::Positive => Side::Negative,
            Side::Negative => Side::Positive,
        }
    }

    /// Returns the side to which a structure uplifts: opposite to the acceleration `ground`.
    pub fn opposing(ground: f64) -> Side {
        if ground > 0.0 { Side::Negative } else { Side::Positive }
    }
}

/// The observer of a simulation of which only the response counts.
pub struct NoObserver;

impl Observer for NoObserver {}
