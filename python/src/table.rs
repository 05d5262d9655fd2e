//! Tables between Python and Parquet files, by the C streams of Arrow.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use anyhow::Context as _;
use arrow_array::cast::AsArray;
use arrow_array::ffi_stream::{ArrowArrayStreamReader, FFI_ArrowArrayStream};
use arrow_array::{ArrayRef, RecordBatch, RecordBatchReader};
use arrow_schema::{ArrowError, DataType, Schema, SchemaRef};
use arrow_select::concat::concat_batches;
use arrow_select::take::take;
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::file::properties::WriterProperties;
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict};
use rockfrag::table::columns::{numbers as numbers_of, texts};
use rockfrag::table::file::ParquetTable;
use rockfrag::table::frame::{self, Format};

use crate::arrays::bytes;
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

/// The columns of a Parquet file whose names `wanted` has, if it is given, of at most so many rows: numbers as
/// the bytes of f64, NaN where there is none; texts, or lists of such bytes.
#[pyfunction]
pub fn read_columns<'py>(
    py: Python<'py>,
    path: PathBuf,
    wanted: Option<Vec<String>>,
    rows: Option<usize>,
) -> PyResult<Bound<'py, PyDict>> {
    let read = || -> anyhow::Result<_> {
        let place = || path.display().to_string();
        let file = ParquetRecordBatchReaderBuilder::try_new(File::open(&path).with_context(place)?)?;
        let (schema, most) = (file.schema().clone(), rows.unwrap_or(usize::MAX));
        let batches = file.with_limit(most).build()?.collect::<Result<Vec<_>, _>>()?;
        concat_batches(&schema, &batches).with_context(place)
    };
    let table = py.detach(read).map_err(|error| to_python(&error))?;
    let found = PyDict::new(py);
    columns(&found, &table, &|name| {
        wanted.as_ref().is_none_or(|wanted| wanted.iter().any(|one| one == name))
    })?;
    Ok(found)
}

/// Adds columns of a table.
pub fn columns(found: &Bound<PyDict>, table: &RecordBatch, is_wanted: &dyn Fn(&str) -> bool) -> PyResult<()> {
    let py = found.py();
    let of_numbers = |column: &ArrayRef| {
        let values = numbers_of(column)?.into_iter().map(|number| number.unwrap_or(f64::NAN));
        Some(bytes(py, values))
    };
    let schema = table.schema();
    let named = schema.fields().iter().map(|field| field.name()).zip(table.columns());
    for (name, column) in named.filter(|(name, _)| is_wanted(name)) {
        let flags = column.as_boolean_opt().map(|flags| {
            bytes(py, flags.iter().map(|flag| flag.map_or(f64::NAN, |flag| f64::from(u8::from(flag)))))
        });
        if let Some(numbers) = flags.or_else(|| of_numbers(column)) {
            found.set_item(name, numbers)?;
        } else if let Some(lists) = column.as_list_opt::<i32>() {
            let lists: Vec<_> = lists.iter().map(|list| of_numbers(&list?)).collect();
            found.set_item(name, lists)?;
        } else {
            found.set_item(name, texts(column))?;
        }
    }
    Ok(())
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
