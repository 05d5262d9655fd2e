//! Narrow tables as polars frames, and their text, CSV and JSON.

use arrow_array::cast::AsArray;
use arrow_array::{Array, ArrayRef, RecordBatch};
use polars::prelude::{AnyValue, Column, DataFrame, DataType, GroupsIndicator, PolarsError};
use rockfrag_core::fragility::Group;
use rockfrag_core::spelling::unknown_word;
use serde_json::Value;

use super::columns::{integers, numbers};
use super::file::{NARROW_BATCH, ParquetTable};
use crate::number::{aligned, fixed, significant};

/// Format of a printed table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<Format>)]
pub enum Format {
    Text,
    Csv,
    Json,
}

/// Reads the first rows of a table, at most this many; a list is shown by its length.
pub fn read(table: &ParquetTable, most: usize) -> anyhow::Result<DataFrame> {
    let mut whole = DataFrame::default();
    for group in table.row_groups() {
        for batch in table.read(&group, &|_| true, most.clamp(1, NARROW_BATCH)) {
            let rows = batch?.rows;
            let some = from_batch(&rows.slice(0, rows.num_rows().min(most - whole.height())))?;
            whole = if whole.width() == 0 { some } else { whole.vstack(&some)? };
            if whole.height() == most {
                return Ok(whole);
            }
        }
    }
    Ok(whole)
}

pub fn from_batch(rows: &RecordBatch) -> Result<DataFrame, PolarsError> {
    let schema = rows.schema();
    let columns =
        schema.fields().iter().zip(rows.columns()).map(|(field, array)| column(field.name(), array));
    DataFrame::new(rows.num_rows(), columns.collect())
}

/// The rows of each suite and structure, in the order in which these first come.
pub fn groups<'a>(rows: impl Iterator<Item = Group<'a>>) -> Result<Vec<Vec<usize>>, PolarsError> {
    let (suites, structures): (Vec<_>, Vec<_>) = rows.map(|group| (group.suite, group.structure)).unzip();
    let height = structures.len();
    let keys = vec![Column::new("suite".into(), suites), Column::new("structure".into(), structures)];
    // On this thread: the pool of polars does not know --threads.
    let frame = DataFrame::new(height, keys)?;
    let groups = frame.group_by_with_series(frame.columns().to_vec(), false, true)?;
    let rows = groups.get_groups().iter().map(|group| match group {
        GroupsIndicator::Idx((_, rows)) => rows.iter().map(|&row| row as usize).collect(),
        GroupsIndicator::Slice([first, count]) => (first as usize..(first + count) as usize).collect(),
    });
    Ok(rows.collect())
}

fn column(name: &str, array: &ArrayRef) -> Column {
    let name = name.into();
    if let Some(texts) = array.as_string_opt::<i32>() {
        Column::new(name, texts.iter().collect::<Vec<_>>())
    } else if let Some(flags) = array.as_boolean_opt() {
        Column::new(name, flags.iter().collect::<Vec<_>>())
    } else if let Some(whole) = integers(array) {
        match whole.iter().map(|value| value.map(i64::try_from).transpose()).collect::<Result<Vec<_>, _>>() {
            Ok(counts) => Column::new(name, counts),
            // Names such as hashes.
            Err(_) => Column::new(
                name,
                whole.iter().map(|value| Some(value.as_ref()?.to_string())).collect::<Vec<_>>(),
            ),
        }
    } else if let Some(values) = numbers(array) {
        Column::new(name, values)
    } else {
        let lists = array.as_list_opt::<i32>();
        let lengths = (0..array.len()).map(|row| Some(format!("{} numbers", lists?.value_length(row))));
        Column::new(name, lengths.collect::<Vec<_>>())
    }
}

/// Formats a frame as text with aligned columns, as CSV, or as a list of JSON objects: numbers in full but in
/// text, null as an empty cell.
pub fn show(frame: &DataFrame, format: Format) -> anyhow::Result<String> {
    let names = frame.get_column_names();
    match format {
        Format::Text => Ok(text(frame)),
        Format::Csv => {
            let mut writer = csv::Writer::from_writer(Vec::new());
            writer.write_record(names.iter().map(|name| name.as_str()))?;
            for row in rows(frame) {
                writer.write_record(row.iter().map(|value| cell(value, "")))?;
            }
            Ok(String::from_utf8(writer.into_inner()?)?)
        }
        Format::Json => {
            let names = names.iter().map(|name| name.to_string());
            let objects = rows(frame).map(|row| names.clone().zip(row).collect::<Value>());
            Ok(serde_json::to_string_pretty(&objects.collect::<Vec<_>>())? + "\n")
        }
    }
}

fn rows(frame: &DataFrame) -> impl Iterator<Item = Vec<Value>> {
    let value = |column: &Column, row| match column.get(row) {
        Ok(AnyValue::Float64(number)) => Value::from(number),
        Ok(AnyValue::Int64(count)) => Value::from(count),
        Ok(AnyValue::Boolean(flag)) => Value::from(flag),
        Ok(AnyValue::String(text)) => Value::from(text),
        _ => Value::Null,
    };
    (0..frame.height()).map(move |row| frame.columns().iter().map(|column| value(column, row)).collect())
}

fn cell(value: &Value, null: &str) -> String {
    match value {
        Value::Null => null.to_string(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}

/// Formats a frame as text: numbers right-aligned with four significant digits, "-" for null.
pub fn text(frame: &DataFrame) -> String {
    let names = frame.get_column_names().into_iter().map(|name| name.to_string());
    let lines = rows(frame).map(|row| {
        let cells = row.iter().map(|value| match (value.as_i64(), value.as_f64()) {
            (Some(count), _) => fixed(count as f64, 0),
            (None, Some(number)) => significant(number, 4),
            _ => cell(value, "-"),
        });
        cells.collect()
    });
    let lines: Vec<Vec<String>> = std::iter::once(names.collect()).chain(lines).collect();
    aligned(&lines, |column| frame.columns()[column].dtype() != &DataType::String)
}
