//! The rotation of a structure over time.

use super::record::Record;
use crate::keyword::keywords;

/// What happens to a rocking structure at a moment, as the solver finds it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SolverEvent {
    /// It leaves its base.
    Uplift,
    /// It strikes its base and goes over to the other side.
    Impact,
    /// It stays on its base.
    Rest,
    /// Its rotation reaches pi/2.
    Overturn,
}

keywords!(SolverEvent { Uplift = "uplift", Impact = "impact", Rest = "rest", Overturn = "overturn" });

/// A moment of a traced response: a sample of the record, or an event between two of them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TracePoint {
    /// Time from the start of the record, s.
    pub time_s: f64,
    /// Rotation theta, rad.
    pub theta_rad: f64,
    /// Angular velocity, rad/s; at an impact, that after it.
    pub theta_dot_rad_s: f64,
    /// What happens here; none at a sample of the record.
    pub solver_event: Option<SolverEvent>,
}

/// Appends `tail_s` (s, 0 or more) of zeros to a record, in which free rocking shows.
pub fn with_tail(record: &Record, tail_s: f64) -> Vec<f64> {
    let quiet = (tail_s / record.dt_s()).ceil() as usize;
    [record.acceleration_m_s2(), &vec![0.0; quiet]].concat()
}
