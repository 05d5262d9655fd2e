//! Structures side by side, one in each lane of a vector, each on its own way through its own record.
//!
//! A step does for all lanes what [`super::march`] does for one: the Taylor polynomial to the next sample, its first root if
//! it strikes before, the peak. What is rare (several roots, a new peak within a step, overturning) is left to the scalar
//! code for the lane that needs it. No lane's arithmetic depends on what is in the others.

use std::f64::consts::FRAC_PI_2;

use pulp::Simd;

use super::lane_roots::{count, deflated, falling_root};
use super::march::{REST_VELOCITY, first_impact, first_overturning, largest, longest_step};
use super::observer::Side;
use super::polynomial::{self, Polynomial};
use super::real::Real;
use super::record::Record;
use super::structure::Structure;
use super::taylor::{Excess, Slenderness, State, series};
use super::uplift::{Uplift, next_uplift};
use super::vector::{MOST_LANES, Mask, Vector};
use crate::units::PER_G;

/// What happened in the lanes during a step, a bit for each.
#[derive(Debug, Clone, Copy, Default)]
pub struct Events {
    /// The record is over while the structure rocks.
    pub ended: u32,
    /// It came to rest after an impact.
    pub rested: u32,
    /// It overturned.
    pub overturned: u32,
}

impl Events {
    pub fn any(&self) -> bool {
        self.ended | self.rested | self.overturned != 0
    }
}

/// A structure in each lane, somewhere between two samples of its record.
pub struct Lanes<'a, S: Simd> {
    simd: S,
    /// The lanes in use, a bit for each.
    busy: u32,
    /// The number of the problem.
    problem: [usize; MOST_LANES],
    samples: [&'a [f64]; MOST_LANES],
    /// The last sample that has passed.
    index: [usize; MOST_LANES],
    slenderness: Slenderness<Vector<S>>,
    eta: Vector<S>,
    /// p times the time between samples.
    p_dt: Vector<S>,
    /// The longest step.
    longest: Vector<S>,
    state: State<Vector<S>>,
    /// The sign of theta.
    side: Vector<S>,
    /// Ground acceleration over g.
    now: Vector<S>,
    /// Ground acceleration at the next sample, m/s2.
    next: Vector<S>,
    /// p times the time to the next sample, and its inverse.
    left: Vector<S>,
    per_left: Vector<S>,
    /// The largest |theta| so far, rad.
    peak: Vector<S>,
    impacts: Vector<S>,
}

/// A Taylor step from where the lanes stand.
pub struct Step<S: Simd> {
    rotation: Polynomial<Vector<S>>,
    /// The inverse of its length in p t, and its share of the time to the next sample.
    per_h: Vector<S>,
    share: Vector<S>,
    end: State<Vector<S>>,
    /// Bounds of the rotation.
    low: Vector<S>,
    high: Vector<S>,
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
        };
        (0..S::F64_LANES).for_each(|lane| lanes.vacate(lane));
        lanes
    }

    pub fn are_idle(&self) -> bool {
        self.busy == 0
    }

    /// The number of the problem in a lane.
    pub fn problem(&self, lane: usize) -> usize {
        self.problem[lane]
    }

    /// The largest |theta| of a lane so far, rad.
    pub fn peak(&self, lane: usize) -> f64 {
        self.peak.lane(lane)
    }

    /// The impacts of a lane so far.
    pub fn impacts(&self, lane: usize) -> u32 {
        self.impacts.lane(lane) as u32
    }

    /// The rotation and velocity of a lane.
    pub fn state(&self, lane: usize) -> State {
        State { rotation: self.state.rotation.lane(lane), velocity: self.state.velocity.lane(lane) }
    }

    /// Puts a problem into a lane, where its structure first uplifts; false if it never does.
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
        self.longest.set(lane, longest_step(record));
        self.peak.set(lane, 0.0);
        self.impacts.set(lane, 0.0);
        self.problem[lane] = problem;
        self.samples[lane] = record.acceleration_m_s2();
        self.busy |= 1 << lane;
        self.rise(lane, next_uplift(record.acceleration_m_s2(), 0, slenderness.tan))
    }

    /// From rest on; false if the lane rests to the end.
    #[inline(never)]
    pub fn leave_rest(&mut self, lane: usize) -> bool {
        let (samples, index, tan) = (self.samples[lane], self.index[lane], self.slenderness.tan.lane(lane));
        // A lane that has just arrived at its last sample.
        if index + 1 >= samples.len() {
            return false;
        }
        let (now, next) = (self.now.lane(lane), self.next.lane(lane) * PER_G);
        match Uplift::between(now, next, tan) {
            Some(uplift) => {
                let left = self.left.lane(lane) * (1.0 - uplift.share);
                self.rise(lane, Some(Uplift { index, ..uplift }));
                self.set_left(lane, left);
                true
            }
            None => self.rise(lane, next_uplift(samples, index + 1, tan)),
        }
    }

    /// At rest at the moment of an uplift after a sample, if there is one.
    fn rise(&mut self, lane: usize, uplift: Option<Uplift>) -> bool {
        let Some(Uplift { index, share, ground }) = uplift else { return false };
        self.index[lane] = index;
        self.side.set(lane, Side::opposing(ground).sign());
        self.now.set(lane, ground);
        self.next.set(lane, self.samples[lane][index + 1]);
        self.set_left(lane, self.p_dt.lane(lane) * (1.0 - share));
        self.state.rotation.set(lane, 0.0);
        self.state.velocity.set(lane, 0.0);
        true
    }

    fn set_left(&mut self, lane: usize, left: f64) {
        self.left.set(lane, left);
        self.per_left.set(lane, 1.0 / left);
    }

    /// Leaves a lane idle: it holds still and meets no event.
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

    /// The Taylor polynomials from where the lanes stand to their next samples, or as far as the series holds.
    #[inline(always)]
    pub fn step(&self) -> Step<S> {
        let (zero, one) = (Vector::splat(self.simd, 0.0), Vector::splat(self.simd, 1.0));
        let next = self.next * PER_G;
        let (mut share, mut h, mut per_h, mut ground) = (one, self.left, self.per_left, next);
        let far = self.longest.lt(self.left);
        if far.any() {
            share = far.select(self.longest * self.per_left, one);
            h = far.select(self.longest, self.left);
            per_h = far.select(one / self.longest, self.per_left);
            ground = far.select(share.mul_add(next - self.now, self.now), next);
        }
        let tan = self.slenderness.tan;
        let excess = Excess { start: self.side.mul_add(self.now, tan), end: self.side.mul_add(ground, tan) };
        let r = series(&self.slenderness, excess, self.state, h);

        let mut rise = r[1].max(zero);
        for coefficient in &r[2..] {
            rise = rise + coefficient.max(zero);
        }
        let rotation = polynomial::value(&r, one);
        let velocity = polynomial::slope(&r, one) * per_h;
        Step {
            rotation: r,
            per_h,
            share,
            end: State { rotation: rotation.max(zero), velocity },
            low: rotation - rise,
            high: r[0] + rise,
        }
    }

    /// Takes a step as far as the first impact in it.
    #[inline(always)]
    pub fn advance(&mut self, step: &Step<S>) -> Events {
        let one = Vector::splat(self.simd, 1.0);
        let mut events = Events::default();
        let zero = Vector::splat(self.simd, 0.0);
        let doubtful = step.low.le(zero);
        let struck = if doubtful.any() { self.impact(step, doubtful) } else { None };
        let until = struck.as_ref().map_or(one, |struck| struck.until);
        self.state = step.end;
        if Vector::splat(self.simd, FRAC_PI_2).le(step.high).any() {
            events.overturned = self.overturned(step, until);
        }
        if self.peak.lt(step.high).any() {
            self.raise_peak(step, until);
        }
        let passed = until * step.share;
        let within = passed.lt(one);
        let arrived = !within.bits();
        let next = self.next * PER_G;
        self.now = within.select(passed.mul_add(next - self.now, self.now), next);
        self.left = within.select((one - passed) * self.left, self.p_dt);
        self.per_left = one / self.left;
        if let Some(Struck { lanes, velocity, .. }) = struck {
            let after = -(velocity * self.eta);
            self.state.rotation = lanes.select(zero, self.state.rotation);
            self.state.velocity = lanes.select(after, self.state.velocity);
            self.side = lanes.select(-self.side, self.side);
            self.impacts = self.impacts + lanes.select(one, zero);
            events.rested = (lanes & after.lt(Vector::splat(self.simd, REST_VELOCITY))).bits();
        }
        events.ended = self.pass_samples(arrived) & self.busy & !(events.overturned | events.rested);
        events
    }

    /// The lanes of `doubtful` that strike during a step.
    #[inline(always)]
    fn impact(&self, step: &Step<S>, doubtful: Mask<S>) -> Option<Struck<S>> {
        let (zero, one) = (Vector::splat(self.simd, 0.0), Vector::splat(self.simd, 1.0));
        let c = deflated(&step.rotation, step.rotation[0].equals(zero));
        let roots = count(&c);
        let mut lanes = roots.one & doubtful;
        let mut until = one;
        if lanes.any() {
            until = lanes.select(falling_root(&c, lanes), one);
        }
        for lane in each((roots.unclear & doubtful).bits()) {
            if let Some(x) = first_impact(&of_lane(&step.rotation, lane)) {
                until.set(lane, x);
                lanes = lanes | Mask::of_lane(self.simd, lane);
            }
        }
        let velocity = polynomial::slope(&step.rotation, until) * step.per_h;
        lanes.any().then_some(Struck { lanes, until, velocity })
    }

    #[inline(never)]
    fn overturned(&self, step: &Step<S>, until: Vector<S>) -> u32 {
        let high = Vector::splat(self.simd, FRAC_PI_2).le(step.high).bits() & self.busy;
        let falls = |lane: &usize| {
            first_overturning(&of_lane(&step.rotation, *lane)).is_some_and(|x| x <= until.lane(*lane))
        };
        each(high).filter(falls).fold(0, |bits, lane| bits | 1 << lane)
    }

    /// Raises the peak of the lanes that come higher than ever.
    #[inline(always)]
    fn raise_peak(&mut self, step: &Step<S>, until: Vector<S>) {
        let zero = Vector::splat(self.simd, 0.0);
        let r = &step.rotation;
        let (mut least, mut most) = (r[1], r[1]);
        for (k, &coefficient) in r.iter().enumerate().skip(2) {
            let rate = coefficient * k as f64;
            least = least + rate.min(zero);
            most = most + rate.max(zero);
        }
        let (rising, falling) = (zero.le(least), most.le(zero));
        let higher = self.peak.lt(step.high);
        self.peak = (higher & rising).select(self.peak.max(step.end.rotation), self.peak);
        for lane in each((higher & !rising & !falling).bits()) {
            let top = largest(&of_lane(r, lane), until.lane(lane));
            self.peak.set(lane, self.peak.lane(lane).max(top));
        }
    }

    /// Counts the samples at which lanes have `arrived` and looks up the next ones; the lanes at their last sample.
    #[inline(always)]
    fn pass_samples(&mut self, arrived: u32) -> u32 {
        let mut ended = 0;
        let mut next = [0.0; MOST_LANES];
        for (lane, next) in next.iter_mut().enumerate().take(S::F64_LANES) {
            let ahead = self.index[lane] + 1 + (arrived >> lane & 1) as usize;
            self.index[lane] = ahead - 1;
            let sample = self.samples[lane].get(ahead);
            ended |= u32::from(sample.is_none()) << lane;
            *next = sample.copied().unwrap_or(0.0);
        }
        self.next = Vector::of(self.simd, &next);
        ended
    }
}

/// Impacts during a step.
struct Struck<S: Simd> {
    /// The lanes that strike.
    lanes: Mask<S>,
    /// The share of the step that passes before, 1 in the other lanes.
    until: Vector<S>,
    /// The velocity at that moment.
    velocity: Vector<S>,
}

/// The lanes whose bits are set.
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

fn of_lane<S: Simd>(c: &Polynomial<Vector<S>>, lane: usize) -> Polynomial {
    std::array::from_fn(|k| c[k].lane(lane))
}
