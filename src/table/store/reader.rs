//! Reads a table batch by batch, from wherever it is: a file, a folder of files, or memory.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use arrow_array::RecordBatch;
use arrow_schema::SchemaRef;

use super::columns::missing;
use super::folder;
use super::fragment::Fragment;
pub use super::fragment::{Batch, Run};
use super::source::Source;
use super::table_file::TableFile;
use crate::table::TableError;
use crate::table::schema::{Column, Table};

/// Rows of a narrow table that are decoded at once.
const NARROW_BATCH: usize = 8192;

/// Rows of any table that are decoded at once, each of which may be a motion.
const FEW_ROWS: usize = 64;

/// A table, open at those of its columns that are wanted.
pub struct OpenTable {
    fragments: Vec<Fragment>,
}

/// The batches of a table in order.
pub struct Batches {
    schema: SchemaRef,
    rows: u64,
    batches: BatchIterator,
}

type BatchIterator = Box<dyn Iterator<Item = Result<Batch, TableError>> + Send>;

impl OpenTable {
    /// Opens a table at those of `columns` that it has.
    ///
    /// # Errors
    /// If a file is missing, unreadable, or the output of a stage other than `stages`, if a folder is incomplete, or if there
    /// are no rows. A file that another program wrote has no stage and is taken by its columns.
    pub fn open(
        source: impl Into<Source>,
        stages: &[&str],
        columns: &[Column],
    ) -> Result<OpenTable, TableError> {
        OpenTable::open_at(source, stages, |name| columns.iter().any(|column| column.name == name))
    }

    /// The same at the columns whose names are wanted.
    ///
    /// # Errors
    /// As [`OpenTable::open`].
    pub fn open_at(
        source: impl Into<Source>,
        stages: &[&str],
        is_wanted: impl Fn(&str) -> bool,
    ) -> Result<OpenTable, TableError> {
        let source = source.into();
        let table = OpenTable::of(&source, Some(stages), is_wanted)?;
        if table.rows() == 0 && !is_partition(&source)? {
            return Err(TableError::Empty { path: source.name().to_path_buf() });
        }
        Ok(table)
    }

    fn of(
        source: &Source,
        stages: Option<&[&str]>,
        is_wanted: impl Fn(&str) -> bool,
    ) -> Result<OpenTable, TableError> {
        let fragments = match source {
            Source::Path(path) => folder::files(path)?
                .iter()
                .map(|file| Ok(Fragment::File(TableFile::open(file, stages, &is_wanted)?)))
                .collect::<Result<Vec<_>, TableError>>()?,
            Source::Memory(table) => {
                let fields = table.schema.fields().iter().enumerate();
                let wanted = fields.filter(|(_, field)| is_wanted(field.name())).map(|(at, _)| at).collect();
                vec![Fragment::Memory(table.clone(), wanted)]
            }
        };
        Ok(OpenTable { fragments })
    }

    /// How many rows it has.
    pub fn rows(&self) -> u64 {
        self.fragments.iter().flat_map(Fragment::rows_of_groups).sum()
    }

    /// The files that do not say which of our stages made them, or the table in memory.
    pub fn of_others(&self) -> impl Iterator<Item = Arc<Path>> {
        let is_ours = |fragment: &&Fragment| matches!(fragment, Fragment::File(file) if file.is_ours);
        self.fragments.iter().filter(move |fragment| !is_ours(fragment)).map(Fragment::path)
    }

    /// The columns that will be read, of each file.
    ///
    /// # Errors
    /// If a file is damaged.
    pub fn schemas(&self) -> Result<Vec<(Arc<Path>, SchemaRef)>, TableError> {
        self.fragments.iter().map(|fragment| Ok((fragment.path(), fragment.schema()?))).collect()
    }

    /// The rows of `range`, in runs: row groups, as far as they lie in it.
    pub fn runs(&self, range: Range<u64>) -> Vec<Run> {
        let mut runs = Vec::new();
        let mut before = 0;
        for (fragment, of_piece) in self.fragments.iter().enumerate() {
            let mut first_row = 0;
            for (group, rows) in of_piece.rows_of_groups().into_iter().enumerate() {
                let first = range.start.clamp(before, before + rows) - before;
                let end = range.end.clamp(before, before + rows) - before;
                if end > first {
                    runs.push(Run {
                        fragment,
                        group,
                        first,
                        rows: end - first,
                        first_row: first_row + first,
                    });
                }
                before += rows;
                first_row += rows;
            }
        }
        runs
    }

    /// The file of a run, or the name of the table in memory.
    pub fn path_of(&self, run: Run) -> Arc<Path> {
        self.fragments[run.fragment].path()
    }

    /// The rows of a run, `batch_size` at a time.
    ///
    /// # Errors
    /// If the file is damaged.
    pub fn batches_of(
        &self,
        run: Run,
        batch_size: usize,
    ) -> Result<impl Iterator<Item = Result<Batch, TableError>> + Send + use<>, TableError> {
        self.fragments[run.fragment].read(run, batch_size)
    }

    /// All rows, `batch_size` at a time.
    ///
    /// # Errors
    /// If a file is damaged.
    pub fn batches(self, batch_size: usize) -> Result<Batches, TableError> {
        let (schema, rows) = (self.fragments[0].schema()?, self.rows());
        let batches = self.runs(0..rows).into_iter().flat_map(move |run| -> BatchIterator {
            match self.batches_of(run, batch_size) {
                Ok(batches) => Box::new(batches),
                Err(error) => Box::new(std::iter::once(Err(error))),
            }
        });
        Ok(Batches { schema, rows, batches: Box::new(batches) })
    }

    /// All rows, to be held as a whole.
    ///
    /// # Errors
    /// If a file is damaged, or announces more rows than it has bytes.
    pub fn whole(self) -> Result<Batches, TableError> {
        self.expect_rows(0)?;
        self.batches(NARROW_BATCH)
    }

    /// That no file makes much work, or much of another file, of little: more rows than it has bytes, and more than `few`.
    ///
    /// # Errors
    /// With the first one that does.
    pub fn expect_rows(&self, few: u64) -> Result<(), TableError> {
        self.fragments.iter().try_for_each(|fragment| match fragment {
            Fragment::File(file) => file.expect_rows(few),
            Fragment::Memory(..) => Ok(()),
        })
    }
}

/// Whether a file is a part of a table, and may be without rows.
fn is_partition(source: &Source) -> Result<bool, TableError> {
    match source {
        Source::Path(path) if path.is_file() => Ok(folder::partition_of(path)?.is_some()),
        _ => Ok(false),
    }
}

impl Batches {
    /// Opens a table: those of `columns` that it has, `batch_size` rows at a time; all of its files must have those that may not
    /// be null, and no more rows than bytes or `few`.
    ///
    /// # Errors
    /// As [`OpenTable::open`] and [`OpenTable::expect_rows`], or if a column is missing.
    pub fn open(
        source: impl Into<Source>,
        stages: &[&str],
        columns: &[Column],
        few: u64,
        batch_size: usize,
    ) -> Result<Batches, TableError> {
        let table = OpenTable::open(source, stages, columns)?;
        table.expect_rows(few)?;
        let schemas = table.schemas()?;
        schemas.iter().try_for_each(|(path, schema)| expect_columns(path, schema, columns))?;
        table.batches(batch_size)
    }

    /// Opens a table that is then held as a whole.
    ///
    /// # Errors
    /// As [`OpenTable::open`] and [`OpenTable::whole`].
    pub fn open_whole(
        source: impl Into<Source>,
        table: &Table,
        stages: &[&str],
    ) -> Result<Batches, TableError> {
        OpenTable::open(source, stages, table.columns)?.whole()
    }

    /// How many rows the table has.
    pub fn rows(&self) -> u64 {
        self.rows
    }

    /// The columns that will be read.
    pub fn schema(&self) -> &SchemaRef {
        &self.schema
    }
}

impl Iterator for Batches {
    type Item = Result<Batch, TableError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.batches.next()
    }
}

/// The batches of any narrow table with the columns that are wanted, whoever wrote it.
///
/// # Errors
/// If it is missing or unreadable.
pub fn read_any(
    source: impl Into<Source>,
    is_wanted: impl Fn(&str) -> bool,
) -> Result<Vec<RecordBatch>, TableError> {
    let table = OpenTable::of(&source.into(), None, is_wanted)?;
    table.whole()?.map(|batch| Ok(batch?.rows)).collect()
}

/// The first rows of any table with all its columns, whoever wrote it.
///
/// # Errors
/// If it is missing or unreadable.
pub fn read_first(source: impl Into<Source>, rows: usize) -> Result<Vec<RecordBatch>, TableError> {
    let table = OpenTable::of(&source.into(), None, |_| true)?;
    let mut batches = Vec::new();
    for run in table.runs(0..rows as u64) {
        for batch in table.batches_of(run, FEW_ROWS)? {
            batches.push(batch?.rows);
        }
    }
    Ok(batches)
}

/// That a schema has those of the columns that may not be null.
///
/// # Errors
/// With the first one that is missing.
pub fn expect_columns(path: &Path, schema: &SchemaRef, columns: &[Column]) -> Result<(), TableError> {
    let is_missing = |column: &&Column| !column.nullable && schema.field_with_name(column.name).is_err();
    match columns.iter().find(is_missing) {
        Some(column) => Err(missing(path, column)),
        None => Ok(()),
    }
}
