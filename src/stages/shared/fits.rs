//! What a stage that fits prints of its rows, and the warnings about its fits.

use std::cmp::Ordering;
use std::path::Path;

use rockfrag_core::fragility::Calibration;
use rockfrag_core::warning::Warnings;

use crate::pipeline::options::first_lines;
use crate::table::frame;
use crate::table::rows::{self, Row};

/// Some columns of the first rows; all are in a file.
pub fn text<'a, R: Row>(
    rows: impl IntoIterator<Item = &'a R>,
    columns: &str,
    out: &Path,
) -> anyhow::Result<String> {
    let frame = frame::from_batch(&rows::batch(rows)?)?;
    Ok(first_lines(&frame::text(&frame.select(columns.split(' '))?), 1, out))
}

/// Log scores of held-out cases, the best first, and those without one last.
pub fn by_score(a: Option<f64>, b: Option<f64>) -> Ordering {
    let [a, b] = [a, b].map(|score| score.unwrap_or(f64::NEG_INFINITY));
    b.total_cmp(&a)
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
