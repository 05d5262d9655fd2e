//! The bootstrap files of fit-pex and fit-pro: one row a fit and resample, null where a resample has no fit.

use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, StringArray};
use arrow_schema::ArrowError;

use super::pex::PexRow;
use super::pro::ProRow;
use super::schema::{PEX_BOOTSTRAP, PRO_BOOTSTRAP};
use crate::fragility::demand::Replicate;
use crate::keyword::Keyword;

/// The resamples of a regression of the demand.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn pex_batch(row: &PexRow) -> Result<RecordBatch, ArrowError> {
    let text = |value: Option<&str>| repeated(value, row.regression.replicates.len());
    let number = |value: &dyn Fn(&Replicate) -> Option<f64>| -> ArrayRef {
        let finite = |replicate: &Replicate| value(replicate).filter(|v| v.is_finite());
        Arc::new(Float64Array::from_iter(
            row.regression.replicates.iter().map(|r| r.as_ref().and_then(finite)),
        ))
    };
    let coefficient = |k: usize| number(&|replicate| replicate.fit.coefficients.get(k).copied());
    let columns: Vec<ArrayRef> = vec![
        text(row.suite.as_deref()),
        text(Some(&row.structure)),
        text(Some(row.regression.form.as_str())),
        text(Some(row.regression.im_x.as_str())),
        text(row.regression.im_y.map(Keyword::as_str)),
        numbers(row.regression.replicates.len()),
        number(&|replicate| Some(replicate.range.start)),
        number(&|replicate| Some(replicate.range.end)),
        coefficient(0),
        coefficient(1),
        coefficient(2),
        number(&|replicate| Some(replicate.fit.residual_sd)),
    ];
    RecordBatch::try_new(PEX_BOOTSTRAP.schema(), columns)
}

/// The resamples of a curve.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn pro_batch(row: &ProRow) -> Result<RecordBatch, ArrowError> {
    let text = |value: Option<&str>| repeated(value, row.curve.replicates.len());
    let coefficient = |k: usize| -> ArrayRef {
        let values = row.curve.replicates.iter().map(|b| b.as_ref().and_then(|b| b.get(k).copied()));
        Arc::new(Float64Array::from_iter(values))
    };
    let columns: Vec<ArrayRef> = vec![
        text(row.suite.as_deref()),
        text(Some(&row.structure)),
        text(Some(row.curve.event.as_str())),
        text(Some(row.curve.im_x.as_str())),
        text(row.curve.im_y.map(Keyword::as_str)),
        numbers(row.curve.replicates.len()),
        coefficient(0),
        coefficient(1),
        coefficient(2),
    ];
    RecordBatch::try_new(PRO_BOOTSTRAP.schema(), columns)
}

fn repeated(value: Option<&str>, times: usize) -> ArrayRef {
    Arc::new(std::iter::repeat_n(value, times).collect::<StringArray>())
}

fn numbers(up_to: usize) -> ArrayRef {
    Arc::new(Int64Array::from_iter_values(0..up_to as i64))
}
