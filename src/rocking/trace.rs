//! The rotation of a structure over time.

use super::record::Record;
use crate::keyword::keywords;

keywords! {
    /// An event of a rocking structure in the solver.
    pub enum SolverEvent {
        /// The structure leaves its base.
        Uplift = "uplift",
        /// It strikes its base and continues on the other side.
        Impact = "impact",
        /// It comes to rest.
        Rest = "rest",
        /// Its rotation reaches pi/2.
        Overturn = "overturn",
    }
}

/// A point of a traced response: a sample of the record, or an event between two samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TracePoint {
    /// Time from the start of the record, s.
    pub time_s: f64,
    /// Rotation theta, rad.
    pub theta_rad: f64,
    /// Angular velocity, rad/s; after an impact, if there is one.
    pub theta_dot_rad_s: f64,
    /// Event; none at a sample of the record.
    pub solver_event: Option<SolverEvent>,
}

/// Appends `tail_s` seconds of zeros to a record, for free rocking. Returns the samples, m/s2.
pub fn with_tail(record: &Record, tail_s: f64) -> Vec<f64> {
    let quiet = (tail_s / record.dt_s()).ceil() as usize;
    [record.acceleration_m_s2(), &vec![0.0; quiet]].concat()
}
