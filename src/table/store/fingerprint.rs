//! The hash of what a table holds.

use arrow_array::cast::AsArray;
use arrow_array::types::{Float32Type, Float64Type, Int32Type, Int64Type};
use arrow_array::{Array, RecordBatch};
use arrow_schema::{DataType, SchemaRef};

/// Hashes what a table holds, column by column, so that neither batches nor row groups matter.
pub struct Fingerprint {
    schema: SchemaRef,
    columns: Vec<blake3::Hasher>,
    rows: u64,
}

impl Fingerprint {
    /// Of a table without rows yet.
    pub fn new(schema: SchemaRef) -> Fingerprint {
        let columns = vec![blake3::Hasher::new(); schema.fields().len()];
        Fingerprint { schema, columns, rows: 0 }
    }

    /// Whether a column of this type can be hashed: those of our files can.
    pub fn knows(kind: &DataType) -> bool {
        match kind {
            DataType::Int64 | DataType::Int32 | DataType::Float64 | DataType::Utf8 => true,
            DataType::List(items) => matches!(items.data_type(), DataType::Float32 | DataType::Float64),
            _ => false,
        }
    }

    /// Adds the rows of a batch of this schema.
    pub fn update(&mut self, batch: &RecordBatch) {
        self.rows += batch.num_rows() as u64;
        for (hasher, array) in self.columns.iter_mut().zip(batch.columns()) {
            update_column(hasher, array.as_ref());
        }
    }

    /// The fingerprint of all rows so far.
    pub fn finish(&self) -> String {
        let mut whole = blake3::Hasher::new();
        whole.update(&self.rows.to_le_bytes());
        for (field, column) in self.schema.fields().iter().zip(&self.columns) {
            whole.update(format!("{} {}\n", field.name(), field.data_type()).as_bytes());
            whole.update(column.finalize().as_bytes());
        }
        whole.finalize().to_hex().to_string()
    }
}

/// All at once, since the hash of one long fragment takes a fraction of the time of many short ones.
fn update_column(hasher: &mut blake3::Hasher, array: &dyn Array) {
    let mut bytes = Vec::with_capacity(16 * array.len());
    for row in 0..array.len() {
        if array.is_null(row) {
            bytes.extend(b"null");
            continue;
        }
        match array.data_type() {
            DataType::Int64 => push(&mut bytes, &array.as_primitive::<Int64Type>().value(row).to_le_bytes()),
            DataType::Int32 => push(&mut bytes, &array.as_primitive::<Int32Type>().value(row).to_le_bytes()),
            DataType::Float64 => {
                push(&mut bytes, &array.as_primitive::<Float64Type>().value(row).to_le_bytes())
            }
            DataType::Utf8 => push(&mut bytes, array.as_string::<i32>().value(row).as_bytes()),
            _ => {
                let list = array.as_list::<i32>().value(row);
                match list.data_type() {
                    DataType::Float64 => {
                        push(&mut bytes, list.as_primitive::<Float64Type>().values().inner().as_slice())
                    }
                    _ => push(&mut bytes, list.as_primitive::<Float32Type>().values().inner().as_slice()),
                }
            }
        }
    }
    hasher.update(&bytes);
}

/// With the length in front, so that no two different columns run together into the same bytes.
fn push(bytes: &mut Vec<u8>, value: &[u8]) {
    bytes.extend((value.len() as u64).to_le_bytes());
    bytes.extend(value);
}
