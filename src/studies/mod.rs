//! Studies of the fits: which measures predict best, validation on other data, comparison with the paper.
//!
//! ```text
//! ranking     sets of measures by AIC and by log score on cells left out
//! validation  any probabilities against what happened
//! paper       each published number beside ours
//! ```

pub mod paper;
mod ranking;
mod validation;

pub use ranking::{Form, RankedSet, Ranking, RankingRules, Target, rank_measures};
pub use validation::{Forecasts, ReliabilityBin, Validation, observed_share};
