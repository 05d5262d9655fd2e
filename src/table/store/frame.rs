//! Narrow tables whole, as polars frames.

use std::path::Path;

use polars::prelude::{DataFrame, IntoColumn, NamedFrom, PolarsError, PolarsResult, Series};

use super::columns::Columns;
use super::reader::Batches;
use super::source::Source;
use crate::table::TableError;
use crate::table::schema::{Column, Kind, Table};

/// A narrow table whole. Columns that may be null and are missing in the file become nulls.
///
/// # Errors
/// As [`Batches::open_whole`], or if a column is missing, of another type, or holds a value that it must not.
pub fn read_frame(source: impl Into<Source>, table: &Table) -> Result<DataFrame, TableError> {
    read_frame_of(source, table, &[table.stage])
}

/// A narrow table whole, as [`read_frame`], where other stages may have made it too.
///
/// # Errors
/// As there.
pub fn read_frame_of(
    source: impl Into<Source>,
    table: &Table,
    stages: &[&str],
) -> Result<DataFrame, TableError> {
    let batches = Batches::open_whole(source, table, stages)?;
    let mut whole = DataFrame::empty();
    for batch in batches {
        let batch = batch?;
        let columns = batch.columns();
        let series = table.columns.iter().map(|column| series(&columns, column));
        let series =
            series.map(|series| Ok(series?.into_column())).collect::<Result<Vec<_>, TableError>>()?;
        let failed = |source| polars_error(&batch.path, &source);
        let frame = DataFrame::new(columns.rows(), series).map_err(failed)?;
        whole = if whole.height() == 0 { frame } else { stack(whole, frame).map_err(failed)? };
    }
    Ok(whole)
}

fn stack(mut above: DataFrame, below: DataFrame) -> PolarsResult<DataFrame> {
    above.vstack_mut_owned(below)?;
    Ok(above)
}

fn series(columns: &Columns, column: &Column) -> Result<Series, TableError> {
    let name = column.name.into();
    Ok(match (column.kind, column.nullable) {
        (Kind::Text, true) => Series::new(name, columns.optional_text(column)?),
        (Kind::Text, false) => Series::new(name, columns.text(column)?),
        (Kind::Float64, true) => Series::new(name, columns.optional_numbers(column)?),
        (Kind::Float64, false) => Series::new(name, columns.numbers(column)?),
        (Kind::Int64 | Kind::Int32, _) if columns.is_text(column) => Series::new(name, columns.text(column)?),
        (Kind::Int64 | Kind::Int32, _) => Series::new(name, columns.integers(column)?),
        (Kind::Samples, _) => return Err(columns.value_error(0, column, "no narrow table holds samples")),
    })
}

fn polars_error(path: &Path, source: &PolarsError) -> TableError {
    TableError::Read { path: path.to_path_buf(), message: source.to_string() }
}
