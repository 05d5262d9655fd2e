//! What is predicted for each object of a call, the worst first.

use rayon::prelude::*;
use rockfrag_core::fragility::Model;
use rockfrag_core::hazard::Budget;
use rockfrag_core::motion::Peaks;
use rockfrag_core::object::{Object, RockingObject};
use rockfrag_core::statistics::Interval;
use rockfrag_core::warning::Warning;

use crate::pipeline::context::Context;
use crate::stages::shared::model_args::Models;
use crate::table::answers::{Answer, ObjectRow, UncertaintyRow};
use crate::table::rows::Row;

/// A row of predictions; the default one is that of an object without an answer.
pub trait Predicted: Row + Default + Send + Sync {
    /// Probability or rate of overturning.
    fn overturning(&self) -> Interval<Option<f64>>;

    /// By which objects are sorted, the worst first.
    fn severity(&self) -> f64 {
        let rate = self.overturning();
        rate.value.or(rate.high).unwrap_or(f64::NEG_INFINITY)
    }
}

/// What is predicted for an object that has an answer.
pub struct Prediction<R> {
    pub row: R,
    /// Errors of the logit of the probability of overturning, or of ln of its rate.
    pub budget: Budget,
    /// The motion that matters.
    pub motion: Peaks,
    pub warnings: Vec<Warning>,
}

/// Predicts for all objects, the worst first.
pub fn answers<R: Predicted>(
    objects: &[Object],
    models: &Models,
    context: &Context,
    predict: impl Fn(&Object, &RockingObject) -> Prediction<R> + Sync,
) -> anyhow::Result<Vec<Answer<R>>> {
    let bar = context.bar(objects.len());
    let answer = |object: &Object| -> anyhow::Result<Answer<R>> {
        bar.advance(1)?;
        if let Err(reason) = object.sides() {
            let doubts = UncertaintyRow { warnings: Some(reason.to_string()), ..UncertaintyRow::default() };
            let object = ObjectRow::new(object, None, models.args.limit_state);
            return Ok(Answer { object, doubts, ..Answer::default() });
        }
        let (rocking_object, mut warnings) = models.rocking_object(object)?;
        let predicted = predict(object, &rocking_object);
        warnings.extend(predicted.warnings);
        warnings.extend(rocking_object.warnings(predicted.motion));
        warnings.sort();
        warnings.dedup();
        let weaker = &rocking_object.directions[0];
        Ok(Answer {
            object: ObjectRow::new(object, Some(weaker), models.args.limit_state),
            row: predicted.row,
            doubts: UncertaintyRow::new(&warnings, &predicted.budget),
            warnings,
            responses: match &weaker.model {
                Model::Surface { overturning, .. } => overturning.n,
                Model::Paper { overturning, .. } => overturning.n,
            },
        })
    };
    // The first error in the order of the objects, whichever thread meets one first.
    let all: Vec<_> = objects.par_iter().map(answer).collect();
    let mut all = all.into_iter().collect::<anyhow::Result<Vec<_>>>()?;
    all.sort_by(|a, b| b.row.severity().total_cmp(&a.row.severity()));
    Ok(all)
}
