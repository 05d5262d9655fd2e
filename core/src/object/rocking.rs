//! An object with its models and its uncertainty, as changes that are applied on demand.

use std::sync::Arc;

use super::given::{Object, ObjectError};
use super::sides::Side;
use crate::fragility::{Model, MotionKind, RockingDirection, Tau};
use crate::motion::{Floor, IntensityMeasures, Peaks};
use crate::plausibility::{LEAST_ALPHA_RAD, LEAST_P_RAD_S};
use crate::rocking::Structure;
use crate::statistics::normal::Z_95;
use crate::warning::Warning;

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case")]
pub enum UncertaintySource {
    /// Parameters of the fragility model.
    Fit,
    Magnitude,
    /// Level of PGV / PGA.
    Velocity,
    Eta,
    /// Rebound from a wall.
    Wall,
    /// Centre of mass and inertia.
    Object,
    /// Building under the object.
    Floor,
    /// Fractiles of the hazard where they are given, and motions beyond the end of its curve.
    Hazard,
}

impl UncertaintySource {
    /// Whether it is the same for all objects of a list at a site.
    pub fn is_of_site(self) -> bool {
        use UncertaintySource::{Fit, Hazard, Magnitude, Velocity};
        matches!(self, Fit | Magnitude | Velocity | Hazard)
    }
}

/// An object in its directions, and its uncertainties.
#[derive(Debug, Clone, PartialEq)]
pub struct RockingObject {
    /// The weaker first; one or more.
    pub directions: Vec<RockingDirection>,
    /// The directions with each unknown of the object at its quantiles.
    pub perturbations: Vec<LowHigh<Vec<RockingDirection>>>,
}

/// A quantity that is uncertain, an object of which one is, or a result of either.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct LowHigh<T> {
    pub source: UncertaintySource,
    /// At its 2.5 % quantile, inside what is possible; of a hazard at the 16 % fractile, as agencies give it.
    pub low: T,
    /// At its 97.5 % quantile, or 84 % fractile.
    pub high: T,
}

impl<T> LowHigh<T> {
    pub fn map<U>(&self, result: impl Fn(&T) -> U) -> LowHigh<U> {
        LowHigh { source: self.source, low: result(&self.low), high: result(&self.high) }
    }
}

impl LowHigh<f64> {
    /// Of a normal distribution about 0.
    pub(crate) fn normal(source: UncertaintySource, sd: f64) -> LowHigh<f64> {
        LowHigh { source, low: -Z_95 * sd, high: Z_95 * sd }
    }
}

impl<T: Clone> LowHigh<T> {
    /// `results` are the estimate, then that with each error of the models at both quantiles.
    pub(crate) fn from_fit_errors(results: &[T]) -> impl Iterator<Item = LowHigh<T>> {
        let at_quantiles = results[1..].chunks_exact(2);
        at_quantiles.map(|at_quantiles| LowHigh {
            source: UncertaintySource::Fit,
            low: at_quantiles[0].clone(),
            high: at_quantiles[1].clone(),
        })
    }
}

/// Standard deviation of the logarithm of a building's period that is not given.
pub const SD_OF_PERIOD: f64 = 0.25;
/// Below this a coefficient of restitution is more likely a typing error.
const LOW_ETA: f64 = 0.5;
/// Share of a probability below which a direction adds nothing to it.
const LEAST_ADDED: f64 = 0.01;

impl RockingObject {
    /// Joins the [sides](Object::sides) of an object with the model of each, and puts these on its floor.
    ///
    /// # Errors
    /// Why there is no answer.
    pub fn new(object: &Object, models: Vec<Model>) -> Result<RockingObject, ObjectError> {
        let (sides, floor) = (object.sides()?, object.place.floor()?);
        let on = |floor: Option<Floor>| -> Option<Vec<Arc<Model>>> {
            models.iter().map(|model| Some(Arc::new(model.clone().on(floor)?))).collect()
        };
        let is_known = object.place.wall.is_none() || matches!(models[0], Model::Surface { .. });
        let problem = "period or wall: the paper's model is that of a free object on the ground";
        let problem = || ObjectError::Implausible(problem.to_string());
        let usual = on(floor).filter(|_| is_known).ok_or_else(problem)?;
        let directions = |models: &[Arc<Model>], structure: &dyn Fn(&Side) -> Structure| {
            let joined = sides.iter().zip(models).map(|(side, model)| RockingDirection {
                structure: structure(side),
                model: Arc::clone(model),
                count: None,
            });
            joined.collect::<Vec<RockingDirection>>()
        };
        // All sides of an object have the same sources of uncertainty.
        let of_shape = sides[0].at_quantiles.iter().enumerate().map(|(number, unknown)| LowHigh {
            source: unknown.source,
            low: directions(&usual, &|side| side.at_quantiles[number].low.clone()),
            high: directions(&usual, &|side| side.at_quantiles[number].high.clone()),
        });
        let of_floor = floor.map(|floor| {
            let sd = object.place.period_sd.unwrap_or(SD_OF_PERIOD);
            LowHigh::normal(UncertaintySource::Floor, sd).map(|off| {
                let moved = on(Some(Floor { period_s: floor.period_s * off.exp(), ..floor }));
                directions(&moved.unwrap_or_default(), &|side| side.structure.clone())
            })
        });
        Ok(RockingObject {
            directions: directions(&usual, &|side| side.structure.clone()),
            perturbations: of_shape.chain(of_floor).collect(),
        })
    }

    /// With the uncalibrated surface. `limit_state` is the demand |theta|max / alpha of failure.
    ///
    /// # Errors
    /// Why there is no answer.
    pub fn uncalibrated(
        object: &Object,
        kind: MotionKind,
        limit_state: f64,
    ) -> Result<RockingObject, ObjectError> {
        let sides = object.sides()?;
        let models = sides.iter().map(|side| Model::uncalibrated(kind, &side.structure, limit_state));
        RockingObject::new(object, models.collect())
    }

    /// One or more objects of a list, each as often as it is there: what happens to it happens to at least one
    /// of them. What is unknown of each object is left out.
    pub fn any_of<'a>(list: impl IntoIterator<Item = (&'a RockingObject, f64)>) -> RockingObject {
        let directions = list.into_iter().flat_map(|(object, count)| {
            object
                .directions
                .iter()
                .map(move |direction| RockingDirection { count: Some(count), ..direction.clone() })
        });
        RockingObject { directions: directions.collect(), perturbations: Vec::new() }
    }

    /// Results with each source of uncertainty at its quantiles.
    pub fn at_quantiles<T>(&self, result: impl Fn(&[RockingDirection]) -> T) -> Vec<LowHigh<T>> {
        self.perturbations.iter().map(|unknown| unknown.map(|directions| result(directions))).collect()
    }

    pub fn structure_warnings(&self) -> Vec<Warning> {
        self.directions.iter().flat_map(|direction| structure_warnings(&direction.structure)).collect()
    }

    /// Warnings about hardly possible structures, and about predictions under a motion: of the weaker
    /// direction, and of those that add to the probability of overturning.
    pub fn warnings(&self, motion: Peaks) -> Vec<Warning> {
        if motion.pga_m_s2 <= 0.0 {
            return self.structure_warnings();
        }
        let (mut warnings, mut most) = (Vec::new(), 0.0);
        for RockingDirection { structure, model, .. } in &self.directions {
            let measures = IntensityMeasures::new(structure, motion, None, None);
            let states = model.probabilities(structure, &measures, None, Tau::Averaged).limit_states();
            let p = states.overturning.map_or(1.0, |p| p.value);
            if p >= LEAST_ADDED * most {
                warnings.extend(structure_warnings(structure));
                warnings.extend(model.warnings(structure, &measures));
            }
            most = p.max(most);
        }
        warnings.sort();
        warnings.dedup();
        warnings
    }
}

pub fn structure_warnings(structure: &Structure) -> Vec<Warning> {
    let is_unlike = structure.p_rad_s < LEAST_P_RAD_S || structure.alpha_rad < LEAST_ALPHA_RAD;
    let size = is_unlike.then_some(Warning::ImplausibleSize);
    size.into_iter().chain((structure.eta < LOW_ETA).then_some(Warning::LowRestitution)).collect()
}
