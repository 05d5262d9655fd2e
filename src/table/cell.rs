//! The values that a field of a row can have: how a column is made of them, and read.

use std::collections::HashSet;
use std::sync::Arc;

use arrow_array::builder::{Float32Builder, Float64Builder, ListBuilder};
use arrow_array::{ArrayRef, Float64Array, Int32Array, Int64Array, StringArray};
use arrow_schema::{DataType, Field};

use super::TableError;
use super::schema::{Column, Kind, same};
use super::store::columns::{Columns, Samples};
use crate::keyword::{self, Keyword};

/// The type of a field of a row: a value, or an `Option` of one where it may be missing.
pub trait Cell {
    const KIND: Kind;
    const NULLABLE: bool;
}

/// A cell that can be written.
pub trait WriteCell: Cell {
    /// Makes a column of cells; `by_name` says whether motions go by name rather than by number.
    fn array<'r>(cells: impl Iterator<Item = &'r Self>, by_name: bool) -> ArrayRef
    where
        Self: 'r;
}

/// A cell that can be read.
pub trait ReadCell: Cell + Sized {
    /// Reads the cells of a column.
    ///
    /// # Errors
    /// If the column is missing or of another type, or a value cannot be used.
    fn read(columns: &Columns, column: &Column) -> Result<Vec<Self>, TableError>;
}

/// A value of a column.
pub trait Value {
    const KIND: Kind;
}

/// A value that can be written.
pub trait WriteValue: Value {
    fn optional_array<'r>(values: impl Iterator<Item = Option<&'r Self>>, by_name: bool) -> ArrayRef
    where
        Self: 'r;

    fn array<'r>(values: impl Iterator<Item = &'r Self>, by_name: bool) -> ArrayRef
    where
        Self: 'r,
    {
        Self::optional_array(values.map(Some), by_name)
    }
}

/// A value that can be read.
pub trait ReadValue: Value + Sized {
    /// Reads a value in each row.
    fn read(columns: &Columns, column: &Column) -> Result<Vec<Self>, TableError>;

    /// Reads values, where there are any.
    fn read_optional(columns: &Columns, column: &Column) -> Result<Vec<Option<Self>>, TableError>;
}

impl<V: Value> Cell for V {
    const KIND: Kind = V::KIND;
    const NULLABLE: bool = false;
}

impl<V: Value> Cell for Option<V> {
    const KIND: Kind = V::KIND;
    const NULLABLE: bool = true;
}

impl<V: WriteValue> WriteCell for V {
    fn array<'r>(cells: impl Iterator<Item = &'r V>, by_name: bool) -> ArrayRef
    where
        V: 'r,
    {
        V::array(cells, by_name)
    }
}

impl<V: WriteValue> WriteCell for Option<V> {
    fn array<'r>(cells: impl Iterator<Item = &'r Option<V>>, by_name: bool) -> ArrayRef
    where
        V: 'r,
    {
        V::optional_array(cells.map(Option::as_ref), by_name)
    }
}

impl<V: ReadValue> ReadCell for V {
    fn read(columns: &Columns, column: &Column) -> Result<Vec<V>, TableError> {
        V::read(columns, column)
    }
}

impl<V: ReadValue> ReadCell for Option<V> {
    fn read(columns: &Columns, column: &Column) -> Result<Vec<Option<V>>, TableError> {
        V::read_optional(columns, column)
    }
}

/// Checks, while the program is compiled, that a field has the name and the type of its column.
pub const fn column_of<C: Cell>(column: Column, field: &str) -> Column {
    assert!(C::KIND as u8 == column.kind as u8, "the field has another type than its column");
    assert!(same(column.name, field), "the field has another name than its column");
    Column { nullable: C::NULLABLE, ..column }
}

impl Value for f64 {
    const KIND: Kind = Kind::Float64;
}

impl WriteValue for f64 {
    /// What is not a finite number is missing.
    fn optional_array<'r>(values: impl Iterator<Item = Option<&'r f64>>, _: bool) -> ArrayRef {
        let finite = |value: Option<&f64>| value.copied().filter(|value| value.is_finite());
        Arc::new(Float64Array::from_iter(values.map(finite)))
    }

    fn array<'r>(values: impl Iterator<Item = &'r f64>, _: bool) -> ArrayRef {
        Arc::new(Float64Array::from_iter_values(values.copied()))
    }
}

impl ReadValue for f64 {
    fn read(columns: &Columns, column: &Column) -> Result<Vec<f64>, TableError> {
        columns.numbers(column)
    }

    fn read_optional(columns: &Columns, column: &Column) -> Result<Vec<Option<f64>>, TableError> {
        columns.optional_numbers(column)
    }
}

/// Whole numbers: their type in Rust, that in the file, and what a message calls them.
macro_rules! whole_numbers {
    ($($type:ty as $written:ty, $array:ident, $kind:ident, $words:literal;)*) => {
        $(
            impl Value for $type {
                const KIND: Kind = Kind::$kind;
            }

            impl WriteValue for $type {
                fn optional_array<'r>(values: impl Iterator<Item = Option<&'r $type>>, _: bool) -> ArrayRef {
                    Arc::new($array::from_iter(values.map(|value| value.map(|&value| value as $written))))
                }

                fn array<'r>(values: impl Iterator<Item = &'r $type>, _: bool) -> ArrayRef {
                    Arc::new($array::from_iter_values(values.map(|&value| value as $written)))
                }
            }

            impl ReadValue for $type {
                fn read(columns: &Columns, column: &Column) -> Result<Vec<$type>, TableError> {
                    let values = columns.integers(column)?.into_iter().enumerate();
                    values.map(|(row, value)| narrow(value, columns, column, row, $words)).collect()
                }

                fn read_optional(columns: &Columns, column: &Column) -> Result<Vec<Option<$type>>, TableError> {
                    let values = columns.optional_integers(column)?.into_iter().enumerate();
                    let each = |(row, value): (usize, Option<i64>)| {
                        value.map(|value| narrow(value, columns, column, row, $words)).transpose()
                    };
                    values.map(each).collect()
                }
            }
        )*
    };
}

whole_numbers! {
    i64 as i64, Int64Array, Int64, "a whole number";
    usize as i64, Int64Array, Int64, "a count";
    i32 as i32, Int32Array, Int32, "a 32-bit integer";
}

fn narrow<T: TryFrom<i64>>(
    value: i64,
    columns: &Columns,
    column: &Column,
    row: usize,
    expected: &str,
) -> Result<T, TableError> {
    T::try_from(value).map_err(|_| columns.value_error(row, column, &format!("{value}; expected {expected}")))
}

/// Text, whoever holds it.
macro_rules! texts {
    ($($type:ty),*) => {
        $(
            impl Value for $type {
                const KIND: Kind = Kind::Text;
            }

            impl WriteValue for $type {
                fn optional_array<'r>(values: impl Iterator<Item = Option<&'r Self>>, _: bool) -> ArrayRef
                where
                    Self: 'r,
                {
                    Arc::new(values.collect::<StringArray>())
                }
            }
        )*
    };
}

texts!(String, &str, Arc<str>);

impl ReadValue for String {
    fn read(columns: &Columns, column: &Column) -> Result<Vec<String>, TableError> {
        columns.text(column)
    }

    fn read_optional(columns: &Columns, column: &Column) -> Result<Vec<Option<String>>, TableError> {
        columns.optional_text(column)
    }
}

/// Equal texts of a batch are one: for columns of few words in many rows.
impl ReadValue for Arc<str> {
    fn read(columns: &Columns, column: &Column) -> Result<Vec<Arc<str>>, TableError> {
        let mut known = HashSet::new();
        columns.each_text(column, |text| Ok(shared(&mut known, text)))
    }

    fn read_optional(columns: &Columns, column: &Column) -> Result<Vec<Option<Arc<str>>>, TableError> {
        let mut known = HashSet::new();
        columns.each_optional_text(column, |text| Ok(shared(&mut known, text)))
    }
}

fn shared(known: &mut HashSet<Arc<str>>, text: &str) -> Arc<str> {
    if let Some(text) = known.get(text) {
        return text.clone();
    }
    let text: Arc<str> = text.into();
    known.insert(text.clone());
    text
}

/// A word of a list stands in the file as text.
impl<K: Keyword> Value for K {
    const KIND: Kind = Kind::Text;
}

impl<K: Keyword> WriteValue for K {
    fn optional_array<'r>(values: impl Iterator<Item = Option<&'r K>>, _: bool) -> ArrayRef {
        Arc::new(values.map(|word| word.map(|word| word.as_str())).collect::<StringArray>())
    }
}

impl<K: Keyword> ReadValue for K {
    fn read(columns: &Columns, column: &Column) -> Result<Vec<K>, TableError> {
        columns.each_text(column, |word| keyword::parse(word).map_err(|unknown| unknown.to_string()))
    }

    fn read_optional(columns: &Columns, column: &Column) -> Result<Vec<Option<K>>, TableError> {
        columns.each_optional_text(column, |word| keyword::parse(word).map_err(|unknown| unknown.to_string()))
    }
}

/// A name that others may give as a whole number.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Label(pub String);

impl Value for Label {
    const KIND: Kind = Kind::Text;
}

impl ReadValue for Label {
    fn read(columns: &Columns, column: &Column) -> Result<Vec<Label>, TableError> {
        Ok(columns.labels(column)?.into_iter().map(Label).collect())
    }

    fn read_optional(columns: &Columns, column: &Column) -> Result<Vec<Option<Label>>, TableError> {
        Ok(columns.optional_labels(column)?.into_iter().map(|label| label.map(Label)).collect())
    }
}

impl Value for &[f32] {
    const KIND: Kind = Kind::Samples;
}

/// The samples of motions, one list a motion.
impl WriteValue for &[f32] {
    fn optional_array<'r>(motions: impl Iterator<Item = Option<&'r Self>>, _: bool) -> ArrayRef
    where
        Self: 'r,
    {
        let item = Field::new("item", DataType::Float32, false);
        let mut list = ListBuilder::new(Float32Builder::new()).with_field(item);
        for samples in motions {
            list.values().append_slice(samples.copied().unwrap_or_default());
            list.append(samples.is_some());
        }
        Arc::new(list.finish())
    }
}

impl Value for Samples {
    const KIND: Kind = Kind::Samples;
}

impl ReadValue for Samples {
    fn read(columns: &Columns, column: &Column) -> Result<Vec<Samples>, TableError> {
        columns.samples(column)
    }

    fn read_optional(columns: &Columns, column: &Column) -> Result<Vec<Option<Samples>>, TableError> {
        Ok(columns.samples(column)?.into_iter().map(Some).collect())
    }
}

/// So many numbers, one list a row.
impl<const N: usize> Value for [f64; N] {
    const KIND: Kind = Kind::Numbers;
}

impl<const N: usize> WriteValue for [f64; N] {
    fn optional_array<'r>(rows: impl Iterator<Item = Option<&'r Self>>, _: bool) -> ArrayRef {
        let item = Field::new("item", DataType::Float64, false);
        let mut list = ListBuilder::new(Float64Builder::new()).with_field(item);
        for numbers in rows {
            list.values().append_slice(numbers.map_or(&[], |numbers| numbers));
            list.append(numbers.is_some());
        }
        Arc::new(list.finish())
    }
}

impl<const N: usize> ReadValue for [f64; N] {
    fn read(columns: &Columns, column: &Column) -> Result<Vec<Self>, TableError> {
        let rows = Self::read_optional(columns, column)?.into_iter().enumerate();
        rows.map(|(row, numbers)| {
            numbers.ok_or_else(|| columns.value_error(row, column, &format!("null; expected {N} numbers")))
        })
        .collect()
    }

    fn read_optional(columns: &Columns, column: &Column) -> Result<Vec<Option<Self>>, TableError> {
        let rows = columns.optional_lists(column)?.into_iter().enumerate();
        let each = |(row, numbers): (usize, Option<Vec<f64>>)| {
            let sized = |numbers: Vec<f64>| {
                let wrong = |numbers: Vec<f64>| {
                    columns.value_error(row, column, &format!("{} numbers; expected {N}", numbers.len()))
                };
                <[f64; N]>::try_from(numbers).map_err(wrong)
            };
            numbers.map(sized).transpose()
        };
        rows.map(each).collect()
    }
}
