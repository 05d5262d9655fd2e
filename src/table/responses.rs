//! The outputs of simulate and ida: responses and capacities, one row for each motion and structure, traces and
//! distributions of capacities.

use rockfrag_core::motion::IntensityMeasures;
use rockfrag_core::rocking::{Capacity, Outcome, SolverEvent, Structure};
use rockfrag_core::spelling::unknown_word;
use rockfrag_core::statistics::{FitStatus, Interval};
use serde::{Deserialize, Serialize};

/// An outcome but for its demand, which has its own column.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<OutcomeWord>)]
pub enum OutcomeWord {
    NoRocking,
    SafeRocking,
    #[serde(rename = "overturning")]
    #[strum(serialize = "overturning")]
    Overturned,
}

impl From<Outcome> for OutcomeWord {
    fn from(outcome: Outcome) -> OutcomeWord {
        match outcome {
            Outcome::NoRocking => OutcomeWord::NoRocking,
            Outcome::SafeRocking(_) => OutcomeWord::SafeRocking,
            Outcome::Overturned => OutcomeWord::Overturned,
        }
    }
}

impl OutcomeWord {
    /// The outcome with its demand, which only overturned structures lack.
    pub fn with_demand(self, edp: Option<f64>) -> Option<Outcome> {
        match self {
            OutcomeWord::NoRocking => edp.map(|_| Outcome::NoRocking),
            OutcomeWord::SafeRocking => edp.map(Outcome::SafeRocking),
            OutcomeWord::Overturned => Some(Outcome::Overturned),
        }
    }
}

/// The response of a structure to a motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ResponseRow {
    pub motion_id: String,
    pub suite: Option<String>,
    pub structure: Structure,
    pub outcome: OutcomeWord,
    /// None after overturning: the final rotation is not a demand.
    pub edp: Option<f64>,
    pub impacts: Option<i32>,
    pub scenario_id: Option<i64>,
    pub mw: Option<f64>,
    pub re_km: Option<f64>,
    pub earthquake: Option<String>,
    pub pga_m_s2: f64,
    pub pgv_m_s: f64,
    pub tp_s: Option<f64>,
    pub tm_s: Option<f64>,
    pub measures: IntensityMeasures,
}

/// A moment of the response of a structure to a motion: all that a picture of it needs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TraceRow {
    pub motion_id: String,
    pub structure: String,
    pub time_s: f64,
    pub theta_rad: f64,
    pub theta_dot_rad_s: f64,
    pub theta_over_alpha: f64,
    pub ground_acceleration_m_s2: f64,
    pub ground_velocity_m_s: f64,
    pub solver_event: Option<SolverEvent>,
    pub p_rad_s: f64,
    pub alpha_rad: f64,
    pub eta: f64,
    pub block_width_m: f64,
    pub block_height_m: f64,
}

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
