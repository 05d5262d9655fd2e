//! The own columns of the list of the objects: texts behind the columns of answers.

use std::borrow::Cow;
use std::path::Path;
use std::sync::Arc;

use arrow_array::{ArrayRef, RecordBatch, StringArray};
use arrow_schema::DataType;

use super::{Answer, CurveRow};
use crate::table::TableError;
use crate::table::file::ParquetTable;
use crate::table::rows;

/// What a list says of an object in words of its own: headings and cells.
pub type Labels = Vec<(String, String)>;

/// The columns of labels; none without any. A heading that answers have too gets ` (list)` behind it.
pub fn columns<'a>(answers: impl Iterator<Item = &'a Answer>) -> anyhow::Result<Option<RecordBatch>> {
    let all: Vec<&Labels> = answers.map(|answer| &answer.labels).collect();
    let Some(headings) = all.iter().find(|labels| !labels.is_empty()) else { return Ok(None) };
    let mut columns: Vec<(String, ArrayRef, bool)> = Vec::new();
    for (at, (heading, _)) in headings.iter().enumerate() {
        let mut name = heading.clone();
        while is_of_answers(&name) || columns.iter().any(|(other, ..)| *other == name) {
            name = format!("{name} (list)").trim().to_string();
        }
        let cells =
            all.iter().map(|labels| labels.get(at).map(|(_, cell)| cell).filter(|cell| !cell.is_empty()));
        columns.push((name, Arc::new(StringArray::from_iter(cells)), true));
    }
    Ok(Some(RecordBatch::try_from_iter_with_nullable(columns)?))
}

/// The labels of each row of a file of answers: its texts that are of no answer.
pub fn read(path: &Path) -> Result<Vec<Labels>, TableError> {
    let table = ParquetTable::open(path)?;
    let texts = table.schema().fields().iter().filter(|field| *field.data_type() == DataType::Utf8);
    let names: Vec<&String> = texts.map(|field| field.name()).filter(|name| !is_of_answers(name)).collect();
    let mut all = Vec::new();
    for batch in table.batches(|column| names.iter().any(|name| *name == column)) {
        let batch = batch?;
        let cells = names.iter().map(|name| batch.texts(name)).collect::<Result<Vec<_>, _>>()?;
        all.extend((0..batch.rows.num_rows()).map(|row| {
            let label = |(name, cells): (&&String, &Vec<Option<Cow<str>>>)| {
                (name.to_string(), cells[row].as_deref().unwrap_or_default().to_string())
            };
            names.iter().zip(&cells).map(label).collect()
        }));
    }
    Ok(all)
}

fn is_of_answers(name: &str) -> bool {
    let schemas = [rows::schema::<Answer>(), rows::schema::<CurveRow>()];
    name.is_empty() || schemas.iter().any(|schema| schema.index_of(name).is_ok())
}
