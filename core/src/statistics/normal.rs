//! The standard normal distribution.

use std::f64::consts::{FRAC_1_SQRT_2, TAU};

/// The 97.5 % quantile.
pub const Z_95: f64 = 1.959_963_984_540_054;
/// The lower tail below this uses a continued fraction.
const TAIL: f64 = -5.0;
/// Levels of the continued fraction; at [`TAIL`] more have no effect.
const LEVELS: u32 = 40;

/// Computes the cumulative probability Phi(x), with full relative precision in the lower tail.
pub fn cdf(x: f64) -> f64 {
    0.5 * libm::erfc(-x * FRAC_1_SQRT_2)
}

pub fn density(x: f64) -> f64 {
    (-0.5 * x * x).exp() / TAU.sqrt()
}

pub fn ln_density(x: f64) -> f64 {
    -0.5 * (x * x + TAU.ln())
}

/// Computes ln Phi(x) and its derivative, the inverse Mills ratio phi(x) / Phi(x).
pub fn ln_cdf_and_slope(x: f64) -> (f64, f64) {
    let ln_density = ln_density(x);
    if x < TAIL {
        // phi / Phi = y + 1/(y + 2/(y + 3/(y + ...))), y = -x (Laplace).
        let mills = (1..=LEVELS).rev().fold(-x, |ratio, level| -x + f64::from(level) / ratio);
        (ln_density - mills.ln(), mills)
    } else if x < 0.0 {
        let below = cdf(x);
        (below.ln(), ln_density.exp() / below)
    } else {
        let above = cdf(-x);
        ((-above).ln_1p(), ln_density.exp() / (1.0 - above))
    }
}

/// Computes ln Phi(x), precise in both tails.
pub fn ln_cdf(x: f64) -> f64 {
    ln_cdf_and_slope(x).0
}

/// Computes the `p` quantile; infinite at 0 and 1, NaN outside.
pub fn quantile(p: f64) -> f64 {
    if p > 0.5 {
        return -quantile(1.0 - p);
    }
    if p == 0.0 {
        return f64::NEG_INFINITY;
    }
    // Within 4.5e-4 (Abramowitz & Stegun 1964, 26.2.23); each Newton step on ln Phi squares the error.
    let t = (-2.0 * p.ln()).sqrt();
    let mut x = (2.515_517 + t * (0.802_853 + t * 0.010_328))
        / (1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308)))
        - t;
    for _ in 0..3 {
        let (ln_p, slope) = ln_cdf_and_slope(x);
        x -= (ln_p - p.ln()) / slope;
    }
    x
}
