//! Tables between Python and the stages: the batches themselves, through the Arrow PyCapsule interface.

use std::path::PathBuf;
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Float64Type, Int32Type, Int64Type};
use arrow_array::{Array, ArrayRef, RecordBatch, StructArray};
use arrow_schema::{ArrowError, DataType, Field};
use numpy::IntoPyArray;
use pyo3::exceptions::{PyImportError, PyKeyError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict, PyList, PySlice, PyTuple};
use pyo3_arrow::error::PyArrowResult;
use pyo3_arrow::ffi::{ArrayIterator, to_schema_pycapsule, to_stream_pycapsule};
use pyo3_arrow::input::AnyRecordBatch;
use rockfrag::table::TableError;
use rockfrag::table::store::source::{MemoryTable, MemoryTables, Source};

use crate::error::to_python;

/// A table that a stage has made.
///
/// It has the columns of the file that the command would write, in memory. ``table["edp"]`` is a column as a NumPy array,
/// ``table[["edp", "outcome"]]`` a table of two columns, ``table[2:5]`` one of three rows. polars, pyarrow and DuckDB take the whole
/// without a copy, by the Arrow PyCapsule interface: ``polars.DataFrame(table)``, ``pyarrow.table(table)``,
/// ``duckdb.sql("from table")``. For pandas call ``table.to_pandas()``. Two tables are equal if their columns and all values are.
/// A table can be pickled, with its metadata; that needs pyarrow.
///
/// Examples
/// --------
/// >>> import rockfrag
/// >>> scenarios = rockfrag.sample_scenarios(mw="6.5", re="5", samples=3)
/// >>> scenarios.shape
/// (3, 9)
/// >>> scenarios.columns[:4]
/// ['scenario_id', 'cell', 'sample', 'mw']
/// >>> scenarios["re_km"]
/// array([5., 5., 5.])
/// >>> scenarios[["scenario_id", "mw"]][1:].shape
/// (2, 2)
/// >>> scenarios.metadata["parameters"]["seed"]
/// 42
/// >>> scenarios == rockfrag.sample_scenarios(mw=6.5, re=5, samples=3, seed=42)
/// True
#[pyclass(frozen, module = "rockfrag", name = "Table")]
pub struct PyTable {
    table: MemoryTable,
    parts: Vec<(String, Py<PyTable>)>,
    /// How it was made, as JSON.
    made: String,
}

impl PyTable {
    /// What a stage has left in memory under `main`, and under the names of `parts` what else there is.
    pub fn take(
        py: Python,
        tables: &MemoryTables,
        main: &str,
        parts: &[String],
        made: &str,
    ) -> PyResult<Option<PyTable>> {
        let made = made.to_string();
        let Some(table) = tables.take(main) else { return Ok(None) };
        let part = |name: &String| {
            let part = PyTable { table: tables.take(name)?, parts: Vec::new(), made: made.clone() };
            Some(Py::new(py, part).map(|part| (name.clone(), part)))
        };
        let parts = parts.iter().filter_map(part).collect::<PyResult<_>>()?;
        Ok(Some(PyTable { table, parts, made }))
    }

    fn convert<'py>(slf: &Bound<'py, Self>, module: &str, function: &str) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import(module)?.getattr(function)?.call1((slf,))
    }

    /// The batches of some rows.
    fn between(&self, start: usize, rows: usize) -> Vec<RecordBatch> {
        let (mut before, mut left) = (start, rows);
        let mut some = Vec::new();
        for batch in &self.table.batches {
            let skipped = before.min(batch.num_rows());
            let taken = left.min(batch.num_rows() - skipped);
            (before, left) = (before - skipped, left - taken);
            if taken > 0 {
                some.push(batch.slice(skipped, taken));
            }
        }
        some
    }

    /// The same table with other rows or columns.
    fn with(&self, py: Python, table: MemoryTable) -> PyTable {
        let parts = self.parts.iter().map(|(name, part)| (name.clone(), part.clone_ref(py))).collect();
        PyTable { table, parts, made: self.made.clone() }
    }

    /// The place of a column.
    fn place(&self, column: &str) -> PyResult<usize> {
        let known = self.table.schema.column_with_name(column).map(|(place, _)| place);
        known.ok_or_else(|| {
            PyKeyError::new_err(format!("no column '{column}'; there are {}", self.columns().join(", ")))
        })
    }

    fn column<'py>(&self, py: Python<'py>, column: &str) -> PyResult<Bound<'py, PyAny>> {
        let place = self.place(column)?;
        let arrays: Vec<ArrayRef> =
            self.table.batches.iter().map(|batch| batch.column(place).clone()).collect();
        column_of(py, self.table.schema.field(place).data_type(), &arrays)
    }

    fn of_columns(&self, py: Python, columns: &[String]) -> PyResult<PyTable> {
        let places = columns.iter().map(|column| self.place(column)).collect::<PyResult<Vec<usize>>>()?;
        let failed = |error: ArrowError| PyTypeError::new_err(error.to_string());
        let batches = self.table.batches.iter().map(|batch| batch.project(&places));
        let batches = batches.collect::<Result<_, _>>().map_err(failed)?;
        let schema = Arc::new(self.table.schema.project(&places).map_err(failed)?);
        Ok(self.with(py, MemoryTable { schema, batches, ..self.table.clone() }))
    }

    /// Whether all values are those of a table with as many rows, however these are cut into batches.
    fn has_rows_of(&self, other: &PyTable) -> bool {
        let (mut ours, mut theirs) = (self.between(0, usize::MAX), other.between(0, usize::MAX));
        ours.reverse();
        theirs.reverse();
        loop {
            let (Some(a), Some(b)) = (ours.pop(), theirs.pop()) else { return true };
            let rows = a.num_rows().min(b.num_rows());
            if a.slice(0, rows).columns() != b.slice(0, rows).columns() {
                return false;
            }
            for (batches, batch) in [(&mut ours, a), (&mut theirs, b)] {
                if batch.num_rows() > rows {
                    batches.push(batch.slice(rows, batch.num_rows() - rows));
                }
            }
        }
    }
}

#[pymethods]
impl PyTable {
    /// Names of the columns, in order. A name ends in its unit; the metadata of the Arrow fields have unit and meaning.
    #[getter]
    fn columns(&self) -> Vec<&str> {
        self.table.schema.fields().iter().map(|field| field.name().as_str()).collect()
    }

    /// Numbers of rows and columns.
    #[getter]
    fn shape(&self) -> (usize, usize) {
        (self.__len__(), self.table.schema.fields().len())
    }

    /// Further tables of the same stage, by name: ``scan`` and ``bootstrap`` of fits, ``trace`` of simulate.
    #[getter]
    fn parts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let parts = PyDict::new(py);
        self.parts.iter().try_for_each(|(name, part)| parts.set_item(name, part))?;
        Ok(parts)
    }

    /// How the table was made: stage, version, parameters (with the seed) and warnings.
    #[getter]
    fn metadata<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("json")?.getattr("loads")?.call1((&self.made,))
    }

    /// Returns the first rows, without a copy.
    #[pyo3(signature = (n=5))]
    fn head(&self, py: Python, n: isize) -> PyResult<PyTable> {
        let rows = usize::try_from(n)
            .map_err(|_| PyValueError::new_err(format!("n is {n}; expected a number of rows, 0 or more")))?;
        Ok(self.with(py, MemoryTable { batches: self.between(0, rows), ..self.table.clone() }))
    }

    /// Returns a ``polars.DataFrame``, without a copy.
    fn to_polars<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        PyTable::convert(slf, "polars", "DataFrame")
    }

    /// Returns a ``pyarrow.Table``, without a copy.
    fn to_pyarrow<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        PyTable::convert(slf, "pyarrow", "table")
    }

    /// Returns a ``pandas.DataFrame``; needs pyarrow.
    fn to_pandas<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        PyTable::to_pyarrow(slf)?.call_method0("to_pandas")
    }

    /// A column as a NumPy array: where a number is missing NaN, where anything else is missing None. Rows by a slice, and columns by a
    /// list of their names, are a table.
    fn __getitem__<'py>(&self, py: Python<'py>, key: &Bound<'py, PyAny>) -> PyResult<Bound<'py, PyAny>> {
        if let Ok(column) = key.extract::<String>() {
            return self.column(py, &column);
        }
        if let Ok(rows) = key.cast::<PySlice>() {
            let rows = rows.indices(self.__len__() as isize)?;
            if rows.step == 1 {
                let batches = self.between(rows.start as usize, rows.slicelength);
                let table = self.with(py, MemoryTable { batches, ..self.table.clone() });
                return Ok(Bound::new(py, table)?.into_any());
            }
        } else if key.is_instance_of::<PyList>()
            && let Ok(columns) = key.extract::<Vec<String>>()
        {
            return Ok(Bound::new(py, self.of_columns(py, &columns)?)?.into_any());
        }
        Err(PyTypeError::new_err(format!(
            "table[{}]; expected the name of a column, a list of names, or rows from:to; filter and sort table.to_polars() or \
             table.to_pandas()",
            key.repr()?
        )))
    }

    /// What an editor offers within the brackets.
    fn _ipython_key_completions_(&self) -> Vec<&str> {
        self.columns()
    }

    /// No array: pandas would take the names of the columns for values.
    #[pyo3(signature = (dtype=None, copy=None))]
    fn __array__(&self, dtype: Option<&Bound<PyAny>>, copy: Option<bool>) -> PyResult<()> {
        let _ = (dtype, copy);
        Err(PyTypeError::new_err(
            "a Table is no single array; take table.to_pandas() for pandas, or a column as table['name']",
        ))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyTuple>> {
        let py = slf.py();
        let whole =
            PyTable::to_pyarrow(slf).map_err(|error| match error.is_instance_of::<PyImportError>(py) {
                true => PyTypeError::new_err("to pickle a Table needs pyarrow: pip install pyarrow"),
                false => error,
            })?;
        let restored = py.import("rockfrag._rockfrag")?.getattr("restored")?;
        let table = slf.get();
        let parts: Vec<(&String, &Py<PyTable>)> =
            table.parts.iter().map(|(name, part)| (name, part)).collect();
        (restored, (whole, table.made.as_str(), parts)).into_pyobject(py)
    }

    fn __contains__(&self, column: &str) -> bool {
        self.table.schema.column_with_name(column).is_some()
    }

    fn __iter__<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        Ok(PyList::new(py, self.columns())?.try_iter()?.into_any())
    }

    fn __len__(&self) -> usize {
        self.table.rows() as usize
    }

    fn __eq__(&self, other: &Bound<PyAny>) -> bool {
        let Ok(other) = other.cast::<PyTable>() else { return false };
        let (ours, theirs) = (self.table.schema.fields(), other.get().table.schema.fields());
        let alike =
            |(a, b): (&Arc<Field>, &Arc<Field>)| a.name() == b.name() && a.data_type() == b.data_type();
        let as_long = self.table.rows() == other.get().table.rows();
        let is_alike = as_long && ours.len() == theirs.len() && ours.iter().zip(theirs).all(alike);
        is_alike && self.has_rows_of(other.get())
    }

    fn __repr__<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        PyTable::convert(slf, "rockfrag._show", "text")
    }

    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        PyTable::convert(slf, "rockfrag._show", "html")
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

/// The table that was pickled.
#[pyfunction]
pub fn restored(table: AnyRecordBatch, made: String, parts: Vec<(String, Py<PyTable>)>) -> PyResult<PyTable> {
    let (batches, schema) = table.into_table()?.into_inner();
    Ok(PyTable { table: MemoryTable { name: PathBuf::new(), schema, batches }, parts, made })
}

/// A column as a NumPy array.
fn column_of<'py>(py: Python<'py>, kind: &DataType, arrays: &[ArrayRef]) -> PyResult<Bound<'py, PyAny>> {
    let has_nulls = arrays.iter().any(|array| array.null_count() > 0);
    macro_rules! numbers {
        ($type:ty, $missing:expr) => {{
            let values = arrays.iter().flat_map(|array| array.as_primitive::<$type>().iter());
            values.map(|value| value.unwrap_or($missing)).collect::<Vec<_>>().into_pyarray(py).into_any()
        }};
    }
    Ok(match kind {
        DataType::Float64 => numbers!(Float64Type, f64::NAN),
        DataType::Float32 => numbers!(Float32Type, f32::NAN),
        DataType::Int64 if !has_nulls => numbers!(Int64Type, 0),
        DataType::Int32 if !has_nulls => numbers!(Int32Type, 0),
        _ => {
            let values = PyList::empty(py);
            for array in arrays {
                (0..array.len()).try_for_each(|row| values.append(value_of(py, array, row)?))?;
            }
            py.import("rockfrag._show")?.getattr("array")?.call1((values,))?
        }
    })
}

/// A value of a column that is not plain numbers.
fn value_of<'py>(py: Python<'py>, array: &ArrayRef, row: usize) -> PyResult<Option<Bound<'py, PyAny>>> {
    if array.is_null(row) {
        return Ok(None);
    }
    Ok(Some(match array.data_type() {
        DataType::Int64 => array.as_primitive::<Int64Type>().value(row).into_pyobject(py)?.into_any(),
        DataType::Int32 => array.as_primitive::<Int32Type>().value(row).into_pyobject(py)?.into_any(),
        DataType::Boolean => array.as_boolean().value(row).into_pyobject(py)?.to_owned().into_any(),
        DataType::Utf8 => array.as_string::<i32>().value(row).into_pyobject(py)?.into_any(),
        DataType::LargeUtf8 => array.as_string::<i64>().value(row).into_pyobject(py)?.into_any(),
        DataType::List(of) => {
            let values = array.as_list::<i32>().value(row);
            column_of(py, of.data_type(), &[values])?
        }
        DataType::LargeList(of) => {
            let values = array.as_list::<i64>().value(row);
            column_of(py, of.data_type(), &[values])?
        }
        other => {
            let message = format!(
                "a column of {other}; expected numbers, text or lists: take the table to polars or pyarrow"
            );
            return Err(PyTypeError::new_err(message));
        }
    }))
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
    let table = given.extract::<AnyRecordBatch>().map_err(|error| no_table(given.py(), name, error))?;
    let (batches, schema) = table.into_table()?.into_inner();
    Ok(Source::Memory(Arc::new(MemoryTable { name: name.into(), schema, batches })))
}

/// What a library says of a table that it cannot give as Arrow: pyarrow of a column of pandas whose values are of several types.
fn no_table(py: Python, name: &str, error: PyErr) -> PyErr {
    let words = error.value(py).getattr("args").and_then(|words| words.extract::<Vec<String>>());
    match words {
        Ok(words) if error.is_instance_of::<PyValueError>(py) || error.is_instance_of::<PyTypeError>(py) => {
            let message = format!("{}; expected values of one type in each column", words.join("; "));
            to_python(py, &TableError::Read { path: name.into(), message }.into())
        }
        _ => error,
    }
}
