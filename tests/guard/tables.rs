//! What a Parquet file holds, by plain readers: its columns, its first row, and a hash of each column's values.

use std::fmt::Write;
use std::path::Path;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Float64Type, Int32Type, Int64Type};
use arrow_array::{Array, RecordBatch};
use arrow_schema::{DataType, Field};
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;

/// A value without the width of its type: `Int32` and `Int64` of the same number are the same.
enum Value {
    Null,
    Float(f64),
    Int(i64),
    Bool(bool),
    Text(String),
    List(Vec<Value>),
}

impl Value {
    fn of(array: &dyn Array, row: usize) -> Value {
        if array.is_null(row) {
            return Value::Null;
        }
        match array.data_type() {
            DataType::Float64 => Value::Float(array.as_primitive::<Float64Type>().value(row)),
            DataType::Float32 => Value::Float(array.as_primitive::<Float32Type>().value(row).into()),
            DataType::Int64 => Value::Int(array.as_primitive::<Int64Type>().value(row)),
            DataType::Int32 => Value::Int(array.as_primitive::<Int32Type>().value(row).into()),
            DataType::Boolean => Value::Bool(array.as_boolean().value(row)),
            DataType::Utf8 => Value::Text(array.as_string::<i32>().value(row).to_string()),
            DataType::List(_) => {
                let items = array.as_list::<i32>().value(row);
                Value::List((0..items.len()).map(|item| Value::of(&items, item)).collect())
            }
            other => panic!("values of type {other} are not known here"),
        }
    }

    fn hash_into(&self, hasher: &mut blake3::Hasher) {
        let mut tagged = |tag: u8, bytes: &[u8]| {
            hasher.update(&[tag]).update(bytes);
        };
        match self {
            Value::Null => tagged(0, &[]),
            Value::Float(number) => tagged(1, &number.to_bits().to_le_bytes()),
            Value::Int(number) => tagged(2, &number.to_le_bytes()),
            Value::Bool(truth) => tagged(3, &[u8::from(*truth)]),
            Value::Text(text) => {
                tagged(4, &text.len().to_le_bytes());
                hasher.update(text.as_bytes());
            }
            Value::List(items) => {
                tagged(5, &items.len().to_le_bytes());
                items.iter().for_each(|item| item.hash_into(hasher));
            }
        }
    }

    fn show(&self) -> String {
        match self {
            Value::Null => "null".to_string(),
            Value::Float(number) => format!("{number:?}"),
            Value::Int(number) => number.to_string(),
            Value::Bool(truth) => truth.to_string(),
            Value::Text(text) => format!("{text:?}"),
            Value::List(items) => {
                let first: Vec<String> = items.iter().take(3).map(Value::show).collect();
                format!("{} items: {}", items.len(), first.join(", "))
            }
        }
    }
}

fn open(path: &Path) -> ParquetRecordBatchReaderBuilder<std::fs::File> {
    let file = std::fs::File::open(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    ParquetRecordBatchReaderBuilder::try_new(file).unwrap()
}

fn batches(path: &Path) -> impl Iterator<Item = RecordBatch> {
    open(path).build().unwrap().map(Result::unwrap)
}

/// A line for each column: name, Arrow type, whether null, metadata (unit and description), and the value in the first row.
pub fn schema(path: &Path) -> String {
    let builder = open(path);
    let mut keys: Vec<String> = builder
        .metadata()
        .file_metadata()
        .key_value_metadata()
        .into_iter()
        .flatten()
        .map(|pair| pair.key.clone())
        .collect();
    keys.sort();
    let mut text = format!("footer: {}\n", keys.join(", "));
    let first = batches(path).find(|batch| batch.num_rows() > 0);
    for (column, field) in builder.schema().fields().iter().enumerate() {
        let value = first.as_ref().map(|batch| Value::of(batch.column(column), 0).show());
        writeln!(text, "{}\n    {}", line(field), value.unwrap_or_else(|| "no rows".to_string())).unwrap();
    }
    text
}

fn line(field: &Field) -> String {
    let nulls = if field.is_nullable() { "nullable" } else { "not null" };
    let mut metadata: Vec<String> =
        field.metadata().iter().map(|(key, value)| format!("{key}: {value}")).collect();
    metadata.sort_by_key(|entry| !entry.starts_with("unit"));
    format!("{} | {} | {nulls} | {}", field.name(), field.data_type(), metadata.join(" | "))
}

/// A line for each column: its name and a hash of its values, with the number of rows first.
pub fn fingerprints(path: &Path) -> String {
    let schema = open(path).schema().clone();
    let mut hashers = vec![blake3::Hasher::new(); schema.fields().len()];
    let mut rows = 0;
    for batch in batches(path) {
        rows += batch.num_rows();
        for (column, hasher) in batch.columns().iter().zip(&mut hashers) {
            (0..column.len()).for_each(|row| Value::of(column, row).hash_into(hasher));
        }
    }
    let mut text = format!("{rows} rows\n");
    for (field, hasher) in schema.fields().iter().zip(&hashers) {
        writeln!(text, "{:34} {}", field.name(), &hasher.finalize().to_hex()[..16]).unwrap();
    }
    text
}
