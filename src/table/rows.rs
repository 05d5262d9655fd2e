//! Structs as rows of a table: the struct is the schema, the dictionary has unit and meaning.

use std::any::TypeId;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

use arrow_array::{
    Array, ArrayRef, Float64Array, Int32Array, Int64Array, RecordBatch, StringArray, StructArray,
    new_null_array,
};
use arrow_schema::{DataType, Field, FieldRef, Schema, SchemaRef};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_arrow::schema::{SchemaLike, TracingOptions};

use super::TableError;
use super::columns::Batch;
use super::dictionary;
use super::file::ParquetTable;

/// A struct of numbers, texts, options of them and lists: each field is a column, and each part of a struct
/// in it. A value with its limits ([`rockfrag_core::statistics::Interval`]) is named by its field; a part whose name
/// begins with a low line continues that of its field.
pub trait Row: Serialize + DeserializeOwned + 'static {}

impl<T: Serialize + DeserializeOwned + 'static> Row for T {}

/// The fields of a row, and the schema of its columns.
type Layout = (Vec<FieldRef>, SchemaRef);

/// Returns the layout of a row, which is found once: that takes as long as some motions.
fn layout<R: Row>() -> Layout {
    static KNOWN: Mutex<BTreeMap<TypeId, Layout>> = Mutex::new(BTreeMap::new());
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    known.entry(TypeId::of::<R>()).or_insert_with(find_layout::<R>).clone()
}

fn find_layout<R: Row>() -> Layout {
    let options = TracingOptions::default()
        .strings_as_large_utf8(false)
        .sequence_as_large_list(false)
        .enums_without_data_as_strings(true);
    let fields = Vec::<FieldRef>::from_type::<R>(options).expect("rows are flat structs");
    let fields: Vec<FieldRef> = fields.iter().map(with_texts).collect();
    let flat = RecordBatch::new_empty(Arc::new(Schema::new(fields.clone()))).normalize(".", None);
    let schema = flat.expect("structs are flattened").schema();
    let named = |field: &FieldRef| field.as_ref().clone().with_name(column_name(field.name()));
    let columns = schema.fields().iter().map(|field| dictionary::with_meaning(named(field)));
    (fields, Arc::new(Schema::new(columns.collect::<Vec<_>>())))
}

/// Takes the words of enums for texts.
fn with_texts(field: &FieldRef) -> FieldRef {
    let data_type = match field.data_type() {
        DataType::Dictionary(_, texts) => (**texts).clone(),
        DataType::Struct(parts) => DataType::Struct(parts.iter().map(with_texts).collect()),
        _ => return field.clone(),
    };
    Arc::new(field.as_ref().clone().with_data_type(data_type))
}

/// The name of a column by the fields that lead to it, with points between.
fn column_name(fields: &str) -> String {
    let parts = fields.split('.').map(str::to_string);
    let name = parts.reduce(|outer, part| match part.as_str() {
        "value" => outer,
        "low" | "high" => format!("{outer}_{part}"),
        _ if part.starts_with('_') => outer + &part,
        _ => part,
    });
    name.unwrap_or_default()
}

/// Returns the schema of a row, with unit and meaning.
pub fn schema<R: Row>() -> SchemaRef {
    layout::<R>().1
}

pub fn batch<'a, R: Row + 'a>(rows: impl IntoIterator<Item = &'a R>) -> anyhow::Result<RecordBatch> {
    let rows: Vec<&R> = rows.into_iter().collect();
    let (fields, schema) = layout::<R>();
    let flat = serde_arrow::to_record_batch(&fields, &rows)?.normalize(".", None)?;
    Ok(RecordBatch::try_new(schema, flat.columns().to_vec())?)
}

fn put_together(field: &FieldRef, columns: &mut impl Iterator<Item = ArrayRef>) -> ArrayRef {
    match field.data_type() {
        DataType::Struct(fields) => {
            let parts = fields.iter().map(|field| put_together(field, columns)).collect();
            Arc::new(StructArray::new(fields.clone(), parts, None))
        }
        _ => columns.next().expect("the schema has all columns"),
    }
}

/// Reads all rows of a table. A column of optional values may be missing.
pub fn read<R: Row>(path: &Path) -> Result<Vec<R>, TableError> {
    let table = ParquetTable::open(path)?;
    let batches = stream(&table)?.collect::<Result<Vec<Vec<R>>, _>>()?;
    Ok(batches.into_iter().flatten().collect())
}

pub fn stream<'a, R: Row>(
    table: &'a ParquetTable,
) -> Result<impl Iterator<Item = Result<Vec<R>, TableError>> + Send + use<'a, R>, TableError> {
    let schema = schema::<R>();
    let required = schema.fields().iter().filter(|field| !field.is_nullable());
    table.expect(required.map(|field| field.name().as_str()))?;
    let batches = table.batches(move |name| schema.index_of(name).is_ok());
    Ok(batches.map(|batch| from_batch(&batch?)))
}

/// Reads the rows of a batch. A column of optional values may be missing.
pub fn from_batch<R: Row>(batch: &Batch) -> Result<Vec<R>, TableError> {
    let (fields, schema) = layout::<R>();
    let columns = schema.fields().iter().map(|column| checked(batch, column));
    let mut columns = columns.collect::<Result<Vec<_>, _>>()?.into_iter();
    let arrays: Vec<ArrayRef> = fields.iter().map(|field| put_together(field, &mut columns)).collect();
    serde_arrow::from_arrow(&fields, &arrays)
        .map_err(|error| TableError::table(&batch.path, error.to_string()))
}

/// A column whose numbers are of its quantity, and not null where one is expected.
fn checked(batch: &Batch, column: &Field) -> Result<ArrayRef, TableError> {
    let name = column.name();
    let checked: ArrayRef = match column.data_type() {
        DataType::Float64 => Arc::new(Float64Array::from(batch.numbers(name)?)),
        DataType::Int64 => Arc::new(Int64Array::from(batch.counts::<i64>(name)?)),
        DataType::Int32 => Arc::new(Int32Array::from(batch.counts::<i32>(name)?)),
        DataType::Utf8 => Arc::new(StringArray::from_iter(batch.texts(name)?)),
        other => match batch.rows.column_by_name(name) {
            Some(found) => found.clone(),
            None => new_null_array(other, batch.rows.num_rows()),
        },
    };
    match (0..checked.len()).find(|row| checked.is_null(*row)).filter(|_| !column.is_nullable()) {
        Some(row) => Err(batch.null_error(row, name)),
        None => Ok(checked),
    }
}

/// Joins the columns of batches of equal length, with unit and meaning.
pub fn side_by_side(batches: &[RecordBatch]) -> anyhow::Result<RecordBatch> {
    let schemas: Vec<SchemaRef> = batches.iter().map(RecordBatch::schema).collect();
    let fields = schemas.iter().flat_map(|schema| schema.fields());
    let fields: Vec<Field> = fields.map(|field| dictionary::with_meaning(field.as_ref().clone())).collect();
    let columns = batches.iter().flat_map(|batch| batch.columns().iter().cloned()).collect();
    Ok(RecordBatch::try_new(Arc::new(Schema::new(fields)), columns)?)
}

/// The rows of each key, in the order in which the keys first come.
pub fn by<R: Copy, K: PartialEq>(rows: impl IntoIterator<Item = R>, key: impl Fn(R) -> K) -> Vec<Vec<R>> {
    let mut groups: Vec<Vec<R>> = Vec::new();
    for row in rows {
        match groups.iter_mut().find(|group| key(group[0]) == key(row)) {
            Some(group) => group.push(row),
            None => groups.push(vec![row]),
        }
    }
    groups
}

/// Each row once.
pub fn distinct<R: Copy + PartialEq>(rows: impl IntoIterator<Item = R>) -> Vec<R> {
    by(rows, |row| row).into_iter().map(|same| same[0]).collect()
}
