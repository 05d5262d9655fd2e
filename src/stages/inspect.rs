//! inspect: what a file holds and where it came from.

use std::fmt::Write;
use std::path::Path;

use arrow_schema::DataType;

use crate::table::footer::footer;
use crate::table::provenance::{Stamp, stamp};

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
        "\n  {:18} {:14} {:>8} {:>12} {:>12}  description",
        "column", "type", "nulls", "least", "largest"
    )?;
    for field in footer.schema.fields() {
        let range = footer.ranges.get(field.name()).cloned().unwrap_or_default();
        let metadata = |key: &str| field.metadata().get(key).cloned().unwrap_or_default();
        let unit = match metadata("unit").as_str() {
            "" | "1" => String::new(),
            unit => format!(" [{unit}]"),
        };
        let number = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:.5}"));
        writeln!(
            text,
            "  {:18} {:14} {:>8} {:>12} {:>12}  {}{unit}",
            field.name(),
            type_words(field.data_type()),
            range.nulls,
            number(range.least),
            number(range.largest),
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
