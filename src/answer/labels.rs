//! The own columns of the list of the objects: texts behind the columns of answers.

use std::sync::Arc;

use arrow_array::{ArrayRef, RecordBatch, StringArray};
use arrow_schema::DataType;

use super::{Answer, CurveRow};
use crate::table::columns::Batch;
use crate::table::{TableError, rows};

/// What a list says of an object in words of its own: headings and cells.
pub type Labels = Vec<(String, String)>;

/// The columns of labels; none without any. A heading that answers have too gets ` (list)` behind it.
pub fn columns(answers: &[&Answer]) -> anyhow::Result<Option<RecordBatch>> {
    let all: Vec<&Labels> = answers.iter().map(|answer| &answer.labels).collect();
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

/// The labels of each row of a batch of answers: its texts that are of no answer.
pub fn read(batch: &Batch) -> Result<Vec<Labels>, TableError> {
    let schema = batch.rows.schema();
    let fields = schema.fields().iter().filter(|field| *field.data_type() == DataType::Utf8);
    let mut all = vec![Labels::new(); batch.rows.num_rows()];
    for name in fields.map(|field| field.name()).filter(|name| !is_of_answers(name)) {
        let cells = batch.texts(name)?.into_iter().map(|cell| cell.unwrap_or_default().into_owned());
        all.iter_mut().zip(cells).for_each(|(labels, cell)| labels.push((name.clone(), cell)));
    }
    Ok(all)
}

fn is_of_answers(name: &str) -> bool {
    let schemas = [rows::schema::<Answer>(), rows::schema::<CurveRow>()];
    name.is_empty() || schemas.iter().any(|schema| schema.index_of(name).is_ok())
}
