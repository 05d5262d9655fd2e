//! One structure through one record: rest, uplift, rocking, impacts, overturning.
//!
//! The rules stand here for one structure, and in [`lanes`](super::lanes) and [`lane_step`](super::lane_step) for a vector of them:
//! uplift in [`Uplift`] (shared), the impact in `March::impact` and `Lanes::advance`, overturning in `March::rock` and
//! `Lanes::overturned`. `tests/solver/simd.rs` and `tests/solver/numbers.rs` hold the two together, `tests/solver/truth.rs` each of
//! them against quadruple precision.

use std::f64::consts::FRAC_PI_2;
use std::ops::ControlFlow;

use super::observer::{NoObserver, Observer, Side};
use super::polynomial::{self, Polynomial};
use super::record::Record;
use super::response::{Response, Tail, free_rocking};
use super::structure::Structure;
use super::taylor::{Excess, Slenderness, State, series};
use crate::units::{G_M_S2, PER_G};

/// After an impact, a velocity eta |theta'| below this fraction of p counts as none: the structure rests, or uplifts at once if the
/// ground demands it.
pub const REST_VELOCITY: f64 = 1e-6;

/// After this many impacts between two samples the structure rests until the next one: a bound of the work. It takes a coefficient
/// of restitution near 1 to come to this, and a velocity of some 1e-6 p.
pub const MOST_IMPACTS: u32 = 10_000;

/// The longest Taylor step, as p dt sqrt(1 + PGA/g). What order 8 leaves out of steps this long moves the peak of a
/// structure in white noise of 0.6 g by some 1e-12 of itself.
const LONGEST_STEP: f64 = 0.03;

/// Returns the longest Taylor step, p dt, through a record.
pub(super) fn longest_step(record: &Record) -> f64 {
    LONGEST_STEP / (1.0 + record.peak_m_s2() * PER_G).sqrt()
}

#[derive(Debug, Clone, Copy)]
enum Phase {
    Rest,
    Rocking(Side, State),
    Overturned,
}

/// What is left of the time between two samples; the ground acceleration over g is linear in it.
#[derive(Clone, Copy)]
struct Remainder {
    index: usize,
    /// Fraction of the time between the samples that has passed.
    elapsed: f64,
    start: f64,
    end: f64,
}

impl Remainder {
    fn ground(&self, fraction: f64) -> f64 {
        self.start + fraction * (self.end - self.start)
    }

    /// Returns what is left after a fraction of it has passed, with the ground acceleration at that moment.
    fn after(&self, fraction: f64, ground: f64) -> Remainder {
        let elapsed = if fraction < 1.0 { self.elapsed + fraction * (1.0 - self.elapsed) } else { 1.0 };
        Remainder { elapsed, start: ground, ..*self }
    }
}

struct March<'a, O> {
    slenderness: Slenderness,
    structure: &'a Structure,
    dt_s: f64,
    longest_step: f64,
    observer: &'a mut O,
    rocked: bool,
    impacts: u32,
    /// Largest |theta| so far, rad.
    peak: f64,
}

/// Simulates a structure, at rest at first, through a record and the free rocking that follows it.
pub fn simulate(structure: &Structure, record: &Record) -> Response {
    march(structure, record, &mut NoObserver)
}

/// Simulates as [`simulate`] does, and tells `observer` what happens on the way.
pub fn march(structure: &Structure, record: &Record, observer: &mut impl Observer) -> Response {
    let mut march = March {
        slenderness: Slenderness::new(structure.alpha_rad),
        structure,
        dt_s: record.dt_s(),
        longest_step: longest_step(record),
        observer,
        rocked: false,
        impacts: 0,
        peak: 0.0,
    };
    let phase = march.through(record);
    march.response(phase)
}

impl<O: Observer> March<'_, O> {
    fn through(&mut self, record: &Record) -> Phase {
        let samples = record.acceleration_m_s2();
        let uplift = G_M_S2 * self.slenderness.tan;
        let mut phase = Phase::Rest;
        let mut index = 0;
        self.observer.sample(0, None);
        while index + 1 < samples.len() {
            // Most of a record is too weak to uplift the structure.
            if let Phase::Rest = phase
                && samples[index].abs() < uplift
                && samples[index + 1].abs() < uplift
            {
                index += 1;
                self.observer.sample(index, None);
                continue;
            }
            let (start, end) = (samples[index] * PER_G, samples[index + 1] * PER_G);
            phase = self.between_samples(phase, Remainder { index, elapsed: 0.0, start, end });
            index += 1;
            match phase {
                Phase::Rest => self.observer.sample(index, None),
                Phase::Rocking(side, state) => self.observer.sample(index, Some((side, state))),
                Phase::Overturned => return phase,
            }
        }
        phase
    }

    /// Advances to the next sample, through all that happens before it.
    fn between_samples(&mut self, mut phase: Phase, mut remainder: Remainder) -> Phase {
        let most = self.impacts.saturating_add(MOST_IMPACTS);
        while remainder.elapsed < 1.0 {
            if self.impacts >= most {
                self.observer.rest(self.time_s(&remainder));
                return Phase::Rest;
            }
            (phase, remainder) = match phase {
                Phase::Rest => self.rest(remainder),
                Phase::Rocking(side, state) => self.rock(side, state, remainder),
                Phase::Overturned => return phase,
            };
        }
        phase
    }

    /// Rests until |a| = g tan(alpha), at the root of the linear acceleration, or to the next sample.
    fn rest(&mut self, remainder: Remainder) -> (Phase, Remainder) {
        let Remainder { start, end, .. } = remainder;
        let Some(Uplift { fraction, ground, .. }) = Uplift::between(start, end, self.slenderness.tan) else {
            return (Phase::Rest, remainder.after(1.0, end));
        };
        let side = Side::opposing(ground);
        let remainder = remainder.after(fraction, ground);
        self.rocked = true;
        self.observer.uplift(self.time_s(&remainder), side);
        (Phase::Rocking(side, State { rotation: 0.0, velocity: 0.0 }), remainder)
    }

    /// Rocks on one side until the first impact, overturning, or the end of the Taylor step (section 2.2, Eqs. 8 to 11).
    fn rock(&mut self, side: Side, state: State, remainder: Remainder) -> (Phase, Remainder) {
        let left = self.structure.p_rad_s * self.dt_s * (1.0 - remainder.elapsed);
        let fraction = (self.longest_step / left).min(1.0);
        let h = left * fraction;
        let excess = Excess {
            start: side.sign() * remainder.start + self.slenderness.tan,
            end: side.sign() * remainder.ground(fraction) + self.slenderness.tan,
        };
        let rotation = series(&self.slenderness, excess, state, h);

        // Bounds of the rotation spare the search for roots in nearly all steps.
        let (low, high) = polynomial::bounds(&rotation);
        let impact = if low > 0.0 { None } else { first_impact(&rotation) };
        let until = impact.unwrap_or(1.0);
        if high >= FRAC_PI_2
            && let Some(x) = first_overturning(&rotation).filter(|&x| x <= until)
        {
            let remainder = remainder.after(fraction * x, remainder.ground(fraction * x));
            let velocity = polynomial::slope(&rotation, x) / h;
            self.observer.overturn(self.time_s(&remainder), side, velocity);
            return (Phase::Overturned, remainder);
        }
        if high > self.peak {
            self.peak = self.peak.max(largest(&rotation, until));
        }
        let remainder = remainder.after(fraction * until, remainder.ground(fraction * until));
        let velocity = polynomial::slope(&rotation, until) / h;
        if impact.is_some() {
            (self.impact(side, -velocity, &remainder), remainder)
        } else {
            let rotation = polynomial::value(&rotation, 1.0).max(0.0);
            (Phase::Rocking(side, State { rotation, velocity }), remainder)
        }
    }

    /// Strikes the base (section 2.2): goes on with the velocity eta |theta'| on the other side, or rests. `Lanes::advance` does the
    /// same.
    fn impact(&mut self, side: Side, before: f64, remainder: &Remainder) -> Phase {
        let after = self.structure.eta * before;
        let time_s = self.time_s(remainder);
        self.impacts += 1;
        self.observer.impact(time_s, side, before, after);
        if after >= REST_VELOCITY {
            return Phase::Rocking(side.other(), State { rotation: 0.0, velocity: after });
        }
        self.observer.rest(time_s);
        Phase::Rest
    }

    fn time_s(&self, remainder: &Remainder) -> f64 {
        (remainder.index as f64 + remainder.elapsed) * self.dt_s
    }

    /// Makes the response, with the free rocking that follows the record.
    fn response(&self, phase: Phase) -> Response {
        let alpha = self.structure.alpha_rad;
        let tail = match phase {
            Phase::Overturned => Tail::Overturns,
            Phase::Rest if !self.rocked => return Response::NO_ROCKING,
            Phase::Rest => Tail::Settles { peak: 0.0 },
            Phase::Rocking(_, state) => free_rocking(state, alpha, self.structure.eta),
        };
        Response::of_rocking(tail, self.peak, alpha, self.impacts)
    }
}

/// Finds the first return to the base. A rotation that starts downwards from 0 strikes at once.
pub(super) fn first_impact(rotation: &Polynomial) -> Option<f64> {
    let leading = rotation.iter().find(|&&coefficient| coefficient != 0.0)?;
    if *leading < 0.0 { Some(0.0) } else { polynomial::first_root(rotation) }
}

/// Finds where the rotation first reaches pi/2.
pub(super) fn first_overturning(rotation: &Polynomial) -> Option<f64> {
    let mut margin = rotation.map(|coefficient| -coefficient);
    margin[0] += FRAC_PI_2;
    polynomial::first_root(&margin)
}

/// Finds the largest rotation from the start of the step to `until`.
pub(super) fn largest(rotation: &Polynomial, until: f64) -> f64 {
    let mut largest = rotation[0].max(polynomial::value(rotation, until));
    let _ = polynomial::visit_roots(&polynomial::derivative(rotation), |x| {
        if x > until {
            return ControlFlow::Break(());
        }
        largest = largest.max(polynomial::value(rotation, x));
        ControlFlow::Continue(())
    });
    largest
}

/// The moment at which a structure at rest leaves its base.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Uplift {
    /// Index of the sample before it.
    pub index: usize,
    /// Fraction that has passed of the time from that sample, or from where the structure stands, to the next.
    pub fraction: f64,
    /// Ground acceleration over g.
    pub ground: f64,
}

impl Uplift {
    /// Finds the uplift, |a| = g tan(alpha), while the ground acceleration over g goes linearly from `start` to `end` (section 2.2).
    pub fn between(start: f64, end: f64, tan: f64) -> Option<Uplift> {
        if start.abs() > tan {
            return Some(Uplift { index: 0, fraction: 0.0, ground: start });
        }
        let threshold = tan.copysign(end);
        let fraction = (threshold - start) / (end - start);
        (end.abs() > tan).then_some(Uplift { index: 0, fraction, ground: threshold })
    }
}

/// Finds the first uplift from sample `from` on of a structure that rests there, in `samples` of m/s2.
pub fn next_uplift(samples: &[f64], from: usize, tan: f64) -> Option<Uplift> {
    // Rounding may let a sample pass here that is no larger than the threshold over g.
    let threshold = G_M_S2 * tan * (1.0 - f64::EPSILON);
    let mut index = from;
    loop {
        index += first_as_large(samples.get(index..)?, threshold)?;
        let before = index.saturating_sub(1).max(from);
        for index in before..=index {
            let start = samples[index] * PER_G;
            let end = samples.get(index + 1)? * PER_G;
            if let Some(uplift) = Uplift::between(start, end, tan) {
                return Some(Uplift { index, ..uplift });
            }
        }
        index += 1;
    }
}

/// Finds the first value of at least this size: by blocks, whose comparisons the compiler puts into vector registers.
fn first_as_large(values: &[f64], size: f64) -> Option<usize> {
    const BLOCK: usize = 16;
    let loud = |block: &[f64]| block.iter().fold(false, |loud, value| loud | (value.abs() >= size));
    let quiet = values.chunks(BLOCK).take_while(|block| !loud(block)).count() * BLOCK;
    let rest = values.get(quiet..)?;
    rest.iter().position(|value| value.abs() >= size).map(|at| quiet + at)
}
