//! What a table consists of: files, or batches in memory.

use std::path::Path;
use std::sync::Arc;

use arrow_array::RecordBatch;
use arrow_schema::{ArrowError, SchemaRef};
use parquet::errors::ParquetError;

use super::columns::Columns;
use super::footer::not_parquet;
use super::source::MemoryTable;
use super::table_file::TableFile;
use crate::table::TableError;

/// A file, or a table in memory with the places of the columns that are wanted.
pub(super) enum Fragment {
    File(TableFile),
    Memory(Arc<MemoryTable>, Vec<usize>),
}

/// A run of rows that one thread can read on its own: in a row group of a file, or in a batch in memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Run {
    /// Which fragment of the table.
    pub(super) fragment: usize,
    /// Which group of it.
    pub(super) group: usize,
    /// From the start of the group.
    pub(super) first: u64,
    /// How many rows.
    pub rows: u64,
    /// Rows of the fragment before this run.
    pub first_row: u64,
}

/// A batch and where it stands.
pub struct Batch {
    pub rows: RecordBatch,
    /// The file they are of, or the name of the table in memory.
    pub path: Arc<Path>,
    /// The number of rows of the file before them.
    pub first_row: u64,
}

impl Batch {
    /// Its columns.
    pub fn columns(&self) -> Columns<'_> {
        Columns::new(&self.path, &self.rows, self.first_row)
    }

    /// Its rows in order, `size` at a time.
    pub fn slices(&self, size: usize) -> impl Iterator<Item = Batch> {
        (0..self.rows.num_rows()).step_by(size).map(move |first| Batch {
            rows: self.rows.slice(first, size.min(self.rows.num_rows() - first)),
            path: self.path.clone(),
            first_row: self.first_row + first as u64,
        })
    }
}

impl Fragment {
    pub fn path(&self) -> Arc<Path> {
        match self {
            Fragment::File(file) => file.path.clone(),
            Fragment::Memory(table, _) => table.name.as_path().into(),
        }
    }

    pub fn schema(&self) -> Result<SchemaRef, TableError> {
        match self {
            Fragment::File(file) => Ok(file.schema.clone()),
            Fragment::Memory(table, columns) => {
                table.schema.project(columns).map(Arc::new).map_err(|source| damaged(table, &source))
            }
        }
    }

    pub fn rows_of_groups(&self) -> Vec<u64> {
        match self {
            Fragment::File(file) => file.rows_of_groups(),
            Fragment::Memory(table, _) => table.batches.iter().map(|batch| batch.num_rows() as u64).collect(),
        }
    }

    pub fn read(&self, run: Run, batch_size: usize) -> Result<BatchesOfRun, TableError> {
        let rows: Rows = match self {
            Fragment::File(file) => Box::new(file.read(run.group, run.first, run.rows, batch_size)?),
            Fragment::Memory(table, columns) => {
                let batch = table.batches[run.group].slice(run.first as usize, run.rows as usize);
                let batch = batch.project(columns).map_err(|source| damaged(table, &source))?;
                let starts = (0..batch.num_rows()).step_by(batch_size);
                Box::new(
                    starts.map(move |start| Ok(batch.slice(start, batch_size.min(batch.num_rows() - start)))),
                )
            }
        };
        Ok(BatchesOfRun { path: self.path(), rows, next_row: run.first_row })
    }
}

fn damaged(table: &MemoryTable, source: &ArrowError) -> TableError {
    not_parquet(&table.name, ParquetError::ArrowError(source.to_string()))
}

type Rows = Box<dyn Iterator<Item = Result<RecordBatch, TableError>> + Send>;

pub(super) struct BatchesOfRun {
    path: Arc<Path>,
    rows: Rows,
    next_row: u64,
}

impl Iterator for BatchesOfRun {
    type Item = Result<Batch, TableError>;

    fn next(&mut self) -> Option<Self::Item> {
        let batch = self.rows.next()?.map(|rows| {
            let first_row = self.next_row;
            self.next_row += rows.num_rows() as u64;
            Batch { rows, path: self.path.clone(), first_row }
        });
        Some(batch)
    }
}
