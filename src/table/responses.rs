//! The outputs of simulate: responses, one row for each motion and structure, and traces.

use arrow_array::RecordBatch;
use serde::{Deserialize, Serialize};

use super::rows;
use crate::motion::IntensityMeasures;
use crate::rocking::{Outcome, SolverEvent};

/// The response of a structure to a motion; beside it stand the measures of the motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ResponseRow {
    pub motion_id: String,
    pub suite: Option<String>,
    pub structure: String,
    pub p_rad_s: f64,
    pub alpha_rad: f64,
    pub eta: f64,
    pub outcome: Outcome,
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
}

/// Makes a batch of responses, with the measures of their motions behind.
pub fn batch(responses: &[ResponseRow], measures: &[IntensityMeasures]) -> anyhow::Result<RecordBatch> {
    rows::side_by_side(&[rows::batch(responses)?, rows::batch(measures)?])
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
