//! The outputs of simulate: responses, one row for each motion and structure, and traces.

use rockfrag_core::motion::IntensityMeasures;
use rockfrag_core::rocking::{Outcome, SolverEvent};
use rockfrag_core::spelling::unknown_word;
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
    pub structure: String,
    pub p_rad_s: f64,
    pub alpha_rad: f64,
    pub eta: f64,
    pub outcome: OutcomeWord,
    /// None after overturning: the final rotation is not a demand.
    pub edp: Option<f64>,
    pub impacts: Option<i32>,
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
