//! Rows of evaluate and of simulate, as the pages show them.

use std::path::Path;

use crate::report::rated::Evaluation;
use crate::report::response::{TracedPoint, TracedResponse};
use crate::stages::evaluate::{Answer, DoubtsRow, ObjectRow, RatesRow, pages};
use crate::table::TableError;
use crate::table::provenance::Provenance;
use crate::table::responses::TraceRow;
use crate::table::rows;

/// The most responses that are drawn.
const MOST_TRACES: usize = 50;

/// The evaluation in a file.
pub fn read(path: &Path, made: Option<&Provenance>) -> Result<Evaluation, TableError> {
    let objects = rows::read::<ObjectRow>(path)?;
    let rates = rows::read::<RatesRow>(path)?;
    let doubts = rows::read::<DoubtsRow>(path)?;
    let answers = objects.into_iter().zip(rates).zip(doubts);
    let answers = answers.map(|((object, row), doubts)| Answer { object, row, doubts, ..Answer::default() });
    let made = made.cloned().unwrap_or_default();
    let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    Ok(Evaluation { file, ..pages::over_hazard(&answers.collect::<Vec<_>>(), &made) })
}

/// The first responses over time of a file.
pub fn read_traces(path: &Path) -> Result<Vec<TracedResponse>, TableError> {
    let mut traces: Vec<TracedResponse> = Vec::new();
    for row in rows::read::<TraceRow>(path)? {
        let is_next =
            traces.last().is_none_or(|last| last.motion != row.motion_id || last.structure != row.structure);
        if is_next && traces.len() == MOST_TRACES {
            break;
        }
        if is_next {
            let (motion, structure) = (row.motion_id.clone(), row.structure.clone());
            traces.push(TracedResponse {
                motion,
                structure,
                alpha_rad: row.alpha_rad,
                width_m: row.block_width_m,
                height_m: row.block_height_m,
                points: Vec::new(),
            });
        }
        let Some(trace) = traces.last_mut() else { break };
        trace.points.push(TracedPoint {
            time_s: row.time_s,
            theta_over_alpha: row.theta_over_alpha,
            ground_m_s2: row.ground_acceleration_m_s2,
            ground_m_s: row.ground_velocity_m_s,
            event: row.solver_event,
        });
    }
    Ok(traces)
}
