//! What a stage that fits prints, and the warnings about its fits.

use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::fragility::Calibration;
use crate::keyword::Keyword;
use crate::number::{THREE_DIGITS, significant};
use crate::pipeline::options::first_lines;
use crate::statistics::FitStatus;
use crate::table::frame;
use crate::table::rows::{self, Row};
use crate::warning::Warnings;

/// A printed row: the surface beside what was observed.
#[derive(Serialize, Deserialize)]
struct CalibrationLine {
    suite: String,
    structure: String,
    limit: Option<String>,
    cases: i64,
    events: i64,
    calibration: String,
}

/// Calibrations as a table, with these headings of cases and events.
pub fn calibrations_text(
    rows: &[Calibration],
    [cases, events]: [&str; 2],
    out: &Path,
) -> anyhow::Result<String> {
    let line = |row: &Calibration| CalibrationLine {
        suite: suite_name(&row.suite),
        structure: row.structure.clone(),
        limit: row.limit_state.map(|limit_state| limit_state.to_string()),
        cases: row.n,
        events: row.n_events,
        calibration: calibration_in_words(row),
    };
    let lines: Vec<CalibrationLine> = rows.iter().map(line).collect();
    let mut frame = frame::of_batch(&rows::batch(&lines)?)?;
    frame.rename("cases", cases.into())?.rename("events", events.into())?;
    if rows.iter().all(|row| row.limit_state.is_none()) {
        frame = frame.drop("limit")?;
    }
    Ok(first_lines(&frame::text(&frame), 1, out))
}

fn calibration_in_words(row: &Calibration) -> String {
    match (row.n, row.n_events) {
        (0, _) => "no case".to_string(),
        (_, 0) => format!("none of {} predicted", significant(row.expected, 2)),
        (_, events) => format!("{:.2} times the prediction", events as f64 / row.expected),
    }
}

/// The first rows as a table; all are in a file.
pub fn text<R: Row>(lines: &[R], out: &Path) -> anyhow::Result<String> {
    Ok(first_lines(&frame::text(&frame::of_batch(&rows::batch(lines)?)?), 1, out))
}

/// A number with its limits, to three digits.
pub fn with_limits(value: f64, low: f64, high: f64) -> String {
    THREE_DIGITS.both([value, low, high].map(Some), "")
}

/// The name of a suite.
pub fn suite_name(suite: &Option<String>) -> String {
    suite.clone().unwrap_or_else(|| "-".to_string())
}

/// A status in plain words.
pub fn verdict(status: FitStatus) -> String {
    status.as_str().replace('_', " ")
}

/// Warnings about calibrations, each with its structure and suite.
pub fn warnings(rows: &[Calibration]) -> Warnings {
    let about = |row: &Calibration| match &row.suite {
        Some(suite) => format!("{} ({suite})", row.structure),
        None => row.structure.clone(),
    };
    rows.iter().flat_map(|row| row.warnings().into_iter().map(move |warning| (warning, about(row)))).collect()
}
