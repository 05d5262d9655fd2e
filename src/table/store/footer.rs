//! The end of a Parquet file, which says what is in the whole; or those of a folder.

use std::collections::HashMap;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use arrow_schema::SchemaRef;
use parquet::arrow::arrow_reader::{ArrowReaderMetadata, ArrowReaderOptions};
use parquet::errors::{ParquetError, Result as ParquetResult};
use parquet::file::metadata::{
    ParquetMetaData, ParquetMetaDataOptions, ParquetMetaDataReader, ParquetStatisticsPolicy,
};
use parquet::file::reader::{ChunkReader, Length};
use parquet::file::statistics::Statistics;

use super::guarded::guarded;
use super::limits::{MOST_FOOTER_BYTES, check_footer, check_rows};
use super::shared_file::SharedFile;
use crate::table::TableError;

/// The length of the footer and the magic number, with which a file ends.
const END_BYTES: u64 = 8;
const MAGIC: &[u8] = b"PAR1";

/// What the end of a Parquet file says of the whole.
pub struct Footer {
    /// Rows.
    pub rows: i64,
    /// Row groups.
    pub row_groups: usize,
    /// Size of the file.
    pub bytes: u64,
    /// Columns.
    pub schema: SchemaRef,
    /// What the statistics say of the columns of plain numbers and text.
    pub ranges: HashMap<String, Range>,
}

/// The range of a column.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Range {
    /// Rows without a value.
    pub nulls: u64,
    /// The least floating-point number.
    pub least: Option<f64>,
    pub largest: Option<f64>,
}

impl Range {
    fn of(statistics: &Statistics) -> Range {
        let nulls = statistics.null_count_opt().unwrap_or(0);
        match statistics {
            Statistics::Double(numbers) => {
                Range { nulls, least: numbers.min_opt().copied(), largest: numbers.max_opt().copied() }
            }
            _ => Range { nulls, ..Range::default() },
        }
    }

    fn merge(&mut self, other: &Range) {
        self.nulls += other.nulls;
        self.least = self.least.into_iter().chain(other.least).reduce(f64::min);
        self.largest = self.largest.into_iter().chain(other.largest).reduce(f64::max);
    }
}

impl Footer {
    /// What two files hold together, of the same columns.
    pub(super) fn add(&mut self, other: Footer) {
        self.rows += other.rows;
        self.row_groups += other.row_groups;
        self.bytes += other.bytes;
        for (column, range) in other.ranges {
            self.ranges.entry(column).or_default().merge(&range);
        }
    }
}

pub(super) fn of_file(path: &Path) -> Result<Footer, TableError> {
    let Opened { file, metadata } = open_keeping(path, ParquetStatisticsPolicy::KeepAll)?;
    let schema = metadata.schema().clone();
    let metadata = metadata.metadata();
    Ok(Footer {
        rows: metadata.file_metadata().num_rows(),
        row_groups: metadata.num_row_groups(),
        bytes: file.len(),
        schema,
        ranges: ranges(metadata),
    })
}

fn ranges(metadata: &ParquetMetaData) -> HashMap<String, Range> {
    let mut ranges: HashMap<String, Range> = HashMap::new();
    for column in metadata.row_groups().iter().flat_map(|group| group.columns()) {
        if let ([name], Some(statistics)) = (column.column_path().parts(), column.statistics()) {
            ranges.entry(name.clone()).or_default().merge(&Range::of(statistics));
        }
    }
    ranges
}

/// A file and what its footer says.
pub(super) struct Opened {
    pub file: SharedFile,
    pub metadata: ArrowReaderMetadata,
}

/// Opens a Parquet file and reads its footer, without statistics: they take more room than all else, for each column of
/// each row group.
pub(super) fn open(path: &Path) -> Result<Opened, TableError> {
    open_keeping(path, ParquetStatisticsPolicy::SkipAll)
}

fn open_keeping(path: &Path, statistics: ParquetStatisticsPolicy) -> Result<Opened, TableError> {
    let options = ParquetMetaDataOptions::new()
        .with_column_stats_policy(statistics.clone())
        .with_encoding_stats_policy(statistics.clone())
        .with_size_stats_policy(statistics);
    let file = SharedFile::new(open_file(path)?).map_err(|source| TableError::io(path, source))?;
    let metadata = guarded(|| metadata(&file, &options)).map_err(|source| not_parquet(path, source))?;
    Ok(Opened { file, metadata })
}

fn metadata(file: &SharedFile, options: &ParquetMetaDataOptions) -> ParquetResult<ArrowReaderMetadata> {
    let cut_off = || ParquetError::EOF("the file is cut off, or no Parquet file".to_string());
    let footer_end = file.len().checked_sub(END_BYTES).ok_or_else(cut_off)?;
    let end = file.get_bytes(footer_end, END_BYTES as usize)?;
    let (length, magic) = end.split_at(end.len() - MAGIC.len());
    let length = length.iter().rev().fold(0, |length, &byte| length << 8 | u64::from(byte));
    if magic != MAGIC || length > MOST_FOOTER_BYTES {
        return Err(cut_off());
    }
    let start = footer_end.checked_sub(length).ok_or_else(cut_off)?;
    let footer = file.get_bytes(start, length as usize)?;
    check_footer(&footer)?;
    let metadata = ParquetMetaDataReader::decode_metadata_with_options(&footer, Some(options))?;
    let metadata = ArrowReaderMetadata::try_new(metadata.into(), ArrowReaderOptions::default())?;
    check_rows(&metadata)?;
    Ok(metadata)
}

fn open_file(path: &Path) -> Result<File, TableError> {
    match File::open(path) {
        Ok(file) if file.metadata().is_ok_and(|metadata| metadata.is_dir()) => {
            Err(TableError::io(path, std::io::Error::other("a folder; expected a Parquet file")))
        }
        Ok(file) => Ok(file),
        Err(source) if source.kind() == std::io::ErrorKind::NotFound => Err(TableError::Missing {
            path: path.to_path_buf(),
            hint: match Path::new("out").join(path) {
                of_run if of_run.exists() => format!("there is {}: name that", of_run.display()),
                _ => "run the stage that makes it first, or name another file".to_string(),
            },
        }),
        Err(source) => Err(TableError::io(path, source)),
    }
}

/// Whether a file was one of Parquet once, for all that is wrong with it.
fn begins_as_parquet(path: &Path) -> bool {
    let mut start = [0; MAGIC.len()];
    File::open(path).is_ok_and(|mut file| file.read_exact(&mut start).is_ok() && start == *MAGIC)
}

pub(super) fn not_parquet(path: &Path, source: ParquetError) -> TableError {
    let path = path.to_path_buf();
    let message = source.to_string();
    if message.contains("Disabled feature") {
        return TableError::Codec { path, message };
    }
    if !begins_as_parquet(&path) {
        let expected = "a table that rockfrag made, or one with its columns; CSV is for import-motions, --structures and --hazard".to_string();
        return TableError::NoParquet { path, expected };
    }
    TableError::NotParquet { path, cause: source }
}
