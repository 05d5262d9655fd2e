//! What a stage that fits prints of its rows, and the warnings about its fits.

use std::path::Path;

use rockfrag_core::fragility::{Calibration, CurveFit, Group, Measure, Parameter};
use rockfrag_core::statistics::{FitStatus, Interval};
use rockfrag_core::warning::Warnings;
use serde::{Deserialize, Serialize};

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

/// What is shown of a curve of overturning (Eqs. 20 and 24).
#[derive(Debug, Serialize, Deserialize)]
pub struct CurveLine {
    suite: Option<String>,
    structure: String,
    im_x: Measure,
    im_y: Option<Measure>,
    pub theta: Interval<Option<f64>>,
    pub beta: Interval<Option<f64>>,
    lambda: Option<f64>,
    n_events: i64,
    largest_difference: Option<f64>,
    status: FitStatus,
}

impl CurveLine {
    pub fn new(fit: &CurveFit, confidence: f64) -> CurveLine {
        let parameters = fit.parameters(confidence);
        let of = |parameter: Parameter| -> Interval<Option<f64>> {
            parameters.iter().find(|row| row.parameter == parameter).map(|row| row.estimate()).into()
        };
        CurveLine {
            suite: fit.suite.clone(),
            structure: fit.structure.name.clone(),
            im_x: fit.im_x.clone(),
            im_y: fit.im_y.clone(),
            theta: of(Parameter::Theta),
            beta: of(Parameter::Beta),
            lambda: of(Parameter::Lambda).value,
            n_events: fit.n_events,
            largest_difference: fit.largest_difference,
            status: fit.status,
        }
    }
}

/// Fits in the order of their groups, of each that with the best log score of held-out cases first, and those
/// without one last.
pub fn best_first<F>(fits: &[F], group: fn(&F) -> Group, score: fn(&F) -> Option<f64>) -> Vec<&F> {
    let mut best: Vec<&F> = fits.iter().collect();
    let key = |fit: &F| score(fit).unwrap_or(f64::NEG_INFINITY);
    let groups = best.chunk_by_mut(|a, b| group(a) == group(b));
    groups.for_each(|its| its.sort_by(|a, b| key(b).total_cmp(&key(a))));
    best
}

/// Warnings about calibrations, each with its structure and suite.
pub fn warnings(rows: &[Calibration]) -> Warnings {
    let warnings = rows.iter().flat_map(|row| {
        let suite = row.suite.as_ref().map_or(String::new(), |suite| format!(" ({suite})"));
        let about = move |warning| (warning, format!("{}{suite}", row.structure.name));
        row.warnings().into_iter().map(about)
    });
    warnings.collect()
}
