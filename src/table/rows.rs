//! Structs as rows of a table: the struct is the schema, the dictionary has unit and meaning.

use std::path::Path;
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::{ArrayRef, RecordBatch, StructArray};
use arrow_schema::{DataType, Field, FieldRef, Schema, SchemaRef};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_arrow::schema::{SchemaLike, TracingOptions};

use super::TableError;
use super::dictionary;
use super::file::Table;

/// A struct of numbers, texts, options of them and lists; each field is a column, and a value with its limits
/// ([`crate::number::Limited`]) three.
pub trait Row: Serialize + DeserializeOwned {}

impl<T: Serialize + DeserializeOwned> Row for T {}

/// How the names of the columns of a value with its limits end.
const LIMITS: [&str; 3] = ["", "_low", "_high"];

fn fields<R: Row>() -> Vec<FieldRef> {
    let options = TracingOptions::default()
        .strings_as_large_utf8(false)
        .sequence_as_large_list(false)
        .enums_without_data_as_strings(true);
    let fields = Vec::<FieldRef>::from_type::<R>(options).expect("rows are flat structs");
    let field = |field: FieldRef| match field.data_type() {
        // Words are texts.
        DataType::Dictionary(_, texts) => {
            Arc::new(Field::new(field.name(), (**texts).clone(), field.is_nullable()))
        }
        _ => field,
    };
    fields.into_iter().map(field).collect()
}

fn columns(field: &FieldRef) -> Vec<FieldRef> {
    let DataType::Struct(parts) = field.data_type() else { return vec![field.clone()] };
    let column = |(end, part): (&str, &FieldRef)| {
        Arc::new(Field::new(format!("{}{end}", field.name()), part.data_type().clone(), part.is_nullable()))
    };
    LIMITS.into_iter().zip(parts).map(column).collect()
}

/// Returns the schema of a row, with unit and meaning.
pub fn schema<R: Row>() -> SchemaRef {
    let columns = fields::<R>().iter().flat_map(columns).collect::<Vec<FieldRef>>();
    let columns = columns.iter().map(|column| dictionary::with_meaning(column.as_ref().clone()));
    Arc::new(Schema::new(columns.collect::<Vec<_>>()))
}

pub fn batch<'a, R: Row + 'a>(rows: impl IntoIterator<Item = &'a R>) -> anyhow::Result<RecordBatch> {
    let rows: Vec<&R> = rows.into_iter().collect();
    let arrays = serde_arrow::to_arrow(&fields::<R>(), &rows)?;
    let columns = arrays.into_iter().flat_map(|array| match array.as_struct_opt() {
        Some(limited) => limited.columns().to_vec(),
        None => vec![array],
    });
    Ok(RecordBatch::try_new(schema::<R>(), columns.collect())?)
}

/// Reads all rows of a table. A column of optional values may be missing.
pub fn read<R: Row>(path: &Path) -> Result<Vec<R>, TableError> {
    let (table, schema) = (Table::open(path)?, schema::<R>());
    let required = schema.fields().iter().filter(|field| !field.is_nullable());
    table.expect(path, required.map(|field| field.name().as_str()))?;
    let mut rows = Vec::new();
    for batch in table.batches(&|name| schema.index_of(name).is_ok()) {
        let batch = batch?;
        let read: Vec<R> =
            rows_of(&batch.rows).map_err(|error| TableError::table(&batch.path, error.to_string()))?;
        rows.extend(read);
    }
    Ok(rows)
}

fn rows_of<R: Row>(batch: &RecordBatch) -> anyhow::Result<Vec<R>> {
    let array = |column: &FieldRef| batch.column_by_name(column.name()).cloned();
    let known = |field: FieldRef| {
        let arrays = columns(&field).iter().map(array).collect::<Option<Vec<ArrayRef>>>()?;
        let array = match field.data_type() {
            DataType::Struct(parts) => Arc::new(StructArray::new(parts.clone(), arrays, None)),
            _ => arrays[0].clone(),
        };
        Some((field, array))
    };
    let (fields, arrays): (Vec<FieldRef>, Vec<ArrayRef>) =
        fields::<R>().into_iter().filter_map(known).unzip();
    Ok(serde_arrow::from_arrow(&fields, &arrays)?)
}

/// Joins the columns of batches of equal length.
pub fn side_by_side(batches: &[RecordBatch]) -> anyhow::Result<RecordBatch> {
    let schemas: Vec<SchemaRef> = batches.iter().map(RecordBatch::schema).collect();
    let fields: Vec<FieldRef> = schemas.iter().flat_map(|schema| schema.fields().iter().cloned()).collect();
    let columns = batches.iter().flat_map(|batch| batch.columns().iter().cloned()).collect();
    Ok(RecordBatch::try_new(Arc::new(Schema::new(fields)), columns)?)
}
