//! Roots and maxima of the rotation over a step: in all lanes at once where the sign of slope or curvature
//! ensures a single root, else lane by lane.

use std::f64::consts::FRAC_PI_2;

use pulp::Simd;

use super::polynomial::{self, ORDER, Polynomial};
use super::vector::{Mask, Vector};

/// After a Halley step this small, relative to the root, the next is about its cube, below rounding.
const CONVERGED: f64 = 4e-6;

/// More iterations than bisection alone needs to narrow the bracket to rounding.
const MOST_ITERATIONS: usize = 64;

/// Evaluates the polynomials at `x` (Horner).
#[inline(always)]
pub fn values<S: Simd>(c: &Polynomial<Vector<S>>, x: Vector<S>) -> Vector<S> {
    let mut sum = c[ORDER];
    for k in (0..ORDER).rev() {
        sum = sum.mul_add(x, c[k]);
    }
    sum
}

#[inline(always)]
pub fn slopes<S: Simd>(c: &Polynomial<Vector<S>>, x: Vector<S>) -> Vector<S> {
    let mut sum = c[ORDER] * ORDER as f64;
    for k in (1..ORDER).rev() {
        sum = sum.mul_add(x, c[k] * k as f64);
    }
    sum
}

/// Finds the root in (0, 1) of each lane of `wanted`, whose polynomial falls through zero once and may start
/// at zero, by Halley's method with bisection. The iterations of a lane are independent of the other lanes.
#[inline(always)]
pub fn falling_root<S: Simd>(c: &Polynomial<Vector<S>>, wanted: Mask<S>) -> Vector<S> {
    let (zero, one) = (c[0].like(0.0), c[0].like(1.0));
    let (mut low, mut high, mut x, mut active) = (zero, one, first_guess(c), wanted);
    for _ in 0..MOST_ITERATIONS {
        // Value, slope and half the curvature.
        let (mut value, mut slope, mut bend) = (c[ORDER], zero, zero);
        for k in (0..ORDER).rev() {
            bend = bend.mul_add(x, slope);
            slope = slope.mul_add(x, value);
            value = value.mul_add(x, c[k]);
        }
        let above = zero.lt(value);
        (low, high) = (above.select(x, low), above.select(high, x));
        let closer = halley(x, value, slope, bend);
        let inside = low.le(closer) & closer.le(high);
        let next = inside.select(closer, (low + high) * 0.5);
        let close = inside & (next - x).abs().le(next * CONVERGED);
        x = active.select(next, x);
        active = active & !close;
        if !active.any() {
            break;
        }
    }
    x
}

/// Estimates the root: the falling root of the leading parabola, then one Halley step on the leading cubic.
#[inline(always)]
fn first_guess<S: Simd>(c: &Polynomial<Vector<S>>) -> Vector<S> {
    let (zero, one) = (c[0].like(0.0), c[0].like(1.0));
    let root = c[1].mul_add(c[1], c[0] * c[2] * -4.0).max(zero).sqrt();
    // The one of two equal fractions without cancellation.
    let rises = zero.lt(c[1]);
    let x = rises.select(c[1] + root, c[0] * 2.0) / rises.select(c[2] * -2.0, root - c[1]);
    let x = (zero.lt(x) & x.lt(one)).select(x, one * 0.5);
    let value = x.mul_add(x.mul_add(x.mul_add(c[3], c[2]), c[1]), c[0]);
    let slope = x.mul_add(x.mul_add(c[3] * 3.0, c[2] * 2.0), c[1]);
    let closer = halley(x, value, slope, x.mul_add(c[3] * 3.0, c[2]));
    (zero.lt(closer) & closer.lt(one)).select(closer, x)
}

/// Computes Halley's step from x, from value, slope and half the curvature.
#[inline(always)]
fn halley<S: Simd>(x: Vector<S>, value: Vector<S>, slope: Vector<S>, bend: Vector<S>) -> Vector<S> {
    x - value * slope / slope.mul_add(slope, -(value * bend))
}

/// Finds the first return to the base. A rotation that falls from 0 returns at once.
pub fn first_impact(rotation: &Polynomial) -> Option<f64> {
    let leading = rotation.iter().find(|&&coefficient| coefficient != 0.0)?;
    if *leading < 0.0 { Some(0.0) } else { polynomial::roots(rotation).first().copied() }
}

/// Finds the fraction of the step at which the rotation first reaches pi/2.
pub fn first_overturning(rotation: &Polynomial) -> Option<f64> {
    let mut margin = rotation.map(|coefficient| -coefficient);
    margin[0] += FRAC_PI_2;
    polynomial::roots(&margin).first().copied()
}

pub fn largest(rotation: &Polynomial, until: f64) -> f64 {
    let turns = polynomial::roots(&polynomial::derivative(rotation)).into_iter().filter(|x| *x < until);
    let rotations = turns.chain([0.0, until]).map(|x| polynomial::value(rotation, x));
    rotations.fold(0.0, f64::max)
}
