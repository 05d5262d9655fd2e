//! A narrow table as text: aligned for reading, CSV, JSON.

use polars::prelude::{AnyValue, Column, DataFrame, DataType};
use serde_json::Value;

/// Aligned columns under their names: numbers to the right with four significant digits, "-" where there is none.
pub fn aligned(frame: &DataFrame) -> String {
    let names = frame.columns().iter().map(|column| vec![column.name().to_string()]);
    aligned_under(frame, names)
}

/// The same with a line of units under the names.
pub fn aligned_with_units(frame: &DataFrame, units: &[String]) -> String {
    let head = |(column, unit): (&Column, &String)| vec![column.name().to_string(), unit.clone()];
    aligned_under(frame, frame.columns().iter().zip(units).map(head))
}

fn aligned_under(frame: &DataFrame, heads: impl Iterator<Item = Vec<String>>) -> String {
    let columns = frame.columns().iter().zip(heads).map(|(column, head)| {
        let cells: Vec<String> = head.into_iter().chain(cells(column)).collect();
        let width = cells.iter().map(|cell| cell.chars().count()).max().unwrap_or(0);
        let to_the_right = column.dtype() != &DataType::String;
        let pad = |cell: &String| {
            let spaces = " ".repeat(width - cell.chars().count());
            if to_the_right { spaces + cell } else { cell.clone() + &spaces }
        };
        cells.iter().map(pad).collect::<Vec<String>>()
    });
    let columns: Vec<Vec<String>> = columns.collect();
    let line = |row: usize| {
        let cells = columns.iter().map(|column| column[row].as_str()).collect::<Vec<_>>();
        format!("{}\n", cells.join("  ").trim_end())
    };
    (0..columns.first().map_or(0, Vec::len)).map(line).collect()
}

/// The cells of a column as [`aligned`] shows them.
pub fn cells(column: &Column) -> impl Iterator<Item = String> {
    values(column).map(|value| match value {
        AnyValue::String(text) => text.to_string(),
        // In a frame of one row.
        AnyValue::StringOwned(text) => text.to_string(),
        AnyValue::Float64(number) => short(number),
        AnyValue::Int64(count) => count.to_string(),
        AnyValue::Int32(count) => count.to_string(),
        _ => "-".to_string(),
    })
}

/// Comma-separated values, names in the first line, numbers in full, nothing where there is none.
///
/// # Errors
/// If memory runs out.
pub fn csv(frame: &DataFrame) -> anyhow::Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(frame.columns().iter().map(|column| column.name().as_str()))?;
    for row in rows(frame) {
        writer.write_record(row.map(|value| match value {
            AnyValue::String(text) => text.to_string(),
            AnyValue::StringOwned(text) => text.to_string(),
            AnyValue::Float64(number) => number.to_string(),
            AnyValue::Int64(count) => count.to_string(),
            AnyValue::Int32(count) => count.to_string(),
            _ => String::new(),
        }))?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

/// A list of objects, one a row; null where there is no value.
pub fn json(frame: &DataFrame) -> String {
    let object = |row: Vec<AnyValue>| {
        let pairs = frame.columns().iter().zip(row).map(|(column, value)| {
            let value = match value {
                AnyValue::String(text) => Value::from(text),
                AnyValue::StringOwned(text) => Value::from(text.as_str()),
                AnyValue::Float64(number) => Value::from(number),
                AnyValue::Int64(count) => Value::from(count),
                AnyValue::Int32(count) => Value::from(count),
                _ => Value::Null,
            };
            format!("{}: {value}", Value::from(column.name().as_str()))
        });
        format!("  {{ {} }}", pairs.collect::<Vec<_>>().join(", "))
    };
    let objects = rows(frame).map(|row| object(row.collect())).collect::<Vec<_>>();
    if objects.is_empty() { "[]\n".to_string() } else { format!("[\n{}\n]\n", objects.join(",\n")) }
}

/// How [`json_with_warnings`] begins.
pub const JSON: &str = "{\n\"warnings\": ";

/// The same beside the warnings that a reader must know: `{ "warnings": [...], "rows": [...] }`.
pub fn json_with_warnings(warnings: &[String], frame: &DataFrame) -> String {
    format!("{JSON}{},\n\"rows\": {}}}\n", serde_json::json!(warnings), json(frame))
}

fn values(column: &Column) -> impl Iterator<Item = AnyValue<'_>> {
    (0..column.len()).map(|row| column.get(row).unwrap_or(AnyValue::Null))
}

fn rows(frame: &DataFrame) -> impl Iterator<Item = impl Iterator<Item = AnyValue<'_>>> {
    let at = move |row| frame.columns().iter().map(move |column| column.get(row).unwrap_or(AnyValue::Null));
    (0..frame.height()).map(at)
}

/// With four significant digits.
fn short(number: f64) -> String {
    if number == 0.0 {
        return "0".to_string();
    }
    match libm::log10(number.abs()).floor() as i32 {
        magnitude @ -4..5 => format!("{number:.*}", (3 - magnitude).max(0) as usize),
        _ => format!("{number:.3e}"),
    }
}
