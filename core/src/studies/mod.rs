//! Studies of the fits: validation on other data, comparison with the paper.
//!
//! ```text
//! validation  any probabilities against what happened
//! paper       each published number beside ours
//! ```

pub mod paper;
mod validation;

pub use validation::{Forecasts, ReliabilityBin, Validation, observed_share};
