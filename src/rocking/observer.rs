use super::taylor::State;

/// Someone who looks on while a structure rocks. Times in s from the start of the record, angles in rad.
pub trait Observer {
    /// A structure at rest uplifts towards `side`.
    fn uplift(&mut self, _time_s: f64, _side: Side) {}
    /// It strikes its base with the velocity `before` (rad, per unit of p t) and leaves it with `after`.
    fn impact(&mut self, _time_s: f64, _side: Side, _before: f64, _after: f64) {}
    /// It stays on its base after an impact.
    fn rest(&mut self, _time_s: f64) {}
    /// It has turned by pi/2, at `velocity`.
    fn overturn(&mut self, _time_s: f64, _side: Side, _velocity: f64) {}
    /// The state at a sample of the record; `None` is rest.
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
    /// +1 or -1, the sign of theta.
    pub fn sign(self) -> f64 {
        match self {
            Side::Positive => 1.0,
            Side::Negative => -1.0,
        }
    }

    /// That of the next rocking.
    pub fn other(self) -> Side {
        match self {
            Side::Positive => Side::Negative,
            Side::Negative => Side::Positive,
        }
    }

    /// The ground throws the structure to the side it does not accelerate to.
    pub fn opposing(ground: f64) -> Side {
        if ground > 0.0 { Side::Negative } else { Side::Positive }
    }
}

/// Nobody looks on: only the response counts.
pub struct Unobserved;

impl Observer for Unobserved {}
