//! The motions file: one row a ground motion, its samples as a list.

use std::ops::Deref;
use std::sync::Arc;

use arrow_array::{ArrayRef, Int64Array, StringArray};

use super::TableError;
use super::cell::{Label, ReadValue, Value, WriteValue};
use super::records::RECORDS;
use super::row::{ReadRow, Row, schema_of, table};
use super::schema::{self, Column, Kind};
use super::store::columns::{Columns, Samples};
use super::store::provenance::Provenance;
use super::store::reader::{Batch, Batches};
use super::store::source::{Source, Target};
use super::store::writer::TableWriter;
use super::synthetic_motions::MOTIONS;

/// The stages whose output can stand as a motions file.
pub(super) const STAGES: [&str; 2] = ["synthesize-motions", "import-motions"];

/// What a motion is called: by number in our files, by number or name in those of others.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum MotionId {
    Number(i64),
    Name(String),
}

impl std::fmt::Display for MotionId {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        match self {
            MotionId::Number(number) => write!(f, "{number}"),
            MotionId::Name(name) => f.write_str(name),
        }
    }
}

impl Value for MotionId {
    const KIND: Kind = Kind::Int64;
}

impl Value for &MotionId {
    const KIND: Kind = Kind::Int64;
}

/// The column is of whole numbers, or of text where motions go by name.
impl WriteValue for &MotionId {
    fn optional_array<'r>(ids: impl Iterator<Item = Option<&'r Self>>, by_name: bool) -> ArrayRef
    where
        Self: 'r,
    {
        if by_name {
            return Arc::new(ids.map(|id| id.map(|id| id.to_string())).collect::<StringArray>());
        }
        let number = |id: Option<&&MotionId>| match id {
            Some(MotionId::Number(number)) => Some(*number),
            _ => None,
        };
        Arc::new(ids.map(number).collect::<Int64Array>())
    }
}

impl ReadValue for MotionId {
    fn read(columns: &Columns, column: &Column) -> Result<Vec<MotionId>, TableError> {
        Ok(if columns.is_text(column) {
            columns.text(column)?.into_iter().map(MotionId::Name).collect()
        } else {
            columns.integers(column)?.into_iter().map(MotionId::Number).collect()
        })
    }

    fn read_optional(columns: &Columns, column: &Column) -> Result<Vec<Option<MotionId>>, TableError> {
        Ok(MotionId::read(columns, column)?.into_iter().map(Some).collect())
    }
}

table! {
    /// A motion as simulate needs it: ours, or anyone's with the three columns that cannot be done without.
    pub struct MotionRow of RECORDS or MOTIONS {
        motion_id: MotionId,
        suite: Option<String>,
        mw: Option<f64>,
        re_km: Option<f64>,
        earthquake: Option<Label>,
        dt_s: f64,
        pga_m_s2: Option<f64>,
        pgv_m_s: Option<f64>,
        tm_s: Option<f64>,
        tp_s: Option<f64>,
        acceleration_m_s2: Samples,
    }
}

/// A motion, and where it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    pub columns: MotionRow,
    /// Its row in the file.
    pub row: u64,
}

impl Deref for Motion {
    type Target = MotionRow;

    fn deref(&self) -> &MotionRow {
        &self.columns
    }
}

/// The motions of a table, some at a time.
pub struct MotionBatches {
    batches: Batches,
}

impl MotionBatches {
    /// Opens a table of motions, ours or anyone's with the three columns that count, `batch_size` motions at a time.
    ///
    /// # Errors
    /// If it is missing, unreadable, empty, of another stage, or lacks a column.
    pub fn open(source: impl Into<Source>, batch_size: usize) -> Result<MotionBatches, TableError> {
        Ok(MotionBatches {
            batches: Batches::open(source, &STAGES, MotionRow::TABLE.columns, 0, batch_size)?,
        })
    }

    /// How many motions there are.
    pub fn rows(&self) -> u64 {
        self.batches.rows()
    }
}

impl Iterator for MotionBatches {
    type Item = Result<Vec<Motion>, TableError>;

    fn next(&mut self) -> Option<Self::Item> {
        Some(self.batches.next()?.and_then(|batch| motions_of(&batch)))
    }
}

/// The motions of a batch.
///
/// # Errors
/// If a value cannot be used.
pub(super) fn motions_of(batch: &Batch) -> Result<Vec<Motion>, TableError> {
    let rows = batch.first_row..;
    Ok(MotionRow::of(&batch.columns())?
        .into_iter()
        .zip(rows)
        .map(|(columns, row)| Motion { columns, row })
        .collect())
}

/// Starts a table in which motions go by number or by name.
///
/// # Errors
/// As [`TableWriter::create`].
pub fn writer(
    target: impl Into<Target>,
    table: &schema::Table,
    by_name: bool,
    provenance: &Provenance,
) -> Result<TableWriter, TableError> {
    TableWriter::with_schema(target, table, schema_of(table, by_name), provenance.clone())
}
