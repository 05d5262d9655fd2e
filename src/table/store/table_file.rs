//! One Parquet file of a table, open at those of its columns that are wanted.

use std::path::Path;
use std::sync::Arc;

use arrow_array::{ArrayRef, RecordBatch, RecordBatchOptions};
use arrow_schema::{FieldRef, SchemaRef};
use parquet::arrow::ProjectionMask;
use parquet::arrow::arrow_reader::{
    ArrowReaderMetadata, ParquetRecordBatchReader, ParquetRecordBatchReaderBuilder,
};
use parquet::errors::{ParquetError, Result as ParquetResult};
use parquet::file::metadata::ParquetMetaData;
use parquet::file::reader::Length;
use parquet::file::serialized_reader::SerializedPageReader;

use super::footer::{self, Opened, not_parquet};
use super::guarded::guarded;
use super::limits::check_pages;
use super::lists::Lists;
use super::provenance::recorded_in;
use super::shared_file::SharedFile;
use crate::table::TableError;

/// The file, its description, and the columns.
pub(super) struct TableFile {
    pub path: Arc<Path>,
    /// The columns that will be read.
    pub schema: SchemaRef,
    /// Whether it says by which of our stages it was made.
    pub is_ours: bool,
    file: SharedFile,
    metadata: ArrowReaderMetadata,
    columns: ProjectionMask,
    /// Those that are read straight from their pages.
    lists: Vec<ListColumn>,
}

/// A column of lists of samples.
struct ListColumn {
    /// Among those that will be read.
    place: usize,
    /// Among the columns of the file, as deep as they nest.
    leaf: usize,
    item: FieldRef,
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
        let is_ours = expect_stage(path, metadata.metadata(), stages)?;
        let fields = metadata.schema().fields();
        let wanted: Vec<usize> =
            (0..fields.len()).filter(|&column| is_wanted(fields[column].name())).collect();
        let schema = metadata.schema().project(&wanted).map_err(ParquetError::from);
        let schema = Arc::new(schema.map_err(|source| not_parquet(path, source))?);
        let columns = ProjectionMask::roots(metadata.parquet_schema(), wanted.iter().copied());
        let lists = lists_among(&wanted, &metadata);
        Ok(TableFile { path: path.into(), schema, is_ours, file, metadata, columns, lists })
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
        let path = self.path.clone();
        let open = || self.open_row_group(group, first, rows, batch_size);
        let mut rows = guarded(open).map_err(|source| not_parquet(&path, source))?;
        Ok(std::iter::from_fn(move || {
            guarded(|| rows.next()).map_err(|source| not_parquet(&path, source)).transpose()
        }))
    }

    fn open_row_group(
        &self,
        group: usize,
        first: u64,
        rows: u64,
        batch_size: usize,
    ) -> ParquetResult<RowGroup> {
        self.check(group)?;
        let leaves = self.metadata.parquet_schema();
        let of_group = self.metadata.metadata().row_group(group);
        let lists = |column: &ListColumn| {
            let (file, rows) = (Arc::new(self.file.clone()), of_group.num_rows() as usize);
            let pages = SerializedPageReader::new(file, of_group.column(column.leaf), rows, None)?;
            let lists = Lists::new(column.item.clone(), leaves.column(column.leaf), Box::new(pages), first)?;
            Ok((column.place, lists))
        };
        let is_narrow = |leaf: &usize| {
            self.columns.leaf_included(*leaf) && self.lists.iter().all(|column| column.leaf != *leaf)
        };
        let narrow = ProjectionMask::leaves(leaves, (0..leaves.num_columns()).filter(is_narrow));
        let metadata = self.metadata.clone();
        let mut builder = ParquetRecordBatchReaderBuilder::new_with_metadata(self.file.clone(), metadata)
            .with_batch_size(batch_size)
            .with_projection(narrow)
            .with_row_groups(vec![group]);
        if rows < of_group.num_rows().unsigned_abs() {
            builder = builder.with_offset(first as usize).with_limit(rows as usize);
        }
        Ok(RowGroup {
            schema: self.schema.clone(),
            narrow: builder.build()?,
            lists: self.lists.iter().map(lists).collect::<ParquetResult<_>>()?,
        })
    }

    /// That what will be read of a row group fits into memory.
    fn check(&self, group: usize) -> ParquetResult<()> {
        let group = self.metadata.metadata().row_group(group);
        let wanted = group.columns().iter().enumerate().filter(|(leaf, _)| self.columns.leaf_included(*leaf));
        wanted.into_iter().try_for_each(|(_, column)| check_pages(&self.file, column, group.num_rows()))
    }
}

/// Those of the wanted columns that are lists of samples as our own files hold them.
fn lists_among(wanted: &[usize], metadata: &ArrowReaderMetadata) -> Vec<ListColumn> {
    let (fields, leaves) = (metadata.schema().fields(), metadata.parquet_schema());
    let list_column = |(place, &root): (usize, &usize)| {
        let leaf = (0..leaves.num_columns()).find(|&leaf| leaves.get_column_root_idx(leaf) == root)?;
        let item = Lists::item_of(&fields[root], &leaves.column(leaf))?;
        Some(ListColumn { place, leaf, item })
    };
    wanted.iter().enumerate().filter_map(list_column).collect()
}

/// That a file which says by which stage it was made was made by one of these, if some are given; tells whether it does say so.
fn expect_stage(
    path: &Path,
    metadata: &ParquetMetaData,
    stages: Option<&[&str]>,
) -> Result<bool, TableError> {
    let Some(stages) = stages else { return Ok(false) };
    match recorded_in(path, metadata)?.map(|recorded| recorded.provenance.stage) {
        Some(found) if !stages.contains(&found.as_str()) => {
            Err(TableError::OtherStage { path: path.to_path_buf(), found, expected: stages.join(" or ") })
        }
        found => Ok(found.is_some()),
    }
}

/// Reads some rows of a row group: samples straight from their pages, all else by the library.
struct RowGroup {
    /// All columns, in order.
    schema: SchemaRef,
    /// What reads those that are no lists.
    narrow: ParquetRecordBatchReader,
    /// What reads the others, each with its place among all, ascending.
    lists: Vec<(usize, Lists)>,
}

impl RowGroup {
    /// The next batch, or nothing at the end.
    ///
    /// # Errors
    /// If the pages are damaged, or some columns end before others.
    fn next(&mut self) -> ParquetResult<Option<RecordBatch>> {
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
