//! Narrow tables whole, as polars frames: filtered, sorted and shown there.

use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Float64Type, Int32Type, Int64Type};
use arrow_array::{ArrayRef, RecordBatch};
use polars::prelude::{Column, DataFrame, DataType, IntoColumn, NamedFrom, PolarsError, Series};

use super::reader::Batches;
use super::source::Source;
use crate::table::TableError;
use crate::table::schema::{self, Kind, Table};

/// Reads a narrow table whole. Columns that may be null and are missing in the file become nulls.
///
/// # Errors
/// If it is missing, unreadable, or not the output of the stage of this table, or lacks a column that may not be null.
pub fn read_frame(source: impl Into<Source>, table: &Table) -> Result<DataFrame, TableError> {
    let source = source.into();
    let path = source.name().to_path_buf();
    let frames = Batches::open_whole(source, table, &[table.stage])?.map(|batch| {
        let batch = batch?;
        let failed = |error: PolarsError| TableError::Read {
            path: batch.path.to_path_buf(),
            message: error.to_string(),
        };
        let mut frame = frame_of(&batch.rows).map_err(failed)?;
        for missing in
            table.columns.iter().filter(|column| frame.column(column.name).is_err()).collect::<Vec<_>>()
        {
            let nulls = Column::full_null(missing.name.into(), frame.height(), &data_type(missing.kind));
            frame.with_column(nulls).map_err(failed)?;
        }
        Ok(frame)
    });
    let frames = frames.collect::<Result<Vec<_>, TableError>>()?;
    stacked(frames).map_err(|error| TableError::Read { path, message: error.to_string() })
}

/// The frames, one below the other.
///
/// # Errors
/// If they have other columns.
pub fn stacked(frames: impl IntoIterator<Item = DataFrame>) -> Result<DataFrame, PolarsError> {
    let mut frames = frames.into_iter();
    let mut whole = frames.next().unwrap_or_default();
    for frame in frames {
        whole.vstack_mut_owned(frame)?;
    }
    Ok(whole)
}

fn data_type(kind: Kind) -> DataType {
    match kind {
        Kind::Float64 => DataType::Float64,
        Kind::Int64 | Kind::Int32 => DataType::Int64,
        Kind::Text | Kind::Samples | Kind::Numbers => DataType::String,
    }
}

/// The rows of a batch; columns that are neither text, numbers nor counts are left out.
///
/// # Errors
/// If two columns have one name.
pub fn frame_of(rows: &RecordBatch) -> Result<DataFrame, PolarsError> {
    let schema = rows.schema();
    let columns = schema.fields().iter().zip(rows.columns());
    let columns = columns.filter_map(|(field, array)| column(field.name(), array)).collect();
    DataFrame::new(rows.num_rows(), columns)
}

fn column(name: &str, array: &ArrayRef) -> Option<Column> {
    let name = name.into();
    let series = if let Some(text) = array.as_string_opt::<i32>() {
        Series::new(name, text.iter().collect::<Vec<_>>())
    } else if let Some(text) = array.as_string_opt::<i64>() {
        Series::new(name, text.iter().collect::<Vec<_>>())
    } else if let Some(text) = array.as_string_view_opt() {
        Series::new(name, text.iter().collect::<Vec<_>>())
    } else if let Some(numbers) = array.as_primitive_opt::<Float64Type>() {
        Series::new(name, numbers.iter().collect::<Vec<_>>())
    } else if let Some(numbers) = array.as_primitive_opt::<Float32Type>() {
        Series::new(name, numbers.iter().map(|number| number.map(f64::from)).collect::<Vec<_>>())
    } else if let Some(counts) = array.as_primitive_opt::<Int64Type>() {
        Series::new(name, counts.iter().collect::<Vec<_>>())
    } else {
        Series::new(name, array.as_primitive_opt::<Int32Type>()?.iter().collect::<Vec<_>>())
    };
    Some(series.into_column())
}

/// The names of columns, as [`DataFrame::select`] takes them.
pub fn names(columns: &[schema::Column]) -> impl Iterator<Item = &'static str> + '_ {
    columns.iter().map(|column| column.name)
}
