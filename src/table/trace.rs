//! The trace file: one row a moment of a traced response.

use super::motions::MotionId;
use super::row::table;
use crate::rocking::SolverEvent;

table! {
    /// Responses over time.
    pub struct TraceRow<'a> as TRACE = "trace" by "simulate" {
        motion_id: &'a MotionId,
        structure: &'a str,
        time_s: f64,
        theta_rad: f64,
        theta_dot_rad_s: f64,
        theta_over_alpha: f64,
        ground_m_s2: f64,
        solver_event: Option<SolverEvent>,
    }
}
