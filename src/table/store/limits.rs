//! What a Parquet file may ask of memory, checked before a byte of it is decoded. A file of a few hundred bytes can announce
//! pages, dictionaries and lists of billions of values.

use parquet::arrow::arrow_reader::ArrowReaderMetadata;
use parquet::errors::{ParquetError, Result};
use parquet::file::metadata::ColumnChunkMetaData;
use parquet::file::reader::{ChunkReader, Length};

use super::compact::{Broken, Compact, Kind};
use super::description::{FILE, PAGE_HEADER};
use super::shared_file::SharedFile;

/// The largest footer: that of tens of thousands of row groups.
pub(super) const MOST_FOOTER_BYTES: u64 = 256 << 20;
/// The largest page, decompressed; those of common writers have a megabyte.
const MOST_PAGE_BYTES: i64 = 256 << 20;
/// The most samples in a row group, which one motion of a hostile file could have all to itself.
pub(super) const MOST_SAMPLES: u64 = 1 << 28;
/// DELTA_LENGTH_BYTE_ARRAY and DELTA_BYTE_ARRAY.
const ENCODINGS_OF_DIFFERENCES: [i64; 2] = [6, 7];
/// How deep columns may nest.
const MOST_LEVELS: usize = 16;
/// The first look at the header of a page, and the largest.
const PAGE_HEADER_BYTES: u64 = 256;
const MOST_PAGE_HEADER_BYTES: u64 = 1 << 20;

fn refused(words: impl Into<String>) -> ParquetError {
    ParquetError::General(words.into())
}

/// That the footer is a description of moderate depth, in which no list is longer than its bytes, and each field what it should
/// be.
pub(super) fn check_footer(bytes: &[u8]) -> Result<()> {
    let mut reader = Compact::new(bytes);
    let mut children = Vec::new();
    let schema = |reader: &mut Compact, id, kind| match id {
        SCHEMA => {
            let (_, elements) = reader.list()?;
            for _ in 0..elements {
                let mut count = 0;
                reader.fields(|reader, id, kind| match id {
                    CHILDREN => reader.integer().map(|children| count = children),
                    _ => reader.skip(kind),
                })?;
                children.push(count);
            }
            Ok(())
        }
        _ => reader.skip(kind),
    };
    const SCHEMA: i64 = 2;
    const CHILDREN: i64 = 5;
    let passed = FILE.pass(&mut Compact::new(bytes)).and_then(|()| reader.fields(schema));
    passed.map_err(|broken| refused(broken.to_string()))?;
    check_nesting(&children)
}

/// That the columns, listed depth first with the number of children of each, nest in moderation.
fn check_nesting(children: &[i64]) -> Result<()> {
    let mut open: Vec<i64> = Vec::new();
    for &count in children {
        if count < 0 || count > children.len() as i64 {
            return Err(refused(format!("a column of {count} columns")));
        }
        open.push(count);
        if open.len() > MOST_LEVELS {
            return Err(refused(format!("columns nest deeper than {MOST_LEVELS} levels")));
        }
        while let Some(left) = open.last_mut() {
            if *left > 0 {
                *left -= 1;
                break;
            }
            open.pop();
        }
    }
    Ok(())
}

/// That rows of groups add up to those of the file.
pub(super) fn check_rows(metadata: &ArrowReaderMetadata) -> Result<()> {
    let metadata = metadata.metadata();
    let rows = metadata.file_metadata().num_rows();
    let mut sum = 0_i64;
    for group in metadata.row_groups() {
        let known = sum.checked_add(group.num_rows()).filter(|_| group.num_rows() >= 0);
        sum = known.ok_or_else(|| refused(format!("a row group of {} rows", group.num_rows())))?;
    }
    if sum == rows { Ok(()) } else { Err(refused(format!("{rows} rows, but {sum} in its row groups"))) }
}

/// That the pages of a column of a row group are of moderate size, and hold what the row group announces.
pub(super) fn check_pages(file: &SharedFile, column: &ColumnChunkMetaData, rows: i64) -> Result<()> {
    let name = column.column_path().string();
    let refused = |words: String| refused(format!("column '{name}': {words}"));
    let dictionary = column.dictionary_page_offset().filter(|&offset| offset > 0);
    let start = dictionary.unwrap_or(column.data_page_offset()).min(column.data_page_offset());
    let bounds = u64::try_from(start).ok().zip(u64::try_from(column.compressed_size()).ok());
    let bounds = bounds.and_then(|(start, length)| Some((start, start.checked_add(length)?)));
    let (mut at, end) = bounds
        .filter(|&(_, end)| end <= file.len())
        .ok_or_else(|| refused("lies outside of the file".to_string()))?;
    let mut values = 0_u64;
    while at < end {
        let (page, length) = page(file, at, end)?;
        if !(0..=MOST_PAGE_BYTES).contains(&page.bytes) {
            let most = MOST_PAGE_BYTES >> 20;
            return Err(refused(format!("a page of {} bytes; expected {most} MiB at most", page.bytes)));
        }
        // These say within the page how much room to make, and are taken at their word.
        if ENCODINGS_OF_DIFFERENCES.contains(&page.encoding) {
            return Err(refused(
                "encoded by differences of texts; expected plain or a dictionary".to_string(),
            ));
        }
        let count = u64::try_from(page.values).map_err(|_| refused(format!("{} values", page.values)))?;
        if page.is_dictionary && count > page.bytes.unsigned_abs() {
            return Err(refused(format!("a dictionary of {count} values in {} bytes", page.bytes)));
        }
        values += if page.is_dictionary { 0 } else { count };
        let next = u64::try_from(page.compressed_bytes).ok().and_then(|bytes| at.checked_add(length + bytes));
        at = next.filter(|&next| next <= end).ok_or_else(|| refused("a page ends after it".to_string()))?;
    }
    let is_list = column.column_descr().max_rep_level() > 0;
    if is_list && values > MOST_SAMPLES {
        return Err(refused(format!(
            "{values} samples in a row group; expected {MOST_SAMPLES} at most: write fewer rows in each"
        )));
    }
    if !is_list && values != rows.unsigned_abs() {
        return Err(refused(format!("{values} values in {rows} rows")));
    }
    Ok(())
}

/// What the header of a page says.
#[derive(Default)]
struct Page {
    bytes: i64,
    compressed_bytes: i64,
    values: i64,
    encoding: i64,
    is_dictionary: bool,
}

/// The page at a place of the file, and the length of its header.
fn page(file: &SharedFile, at: u64, end: u64) -> Result<(Page, u64)> {
    let mut window = PAGE_HEADER_BYTES;
    loop {
        let length = window.min(end - at);
        let bytes = file.get_bytes(at, length as usize)?;
        let mut reader = Compact::new(&bytes);
        match PAGE_HEADER.pass(&mut Compact::new(&bytes)).and_then(|()| page_header(&mut reader)) {
            Ok(page) => return Ok((page, reader.read() as u64)),
            Err(Broken::Ends) if length == window && window < MOST_PAGE_HEADER_BYTES => window *= 16,
            Err(broken) => return Err(refused(format!("page at byte {at}: {broken}"))),
        }
    }
}

fn page_header(reader: &mut Compact) -> std::result::Result<Page, Broken> {
    let mut page = Page::default();
    reader.fields(|reader, id, kind| match (id, kind) {
        (2, _) => reader.integer().map(|bytes| page.bytes = bytes),
        (3, _) => reader.integer().map(|bytes| page.compressed_bytes = bytes),
        // Data of both versions, and dictionaries.
        (5 | 7 | 8, Kind::STRUCT) => {
            page.is_dictionary = id == 7;
            let encoding = if id == 8 { 4 } else { 2 };
            reader.fields(|reader, field, kind| match field {
                1 => reader.integer().map(|values| page.values = values),
                field if field == encoding => reader.integer().map(|encoding| page.encoding = encoding),
                _ => reader.skip(kind),
            })
        }
        _ => reader.skip(kind),
    })?;
    Ok(page)
}
