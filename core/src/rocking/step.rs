//! One step of all lanes: the Taylor polynomial to the next sample, its first root if the structure strikes
//! its base before, the impact, the peak, overturning. Where curvature or slope keeps its sign over the step,
//! which is nearly always, its ends suffice; the other lanes are solved one by one. `tests/solver/truth.rs`
//! compares this with quadruple precision.

use std::f64::consts::FRAC_PI_2;

use pulp::Simd;

use super::lanes::{Events, Lanes, set_bits};
use super::polynomial::{ORDER, Polynomial};
use super::roots::{falling_root, first_impact, first_overturning, largest, slopes, values};
use super::taylor::{Excess, MOST_IMPACTS, REST_VELOCITY, RockingState, series};
use super::vector::{Mask, Vector};
use crate::units::G_PER_M_S2;

/// One Taylor step of each lane.
pub struct Step<S: Simd> {
    rotation: Polynomial<Vector<S>>,
    /// Inverse of its length in p t.
    per_h: Vector<S>,
    /// Its share of the time to the next sample.
    fraction: Vector<S>,
    /// Rotation at its end; negative if the structure strikes its base before.
    last: Vector<S>,
    /// State at its end, without an impact.
    end: RockingState<Vector<S>>,
    /// Bounds of the rotation over the step.
    low: Vector<S>,
    high: Vector<S>,
    /// The lanes whose curvature is negative, or nowhere negative, over the step.
    concave: Mask<S>,
    convex: Mask<S>,
}

impl<S: Simd> Step<S> {
    /// Finds the lanes of `wanted` whose curvature or slope keeps its sign over the step. The slope is used
    /// only where the curvature changes sign.
    #[inline(always)]
    fn keeps_a_sign(&self, wanted: Mask<S>) -> Mask<S> {
        let curvature = self.concave | self.convex;
        if !(wanted & !curvature).any() {
            return curvature;
        }
        // Upper bound of the change of the slope.
        let r = &self.rotation;
        let mut change = r[0].like(0.0);
        for (k, coefficient) in r.iter().enumerate().skip(2) {
            change = coefficient.abs().mul_add(r[0].like(k as f64), change);
        }
        curvature | change.le(r[1].abs())
    }
}

impl<S: Simd> Lanes<'_, S> {
    /// Expands the rotation to the next sample of each lane, or as far as the series converges.
    #[inline(always)]
    pub fn step(&self) -> Step<S> {
        let (zero, one) = (Vector::splat(self.simd, 0.0), Vector::splat(self.simd, 1.0));
        let next = self.next * G_PER_M_S2;
        let (mut fraction, mut h, mut per_h, mut ground) = (one, self.left, self.per_left, next);
        let far = self.longest.lt(self.left);
        if far.any() {
            fraction = far.select(self.longest * self.per_left, one);
            h = far.select(self.longest, self.left);
            per_h = far.select(one / self.longest, self.per_left);
            ground = far.select(fraction.mul_add(next - self.now, self.now), next);
        }
        let tan = self.slenderness.tan;
        let excess = Excess { start: self.side.mul_add(self.now, tan), end: self.side.mul_add(ground, tan) };
        let r = series(&self.slenderness, excess, self.state, h);

        // The powers of the fraction grow from 0 to 1: the sum of the positive terms bounds the rise from the
        // start of the step, and to its end.
        let mut rise = r[1].max(zero);
        for coefficient in &r[2..] {
            rise = rise + coefficient.max(zero);
        }
        // Upper bound of the change of half the curvature.
        let mut change = zero;
        for (k, coefficient) in r.iter().enumerate().skip(3) {
            change = change + coefficient.abs() * (k * (k - 1) / 2) as f64;
        }
        let last = values(&r, one);
        let velocity = slopes(&r, one) * per_h;
        Step {
            rotation: r,
            per_h,
            fraction,
            last,
            end: RockingState { rotation: last.max(zero), velocity },
            low: last - rise,
            high: r[0] + rise,
            concave: (r[2] + change).lt(zero),
            convex: change.le(r[2]),
        }
    }

    /// Advances the lanes by a step, or to the first impact in it.
    #[inline(always)]
    pub fn advance(&mut self, step: &Step<S>) -> Events {
        let (zero, one) = (Vector::splat(self.simd, 0.0), Vector::splat(self.simd, 1.0));
        let mut events = Events::default();
        let candidates = step.low.le(zero);
        let until = if candidates.any() { self.first_impacts(step, candidates) } else { one };
        self.state = step.end;
        if Vector::splat(self.simd, FRAC_PI_2).le(step.high).any() {
            events.overturned = self.overturned(step, until);
        }
        if self.peak.lt(step.high).any() {
            self.raise_peak(step, until);
        }
        // The order matters: `now` needs the next sample, which `pass_samples` replaces last, and an impact
        // counts among the bounces only after a new sample has reset them.
        let passed = until * step.fraction;
        let within = passed.lt(one);
        let arrived = !within.bits();
        let next = self.next * G_PER_M_S2;
        self.now = within.select(passed.mul_add(next - self.now, self.now), next);
        self.left = within.select((one - passed) * self.left, self.p_dt);
        self.per_left = one / self.left;
        self.bounces = within.select(self.bounces, zero);
        // Impact (Eq. 6): theta'+ = eta theta'-, on the other side.
        let struck = until.lt(one);
        if struck.any() {
            let after = -(slopes(&step.rotation, until) * step.per_h * self.eta);
            self.state.rotation = struck.select(zero, self.state.rotation);
            self.state.velocity = struck.select(after, self.state.velocity);
            self.side = struck.select(-self.side, self.side);
            self.impacts = self.impacts + struck.select(one, zero);
            self.bounces = self.bounces + struck.select(one, zero);
            let feeble = after.lt(Vector::splat(self.simd, REST_VELOCITY));
            let exhausted = Vector::splat(self.simd, f64::from(MOST_IMPACTS)).le(self.bounces);
            events.rested = (struck & (feeble | exhausted)).bits();
        }
        events.ended = self.pass_samples(arrived) & self.busy & !(events.overturned | events.rested);
        events
    }

    /// Finds the fraction of the step before the first impact of `candidates`; 1 without an impact.
    #[inline(always)]
    fn first_impacts(&self, step: &Step<S>, candidates: Mask<S>) -> Vector<S> {
        let (zero, one) = (Vector::splat(self.simd, 0.0), Vector::splat(self.simd, 1.0));
        let c = &step.rotation;
        let below = step.last.lt(zero);
        let starts_above = zero.lt(c[0]) | zero.lt(c[1]);
        let monotone = step.end.velocity.le(zero) | zero.le(c[1]);
        let plain = step.keeps_a_sign(candidates);
        let strikes = candidates & below & starts_above & plain;
        let passes = !below & (step.concave | (plain & monotone));
        let mut until = if strikes.any() { strikes.select(falling_root(c, strikes), one) } else { one };
        for lane in set_bits((candidates & !strikes & !passes).bits()) {
            until.set(lane, first_impact(&in_lane(c, lane)).unwrap_or(1.0));
        }
        until
    }

    /// Finds the lanes that reach pi/2 up to `until`.
    #[inline(never)]
    fn overturned(&self, step: &Step<S>, until: Vector<S>) -> u32 {
        let high = Vector::splat(self.simd, FRAC_PI_2).le(step.high).bits() & self.busy;
        let overturns = |lane: &usize| {
            first_overturning(&in_lane(&step.rotation, *lane)).is_some_and(|x| x <= until.lane(*lane))
        };
        set_bits(high).filter(overturns).fold(0, |bits, lane| bits | 1 << lane)
    }

    #[inline(always)]
    fn raise_peak(&mut self, step: &Step<S>, until: Vector<S>) {
        let zero = Vector::splat(self.simd, 0.0);
        let r = &step.rotation;
        let higher = self.peak.lt(step.high);
        let turns = step.concave & zero.lt(r[1]) & step.end.velocity.lt(zero);
        let ends = higher & step.keeps_a_sign(higher) & !turns;
        self.peak = ends.select(self.peak.max(step.end.rotation), self.peak);
        let turning = higher & !ends & turns;
        if turning.any() {
            let mut slope = [zero; ORDER + 1];
            for k in 1..=ORDER {
                slope[k - 1] = r[k] * k as f64;
            }
            let highest = values(r, falling_root(&slope, turning));
            self.peak = turning.select(self.peak.max(highest), self.peak);
        }
        for lane in set_bits((higher & !ends & !turns).bits()) {
            let highest = largest(&in_lane(r, lane), until.lane(lane));
            self.peak.set(lane, highest.max(self.peak.lane(lane)));
        }
    }

    /// Moves `arrived` lanes to their next sample. Returns the lanes at their last sample.
    #[inline(always)]
    fn pass_samples(&mut self, arrived: u32) -> u32 {
        let mut ended = 0;
        for lane in 0..Vector::<S>::LANES {
            let ahead = self.index[lane] + 1 + (arrived >> lane & 1) as usize;
            self.index[lane] = ahead - 1;
            let sample = self.samples[lane].get(ahead);
            ended |= u32::from(sample.is_none()) << lane;
            self.next.set(lane, sample.copied().unwrap_or(0.0));
        }
        ended
    }
}

fn in_lane<S: Simd>(c: &Polynomial<Vector<S>>, lane: usize) -> Polynomial {
    std::array::from_fn(|k| c[k].lane(lane))
}
