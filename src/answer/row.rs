//! The columns of an answer. Those of another question than the one that was asked are empty.

use std::collections::BTreeSet;

use rockfrag_core::fragility::{
    AssumedMagnitude, LimitStates, MagnitudeSource, MotionKind, Peak, RockingDirection, Tau,
};
use rockfrag_core::hazard::{
    Bases, Budget, FragilityPoint, GroundMotion, Lognormal, SiteRates, VelocitySource, probability_in_years,
};
use rockfrag_core::motion::{IntensityMeasures, Peaks};
use rockfrag_core::object::{Base, Object, RockingObject, Shape, UncertaintySource};
use rockfrag_core::statistics::Interval;
use rockfrag_core::units::G_M_S2;
use rockfrag_core::warning::Warning;
use serde::{Deserialize, Serialize};
use strum::VariantArray;

/// An object and the model that predicts for it; without parameters where it has no answer.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ObjectColumns {
    pub structure: String,
    /// Block, body, frame or structure.
    pub object_kind: Option<String>,
    pub width_m: Option<f64>,
    pub depth_m: Option<f64>,
    pub height_m: Option<f64>,
    pub centre_height_m: Option<f64>,
    pub centre_offset_m: Option<f64>,
    pub floor_period_s: Option<f64>,
    pub floor_level: Option<f64>,
    /// The floor as the list of the object has it.
    pub floor: Option<String>,
    pub count: Option<f64>,
    pub p_rad_s: Option<f64>,
    pub alpha_rad: Option<f64>,
    pub eta: Option<f64>,
    /// What it stands on, if that sets eta.
    pub base: Option<Base>,
    /// Of an object on a pedestal: fixed, it is one body with it; else it is loose on it.
    pub is_fixed_to_pedestal: Option<bool>,
    pub wall_rebound: Option<f64>,
    /// tan(alpha): with less friction it slides.
    pub friction: Option<f64>,
    /// Whether its friction was given, and is enough.
    pub is_friction_known: Option<bool>,
    pub model: Option<String>,
    pub motions: Option<MotionKind>,
    pub responses: Option<i64>,
    pub limit_state: Option<f64>,
}

impl ObjectColumns {
    /// Makes the columns of an object and, if it has an answer, of the direction in which it is weaker.
    pub fn new(object: &Object, weaker: Option<&RockingDirection>) -> ObjectColumns {
        let (shape, floor) = (&object.shape, object.place.floor().ok().flatten());
        let (structure, model) =
            weaker.map(|RockingDirection { structure, model, .. }| (structure, model)).unzip();
        ObjectColumns {
            structure: object.name.clone(),
            object_kind: Some(shape.kind().to_string()),
            width_m: shape.width,
            depth_m: shape.depth,
            height_m: shape.height,
            centre_height_m: centre_height(shape),
            centre_offset_m: centre_height(shape).map(|_| shape.centre_offset.unwrap_or(0.0)),
            floor_period_s: floor.map(|floor| floor.period_s),
            floor_level: floor.map(|floor| floor.level),
            floor: object.floor.clone().filter(|_| floor.is_some()),
            count: object.count.map(f64::from),
            p_rad_s: structure.map(|structure| structure.p_rad_s),
            alpha_rad: structure.map(|structure| structure.alpha_rad),
            eta: structure.map(|structure| structure.eta),
            base: object.place.base,
            is_fixed_to_pedestal: object.place.fixed_to_pedestal,
            wall_rebound: structure.and_then(|structure| structure.rebound),
            friction: structure.map(|structure| structure.alpha_rad.tan()),
            is_friction_known: Some(object.place.friction.is_some()),
            model: model.map(|model| model.description()),
            motions: model.map(|model| model.kind()),
            responses: model.map(|model| model.responses()),
            limit_state: model.and_then(|model| model.limit_state()),
        }
    }
}

/// The height of the centre of mass, m; none of a frame, which has none of its own.
fn centre_height(shape: &Shape) -> Option<f64> {
    let height = shape.height.filter(|_| shape.beam_mass_ratio.is_none())?;
    Some(shape.centre_height.unwrap_or(0.5 * height))
}

/// Of the paper's tree under a motion (Eqs. 8 to 12) what is given rocking; none where it is not known.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TreeColumns {
    pub pga_m_s2: Option<f64>,
    pub pgv_m_s: Option<f64>,
    pub p_ex: Interval<Option<f64>>,
    pub p_ro: Interval<Option<f64>>,
}

impl TreeColumns {
    /// Of an object with these probabilities under a motion.
    pub fn new(
        motion: &GroundMotion,
        object: &RockingObject,
        states: LimitStates<Interval<Option<f64>>>,
    ) -> TreeColumns {
        // The demand has a probability of its own under a motion that is known.
        let p_ex = match (&object.directions[..], motion.pga_m_s2, motion.pgv_m_s) {
            _ if motion.is_still() => None,
            ([RockingDirection { structure, model, .. }], Some(pga_m_s2), Some(pgv_m_s)) => {
                let measures = IntensityMeasures::new(structure, Peaks { pga_m_s2, pgv_m_s }, None, None);
                model.probabilities(structure, &measures, motion.mw, Tau::Included).given_rocking
            }
            _ => None,
        };
        let rocking = states.rocking.value.filter(|rocking| *rocking > 0.0);
        TreeColumns {
            pga_m_s2: motion.pga_m_s2,
            pgv_m_s: motion.pgv_m_s,
            p_ex: p_ex.and_then(|given| given.p_ex).into(),
            p_ro: rocking.map_or(Interval::default(), |rocking| states.overturning.map(|p| p / rocking)),
        }
    }
}

/// Probabilities of the limit states: under a motion, or in the time of exposure.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct StateColumns {
    pub p_rocking: Option<f64>,
    pub p_failure: Interval<Option<f64>>,
    pub p_overturning: Interval<Option<f64>>,
}

impl StateColumns {
    pub fn new(states: LimitStates<Interval<Option<f64>>>) -> StateColumns {
        let LimitStates { rocking, failure, overturning } = states;
        StateColumns { p_rocking: rocking.value, p_failure: failure, p_overturning: overturning }
    }
}

/// Annual rates of an object at a site.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RateColumns {
    pub rocking_per_year: Option<f64>,
    pub failure_per_year: Interval<Option<f64>>,
    pub overturning_per_year: Interval<Option<f64>>,
    pub return_period_years: Option<f64>,
    pub years: Option<f64>,
    /// The changes of [`RateColumns::budget`], as JSON.
    pub rate_changes: Option<String>,
    pub velocity_by: Option<VelocitySource>,
    /// Share of the rate of overturning beyond the last point of the hazard curve.
    pub share_extrapolated: Option<f64>,
    /// Probability of overturning that is aimed at.
    pub target: Option<f64>,
    pub bases: Bases,
}

impl RateColumns {
    pub fn new(rates: &SiteRates, years: f64) -> (RateColumns, StateColumns) {
        let LimitStates { rocking, failure, overturning } = rates.states;
        let columns = RateColumns {
            rocking_per_year: rocking.value,
            failure_per_year: failure,
            overturning_per_year: overturning,
            return_period_years: overturning.value.map(f64::recip).filter(|years| years.is_finite()),
            years: Some(years),
            rate_changes: overturning.value.and_then(|_| serde_json::to_string(&rates.budget.changes).ok()),
            velocity_by: rates.pgv_pga_source,
            share_extrapolated: rates.beyond,
            ..RateColumns::default()
        };
        let in_years = rates.states.map(|rate| rate.map(|rate| probability_in_years(rate, years)));
        (columns, StateColumns::new(in_years))
    }

    /// What is unknown of the rate of overturning.
    pub fn budget(&self) -> Option<Budget> {
        Some(Budget { changes: serde_json::from_str(self.rate_changes.as_ref()?).ok()? })
    }
}

/// What the fragility of an object comes to, over PGA in g or PGV in m/s.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FragilityColumns {
    pub over: Option<Peak>,
    pub failure: Lognormal,
    pub overturning: Lognormal,
}

/// A point of the fragility curve of an object: the shares of the motions of an intensity.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct CurveRow {
    pub pga_g: Option<f64>,
    pub pgv_m_s: Option<f64>,
    pub p_rocking: Interval<Option<f64>>,
    pub p_failure: Interval<Option<f64>>,
    pub p_overturning: Interval<Option<f64>>,
}

impl CurveRow {
    pub fn new(over: Option<Peak>, FragilityPoint { intensity, p }: &FragilityPoint) -> CurveRow {
        CurveRow {
            pga_g: (over == Some(Peak::Pga)).then_some(intensity / G_M_S2),
            pgv_m_s: (over == Some(Peak::Pgv)).then_some(*intensity),
            p_rocking: p.rocking,
            p_failure: p.failure,
            p_overturning: p.overturning,
        }
    }

    pub fn point(&self) -> Option<FragilityPoint> {
        let (rocking, failure, overturning) = (self.p_rocking, self.p_failure, self.p_overturning);
        Some(FragilityPoint {
            intensity: self.pga_g.map(|pga_g| pga_g * G_M_S2).or(self.pgv_m_s)?,
            p: LimitStates { rocking, failure, overturning },
        })
    }
}

/// What an answer assumes, the warnings about it, and the parts of the error of overturning: standard
/// deviations of ln of its annual rate, or of the logit of its probability.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct UncertaintyColumns {
    /// The magnitude, and its standard deviation where it is not given.
    pub magnitude: Option<f64>,
    pub magnitude_sd: Option<f64>,
    pub magnitude_by: Option<MagnitudeSource>,
    /// PGV / PGA of the motion that the answer is for, or turns on.
    pub pgv_pga_s: Option<f64>,
    /// Warnings, or why there is no answer.
    pub warnings: Option<String>,
    pub error_fit: Option<f64>,
    pub error_magnitude: Option<f64>,
    pub error_velocity: Option<f64>,
    pub error_eta: Option<f64>,
    pub error_wall: Option<f64>,
    pub error_object: Option<f64>,
    pub error_floor: Option<f64>,
    pub error_hazard: Option<f64>,
    pub error_largest: Option<UncertaintySource>,
}

/// Stands between warnings.
const BETWEEN: &str = "; ";

impl UncertaintyColumns {
    pub fn new(
        warnings: Vec<Warning>,
        budget: &Budget,
        magnitude: Option<AssumedMagnitude>,
        motion: Peaks,
    ) -> UncertaintyColumns {
        let texts: Vec<&str> = BTreeSet::from_iter(warnings).into_iter().map(Warning::text).collect();
        let pgv_pga_s = motion.pgv_m_s / motion.pga_m_s2;
        UncertaintyColumns {
            magnitude: magnitude.map(|magnitude| magnitude.mw),
            magnitude_sd: magnitude.map(|magnitude| magnitude.sd),
            magnitude_by: magnitude.map(|magnitude| magnitude.source),
            pgv_pga_s: Some(pgv_pga_s).filter(|ratio| *ratio > 0.0 && ratio.is_finite()),
            warnings: (!texts.is_empty()).then(|| texts.join(BETWEEN)),
            error_fit: budget.source_sd(UncertaintySource::Fit),
            error_magnitude: budget.source_sd(UncertaintySource::Magnitude),
            error_velocity: budget.source_sd(UncertaintySource::Velocity),
            error_eta: budget.source_sd(UncertaintySource::Eta),
            error_wall: budget.source_sd(UncertaintySource::Wall),
            error_object: budget.source_sd(UncertaintySource::Object),
            error_floor: budget.source_sd(UncertaintySource::Floor),
            error_hazard: budget.source_sd(UncertaintySource::Hazard),
            error_largest: budget.largest(),
        }
    }

    /// The standard deviations of what is unknown, by source.
    pub fn source_sds(&self) -> Vec<(UncertaintySource, f64)> {
        let of_motion = [self.error_fit, self.error_magnitude, self.error_velocity];
        let of_object = [self.error_eta, self.error_wall, self.error_object, self.error_floor];
        let sds = of_motion.into_iter().chain(of_object).chain([self.error_hazard]);
        // What moves a rate by less than a percent is not told.
        let sds = sds.map(|sd| sd.filter(|sd| *sd > 0.005));
        let known = UncertaintySource::VARIANTS.iter().zip(sds).map(|(source, sd)| Some((*source, sd?)));
        known.flatten().collect()
    }

    /// The warnings; none for an object without an answer.
    pub fn warnings(&self) -> Vec<Warning> {
        let texts: Vec<&str> = self.warnings.iter().flat_map(|texts| texts.split(BETWEEN)).collect();
        Warning::VARIANTS.iter().copied().filter(|warning| texts.contains(&warning.text())).collect()
    }
}
