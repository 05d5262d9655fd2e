//! inspect: what a file holds and where it came from.

use std::fmt::Write;
use std::path::Path;

use arrow_schema::{DataType, Field};

use crate::table::columns::Columns;
use crate::table::provenance::{Stamp, stamp};
use crate::table::reader::{Batch, Batches, footer};
use crate::table::schema::{Column, Kind};

/// Rows that are read at once.
const BATCH: usize = 8192;

/// A description of a Parquet file, ours or another's.
///
/// # Errors
/// If it is missing or no Parquet file.
pub fn inspect(path: &Path) -> anyhow::Result<String> {
    let stamp = stamp(path)?;
    let footer = footer(path)?;
    let mut text = String::new();
    writeln!(text, "{}", path.display())?;
    writeln!(
        text,
        "  {} rows in {} row groups, {:.1} MB",
        footer.rows,
        footer.row_groups,
        footer.bytes as f64 / 1e6
    )?;
    match &stamp {
        Some(stamp) => write_stamp(&mut text, stamp)?,
        None => writeln!(text, "  not written by rockfrag")?,
    }
    writeln!(
        text,
        "\n  {:18} {:14} {:>7} {:>12} {:>12} {:>12}  description",
        "column", "type", "nulls", "least", "mean", "largest"
    )?;
    for field in footer.schema.fields() {
        let summary =
            if footer.rows > 0 { summary(path, field, stamp.as_ref())? } else { Summary::default() };
        let metadata = |key: &str| field.metadata().get(key).cloned().unwrap_or_default();
        let unit = match metadata("unit").as_str() {
            "" | "1" => String::new(),
            unit => format!(" [{unit}]"),
        };
        let number = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:.5}"));
        writeln!(
            text,
            "  {:18} {:14} {:>7} {:>12} {:>12} {:>12}  {}{unit}",
            field.name(),
            type_words(field.data_type()),
            summary.nulls.map_or(String::new(), |nulls| nulls.to_string()),
            number(summary.least),
            number(summary.mean),
            number(summary.largest),
            metadata("description"),
        )?;
    }
    Ok(text)
}

fn write_stamp(text: &mut String, stamp: &Stamp) -> std::fmt::Result {
    let Stamp { provenance, content, .. } = stamp;
    writeln!(text, "  made by {}, rockfrag {}", provenance.stage, provenance.version)?;
    writeln!(text, "  content {content}")?;
    for (role, content) in &provenance.inputs {
        writeln!(text, "  from {role} {content}")?;
    }
    if let serde_json::Value::Object(parameters) = &provenance.parameters {
        for (name, value) in parameters {
            writeln!(text, "  {name}: {value}")?;
        }
    }
    Ok(())
}

#[derive(Default)]
struct Summary {
    nulls: Option<usize>,
    least: Option<f64>,
    mean: Option<f64>,
    largest: Option<f64>,
}

/// The range of a column of floating-point numbers; nothing of others.
fn summary(path: &Path, field: &Field, stamp: Option<&Stamp>) -> anyhow::Result<Summary> {
    if !matches!(field.data_type(), DataType::Float32 | DataType::Float64) {
        return Ok(Summary::default());
    }
    let name: &'static str = field.name().clone().leak();
    let column = Column { name, kind: Kind::Float64, nullable: true, unit: "1", description: "" };
    let stages: Vec<&str> = stamp.iter().map(|stamp| stamp.provenance.stage.as_str()).collect();
    let mut values: Vec<f64> = Vec::new();
    let mut nulls = 0;
    for batch in Batches::open(path, &stages, &[column], BATCH)? {
        let Batch { rows, first_row } = batch?;
        let numbers = Columns::new(path, &rows, first_row).optional_numbers(&column)?;
        nulls += numbers.iter().filter(|number| number.is_none()).count();
        values.extend(numbers.into_iter().flatten());
    }
    let some = |value: f64| (!values.is_empty()).then_some(value);
    Ok(Summary {
        nulls: Some(nulls),
        least: some(values.iter().copied().fold(f64::INFINITY, f64::min)),
        mean: some(values.iter().sum::<f64>() / values.len() as f64),
        largest: some(values.iter().copied().fold(f64::NEG_INFINITY, f64::max)),
    })
}

fn type_words(data_type: &DataType) -> String {
    match data_type {
        DataType::Int64 => "i64".to_string(),
        DataType::Int32 => "i32".to_string(),
        DataType::Float64 => "f64".to_string(),
        DataType::Float32 => "f32".to_string(),
        DataType::Utf8 | DataType::LargeUtf8 | DataType::Utf8View => "str".to_string(),
        DataType::List(item) | DataType::LargeList(item) | DataType::FixedSizeList(item, _) => {
            format!("list<{}>", type_words(item.data_type()))
        }
        other => other.to_string(),
    }
}
