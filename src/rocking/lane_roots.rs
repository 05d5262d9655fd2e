//! The first roots of several polynomials at once.

use pulp::Simd;

use super::polynomial::{ORDER, Polynomial, bernstein};
use super::real::Real;
use super::vector::{Mask, Vector};

/// Halley's step is this small, relative to the root, when the next one would be below rounding.
const CONVERGED: f64 = 1e-5;

/// More iterations than any root takes: bisection alone would have narrowed the bracket to rounding.
const MOST_ITERATIONS: usize = 64;

/// What the signs of the Bernstein coefficients tell.
pub struct Roots<S: Simd> {
    /// Lanes with one simple root in (0, 1).
    pub one: Mask<S>,
    /// Lanes of which the signs do not tell.
    pub unclear: Mask<S>,
}

/// Sorts polynomials by their roots in (0, 1), by Descartes' rule.
#[inline(always)]
pub fn count<S: Simd>(c: &Polynomial<Vector<S>>) -> Roots<S> {
    let b = bernstein(c);
    let zero = b[0].like(0.0);
    let mut last = b[0].lt(zero);
    let starts_above = zero.lt(b[0]);
    let mut one = last & !last;
    let mut more = one;
    for coefficient in &b[1..] {
        let negative = coefficient.lt(zero);
        let change = negative ^ last;
        more = more | (one & change);
        one = one | change;
        last = negative;
    }
    let unclear = more | (one & !starts_above);
    Roots { one: one & !unclear, unclear }
}

/// The root of each lane of `wanted`, which falls through zero once in (0, 1): Halley's iterations, kept inside the
/// shrinking bracket by bisection. A lane's iterations do not depend on the other lanes.
#[inline(always)]
pub fn falling_root<S: Simd>(c: &Polynomial<Vector<S>>, wanted: Mask<S>) -> Vector<S> {
    let (zero, one) = (c[0].like(0.0), c[0].like(1.0));
    // The root of the parabola that begins as the polynomial does.
    let discriminant = c[1].mul_add(c[1], c[0] * c[2] * -4.0).max(zero);
    let guess = c[0] * 2.0 / (discriminant.sqrt() - c[1]);
    let inside = zero.lt(guess) & guess.lt(one);
    let mut bracket = Bracket { low: zero, high: one, x: inside.select(guess, one * 0.5) };
    let mut active = bracket.refine(c, wanted);
    let mut iterations = 1;
    while active.any() && iterations < MOST_ITERATIONS {
        active = bracket.refine(c, active);
        iterations += 1;
    }
    bracket.x
}

/// Where a root lies, and the best guess at it.
struct Bracket<S: Simd> {
    low: Vector<S>,
    high: Vector<S>,
    x: Vector<S>,
}

impl<S: Simd> Bracket<S> {
    /// One iteration in the lanes of `active`; those that need another one.
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
        let halley = x - value * slope / slope.mul_add(slope, -(value * bend));
        let inside = self.low.le(halley) & halley.le(self.high);
        let next = inside.select(halley, (self.low + self.high) * 0.5);
        let close = inside & (next - x).abs().le(next * CONVERGED);
        self.x = active.select(next, x);
        active & !(close | next.equals(self.low) | next.equals(self.high))
    }
}

/// The polynomials without their root at 0 in the lanes of `rooted`.
#[inline(always)]
pub fn deflated<S: Simd>(c: &Polynomial<Vector<S>>, rooted: Mask<S>) -> Polynomial<Vector<S>> {
    let zero = c[0].like(0.0);
    let mut d = *c;
    for k in 0..ORDER {
        d[k] = rooted.select(c[k + 1], c[k]);
    }
    d[ORDER] = rooted.select(zero, c[ORDER]);
    d
}
