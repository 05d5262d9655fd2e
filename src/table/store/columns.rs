//! The columns of a batch, by name: right in type, free of nulls where none may be.

use std::path::Path;
use std::sync::Arc;

use arrow_array::builder::StringViewBuilder;
use arrow_array::cast::AsArray;
use arrow_array::types::{
    Decimal128Type, Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type, UInt8Type,
    UInt16Type, UInt32Type,
};
use arrow_array::{Array, ArrayRef, Float32Array, Float64Array, RecordBatch, make_array, new_null_array};
use arrow_data::transform::MutableArrayData;
use arrow_schema::DataType;

use crate::motion::LONGEST_MOTION;
use crate::table::TableError;
use crate::table::schema::{Column, is_spectral_acceleration, spectral_acceleration};

/// The longest name of anything, bytes: that of a path.
const LONGEST_TEXT: usize = 4096;

/// A batch of rows of a file.
pub struct Columns<'a> {
    path: &'a Path,
    batch: &'a RecordBatch,
    /// The row of the file with which the batch begins.
    first_row: u64,
}

/// The samples of one row as they stand in the file: nothing is copied until they are used.
#[derive(Debug, Clone, PartialEq)]
pub enum Samples {
    /// In single precision.
    Float32(Float32Array),
    /// In double precision.
    Float64(Float64Array),
}

/// A column of spectral accelerations, m/s2.
#[derive(Debug, Clone, PartialEq)]
pub struct SpectralAcceleration {
    /// Its name, which tells the period.
    pub name: String,
    /// The number in each row, where there is one.
    pub values: Vec<Option<f64>>,
}

impl Samples {
    /// How many.
    #[expect(clippy::len_without_is_empty, reason = "a record has samples, or is none")]
    pub fn len(&self) -> usize {
        match self {
            Samples::Float32(samples) => samples.len(),
            Samples::Float64(samples) => samples.len(),
        }
    }

    /// All of them.
    pub fn to_vec(&self) -> Vec<f64> {
        let mut values = Vec::new();
        self.append_to(&mut values);
        values
    }

    /// Appends them to `values`.
    pub fn append_to(&self, values: &mut Vec<f64>) {
        match self {
            Samples::Float32(samples) => {
                values.extend(samples.values().iter().map(|&value| f64::from(value)))
            }
            Samples::Float64(samples) => values.extend_from_slice(samples.values()),
        }
    }
}

impl<'a> Columns<'a> {
    /// Of a batch that begins at `first_row` of the file at `path`.
    pub fn new(path: &'a Path, batch: &'a RecordBatch, first_row: u64) -> Columns<'a> {
        Columns { path, batch, first_row }
    }

    /// How many rows the batch has.
    pub fn rows(&self) -> usize {
        self.batch.num_rows()
    }

    /// Finite numbers, one in each row.
    ///
    /// # Errors
    /// If the column is missing or of another type, or a value is null, NaN or infinite.
    pub fn numbers(&self, column: &Column) -> Result<Vec<f64>, TableError> {
        let values = self.numbers_of(&self.required(column)?, column)?;
        values
            .into_iter()
            .enumerate()
            .map(|(row, value)| match value {
                Some(value) if value.is_finite() => Ok(value),
                Some(value) => {
                    Err(self.value_error(row, column, &format!("{value}; expected a finite number")))
                }
                None => Err(self.value_error(row, column, "null; expected a number")),
            })
            .collect()
    }

    /// Numbers, or `None` where the column or the value is missing (null or NaN).
    ///
    /// # Errors
    /// If the column has another type or a value is infinite.
    pub fn optional_numbers(&self, column: &Column) -> Result<Vec<Option<f64>>, TableError> {
        let Some(array) = self.column(column) else {
            return Ok(vec![None; self.rows()]);
        };
        let values = self.numbers_of(&array, column)?;
        let check = |(row, value): (usize, Option<f64>)| match value {
            Some(value) if value.is_infinite() => {
                Err(self.value_error(row, column, &format!("{value}; expected a finite number or null")))
            }
            Some(value) if value.is_nan() => Ok(None),
            value => Ok(value),
        };
        values.into_iter().enumerate().map(check).collect()
    }

    /// The columns of spectral accelerations.
    ///
    /// # Errors
    /// If one has another type.
    pub fn spectral_accelerations(&self) -> Result<Vec<SpectralAcceleration>, TableError> {
        let schema = self.batch.schema();
        let names = schema.fields().iter().map(|field| field.name());
        let spectral = names.zip(self.batch.columns()).filter(|(name, _)| is_spectral_acceleration(name));
        let numbers = |(name, array): (&String, &ArrayRef)| {
            let finite = |value: Option<f64>| value.filter(|value| value.is_finite());
            let values = self.numbers_of(array, &spectral_acceleration)?;
            Ok(SpectralAcceleration { name: name.clone(), values: values.into_iter().map(finite).collect() })
        };
        spectral.map(numbers).collect()
    }

    /// Whole numbers, one in each row.
    ///
    /// # Errors
    /// If the column is missing or of another type, or a value is null.
    pub fn integers(&self, column: &Column) -> Result<Vec<i64>, TableError> {
        let values = self.integers_of(&self.required(column)?, column)?;
        self.none_missing(values, column, "a whole number")
    }

    /// Whole numbers, or `None` where the column or the value is missing.
    ///
    /// # Errors
    /// If the column has another type.
    pub fn optional_integers(&self, column: &Column) -> Result<Vec<Option<i64>>, TableError> {
        match self.column(column) {
            Some(array) => self.integers_of(&array, column),
            None => Ok(vec![None; self.rows()]),
        }
    }

    /// Text, one in each row.
    ///
    /// # Errors
    /// If the column is missing or of another type, or a value is null.
    pub fn text(&self, column: &Column) -> Result<Vec<String>, TableError> {
        self.each_text(column, |text| Ok(text.to_string()))
    }

    /// Text, or `None` where the column or the value is missing.
    ///
    /// # Errors
    /// If the column has another type.
    pub fn optional_text(&self, column: &Column) -> Result<Vec<Option<String>>, TableError> {
        self.each_optional_text(column, |text| Ok(text.to_string()))
    }

    /// What `make` makes of the text in each row.
    ///
    /// # Errors
    /// If the column is missing or of another type, or a value is null, or what `make` says is wrong with it.
    pub fn each_text<T>(
        &self,
        column: &Column,
        make: impl FnMut(&str) -> Result<T, String>,
    ) -> Result<Vec<T>, TableError> {
        let values = self.text_of(&self.required(column)?, column, make)?;
        self.none_missing(values, column, "text")
    }

    /// The same where there is text.
    ///
    /// # Errors
    /// If the column is of another type, or what `make` says is wrong with a text.
    pub fn each_optional_text<T>(
        &self,
        column: &Column,
        make: impl FnMut(&str) -> Result<T, String>,
    ) -> Result<Vec<Option<T>>, TableError> {
        match self.column(column) {
            Some(array) => self.text_of(&array, column, make),
            None => Ok((0..self.rows()).map(|_| None).collect()),
        }
    }

    /// Text or whole numbers as text, one in each row.
    ///
    /// # Errors
    /// If the column is missing or of another type, or a value is null.
    pub fn labels(&self, column: &Column) -> Result<Vec<String>, TableError> {
        self.required(column)?;
        self.none_missing(self.optional_labels(column)?, column, "a name or a whole number")
    }

    /// Text or whole numbers as text, or `None` where the column or the value is missing.
    ///
    /// # Errors
    /// If the column has another type.
    pub fn optional_labels(&self, column: &Column) -> Result<Vec<Option<String>>, TableError> {
        match self.column(column) {
            Some(array) if array.data_type().is_integer() => {
                let numbers = self.integers_of(&array, column)?.into_iter();
                Ok(numbers.map(|number| number.map(|number| number.to_string())).collect())
            }
            _ => self.optional_text(column),
        }
    }

    /// Lists of finite numbers, or `None` where the column or the list is missing.
    ///
    /// # Errors
    /// If the column has another type, or a number is null or not finite.
    pub fn optional_lists(&self, column: &Column) -> Result<Vec<Option<Vec<f64>>>, TableError> {
        let Some(array) = self.column(column) else {
            return Ok(vec![None; self.rows()]);
        };
        let list: Box<dyn Fn(usize) -> ArrayRef> = match array.data_type() {
            DataType::List(_) => Box::new(|row| array.as_list::<i32>().value(row)),
            DataType::LargeList(_) => Box::new(|row| array.as_list::<i64>().value(row)),
            _ => return Err(self.wrong_type(&array, column)),
        };
        let each = |row| {
            if array.is_null(row) {
                return Ok(None);
            }
            let numbers = self.numbers_of(&list(row), column)?.into_iter();
            let finite = |number: Option<f64>| number.filter(|number| number.is_finite());
            let problem = || self.value_error(row, column, "a number is missing or not finite");
            numbers
                .map(|number| finite(number).ok_or_else(problem))
                .collect::<Result<Vec<f64>, _>>()
                .map(Some)
        };
        (0..self.rows()).map(each).collect()
    }

    /// The samples of each row.
    ///
    /// # Errors
    /// If the column is missing or no list of numbers, a list or one of its samples is null, or a list too long.
    pub fn samples(&self, column: &Column) -> Result<Vec<Samples>, TableError> {
        let array = self.required(column)?;
        let list: Box<dyn Fn(usize) -> ArrayRef> = match array.data_type() {
            DataType::List(_) => Box::new(|row| array.as_list::<i32>().value(row)),
            DataType::LargeList(_) => Box::new(|row| array.as_list::<i64>().value(row)),
            DataType::FixedSizeList(..) => Box::new(|row| array.as_fixed_size_list().value(row)),
            _ => return Err(self.wrong_type(&array, column)),
        };
        let each = |row| {
            if array.is_null(row) {
                return Err(self.value_error(row, column, "null; expected a list of samples"));
            }
            let samples = list(row);
            if samples.len() > LONGEST_MOTION {
                let problem = format!("{} samples; expected {LONGEST_MOTION} at most", samples.len());
                return Err(self.value_error(row, column, &problem));
            }
            if let Some(at) = samples.nulls().and_then(|nulls| nulls.iter().position(|valid| !valid)) {
                let problem = format!("sample {at} is null; expected a number");
                return Err(self.value_error(row, column, &problem));
            }
            match samples.data_type() {
                DataType::Float32 => Ok(Samples::Float32(samples.as_primitive().clone())),
                DataType::Float64 => Ok(Samples::Float64(samples.as_primitive().clone())),
                kind if kind.is_numeric() => {
                    let numbers =
                        self.numbers_of(&samples, column).map_err(|_| self.wrong_type(&array, column))?;
                    Ok(Samples::Float64(numbers.into_iter().flatten().collect::<Vec<f64>>().into()))
                }
                _ => Err(self.wrong_type(&array, column)),
            }
        };
        (0..self.rows()).map(each).collect()
    }

    /// Whether the batch has this column as text.
    pub fn is_text(&self, column: &Column) -> bool {
        let field = self.batch.schema_ref().field_with_name(column.name);
        field.is_ok_and(|field| match field.data_type() {
            DataType::Dictionary(_, of) => is_text(of),
            other => is_text(other),
        })
    }

    /// A value of a row of this batch that cannot be used.
    pub fn value_error(&self, row: usize, column: &Column, problem: &str) -> TableError {
        TableError::Value {
            path: self.path.to_path_buf(),
            row: self.first_row + row as u64,
            column: column.name.to_string(),
            problem: problem.to_string(),
        }
    }

    fn required(&self, column: &Column) -> Result<ArrayRef, TableError> {
        self.column(column).ok_or_else(|| missing(self.path, column))
    }

    fn column(&self, column: &Column) -> Option<ArrayRef> {
        self.batch.column_by_name(column.name).map(spelt_out)
    }

    fn numbers_of(&self, array: &ArrayRef, column: &Column) -> Result<Vec<Option<f64>>, TableError> {
        numbers(array).ok_or_else(|| self.wrong_type(array, column))
    }

    fn integers_of(&self, array: &ArrayRef, column: &Column) -> Result<Vec<Option<i64>>, TableError> {
        whole_numbers(array).ok_or_else(|| self.wrong_type(array, column))
    }

    fn text_of<T>(
        &self,
        array: &ArrayRef,
        column: &Column,
        mut make: impl FnMut(&str) -> Result<T, String>,
    ) -> Result<Vec<Option<T>>, TableError> {
        let made = |(row, value): (usize, Option<&str>)| {
            let Some(text) = value else { return Ok(None) };
            let made = match text.len() {
                0..=LONGEST_TEXT => make(text),
                bytes => Err(format!("text of {bytes} bytes; expected {LONGEST_TEXT} at most")),
            };
            made.map(Some).map_err(|problem| self.value_error(row, column, &problem))
        };
        match array.data_type() {
            DataType::Utf8 => array.as_string::<i32>().iter().enumerate().map(made).collect(),
            DataType::LargeUtf8 => array.as_string::<i64>().iter().enumerate().map(made).collect(),
            DataType::Utf8View => array.as_string_view().iter().enumerate().map(made).collect(),
            DataType::Null => Ok((0..array.len()).map(|_| None).collect()),
            _ => Err(self.wrong_type(array, column)),
        }
    }

    fn none_missing<T>(
        &self,
        values: Vec<Option<T>>,
        column: &Column,
        expected: &str,
    ) -> Result<Vec<T>, TableError> {
        let each = |(row, value): (usize, Option<T>)| {
            value.ok_or_else(|| self.value_error(row, column, &format!("null; expected {expected}")))
        };
        values.into_iter().enumerate().map(each).collect()
    }

    fn wrong_type(&self, array: &ArrayRef, column: &Column) -> TableError {
        TableError::WrongType {
            path: self.path.to_path_buf(),
            column: column.name.to_string(),
            found: words_of(array.data_type()),
            expected: column.words(),
        }
    }
}

/// The same array; of a dictionary (a categorical column) the values that it stands for.
pub fn spelt_out(array: &ArrayRef) -> ArrayRef {
    let Some(dictionary) = array.as_any_dictionary_opt() else { return array.clone() };
    let values = dictionary.values();
    if values.is_empty() {
        return new_null_array(values.data_type(), array.len());
    }
    let keys = dictionary.normalized_keys();
    // Only of what the rows have, since a dictionary may be that of many batches.
    match values.data_type() {
        DataType::Utf8 => shared(array, &keys, |key| values.as_string::<i32>().value(key)),
        DataType::LargeUtf8 => shared(array, &keys, |key| values.as_string::<i64>().value(key)),
        DataType::Utf8View => shared(array, &keys, |key| values.as_string_view().value(key)),
        _ => {
            let values = values.to_data();
            let mut rows = MutableArrayData::new(vec![&values], true, array.len());
            let each = |(row, key): (usize, usize)| match array.is_null(row) {
                true => rows.try_extend_nulls(1),
                false => rows.try_extend(0, key, key + 1),
            };
            match keys.into_iter().enumerate().try_for_each(each) {
                Ok(()) => make_array(rows.freeze()),
                Err(_) => array.clone(),
            }
        }
    }
}

/// The texts of rows, which share one that is long, however many they are.
fn shared<'t>(rows: &ArrayRef, keys: &[usize], text: impl Fn(usize) -> &'t str) -> ArrayRef {
    let nulls = rows.logical_nulls();
    let mut shared = StringViewBuilder::new().with_deduplicate_strings();
    for (row, key) in keys.iter().enumerate() {
        let is_null = nulls.as_ref().is_some_and(|nulls| nulls.is_null(row));
        shared.append_option((!is_null).then(|| text(*key)));
    }
    Arc::new(shared.finish())
}

/// Numbers of any type but whole ones of 64 bits without a sign.
pub fn numbers(array: &ArrayRef) -> Option<Vec<Option<f64>>> {
    match array.data_type() {
        DataType::Float64 => Some(array.as_primitive::<Float64Type>().iter().collect()),
        DataType::Float32 => {
            Some(array.as_primitive::<Float32Type>().iter().map(|value| value.map(f64::from)).collect())
        }
        // What DuckDB makes of a number that is written out.
        DataType::Decimal128(_, scale @ 0..) => {
            let unit: f64 = (0..*scale).map(|_| 10.0).product();
            let values = array.as_primitive::<Decimal128Type>().iter();
            Some(values.map(|value| Some(value? as f64 / unit)).collect())
        }
        DataType::Null => Some(vec![None; array.len()]),
        _ => Some(whole_numbers(array)?.into_iter().map(|value| Some(value? as f64)).collect()),
    }
}

/// Text, or numbers as text.
///
/// # Errors
/// If the column has another type, with that in words.
pub fn text_or_numbers(array: &ArrayRef) -> Result<Vec<Option<String>>, String> {
    let array = &spelt_out(array);
    let owned = |text: Option<&str>| text.map(str::to_string);
    match array.data_type() {
        DataType::Utf8 => Ok(array.as_string::<i32>().iter().map(owned).collect()),
        DataType::LargeUtf8 => Ok(array.as_string::<i64>().iter().map(owned).collect()),
        DataType::Utf8View => Ok(array.as_string_view().iter().map(owned).collect()),
        other => {
            if let Some(whole) = whole_numbers(array) {
                return Ok(whole.into_iter().map(|number| number.map(|number| number.to_string())).collect());
            }
            let numbers = numbers(array).ok_or_else(|| words_of(other))?;
            Ok(numbers.into_iter().map(|number| number.map(|number| number.to_string())).collect())
        }
    }
}

/// Whole numbers of any width but of 64 bits without a sign, which may not fit.
pub fn whole_numbers(array: &ArrayRef) -> Option<Vec<Option<i64>>> {
    macro_rules! of {
        ($($kind:ident: $type:ty),*) => {
            match array.data_type() {
                $(DataType::$kind => {
                    let values = array.as_primitive::<$type>().iter();
                    Some(values.map(|value| value.map(i64::from)).collect())
                })*
                _ => None,
            }
        };
    }
    of!(
        Int64: Int64Type, Int32: Int32Type, Int16: Int16Type, Int8: Int8Type, UInt32: UInt32Type, UInt16: UInt16Type,
        UInt8: UInt8Type
    )
}

/// A type of Arrow, in words.
pub fn words_of(data_type: &DataType) -> String {
    match data_type {
        text if is_text(text) => "text".to_string(),
        DataType::List(item) | DataType::LargeList(item) | DataType::FixedSizeList(item, _) => {
            format!("lists of {}", words_of(item.data_type()))
        }
        other => other.to_string(),
    }
}

/// The error for a column that a file does not have.
pub(super) fn missing(path: &Path, column: &Column) -> TableError {
    TableError::MissingColumn {
        path: path.to_path_buf(),
        column: column.name.to_string(),
        expected: column.words(),
    }
}

fn is_text(data_type: &DataType) -> bool {
    matches!(data_type, DataType::Utf8 | DataType::LargeUtf8 | DataType::Utf8View)
}
