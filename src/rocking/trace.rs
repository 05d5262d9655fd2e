//! The rotation of a structure over time: what [`simulate`](super::simulate) computes, at every sample and event.

use super::march::march;
use super::observer::{Observer, Side};
use super::record::Record;
use super::response::Response;
use super::structure::Structure;
use super::taylor::State;
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

/// Simulates as [`super::simulate`] does and keeps the response at every sample and event. The record ends with its
/// last sample; append zeros to it to see the free rocking that follows.
pub fn trace(structure: &Structure, record: &Record) -> (Response, Vec<TracePoint>) {
    let mut recorder = Recorder {
        dt_s: record.dt_s(),
        p_rad_s: structure.p_rad_s,
        points: Vec::with_capacity(record.acceleration_m_s2().len()),
    };
    let response = march(structure, record, &mut recorder);
    (response, recorder.points)
}

/// Appends `tail_s` (s, 0 or more) of zeros to a record, in which free rocking shows.
pub fn with_tail(record: &Record, tail_s: f64) -> Vec<f64> {
    let quiet = (tail_s / record.dt_s()).ceil() as usize;
    [record.acceleration_m_s2(), &vec![0.0; quiet]].concat()
}

struct Recorder {
    dt_s: f64,
    p_rad_s: f64,
    points: Vec<TracePoint>,
}

impl Recorder {
    fn push(&mut self, time_s: f64, side: Side, rotation: f64, velocity: f64, event: Option<SolverEvent>) {
        self.points.push(TracePoint {
            time_s,
            theta_rad: side.sign() * rotation,
            theta_dot_rad_s: side.sign() * velocity * self.p_rad_s,
            solver_event: event,
        });
    }
}

impl Observer for Recorder {
    fn uplift(&mut self, time_s: f64, side: Side) {
        self.push(time_s, side, 0.0, 0.0, Some(SolverEvent::Uplift));
    }

    fn impact(&mut self, time_s: f64, side: Side, _before: f64, after: f64) {
        // Leaving for the other side, the structure keeps the direction in which it turns.
        self.push(time_s, side, 0.0, -after, Some(SolverEvent::Impact));
    }

    fn rest(&mut self, time_s: f64) {
        self.push(time_s, Side::Positive, 0.0, 0.0, Some(SolverEvent::Rest));
    }

    fn overturn(&mut self, time_s: f64, side: Side, velocity: f64) {
        self.push(time_s, side, std::f64::consts::FRAC_PI_2, velocity, Some(SolverEvent::Overturn));
    }

    fn sample(&mut self, index: usize, rocking: Option<(Side, State)>) {
        let resting = (Side::Positive, State { rotation: 0.0, velocity: 0.0 });
        let (side, State { rotation, velocity }) = rocking.unwrap_or(resting);
        self.push(index as f64 * self.dt_s, side, rotation, velocity, None);
    }
}
