//! Reads a table batch by batch, or a narrow one whole.

use std::path::{Path, PathBuf};

use arrow_array::RecordBatch;
use arrow_schema::SchemaRef;
use parquet::arrow::ProjectionMask;
use parquet::arrow::arrow_reader::{
    ArrowReaderMetadata, ParquetRecordBatchReader, ParquetRecordBatchReaderBuilder,
};
use parquet::errors::{ParquetError, Result as ParquetResult};
use parquet::file::metadata::ParquetMetaData;
use parquet::file::reader::Length;
use parquet::schema::types::TypePtr;
use polars::prelude::{DataFrame, IntoColumn, NamedFrom, Series};

use super::TableError;
use super::columns::{Columns, missing};
use super::footer::{self, Opened, not_parquet};
use super::guarded::guarded;
use super::limits::check_pages;
use super::provenance::stamp_in;
use super::schema::{Column, Kind, Table};
use super::shared_file::SharedFile;

/// Rows of a narrow table that are decoded at once.
const NARROW_BATCH: usize = 8192;

/// A file of a table, open at those of its columns that are wanted.
pub struct TableFile {
    path: PathBuf,
    file: SharedFile,
    metadata: ArrowReaderMetadata,
    columns: ProjectionMask,
}

/// The batches of a file in order.
pub struct Batches {
    path: PathBuf,
    reader: ParquetRecordBatchReader,
    schema: SchemaRef,
    rows: u64,
    next_row: u64,
}

/// A batch and the row of the file with which it begins.
pub struct Batch {
    /// The rows.
    pub rows: RecordBatch,
    /// The number of rows before them.
    pub first_row: u64,
}

impl TableFile {
    /// Opens the file of a table at those of `columns` that it has.
    ///
    /// # Errors
    /// If the file is missing, unreadable, empty, or the output of a stage other than `stages`. A file that another
    /// program wrote has no stage and is taken by its columns.
    pub fn open(path: &Path, stages: &[&str], columns: &[Column]) -> Result<TableFile, TableError> {
        TableFile::open_at(path, stages, |name| columns.iter().any(|column| column.name == name))
    }

    /// The same at the columns whose names are wanted.
    ///
    /// # Errors
    /// As [`TableFile::open`].
    pub fn open_at(
        path: &Path,
        stages: &[&str],
        is_wanted: impl Fn(&str) -> bool,
    ) -> Result<TableFile, TableError> {
        let Opened { file, metadata } = footer::open(path)?;
        expect_stage(path, metadata.metadata(), stages)?;
        if metadata.metadata().file_metadata().num_rows() <= 0 {
            return Err(TableError::Empty { path: path.to_path_buf() });
        }
        let roots = metadata.parquet_schema().root_schema().get_fields();
        let wanted = |field: &TypePtr| is_wanted(field.name());
        let wanted: Vec<usize> = (0..roots.len()).filter(|&root| wanted(&roots[root])).collect();
        let columns = ProjectionMask::roots(metadata.parquet_schema(), wanted);
        Ok(TableFile { path: path.to_path_buf(), file, metadata, columns })
    }

    /// The columns that will be read.
    ///
    /// # Errors
    /// If the file is damaged.
    pub fn schema(&self) -> Result<SchemaRef, TableError> {
        let reader = guarded(|| self.builder(1).build()).map_err(|source| not_parquet(&self.path, source))?;
        Ok(arrow_array::RecordBatchReader::schema(&reader))
    }

    /// How many rows each of its row groups has.
    pub fn rows_of_groups(&self) -> Vec<u64> {
        let groups = self.metadata.metadata().row_groups();
        groups.iter().map(|group| group.num_rows().max(0).unsigned_abs()).collect()
    }

    /// The rows of one row group, `batch_size` at a time.
    ///
    /// # Errors
    /// If the file is damaged.
    pub fn row_group(&self, group: usize, batch_size: usize) -> Result<Batches, TableError> {
        let rows = self.rows_of_groups();
        let first_row = rows[..group].iter().sum();
        self.read(batch_size, rows[group], first_row, vec![group])
    }

    /// All rows, `batch_size` at a time.
    ///
    /// # Errors
    /// If the file is damaged.
    pub fn batches(&self, batch_size: usize) -> Result<Batches, TableError> {
        let metadata = self.metadata.metadata();
        let rows = metadata.file_metadata().num_rows();
        self.read(batch_size, rows.unsigned_abs(), 0, (0..metadata.num_row_groups()).collect())
    }

    /// All rows, to be held as a whole.
    ///
    /// # Errors
    /// If the file is damaged, or announces more rows than it has bytes: rows that differ take more.
    pub fn whole(&self) -> Result<Batches, TableError> {
        let (rows, bytes) = (self.rows_of_groups().iter().sum(), self.file.len());
        if rows > bytes {
            return Err(TableError::TooManyRows { path: self.path.clone(), rows, bytes });
        }
        self.batches(NARROW_BATCH)
    }

    fn read(
        &self,
        batch_size: usize,
        rows: u64,
        next_row: u64,
        groups: Vec<usize>,
    ) -> Result<Batches, TableError> {
        let build = || {
            groups.iter().try_for_each(|&group| self.check(group))?;
            self.builder(batch_size).with_row_groups(groups).build()
        };
        let reader = guarded(build).map_err(|source| not_parquet(&self.path, source))?;
        let schema = arrow_array::RecordBatchReader::schema(&reader);
        Ok(Batches { path: self.path.clone(), reader, schema, rows, next_row })
    }

    fn builder(&self, batch_size: usize) -> ParquetRecordBatchReaderBuilder<SharedFile> {
        ParquetRecordBatchReaderBuilder::new_with_metadata(self.file.clone(), self.metadata.clone())
            .with_batch_size(batch_size)
            .with_projection(self.columns.clone())
    }

    /// That what will be read of a row group fits into memory.
    fn check(&self, group: usize) -> ParquetResult<()> {
        let group = self.metadata.metadata().row_group(group);
        let wanted = group.columns().iter().enumerate().filter(|(leaf, _)| self.columns.leaf_included(*leaf));
        wanted.into_iter().try_for_each(|(_, column)| check_pages(&self.file, column, group.num_rows()))
    }
}

impl Batches {
    /// Opens the file of a table: those of `columns` that it has, `batch_size` rows at a time.
    ///
    /// # Errors
    /// As [`TableFile::open`].
    pub fn open(
        path: &Path,
        stages: &[&str],
        columns: &[Column],
        batch_size: usize,
    ) -> Result<Batches, TableError> {
        TableFile::open(path, stages, columns)?.batches(batch_size)
    }

    /// Opens the file of a table that is then held as a whole.
    ///
    /// # Errors
    /// As [`TableFile::open`] and [`TableFile::whole`].
    pub fn open_whole(path: &Path, table: &Table, stages: &[&str]) -> Result<Batches, TableError> {
        TableFile::open(path, stages, table.columns)?.whole()
    }

    /// How many rows the file has.
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
        let decoded = guarded(|| {
            let decoded = self.reader.next().transpose();
            decoded.map_err(|source| ParquetError::ArrowError(source.to_string()))
        });
        let rows = match decoded {
            Ok(rows) => rows?,
            Err(source) => return Some(Err(not_parquet(&self.path, source))),
        };
        let first_row = self.next_row;
        self.next_row += rows.num_rows() as u64;
        Some(Ok(Batch { rows, first_row }))
    }
}

/// The batches of any narrow table with all its columns, whoever wrote it.
///
/// # Errors
/// If the file is missing or unreadable.
pub fn read_any(path: &Path) -> Result<Vec<RecordBatch>, TableError> {
    let Opened { file, metadata } = footer::open(path)?;
    let file = TableFile { path: path.to_path_buf(), file, metadata, columns: ProjectionMask::all() };
    file.whole()?.map(|batch| Ok(batch?.rows)).collect()
}

/// A narrow table whole. Columns that may be null and are missing in the file become nulls.
///
/// # Errors
/// As [`Batches::open`], or if a column is missing, of another type, or holds a value that it must not.
pub fn read_frame(path: &Path, table: &Table) -> Result<DataFrame, TableError> {
    read_frame_of(path, table, &[table.stage])
}

/// A narrow table whole, as [`read_frame`], where other stages may have made it too.
///
/// # Errors
/// As there.
pub fn read_frame_of(path: &Path, table: &Table, stages: &[&str]) -> Result<DataFrame, TableError> {
    let batches = Batches::open_whole(path, table, stages)?;
    let mut whole = DataFrame::empty();
    for batch in batches {
        let Batch { rows, first_row } = batch?;
        let columns = Columns::new(path, &rows, first_row);
        let series = table.columns.iter().map(|column| series(&columns, column));
        let series =
            series.map(|series| Ok(series?.into_column())).collect::<Result<Vec<_>, TableError>>()?;
        let frame = DataFrame::new(columns.rows(), series).map_err(|source| polars_error(path, &source))?;
        whole =
            if first_row == 0 { frame } else { stack(whole, frame).map_err(|s| polars_error(path, &s))? };
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

/// That a file which says by which stage it was made was made by one of these.
fn expect_stage(path: &Path, metadata: &ParquetMetaData, stages: &[&str]) -> Result<(), TableError> {
    match stamp_in(path, metadata)? {
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
