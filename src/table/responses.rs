//! The files of simulate: one row a motion and structure, and one a moment of a traced response.

use std::sync::Arc;

use super::motions::MotionId;
use super::row::table;
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
        edp: f64,
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
        edp: f64,
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
