//! One Taylor step of the equation of motion.
//!
//! With r = |theta|, x = p t, and w the ground acceleration over g, positive where it presses the structure back
//! onto its base, section 2.2 reads on either side of the rest position
//!
//! ```text
//! r'' = -[ sin(alpha - r) + w cos(alpha - r) ] = -[ A cos r + B sin r ]
//! A = e cos(alpha),  B = e sin(alpha) - 1/cos(alpha),  e = w + tan(alpha)
//! ```
//!
//! The second form keeps the full relative precision of a small rotation, and of the excess e of the ground
//! acceleration over the uplift threshold, which is negative while the ground lifts the structure further.

use super::polynomial::{Coefficients, ORDER};

/// What depends on the slenderness alone.
#[derive(Debug, Clone, Copy)]
pub struct Slenderness {
    pub tan: f64,
    pub sin: f64,
    pub cos: f64,
}

impl Slenderness {
    pub fn new(alpha_rad: f64) -> Slenderness {
        let (sin, cos) = (libm::sin(alpha_rad), libm::cos(alpha_rad));
        Slenderness { tan: libm::tan(alpha_rad), sin, cos }
    }
}

/// The excess e over a step: linear from its start to its end.
#[derive(Debug, Clone, Copy)]
pub struct Excess {
    pub start: f64,
    pub end: f64,
}

/// Rotation r >= 0 (rad) and velocity dr/dx (rad) on one side of the rest position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    pub rotation: f64,
    pub velocity: f64,
}

/// The Taylor polynomial of r over a step of `h` = p dt, in powers of the fraction of the step.
///
/// The series of sin r and cos r follow from s' = r' c and c' = -r' s, term by term.
#[inline]
pub fn series(slenderness: &Slenderness, excess: Excess, state: State, h: f64) -> Coefficients {
    let slope = excess.end - excess.start;
    let a0 = excess.start * slenderness.cos;
    let a1 = slope * slenderness.cos;
    let b0 = excess.start * slenderness.sin - 1.0 / slenderness.cos;
    let b1 = slope * slenderness.sin;

    let mut r = [0.0; ORDER + 1];
    let mut s = [0.0; ORDER - 1];
    let mut c = [0.0; ORDER - 1];
    r[0] = state.rotation;
    r[1] = state.velocity * h;
    s[0] = libm::sin(state.rotation);
    c[0] = libm::cos(state.rotation);
    r[2] = -0.5 * h * h * (a0 * c[0] + b0 * s[0]);
    for k in 1..ORDER - 1 {
        for j in 1..=k {
            s[k] += j as f64 * r[j] * c[k - j];
            c[k] -= j as f64 * r[j] * s[k - j];
        }
        s[k] /= k as f64;
        c[k] /= k as f64;
        let moment = a0 * c[k] + a1 * c[k - 1] + b0 * s[k] + b1 * s[k - 1];
        r[k + 2] = -h * h * moment / ((k + 1) * (k + 2)) as f64;
    }
    r
}
