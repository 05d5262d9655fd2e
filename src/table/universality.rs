//! The files of universality: one row an event of one structure, and one a coefficient of a pooled curve.

use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, StringArray};
use arrow_schema::ArrowError;

use super::schema::{POOLED, UNIVERSALITY};
use crate::fragility::Event;
use crate::keyword::Keyword;
use crate::rocking::Structure;
use crate::statistics::FitStatus;
use crate::studies::{BesideOwn, PooledPart, PooledTerm, PooledTerms, Transfer, Validation};

/// The curve of one structure on another.
#[derive(Debug, Clone, PartialEq)]
pub struct UniversalityRow {
    /// Suite of the motions.
    pub suite: Option<String>,
    /// The structure that it is held against.
    pub structure: Structure,
    /// The structure whose curve it is.
    pub reference: String,
    /// What is foretold.
    pub event: Event,
    /// The demand that P_ex is about.
    pub limit_state: f64,
    /// How it fares.
    pub transfer: Transfer,
    /// Log score by the curve of all other structures, of each of [`PooledTerms::ALL`]; none without such a curve.
    pub pooled: [Option<f64>; 4],
}

/// A coefficient of a curve of all structures.
#[derive(Debug, Clone, PartialEq)]
pub struct PooledRow {
    /// Suite of the motions.
    pub suite: Option<String>,
    /// What is foretold.
    pub event: Event,
    /// What the curve consists of.
    pub terms: PooledTerms,
    /// The curve where it holds.
    pub part: PooledPart,
    /// The coefficient.
    pub term: PooledTerm,
}

/// The rows of a universality file.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn batch(rows: &[UniversalityRow]) -> Result<RecordBatch, ArrowError> {
    let text = |value: fn(&UniversalityRow) -> Option<&str>| -> ArrayRef {
        Arc::new(rows.iter().map(value).collect::<StringArray>())
    };
    let number = |value: &dyn Fn(&UniversalityRow) -> Option<f64>| -> ArrayRef {
        Arc::new(Float64Array::from_iter(rows.iter().map(value)))
    };
    let count = |value: fn(&Validation) -> usize| -> ArrayRef {
        let counts = rows.iter().map(|row| value(&row.transfer.validation) as i64);
        Arc::new(Int64Array::from_iter_values(counts))
    };
    let own = |value: fn(&BesideOwn) -> f64| number(&|row| row.transfer.own.as_ref().ok().map(value));
    let columns: Vec<ArrayRef> = vec![
        text(|row| row.suite.as_deref()),
        text(|row| Some(&row.structure.name)),
        number(&|row| Some(row.structure.p_rad_s)),
        number(&|row| Some(row.structure.alpha_rad)),
        number(&|row| Some(row.structure.eta)),
        text(|row| Some(&row.reference)),
        text(|row| Some(row.event.as_str())),
        number(&|row| Some(row.limit_state)),
        count(|validation| validation.n),
        count(|validation| validation.seen),
        number(&|row| Some(row.transfer.validation.expected)),
        count(|validation| validation.chance_limits[0]),
        count(|validation| validation.chance_limits[1]),
        number(&|row| Some(row.transfer.validation.chance_p)),
        number(&|row| row.transfer.validation.calibration),
        number(&|row| row.transfer.slope),
        own(|own| own.log_score),
        own(|own| own.transferred),
        own(|own| own.loss.value),
        own(|own| own.loss.standard_error),
        number(&|row| Some(row.transfer.share_log_score)),
        number(&|row| row.transfer.share_lost()),
        own(|own| own.mean_error),
        own(|own| own.worst_over),
        own(|own| own.worst_under),
        number(&|row| row.pooled[0]),
        number(&|row| row.pooled[1]),
        number(&|row| row.pooled[2]),
        number(&|row| row.pooled[3]),
        count(|validation| validation.extrapolated),
        text(|row| Some(row.transfer.own.as_ref().err().copied().unwrap_or(FitStatus::Ok).as_str())),
        text(|row| Some(row.transfer.verdict().as_str())),
    ];
    RecordBatch::try_new(UNIVERSALITY.schema(), columns)
}

/// The rows of a file of pooled curves.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn pooled_batch(rows: &[PooledRow]) -> Result<RecordBatch, ArrowError> {
    let text = |value: fn(&PooledRow) -> Option<&str>| -> ArrayRef {
        Arc::new(rows.iter().map(value).collect::<StringArray>())
    };
    let number = |value: fn(&PooledRow) -> Option<f64>| -> ArrayRef {
        Arc::new(Float64Array::from_iter(rows.iter().map(value)))
    };
    let columns: Vec<ArrayRef> = vec![
        text(|row| row.suite.as_deref()),
        text(|row| Some(row.event.as_str())),
        text(|row| Some(row.terms.as_str())),
        number(|row| Some(row.part.range.start)),
        number(|row| Some(row.part.range.end).filter(|end| end.is_finite())),
        text(|row| Some(&row.term.name)),
        number(|row| Some(row.term.coefficient)),
        number(|row| Some(row.term.standard_error)),
        number(|row| row.part.residual_sd),
        Arc::new(Int64Array::from_iter_values(rows.iter().map(|row| row.part.n as i64))),
    ];
    RecordBatch::try_new(POOLED.schema(), columns)
}
