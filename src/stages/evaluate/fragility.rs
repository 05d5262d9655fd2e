//! The fragility of objects: the intensities that half of the motions need, the curve, and in words.

use std::path::Path;

use rockfrag_core::fragility::Peak;
use rockfrag_core::hazard::{Fragility, FragilityPoint, format_intensity};
use rockfrag_core::statistics::Interval;
use rockfrag_core::units::G_M_S2;

use super::object::Predicted;
use super::words::{about_buildings, line, model, model_of_all, mostly_unknown, table, validity};
use crate::document::fragility::{cells, half_in_words};
use crate::number::{aligned, significant};
use crate::table::answers::{Answer, CurveRow, FragilityRow};

impl Predicted for FragilityRow {
    fn overturning(&self) -> Interval<Option<f64>> {
        self.overturning.theta
    }

    fn severity(&self) -> f64 {
        let weakest = self.overturning.theta.value.map_or(0.0, f64::recip);
        if self.over.is_some() { weakest } else { f64::NEG_INFINITY }
    }
}

/// The curves of all objects, one below the other.
pub fn curves(all: &[Answer<FragilityRow>]) -> Vec<CurveRow> {
    let mut rows = Vec::new();
    for (structure, curve) in
        all.iter().filter_map(|answer| Some((&answer.object.structure, answer.row.curve.as_ref()?)))
    {
        for FragilityPoint { intensity, p } in &curve.points {
            rows.push(CurveRow {
                structure: structure.clone(),
                pga_g: (curve.over == Peak::Pga).then_some(intensity / G_M_S2),
                pgv_m_s: (curve.over == Peak::Pgv).then_some(*intensity),
                p_rocking: p.rocking,
                p_failure: p.failure,
                p_overturning: p.overturning,
            });
        }
    }
    rows
}

/// The answer for all objects, in words.
pub fn text(all: &[Answer<FragilityRow>], out: Option<&Path>) -> String {
    super::words::text(all, tell, || tell_list(all, out))
}

fn tell(answer: &Answer<FragilityRow>) -> String {
    let Answer { object, row, .. } = answer;
    let Some(Fragility { over, failure, overturning, .. }) = &row.curve else { return String::new() };
    let heads = ["", "half", "", "16 %", "84 %"].map(String::from);
    let too_far = format!("{}, or overturns", object.too_far());
    let mut lines = vec![heads.to_vec()];
    for (name, state) in [(too_far, failure), ("overturns".to_string(), overturning)] {
        lines.push([vec![name], cells(*over, state, "95 % limits ")].concat());
    }
    let (half, lines) = (half(answer), aligned(&lines, |_| false));
    let lognormal = overturning.beta.zip(overturning.largest_error).map(|(beta, error)| {
        let [beta, error] = [beta, error].map(|value| significant(value, 2));
        format!("Overturning is lognormal with beta {beta}, within {error}.")
    });
    let unknown = line([mostly_unknown(answer, "Add --ratio, --vs30 or --hazard."), lognormal]);
    format!("{half}\n{lines}{unknown}By {}.\n{}", model(object), validity(answer))
}

/// The intensity at which half of the motions overturn an object.
fn half(Answer { object, row, .. }: &Answer<FragilityRow>) -> String {
    let Some(Fragility { over, overturning, .. }) = &row.curve else { return object.title() };
    format!("{}: half of the motions overturn it at a {}", object.title(), half_in_words(*over, overturning))
}

fn tell_list(all: &[Answer<FragilityRow>], out: Option<&Path>) -> String {
    let rows = table(&["overturns", "", "16 %", "84 %", "too far"], all, out, |Answer { row, .. }| {
        row.curve.as_ref().map_or(
            vec!["-".to_string(); 5],
            |Fragility { over, failure, overturning, .. }| {
                let too_far = format_intensity(*over, failure.theta.value);
                [cells(*over, overturning, "95 % limits "), vec![too_far]].concat()
            },
        )
    });
    let over = all[0].row.over.unwrap_or(Peak::Pga).name_and_unit().0;
    let by = format!("{over} at which half of the motions have the effect, by {}.", model_of_all(all));
    format!("{}\n{rows}{}", half(&all[0]), line([Some(by), about_buildings(all)]))
}
