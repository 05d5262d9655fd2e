//! The pex file: one row a regression of the demand in safe rocking.

use std::path::Path;
use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, StringArray};
use arrow_schema::ArrowError;

use polars::prelude::{ChunkCompareEq, DataFrame};

use super::TableError;
use super::frame::read_frame;
use super::schema::{self, Column, PEX};
use crate::fragility::demand::{Form, Regression};
use crate::keyword::Keyword;
use crate::resampling::BootstrapLimits;
use crate::statistics::{Estimate, LinearFit};

/// One regression.
#[derive(Debug, Clone, PartialEq)]
pub struct PexRow {
    /// Suite of the responses, if known.
    pub suite: Option<String>,
    /// Name of the structure.
    pub structure: String,
    /// Its coefficient of restitution.
    pub eta: f64,
    /// The demand that P_ex is about.
    pub limit_state: f64,
    /// What was fitted.
    pub regression: Regression,
}

/// The rows of the pex file; what is no finite number is null.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn batch(rows: &[PexRow]) -> Result<RecordBatch, ArrowError> {
    let of_row = |value: &dyn Fn(&PexRow) -> Option<f64>| -> ArrayRef {
        Arc::new(Float64Array::from_iter(rows.iter().map(|row| value(row).filter(|v| v.is_finite()))))
    };
    let number = |value: &dyn Fn(&Regression) -> Option<f64>| of_row(&|row| value(&row.regression));
    let fitted = |value: fn(&LinearFit) -> f64| number(&|row| row.fit.as_ref().ok().map(value));
    let estimate = |index: usize, part: fn(Estimate) -> f64| number(&|row| row.coefficient(index).map(part));
    let text = |value: fn(&PexRow) -> Option<&str>| -> ArrayRef {
        Arc::new(rows.iter().map(value).collect::<StringArray>())
    };
    let mut columns: Vec<ArrayRef> = vec![
        text(|row| row.suite.as_deref()),
        text(|row| Some(&row.structure)),
        text(|row| Some(row.regression.form.as_str())),
        text(|row| Some(row.regression.im_x.as_str())),
        text(|row| row.regression.im_y.map(Keyword::as_str)),
        number(&|row| Some(row.range.start).filter(|start| *start > 0.0)),
        number(&|row| Some(row.range.end)),
        of_row(&|row| Some(row.limit_state)),
    ];
    columns.extend((0..3).map(|index| estimate(index, |e| e.value)));
    columns.extend([
        fitted(|fit| fit.r2),
        number(&|row| row.r2_pooled),
        number(&|row| row.r2_overall),
        number(&|row| row.transition_found),
        fitted(|fit| fit.residual_sd),
        number(&Regression::zeta),
        Arc::new(Int64Array::from_iter_values(
            rows.iter().map(|row| row.regression.fit.as_ref().map_or(0, |fit| fit.n as i64)),
        )),
    ]);
    columns.extend((0..3).map(|index| estimate(index, |e| e.standard_error)));
    columns.extend((0..3).flat_map(|index| [estimate(index, |e| e.low), estimate(index, |e| e.high)]));
    columns.extend([(0, 1), (0, 2), (1, 2)].map(|place| number(&|row| row.covariance(place))));
    columns.extend((0..3).map(|k| number(&|row| row.clustered_errors.get(k).copied())));
    columns.push(number(&|row| Some(row.confidence)));
    columns.push(Arc::new(Int64Array::from_iter_values(
        rows.iter().map(|row| row.regression.replicates.iter().flatten().count() as i64),
    )));
    let limits = |of: &dyn Fn(&Regression) -> Option<BootstrapLimits>| {
        [0, 1, 2, 3].map(|k| number(&|row| of(row)?.in_order()[k]))
    };
    columns.extend((0..3).flat_map(|index| limits(&|row| row.coefficient_limits(index))));
    columns.extend(limits(&Regression::beta_limits));
    columns.extend([
        number(&|row| Some(row.transition_limits?.low)),
        number(&|row| Some(row.transition_limits?.high)),
        number(&|row| Some(row.transition_percentile?.low)),
        number(&|row| Some(row.transition_percentile?.high)),
        number(&|row| Some(row.transition_width?.value)),
        number(&|row| Some(row.transition_width?.standard_error)),
        number(&|row| Some(row.reset?.statistic)),
        number(&|row| Some(row.reset?.p)),
    ]);
    let end = |(measure, end): (usize, usize)| number(&|row| Some(row.data_ranges.get(measure)?[end]));
    columns.extend([(0, 0), (0, 1), (1, 0), (1, 1)].map(end));
    columns.push(of_row(&|row| Some(row.eta)));
    columns.push(text(|row| Some(row.regression.status().as_str())));
    RecordBatch::try_new(PEX.schema(), columns)
}

/// The regressions of a pex file.
pub struct PexFrame(DataFrame);

impl PexFrame {
    /// Reads the file.
    ///
    /// # Errors
    /// If it is none of regressions.
    pub fn read(path: &Path) -> Result<PexFrame, TableError> {
        read_frame(path, &PEX).map(PexFrame)
    }

    /// A number of one of the two planes, below the transition or above it.
    pub fn plane_number(&self, suite: &str, structure: &str, low: bool, column: &str) -> Option<f64> {
        let equal =
            |column: Column, word: &str| Some(self.0.column(column.name).ok()?.str().ok()?.equal(word));
        let open_above = self.0.column(schema::RANGE_HIGH.name).ok()?.is_null();
        let side = if low { !&open_above } else { open_above };
        let rows = equal(schema::SUITE, suite)?
            & equal(schema::STRUCTURE, structure)?
            & equal(schema::MODEL, Form::Biplanar.as_str())?
            & side;
        self.0.filter(&rows).ok()?.column(column).ok()?.f64().ok()?.iter().next().flatten()
    }
}
