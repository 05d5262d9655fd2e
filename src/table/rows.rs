//! Structs as rows of a table: the struct is the schema, the dictionary has unit and meaning.

use std::path::Path;
use std::sync::Arc;

use arrow_array::RecordBatch;
use arrow_schema::{DataType, Field, FieldRef, Schema, SchemaRef};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_arrow::schema::{SchemaLike, TracingOptions};

use super::TableError;
use super::dictionary;
use super::file::Table;

/// A struct of numbers, texts, options of them and lists; each field is a column.
pub trait Row: Serialize + DeserializeOwned {}

impl<T: Serialize + DeserializeOwned> Row for T {}

/// Returns the schema of a row, with unit and meaning.
pub fn schema<R: Row>() -> SchemaRef {
    let options = TracingOptions::default()
        .strings_as_large_utf8(false)
        .sequence_as_large_list(false)
        .enums_without_data_as_strings(true);
    let fields = Vec::<FieldRef>::from_type::<R>(options).expect("rows are flat structs");
    let column = |field: &FieldRef| match field.data_type() {
        // Words are texts.
        DataType::Dictionary(_, texts) => Field::new(field.name(), (**texts).clone(), field.is_nullable()),
        _ => field.as_ref().clone(),
    };
    let columns = fields.iter().map(|field| dictionary::with_meaning(column(field)));
    Arc::new(Schema::new(columns.collect::<Vec<_>>()))
}

/// Converts rows to a batch.
pub fn batch<R: Row>(rows: &[R]) -> anyhow::Result<RecordBatch> {
    batch_of::<R, R>(rows)
}

/// Converts rows, or references to them, to a batch.
pub fn batch_of<R: Row, S: Serialize>(rows: &[S]) -> anyhow::Result<RecordBatch> {
    let schema = schema::<R>();
    let batch = serde_arrow::to_record_batch(schema.fields(), &rows)?;
    Ok(batch.with_schema(schema)?)
}

/// Reads all rows of a table. A column of optional values may be missing.
pub fn read<R: Row>(path: &Path) -> Result<Vec<R>, TableError> {
    let (table, schema) = (Table::open(path)?, schema::<R>());
    let required = schema.fields().iter().filter(|field| !field.is_nullable());
    table.expect(path, required.map(|field| field.name().as_str()))?;
    let mut rows = Vec::new();
    for batch in table.batches(&|name| schema.index_of(name).is_ok()) {
        let batch = batch?;
        let read: Vec<R> = serde_arrow::from_record_batch(&batch.rows)
            .map_err(|error| TableError::table(&batch.path, error.to_string()))?;
        rows.extend(read);
    }
    Ok(rows)
}

/// Joins the columns of batches of equal length.
pub fn side_by_side(batches: &[RecordBatch]) -> anyhow::Result<RecordBatch> {
    let schemas: Vec<SchemaRef> = batches.iter().map(RecordBatch::schema).collect();
    let fields: Vec<FieldRef> = schemas.iter().flat_map(|schema| schema.fields().iter().cloned()).collect();
    let columns = batches.iter().flat_map(|batch| batch.columns().iter().cloned()).collect();
    Ok(RecordBatch::try_new(Arc::new(Schema::new(fields)), columns)?)
}
