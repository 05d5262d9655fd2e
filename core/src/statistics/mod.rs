//! Regressions and distributions.
//!
//! A fit takes columns of length n and has k coefficients, the intercept first; a covariance is k × k, row by
//! row.

mod binary;
pub mod clusters;
mod design;
pub mod distributions;
mod fit;
mod interval;
mod linear;
pub(crate) mod newton;
pub mod normal;
pub mod numerics;
mod range;
pub mod scores;

pub use binary::{FEW_EVENTS, ProbitFit, clustered_probit, log_likelihood, probit};
pub use clusters::held_out;
pub use fit::{Fit, FitStatus, delta_variance, independent_errors, predict};
pub use interval::Interval;
pub use linear::{LinearFit, clustered_least_squares, least_squares};
pub use range::{Bounds, Range};
