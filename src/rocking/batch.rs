//! Simulates structures and records, one in each lane of the processor's vector registers.

use pulp::WithSimd;

use super::lanes::{Lanes, each};
use super::record::Record;
use super::response::{Response, Tail, free_rocking};
use super::step::Events;
use super::structure::Structure;
use super::vector::Vector;
use crate::wide::{Simd, registers};

/// A structure, at rest at first, and the ground motion that shakes it.
#[derive(Debug, Clone, Copy)]
pub struct Problem<'a> {
    pub structure: &'a Structure,
    pub record: Record<'a>,
}

/// Simulates a structure, at rest at first, through a record and the free rocking that follows it.
pub fn simulate(structure: &Structure, record: &Record) -> Response {
    let problem = Problem { structure, record: *record };
    simulate_all(&[problem], Simd::Scalar)[0]
}

/// Simulates each problem, in order. Vector instructions do not change the responses.
pub fn simulate_all(problems: &[Problem], simd: Simd) -> Vec<Response> {
    registers(simd, Batch { problems })
}

struct Batch<'a> {
    problems: &'a [Problem<'a>],
}

impl WithSimd for Batch<'_> {
    type Output = Vec<Response>;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, registers: S) -> Vec<Response> {
        let mut queue = Queue::new(self.problems);
        let mut lanes = Lanes::new(registers);
        (0..Vector::<S>::LANES).for_each(|lane| queue.refill(lane, &mut lanes));
        while !lanes.are_idle() {
            let step = lanes.step();
            let events = lanes.advance(&step);
            if events.any() {
                queue.handle(events, &mut lanes);
            }
        }
        queue.responses
    }
}

/// The problems that wait for a lane, and the responses so far.
pub struct Queue<'a> {
    problems: &'a [Problem<'a>],
    next: usize,
    pub responses: Vec<Response>,
}

impl<'a> Queue<'a> {
    pub fn new(problems: &'a [Problem<'a>]) -> Queue<'a> {
        Queue { problems, next: 0, responses: vec![Response::NO_ROCKING; problems.len()] }
    }

    /// Finishes or restarts the lanes that cannot go on by themselves.
    #[inline(never)]
    pub fn handle<S: pulp::Simd>(&mut self, events: Events, lanes: &mut Lanes<'a, S>) {
        for lane in each(events.overturned) {
            self.finish(lane, Tail::Overturns, lanes);
        }
        for lane in each(events.ended) {
            let structure = self.problems[lanes.problem(lane)].structure;
            let tail = free_rocking(lanes.state(lane), structure.alpha_rad, structure.eta);
            self.finish(lane, tail, lanes);
        }
        for lane in each(events.rested) {
            if !lanes.leave_rest(lane) {
                self.finish(lane, Tail::Settles { peak: 0.0 }, lanes);
            }
        }
    }

    fn finish<S: pulp::Simd>(&mut self, lane: usize, tail: Tail, lanes: &mut Lanes<'a, S>) {
        let problem = lanes.problem(lane);
        let alpha = self.problems[problem].structure.alpha_rad;
        self.responses[problem] = Response::of_rocking(tail, lanes.peak(lane), alpha, lanes.impacts(lane));
        self.refill(lane, lanes);
    }

    /// Gives a lane the next problem in which the structure rocks.
    pub fn refill<S: pulp::Simd>(&mut self, lane: usize, lanes: &mut Lanes<'a, S>) {
        while let Some(Problem { structure, record }) = self.problems.get(self.next) {
            self.next += 1;
            if lanes.occupy(lane, self.next - 1, structure, record) {
                return;
            }
        }
        lanes.vacate(lane);
    }
}
