//! Lists of samples as our own files hold them, from the pages of their column straight into one array. The reader of whole
//! batches works out for each sample whether it is null, which none of these can be; that takes longer than to decode it.

use std::sync::Arc;

use arrow_array::{Float32Array, ListArray};
use arrow_buffer::{OffsetBuffer, ScalarBuffer};
use arrow_schema::{DataType, Field, FieldRef};
use parquet::basic::Type;
use parquet::column::page::PageReader;
use parquet::column::reader::ColumnReaderImpl;
use parquet::data_type::FloatType;
use parquet::errors::{ParquetError, Result};
use parquet::schema::types::{ColumnDescPtr, ColumnDescriptor};

/// Levels that are looked at together for the start of a list, which few of them are.
const LEVELS_AT_ONCE: usize = 64;

/// The lists of a column in a row group, some rows at a time.
pub(super) struct Lists {
    item: FieldRef,
    reader: ColumnReaderImpl<FloatType>,
    /// Of each sample or empty list: 0 where a list starts.
    repetition: Vec<i16>,
    /// The same: 0 for an empty list.
    definition: Vec<i16>,
}

impl Lists {
    /// The field of the samples, where a column is of single precision and neither a list nor a sample can be null.
    pub fn item_of(field: &Field, leaf: &ColumnDescriptor) -> Option<FieldRef> {
        let levels = (leaf.max_rep_level(), leaf.max_def_level());
        match field.data_type() {
            DataType::List(item)
                if item.data_type() == &DataType::Float32
                    && leaf.physical_type() == Type::FLOAT
                    && levels == (1, 1) =>
            {
                Some(item.clone())
            }
            _ => None,
        }
    }

    /// Those of these pages from row `first` on.
    ///
    /// # Errors
    /// If the pages are damaged.
    pub fn new(item: FieldRef, leaf: ColumnDescPtr, pages: Box<dyn PageReader>, first: u64) -> Result<Lists> {
        let mut reader = ColumnReaderImpl::new(leaf, pages);
        reader.skip_records(first as usize)?;
        Ok(Lists { item, reader, repetition: Vec::new(), definition: Vec::new() })
    }

    /// The lists of the next `rows` rows.
    ///
    /// # Errors
    /// If the pages are damaged, or end before.
    pub fn next(&mut self, rows: usize) -> Result<ListArray> {
        self.repetition.clear();
        self.definition.clear();
        let mut samples = Vec::new();
        let (definition, repetition) = (&mut self.definition, &mut self.repetition);
        self.reader.read_records(rows, Some(definition), Some(repetition), &mut samples)?;
        let mut offsets = Vec::with_capacity(rows + 1);
        let mut empty = 0;
        for (block, levels) in self.repetition.chunks(LEVELS_AT_ONCE).enumerate() {
            if !levels.contains(&0) {
                continue;
            }
            for start in (0..levels.len()).filter(|&at| levels[at] == 0) {
                let start = block * LEVELS_AT_ONCE + start;
                offsets.push((start - empty) as i32);
                empty += usize::from(self.definition[start] == 0);
            }
        }
        if offsets.len() != rows || self.repetition.len() - empty != samples.len() {
            let (lists, samples) = (offsets.len(), samples.len());
            return Err(ParquetError::General(format!(
                "{lists} lists, {empty} of them empty, and {samples} samples; expected {rows} lists"
            )));
        }
        offsets.push(samples.len() as i32);
        let offsets = OffsetBuffer::new(ScalarBuffer::from(offsets));
        let samples = Float32Array::new(ScalarBuffer::from(samples), None);
        Ok(ListArray::try_new(self.item.clone(), offsets, Arc::new(samples), None)?)
    }
}
