//! The standard normal distribution.

mod quantile;
mod tail;

use std::f64::consts::{FRAC_1_SQRT_2, PI};

pub use quantile::quantile;
pub use tail::{LowerTail, lower_tail};

/// Probability density at `x`.
pub fn pdf(x: f64) -> f64 {
    libm::exp(-0.5 * x * x) / (2.0 * PI).sqrt()
}

/// Cumulative probability at `x`, with full relative precision in the lower tail.
pub fn cdf(x: f64) -> f64 {
    0.5 * libm::erfc(-x * FRAC_1_SQRT_2)
}

/// Logarithm of the cumulative probability at `x`, precise in both tails.
pub fn ln_cdf(x: f64) -> f64 {
    lower_tail(x).ln_cdf
}
