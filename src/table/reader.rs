//! Reads a table batch by batch, from wherever it is, or a narrow one whole.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use arrow_array::RecordBatch;
use arrow_schema::{ArrowError, FieldRef, SchemaRef};
use parquet::arrow::ProjectionMask;
use parquet::arrow::arrow_reader::{
    ArrowReaderMetadata, ArrowReaderOptions, ParquetRecordBatchReader, ParquetRecordBatchReaderBuilder,
};
use parquet::errors::ParquetError;
use parquet::schema::types::TypePtr;
use polars::prelude::{DataFrame, IntoColumn, NamedFrom, Series};

use super::TableError;
use super::columns::{Columns, missing};
use super::folder;
use super::footer::{not_parquet, open_file};
use super::provenance::stamp;
use super::schema::{Column, Kind, Table};
use super::shared_file::SharedFile;
use super::source::{MemoryTable, Source};

/// Rows of a narrow table that are decoded at once.
const NARROW_BATCH: usize = 8192;

/// A table, open at those of its columns that are wanted: of one file, of a folder of them, or in memory.
pub struct OpenTable {
    pieces: Vec<Piece>,
}

enum Piece {
    File(TableFile),
    Memory(Arc<MemoryTable>, Vec<usize>),
}

/// A run of rows that one thread can read on its own: in a row group of a file, or in a batch in memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Run {
    piece: usize,
    group: usize,
    /// From the start of the group.
    first: u64,
    /// How many rows.
    pub rows: u64,
    /// Rows of the piece before this run.
    first_row: u64,
}

/// The batches of a table in order.
pub struct Batches {
    schema: SchemaRef,
    rows: u64,
    batches: Box<dyn Iterator<Item = Result<Batch, TableError>> + Send>,
}

/// A batch and where it stands.
pub struct Batch {
    /// The rows.
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
}

impl OpenTable {
    /// Opens a table at those of `columns` that it has.
    ///
    /// # Errors
    /// If a file is missing, unreadable, or the output of a stage other than `stages`, if a folder is incomplete, or if there
    /// are no rows. A file that another program wrote has no stage and is taken by its columns.
    pub fn open(source: &Source, stages: &[&str], columns: &[Column]) -> Result<OpenTable, TableError> {
        let pieces = match source {
            Source::Path(path) => folder::files(path)?
                .iter()
                .map(|file| Ok(Piece::File(TableFile::open(file, stages, columns)?)))
                .collect::<Result<Vec<_>, TableError>>()?,
            Source::Memory(table) => {
                let wanted = |field: &FieldRef| columns.iter().any(|column| column.name == field.name());
                let fields = table.schema.fields().iter().enumerate();
                let wanted = fields.filter(|(_, field)| wanted(field)).map(|(at, _)| at).collect();
                vec![Piece::Memory(table.clone(), wanted)]
            }
        };
        let table = OpenTable { pieces };
        if table.rows() == 0 && !is_partition(source)? {
            return Err(TableError::Empty { path: source.name().to_path_buf() });
        }
        Ok(table)
    }

    /// How many rows it has.
    pub fn rows(&self) -> u64 {
        self.pieces.iter().flat_map(Piece::rows_of_groups).sum()
    }

    /// The columns that will be read, of each file.
    ///
    /// # Errors
    /// If a file is damaged.
    pub fn schemas(&self) -> Result<Vec<(Arc<Path>, SchemaRef)>, TableError> {
        self.pieces.iter().map(|piece| Ok((piece.path(), piece.schema()?))).collect()
    }

    /// The rows of `range`, in runs: row groups, as far as they lie in it.
    pub fn runs(&self, range: Range<u64>) -> Vec<Run> {
        let mut runs = Vec::new();
        let mut before = 0;
        for (piece, of_piece) in self.pieces.iter().enumerate() {
            let mut first_row = 0;
            for (group, rows) in of_piece.rows_of_groups().into_iter().enumerate() {
                let first = range.start.clamp(before, before + rows) - before;
                let end = range.end.clamp(before, before + rows) - before;
                if end > first {
                    runs.push(Run { piece, group, first, rows: end - first, first_row: first_row + first });
                }
                before += rows;
                first_row += rows;
            }
        }
        runs
    }

    /// The file of a run, or the name of the table in memory.
    pub fn path_of(&self, run: Run) -> Arc<Path> {
        self.pieces[run.piece].path()
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
        self.pieces[run.piece].read(run, batch_size)
    }
}

impl Piece {
    fn path(&self) -> Arc<Path> {
        match self {
            Piece::File(file) => file.path.clone(),
            Piece::Memory(table, _) => table.name.as_path().into(),
        }
    }

    fn schema(&self) -> Result<SchemaRef, TableError> {
        match self {
            Piece::File(file) => file.schema(),
            Piece::Memory(table, columns) => table
                .schema
                .project(columns)
                .map(Arc::new)
                .map_err(|source| file_damaged(&table.name, &source)),
        }
    }

    fn rows_of_groups(&self) -> Vec<u64> {
        match self {
            Piece::File(file) => file.rows_of_groups(),
            Piece::Memory(table, _) => table.batches.iter().map(|batch| batch.num_rows() as u64).collect(),
        }
    }

    fn read(&self, run: Run, batch_size: usize) -> Result<BatchesOfRun, TableError> {
        let rows: Rows = match self {
            Piece::File(file) => Box::new(file.read(run, batch_size)?),
            Piece::Memory(table, columns) => {
                let batch = table.batches[run.group].slice(run.first as usize, run.rows as usize);
                let batch = batch.project(columns).map_err(|source| file_damaged(&table.name, &source))?;
                let starts = (0..batch.num_rows()).step_by(batch_size);
                Box::new(
                    starts.map(move |start| Ok(batch.slice(start, batch_size.min(batch.num_rows() - start)))),
                )
            }
        };
        Ok(BatchesOfRun { path: self.path(), rows, next_row: run.first_row })
    }
}

type Rows = Box<dyn Iterator<Item = Result<RecordBatch, ArrowError>> + Send>;

struct BatchesOfRun {
    path: Arc<Path>,
    rows: Rows,
    next_row: u64,
}

impl Iterator for BatchesOfRun {
    type Item = Result<Batch, TableError>;

    fn next(&mut self) -> Option<Self::Item> {
        let rows = match self.rows.next()? {
            Ok(rows) => rows,
            Err(source) => return Some(Err(file_damaged(&self.path, &source))),
        };
        let first_row = self.next_row;
        self.next_row += rows.num_rows() as u64;
        Some(Ok(Batch { rows, path: self.path.clone(), first_row }))
    }
}

/// A file of a table, open at those of its columns that are wanted.
struct TableFile {
    path: Arc<Path>,
    file: SharedFile,
    metadata: ArrowReaderMetadata,
    columns: ProjectionMask,
}

impl TableFile {
    fn open(path: &Path, stages: &[&str], columns: &[Column]) -> Result<TableFile, TableError> {
        expect_stage(path, stages)?;
        let file = SharedFile::new(open_file(path)?).map_err(|source| TableError::io(path, source))?;
        let metadata = ArrowReaderMetadata::load(&file, ArrowReaderOptions::default())
            .map_err(|source| not_parquet(path, source))?;
        let roots = metadata.parquet_schema().root_schema().get_fields();
        let wanted = |field: &TypePtr| columns.iter().any(|column| column.name == field.name());
        let wanted: Vec<usize> = (0..roots.len()).filter(|&root| wanted(&roots[root])).collect();
        let columns = ProjectionMask::roots(metadata.parquet_schema(), wanted);
        Ok(TableFile { path: path.into(), file, metadata, columns })
    }

    fn rows_of_groups(&self) -> Vec<u64> {
        let groups = self.metadata.metadata().row_groups();
        groups.iter().map(|group| group.num_rows().max(0).unsigned_abs()).collect()
    }

    fn schema(&self) -> Result<SchemaRef, TableError> {
        Ok(arrow_array::RecordBatchReader::schema(&self.build(self.builder())?))
    }

    fn read(&self, run: Run, batch_size: usize) -> Result<ParquetRecordBatchReader, TableError> {
        let mut builder = self.builder().with_batch_size(batch_size).with_row_groups(vec![run.group]);
        if run.rows < self.rows_of_groups()[run.group] {
            builder = builder.with_offset(run.first as usize).with_limit(run.rows as usize);
        }
        self.build(builder)
    }

    fn builder(&self) -> Builder {
        let builder = Builder::new_with_metadata(self.file.clone(), self.metadata.clone());
        builder.with_projection(self.columns.clone())
    }

    fn build(&self, builder: Builder) -> Result<ParquetRecordBatchReader, TableError> {
        builder.build().map_err(|source| not_parquet(&self.path, source))
    }
}

type Builder = ParquetRecordBatchReaderBuilder<SharedFile>;

fn file_damaged(path: &Path, source: &ArrowError) -> TableError {
    not_parquet(path, ParquetError::ArrowError(source.to_string()))
}

impl Batches {
    /// Opens a table: those of `columns` that it has, `batch_size` rows at a time; all of its files must have those of
    /// `required`.
    ///
    /// # Errors
    /// As [`OpenTable::open`], or if a column is missing.
    pub fn open(
        source: &Source,
        stages: &[&str],
        columns: &[Column],
        required: &[Column],
        batch_size: usize,
    ) -> Result<Batches, TableError> {
        let table = OpenTable::open(source, stages, columns)?;
        let schemas = table.schemas()?;
        schemas.iter().try_for_each(|(path, schema)| expect_columns(path, schema, required))?;
        let rows = table.rows();
        let batches = table.runs(0..rows).into_iter().flat_map(move |run| -> BatchIterator {
            match table.batches_of(run, batch_size) {
                Ok(batches) => Box::new(batches),
                Err(error) => Box::new(std::iter::once(Err(error))),
            }
        });
        Ok(Batches { schema: schemas[0].1.clone(), rows, batches: Box::new(batches) })
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

type BatchIterator = Box<dyn Iterator<Item = Result<Batch, TableError>> + Send>;

impl Iterator for Batches {
    type Item = Result<Batch, TableError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.batches.next()
    }
}

/// A narrow table whole. Columns that may be null and are missing in the file become nulls.
///
/// # Errors
/// As [`Batches::open`], or if a column is missing, of another type, or holds a value that it must not.
pub fn read_frame(source: &Source, table: &Table) -> Result<DataFrame, TableError> {
    let batches = Batches::open(source, &[table.stage], table.columns, &[], NARROW_BATCH)?;
    let mut whole = DataFrame::empty();
    for batch in batches {
        let batch = batch?;
        let columns = batch.columns();
        let series = table.columns.iter().map(|column| series(&columns, column));
        let series =
            series.map(|series| Ok(series?.into_column())).collect::<Result<Vec<_>, TableError>>()?;
        let failed = |source| polars_error(&batch.path, &source);
        let frame = DataFrame::new(columns.rows(), series).map_err(failed)?;
        whole = if whole.height() == 0 { frame } else { stack(whole, frame).map_err(failed)? };
    }
    Ok(whole)
}

fn stack(mut above: DataFrame, below: DataFrame) -> polars::prelude::PolarsResult<DataFrame> {
    above.vstack_mut_owned(below)?;
    Ok(above)
}

fn series(columns: &Columns, column: &Column) -> Result<Series, TableError> {
    let name = column.name.into();
    Ok(match (column.kind, column.nullable) {
        (Kind::Text, true) => Series::new(name, columns.optional_text(column)?),
        (Kind::Text, false) => Series::new(name, columns.text(column)?),
        (Kind::Float64, true) => Series::new(name, columns.optional_numbers(column)?),
        (Kind::Float64, false) => Series::new(name, columns.numbers(column)?),
        (Kind::Int64 | Kind::Int32, _) if columns.is_text(column) => Series::new(name, columns.text(column)?),
        (Kind::Int64 | Kind::Int32, _) => Series::new(name, columns.integers(column)?),
        (Kind::Samples, _) => return Err(columns.value_error(0, column, "no narrow table holds samples")),
    })
}

/// Whether a file is a part of a table, and may be without rows.
fn is_partition(source: &Source) -> Result<bool, TableError> {
    match source {
        Source::Path(path) if path.is_file() => Ok(folder::partition_of(path)?.is_some()),
        _ => Ok(false),
    }
}

/// That a file which says by which stage it was made was made by one of these.
fn expect_stage(path: &Path, stages: &[&str]) -> Result<(), TableError> {
    match stamp(path)? {
        Some(stamp) if !stages.contains(&stamp.provenance.stage.as_str()) => Err(TableError::OtherStage {
            path: path.to_path_buf(),
            found: stamp.provenance.stage,
            expected: stages.join(" or "),
        }),
        _ => Ok(()),
    }
}

/// That a schema has the columns a stage cannot do without.
///
/// # Errors
/// With the first one that is missing.
pub fn expect_columns(path: &Path, schema: &SchemaRef, columns: &[Column]) -> Result<(), TableError> {
    match columns.iter().find(|column| schema.field_with_name(column.name).is_err()) {
        Some(column) => Err(missing(path, column)),
        None => Ok(()),
    }
}

fn polars_error(path: &Path, source: &polars::prelude::PolarsError) -> TableError {
    TableError::Write { path: path.to_path_buf(), message: source.to_string() }
}
