//! A column of lists of numbers, read by Parquet's own reader: the values, and where each list begins.

use std::path::Path;
use std::sync::Arc;

use arrow_array::ArrowPrimitiveType;
use arrow_array::types::Float16Type;
use arrow_schema::DataType::*;
use parquet::arrow::ProjectionMask;
use parquet::basic::Repetition;
use parquet::column::page::{Page, PageMetadata, PageReader};
use parquet::column::reader::{ColumnReader, ColumnReaderImpl, get_column_reader};
use parquet::data_type::DataType as Number;
use parquet::errors::ParquetError;
use parquet::file::serialized_reader::SerializedPageReader;
use parquet::schema::types::ColumnDescriptor;

use super::TableError;
use super::file::{RowGroup, Table, TableFile, expect_small, guarded};
use super::pages::Pages;

/// The lists of a row group, row by row.
pub struct Lists {
    path: Arc<Path>,
    column: &'static str,
    next_row: usize,
    next: Box<Next>,
}

type Half = <Float16Type as ArrowPrimitiveType>::Native;

/// Levels that are searched at once.
const BLOCK: usize = 512;

/// Reads the lists of the next rows, none where a list or one of its numbers is null.
type Next = dyn FnMut(usize) -> Result<Vec<Option<Vec<f64>>>, ParquetError> + Send;

impl Lists {
    /// Begins to read the lists of a row group.
    pub fn open(table: &Table, group: &RowGroup, column: &'static str) -> Result<Lists, TableError> {
        let TableFile { path, metadata } = &table.files[group.file];
        let (data, schema) = (metadata.metadata().row_group(group.group), metadata.parquet_schema());
        let leaf = (0..schema.num_columns()).find(|leaf| schema.get_column_root(*leaf).name() == column);
        let Some((leaf, (_, field))) = leaf.zip(metadata.schema().column_with_name(column)) else {
            return Err(TableError::missing_column(path, column));
        };
        let found = field.data_type();
        let item = match found {
            List(item) | LargeList(item) | FixedSizeList(item, _) => item.data_type(),
            _ => &Null,
        };
        let scale = match item {
            Decimal128(_, scale) | Decimal256(_, scale) => 10f64.powi(i32::from(*scale)),
            _ if item.is_numeric() => 1.0,
            _ => return Err(TableError::other_type(path, column, found, "a list of numbers")),
        };
        let (is_unsigned, is_half) = (matches!(item, UInt32 | UInt64), *item == Float16);
        let mask = ProjectionMask::leaves(schema, [leaf]);
        expect_small(path, data, &mask)?;
        let pages = Arc::new(Pages::open(path, metadata.metadata(), group.group, &mask)?);
        let rows = data.num_rows() as usize;
        let next =
            guarded(path, || {
                let pages = SerializedPageReader::new(pages, data.column(leaf), rows, None)?;
                let (of, skipped) = (schema.column(leaf), group.rows.start);
                Ok::<_, ParquetError>(match get_column_reader(of.clone(), Box::new(Filled(pages))) {
                    ColumnReader::FloatColumnReader(reader) => next(reader, &of, skipped, |x| f64::from(*x)),
                    ColumnReader::DoubleColumnReader(reader) => next(reader, &of, skipped, |x| *x),
                    ColumnReader::Int32ColumnReader(reader) => next(reader, &of, skipped, move |x| {
                        if is_unsigned { f64::from(*x as u32) } else { f64::from(*x) / scale }
                    }),
                    ColumnReader::Int64ColumnReader(reader) => next(reader, &of, skipped, move |x| {
                        if is_unsigned { *x as u64 as f64 } else { *x as f64 / scale }
                    }),
                    ColumnReader::FixedLenByteArrayColumnReader(reader) => {
                        next(reader, &of, skipped, move |x| {
                            if is_half { half(x.data()) } else { big_endian(x.data()) / scale }
                        })
                    }
                    ColumnReader::ByteArrayColumnReader(reader) => {
                        next(reader, &of, skipped, move |x| big_endian(x.data()) / scale)
                    }
                    _ => Box::new(|_| Ok(Vec::new())),
                })
            })?;
        Ok(Lists { path: path.clone(), column, next_row: group.first_row, next })
    }

    /// Reads the next `rows` lists.
    pub fn read(&mut self, rows: usize) -> Result<Vec<Vec<f64>>, TableError> {
        let lists = guarded(&self.path, || (self.next)(rows))?;
        if lists.len() < rows {
            return Err(TableError::parquet(&self.path, format!("column '{}' ends early", self.column)));
        }
        let rows = self.next_row..self.next_row + rows;
        self.next_row = rows.end;
        let problem = "null, or with a null; expected a list of numbers";
        let known = rows
            .zip(lists)
            .map(|(row, list)| list.ok_or_else(|| TableError::value(&self.path, row, self.column, problem)));
        known.collect()
    }
}

fn half(bytes: &[u8]) -> f64 {
    Half::from_le_bytes([bytes[0], bytes[1]]).into()
}

/// Reads the unscaled integer of a decimal number.
fn big_endian(bytes: &[u8]) -> f64 {
    let sign = bytes.first().map_or(0.0, |byte| f64::from(*byte as i8));
    bytes.iter().skip(1).fold(sign, |value, byte| 256.0 * value + f64::from(*byte))
}

/// The pages of a column but for empty ones, at which the reader of Parquet would stop.
struct Filled(SerializedPageReader<Pages>);

impl Iterator for Filled {
    type Item = Result<Page, ParquetError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.get_next_page().transpose()
    }
}

impl PageReader for Filled {
    fn get_next_page(&mut self) -> Result<Option<Page>, ParquetError> {
        self.peek_next_page()?;
        self.0.get_next_page()
    }

    fn peek_next_page(&mut self) -> Result<Option<PageMetadata>, ParquetError> {
        loop {
            match self.0.peek_next_page()? {
                Some(page) if !page.is_dict && page.num_levels.or(page.num_rows) == Some(0) => {
                    self.0.skip_next_page()?;
                }
                page => return Ok(page),
            }
        }
    }

    fn skip_next_page(&mut self) -> Result<(), ParquetError> {
        self.peek_next_page()?;
        self.0.skip_next_page()
    }
}

/// Makes the reader of a column of lists behind its first rows.
fn next<T: Number>(
    mut reader: ColumnReaderImpl<T>,
    column: &ColumnDescriptor,
    mut skipped: usize,
    number: impl Fn(&T::T) -> f64 + Copy + Send + 'static,
) -> Box<Next> {
    // The definition level of a number, and the least one of an item, which may be null.
    let known = column.max_def_level();
    let is_nullable = column.self_type().get_basic_info().repetition() == Repetition::OPTIONAL;
    let item = known - i16::from(is_nullable);
    let (mut levels, mut repeated, mut values) = (Vec::new(), Vec::new(), Vec::new());
    Box::new(move |rows| {
        reader.skip_records(std::mem::take(&mut skipped))?;
        levels.clear();
        repeated.clear();
        values.clear();
        reader.read_records(rows, Some(&mut levels), Some(&mut repeated), &mut values)?;
        let mut rest = &values[..];
        let mut list = |items: &[i16]| {
            if items[0] < item {
                // An empty list, unless it is null itself.
                return (items[0] + 1 == item).then(Vec::new);
            }
            let (its, later) = rest.split_at(items.iter().filter(|level| **level == known).count());
            rest = later;
            (its.len() == items.len()).then(|| its.iter().map(number).collect())
        };
        // Most blocks are within a list.
        let mut starts = Vec::with_capacity(rows + 1);
        for (at, block) in
            (0..).step_by(BLOCK).zip(repeated.chunks(BLOCK)).filter(|(_, block)| block.contains(&0))
        {
            starts.extend((at..).zip(block).filter(|(_, level)| **level == 0).map(|(at, _)| at));
        }
        starts.push(levels.len());
        Ok(starts.windows(2).map(|ends| list(&levels[ends[0]..ends[1]])).collect())
    })
}
