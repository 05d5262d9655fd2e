//! The outputs of evaluate: what is predicted for each object, and points of fragility curves.

use rockfrag_core::fragility::{MotionKind, Peak, RockingDirection};
use rockfrag_core::hazard::{
    Bases, Budget, Fragility, Lognormal, SiteRates, VelocitySource, probability_in_years,
};
use rockfrag_core::object::{Object, UncertaintySource};
use rockfrag_core::statistics::Interval;
use rockfrag_core::warning::Warning;
use serde::{Deserialize, Serialize};
use strum::VariantArray;

/// What is predicted for an object.
#[derive(Debug, Clone, Default)]
pub struct Answer<R> {
    pub object: ObjectRow,
    pub row: R,
    pub doubts: UncertaintyRow,
    pub warnings: Vec<Warning>,
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
    /// The floor as the list of the object has it.
    pub floor: Option<String>,
    /// Number of such objects.
    pub count: Option<f64>,
    pub p_rad_s: Option<f64>,
    pub alpha_rad: Option<f64>,
    pub eta: Option<f64>,
    /// tan(alpha): with less friction it slides.
    pub friction: Option<f64>,
    pub model: Option<String>,
    /// Kind of motion that the model is for.
    pub motions: Option<MotionKind>,
    pub limit_state: Option<f64>,
    /// Block, body or frame; empty if read from a file.
    #[serde(skip)]
    pub kind: &'static str,
    /// Name of its file; empty if not read from one.
    #[serde(skip)]
    pub file: String,
    /// Whether friction was given, and is enough.
    #[serde(skip)]
    pub is_friction_known: bool,
}

impl ObjectRow {
    /// Makes the row of an object and, if it has an answer, of the structure and model that predict for it.
    pub fn new(object: &Object, by: Option<&RockingDirection>, limit_state: f64) -> ObjectRow {
        let (shape, floor) = (&object.shape, object.place.floor().ok().flatten());
        let structure = by.map(|direction| &direction.structure);
        ObjectRow {
            structure: object.name.clone(),
            width_m: shape.width,
            depth_m: shape.depth,
            height_m: shape.height,
            floor_period_s: floor.map(|floor| floor.period_s),
            floor_level: floor.map(|floor| floor.level),
            floor: object.floor.clone().filter(|_| floor.is_some()),
            count: object.count.map(f64::from),
            p_rad_s: structure.map(|structure| structure.p_rad_s),
            alpha_rad: structure.map(|structure| structure.alpha_rad),
            eta: structure.map(|structure| structure.eta),
            friction: structure.map(|structure| structure.alpha_rad.tan()),
            model: by.map(|direction| direction.model.description()),
            motions: by.map(|direction| direction.model.kind()),
            limit_state: by.map(|_| limit_state),
            kind: shape.kind(),
            file: String::new(),
            is_friction_known: object.place.friction.is_some(),
        }
    }
}

/// Annual rates of an object, and probabilities in the time of exposure. Where the hazard ends too early for
/// a value there is a range alone, in the columns of limits.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct RatesRow {
    pub rocking_per_year: Option<f64>,
    pub failure_per_year: Interval<Option<f64>>,
    pub overturning_per_year: Interval<Option<f64>>,
    pub return_period_years: Option<f64>,
    pub years: Option<f64>,
    pub p_rocking: Option<f64>,
    pub p_failure: Interval<Option<f64>>,
    pub p_overturning: Interval<Option<f64>>,
    /// Whether the hazard ends too early for a rate of overturning.
    pub is_range: Option<bool>,
    /// Source of PGV / PGA.
    pub velocity_by: Option<VelocitySource>,
    /// Share of the rate of overturning beyond the last point of a curve that is extrapolated.
    pub share_extrapolated: Option<f64>,
    pub bases: Bases,
}

impl RatesRow {
    pub fn new(rates: &SiteRates, years: f64, bases: Bases) -> RatesRow {
        let (rocking, failure, overturning) =
            (rates.states.rocking.value, rates.states.failure, rates.states.overturning);
        RatesRow {
            rocking_per_year: rocking,
            failure_per_year: failure,
            overturning_per_year: overturning,
            return_period_years: overturning.value.map(f64::recip).filter(|years| years.is_finite()),
            years: Some(years),
            p_rocking: rocking.map(|rate| probability_in_years(rate, years)),
            p_failure: failure.map(|rate| probability_in_years(rate, years)),
            p_overturning: overturning.map(|rate| probability_in_years(rate, years)),
            is_range: overturning.low.map(|_| overturning.value.is_none()),
            velocity_by: rates.pgv_pga_source,
            share_extrapolated: rates.beyond,
            bases,
        }
    }
}

/// The warnings about an answer, and the parts of the error of overturning: standard deviations of ln of its
/// annual rate, or of the logit of its probability; none where nothing of a part is unknown.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct UncertaintyRow {
    /// Warnings, or why there is no answer.
    pub warnings: Option<String>,
    pub error_fit: Option<f64>,
    pub error_magnitude: Option<f64>,
    pub error_velocity: Option<f64>,
    pub error_eta: Option<f64>,
    pub error_object: Option<f64>,
    pub error_floor: Option<f64>,
    pub error_hazard: Option<f64>,
    /// The largest source.
    pub error_largest: Option<UncertaintySource>,
}

impl UncertaintyRow {
    pub fn new(warnings: &[Warning], budget: &Budget) -> UncertaintyRow {
        let texts: Vec<&str> = warnings.iter().map(|warning| warning.text()).collect();
        UncertaintyRow {
            warnings: (!texts.is_empty()).then(|| texts.join("; ")),
            error_fit: budget.source_sd(UncertaintySource::Fit),
            error_magnitude: budget.source_sd(UncertaintySource::Magnitude),
            error_velocity: budget.source_sd(UncertaintySource::Velocity),
            error_eta: budget.source_sd(UncertaintySource::Eta),
            error_object: budget.source_sd(UncertaintySource::Object),
            error_floor: budget.source_sd(UncertaintySource::Floor),
            error_hazard: budget.source_sd(UncertaintySource::Hazard),
            error_largest: budget.largest(),
        }
    }

    /// The standard deviations of what is unknown, by source.
    pub fn source_sds(&self) -> Vec<(UncertaintySource, f64)> {
        let row = serde_json::json!(self);
        let sd = |source: &UncertaintySource| Some((*source, row[format!("error_{source}")].as_f64()?));
        UncertaintySource::VARIANTS.iter().filter_map(sd).collect()
    }
}

/// What the fragility of an object comes to, over PGA in g or PGV in m/s.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FragilityRow {
    pub over: Option<Peak>,
    pub failure: Lognormal,
    pub overturning: Lognormal,
    #[serde(skip)]
    pub curve: Option<Fragility>,
}

impl FragilityRow {
    pub fn new(fragility: Fragility) -> FragilityRow {
        let (_, unit, _) = fragility.over.name_and_unit();
        let [failure, overturning] = [fragility.failure, fragility.overturning].map(|of| Lognormal {
            at_16: of.at_16.map(|intensity| intensity / unit),
            theta: of.theta.map(|intensity| intensity / unit),
            at_84: of.at_84.map(|intensity| intensity / unit),
            ..of
        });
        FragilityRow { over: Some(fragility.over), failure, overturning, curve: Some(fragility) }
    }
}

/// A point of the fragility curve of an object: the shares of the motions of an intensity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CurveRow {
    pub structure: String,
    pub pga_g: Option<f64>,
    pub pgv_m_s: Option<f64>,
    pub p_rocking: Interval<Option<f64>>,
    pub p_failure: Interval<Option<f64>>,
    pub p_overturning: Interval<Option<f64>>,
}
