//! Columns of a batch by name, as numbers, texts or lists, from any program.

use std::path::Path;

use arrow_array::cast::AsArray;
use arrow_array::types::{
    Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type, UInt8Type, UInt16Type, UInt32Type,
    UInt64Type,
};
use arrow_array::{Array, ArrayRef, RecordBatch};
use arrow_schema::DataType;

use super::TableError;
use super::dictionary;

/// A batch of the table at `path`, whose first row is row `first_row` of the file.
#[derive(Debug, Clone)]
pub struct Columns<'a> {
    pub path: &'a Path,
    pub first_row: u64,
    pub batch: &'a RecordBatch,
}

impl<'a> Columns<'a> {
    /// Returns the number of rows.
    pub fn rows(&self) -> usize {
        self.batch.num_rows()
    }

    /// Returns the numbers of a column, NaN for null or if it is missing.
    pub fn numbers(&self, name: &str) -> Result<Vec<f64>, TableError> {
        match self.batch.column_by_name(name) {
            None => Ok(vec![f64::NAN; self.rows()]),
            Some(column) => numbers(column).ok_or_else(|| self.other_type(name, column, "a number")),
        }
    }

    /// Returns the numbers of a column without nulls.
    pub fn required_numbers(&self, name: &'static str) -> Result<Vec<f64>, TableError> {
        self.expect(name)?;
        let numbers = self.numbers(name)?;
        match numbers.iter().position(|number| number.is_nan()) {
            Some(row) => Err(self.value_error(row, name, "no number; expected one")),
            None => Ok(numbers),
        }
    }

    /// Returns the texts of a column (integers as texts), `None` for null or if it is missing.
    pub fn texts(&self, name: &str) -> Result<Vec<Option<String>>, TableError> {
        let Some(column) = self.batch.column_by_name(name) else { return Ok(vec![None; self.rows()]) };
        if let Some(texts) = column.as_string_opt::<i32>() {
            return Ok(texts.iter().map(|text| text.map(str::to_string)).collect());
        }
        let whole = column.data_type().is_integer().then(|| numbers(column)).flatten();
        let whole = whole.ok_or_else(|| self.other_type(name, column, "text"))?;
        Ok(whole.iter().map(|number| (!number.is_nan()).then(|| number.to_string())).collect())
    }

    /// Returns the texts of a column without nulls.
    pub fn required_texts(&self, name: &'static str) -> Result<Vec<String>, TableError> {
        self.expect(name)?;
        let text = |(row, text): (usize, Option<String>)| {
            text.ok_or_else(|| self.value_error(row, name, "null; expected a text"))
        };
        self.texts(name)?.into_iter().enumerate().map(text).collect()
    }

    /// Returns the lists of numbers of a column without nulls.
    pub fn lists(&self, name: &'static str) -> Result<Vec<Vec<f64>>, TableError> {
        let column = self.expect(name)?;
        let list = |row: usize| {
            let items = match column.data_type() {
                _ if column.is_null(row) => None,
                DataType::List(_) => Some(column.as_list::<i32>().value(row)),
                DataType::LargeList(_) => Some(column.as_list::<i64>().value(row)),
                DataType::FixedSizeList(..) => Some(column.as_fixed_size_list().value(row)),
                _ => return Err(self.other_type(name, column, "a list of numbers")),
            };
            let items =
                items.ok_or_else(|| self.value_error(row, name, "null; expected a list of numbers"))?;
            numbers(&items).ok_or_else(|| self.other_type(name, column, "a list of numbers"))
        };
        (0..self.rows()).map(list).collect()
    }

    /// Makes the error of a value in a row of this batch.
    pub fn value_error(&self, row: usize, column: &'static str, problem: impl Into<String>) -> TableError {
        let row = self.first_row + row as u64;
        TableError::Value { path: self.path.to_path_buf(), row, column, problem: problem.into() }
    }

    fn expect(&self, name: &str) -> Result<&'a ArrayRef, TableError> {
        self.batch.column_by_name(name).ok_or_else(|| {
            let (path, column) = (self.path.to_path_buf(), name.to_string());
            TableError::MissingColumn { path, column, expected: dictionary::meaning(name) }
        })
    }

    fn other_type(&self, name: &str, column: &ArrayRef, expected: &'static str) -> TableError {
        let (path, column, found) =
            (self.path.to_path_buf(), name.to_string(), column.data_type().to_string());
        TableError::ColumnType { path, column, found, expected }
    }
}

/// Converts a column of numbers to f64, NaN for null; `None` for other types.
pub fn numbers(column: &ArrayRef) -> Option<Vec<f64>> {
    macro_rules! cast {
        ($type:ty) => {{
            let values = column.as_primitive::<$type>();
            match values.null_count() {
                0 => values.values().iter().map(|value| *value as f64).collect(),
                _ => values.iter().map(|value| value.map_or(f64::NAN, |value| value as f64)).collect(),
            }
        }};
    }
    Some(match column.data_type() {
        DataType::Float64 => cast!(Float64Type),
        DataType::Float32 => cast!(Float32Type),
        DataType::Int8 => cast!(Int8Type),
        DataType::Int16 => cast!(Int16Type),
        DataType::Int32 => cast!(Int32Type),
        DataType::Int64 => cast!(Int64Type),
        DataType::UInt8 => cast!(UInt8Type),
        DataType::UInt16 => cast!(UInt16Type),
        DataType::UInt32 => cast!(UInt32Type),
        DataType::UInt64 => cast!(UInt64Type),
        DataType::Null => vec![f64::NAN; column.len()],
        _ => return None,
    })
}
