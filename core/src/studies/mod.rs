//! Studies of the fits: validation on other data, comparison with the paper.

pub mod comparison;
mod validation;

pub use validation::{Forecasts, ReliabilityBin, Validation, observed_share};
