//! One Parquet file of a table, open at those of its columns that are wanted.

use std::path::Path;
use std::sync::Arc;

use arrow_array::RecordBatch;
use arrow_schema::SchemaRef;
use parquet::arrow::ProjectionMask;
use parquet::arrow::arrow_reader::{ArrowReaderMetadata, ParquetRecordBatchReaderBuilder};
use parquet::errors::{ParquetError, Result as ParquetResult};
use parquet::file::metadata::ParquetMetaData;
use parquet::file::reader::Length;
use parquet::schema::types::TypePtr;

use super::TableError;
use super::footer::{self, Opened, not_parquet};
use super::guarded::guarded;
use super::limits::check_pages;
use super::provenance::stamp_in;
use super::shared_file::SharedFile;

/// The file, its description, and the columns.
pub(super) struct TableFile {
    pub path: Arc<Path>,
    file: SharedFile,
    metadata: ArrowReaderMetadata,
    columns: ProjectionMask,
}

impl TableFile {
    /// Opens a file of one of `stages`, or of any without them. A file that another program wrote has no stage and is taken by
    /// its columns.
    ///
    /// # Errors
    /// If the file is missing, unreadable, or the output of another stage.
    pub fn open(
        path: &Path,
        stages: Option<&[&str]>,
        is_wanted: impl Fn(&str) -> bool,
    ) -> Result<TableFile, TableError> {
        let Opened { file, metadata } = footer::open(path)?;
        if let Some(stages) = stages {
            expect_stage(path, metadata.metadata(), stages)?;
        }
        let roots = metadata.parquet_schema().root_schema().get_fields();
        let wanted = |field: &TypePtr| is_wanted(field.name());
        let wanted: Vec<usize> = (0..roots.len()).filter(|&root| wanted(&roots[root])).collect();
        let columns = ProjectionMask::roots(metadata.parquet_schema(), wanted);
        Ok(TableFile { path: path.into(), file, metadata, columns })
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

    /// That it announces no more rows than it has bytes, since rows that differ take more; or `few`, which may be as small as they
    /// like.
    ///
    /// # Errors
    /// If it announces more.
    pub fn expect_rows(&self, few: u64) -> Result<(), TableError> {
        let (rows, bytes) = (self.rows_of_groups().iter().sum(), self.file.len());
        if rows > bytes.max(few) {
            return Err(TableError::TooManyRows { path: self.path.to_path_buf(), rows, bytes });
        }
        Ok(())
    }

    /// `rows` rows of a row group from its row `first` on, `batch_size` at a time.
    ///
    /// # Errors
    /// If the file is damaged.
    pub fn read(
        &self,
        group: usize,
        first: u64,
        rows: u64,
        batch_size: usize,
    ) -> Result<impl Iterator<Item = Result<RecordBatch, TableError>> + Send + use<>, TableError> {
        let build = || {
            self.check(group)?;
            let mut builder = self.builder(batch_size).with_row_groups(vec![group]);
            if rows < self.rows_of_groups()[group] {
                builder = builder.with_offset(first as usize).with_limit(rows as usize);
            }
            builder.build()
        };
        let path = self.path.clone();
        let mut reader = guarded(build).map_err(|source| not_parquet(&path, source))?;
        Ok(std::iter::from_fn(move || {
            let decoded = guarded(|| {
                let decoded = reader.next().transpose();
                decoded.map_err(|source| ParquetError::ArrowError(source.to_string()))
            });
            decoded.map_err(|source| not_parquet(&path, source)).transpose()
        }))
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
