//! The rotation of a structure over time: what [`simulate`](super::simulate) computes, at every sample and event.

use std::f64::consts::FRAC_PI_2;

use pulp::WithSimd;

use super::batch::{Problem, Queue};
use super::lanes::Lanes;
use super::record::Record;
use super::response::Response;
use super::step::Step;
use super::structure::Structure;
use super::taylor::State;
use crate::keyword::keywords;
use crate::wide::{Simd, registers};

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
    registers(Simd::Scalar, Traced { problem: Problem { structure, record: *record } })
}

/// Appends `tail_s` (s, 0 or more) of zeros to a record, in which free rocking shows.
pub fn with_tail(record: &Record, tail_s: f64) -> Vec<f64> {
    let quiet = (tail_s / record.dt_s()).ceil() as usize;
    [record.acceleration_m_s2(), &vec![0.0; quiet]].concat()
}

/// A problem, to be solved in the first lane.
struct Traced<'a> {
    problem: Problem<'a>,
}

const LANE: usize = 0;

impl WithSimd for Traced<'_> {
    type Output = (Response, Vec<TracePoint>);

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, registers: S) -> Self::Output {
        let problems = [self.problem];
        let (mut queue, mut lanes) = (Queue::new(&problems), Lanes::new(registers));
        let mut recorder = Recorder { problem: self.problem, samples: 0, points: Vec::new() };
        queue.refill(LANE, &mut lanes);
        recorder.rest(&lanes);
        while !lanes.are_idle() {
            let (steps, side, impacts) = (lanes.steps(LANE), lanes.side(LANE), lanes.impacts(LANE));
            let step = lanes.step();
            let events = lanes.advance(&step);
            if events.overturned != 0 {
                recorder.overturn(steps, side, &step);
            } else {
                recorder.rock(&lanes, lanes.impacts(LANE) > impacts, events.rested != 0);
            }
            if events.any() {
                queue.handle(events, &mut lanes);
            }
            if events.rested != 0 {
                recorder.rest(&lanes);
            }
        }
        (queue.responses[0], recorder.points)
    }
}

struct Recorder<'a> {
    problem: Problem<'a>,
    /// Samples of the record that have passed.
    samples: usize,
    points: Vec<TracePoint>,
}

impl Recorder<'_> {
    /// Keeps a moment, `steps` time steps after the first sample, of a state whose velocity is per p t.
    fn push(&mut self, steps: f64, side: f64, state: State, event: Option<SolverEvent>) {
        let Problem { structure, record } = self.problem;
        self.points.push(TracePoint {
            time_s: steps * record.dt_s(),
            theta_rad: side * state.rotation,
            theta_dot_rad_s: side * state.velocity * structure.p_rad_s,
            solver_event: event,
        });
    }

    fn sample(&mut self, side: f64, state: State) {
        self.push(self.samples as f64, side, state, None);
        self.samples += 1;
    }

    /// Keeps the rest up to the next uplift, or to the end of the record.
    fn rest<S: pulp::Simd>(&mut self, lanes: &Lanes<S>) {
        let idle = lanes.are_idle();
        let last = if idle { self.problem.record.acceleration_m_s2().len() - 1 } else { lanes.index(LANE) };
        while self.samples <= last {
            self.sample(1.0, RESTING);
        }
        if !idle {
            self.push(lanes.steps(LANE), 1.0, RESTING, Some(SolverEvent::Uplift));
        }
    }

    /// Keeps the end of a step: an impact, after which the structure may rest, or a sample.
    fn rock<S: pulp::Simd>(&mut self, lanes: &Lanes<S>, strikes: bool, rests: bool) {
        let (steps, side, state) = (lanes.steps(LANE), lanes.side(LANE), lanes.state(LANE));
        if strikes {
            self.push(steps, side, state, Some(SolverEvent::Impact));
        }
        if rests {
            self.push(steps, 1.0, RESTING, Some(SolverEvent::Rest));
        } else if lanes.index(LANE) == self.samples {
            self.sample(side, state);
        }
    }

    /// Keeps the moment of overturning during a step that starts at `steps`.
    fn overturn<S: pulp::Simd>(&mut self, steps: f64, side: f64, step: &Step<S>) {
        if let Some(x) = step.overturning(LANE) {
            let Problem { structure, record } = self.problem;
            let (p_t, velocity) = step.at(LANE, x);
            let steps = steps + p_t / (structure.p_rad_s * record.dt_s());
            self.push(steps, side, State { rotation: FRAC_PI_2, velocity }, Some(SolverEvent::Overturn));
        }
    }
}

const RESTING: State = State { rotation: 0.0, velocity: 0.0 };
