//! Tables between Python and the stages: the batches themselves, through the Arrow PyCapsule interface.

use std::path::PathBuf;
use std::sync::Arc;

use arrow_array::{ArrayRef, StructArray};
use arrow_schema::{ArrowError, DataType, Field};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict};
use pyo3_arrow::error::PyArrowResult;
use pyo3_arrow::ffi::{ArrayIterator, to_schema_pycapsule, to_stream_pycapsule};
use pyo3_arrow::input::AnyRecordBatch;
use rockfrag::table::store::source::{MemoryTable, MemoryTables, Source};

/// A table that a stage has made. Any library that speaks the Arrow PyCapsule interface takes it without a copy:
/// ``polars.DataFrame(table)``, ``pyarrow.table(table)``, ``duckdb.sql("from table_name")``.
#[pyclass(frozen, module = "rockfrag", name = "Table")]
pub struct PyTable {
    table: MemoryTable,
    parts: Vec<(String, Py<PyTable>)>,
}

impl PyTable {
    /// What a stage has left in memory under `main`, and under the names of `parts` what else there is.
    pub fn take(
        py: Python,
        tables: &MemoryTables,
        main: &str,
        parts: &[String],
    ) -> PyResult<Option<PyTable>> {
        let Some(table) = tables.take(main) else { return Ok(None) };
        let part = |name: &String| {
            let table = tables.take(name)?;
            Some(Py::new(py, PyTable { table, parts: Vec::new() }).map(|part| (name.clone(), part)))
        };
        let parts = parts.iter().filter_map(part).collect::<PyResult<_>>()?;
        Ok(Some(PyTable { table, parts }))
    }

    fn convert<'py>(slf: &Bound<'py, Self>, module: &str, function: &str) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import(module)?.getattr(function)?.call1((slf,))
    }
}

#[pymethods]
impl PyTable {
    /// How many rows there are.
    #[getter]
    fn num_rows(&self) -> u64 {
        self.table.rows()
    }

    /// The names of the columns, in order; units are in their suffixes and, with the meaning, in the metadata of the fields.
    #[getter]
    fn column_names(&self) -> Vec<&str> {
        self.table.schema.fields().iter().map(|field| field.name().as_str()).collect()
    }

    /// Further tables of the same stage, by name: ``scan`` and ``bootstrap`` of fits, ``trace`` of simulate.
    #[getter]
    fn parts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let parts = PyDict::new(py);
        self.parts.iter().try_for_each(|(name, part)| parts.set_item(name, part))?;
        Ok(parts)
    }

    /// As a ``polars.DataFrame``.
    fn to_polars<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        PyTable::convert(slf, "polars", "DataFrame")
    }

    /// As a ``pyarrow.Table``.
    fn to_pyarrow<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        PyTable::convert(slf, "pyarrow", "table")
    }

    /// As a ``pandas.DataFrame``, by way of pyarrow.
    fn to_pandas<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        PyTable::to_pyarrow(slf)?.call_method0("to_pandas")
    }

    fn __len__(&self) -> usize {
        self.table.rows() as usize
    }

    fn __repr__(&self) -> String {
        let columns = self.column_names();
        format!(
            "<rockfrag.Table of {}: {} rows, {}>",
            self.table.name.display(),
            self.table.rows(),
            columns.join(", ")
        )
    }

    fn __arrow_c_schema__<'py>(&self, py: Python<'py>) -> PyArrowResult<Bound<'py, PyCapsule>> {
        to_schema_pycapsule(py, self.table.schema.as_ref())
    }

    #[pyo3(signature = (requested_schema=None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyCapsule>>,
    ) -> PyArrowResult<Bound<'py, PyCapsule>> {
        let field = Field::new("", DataType::Struct(self.table.schema.fields().clone()), false);
        let arrays: Vec<Result<ArrayRef, ArrowError>> = self
            .table
            .batches
            .iter()
            .map(|batch| Ok(Arc::new(StructArray::from(batch.clone())) as _))
            .collect();
        let reader = ArrayIterator::new(arrays, Arc::new(field));
        to_stream_pycapsule(py, Box::new(reader), requested_schema)
    }
}

/// A table as Python gives it: a path, or anything that speaks Arrow. `name` stands for it in messages.
pub fn source(name: &str, given: &Bound<PyAny>) -> PyResult<Source> {
    if let Ok(path) = given.extract::<PathBuf>() {
        return Ok(Source::Path(path));
    }
    if !given.hasattr("__arrow_c_stream__")? && !given.hasattr("__arrow_c_array__")? {
        let message = format!(
            "{name} is {}; expected a path, or a table that speaks Arrow (__arrow_c_stream__): of polars, pyarrow, pandas, DuckDB or rockfrag",
            given.get_type().name()?
        );
        return Err(PyTypeError::new_err(message));
    }
    let (batches, schema) = given.extract::<AnyRecordBatch>()?.into_table()?.into_inner();
    Ok(Source::Memory(Arc::new(MemoryTable { name: name.into(), schema, batches })))
}
