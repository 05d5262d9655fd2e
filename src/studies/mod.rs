//! Studies of the fits: which measures predict best, how probabilities do on other data, how ours stand to
//! the paper's.
//!
//! ```text
//! ranking     sets of measures by AIC and by log score on cells left out
//! validation  any probabilities against what happened
//! paper       each published number beside ours
//! curves      fitted curves over one measure, and scored on other cases
//! ```

mod curves;
pub mod paper;
mod ranking;
mod validation;

pub use curves::{log_score_on, measure_of, motion_at};
pub use ranking::{Form, RankedSet, Ranking, RankingRules, Target, rank_measures};
pub use validation::{Forecasts, ReliabilityBin, Validation, wilson_limits};
