//! Tables between Python and Parquet files, by the C streams of Arrow.

use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::Context as _;
use arrow_array::cast::AsArray;
use arrow_array::ffi_stream::{ArrowArrayStreamReader, FFI_ArrowArrayStream};
use arrow_array::{ArrayRef, Float64Array, RecordBatch, RecordBatchReader};
use arrow_schema::{ArrowError, DataType, Schema, SchemaRef};
use arrow_select::take::take;
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::file::properties::WriterProperties;
use pyo3::prelude::*;
use pyo3::pybacked::PyBackedBytes;
use pyo3::types::{PyBytes, PyCapsule};
use rockfrag::table::file::ParquetTable;
use rockfrag::table::frame::{self, Format};

use crate::arrays::{bytes, numbers};
use crate::error::to_python;

/// Rows of a row group: of lists, such as the samples of motions, and of numbers.
const ROWS_OF_LISTS: usize = 64;
const ROWS_OF_NUMBERS: usize = 32_768;

/// A Parquet file as a capsule with an Arrow stream, which reads it as rows are wanted.
#[pyfunction]
pub fn read_table(py: Python, path: PathBuf) -> PyResult<Bound<PyCapsule>> {
    let reader = || -> anyhow::Result<_> {
        let place = || path.display().to_string();
        let file = File::open(&path).with_context(place)?;
        ParquetRecordBatchReaderBuilder::try_new(file)?.build().with_context(place)
    };
    let reader = reader().map_err(|error| to_python(&error))?;
    PyCapsule::new_with_value(py, FFI_ArrowArrayStream::new(Box::new(reader)), c"arrow_array_stream")
}

/// Writes the rows of an Arrow stream to a Parquet file, or, where `path` ends so, to CSV.
#[pyfunction]
pub fn write_table(py: Python, capsule: &Bound<PyCapsule>, path: PathBuf) -> PyResult<()> {
    let stream = capsule.pointer_checked(Some(c"arrow_array_stream"))?.as_ptr().cast();
    // SAFETY: a capsule of this name holds a valid stream; it is moved out, and a released one is left.
    #[allow(unsafe_code)]
    let reader = unsafe { ArrowArrayStreamReader::from_raw(stream) };
    let written = reader.map_err(anyhow::Error::from).and_then(|reader| {
        // What makes the rows may be Python itself, which takes the GIL again where it needs it.
        py.detach(|| match path.extension().is_some_and(|extension| extension == "csv") {
            true => write_csv(reader, &path),
            false => write(reader.schema(), reader, &path),
        })
    });
    written.map_err(|error| to_python(&error))
}

/// Writes columns, given as the bytes of f64, to a Parquet file.
#[pyfunction]
pub fn write_numbers(columns: BTreeMap<String, PyBackedBytes>, path: PathBuf) -> PyResult<()> {
    let column = |(name, bytes): (String, PyBackedBytes)| {
        (name, Arc::new(Float64Array::from(numbers(&bytes))) as ArrayRef)
    };
    let written = RecordBatch::try_from_iter(columns.into_iter().map(column)).map_err(anyhow::Error::from);
    let written = written.and_then(|batch| write(batch.schema(), [Ok(batch)], &path));
    written.map_err(|error| to_python(&error))
}

/// The columns of a Parquet file whose names `wanted` has, as the bytes of f64; NaN where there is no number.
#[pyfunction]
pub fn read_numbers<'py>(
    py: Python<'py>,
    path: PathBuf,
    wanted: Vec<String>,
) -> PyResult<BTreeMap<String, Bound<'py, PyBytes>>> {
    let mut columns: BTreeMap<String, Vec<f64>> = wanted.into_iter().map(|name| (name, Vec::new())).collect();
    let read = |columns: &mut BTreeMap<String, Vec<f64>>| -> anyhow::Result<()> {
        for batch in ParquetTable::open(&path)?.batches(|_| true) {
            let batch = batch?;
            for (name, values) in columns.iter_mut() {
                let numbers = batch.numbers(name)?.into_iter();
                values.extend(numbers.map(|number| number.unwrap_or(f64::NAN)));
            }
        }
        Ok(())
    };
    py.detach(|| read(&mut columns)).map_err(|error| to_python(&error))?;
    Ok(columns.into_iter().map(|(name, values)| (name, bytes(py, values.into_iter()))).collect())
}

fn write(
    schema: SchemaRef,
    batches: impl IntoIterator<Item = Result<RecordBatch, ArrowError>>,
    path: &Path,
) -> anyhow::Result<()> {
    let has_lists = schema.fields().iter().any(|field| field.data_type().is_nested());
    let rows = if has_lists { ROWS_OF_LISTS } else { ROWS_OF_NUMBERS };
    let properties = WriterProperties::builder()
        .set_dictionary_enabled(false)
        .set_max_row_group_row_count(Some(rows))
        .build();
    let fields = schema.fields().iter().map(|field| match field.data_type() {
        DataType::Dictionary(_, values) => {
            Arc::new(field.as_ref().clone().with_data_type(values.as_ref().clone()))
        }
        _ => field.clone(),
    });
    let schema = Arc::new(Schema::new(fields.collect::<Vec<_>>()));
    let mut writer = ArrowWriter::try_new(File::create(path)?, schema.clone(), Some(properties))?;
    for batch in batches {
        let columns = batch?.columns().iter().map(without_dictionary).collect::<Result<_, _>>()?;
        writer.write(&RecordBatch::try_new(schema.clone(), columns)?)?;
    }
    writer.close()?;
    Ok(())
}

/// A column of categories as the values themselves.
fn without_dictionary(column: &ArrayRef) -> Result<ArrayRef, ArrowError> {
    match column.as_any_dictionary_opt() {
        Some(categories) => take(categories.values(), categories.keys(), None),
        None => Ok(column.clone()),
    }
}

fn write_csv(reader: ArrowArrayStreamReader, path: &Path) -> anyhow::Result<()> {
    let parquet = path.with_extension("parquet");
    write(reader.schema(), reader, &parquet)?;
    let text = frame::show(&frame::read(&ParquetTable::open(&parquet)?)?, Format::Csv)?;
    Ok(std::fs::write(path, text)?)
}
