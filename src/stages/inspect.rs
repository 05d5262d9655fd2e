//! inspect: what a file holds and where it came from.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::{Array, ArrayRef, RecordBatch, StringArray};
use arrow_schema::{DataType, Field, FieldRef};
use polars::prelude::{Column, DataFrame};
use serde_json::{Value, json};

use crate::pipeline::terminal::{Terminal, Weight};
use crate::table::store::columns::spelt_out;
use crate::table::store::contents::footer;
use crate::table::store::contents::recorded;
use crate::table::store::footer::Footer;
use crate::table::store::frame::{frame_of, stacked};
use crate::table::store::provenance::Recorded;
use crate::table::store::reader::read_first;
use crate::table::store::text;

/// What is shown of a file.
pub struct Inspected {
    path: PathBuf,
    recorded: Option<Recorded>,
    shown: Shown,
}

enum Shown {
    Columns(Footer),
    Rows { rows: DataFrame, units: Vec<String> },
}

/// Reads what a Parquet file, ours or another's, says of its columns, or its first rows.
///
/// # Errors
/// If it is missing or no Parquet file.
pub fn inspect(path: &Path, head: Option<usize>) -> anyhow::Result<Inspected> {
    let recorded = recorded(path)?;
    let footer = footer(path)?;
    let shown = match head {
        None => Shown::Columns(footer),
        Some(rows) => {
            let rows = first_rows(path, rows)?;
            let unit = |column: &Column| {
                let field = footer.schema.field_with_name(column.name()).ok();
                field.map_or(String::new(), |field| unit(field).to_string())
            };
            Shown::Rows { units: rows.columns().iter().map(unit).collect(), rows }
        }
    };
    Ok(Inspected { path: path.to_path_buf(), recorded, shown })
}

impl Inspected {
    /// For a reader, as wide as the terminal.
    pub fn text(&self, terminal: &Terminal) -> String {
        match &self.shown {
            Shown::Columns(footer) => self.columns(footer, terminal),
            Shown::Rows { rows, units } => terminal.table(&text::aligned_with_units(rows, units)),
        }
    }

    /// For a program: warnings and rows, and of the columns what made the file.
    pub fn json(&self) -> String {
        let provenance = self.recorded.as_ref().map(|recorded| &recorded.provenance);
        let warnings = provenance.map_or(Vec::new(), |provenance| provenance.warnings.all());
        let footer = match &self.shown {
            Shown::Columns(footer) => footer,
            Shown::Rows { rows, .. } => return text::json_with_warnings(&warnings, rows),
        };
        let column = |field: &FieldRef| {
            let range = footer.ranges.get(field.name()).cloned().unwrap_or_default();
            json!({
                "column": field.name(), "type": type_words(field.data_type()), "unit": unit(field),
                "nulls": range.nulls, "least": range.least, "largest": range.largest,
                "description": field.metadata().get("description")
            })
        };
        let rows: Vec<Value> = footer.schema.fields().iter().map(column).collect();
        let file = json!({
            "path": self.path.display().to_string(), "rows": footer.rows, "row_groups": footer.row_groups,
            "bytes": footer.bytes, "made_by": provenance.map(|made| &made.stage),
            "version": provenance.map(|made| &made.version), "inputs": provenance.map(|made| &made.inputs),
            "parameters": provenance.map(|made| &made.parameters),
            "content": self.recorded.as_ref().map(|recorded| &recorded.content)
        });
        format!("{:#}\n", json!({ "file": file, "warnings": warnings, "rows": rows }))
    }

    fn columns(&self, footer: &Footer, terminal: &Terminal) -> String {
        let mut text = terminal.line(&self.path.display().to_string(), Weight::Strong);
        let megabytes = footer.bytes as f64 / 1e6;
        let size = format!("  {} rows in {} row groups, {megabytes:.1} MB", footer.rows, footer.row_groups);
        text += &terminal.line(&size, Weight::Plain);
        match &self.recorded {
            Some(recorded) => text += &made(recorded, terminal),
            None => text += &terminal.line("  not written by rockfrag", Weight::Plain),
        }
        text.push('\n');
        let rows = std::iter::once(NAMES.map(str::to_string)).chain(rows(footer)).collect::<Vec<_>>();
        let widths: [usize; NAMES.len()] = std::array::from_fn(|column| {
            rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0)
        });
        let [name_width, type_width, nulls_width, least_width, largest_width, _] = widths;
        for (index, [name, kind, nulls, least, largest, description]) in rows.iter().enumerate() {
            let line = format!(
                "  {name:name_width$}  {kind:type_width$}  {nulls:>nulls_width$}  {least:>least_width$}  {largest:>largest_width$}  {description}"
            );
            text += &terminal.line(line.trim_end(), if index == 0 { Weight::Strong } else { Weight::Plain });
        }
        text
    }
}

/// The first rows of a table, each list as the number of its samples.
fn first_rows(path: &Path, rows: usize) -> anyhow::Result<DataFrame> {
    let batches = read_first(path, rows)?;
    let frames = batches.iter().map(|batch| {
        let columns = batch.schema_ref().fields().iter().zip(batch.columns());
        let columns = columns.map(|(field, array)| (field.name(), readable(array)));
        Ok(frame_of(&RecordBatch::try_from_iter(columns)?)?)
    });
    Ok(stacked(frames.collect::<anyhow::Result<Vec<_>>>()?)?)
}

/// A column as a frame holds it.
fn readable(array: &ArrayRef) -> ArrayRef {
    let array = &spelt_out(array);
    let length = |length: usize| format!("{length} samples");
    if let Some(lists) = array.as_list_opt::<i32>() {
        return Arc::new(
            lists.iter().map(|list| list.map(|list| length(list.len()))).collect::<StringArray>(),
        );
    }
    if let Some(lists) = array.as_list_opt::<i64>() {
        return Arc::new(
            lists.iter().map(|list| list.map(|list| length(list.len()))).collect::<StringArray>(),
        );
    }
    if let Some(lists) = array.as_fixed_size_list_opt() {
        return Arc::new(
            lists.iter().map(|list| list.map(|list| length(list.len()))).collect::<StringArray>(),
        );
    }
    array.clone()
}

/// The unit of a column, nothing where it has none.
fn unit(field: &Field) -> &str {
    match field.metadata().get("unit").map_or("", String::as_str) {
        "1" => "",
        unit => unit,
    }
}

/// The cells of a line about a column.
type Row = [String; 6];

/// Their names.
const NAMES: [&str; 6] = ["column", "type", "nulls", "least", "largest", "description"];

fn rows(footer: &Footer) -> impl Iterator<Item = Row> {
    footer.schema.fields().iter().map(|field| {
        let range = footer.ranges.get(field.name()).cloned().unwrap_or_default();
        let metadata = |key: &str| field.metadata().get(key).cloned().unwrap_or_default();
        let unit = match unit(field) {
            "" => String::new(),
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
    if let Value::Object(parameters) = &provenance.parameters {
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
