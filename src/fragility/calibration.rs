//! The universal surface, calibrated by two numbers: logit P = c + s logit P_surface. c and s are estimated from
//! the responses of one structure to one suite of motions; without responses they are those of the kind of motion.

use serde::{Deserialize, Serialize};

use super::cases::Cases;
use super::surface::Kind;
use super::tree::Probability;
use crate::rocking::Structure;

/// Over which magnitudes and distances a probability is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scenarios {
    /// One: what sets it apart from others (tau) is in the limits.
    One,
    /// Many, among which this averages out, as over a hazard.
    Many,
}

/// The calibration of a structure: a row of pro.calibration.parquet or pex.calibration.parquet.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Calibration {
    pub suite: Option<String>,
    pub kind: Kind,
    pub structure: String,
    pub p_rad_s: f64,
    pub alpha_rad: f64,
    pub eta: f64,
    /// Demand |theta|max / alpha of P_ex; none of P_ro.
    pub limit_state: Option<f64>,
    pub c: f64,
    pub ln_s: f64,
    /// Of c and ln s, row by row.
    pub covariance: Vec<f64>,
    /// Standard deviation of the logit between cells or earthquakes.
    pub tau: f64,
    pub n: i64,
    pub n_events: i64,
    pub n_clusters: i64,
    /// Of the motions that it was fitted to: least and largest PGA (m/s2) and PGV/PGA (s).
    pub pga_low: Option<f64>,
    pub pga_high: Option<f64>,
    pub ratio_low: Option<f64>,
    pub ratio_high: Option<f64>,
}

impl Calibration {
    /// That of a kind of motion, for a structure without responses of its own; `limit_state` of P_ex, none of P_ro.
    pub fn shipped(_kind: Kind, _structure: &Structure, _limit_state: Option<f64>) -> Calibration {
        todo!()
    }

    /// Fits c and s to responses: maximum a posteriori, with the priors of the kind of motion.
    pub fn fit(_cases: &Cases, _limit_state: Option<f64>) -> Calibration {
        todo!()
    }

    /// Computes the calibrated probability from the logit of the surface, with 95 % limits.
    pub fn probability(&self, _logit: f64, _scenarios: Scenarios) -> Probability {
        todo!()
    }
}
