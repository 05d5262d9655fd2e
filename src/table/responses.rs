//! The files of simulate: one row a motion and structure, and one a moment of a traced response.

use std::sync::Arc;

use super::TableError;
use super::motions::MotionId;
use super::row::{ReadRow, table};
use super::schema;
use super::store::columns::Columns;
use crate::fragility::Case;
use crate::motion::IntensityMeasures;
use crate::rocking::{Outcome, SolverEvent, Structure};

table! {
    /// Responses of structures to motions.
    pub struct ResponseRow<'a> as RESPONSES = "responses" by "simulate" {
        motion_id: &'a MotionId,
        suite: Option<&'a str>,
        structure: &'a str,
        p_rad_s: f64,
        alpha_rad: f64,
        eta: f64,
        outcome: Outcome,
        edp: Option<f64>,
        impacts: i32,
        mw: Option<f64>,
        re_km: Option<f64>,
        earthquake: Option<&'a str>,
        pga_m_s2: f64,
        pgv_m_s: f64,
        tp_s: Option<f64>,
        tm_s: Option<f64>,
        im1: Option<f64>,
        im2: Option<f64>,
        im3: Option<f64>,
        im4: f64,
        im5: f64,
        im6: Option<f64>,
    }
}

table! {
    /// A response as the fits take it.
    pub struct ResponseCase of RESPONSES {
        motion_id: MotionId,
        suite: Option<Arc<str>>,
        structure: Arc<str>,
        p_rad_s: f64,
        alpha_rad: f64,
        eta: f64,
        outcome: Outcome,
        edp: Option<f64>,
        mw: Option<f64>,
        re_km: Option<f64>,
        earthquake: Option<Arc<str>>,
        pga_m_s2: f64,
        pgv_m_s: f64,
        tp_s: Option<f64>,
        im1: Option<f64>,
        im2: Option<f64>,
        im3: Option<f64>,
        im4: f64,
        im5: f64,
        im6: Option<f64>,
    }
}

impl ResponseCase {
    /// The rows of a batch: whatever did not overturn has a demand.
    ///
    /// # Errors
    /// If a column is missing or of another type, or a value cannot be used.
    pub fn checked(columns: &Columns) -> Result<Vec<ResponseCase>, TableError> {
        let rows = ResponseCase::of(columns)?;
        let lacks = |row: &ResponseCase| row.edp.is_none() && row.outcome != Outcome::Overturning;
        match rows.iter().position(lacks) {
            Some(row) => {
                Err(columns.value_error(row, &schema::edp, "null; expected a number unless it overturns"))
            }
            None => Ok(rows),
        }
    }

    /// The response as the fits see it. One that overturns exceeds any demand.
    pub fn case(&self) -> Case {
        let demand = self.edp.filter(|_| self.outcome != Outcome::Overturning);
        Case { outcome: self.outcome, edp: demand.unwrap_or(f64::INFINITY), measures: self.measures() }
    }

    pub fn measures(&self) -> IntensityMeasures {
        let &ResponseCase { im1, im2, im3, im4, im5, im6, .. } = self;
        IntensityMeasures { im1, im2, im3, im4, im5, im6 }
    }

    /// The structure of the response.
    pub fn structure(&self) -> Structure {
        let &ResponseCase { p_rad_s, alpha_rad, eta, .. } = self;
        Structure { name: self.structure.to_string(), p_rad_s, alpha_rad, eta }
    }
}

table! {
    /// Responses over time: one row a moment of a traced response.
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
