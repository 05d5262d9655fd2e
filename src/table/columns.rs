//! Columns of a batch by name, as numbers, texts or words, from any program.

use std::borrow::Cow;
use std::path::Path;
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::{Decimal128Type, Float16Type, Float32Type};
use arrow_array::{Array, ArrayRef, Float64Array, RecordBatch, downcast_integer};
use arrow_schema::DataType;
use rockfrag_core::plausibility::range_of_column;
use rockfrag_core::rocking::Structure;
use uuid::Uuid;

use super::{TableError, dictionary};

#[derive(Debug, Clone)]
pub struct Batch {
    pub path: Arc<Path>,
    /// First row, counted in the file.
    pub first_row: usize,
    pub rows: RecordBatch,
}

impl Batch {
    /// Returns the numbers of a column, each in the range of its quantity; `None` for null, for NaN, which
    /// some programs write for null, and if the column is missing.
    pub fn numbers(&self, name: &str) -> Result<Vec<Option<f64>>, TableError> {
        let numbers = self.column(name, numbers, "a number")?;
        let (range, expected) = range_of_column(name);
        let outside = |(_, number): &(usize, &Option<f64>)| number.is_some_and(|one| !range.contains(&one));
        if let Some((row, Some(found))) = numbers.iter().enumerate().find(outside) {
            return Err(self.value_error(row, name, format!("{found:?}; expected {expected}")));
        }
        Ok(numbers)
    }

    pub fn required_numbers(&self, name: &str) -> Result<Vec<f64>, TableError> {
        self.required(name, self.numbers(name)?)
    }

    /// Returns the integers of a column, `None` for null and if the column is missing.
    pub fn counts<T: TryFrom<i128> + Clone>(&self, name: &str) -> Result<Vec<Option<T>>, TableError> {
        let whole = self.column(name, integers, "whole numbers")?;
        let counts = whole.iter().enumerate().map(|(row, number)| {
            number.map(T::try_from).transpose().map_err(|_| {
                let found = number.unwrap_or_default();
                self.value_error(row, name, format!("{found}; expected {}", dictionary::meaning(name)))
            })
        });
        counts.collect()
    }

    /// Returns the texts of a column (integers as texts), `None` for null and if the column is missing.
    pub fn texts(&self, name: &str) -> Result<Vec<Option<Cow<'_, str>>>, TableError> {
        self.column(name, texts, "text")
    }

    pub fn required_texts(&self, name: &str) -> Result<Vec<Cow<'_, str>>, TableError> {
        self.required(name, self.texts(name)?)
    }

    pub fn lists(&self, name: &str) -> Result<Vec<Vec<f64>>, TableError> {
        let Some(column) = self.rows.column_by_name(name) else {
            return Err(TableError::missing_column(&self.path, name));
        };
        let expected = "a list of numbers";
        let lists = column.as_list_opt::<i32>().ok_or_else(|| self.other_type(name, column, expected))?;
        let read = lists.iter().enumerate().map(|(row, list)| {
            let list = list.filter(|list| list.null_count() == 0).ok_or_else(|| {
                self.value_error(row, name, format!("null, or with a null; expected {expected}"))
            })?;
            // The record tells of NaN.
            let numbers = floats(&list).ok_or_else(|| self.other_type(name, column, expected))?;
            Ok(numbers.values().to_vec())
        });
        read.collect()
    }

    pub fn structures(&self, names: &[Cow<str>]) -> Result<Vec<Structure>, TableError> {
        let (p, alpha) = (self.required_numbers("p_rad_s")?, self.required_numbers("alpha_rad")?);
        let eta = self.required_numbers("eta")?;
        let structures =
            names.iter().zip(p).zip(alpha).zip(eta).map(|(((name, p_rad_s), alpha_rad), eta)| Structure {
                name: name.to_string(),
                p_rad_s,
                alpha_rad,
                eta,
                rebound: None,
            });
        Ok(structures.collect())
    }

    fn required<T>(&self, name: &str, values: Vec<Option<T>>) -> Result<Vec<T>, TableError> {
        if self.rows.column_by_name(name).is_none() {
            return Err(TableError::missing_column(&self.path, name));
        }
        let known = values.into_iter().enumerate();
        known.map(|(row, value)| value.ok_or_else(|| self.null_error(row, name))).collect()
    }

    fn column<'a, T: Clone>(
        &'a self,
        name: &str,
        read: fn(&'a ArrayRef) -> Option<Vec<Option<T>>>,
        expected: &str,
    ) -> Result<Vec<Option<T>>, TableError> {
        match self.rows.column_by_name(name) {
            Some(column) => read(column).ok_or_else(|| self.other_type(name, column, expected)),
            None => Ok(vec![None; self.rows.num_rows()]),
        }
    }

    pub fn null_error(&self, row: usize, column: &str) -> TableError {
        self.value_error(row, column, format!("none; expected {}", dictionary::meaning(column)))
    }

    pub fn value_error(&self, row: usize, column: &str, problem: impl ToString) -> TableError {
        TableError::value(&self.path, self.first_row + row, column, problem)
    }

    fn other_type(&self, name: &str, column: &ArrayRef, expected: &str) -> TableError {
        let found = column.data_type();
        TableError::table(&self.path, format!("column '{name}' is {found}; expected {expected}"))
    }
}

/// Returns a column of numbers, `None` for null and NaN; `None` for other types.
pub fn numbers(column: &ArrayRef) -> Option<Vec<Option<f64>>> {
    Some(floats(column)?.iter().map(|number| number.filter(|number| !number.is_nan())).collect())
}

fn floats(column: &ArrayRef) -> Option<Float64Array> {
    Some(match *column.data_type() {
        DataType::Float64 => column.as_primitive().clone(),
        DataType::Float32 => column.as_primitive::<Float32Type>().unary(f64::from),
        DataType::Float16 => column.as_primitive::<Float16Type>().unary(f64::from),
        DataType::Decimal128(_, scale) => {
            let unit = 10f64.powi(i32::from(scale));
            column.as_primitive::<Decimal128Type>().unary(|value| value as f64 / unit)
        }
        _ => integers(column)?.into_iter().map(|value| value.map(|value| value as f64)).collect(),
    })
}

/// Returns a column of texts, or of integers, UTF-8 in bytes or UUIDs as texts; `None` for other types.
pub fn texts(column: &ArrayRef) -> Option<Vec<Option<Cow<'_, str>>>> {
    if let Some(texts) = column.as_string_opt::<i32>() {
        return Some(texts.iter().map(|text| text.map(Cow::Borrowed)).collect());
    }
    let bytes = column.as_binary_opt::<i32>().map(|bytes| bytes.iter().collect::<Vec<_>>());
    let bytes = bytes.or_else(|| Some(column.as_fixed_size_binary_opt()?.iter().collect()));
    if let Some(bytes) = bytes {
        let text = |bytes| std::str::from_utf8(bytes).ok().map(Cow::Borrowed);
        let uuid = |bytes| Uuid::from_slice(bytes).ok().map(|uuid| Cow::Owned(uuid.to_string()));
        let texts = bytes.iter().map(|bytes| bytes.map_or(Some(None), |bytes| text(bytes).map(Some)));
        let uuids = bytes.iter().map(|bytes| bytes.map_or(Some(None), |bytes| uuid(bytes).map(Some)));
        return texts.collect::<Option<_>>().or_else(|| uuids.collect());
    }
    Some(integers(column)?.into_iter().map(|number| Some(Cow::Owned(number?.to_string()))).collect())
}

/// Returns a column of integers of any size; `None` for other types.
pub fn integers(column: &ArrayRef) -> Option<Vec<Option<i128>>> {
    macro_rules! cast {
        ($type:ty) => {
            column.as_primitive::<$type>().iter().map(|value| value.map(|value| value as i128)).collect()
        };
    }
    Some(downcast_integer! {
        column.data_type() => (cast),
        DataType::Decimal128(_, 0) => cast!(Decimal128Type),
        DataType::Null => vec![None; column.len()],
        _ => return None,
    })
}
