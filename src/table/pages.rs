//! The pages of a table. A flipped bit in them would be another number without a word, so our tables have a
//! checksum of each column of each row group in the footer; other programs may have written one into each
//! page, which Parquet's reader compares.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use bytes::Bytes;
use parquet::arrow::ProjectionMask;
use parquet::errors::Result;
use parquet::file::metadata::{KeyValue, ParquetMetaData, RowGroupMetaData};
use parquet::file::reader::{ChunkReader, Length};

use super::TableError;
use super::provenance::is_ours;

/// Key of the checksums among the key-value metadata.
const KEY: &str = "rockfrag_checksums";
/// Hexadecimal digits of a checksum.
const DIGITS: usize = 8;

fn checksum(column: &[u8]) -> String {
    blake3::hash(column).to_hex()[..DIGITS].to_string()
}

/// Computes the checksums of row groups that are in the file, column by column.
pub fn checksums(file: &File, groups: &[RowGroupMetaData]) -> Result<KeyValue> {
    let mut all = String::new();
    for column in groups.iter().flat_map(RowGroupMetaData::columns) {
        let (start, length) = column.byte_range();
        all += &checksum(&file.get_bytes(start, length as usize)?);
    }
    Ok(KeyValue::new(KEY.to_string(), all))
}

/// The pages of some columns of a row group: in memory and compared with their checksums, or in the file if
/// it has none.
pub struct Pages {
    file: File,
    /// Columns, and where they begin in the file.
    checked: Vec<(u64, Bytes)>,
}

impl Pages {
    pub fn open(
        path: &Path,
        metadata: &ParquetMetaData,
        group: usize,
        wanted: &ProjectionMask,
    ) -> std::result::Result<Pages, TableError> {
        let file = File::open(path).map_err(|source| TableError::io(path, source))?;
        let mut pages = Pages { file, checked: Vec::new() };
        let Some(checksums) = written(metadata) else { return Ok(pages) };
        let columns = metadata.row_group(group).columns();
        for (leaf, column) in columns.iter().enumerate().filter(|(leaf, _)| wanted.leaf_included(*leaf)) {
            let (start, length) = column.byte_range();
            let found = pages.file.get_bytes(start, length as usize);
            let found = found.map_err(|cause| TableError::parquet(path, cause))?;
            let first = DIGITS * (group * columns.len() + leaf);
            if checksums.get(first..first + DIGITS) != Some(&checksum(&found)) {
                let (name, group) = (column.column_path().parts()[0].as_str(), group + 1);
                let damage = format!("column '{name}' of row group {group} is damaged: make the file again");
                return Err(TableError::parquet(path, damage));
            }
            pages.checked.push((start, found));
        }
        Ok(pages)
    }

    /// The checked bytes from a place in the file on.
    fn checked(&self, start: u64) -> Option<Bytes> {
        let mut columns = self.checked.iter();
        let (first, bytes) =
            columns.find(|(first, bytes)| (*first..first + bytes.len() as u64).contains(&start))?;
        Some(bytes.slice((start - first) as usize..))
    }
}

/// The checksums in the footer of a table that no other program has written since.
fn written(metadata: &ParquetMetaData) -> Option<&str> {
    let footer = metadata.file_metadata();
    let pairs = footer.key_value_metadata().filter(|_| is_ours(footer))?;
    pairs.iter().find(|pair| pair.key == KEY)?.value.as_deref()
}

impl Length for Pages {
    fn len(&self) -> u64 {
        self.file.len()
    }
}

impl ChunkReader for Pages {
    type T = Box<dyn Read>;

    fn get_read(&self, start: u64) -> Result<Box<dyn Read>> {
        Ok(match self.checked(start) {
            Some(bytes) => Box::new(bytes.get_read(0)?),
            None => Box::new(self.file.get_read(start)?),
        })
    }

    fn get_bytes(&self, start: u64, length: usize) -> Result<Bytes> {
        match self.checked(start) {
            Some(bytes) => bytes.get_bytes(0, length),
            None => self.file.get_bytes(start, length),
        }
    }
}
