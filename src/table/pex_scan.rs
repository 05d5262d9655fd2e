//! The scan file of fit-pex: one row a place that was tried for the transition.

use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, StringArray};
use arrow_schema::ArrowError;

use super::schema::PEX_SCAN;
use crate::fragility::ScanPoint;

/// One place that was tried for the transition.
#[derive(Debug, Clone, PartialEq)]
pub struct ScanRow {
    /// Of which suite.
    pub suite: Option<String>,
    /// Of which structure.
    pub structure: String,
    /// The place and its residual.
    pub point: ScanPoint,
}

/// The rows of the scan file.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn batch(rows: &[ScanRow]) -> Result<RecordBatch, ArrowError> {
    let number = |value: fn(&ScanPoint) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter_values(rows.iter().map(|row| value(&row.point))))
    };
    let count = |value: fn(&ScanPoint) -> usize| -> ArrayRef {
        Arc::new(Int64Array::from_iter_values(rows.iter().map(|row| value(&row.point) as i64)))
    };
    let columns: Vec<ArrayRef> = vec![
        Arc::new(rows.iter().map(|row| row.suite.as_deref()).collect::<StringArray>()),
        Arc::new(StringArray::from_iter_values(rows.iter().map(|row| &row.structure))),
        number(|point| point.im4),
        number(|point| point.pooled_rss),
        count(|point| point.n_low),
        count(|point| point.n_high),
    ];
    RecordBatch::try_new(PEX_SCAN.schema(), columns)
}
