//! The states of many structures, one in each lane of a vector, each at its own moment of its own record: rest, uplift, rocking. No
//! lane's arithmetic depends on what is in the others, nor on how many there are.

use pulp::Simd;

use super::record::Record;
use super::structure::Structure;
use super::taylor::{Slenderness, State};
use super::uplift::Uplift;
use super::vector::{MOST_LANES, Vector};
use crate::units::PER_G;

/// After this many impacts between two samples the structure rests until the next one: a bound of the work. It takes a coefficient
/// of restitution near 1 to come to this, and a velocity of some 1e-6 p.
const MOST_IMPACTS: u32 = 10_000;

/// The longest Taylor step, as p dt sqrt(1 + PGA/g). What order 8 leaves out of steps this long moves the peak of a
/// structure in white noise of 0.6 g by some 1e-12 of itself.
const LONGEST_STEP: f64 = 0.03;

/// A structure in each lane, somewhere between two samples of its record.
pub struct Lanes<'a, S: Simd> {
    pub(super) simd: S,
    /// The lanes in use, a bit for each.
    pub(super) busy: u32,
    /// Index of the problem.
    pub(super) problem: [usize; MOST_LANES],
    pub(super) samples: [&'a [f64]; MOST_LANES],
    /// Index of the last sample that has passed.
    pub(super) index: [usize; MOST_LANES],
    pub(super) slenderness: Slenderness<Vector<S>>,
    pub(super) eta: Vector<S>,
    /// p times the time step of the record.
    pub(super) p_dt: Vector<S>,
    /// Longest Taylor step, p dt.
    pub(super) longest: Vector<S>,
    pub(super) state: State<Vector<S>>,
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
    /// Index of the sample before the last impact, and the number of impacts since.
    impacts_after: [(usize, u32); MOST_LANES],
}

impl<'a, S: Simd> Lanes<'a, S> {
    pub fn new(simd: S) -> Lanes<'a, S> {
        let zero = Vector::splat(simd, 0.0);
        let mut lanes = Lanes {
            simd,
            busy: 0,
            problem: [0; MOST_LANES],
            samples: [&[]; MOST_LANES],
            index: [0; MOST_LANES],
            slenderness: Slenderness { tan: zero, sin: zero, cos: zero, secant: zero },
            eta: zero,
            p_dt: zero,
            longest: zero,
            state: State { rotation: zero, velocity: zero },
            side: zero,
            now: zero,
            next: zero,
            left: zero,
            per_left: zero,
            peak: zero,
            impacts: zero,
            impacts_after: [(0, 0); MOST_LANES],
        };
        (0..Vector::<S>::LANES).for_each(|lane| lanes.vacate(lane));
        lanes
    }

    pub fn are_idle(&self) -> bool {
        self.busy == 0
    }

    pub fn problem(&self, lane: usize) -> usize {
        self.problem[lane]
    }

    pub fn peak(&self, lane: usize) -> f64 {
        self.peak.lane(lane)
    }

    /// The sign of theta.
    pub fn side(&self, lane: usize) -> f64 {
        self.side.lane(lane)
    }

    /// Index of the last sample that has passed.
    pub fn index(&self, lane: usize) -> usize {
        self.index[lane]
    }

    /// Time since the first sample, in time steps of the record.
    pub fn steps(&self, lane: usize) -> f64 {
        self.index[lane] as f64 + (1.0 - self.left.lane(lane) / self.p_dt.lane(lane))
    }

    pub fn impacts(&self, lane: usize) -> u32 {
        self.impacts.lane(lane) as u32
    }

    pub fn state(&self, lane: usize) -> State {
        State { rotation: self.state.rotation.lane(lane), velocity: self.state.velocity.lane(lane) }
    }

    /// Puts a problem into a lane, at the first uplift of its structure. Returns false if it never uplifts.
    #[inline(never)]
    pub fn occupy(
        &mut self,
        lane: usize,
        problem: usize,
        structure: &Structure,
        record: &Record<'a>,
    ) -> bool {
        let slenderness = Slenderness::new(structure.alpha_rad);
        self.slenderness.tan.set(lane, slenderness.tan);
        self.slenderness.sin.set(lane, slenderness.sin);
        self.slenderness.cos.set(lane, slenderness.cos);
        self.slenderness.secant.set(lane, slenderness.secant);
        self.eta.set(lane, structure.eta);
        self.p_dt.set(lane, structure.p_rad_s * record.dt_s());
        self.longest.set(lane, LONGEST_STEP / (1.0 + record.peak_m_s2() * PER_G).sqrt());
        self.peak.set(lane, 0.0);
        self.impacts.set(lane, 0.0);
        self.problem[lane] = problem;
        self.impacts_after[lane] = (0, 0);
        self.samples[lane] = record.acceleration_m_s2();
        self.busy |= 1 << lane;
        self.start_at(lane, Uplift::next(record.acceleration_m_s2(), 0, slenderness.tan))
    }

    /// Advances a lane from rest to the next uplift. Returns false if there is none.
    #[inline(never)]
    pub fn leave_rest(&mut self, lane: usize) -> bool {
        let (samples, index, tan) = (self.samples[lane], self.index[lane], self.slenderness.tan.lane(lane));
        // A lane that has just arrived at its last sample.
        if index + 1 >= samples.len() {
            return false;
        }
        if self.impacts_after[lane].1 >= MOST_IMPACTS {
            self.impacts_after[lane] = (index, 0);
            return self.start_at(lane, Uplift::next(samples, index + 1, tan));
        }
        let (now, next) = (self.now.lane(lane), self.next.lane(lane) * PER_G);
        match Uplift::between(now, next, tan) {
            Some(uplift) => {
                let left = self.left.lane(lane) * (1.0 - uplift.fraction);
                self.start_at(lane, Some(Uplift { index, ..uplift }));
                self.set_left(lane, left);
                true
            }
            None => self.start_at(lane, Uplift::next(samples, index + 1, tan)),
        }
    }

    /// Counts an impact in some lanes. Returns those that have had [`MOST_IMPACTS`] since the last sample.
    #[inline(always)]
    pub(super) fn count_impacts(&mut self, struck: u32) -> u32 {
        each(struck).fold(0, |exhausted, lane| {
            let (after, count) = self.impacts_after[lane];
            let count = if after == self.index[lane] { count + 1 } else { 1 };
            self.impacts_after[lane] = (self.index[lane], count);
            exhausted | u32::from(count >= MOST_IMPACTS) << lane
        })
    }

    /// Puts a lane at the moment of an uplift, if there is one.
    fn start_at(&mut self, lane: usize, uplift: Option<Uplift>) -> bool {
        let Some(Uplift { index, fraction, ground }) = uplift else { return false };
        self.index[lane] = index;
        // It leans to the side opposite to the acceleration.
        self.side.set(lane, if ground > 0.0 { -1.0 } else { 1.0 });
        self.now.set(lane, ground);
        self.next.set(lane, self.samples[lane][index + 1]);
        self.set_left(lane, self.p_dt.lane(lane) * (1.0 - fraction));
        self.state.rotation.set(lane, 0.0);
        self.state.velocity.set(lane, 0.0);
        true
    }

    /// Sets the time left to the next sample, never to 0: an uplift so near to that sample that rounding leaves nothing has yet to
    /// reach it.
    fn set_left(&mut self, lane: usize, left: f64) {
        let left = left.max(self.p_dt.lane(lane) * f64::EPSILON);
        self.left.set(lane, left);
        self.per_left.set(lane, 1.0 / left);
    }

    /// Leaves a lane idle: it stands still and meets no event.
    pub fn vacate(&mut self, lane: usize) {
        self.busy &= !(1 << lane);
        self.samples[lane] = &[];
        self.index[lane] = 0;
        for still in [&mut self.p_dt, &mut self.left, &mut self.per_left, &mut self.state.velocity] {
            still.set(lane, 0.0);
        }
        self.state.rotation.set(lane, 0.5);
        self.peak.set(lane, 1.0);
    }
}

/// Iterates over the lanes whose bits are set.
pub fn each(bits: u32) -> impl Iterator<Item = usize> {
    let mut left = bits;
    std::iter::from_fn(move || {
        (left != 0).then(|| {
            let lane = left.trailing_zeros() as usize;
            left &= left - 1;
            lane
        })
    })
}
