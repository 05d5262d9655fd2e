//! Roots and maxima of several polynomials at once.

use pulp::Simd;

use super::polynomial::{ORDER, Polynomial};
use super::real::{Mask, Real, Vector};

/// When Halley's step is this small, relative to the root, the next one is below rounding.
const CONVERGED: f64 = 4e-6;

/// When Newton's step is this small, relative to the place of a maximum, the next one changes the value there by less than
/// rounding.
const MAXIMUM_CONVERGED: f64 = 1e-5;

/// More iterations than any root takes: bisection alone would have narrowed the bracket to rounding.
const MOST_ITERATIONS: usize = 64;

/// Finds the root of each lane of `wanted`, which falls through zero once in (0, 1) and may start at zero: Halley's iterations,
/// kept inside the shrinking bracket by bisection. A lane's iterations do not depend on the other lanes.
#[inline(always)]
pub fn falling_root<S: Simd>(c: &Polynomial<Vector<S>>, wanted: Mask<S>) -> Vector<S> {
    let (zero, one) = (c[0].like(0.0), c[0].like(1.0));
    let mut bracket = Bracket { low: zero, high: one, x: first_guess(c) };
    let mut active = bracket.refine(c, wanted);
    let mut iterations = 1;
    while active.any() && iterations < MOST_ITERATIONS {
        active = bracket.refine(c, active);
        iterations += 1;
    }
    bracket.x
}

/// Guesses by the falling root of the parabola that begins as the polynomial does, and one iteration from there on the cubic.
#[inline(always)]
fn first_guess<S: Simd>(c: &Polynomial<Vector<S>>) -> Vector<S> {
    let (zero, one) = (c[0].like(0.0), c[0].like(1.0));
    let root = c[1].mul_add(c[1], c[0] * c[2] * -4.0).max(zero).sqrt();
    // Of two equal fractions the one in which nothing cancels.
    let rises = zero.lt(c[1]);
    let x = rises.select(c[1] + root, c[0] * 2.0) / rises.select(c[2] * -2.0, root - c[1]);
    let x = (zero.lt(x) & x.lt(one)).select(x, one * 0.5);
    let value = x.mul_add(x.mul_add(x.mul_add(c[3], c[2]), c[1]), c[0]);
    let slope = x.mul_add(x.mul_add(c[3] * 3.0, c[2] * 2.0), c[1]);
    let closer = halley(x, value, slope, x.mul_add(c[3] * 3.0, c[2]));
    (zero.lt(closer) & closer.lt(one)).select(closer, x)
}

/// Takes Halley's step from x, by value, slope and half the curvature there.
#[inline(always)]
fn halley<S: Simd>(x: Vector<S>, value: Vector<S>, slope: Vector<S>, bend: Vector<S>) -> Vector<S> {
    x - value * slope / slope.mul_add(slope, -(value * bend))
}

/// The bounds of a root, and the best guess at it.
struct Bracket<S: Simd> {
    low: Vector<S>,
    high: Vector<S>,
    x: Vector<S>,
}

impl<S: Simd> Bracket<S> {
    /// Iterates once in the lanes of `active`; returns those that need another iteration.
    #[inline(always)]
    fn refine(&mut self, c: &Polynomial<Vector<S>>, active: Mask<S>) -> Mask<S> {
        let x = self.x;
        let zero = x.like(0.0);
        // Value, slope and half the curvature.
        let (mut value, mut slope, mut bend) = (c[ORDER], zero, zero);
        for k in (0..ORDER).rev() {
            bend = bend.mul_add(x, slope);
            slope = slope.mul_add(x, value);
            value = value.mul_add(x, c[k]);
        }
        let above = zero.lt(value);
        self.low = above.select(x, self.low);
        self.high = above.select(self.high, x);
        let closer = halley(x, value, slope, bend);
        let inside = self.low.le(closer) & closer.le(self.high);
        let next = inside.select(closer, (self.low + self.high) * 0.5);
        let close = inside & (next - x).abs().le(next * CONVERGED);
        self.x = active.select(next, x);
        active & !(close | next.equals(self.low) | next.equals(self.high))
    }
}

/// Where polynomials are largest.
pub struct Maxima<S: Simd> {
    pub x: Vector<S>,
    /// The lanes that converged.
    pub found: Mask<S>,
}

/// Finds the maxima, in [0, 1], of the lanes of `wanted`, which rise, are concave and fall in the end: Newton's iterations from
/// the maximum of the parabola that begins as they do. A lane's iterations do not depend on the other lanes.
#[inline(always)]
pub fn maxima<S: Simd>(c: &Polynomial<Vector<S>>, wanted: Mask<S>) -> Maxima<S> {
    let (zero, one) = (c[0].like(0.0), c[0].like(1.0));
    let mut x = (c[1] / (c[2] * -2.0)).min(one);
    let mut active = wanted;
    for _ in 0..MOST_ITERATIONS {
        let (mut slope, mut curvature) = (c[ORDER] * ORDER as f64, zero);
        for k in (1..ORDER).rev() {
            curvature = curvature.mul_add(x, slope);
            slope = slope.mul_add(x, c[k] * k as f64);
        }
        let next = (x - slope / curvature).max(zero).min(one);
        let close = (next - x).abs().le(next * MAXIMUM_CONVERGED);
        x = active.select(next, x);
        active = active & !close;
        if !active.any() {
            break;
        }
    }
    Maxima { x, found: wanted & !active }
}
