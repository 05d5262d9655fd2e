//! Some rows of a row group: samples straight from their pages, and all else by the library's reader of whole batches.

use std::sync::Arc;

use arrow_array::{ArrayRef, RecordBatch, RecordBatchOptions};
use arrow_schema::SchemaRef;
use parquet::arrow::arrow_reader::ParquetRecordBatchReader;
use parquet::errors::{ParquetError, Result};

use super::lists::Lists;

/// Reads on from batch to batch.
pub(super) struct RowGroup {
    /// All columns, in order.
    pub schema: SchemaRef,
    /// What reads those that are no lists.
    pub narrow: ParquetRecordBatchReader,
    /// What reads the others, each with its place among all, ascending.
    pub lists: Vec<(usize, Lists)>,
}

impl RowGroup {
    /// The next batch, or nothing at the end.
    ///
    /// # Errors
    /// If the pages are damaged, or some columns end before others.
    pub fn next(&mut self) -> Result<Option<RecordBatch>> {
        let narrow = self.narrow.next().transpose();
        let Some(narrow) = narrow.map_err(|source| ParquetError::ArrowError(source.to_string()))? else {
            return Ok(None);
        };
        let mut columns: Vec<ArrayRef> = narrow.columns().to_vec();
        for (place, lists) in &mut self.lists {
            columns.insert(*place, Arc::new(lists.next(narrow.num_rows())?));
        }
        let rows = RecordBatchOptions::new().with_row_count(Some(narrow.num_rows()));
        Ok(Some(RecordBatch::try_new_with_options(self.schema.clone(), columns, &rows)?))
    }
}
