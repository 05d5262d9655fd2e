//! Checksums of columns: a flipped bit in one would be another number without a word. Our tables have one of
//! each column of each row group in the footer; other programs may have written one into each page, which
//! Parquet's reader compares.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

use parquet::arrow::ProjectionMask;
use parquet::errors::{ParquetError, Result};
use parquet::file::metadata::{ColumnChunkMetaData, KeyValue, ParquetMetaData, RowGroupMetaData};

use super::provenance::own_entry;

const KEY: &str = "rockfrag_checksums";
/// Hexadecimal digits of a checksum.
const DIGITS: usize = 8;

/// Computes the checksum of a column of a row group, as it is in the file.
fn checksum(mut file: &File, column: &ColumnChunkMetaData) -> Result<String> {
    let (start, length) = column.byte_range();
    file.seek(SeekFrom::Start(start))?;
    let hash = blake3::Hasher::new().update_reader(file.take(length))?.finalize();
    Ok(hash.to_hex()[..DIGITS].to_string())
}

/// Computes the checksums of row groups that are in the file at `path`, column by column.
pub fn checksums(path: &Path, groups: &[RowGroupMetaData]) -> Result<KeyValue> {
    let file = File::open(path)?;
    let columns = groups.iter().flat_map(RowGroupMetaData::columns);
    let all = columns.map(|column| checksum(&file, column)).collect::<Result<String>>()?;
    Ok(KeyValue::new(KEY.to_string(), all))
}

/// Compares some columns of a row group with their checksums, if the file has any and no other program has
/// written it since.
pub fn expect_undamaged(
    file: &File,
    metadata: &ParquetMetaData,
    group: usize,
    wanted: &ProjectionMask,
) -> Result<()> {
    let Some(checksums) = own_entry(metadata, KEY) else { return Ok(()) };
    let columns = metadata.row_group(group).columns();
    for (leaf, column) in columns.iter().enumerate().filter(|(leaf, _)| wanted.leaf_included(*leaf)) {
        let found = checksum(file, column)?;
        let first = DIGITS * (group * columns.len() + leaf);
        if checksums.get(first..first + DIGITS) != Some(found.as_str()) {
            let (name, group) = (column.column_path().parts()[0].as_str(), group + 1);
            let damage = format!("column '{name}' of row group {group} is damaged: make the file again");
            return Err(ParquetError::General(damage));
        }
    }
    Ok(())
}
