//! A column of lists of numbers, read by Parquet's own reader: the values, and where each list begins.

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use arrow_schema::DataType;
use parquet::basic::Repetition;
use parquet::column::reader::{ColumnReader, ColumnReaderImpl, get_column_reader};
use parquet::data_type::DataType as Number;
use parquet::errors::ParquetError;
use parquet::file::serialized_reader::SerializedPageReader;

use super::TableError;
use super::file::{RowGroup, Table, expect_small, guarded};

/// The lists of a row group, row by row.
pub struct Lists {
    path: Arc<Path>,
    column: &'static str,
    next_row: u64,
    reader: ColumnReader,
    levels: Levels,
}

/// The definition level of a number, and the least one of an item, which may be null.
#[derive(Clone, Copy)]
struct Levels {
    number: i16,
    item: i16,
}

impl Lists {
    /// Begins to read the lists of a row group.
    pub fn open(table: &Table, group: &RowGroup, column: &'static str) -> Result<Lists, TableError> {
        let (path, metadata, number) = table.place(group);
        let field = metadata.schema().field_with_name(column);
        let found = field.map_err(|_| TableError::missing_column(path, column))?.data_type();
        if !is_list_of_numbers(found) {
            return Err(TableError::other_type(path, column, found, "a list of numbers"));
        }
        let group_data = metadata.metadata().row_group(number);
        let columns = metadata.parquet_schema();
        let is_its = |leaf: &usize| columns.get_column_root(*leaf).name() == column;
        let leaf = (0..columns.num_columns()).find(is_its).expect("the schema has this column");
        expect_small(path, group_data, &[columns.get_column_root_idx(leaf)])?;
        let file = File::open(path).map_err(|source| TableError::io(path, source))?;
        let rows = group_data.num_rows() as usize;
        let mut reader = guarded(path, || {
            let pages = SerializedPageReader::new(Arc::new(file), group_data.column(leaf), rows, None)?;
            Ok::<_, ParquetError>(get_column_reader(columns.column(leaf), Box::new(pages)))
        })?;
        let before = group.rows().start as usize;
        guarded(path, || match &mut reader {
            ColumnReader::FloatColumnReader(reader) => reader.skip_records(before),
            ColumnReader::DoubleColumnReader(reader) => reader.skip_records(before),
            ColumnReader::Int32ColumnReader(reader) => reader.skip_records(before),
            ColumnReader::Int64ColumnReader(reader) => reader.skip_records(before),
            _ => Ok(0),
        })?;
        let number = columns.column(leaf).max_def_level();
        let is_nullable =
            columns.column(leaf).self_type().get_basic_info().repetition() == Repetition::OPTIONAL;
        let levels = Levels { number, item: number - i16::from(is_nullable) };
        Ok(Lists { path: path.clone(), column, next_row: group.first_row, reader, levels })
    }

    /// Reads the next `rows` lists; NaN where an item is null.
    pub fn read(&mut self, rows: usize) -> Result<Vec<Vec<f64>>, TableError> {
        let levels = self.levels;
        let lists = guarded(&self.path, || match &mut self.reader {
            ColumnReader::FloatColumnReader(reader) => levels.read(reader, rows, |value| f64::from(*value)),
            ColumnReader::DoubleColumnReader(reader) => levels.read(reader, rows, |value| *value),
            ColumnReader::Int32ColumnReader(reader) => levels.read(reader, rows, |value| f64::from(*value)),
            ColumnReader::Int64ColumnReader(reader) => levels.read(reader, rows, |value| *value as f64),
            _ => Ok(Vec::new()),
        })?;
        if lists.len() < rows {
            return Err(TableError::parquet(
                &self.path,
                format!("a column '{}' that ends early", self.column),
            ));
        }
        let null = lists.iter().position(Option::is_none).map(|row| self.next_row + row as u64);
        self.next_row += rows as u64;
        match null {
            Some(row) => Err(TableError::Value {
                path: self.path.to_path_buf(),
                row,
                column: self.column,
                problem: "null; expected a list of numbers".to_string(),
            }),
            None => Ok(lists.into_iter().flatten().collect()),
        }
    }
}

impl Levels {
    /// Reads lists, none where one is null.
    fn read<T: Number>(
        self,
        reader: &mut ColumnReaderImpl<T>,
        rows: usize,
        number: impl Fn(&T::T) -> f64,
    ) -> Result<Vec<Option<Vec<f64>>>, ParquetError> {
        let (mut defined, mut repeated, mut values) = (Vec::new(), Vec::new(), Vec::new());
        reader.read_records(rows, Some(&mut defined), Some(&mut repeated), &mut values)?;
        let mut rest = &values[..];
        let mut list = |items: &[i16]| {
            if items[0] < self.item {
                // An empty list, unless it is null itself.
                return (items[0] + 1 == self.item).then(Vec::new);
            }
            let known = items.iter().filter(|level| **level == self.number).count();
            let (its, later) = rest.split_at(known);
            rest = later;
            let mut numbers = its.iter().map(&number);
            Some(match known == items.len() {
                true => numbers.collect(),
                false => {
                    let item = |level: &i16| {
                        if *level == self.number { numbers.next().unwrap_or(f64::NAN) } else { f64::NAN }
                    };
                    items.iter().map(item).collect()
                }
            })
        };
        let starts = (0..repeated.len()).filter(|&at| repeated[at] == 0);
        let ends = starts.clone().skip(1).chain([repeated.len()]);
        Ok(starts.zip(ends).map(|(start, end)| list(&defined[start..end])).collect())
    }
}

/// Unsigned integers of 32 bits and more are none: the file keeps them as signed ones.
fn is_list_of_numbers(found: &DataType) -> bool {
    use DataType::*;
    let (List(item) | LargeList(item) | FixedSizeList(item, _)) = found else { return false };
    matches!(item.data_type(), Float32 | Float64 | Int8 | Int16 | Int32 | Int64 | UInt8 | UInt16)
}
