//! The outputs of ida: capacities, one row for each motion and structure, and their distributions.

use rockfrag_core::fragility::Group;
use rockfrag_core::rocking::Capacity;
use rockfrag_core::spelling::unknown_word;
use rockfrag_core::statistics::{FitStatus, Interval};
use serde::{Deserialize, Serialize};

use super::responses::OutcomeWord;

/// A measure that grows with a motion in proportion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<ScaledMeasure>)]
pub enum ScaledMeasure {
    /// The factor itself.
    Scale,
    /// Peak ground acceleration, g.
    Pga,
    /// Peak ground velocity, m/s.
    Pgv,
    /// PGA / (g tan alpha).
    Im4,
    /// p PGV / (g tan alpha).
    Im5,
    /// wm PGV / (g tan alpha).
    Im6,
}

/// The capacity of a structure under a motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CapacityRow {
    pub motion_id: String,
    pub suite: Option<String>,
    pub earthquake: Option<String>,
    pub mw: Option<f64>,
    pub re_km: Option<f64>,
    pub structure: String,
    pub measure: ScaledMeasure,
    pub unscaled: f64,
    pub found: Capacity,
}

/// The lognormal distribution of the capacities of a structure under the motions of a suite.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CapacityFitRow {
    pub suite: Option<String>,
    pub structure: String,
    pub measure: ScaledMeasure,
    pub n: i64,
    pub n_safe: i64,
    pub n_below: i64,
    /// Lowest intensity at which half of the motions overturn the structure.
    pub half_overturn_at: Option<f64>,
    pub theta: Interval<Option<f64>>,
    pub beta: Interval<Option<f64>>,
    pub status: FitStatus,
}

/// What is read of a stripe.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Stripe {
    pub suite: Option<String>,
    pub structure: String,
    pub intensity: f64,
    pub outcome: OutcomeWord,
}

impl CapacityRow {
    pub fn group(&self) -> Group<'_> {
        Group { suite: self.suite.as_deref(), structure: &self.structure }
    }
}

impl CapacityFitRow {
    pub fn group(&self) -> Group<'_> {
        Group { suite: self.suite.as_deref(), structure: &self.structure }
    }
}

impl Stripe {
    pub fn group(&self) -> Group<'_> {
        Group { suite: self.suite.as_deref(), structure: &self.structure }
    }
}
