//! The validation file: one row an event of one structure under one suite, by the curves of one suite.

use std::path::Path;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, StringArray};
use arrow_schema::ArrowError;

use super::reader::{Batch, Batches, expect_columns};
use super::schema::{self, VALIDATION};
use super::text;
use crate::fragility::Event;
use crate::keyword::Keyword;
use crate::studies::Validation;

/// One event, foretold and seen.
#[derive(Debug, Clone, PartialEq)]
pub struct ValidationRow {
    /// Suite of the responses.
    pub suite: Option<String>,
    /// Structure of responses and fits.
    pub structure: String,
    /// Suite of the fits.
    pub fits_suite: Option<String>,
    /// What is foretold.
    pub event: Event,
    /// The demand that P_ex is about.
    pub limit_state: f64,
    /// How the forecasts fared.
    pub validation: Validation,
    /// Cases without a forecast.
    pub without_measure: usize,
}

/// The rows of a validation file.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn batch(rows: &[ValidationRow]) -> Result<RecordBatch, ArrowError> {
    let text = |value: fn(&ValidationRow) -> Option<&str>| -> ArrayRef {
        Arc::new(rows.iter().map(value).collect::<StringArray>())
    };
    let number = |value: fn(&Validation) -> Option<f64>| -> ArrayRef {
        Arc::new(Float64Array::from_iter(rows.iter().map(|row| value(&row.validation))))
    };
    let count = |value: fn(&ValidationRow) -> usize| -> ArrayRef {
        Arc::new(Int64Array::from_iter_values(rows.iter().map(|row| value(row) as i64)))
    };
    RecordBatch::try_new(
        VALIDATION.schema(),
        vec![
            text(|row| row.suite.as_deref()),
            text(|row| Some(&row.structure)),
            text(|row| row.fits_suite.as_deref()),
            text(|row| Some(row.event.as_str())),
            Arc::new(Float64Array::from_iter_values(rows.iter().map(|row| row.limit_state))),
            count(|row| row.validation.n),
            count(|row| row.validation.seen),
            number(|validation| Some(validation.expected)),
            number(|validation| Some(validation.expected_limits.low)),
            number(|validation| Some(validation.expected_limits.high)),
            count(|row| row.validation.chance_limits[0]),
            count(|row| row.validation.chance_limits[1]),
            number(|validation| Some(validation.chance_p)),
            number(|validation| Some(validation.share)),
            number(|validation| Some(validation.share_limits.low)),
            number(|validation| Some(validation.share_limits.high)),
            number(|validation| validation.log_score),
            number(|validation| Some(validation.log_score_expected)),
            number(|validation| Some(validation.brier)),
            number(|validation| validation.auc),
            number(|validation| validation.calibration),
            count(|row| row.validation.extrapolated),
            count(|row| row.validation.impossible),
            count(|row| row.without_measure),
        ],
    )
}

/// What a reader looks at first; the file holds the rest.
const SHOWN: [schema::Column; 16] = [
    schema::SUITE,
    schema::STRUCTURE,
    schema::FITS_SUITE,
    schema::FORETOLD,
    schema::N_FORETOLD,
    schema::SEEN,
    schema::EXPECTED,
    schema::CHANCE_LOW,
    schema::CHANCE_HIGH,
    schema::CHANCE_P,
    schema::SHARE_LOW,
    schema::SHARE_HIGH,
    schema::LOG_SCORE,
    schema::BRIER,
    schema::CALIBRATION,
    schema::N_EXTRAPOLATED,
];

/// A validation file as a table to read.
///
/// # Errors
/// If it is none.
pub fn show(path: &Path) -> anyhow::Result<String> {
    let mut table = String::new();
    for batch in Batches::open_whole(path, &VALIDATION, &[VALIDATION.stage])? {
        let Batch { rows, .. } = batch?;
        let schema = rows.schema();
        expect_columns(path, &schema, &SHOWN)?;
        let shown: Vec<usize> = SHOWN.iter().filter_map(|column| schema.index_of(column.name).ok()).collect();
        table += &text::aligned(&rows.project(&shown)?);
    }
    Ok(table)
}
