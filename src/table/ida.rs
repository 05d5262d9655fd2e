//! The files of an incremental dynamic analysis: capacities, safe windows, stripes, shares and fragility.

use std::path::Path;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, StringArray};
use arrow_schema::ArrowError;

use super::motions::{MotionId, id_column, schema_of};
use super::reader::{Batch, Batches};
use super::responses::{self, ResponseRow};
use super::schema::{IDA, IDA_FRAGILITY, IDA_SHARES, IDA_STRIPES, IDA_WINDOWS};
use super::text;
use crate::fragility::CapacityFit;
use crate::keyword::Keyword;
use crate::rocking::{Capacity, CapacityStatus, SafeWindow, Structure};
use crate::statistics::FitStatus;
use crate::studies::wilson_limits;

/// What a scan says of a structure under a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct CapacityRow<'a> {
    /// Which motion.
    pub motion_id: &'a MotionId,
    /// Its kind, if known.
    pub suite: Option<&'a str>,
    /// Which structure.
    pub structure: &'a Structure,
    /// What is scaled.
    pub measure: &'static str,
    /// Its value of the motion as it is.
    pub unscaled: f64,
    /// Where the structure overturns.
    pub capacity: Capacity,
}

/// A response at a level of the scan.
#[derive(Debug, Clone, PartialEq)]
pub struct StripeRow<'a> {
    /// The response to the scaled motion.
    pub response: ResponseRow<'a>,
    /// What is scaled.
    pub measure: &'static str,
    /// Its value of the scaled motion.
    pub intensity: f64,
    /// The factor by which the motion is scaled.
    pub scale: f64,
}

/// The capacities of a structure against the motions of a suite.
#[derive(Debug, Clone, PartialEq)]
pub struct FragilityRow {
    /// The suite, if known.
    pub suite: Option<String>,
    /// The structure.
    pub structure: String,
    /// What is scaled.
    pub measure: &'static str,
    /// Motions.
    pub n: usize,
    /// Those that overturn it nowhere.
    pub n_safe: usize,
    /// Those that overturn it already at the foot of the scan.
    pub n_below: usize,
    /// Those with a safe window.
    pub n_with_windows: usize,
    /// Levels of the scan, rising.
    pub levels: Vec<LevelCount>,
    /// The distribution, or why there is none.
    pub fit: Result<CapacityFit, FitStatus>,
}

/// How many motions overturn a structure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LevelCount {
    /// At this intensity.
    pub intensity: f64,
    /// So many.
    pub overturned: usize,
    /// At this intensity or a lower one.
    pub overturned_up_to: usize,
}

impl CapacityRow<'_> {
    /// The largest intensity that the structure survives, in a scan up to `top`.
    fn safe_up_to(&self, top: f64) -> Option<f64> {
        let Capacity { status, windows, safe_below, .. } = &self.capacity;
        match (status, windows.last()) {
            (CapacityStatus::Safe, _) => Some(top),
            (_, Some(window)) => Some(window.high.unwrap_or(top)),
            (_, None) => *safe_below,
        }
    }
}

/// The rows of the file of capacities, of a scan up to `top`.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn capacities(rows: &[CapacityRow], top: f64, by_name: bool) -> Result<RecordBatch, ArrowError> {
    let number = |value: &dyn Fn(&CapacityRow) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter_values(rows.iter().map(value)))
    };
    let optional = |value: &dyn Fn(&CapacityRow) -> Option<f64>| -> ArrayRef {
        Arc::new(Float64Array::from_iter(rows.iter().map(value)))
    };
    let columns: Vec<ArrayRef> = vec![
        id_column(rows.iter().map(|row| row.motion_id), by_name),
        Arc::new(rows.iter().map(|row| row.suite).collect::<StringArray>()),
        Arc::new(StringArray::from_iter_values(rows.iter().map(|row| &row.structure.name))),
        number(&|row| row.structure.p_rad_s),
        number(&|row| row.structure.alpha_rad),
        number(&|row| row.structure.eta),
        Arc::new(StringArray::from_iter_values(rows.iter().map(|row| row.measure))),
        number(&|row| row.unscaled),
        Arc::new(StringArray::from_iter_values(rows.iter().map(|row| row.capacity.status.as_str()))),
        optional(&|row| row.capacity.safe_below),
        optional(&|row| row.capacity.overturning),
        Arc::new(Int64Array::from_iter_values(rows.iter().map(|row| row.capacity.windows.len() as i64))),
        optional(&|row| row.safe_up_to(top)),
    ];
    RecordBatch::try_new(schema_of(&IDA, by_name), columns)
}

/// The windows of these rows.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn windows(rows: &[CapacityRow], by_name: bool) -> Result<RecordBatch, ArrowError> {
    let mut windows: Vec<(&CapacityRow, i64, &SafeWindow)> = Vec::new();
    for row in rows {
        windows.extend((1..).zip(&row.capacity.windows).map(|(number, window)| (row, number, window)));
    }
    let rows = || windows.iter().map(|(row, ..)| row);
    let columns: Vec<ArrayRef> = vec![
        id_column(rows().map(|row| row.motion_id), by_name),
        Arc::new(rows().map(|row| row.suite).collect::<StringArray>()),
        Arc::new(StringArray::from_iter_values(rows().map(|row| &row.structure.name))),
        Arc::new(StringArray::from_iter_values(rows().map(|row| row.measure))),
        Arc::new(Int64Array::from_iter_values(windows.iter().map(|(_, number, _)| *number))),
        Arc::new(Float64Array::from_iter_values(windows.iter().map(|(.., window)| window.low))),
        Arc::new(Float64Array::from_iter(windows.iter().map(|(.., window)| window.high))),
    ];
    RecordBatch::try_new(schema_of(&IDA_WINDOWS, by_name), columns)
}

/// The rows of the file of stripes.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn stripes(rows: &[StripeRow], by_name: bool) -> Result<RecordBatch, ArrowError> {
    let of_responses: Vec<ResponseRow> = rows.iter().map(|row| row.response).collect();
    let mut columns = responses::batch(&of_responses, by_name)?.columns().to_vec();
    columns.push(Arc::new(StringArray::from_iter_values(rows.iter().map(|row| row.measure))));
    columns.push(Arc::new(Float64Array::from_iter_values(rows.iter().map(|row| row.intensity))));
    columns.push(Arc::new(Float64Array::from_iter_values(rows.iter().map(|row| row.scale))));
    RecordBatch::try_new(schema_of(&IDA_STRIPES, by_name), columns)
}

/// The rows of the file of shares: each level of each row.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn shares(rows: &[FragilityRow]) -> Result<RecordBatch, ArrowError> {
    let levels: Vec<(&FragilityRow, &LevelCount)> =
        rows.iter().flat_map(|row| row.levels.iter().map(move |level| (row, level))).collect();
    let text = |value: &dyn Fn(&FragilityRow) -> Option<String>| -> ArrayRef {
        Arc::new(levels.iter().map(|(row, _)| value(row)).collect::<StringArray>())
    };
    let number = |value: &dyn Fn(&FragilityRow, &LevelCount) -> Option<f64>| -> ArrayRef {
        Arc::new(Float64Array::from_iter(levels.iter().map(|(row, level)| value(row, level))))
    };
    let count = |value: &dyn Fn(&FragilityRow, &LevelCount) -> usize| -> ArrayRef {
        let values = levels.iter().map(|(row, level)| value(row, level) as i64);
        Arc::new(Int64Array::from_iter_values(values))
    };
    let limits = |row: &FragilityRow, level: &LevelCount| wilson_limits(level.overturned, row.n);
    let columns: Vec<ArrayRef> = vec![
        text(&|row| row.suite.clone()),
        text(&|row| Some(row.structure.clone())),
        text(&|row| Some(row.measure.to_string())),
        number(&|_, level| Some(level.intensity)),
        count(&|row, _| row.n),
        count(&|_, level| level.overturned),
        number(&|row, level| Some(level.overturned as f64 / row.n as f64)),
        number(&|row, level| Some(limits(row, level).low)),
        number(&|row, level| Some(limits(row, level).high)),
        count(&|_, level| level.overturned_up_to),
        number(&|row, level| Some(row.fit.as_ref().ok()?.lognormal.p_up_to(level.intensity))),
    ];
    RecordBatch::try_new(IDA_SHARES.schema(), columns)
}

/// The rows of the fragility file.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn fragility(rows: &[FragilityRow]) -> Result<RecordBatch, ArrowError> {
    let number = |value: fn(&CapacityFit) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter(rows.iter().map(|row| row.fit.as_ref().ok().map(value))))
    };
    let count = |value: fn(&FragilityRow) -> usize| -> ArrayRef {
        Arc::new(Int64Array::from_iter_values(rows.iter().map(|row| value(row) as i64)))
    };
    let status = |row: &FragilityRow| row.fit.as_ref().map_or_else(|&status| status, |_| FitStatus::Ok);
    let columns: Vec<ArrayRef> = vec![
        Arc::new(rows.iter().map(|row| row.suite.as_deref()).collect::<StringArray>()),
        Arc::new(StringArray::from_iter_values(rows.iter().map(|row| &row.structure))),
        Arc::new(StringArray::from_iter_values(rows.iter().map(|row| row.measure))),
        count(|row| row.n),
        count(|row| row.n_safe),
        count(|row| row.n_below),
        count(|row| row.n_with_windows),
        number(|fit| fit.lognormal.theta),
        number(|fit| fit.theta_limits.low),
        number(|fit| fit.theta_limits.high),
        number(|fit| fit.lognormal.beta),
        number(|fit| fit.beta_limits.low),
        number(|fit| fit.beta_limits.high),
        Arc::new(StringArray::from_iter_values(rows.iter().map(|row| status(row).as_str()))),
    ];
    RecordBatch::try_new(IDA_FRAGILITY.schema(), columns)
}

/// A fragility file as a table to read.
///
/// # Errors
/// If it is none.
pub fn show(path: &Path) -> anyhow::Result<String> {
    let batches = Batches::open_whole(path, &IDA_FRAGILITY, &[IDA_FRAGILITY.stage])?;
    batches.map(|batch| Ok(batch.map(|Batch { rows, .. }| text::aligned(&rows))?)).collect()
}
