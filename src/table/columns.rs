//! Columns of a batch by name, as numbers, texts or words, from any program.

use std::borrow::Cow;
use std::path::Path;
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Float64Type};
use arrow_array::{Array, ArrayRef, RecordBatch, downcast_integer};
use arrow_schema::DataType;

use super::TableError;
use crate::keyword::{self, Keyword};
use crate::plausibility::MAGNITUDES;
use crate::rocking::Structure;

/// Consecutive rows of a table.
#[derive(Debug, Clone)]
pub struct Batch {
    pub path: Arc<Path>,
    /// First row, counted in the file.
    pub first_row: usize,
    pub rows: RecordBatch,
}

impl Batch {
    /// Returns the numbers of a column, NaN for null or if it is missing.
    pub fn numbers(&self, name: &str) -> Result<Vec<f64>, TableError> {
        match self.rows.column_by_name(name) {
            None => Ok(vec![f64::NAN; self.rows.num_rows()]),
            Some(column) => numbers(column).ok_or_else(|| self.other_type(name, column, "a number")),
        }
    }

    /// Returns moment magnitudes; NaN where they are unknown.
    pub fn magnitudes(&self) -> Result<Vec<f64>, TableError> {
        let mw = self.numbers("mw")?;
        match mw.iter().position(|mw| !mw.is_nan() && !MAGNITUDES.contains(mw)) {
            Some(row) => {
                Err(self.value_error(row, "mw", format!("{}; expected a moment magnitude", mw[row])))
            }
            None => Ok(mw),
        }
    }

    /// Returns the numbers of a column without nulls.
    pub fn required_numbers(&self, name: &str) -> Result<Vec<f64>, TableError> {
        self.expect(name)?;
        let numbers = self.numbers(name)?;
        match numbers.iter().position(|number| number.is_nan()) {
            Some(row) => Err(self.value_error(row, name, "no number; expected one")),
            None => Ok(numbers),
        }
    }

    /// Returns the texts of a column (integers as texts), `None` for null or if it is missing.
    pub fn texts(&self, name: &str) -> Result<Vec<Option<Cow<'_, str>>>, TableError> {
        let Some(column) = self.rows.column_by_name(name) else {
            return Ok(vec![None; self.rows.num_rows()]);
        };
        if let Some(texts) = column.as_string_opt::<i32>() {
            return Ok(texts.iter().map(|text| text.map(Cow::Borrowed)).collect());
        }
        let whole = column.data_type().is_integer().then(|| numbers(column)).flatten();
        let whole = whole.ok_or_else(|| self.other_type(name, column, "text"))?;
        Ok(whole.iter().map(|number| (!number.is_nan()).then(|| Cow::Owned(number.to_string()))).collect())
    }

    pub fn required_texts(&self, name: &str) -> Result<Vec<Cow<'_, str>>, TableError> {
        self.expect(name)?;
        let text = |(row, text): (usize, Option<_>)| {
            text.ok_or_else(|| self.value_error(row, name, "null; expected a text"))
        };
        self.texts(name)?.into_iter().enumerate().map(text).collect()
    }

    pub fn required_words<T: Keyword>(&self, name: &str) -> Result<Vec<T>, TableError> {
        let word = |(row, text): (usize, Cow<str>)| {
            keyword::parse(&text).map_err(|unknown| self.value_error(row, name, unknown))
        };
        self.required_texts(name)?.into_iter().enumerate().map(word).collect()
    }

    /// Makes the structure of a row from its p (rad/s), alpha (rad) and eta.
    pub fn structure(&self, row: usize, name: &str, of: [f64; 3]) -> Result<Structure, TableError> {
        let [p_rad_s, alpha_rad, eta] = of;
        Structure::new(name, p_rad_s, alpha_rad, eta).map_err(|error| {
            let column = match error.parameter {
                "alpha" => "alpha_rad",
                "eta" => "eta",
                _ => "p_rad_s",
            };
            self.value_error(row, column, error)
        })
    }

    pub fn value_error(&self, row: usize, column: &str, problem: impl ToString) -> TableError {
        TableError::value(&self.path, self.first_row + row, column, problem)
    }

    fn expect(&self, name: &str) -> Result<&ArrayRef, TableError> {
        self.rows.column_by_name(name).ok_or_else(|| TableError::missing_column(&self.path, name))
    }

    fn other_type(&self, name: &str, column: &ArrayRef, expected: &'static str) -> TableError {
        TableError::other_type(&self.path, name, column.data_type(), expected)
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
    Some(downcast_integer! {
        column.data_type() => (cast),
        DataType::Float64 => cast!(Float64Type),
        DataType::Float32 => cast!(Float32Type),
        DataType::Null => vec![f64::NAN; column.len()],
        _ => return None,
    })
}
