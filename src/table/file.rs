//! A table on disk: a Parquet file, or a folder of them in the order of their names.

use std::borrow::Cow;
use std::collections::HashSet;
use std::error::Error;
use std::fmt;
use std::fs::{DirEntry, File};
use std::io::{self, ErrorKind, Read};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::Arc;

use arrow_schema::SchemaRef;
use parquet::arrow::ProjectionMask;
use parquet::arrow::arrow_reader::{
    ArrowReaderMetadata, ArrowReaderOptions, ParquetRecordBatchReader, ParquetRecordBatchReaderBuilder,
};
use parquet::file::metadata::RowGroupMetaData;

use super::TableError;
use super::checksums::expect_undamaged;
use super::columns::Batch;
use super::provenance::Provenance;
use crate::source;

/// Largest size of the wanted columns of a row group: larger ones are damaged, or exceed the memory.
const MOST_BYTES: i64 = 4 << 30;
/// Rows per batch of a narrow table.
const NARROW_BATCH: usize = 8192;

/// One of `of` equal parts of a table, counted from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Partition {
    pub index: usize,
    pub of: usize,
}

impl FromStr for Partition {
    type Err = String;

    fn from_str(text: &str) -> Result<Partition, String> {
        let parts = text.split_once('/');
        let part = parts.and_then(|(i, n)| Some(Partition { index: i.parse().ok()?, of: n.parse().ok()? }));
        let expected = || "expected i/n with i from 0 to n - 1, such as 0/4".to_string();
        part.filter(|part| part.index < part.of).ok_or_else(expected)
    }
}

impl<'de> serde::Deserialize<'de> for Partition {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Partition, D::Error> {
        <String as serde::Deserialize>::deserialize(deserializer)?.parse().map_err(serde::de::Error::custom)
    }
}

impl serde::Serialize for Partition {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl fmt::Display for Partition {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.of)
    }
}

impl Partition {
    pub fn file_name(self) -> String {
        format!("part-{:05}.parquet", self.index)
    }

    /// Returns its file in a folder: the one of that name, or else the one of that number among as many.
    pub fn file_of(self, folder: &Path) -> Result<PathBuf, TableError> {
        let named = folder.join(self.file_name());
        let files = if named.exists() { Vec::new() } else { tables(folder)? };
        let numbered = files.get(self.index).filter(|_| files.len() == self.of);
        Ok(numbered.cloned().unwrap_or(named))
    }
}

/// A table open for reading, by several threads if needed.
pub struct ParquetTable {
    files: Vec<TableFile>,
    /// Rows to read; all of them without a partition.
    rows: Range<usize>,
}

struct TableFile {
    path: Arc<Path>,
    metadata: ArrowReaderMetadata,
    /// Which partition it is, a whole table being the only one, and the key that all partitions of its table
    /// share; none of a table of another program.
    part: Option<(Partition, String)>,
}

/// Rows of one row group.
#[derive(Debug, Clone, PartialEq)]
pub struct RowGroup {
    file: usize,
    group: usize,
    pub rows: Range<usize>,
    /// First row, counted in the file.
    pub first_row: usize,
}

impl ParquetTable {
    /// Opens a file, or a folder with the parts of one table.
    pub fn open(path: &Path) -> Result<ParquetTable, TableError> {
        let files = tables(path)?.into_iter().map(TableFile::open);
        let mut files = files.collect::<Result<Vec<_>, TableError>>()?;
        files.sort_by_key(|file| file.part.as_ref().map(|(part, _)| part.index));
        if path.is_dir()
            && let Some(problem) = unlike_partitions(&files)
        {
            return Err(TableError::table(path, problem));
        }
        let total = files.iter().map(TableFile::rows).sum();
        Ok(ParquetTable { files, rows: 0..total })
    }

    /// Opens one partition: a range of rows of a file, or one file of a folder.
    pub fn open_partition(path: &Path, partition: Option<Partition>) -> Result<ParquetTable, TableError> {
        let Some(wanted) = partition.filter(|_| path.is_dir()) else {
            return Ok(ParquetTable::open(path)?.part(partition));
        };
        let file = wanted.file_of(path)?;
        let table = ParquetTable::open(&file)?;
        match table.files[0].part.as_ref().filter(|(made, _)| *made != wanted) {
            Some((made, _)) => Err(TableError::table(&file, format!("partition {made}; expected {wanted}"))),
            None => Ok(table),
        }
    }

    pub fn part(self, partition: Option<Partition>) -> ParquetTable {
        let Some(Partition { index, of }) = partition else { return self };
        let at = |index: usize| (self.rows() as u128 * index as u128 / of as u128) as usize;
        ParquetTable { rows: at(index)..at(index + 1), ..self }
    }

    pub fn head(self, most: usize) -> ParquetTable {
        ParquetTable { rows: 0..most.min(self.rows()), ..self }
    }

    pub fn expect<'a>(&self, columns: impl IntoIterator<Item = &'a str> + Clone) -> Result<(), TableError> {
        for TableFile { path, metadata, .. } in &self.files {
            let mut columns = columns.clone().into_iter();
            if let Some(missing) = columns.find(|column| metadata.schema().index_of(column).is_err()) {
                return Err(TableError::missing_column(path, missing));
            }
        }
        Ok(())
    }

    pub fn rows(&self) -> usize {
        self.rows.len()
    }

    pub fn metadata(&self) -> &ArrowReaderMetadata {
        &self.files[0].metadata
    }

    pub fn schema(&self) -> &SchemaRef {
        self.metadata().schema()
    }

    pub fn row_groups(&self) -> Vec<RowGroup> {
        let mut groups = Vec::new();
        let mut before = 0;
        for (file, table_file) in self.files.iter().enumerate() {
            let mut first_row = 0;
            for (group, metadata) in table_file.metadata.metadata().row_groups().iter().enumerate() {
                let count = metadata.num_rows() as usize;
                let at = |row: usize| row.clamp(before, before + count) - before;
                let rows = at(self.rows.start)..at(self.rows.end);
                if !rows.is_empty() {
                    groups.push(RowGroup { file, group, first_row: first_row + rows.start, rows });
                }
                (before, first_row) = (before + count, first_row + count);
            }
        }
        groups
    }

    /// Reads the `wanted` columns of a row group in batches of `batch_size` rows, up to the first error.
    pub fn read(
        &self,
        group: &RowGroup,
        wanted: &dyn Fn(&str) -> bool,
        batch_size: usize,
    ) -> impl Iterator<Item = Result<Batch, TableError>> + Send + use<> {
        let (path, mut first_row) = (self.files[group.file].path.clone(), group.first_row);
        let (mut reader, error) = match self.reader(group, wanted, batch_size) {
            Ok(reader) => (Some(reader), None),
            Err(error) => (None, Some(Err(error))),
        };
        let batches = std::iter::from_fn(move || {
            let reader = reader.as_mut()?;
            let rows = guarded(&path, || reader.next().transpose()).transpose()?;
            Some(rows.map(|rows| {
                let batch = Batch { path: path.clone(), first_row, rows };
                first_row += batch.rows.num_rows();
                batch
            }))
        });
        batches.chain(error)
    }

    fn reader(
        &self,
        group: &RowGroup,
        wanted: &dyn Fn(&str) -> bool,
        batch_size: usize,
    ) -> Result<ParquetRecordBatchReader, TableError> {
        let TableFile { path, metadata, .. } = &self.files[group.file];
        let schema = metadata.parquet_schema();
        let roots = schema.root_schema().get_fields().iter().enumerate();
        let roots = roots.filter(|(_, root)| wanted(root.name())).map(|(place, _)| place);
        let mask = ProjectionMask::roots(schema, roots);
        expect_small(path, metadata.metadata().row_group(group.group), &mask)?;
        let file = File::open(path).map_err(|source| TableError::io(path, source))?;
        guarded(path, || {
            expect_undamaged(&file, metadata.metadata(), group.group, &mask)?;
            ParquetRecordBatchReaderBuilder::new_with_metadata(file, metadata.clone())
                .with_projection(mask)
                .with_row_groups(vec![group.group])
                .with_offset(group.rows.start)
                .with_limit(group.rows.len())
                .with_batch_size(batch_size)
                .build()
        })
    }

    pub fn batches<'a>(
        &'a self,
        wanted: impl Fn(&str) -> bool + Send + 'a,
    ) -> impl Iterator<Item = Result<Batch, TableError>> + Send + 'a {
        let groups = self.row_groups().into_iter();
        groups.flat_map(move |group| self.read(&group, &wanted, NARROW_BATCH))
    }
}

impl TableFile {
    fn open(path: PathBuf) -> Result<TableFile, TableError> {
        let metadata = metadata(&path)?;
        let mut known = HashSet::new();
        if let Some(field) = metadata.schema().fields().iter().find(|field| !known.insert(field.name())) {
            let problem = format!("two columns are called '{}'; leave out one", field.name());
            return Err(TableError::table(&path, problem));
        }
        let part = Provenance::from_footer(metadata.metadata()).map(|made| {
            let part = made.partition().and_then(|part| part.parse().ok());
            (part.unwrap_or(Partition { index: 0, of: 1 }), made.whole())
        });
        Ok(TableFile { path: path.into(), metadata, part })
    }

    fn rows(&self) -> usize {
        self.metadata.metadata().row_groups().iter().map(|group| group.num_rows() as usize).sum()
    }

    fn name(&self) -> Cow<'_, str> {
        self.path.file_name().unwrap_or_default().to_string_lossy()
    }
}

/// Reads the footer of a Parquet file, with plain Parquet types: the Arrow schema is ignored.
pub fn metadata(path: &Path) -> Result<ArrowReaderMetadata, TableError> {
    // A pipe would wait for its writer.
    if !path.metadata().map_err(|source| TableError::io(path, source))?.is_file() {
        return Err(TableError::table(path, "a folder, pipe or device; expected a Parquet file"));
    }
    let file = File::open(path).map_err(|source| TableError::io(path, source))?;
    let mut start = [0; 4];
    (&file).read(&mut start).map_err(|source| TableError::io(path, source))?;
    if start != *b"PAR1" {
        return Err(TableError::table(path, "not a Parquet file; expected Parquet"));
    }
    let options = ArrowReaderOptions::new().with_skip_arrow_metadata(true);
    let metadata = guarded(path, || ArrowReaderMetadata::load(&file, options))?;
    match metadata.metadata().row_groups().iter().find(|group| group.num_rows() < 0) {
        Some(group) => Err(TableError::parquet(path, format!("a row group of {} rows", group.num_rows()))),
        None => Ok(metadata),
    }
}

/// Returns the files and folders in a folder that are not hidden, in the order of their names.
pub fn entries(folder: &Path) -> Result<Vec<PathBuf>, TableError> {
    let entries = std::fs::read_dir(folder).and_then(|entries| entries.collect::<io::Result<Vec<_>>>());
    let entries = entries.map_err(|source| TableError::io(folder, source))?;
    let mut paths: Vec<PathBuf> = entries.iter().map(DirEntry::path).collect();
    paths.retain(|path| path.file_name().is_some_and(|name| !name.to_string_lossy().starts_with('.')));
    paths.sort_unstable();
    Ok(paths)
}

/// Returns a file itself, or the Parquet files of a folder in the order of their names.
pub fn tables(path: &Path) -> Result<Vec<PathBuf>, TableError> {
    if !path.is_dir() {
        return Ok(vec![path.to_path_buf()]);
    }
    let files = entries(path)?;
    let is_of_value = |of: &&PathBuf| {
        of.is_dir() && of.strip_prefix(path).is_ok_and(|name| name.to_string_lossy().contains('='))
    };
    if let Some(part) = files.iter().find(is_of_value) {
        let (part, whole) = (part.file_name().unwrap_or_default().display(), path.display());
        let problem = format!(
            "a column is in the names of its folders ({part}); expected files with all columns, in DuckDB by \
             COPY (FROM '{whole}/**/*.parquet') TO 'all.parquet'"
        );
        return Err(TableError::table(path, problem));
    }
    Ok(files.into_iter().filter(|path| is_table(path)).collect())
}

pub fn is_table(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "parquet")
}

/// What shows that files are not all the partitions of one table: rows are sorted by magnitude, so that a gap
/// would bias fits.
fn unlike_partitions(files: &[TableFile]) -> Option<String> {
    if files.is_empty() {
        return Some("a folder without Parquet files".to_string());
    }
    let (first, (Partition { of, .. }, whole)) =
        files.iter().find_map(|file| Some((file, file.part.as_ref()?)))?;
    let is_other = |file: &&TableFile| file.part.as_ref().is_none_or(|(_, key)| key != whole);
    if let Some(other) = files.iter().find(is_other) {
        return Some(format!(
            "{} and {} are no parts of one table: they were made by other options, of other files or by \
             another program",
            first.name(),
            other.name()
        ));
    }
    if let Some([one, other]) = files.array_windows().find(|[one, other]| one.part == other.part) {
        return Some(format!("{} and {} have the same rows; leave out one", one.name(), other.name()));
    }
    let parts: Vec<Partition> = files.iter().flat_map(|file| Some(file.part.as_ref()?.0)).collect();
    let mut all = (0..*of).map(|index| Partition { index, of: *of });
    let missing = all.find(|part| !parts.contains(part))?;
    Some(format!("partition {missing} is missing; make it with --partition {missing}"))
}

fn expect_small(path: &Path, group: &RowGroupMetaData, wanted: &ProjectionMask) -> Result<(), TableError> {
    let columns = group.columns().iter().enumerate().filter(|(leaf, _)| wanted.leaf_included(*leaf));
    let bytes: i64 = columns.map(|(_, column)| column.uncompressed_size().max(0)).sum();
    if bytes > MOST_BYTES {
        let cause = format!("a row group of {bytes} bytes; expected {MOST_BYTES} or less");
        return Err(TableError::parquet(path, cause));
    }
    Ok(())
}

/// Calls `read`; a panic of the decoder is an error of a damaged file.
fn guarded<T, E: Error>(path: &Path, read: impl FnOnce() -> Result<T, E>) -> Result<T, TableError> {
    match source::guarded(read) {
        Some(Ok(read)) => Ok(read),
        Some(Err(error)) => Err(match error.source().and_then(|cause| cause.downcast_ref()) {
            Some(cause) if io::Error::kind(cause) != ErrorKind::UnexpectedEof => {
                TableError::io(path, io::Error::new(cause.kind(), cause.to_string()))
            }
            _ => TableError::parquet(path, error),
        }),
        None => Err(TableError::parquet(path, "it is damaged")),
    }
}
