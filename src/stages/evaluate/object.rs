//! What is predicted for each object of a call, the worst first.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::explain::explained;
use crate::fragility::{Direction, Kind, Model};
use crate::hazard::Budget;
use crate::motion::Peaks;
use crate::number::Limited;
use crate::object::{Object, Part, Subject};
use crate::pipeline::context::Progress;
use crate::stages::shared::model_args::{Models, words_of};
use crate::table::rows::Row;
use crate::warning::Warning;

/// What is predicted for an object.
#[derive(Default)]
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

/// A row of predictions; the default one is that of an object without an answer.
pub trait Predicted: Row + Default + Send + Sync {
    /// Probability or rate of overturning.
    fn overturning(&self) -> Limited;

    /// By which objects are sorted, the worst first.
    fn severity(&self) -> f64 {
        let rate = self.overturning();
        rate.value.or(rate.high).unwrap_or(f64::NEG_INFINITY)
    }
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
    /// Block, body or frame.
    #[serde(skip)]
    pub kind: &'static str,
    /// Whether friction was given, and is enough.
    #[serde(skip)]
    pub is_friction_known: bool,
}

impl ObjectRow {
    /// Of an object and, if it has an answer, of the structure and the model that predict for it.
    fn new(object: &Object, by: Option<&Direction>, limit_state: f64) -> ObjectRow {
        let (shape, floor) = (&object.shape, object.place.floor().ok().flatten());
        let structure = by.map(|direction| &direction.structure);
        ObjectRow {
            structure: object.name.clone(),
            width_m: shape.width,
            depth_m: shape.depth,
            height_m: shape.height,
            floor_period_s: floor.map(|floor| floor.period_s),
            floor_level: floor.map(|floor| floor.level),
            count: object.count.map(f64::from),
            p_rad_s: structure.map(|structure| structure.p_rad_s),
            alpha_rad: structure.map(|structure| structure.alpha_rad),
            eta: structure.map(|structure| structure.eta),
            friction: structure.map(|structure| structure.alpha_rad.tan()),
            model: by.map(|direction| words_of(&direction.model)),
            motions: by.map(|direction| direction.model.kind()),
            limit_state: by.map(|_| limit_state),
            kind: shape.kind(),
            is_friction_known: object.place.friction.is_some(),
        }
    }
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
    pub fn new(warnings: &[Warning], budget: &Budget) -> DoubtsRow {
        let texts: Vec<&str> = warnings.iter().map(|warning| warning.text()).collect();
        DoubtsRow {
            warnings: (!texts.is_empty()).then(|| texts.join("; ")),
            error_fit: budget.part_sd(Part::Fit),
            error_magnitude: budget.part_sd(Part::Magnitude),
            error_velocity: budget.part_sd(Part::Velocity),
            error_eta: budget.part_sd(Part::Eta),
            error_object: budget.part_sd(Part::Object),
            error_floor: budget.part_sd(Part::Floor),
            error_hazard: budget.part_sd(Part::Hazard),
            error_largest: budget.largest(),
        }
    }

    /// The standard deviation that a part causes; none where nothing of it is unknown.
    pub fn part_sd(&self, part: Part) -> Option<f64> {
        match part {
            Part::Fit => self.error_fit,
            Part::Magnitude => self.error_magnitude,
            Part::Velocity => self.error_velocity,
            Part::Eta => self.error_eta,
            Part::Object => self.error_object,
            Part::Floor => self.error_floor,
            Part::Hazard => self.error_hazard,
        }
    }
}

/// Predicts for all objects, the worst first. `predict` gives a row, the errors of the logit of the
/// probability of overturning or of ln of its rate, the motion that matters, and warnings.
pub fn answers<R: Predicted>(
    objects: Vec<Object>,
    models: &Models,
    explain: bool,
    bar: &Progress,
    predict: impl Fn(&Object, &Subject) -> (R, Budget, Peaks, Vec<Warning>) + Sync,
) -> anyhow::Result<Vec<Answer<R>>> {
    let answer = |object: Object| -> anyhow::Result<Answer<R>> {
        bar.advance(1)?;
        if let Err(reason) = object.sides() {
            let doubts = DoubtsRow { warnings: Some(reason.to_string()), ..DoubtsRow::default() };
            let object = ObjectRow::new(&object, None, models.args.limit_state);
            return Ok(Answer { object, doubts, ..Answer::default() });
        }
        let (subject, mut warnings) = models.subject(&object)?;
        let (row, budget, motion, of_prediction) = predict(&object, &subject);
        warnings.extend(of_prediction);
        warnings.extend(subject.warnings(motion));
        warnings.sort();
        warnings.dedup();
        let weaker = &subject.directions[0];
        let Direction { structure, model } = weaker;
        Ok(Answer {
            object: ObjectRow::new(&object, Some(weaker), models.args.limit_state),
            row,
            doubts: DoubtsRow::new(&warnings, &budget),
            warnings,
            responses: match model {
                Model::Calibrated { overturning, .. } => overturning.n,
                Model::Paper { overturning, .. } => overturning.n,
            },
            explained: if explain { explained(model, structure, motion, &budget) } else { String::new() },
        })
    };
    // The first error in the order of the objects, whichever thread meets one first.
    let all: Vec<_> = objects.into_par_iter().map(answer).collect();
    let mut all = all.into_iter().collect::<anyhow::Result<Vec<_>>>()?;
    all.sort_by(|a, b| b.row.severity().total_cmp(&a.row.severity()));
    Ok(all)
}
