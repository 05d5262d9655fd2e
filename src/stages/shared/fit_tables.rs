//! What a stage that fits prints, and the warnings about its fits.

use std::cmp::Ordering;
use std::ops::Range;
use std::path::Path;

use rockfrag_core::fragility::Calibration;
use rockfrag_core::statistics::FitStatus;
use rockfrag_core::warning::Warnings;

use crate::number::{aligned, count, fixed, significant};
use crate::pipeline::options::first_lines;

/// Calibrations as a table, the surface beside what was observed, with these headings of cases and events.
pub fn calibrations_text(rows: &[Calibration], [cases, events]: [&str; 2], out: &Path) -> String {
    let lines = rows.iter().map(|row| {
        let calibration = match (row.n, row.n_events) {
            (0, _) => "no case".to_string(),
            (_, 0) => format!("none of {} predicted", significant(row.expected, 2)),
            (_, events) => format!("{:.2} times the prediction", events as f64 / row.expected),
        };
        let limit = row.limit_state.map(|limit_state| limit_state.to_string());
        let [cases, events] = [row.n, row.n_events].map(|n| count(n as usize));
        let name = [suite_name(&row.suite), row.structure.clone()].into_iter();
        name.chain(limit).chain([cases, events, calibration]).collect()
    });
    let mut headings = vec!["suite", "structure", "limit", cases, events, "calibration"];
    if rows.iter().all(|row| row.limit_state.is_none()) {
        headings.remove(2);
    }
    text(&headings, lines.collect(), headings.len() - 3..headings.len() - 1, out)
}

/// The first rows as a table, these columns of numbers flush right; all are in a file.
pub fn text(headings: &[&str], rows: Vec<Vec<String>>, numbers: Range<usize>, out: &Path) -> String {
    let headings = headings.iter().map(|heading| heading.to_string()).collect();
    let lines = [vec![headings], rows].concat();
    first_lines(&aligned(&lines, |column| numbers.contains(&column)), 1, out)
}

/// A log score of held-out cases; `by_score` has the best first, and those without one last.
pub fn score(score: Option<f64>) -> String {
    score.map_or("-".to_string(), |score| fixed(score, 4))
}

pub fn by_score(a: Option<f64>, b: Option<f64>) -> Ordering {
    let [a, b] = [a, b].map(|score| score.unwrap_or(f64::NEG_INFINITY));
    b.total_cmp(&a)
}

pub fn suite_name(suite: &Option<String>) -> String {
    suite.clone().unwrap_or_else(|| "-".to_string())
}

pub fn verdict(status: FitStatus) -> String {
    status.to_string().replace('_', " ")
}

/// Warnings about calibrations, each with its structure and suite.
pub fn warnings(rows: &[Calibration]) -> Warnings {
    let warnings = rows.iter().flat_map(|row| {
        let suite = row.suite.as_ref().map_or(String::new(), |suite| format!(" ({suite})"));
        let about = move |warning| (warning, format!("{}{suite}", row.structure));
        row.warnings().into_iter().map(about)
    });
    warnings.collect()
}
