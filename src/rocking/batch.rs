//! Simulates many structures and records at once, one in each lane of the processor's vector registers.

use pulp::WithSimd;

use super::lane_step::Events;
use super::lanes::{Lanes, each};
use super::march::simulate;
use super::real::Vector;
use super::record::Record;
use super::response::{Response, Tail, free_rocking};
use super::structure::Structure;
use crate::keyword::keywords;

/// A structure, at rest at first, and the ground motion that shakes it.
#[derive(Debug, Clone, Copy)]
pub struct Problem<'a> {
    pub structure: &'a Structure,
    pub record: Record<'a>,
}

/// The vector instructions of the solver. AVX2 and AVX-512 give the same bits; the scalar code differs from them by rounding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Simd {
    /// One problem at a time.
    Scalar,
    /// Four problems in a register of 256 bits.
    Avx2,
    /// Eight problems in a register of 512 bits.
    Avx512,
}

keywords!(Simd { Scalar = "scalar", Avx2 = "avx2", Avx512 = "avx512" });

impl Simd {
    /// Returns the widest that this processor has.
    pub fn fastest() -> Simd {
        [Simd::Avx512, Simd::Avx2].into_iter().find(|simd| simd.is_available()).unwrap_or(Simd::Scalar)
    }

    /// Whether this processor has the registers.
    pub fn is_available(self) -> bool {
        match self {
            Simd::Scalar => true,
            #[cfg(target_arch = "x86_64")]
            Simd::Avx2 => pulp::x86::V3::try_new().is_some(),
            #[cfg(target_arch = "x86_64")]
            Simd::Avx512 => pulp::x86::V4::try_new().is_some(),
            #[cfg(not(target_arch = "x86_64"))]
            Simd::Avx2 | Simd::Avx512 => false,
        }
    }

    /// Names what decides the bits of the results: `scalar` or `vector`.
    pub fn arithmetic(self) -> &'static str {
        match self {
            Simd::Scalar => "scalar",
            Simd::Avx2 | Simd::Avx512 => "vector",
        }
    }
}

/// Simulates each problem, in order, as [`simulate`] does. Falls back to the scalar code where the processor lacks `simd`.
pub fn simulate_all(problems: &[Problem], simd: Simd) -> Vec<Response> {
    let batch = Batch { problems };
    #[cfg(target_arch = "x86_64")]
    match simd {
        Simd::Scalar => {}
        Simd::Avx2 => {
            if let Some(machine) = pulp::x86::V3::try_new() {
                return pulp::Simd::vectorize(machine, batch);
            }
        }
        Simd::Avx512 => {
            if let Some(machine) = pulp::x86::V4::try_new() {
                return pulp::Simd::vectorize(machine, batch);
            }
        }
    }
    batch.problems.iter().map(|problem| simulate(problem.structure, &problem.record)).collect()
}

struct Batch<'a> {
    problems: &'a [Problem<'a>],
}

impl WithSimd for Batch<'_> {
    type Output = Vec<Response>;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, registers: S) -> Vec<Response> {
        let mut queue = Queue {
            problems: self.problems,
            next: 0,
            responses: vec![Response::NO_ROCKING; self.problems.len()],
        };
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
struct Queue<'a> {
    problems: &'a [Problem<'a>],
    next: usize,
    responses: Vec<Response>,
}

impl<'a> Queue<'a> {
    /// Finishes or restarts the lanes that cannot go on by themselves.
    #[inline(never)]
    fn handle<S: pulp::Simd>(&mut self, events: Events, lanes: &mut Lanes<'a, S>) {
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
    fn refill<S: pulp::Simd>(&mut self, lane: usize, lanes: &mut Lanes<'a, S>) {
        while let Some(Problem { structure, record }) = self.problems.get(self.next) {
            self.next += 1;
            if lanes.occupy(lane, self.next - 1, structure, record) {
                return;
            }
        }
        lanes.vacate(lane);
    }
}
