//! A narrow table as text: aligned for reading, CSV, JSON.

use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, Int32Type, Int64Type};
use arrow_array::{Array, ArrayRef, RecordBatch};
use arrow_schema::DataType;
use serde_json::Value;

/// Aligned columns under their names: numbers to the right with four significant digits, "-" where there is none.
pub fn aligned(batch: &RecordBatch) -> String {
    let schema = batch.schema();
    let columns = schema.fields().iter().zip(batch.columns()).map(|(field, array)| {
        let cells: Vec<String> = std::iter::once(field.name().clone()).chain(cells(array)).collect();
        let width = cells.iter().map(|cell| cell.chars().count()).max().unwrap_or(0);
        let to_the_right = field.data_type() != &DataType::Utf8;
        let pad =
            |cell: &String| if to_the_right { format!("{cell:>width$}") } else { format!("{cell:width$}") };
        cells.iter().map(pad).collect::<Vec<String>>()
    });
    let columns: Vec<Vec<String>> = columns.collect();
    let line = |row: usize| {
        let cells = columns.iter().map(|column| column[row].as_str()).collect::<Vec<_>>();
        format!("{}\n", cells.join("  ").trim_end())
    };
    (0..=batch.num_rows()).map(line).collect()
}

/// The cells of a column as [`aligned`] shows them.
pub fn cells(array: &ArrayRef) -> impl Iterator<Item = String> {
    (0..array.len()).map(|row| match cell(array, row) {
        Cell::Nothing => "-".to_string(),
        Cell::Text(text) => text.to_string(),
        Cell::Number(number) => short(number),
        Cell::Count(count) => count.to_string(),
    })
}

/// Comma-separated values, names in the first line, numbers in full, nothing where there is none.
///
/// # Errors
/// If memory runs out.
pub fn csv(batch: &RecordBatch) -> anyhow::Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(batch.schema().fields().iter().map(|field| field.name().as_str()))?;
    for row in 0..batch.num_rows() {
        writer.write_record(batch.columns().iter().map(|array| match cell(array, row) {
            Cell::Nothing => String::new(),
            Cell::Text(text) => text.to_string(),
            Cell::Number(number) => number.to_string(),
            Cell::Count(count) => count.to_string(),
        }))?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

/// A list of objects, one a row; null where there is no value.
pub fn json(batch: &RecordBatch) -> String {
    let schema = batch.schema();
    let object = |row: usize| {
        let pairs = schema.fields().iter().zip(batch.columns()).map(|(field, array)| {
            let value = match cell(array, row) {
                Cell::Nothing => Value::Null,
                Cell::Text(text) => Value::from(text),
                Cell::Number(number) => Value::from(number),
                Cell::Count(count) => Value::from(count),
            };
            format!("{}: {value}", Value::from(field.name().as_str()))
        });
        format!("  {{ {} }}", pairs.collect::<Vec<_>>().join(", "))
    };
    let objects = (0..batch.num_rows()).map(object).collect::<Vec<_>>();
    format!("[\n{}\n]\n", objects.join(",\n"))
}

enum Cell<'a> {
    Nothing,
    Text(&'a str),
    Number(f64),
    Count(i64),
}

/// A cell of a column of text, of 64-bit numbers or of counts; all other types are no part of narrow tables for reading.
fn cell(array: &ArrayRef, row: usize) -> Cell<'_> {
    if array.is_null(row) {
        return Cell::Nothing;
    }
    if let Some(text) = array.as_string_opt::<i32>() {
        Cell::Text(text.value(row))
    } else if let Some(numbers) = array.as_primitive_opt::<Float64Type>() {
        Cell::Number(numbers.value(row))
    } else if let Some(counts) = array.as_primitive_opt::<Int64Type>() {
        Cell::Count(counts.value(row))
    } else if let Some(counts) = array.as_primitive_opt::<Int32Type>() {
        Cell::Count(i64::from(counts.value(row)))
    } else {
        Cell::Nothing
    }
}

/// With four significant digits.
fn short(number: f64) -> String {
    if number == 0.0 {
        return "0".to_string();
    }
    match number.abs().log10().floor() as i32 {
        magnitude @ -4..5 => format!("{number:.*}", (3 - magnitude).max(0) as usize),
        _ => format!("{number:.3e}"),
    }
}
