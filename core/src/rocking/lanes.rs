//! The states of many structures, one in each lane of a vector, each at its own moment of its own record:
//! rest, uplift, rocking. Lanes are independent of each other. A lane that is done takes the next problem.

use pulp::Simd;

use super::record::Record;
use super::response::{Response, free_rocking};
use super::structure::Structure;
use super::taylor::{MOST_IMPACTS, RockingState, Slenderness};
use super::uplift::Uplift;
use super::vector::{MOST_LANES, Vector};
use crate::units::G_PER_M_S2;

/// Longest Taylor step, as p dt sqrt(1 + PGA/g). With steps this long, truncation at order 8 changes the peak
/// of a structure in white noise of 0.6 g by about 1e-12 of itself.
const LONGEST_STEP: f64 = 0.03;

/// A structure, initially at rest, and its ground motion.
#[derive(Debug, Clone, Copy)]
pub struct Problem<'a> {
    pub structure: &'a Structure,
    pub record: Record<'a>,
}

/// The lanes with an event in a step, one bit for each.
#[derive(Debug, Clone, Copy, Default)]
pub struct Events {
    /// The record ended while the structure rocked.
    pub ended: u32,
    /// The structure came to rest after an impact.
    pub rested: u32,
    pub overturned: u32,
}

impl Events {
    pub fn any(&self) -> bool {
        self.ended | self.rested | self.overturned != 0
    }
}

/// A structure in each lane, somewhere between two samples of its record.
pub struct Lanes<'a, S: Simd> {
    pub(super) simd: S,
    problems: &'a [Problem<'a>],
    /// Index of the next problem.
    waiting: usize,
    pub(super) responses: Vec<Response>,
    /// The lanes in use, one bit for each.
    pub(super) busy: u32,
    problem: [usize; MOST_LANES],
    pub(super) samples: [&'a [f64]; MOST_LANES],
    /// Index of the last sample passed.
    pub(super) index: [usize; MOST_LANES],
    pub(super) slenderness: Slenderness<Vector<S>>,
    pub(super) eta: Vector<S>,
    /// p times the time step of the record.
    pub(super) p_dt: Vector<S>,
    /// Longest Taylor step, p dt.
    pub(super) longest: Vector<S>,
    pub(super) state: RockingState<Vector<S>>,
    /// The sign of theta.
    pub(super) side: Vector<S>,
    /// Ground acceleration over g now.
    pub(super) now: Vector<S>,
    /// Ground acceleration at the next sample, m/s2.
    pub(super) next: Vector<S>,
    /// p times the time to the next sample, and its inverse.
    pub(super) left: Vector<S>,
    pub(super) per_left: Vector<S>,
    /// Largest |theta| so far, rad.
    pub(super) peak: Vector<S>,
    pub(super) impacts: Vector<S>,
    /// Impacts since the last sample.
    pub(super) bounces: Vector<S>,
}

impl<'a, S: Simd> Lanes<'a, S> {
    pub fn new(simd: S, problems: &'a [Problem<'a>]) -> Lanes<'a, S> {
        let zero = Vector::splat(simd, 0.0);
        let mut lanes = Lanes {
            simd,
            problems,
            waiting: 0,
            responses: vec![Response::NO_ROCKING; problems.len()],
            busy: 0,
            problem: [0; MOST_LANES],
            samples: [&[]; MOST_LANES],
            index: [0; MOST_LANES],
            slenderness: Slenderness { tan: zero, sin: zero, cos: zero, secant: zero },
            eta: zero,
            p_dt: zero,
            longest: zero,
            state: RockingState { rotation: zero, velocity: zero },
            side: zero,
            now: zero,
            next: zero,
            left: zero,
            per_left: zero,
            peak: zero,
            impacts: zero,
            bounces: zero,
        };
        (0..Vector::<S>::LANES).for_each(|lane| lanes.refill(lane));
        lanes
    }

    #[inline(never)]
    pub fn handle(&mut self, events: Events) {
        for lane in set_bits(events.overturned) {
            self.finish(lane, None);
        }
        for lane in set_bits(events.ended) {
            let structure = self.problems[self.problem[lane]].structure;
            let (rotation, velocity) = (self.state.rotation.lane(lane), self.state.velocity.lane(lane));
            self.finish(
                lane,
                free_rocking(RockingState { rotation, velocity }, structure.alpha_rad, structure.eta),
            );
        }
        for lane in set_bits(events.rested) {
            if !self.leave_rest(lane) {
                self.finish(lane, Some(0.0));
            }
        }
    }

    /// Ends the response of a lane, with the largest rotation (rad) in free rocking, none if it overturns.
    fn finish(&mut self, lane: usize, later: Option<f64>) {
        let problem = self.problem[lane];
        let alpha = self.problems[problem].structure.alpha_rad;
        let (peak, impacts) = (self.peak.lane(lane), self.impacts.lane(lane) as u32);
        self.responses[problem] = Response::after_rocking(later, peak, alpha, impacts);
        self.refill(lane);
    }

    /// Starts the next problem that uplifts in a lane, at its first uplift. Without one the lane idles.
    fn refill(&mut self, lane: usize) {
        while let Some(problem) = self.problems.get(self.waiting) {
            (self.problem[lane], self.waiting) = (self.waiting, self.waiting + 1);
            if self.occupy(lane, problem) {
                self.busy |= 1 << lane;
                return;
            }
        }
        // An idle lane takes steps of no length, at a rotation above 0 and below its peak and pi/2: it never
        // strikes, overturns or peaks, and `busy` masks the end of its record. NaN compares false.
        self.busy &= !(1 << lane);
        self.samples[lane] = &[];
        self.index[lane] = 0;
        for still in [&mut self.p_dt, &mut self.left, &mut self.per_left, &mut self.state.velocity] {
            still.set(lane, 0.0);
        }
        self.state.rotation.set(lane, 0.5);
        self.peak.set(lane, 1.0);
    }

    /// Puts a problem into a lane. Returns false if its structure never uplifts.
    fn occupy(&mut self, lane: usize, Problem { structure, record }: &Problem<'a>) -> bool {
        let slenderness = Slenderness::new(structure.alpha_rad);
        self.slenderness.tan.set(lane, slenderness.tan);
        self.slenderness.sin.set(lane, slenderness.sin);
        self.slenderness.cos.set(lane, slenderness.cos);
        self.slenderness.secant.set(lane, slenderness.secant);
        self.eta.set(lane, structure.eta);
        self.p_dt.set(lane, structure.p_rad_s * record.dt_s());
        self.longest.set(lane, LONGEST_STEP / (1.0 + record.peak_m_s2() * G_PER_M_S2).sqrt());
        self.peak.set(lane, 0.0);
        self.impacts.set(lane, 0.0);
        self.bounces.set(lane, 0.0);
        self.samples[lane] = record.acceleration_m_s2();
        self.start_at(lane, Uplift::next(record.acceleration_m_s2(), 0, slenderness.tan))
    }

    /// Advances a lane from rest to the next uplift. Returns false if there is none.
    fn leave_rest(&mut self, lane: usize) -> bool {
        let (samples, index, tan) = (self.samples[lane], self.index[lane], self.slenderness.tan.lane(lane));
        // After the last sample the ground is still, and the structure stays at rest.
        if index + 1 >= samples.len() {
            return false;
        }
        let (now, next) = (self.now.lane(lane), self.next.lane(lane) * G_PER_M_S2);
        // A structure that strikes its base without end rests to the next sample.
        let soon =
            Uplift::between(now, next, tan).filter(|_| self.bounces.lane(lane) < f64::from(MOST_IMPACTS));
        let Some(uplift) = soon else {
            self.bounces.set(lane, 0.0);
            return self.start_at(lane, Uplift::next(samples, index + 1, tan));
        };
        // This is a fraction of the time left; `start_at` takes it as one of a whole step.
        let left = self.left.lane(lane) * (1.0 - uplift.fraction);
        self.start_at(lane, Some(Uplift { index, ..uplift }));
        self.set_left(lane, left);
        true
    }

    /// Puts a lane at an uplift. Returns false without one.
    fn start_at(&mut self, lane: usize, uplift: Option<Uplift>) -> bool {
        let Some(Uplift { index, fraction, ground }) = uplift else { return false };
        self.index[lane] = index;
        // The structure leans opposite to the acceleration.
        self.side.set(lane, -ground.signum());
        self.now.set(lane, ground);
        self.next.set(lane, self.samples[lane][index + 1]);
        self.set_left(lane, self.p_dt.lane(lane) * (1.0 - fraction));
        self.state.rotation.set(lane, 0.0);
        self.state.velocity.set(lane, 0.0);
        true
    }

    /// Sets the time left to the next sample, above 0 even for an uplift that rounds to that sample.
    fn set_left(&mut self, lane: usize, left: f64) {
        let left = left.max(self.p_dt.lane(lane) * f64::EPSILON);
        self.left.set(lane, left);
        self.per_left.set(lane, 1.0 / left);
    }
}

/// Iterates over the lanes whose bits are set.
pub fn set_bits(bits: u32) -> impl Iterator<Item = usize> {
    let later = |left: &u32| Some(left & (left - 1)).filter(|left| *left != 0);
    std::iter::successors((bits != 0).then_some(bits), later).map(|left| left.trailing_zeros() as usize)
}
