//! The outputs of evaluate: what is predicted for each object, and points of fragility curves.

use serde::{Deserialize, Serialize};

use crate::fragility::{Kind, Peak};
use crate::hazard::{Fragility, VelocitySource};
use crate::keyword::Keyword;
use crate::object::Part;
use crate::statistics::Limited;
use crate::warning::Warning;

/// What is predicted for an object.
#[derive(Debug, Clone, Default)]
pub struct Answer<R> {
    pub object: ObjectRow,
    pub row: R,
    pub doubts: DoubtsRow,
    pub warnings: Vec<Warning>,
    /// The model and the measures of the motion, if requested.
    pub explained: String,
    /// Responses that the model was fitted to.
    pub responses: i64,
}

/// An object and the model that predicts for it; without parameters where it has no answer.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ObjectRow {
    pub structure: String,
    pub width_m: Option<f64>,
    pub depth_m: Option<f64>,
    pub height_m: Option<f64>,
    pub floor_period_s: Option<f64>,
    pub floor_level: Option<f64>,
    /// Number of such objects.
    pub count: Option<f64>,
    pub p_rad_s: Option<f64>,
    pub alpha_rad: Option<f64>,
    pub eta: Option<f64>,
    /// tan(alpha): with less friction it slides.
    pub friction: Option<f64>,
    pub model: Option<String>,
    /// Kind of motion that the model is for.
    pub motions: Option<Kind>,
    pub limit_state: Option<f64>,
    /// Block, body or frame; empty if read from a file.
    #[serde(skip)]
    pub kind: &'static str,
    /// Whether friction was given, and is enough.
    #[serde(skip)]
    pub is_friction_known: bool,
}

/// Annual rates of an object, and probabilities in the time of exposure. Where the hazard ends too early for
/// a value there is a range alone, in the columns of limits.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RatesRow {
    pub rocking_per_year: Option<f64>,
    pub failure_per_year: Limited,
    pub overturning_per_year: Limited,
    pub return_period_years: Option<f64>,
    pub years: Option<f64>,
    pub p_rocking: Option<f64>,
    pub p_failure: Limited,
    pub p_overturning: Limited,
    /// Whether the hazard ends too early for a rate of overturning.
    pub is_range: Option<bool>,
    /// Source of PGV / PGA.
    pub velocity_by: Option<VelocitySource>,
    /// Share of the rate of overturning beyond the last point of a curve that is extrapolated.
    pub share_extrapolated: Option<f64>,
    pub counted_motions: Option<i64>,
    pub counted_per_year: Limited,
    /// Widths of the base that meet the target by the estimate and by its upper limit.
    pub target_width_m: Option<f64>,
    pub target_width_m_high: Option<f64>,
    /// Where the depth is what is too small: the least of both sides.
    pub target_sides_m: Option<f64>,
    pub target_sides_m_high: Option<f64>,
}

/// The warnings about an answer, and the parts of the error of overturning: standard deviations of ln of its
/// annual rate, or of the logit of its probability; none where nothing of a part is unknown.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct DoubtsRow {
    /// Warnings, or why there is no answer.
    pub warnings: Option<String>,
    pub error_fit: Option<f64>,
    pub error_magnitude: Option<f64>,
    pub error_velocity: Option<f64>,
    pub error_eta: Option<f64>,
    pub error_object: Option<f64>,
    pub error_floor: Option<f64>,
    pub error_hazard: Option<f64>,
    /// The largest part.
    pub error_largest: Option<Part>,
}

impl DoubtsRow {
    /// The standard deviations of what is unknown, by part.
    pub fn part_sds(&self) -> Vec<(Part, f64)> {
        let sds = Part::ALL.iter().map(|part| {
            let sd = match part {
                Part::Fit => self.error_fit,
                Part::Magnitude => self.error_magnitude,
                Part::Velocity => self.error_velocity,
                Part::Eta => self.error_eta,
                Part::Object => self.error_object,
                Part::Floor => self.error_floor,
                Part::Hazard => self.error_hazard,
            };
            sd.map(|sd| (*part, sd))
        });
        sds.flatten().collect()
    }
}

/// What the fragility of an object comes to, over PGA in g or PGV in m/s.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FragilityRow {
    pub over: Option<Peak>,
    pub failure_16: Limited,
    pub failure_theta: Limited,
    pub failure_84: Limited,
    pub failure_beta: Option<f64>,
    pub failure_error: Option<f64>,
    pub overturning_16: Limited,
    pub overturning_theta: Limited,
    pub overturning_84: Limited,
    pub overturning_beta: Option<f64>,
    pub overturning_error: Option<f64>,
    #[serde(skip)]
    pub curve: Option<Fragility>,
}

/// A point of the fragility curve of an object: the shares of the motions of an intensity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CurveRow {
    pub structure: String,
    pub pga_g: Option<f64>,
    pub pgv_m_s: Option<f64>,
    pub p_rocking: Limited,
    pub p_failure: Limited,
    pub p_overturning: Limited,
}
