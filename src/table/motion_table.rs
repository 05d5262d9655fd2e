//! A motions file that several threads read, some motions at a time.

use std::collections::HashSet;
use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use arrow_schema::SchemaRef;

use super::TableError;
use super::motions::{Motion, MotionRow, STAGES, motions_of};
use super::row::{Row, ids_are_names};
use super::schema;
use super::store::partition::Partition;
use super::store::reader::{Batch, OpenTable, Run, expect_columns};
use super::store::source::Source;

/// The most motions of a part.
const LARGEST_PART: usize = 128;

/// A table of motions that several threads read.
pub struct MotionTable {
    table: OpenTable,
    rows: Range<u64>,
    by_name: bool,
}

/// Some motions, in order.
pub enum Part {
    /// Few, and not yet read.
    Unread(Run),
    /// Some of a row group that is too large to be read at once.
    Rows(Batch),
}

impl MotionTable {
    /// Opens a table of motions, or a partition of it.
    ///
    /// # Errors
    /// As [`MotionBatches::open`], or if motions go by name in one file and by number in another.
    pub fn open(source: impl Into<Source>, partition: Option<Partition>) -> Result<MotionTable, TableError> {
        let table = OpenTable::open(source, &STAGES, MotionRow::TABLE.columns)?;
        table.expect_rows(0)?;
        let schemas = table.schemas()?;
        schemas
            .iter()
            .try_for_each(|(path, schema)| expect_columns(path, schema, MotionRow::TABLE.columns))?;
        let by_name = ids_are_names(&schemas[0].1);
        if let Some((path, schema)) = schemas.iter().find(|(_, schema)| ids_are_names(schema) != by_name) {
            let type_of = |schema: &SchemaRef| {
                schema
                    .field_with_name(schema::motion_id.name)
                    .map_or(String::new(), |f| f.data_type().to_string())
            };
            return Err(TableError::WrongType {
                path: path.to_path_buf(),
                column: schema::motion_id.name.to_string(),
                found: type_of(schema),
                expected: format!("{} as in {}", type_of(&schemas[0].1), schemas[0].0.display()),
            });
        }
        let total = table.rows();
        let rows = partition.map_or(0..total, |partition| partition.rows(total));
        Ok(MotionTable { table, rows, by_name })
    }

    /// The files that another program made, or the table in memory.
    pub fn of_others(&self) -> HashSet<Arc<Path>> {
        self.table.of_others().collect()
    }

    /// How many motions there are.
    pub fn rows(&self) -> u64 {
        self.rows.end - self.rows.start
    }

    /// Whether motions go by name rather than by number.
    pub fn ids_are_names(&self) -> bool {
        self.by_name
    }

    /// All motions: row groups, which any thread may read, where they are small.
    pub fn parts(&self) -> impl Iterator<Item = Result<Part, TableError>> + Send {
        let runs = self.table.runs(self.rows.clone()).into_iter();
        runs.flat_map(|run| -> Box<dyn Iterator<Item = Result<Part, TableError>> + Send> {
            if run.rows <= LARGEST_PART as u64 {
                return Box::new(std::iter::once(Ok(Part::Unread(run))));
            }
            match self.table.batches_of(run, LARGEST_PART) {
                Ok(batches) => Box::new(batches.map(|batch| batch.map(Part::Rows))),
                Err(error) => Box::new(std::iter::once(Err(error))),
            }
        })
    }

    /// The file of a part, or the name of the table in memory.
    pub fn path_of(&self, part: &Part) -> Arc<Path> {
        match part {
            Part::Rows(batch) => batch.path.clone(),
            Part::Unread(run) => self.table.path_of(*run),
        }
    }

    /// The row groups in which these rows of the table lie, each with the rows of its file, all ascending.
    pub fn runs_of(&self, rows: &[u64]) -> Vec<(Run, Vec<u64>)> {
        let mut before = 0;
        let runs = self.table.runs(self.rows.clone()).into_iter().map(|run| {
            let inside = before..before + run.rows;
            before += run.rows;
            let rows = rows.iter().filter(|row| inside.contains(row));
            (run, rows.map(|row| run.first_row + (row - inside.start)).collect::<Vec<u64>>())
        });
        runs.filter(|(_, rows)| !rows.is_empty()).collect()
    }

    /// The motions of a run that `wanted` picks.
    ///
    /// # Errors
    /// If the file is damaged or a value cannot be used.
    pub fn pick(&self, run: Run, wanted: impl Fn(&Motion) -> bool) -> Result<Vec<Motion>, TableError> {
        let mut picked = Vec::new();
        for batch in self.table.batches_of(run, LARGEST_PART)? {
            picked.extend(motions_of(&batch?)?.into_iter().filter(&wanted));
        }
        Ok(picked)
    }

    /// The motions of a part, `at_once` at a time: what it takes to decode some is used again for the next, which costs less
    /// than new memory, that the kernel has to clear.
    ///
    /// # Errors
    /// If the file is damaged or a value cannot be used.
    pub fn chunks(
        &self,
        part: &Part,
        at_once: usize,
    ) -> Result<impl Iterator<Item = Result<Vec<Motion>, TableError>>, TableError> {
        let batches: Box<dyn Iterator<Item = Result<Batch, TableError>>> = match part {
            Part::Rows(batch) => Box::new(batch.slices(at_once).map(Ok)),
            Part::Unread(run) => Box::new(self.table.batches_of(*run, at_once)?),
        };
        Ok(batches.map(|batch| motions_of(&batch?)))
    }
}
