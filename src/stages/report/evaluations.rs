//! Rows of evaluate and of simulate, as the pages show them.

use std::path::Path;

use crate::fragility::{LimitStates, Peak};
use crate::hazard::{Fragility, FragilityPoint};
use crate::number::Limited;
use crate::report::answers::Evaluation;
use crate::report::response::Trace;
use crate::stages::evaluate::pages;
use crate::statistics::Estimate;
use crate::table::TableError;
use crate::table::answers::{Answer, CurveRow, DoubtsRow, FragilityRow, ObjectRow, RatesRow};
use crate::table::provenance::Provenance;
use crate::table::responses::TraceRow;
use crate::table::rows;
use crate::units::G_M_S2;

/// The most responses that are drawn.
const MOST_TRACES: usize = 50;

/// The evaluation in a file.
pub fn read(path: &Path, made: Option<&Provenance>) -> Result<Evaluation, TableError> {
    let (objects, doubts) = (rows::read::<ObjectRow>(path)?, rows::read::<DoubtsRow>(path)?);
    let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let mut answers = Vec::new();
    for ((object, row), doubts) in objects.into_iter().zip(rows::read::<RatesRow>(path)?).zip(doubts) {
        let object = ObjectRow { file: file.clone(), ..object };
        answers.push(Answer { object, row, doubts, ..Answer::default() });
    }
    Ok(pages::over_hazard(answers, &made.cloned().unwrap_or_default()))
}

/// The fragility curves of a file, those that need least first.
pub fn read_fragility(path: &Path) -> Result<Vec<Answer<FragilityRow>>, TableError> {
    let mut all = Vec::new();
    for curve in rows::read::<CurveRow>(path)?.chunk_by(|a, b| a.structure == b.structure) {
        let points = curve.iter().map(|row| FragilityPoint {
            intensity: row.pga_g.map(|pga_g| pga_g * G_M_S2).or(row.pgv_m_s).unwrap_or(f64::NAN),
            p: LimitStates {
                rocking: estimate(row.p_rocking),
                failure: estimate(row.p_failure),
                overturning: estimate(row.p_overturning),
            },
        });
        let over = if curve[0].pga_g.is_some() { Peak::Pga } else { Peak::Pgv };
        let object = ObjectRow { structure: curve[0].structure.clone(), ..ObjectRow::default() };
        let curve = Some(Fragility::from_points(over, points.collect()));
        let row = FragilityRow { over: Some(over), curve, ..FragilityRow::default() };
        all.push(Answer { object, row, ..Answer::default() });
    }
    Ok(all)
}

fn estimate(p: Limited) -> Estimate {
    let [value, low, high] = [p.value, p.low, p.high].map(|p| p.unwrap_or(f64::NAN));
    Estimate { value, low, high }
}

/// The first responses over time of a file.
pub fn read_traces(path: &Path) -> Result<Vec<Trace>, TableError> {
    let rows = rows::read::<TraceRow>(path)?;
    let traces = rows.chunk_by(|a, b| a.motion_id == b.motion_id && a.structure == b.structure);
    Ok(traces.take(MOST_TRACES).map(|trace| Trace(trace.to_vec())).collect())
}
