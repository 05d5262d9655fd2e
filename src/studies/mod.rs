//! Studies of the curves: which measures predict best, how universal the curves are, how they do on other data.
//!
//! ```text
//! candidate     sets of measures; ranking_sample: the cases in which they are ranked
//! rating        how well a set predicts; ranking: the order of all sets
//! transfer      the curve of one structure, asked about another; universality: how it does; pooled: one curve for all
//! validation    forecasts of cases that were not fitted, tested on what happened
//! paper         how ours stands to what the paper prints
//! ```

pub(crate) mod candidate;
pub mod paper;
pub(crate) mod pooled;
pub(crate) mod ranking;
pub(crate) mod ranking_sample;
pub(crate) mod rating;
pub(crate) mod transfer;
pub(crate) mod universality;
pub(crate) mod validation;

pub use crate::resampling::{Folds, Gain, gain};
pub use candidate::{Candidate, Form};
pub use pooled::{PooledFit, PooledPart, PooledStructure, PooledTerm, PooledTerms, fit_pooled};
pub use ranking::{MeasureRanking, RankingRules};
pub use ranking::{OfPaper, Ranked};
pub use ranking_sample::{FurtherMeasure, RankingSample, Target};
pub use rating::{HeldOut, Rating, ReliabilityGroup, Skill};
pub use transfer::{Curve, CurveForm, CurveSubject};
pub use universality::{BesideOwn, Transfer, Verdict};
pub use validation::{Forecast, Forecasts};
pub use validation::{Validation, calibration_in_the_large, calibration_slope, wilson_limits};

/// Cases that a study takes in all; of more some that are spread over them. How sure its answers are hangs on how many cells or
/// earthquakes there are.
pub const MOST_CASES: usize = 1 << 19;
