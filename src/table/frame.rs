//! Tables as polars frames: their groups and joins, and their text, CSV and JSON.

use anyhow::Context as _;
use arrow_array::cast::AsArray;
use arrow_array::{Array, ArrayRef, RecordBatch};
use polars_core::prelude::{AnyValue, Column, DataFrame, DataType, GroupsType, PolarsResult};
use polars_io::prelude::{CsvWriter, JsonFormat, JsonWriter, SerWriter};
use polars_ops::prelude::{DataFrameJoinOps, JoinArgs, JoinType, MaintainOrderJoin};
use rockfrag_core::fragility::Group;
use rockfrag_core::spelling::unknown_word;

use super::columns::{integers, numbers, texts};
use super::file::ParquetTable;
use crate::number::{aligned, fixed, significant};
use crate::source::guarded;

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

/// Reads a table; a list is shown by its length.
pub fn read(table: &ParquetTable) -> anyhow::Result<DataFrame> {
    let mut whole = DataFrame::default();
    for batch in table.batches(|_| true) {
        whole.vstack_mut_owned(from_batch(&batch?.rows)?)?;
    }
    if whole.width() == 0 {
        whole = from_batch(&RecordBatch::new_empty(table.schema().clone()))?;
    }
    Ok(whole)
}

pub fn from_batch(rows: &RecordBatch) -> PolarsResult<DataFrame> {
    let schema = rows.schema();
    let columns =
        schema.fields().iter().zip(rows.columns()).map(|(field, array)| column(field.name(), array));
    DataFrame::new(rows.num_rows(), columns.collect())
}

/// The rows of each suite and structure, in the order in which these first come.
pub fn groups<'a>(rows: impl Iterator<Item = Group<'a>>) -> anyhow::Result<Vec<Vec<usize>>> {
    let (suites, structures): (Vec<_>, Vec<_>) = rows.map(|group| (group.suite, group.structure)).unzip();
    let height = structures.len();
    let keys = vec![Column::new("suite".into(), suites), Column::new("structure".into(), structures)];
    let frame = DataFrame::new(height, keys)?;
    let keys = frame.columns().to_vec();
    let grouped = with_threads(|| frame.group_by_with_series(keys, false, true))?;
    let groups = GroupsType::clone(grouped.get_groups()).into_idx();
    Ok(groups.all().iter().map(|rows| rows.iter().map(|&row| row as usize).collect()).collect())
}

/// The rows of a frame in their order, with those of the other that have the same in a column.
pub fn left_join(rows: &DataFrame, other: &DataFrame, on: &str) -> anyhow::Result<DataFrame> {
    let how = JoinArgs { maintain_order: MaintainOrderJoin::Left, ..JoinArgs::new(JoinType::Left) };
    with_threads(|| rows.join(other, [on], [on], how, None))
}

/// Calls polars, which has threads of its own, and panics if one of them cannot start.
fn with_threads<T>(call: impl FnOnce() -> PolarsResult<T>) -> anyhow::Result<T> {
    Ok(guarded(call).context("a thread cannot start")??)
}

fn column(name: &str, array: &ArrayRef) -> Column {
    let name = name.into();
    let count = |value: &Option<i128>| value.map(i64::try_from).transpose().ok();
    let counts = |whole: Vec<Option<i128>>| whole.iter().map(count).collect::<Option<Vec<_>>>();
    if let Some(flags) = array.as_boolean_opt() {
        Column::new(name, flags.iter().collect::<Vec<_>>())
    } else if let Some(counts) = integers(array).and_then(counts) {
        Column::new(name, counts)
    } else if let Some(texts) = texts(array) {
        // Names, or integers as large as hashes.
        Column::new(name, texts)
    } else if let Some(values) = numbers(array) {
        let finite = values.into_iter().map(|value| value.filter(|value| value.is_finite()));
        Column::new(name, finite.collect::<Vec<_>>())
    } else {
        let lists = array.as_list_opt::<i32>();
        let lengths = (0..array.len()).map(|row| Some(format!("{} numbers", lists?.value_length(row))));
        Column::new(name, lengths.collect::<Vec<_>>())
    }
}

/// Formats a frame as text with aligned columns, as CSV, or as a list of JSON objects: numbers in full but in
/// text, null as an empty cell.
pub fn show(frame: &DataFrame, format: Format) -> anyhow::Result<String> {
    let (mut frame, mut shown) = (frame.clone(), Vec::new());
    with_threads(|| match format {
        Format::Text => {
            shown = text(&frame).into_bytes();
            Ok(())
        }
        Format::Csv => CsvWriter::new(&mut shown).finish(&mut frame),
        Format::Json => JsonWriter::new(&mut shown).with_json_format(JsonFormat::Json).finish(&mut frame),
    })?;
    let end = if format == Format::Json { "\n" } else { "" };
    Ok(String::from_utf8(shown)? + end)
}

/// Formats a frame as text: numbers right-aligned with four significant digits, "-" for null.
pub fn text(frame: &DataFrame) -> String {
    let lines = cells(frame, |value| match value {
        AnyValue::Int64(count) => fixed(count as f64, 0),
        AnyValue::Float64(number) => significant(number, 4),
        AnyValue::Null => "-".to_string(),
        other => other.str_value().into_owned(),
    });
    aligned(&lines, |column| frame.columns()[column].dtype() != &DataType::String)
}

/// The names of columns, and the rows below them.
pub fn cells(frame: &DataFrame, cell: impl Fn(AnyValue) -> String) -> Vec<Vec<String>> {
    let names = frame.columns().iter().map(|column| column.name().to_string()).collect();
    let rows = (0..frame.height()).flat_map(|row| frame.get_row(row));
    std::iter::once(names).chain(rows.map(|row| row.0.into_iter().map(&cell).collect())).collect()
}
