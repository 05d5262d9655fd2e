//! inspect: what a file holds and where it came from.

use std::path::Path;

use arrow_schema::DataType;

use crate::pipeline::terminal::{Terminal, Weight};
use crate::table::store::contents::footer;
use crate::table::store::contents::recorded;
use crate::table::store::footer::Footer;
use crate::table::store::provenance::Recorded;

/// A description of a Parquet file, ours or another's, as wide as the terminal.
///
/// # Errors
/// If it is missing or no Parquet file.
pub fn inspect(path: &Path, terminal: &Terminal) -> anyhow::Result<String> {
    let recorded = recorded(path)?;
    let footer = footer(path)?;
    let mut text = terminal.line(&path.display().to_string(), Weight::Strong);
    let megabytes = footer.bytes as f64 / 1e6;
    let size = format!("  {} rows in {} row groups, {megabytes:.1} MB", footer.rows, footer.row_groups);
    text += &terminal.line(&size, Weight::Plain);
    match &recorded {
        Some(recorded) => text += &made(recorded, terminal),
        None => text += &terminal.line("  not written by rockfrag", Weight::Plain),
    }
    text.push('\n');
    let rows = std::iter::once(NAMES.map(str::to_string)).chain(rows(&footer)).collect::<Vec<_>>();
    let widths: [usize; NAMES.len()] =
        std::array::from_fn(|column| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0));
    let [name_width, type_width, nulls_width, least_width, largest_width, _] = widths;
    for (index, [name, kind, nulls, least, largest, description]) in rows.iter().enumerate() {
        let line = format!(
            "  {name:name_width$}  {kind:type_width$}  {nulls:>nulls_width$}  {least:>least_width$}  {largest:>largest_width$}  {description}"
        );
        text += &terminal.line(line.trim_end(), if index == 0 { Weight::Strong } else { Weight::Plain });
    }
    Ok(text)
}

/// The cells of a line about a column.
type Row = [String; 6];

/// Their names.
const NAMES: [&str; 6] = ["column", "type", "nulls", "least", "largest", "description"];

fn rows(footer: &Footer) -> impl Iterator<Item = Row> {
    footer.schema.fields().iter().map(|field| {
        let range = footer.ranges.get(field.name()).cloned().unwrap_or_default();
        let metadata = |key: &str| field.metadata().get(key).cloned().unwrap_or_default();
        let unit = match metadata("unit").as_str() {
            "" | "1" => String::new(),
            unit => format!(" [{unit}]"),
        };
        // Adding 0 turns -0 into 0.
        let number = |value: Option<f64>| value.map_or(String::new(), |value| format!("{:.5}", value + 0.0));
        [
            field.name().clone(),
            type_words(field.data_type()),
            range.nulls.to_string(),
            number(range.least),
            number(range.largest),
            format!("{}{unit}", metadata("description")),
        ]
    })
}

/// What made a file.
fn made(Recorded { provenance, content, .. }: &Recorded, terminal: &Terminal) -> String {
    let mut pairs = vec![("content".to_string(), content.clone())];
    pairs.extend(provenance.inputs.iter().map(|(role, content)| (format!("from {role}"), content.clone())));
    if let serde_json::Value::Object(parameters) = &provenance.parameters {
        pairs.extend(parameters.iter().map(|(name, value)| (format!("{name}:"), value.to_string())));
    }
    let by = format!("  made by {}, rockfrag {}", provenance.stage, provenance.version);
    let lines = pairs.iter().map(|(name, value)| terminal.line(&format!("  {name} {value}"), Weight::Faint));
    let warnings = provenance.warnings.all();
    let warnings =
        warnings.iter().map(|warning| terminal.line(&format!("  warning: {warning}"), Weight::Plain));
    std::iter::once(terminal.line(&by, Weight::Plain)).chain(lines).chain(warnings).collect()
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
