//! The standard normal distribution.

mod quantile;
mod tail;

use std::f64::consts::FRAC_1_SQRT_2;

pub use quantile::quantile;
pub use tail::{inverse_mills, ln_cdf};

/// Computes the cumulative probability at `x`, with full relative precision in the lower tail.
pub fn cdf(x: f64) -> f64 {
    0.5 * libm::erfc(-x * FRAC_1_SQRT_2)
}
