//! One Taylor step of the equation of motion (Eq. 4), which [`reference`](super::reference) prints. With
//! r = |theta|, x = p t, and w the ground acceleration over g, positive towards the base:
//!
//! ```text
//! r'' = -[ sin(alpha - r) + w cos(alpha - r) ] = -[ A cos r + B sin r ]
//! A = e cos(alpha),  B = e sin(alpha) - 1/cos(alpha),  e = w + tan(alpha)
//! ```
//!
//! The second form is precise for small rotations, and for a small excess e of the ground acceleration over
//! the uplift threshold. The excess is negative while the ground lifts the structure further.

use pulp::Simd;

use super::polynomial::{ORDER, Polynomial};
use super::vector::{Vector, unrolled};

/// A structure whose velocity eta |theta'| after an impact is below this fraction of p rests, or uplifts at
/// once if the ground acceleration is large enough. On still ground it would rotate by 1e-12 / alpha at most.
pub const REST_VELOCITY: f64 = 1e-6;

/// After this many impacts between two samples the structure rests until the next one: a bound of the work.
/// Only coefficients of restitution near 1 and velocities of about 1e-6 p reach it.
pub const MOST_IMPACTS: u32 = 10_000;

#[derive(Debug, Clone, Copy)]
pub struct Slenderness<T = f64> {
    pub tan: T,
    pub sin: T,
    pub cos: T,
    pub secant: T,
}

impl Slenderness {
    pub fn new(alpha_rad: f64) -> Slenderness {
        let (sin, cos) = alpha_rad.sin_cos();
        Slenderness { tan: alpha_rad.tan(), sin, cos, secant: 1.0 / cos }
    }
}

/// Excess e of the ground acceleration over the uplift threshold, linear from the start of a step to its end.
#[derive(Debug, Clone, Copy)]
pub struct Excess<T> {
    pub start: T,
    pub end: T,
}

/// Rotation r >= 0 (rad) and velocity dr/dx (rad) on one side of the rest position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RockingState<T = f64> {
    pub rotation: T,
    pub velocity: T,
}

/// Expands the equation of motion (Eq. 4) over a step of `h` = p dt, in powers of the fraction of the step.
///
/// The series of sin r and cos r follow term by term from s' = r' c and c' = -r' s.
#[inline(always)]
pub fn series<S: Simd>(
    slenderness: &Slenderness<Vector<S>>,
    excess: Excess<Vector<S>>,
    state: RockingState<Vector<S>>,
    h: Vector<S>,
) -> Polynomial<Vector<S>> {
    // -h^2 A and -h^2 B, linear in the fraction of the step.
    let Slenderness { sin, cos, secant, .. } = *slenderness;
    let minus_h2 = -(h * h);
    let slope = (excess.end - excess.start) * minus_h2;
    let start = excess.start * minus_h2;
    let (a0, a1) = (start * cos, slope * cos);
    let (b0, b1) = (start.mul_add(sin, -(secant * minus_h2)), slope * sin);

    let (s0, c0) = state.rotation.sin_cos();
    let (mut s, mut c) = ([s0; ORDER - 1], [c0; ORDER - 1]);
    let mut r = [state.rotation; ORDER + 1];
    r[1] = state.velocity * h;
    r[2] = a0.mul_add(c0, b0 * s0) * 0.5;
    // j r[j], the coefficients of x r'.
    let mut rate = [r[1]; ORDER - 1];
    unrolled!(k in [1 2 3 4 5 6] {
        rate[k] = r[k] * k as f64;
        s[k] = product(&rate, &c, k) * (1.0 / k as f64);
        c[k] = product(&rate, &s, k) * (-1.0 / k as f64);
        let moment = b0.mul_add(s[k], b1 * s[k - 1]);
        let moment = a0.mul_add(c[k], a1.mul_add(c[k - 1], moment));
        r[k + 2] = moment * (1.0 / ((k + 1) * (k + 2)) as f64);
    });
    r
}

/// Computes term k of x r' f from the terms of x r' and of f up to k. The newest term of f is used last,
/// since its latency is the bottleneck.
#[inline(always)]
fn product<S: Simd>(rate: &[Vector<S>; ORDER - 1], f: &[Vector<S>; ORDER - 1], k: usize) -> Vector<S> {
    let mut sum = rate[k] * f[0];
    for j in (1..k).rev() {
        sum = rate[j].mul_add(f[k - j], sum);
    }
    sum
}
