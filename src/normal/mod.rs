//! The standard normal distribution.

mod exponential;
mod logarithm;
mod polynomial;
mod quantile;
mod tail;

use std::f64::consts::{FRAC_1_SQRT_2, PI};

pub use quantile::quantile;
pub use tail::{inverse_mills, ln_cdf};

/// Probability density at `x`.
pub fn pdf(x: f64) -> f64 {
    libm::exp(-0.5 * x * x) / (2.0 * PI).sqrt()
}

/// Cumulative probability at `x`, with full relative precision in the lower tail.
pub fn cdf(x: f64) -> f64 {
    0.5 * libm::erfc(-x * FRAC_1_SQRT_2)
}
