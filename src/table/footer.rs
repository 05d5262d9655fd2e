//! The end of a Parquet file, which says what is in the whole; or those of a folder.

use std::collections::HashMap;
use std::fs::File;
use std::path::Path;

use arrow_schema::SchemaRef;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::errors::ParquetError;
use parquet::file::metadata::{ParquetMetaData, ParquetMetaDataReader};
use parquet::file::statistics::Statistics;

use super::TableError;
use super::folder;

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
    /// The largest.
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
    fn add(&mut self, other: Footer) {
        self.rows += other.rows;
        self.row_groups += other.row_groups;
        self.bytes += other.bytes;
        for (column, range) in other.ranges {
            self.ranges.entry(column).or_default().merge(&range);
        }
    }
}

/// Reads only the end of a Parquet file, or of each in a folder.
///
/// # Errors
/// If it is missing or no Parquet file.
pub fn footer(path: &Path) -> Result<Footer, TableError> {
    let files = folder::files(path)?;
    let mut whole = of_file(&files[0])?;
    for file in &files[1..] {
        whole.add(of_file(file)?);
    }
    Ok(whole)
}

fn of_file(path: &Path) -> Result<Footer, TableError> {
    let file = open_file(path)?;
    let bytes = file.metadata().map_err(|source| TableError::io(path, source))?.len();
    let builder =
        ParquetRecordBatchReaderBuilder::try_new(file).map_err(|source| not_parquet(path, source))?;
    let metadata = builder.metadata();
    Ok(Footer {
        rows: metadata.file_metadata().num_rows(),
        row_groups: metadata.num_row_groups(),
        bytes,
        schema: builder.schema().clone(),
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

/// The footer of a Parquet file as the library gives it.
pub(super) fn open_metadata(path: &Path) -> Result<ParquetMetaData, TableError> {
    let file = open_file(path)?;
    ParquetMetaDataReader::new().parse_and_finish(&file).map_err(|source| not_parquet(path, source))
}

pub(super) fn open_file(path: &Path) -> Result<File, TableError> {
    match File::open(path) {
        Ok(file) if file.metadata().is_ok_and(|metadata| metadata.is_dir()) => {
            Err(TableError::io(path, std::io::Error::other("a folder; expected a Parquet file")))
        }
        Ok(file) => Ok(file),
        Err(source) if source.kind() == std::io::ErrorKind::NotFound => Err(TableError::Missing {
            path: path.to_path_buf(),
            hint: "run the stage that makes it first, or name another file with --in".to_string(),
        }),
        Err(source) => Err(TableError::io(path, source)),
    }
}

pub(super) fn not_parquet(path: &Path, source: ParquetError) -> TableError {
    let path = path.to_path_buf();
    let message = source.to_string();
    if message.contains("Disabled feature") {
        return TableError::Codec { path, message };
    }
    TableError::NotParquet { path, source }
}
