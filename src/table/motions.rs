//! The motions file: one row a ground motion, its samples as a list.

use std::sync::Arc;

use arrow_array::{ArrayRef, Int64Array, StringArray};
use arrow_schema::{DataType, SchemaRef};

use super::TableError;
use super::columns::Samples;
use super::provenance::Provenance;
use super::reader::{Batch, Batches};
use super::schema::{self, Column};
use super::source::{Source, Target};
use super::writer::TableWriter;

/// The stages whose output can stand as a motions file.
pub(super) const STAGES: [&str; 2] = ["synthesize-motions", "import-motions"];

/// What `simulate` cannot do without.
pub(super) const REQUIRED: [Column; 3] = [schema::MOTION_ID, schema::DT_S, schema::ACCELERATION_M_S2];

/// What it reads where it is there.
pub(super) const READ: [Column; 11] = [
    schema::MOTION_ID,
    schema::SUITE,
    schema::MW,
    schema::RE_KM,
    schema::EARTHQUAKE,
    schema::DT_S,
    schema::PGA_M_S2,
    schema::PGV_M_S,
    schema::TM_S,
    schema::TP_S,
    schema::ACCELERATION_M_S2,
];

/// What a motion is called: by number in our files, by number or name in those of others.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum MotionId {
    /// By number.
    Number(i64),
    /// By name.
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

/// A motion as `simulate` needs it. Measures that the file does not have are `None`.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// What it is called.
    pub motion_id: MotionId,
    /// Its kind, if known.
    pub suite: Option<String>,
    /// Moment magnitude, if known.
    pub mw: Option<f64>,
    /// Distance, km, if known.
    pub re_km: Option<f64>,
    /// The earthquake, if known.
    pub event: Option<String>,
    /// Time between samples, s.
    pub dt_s: f64,
    /// Samples, m/s2.
    pub acceleration_m_s2: Samples,
    /// Peak ground acceleration, m/s2.
    pub pga_m_s2: Option<f64>,
    /// Peak ground velocity, m/s.
    pub pgv_m_s: Option<f64>,
    /// Mean period, s.
    pub tm_s: Option<f64>,
    /// Period of the pulse, s.
    pub tp_s: Option<f64>,
    /// Its row in the file.
    pub row: u64,
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
        Ok(MotionBatches { batches: Batches::open(source, &STAGES, &READ, &REQUIRED, 0, batch_size)? })
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

/// Whether motions go by name rather than by number.
pub(super) fn ids_are_names(schema: &SchemaRef) -> bool {
    let field = schema.field_with_name(schema::MOTION_ID.name);
    field.is_ok_and(|field| !field.data_type().is_numeric())
}

/// The motions of a batch.
///
/// # Errors
/// If a value cannot be used.
pub(super) fn motions_of(batch: &Batch) -> Result<Vec<Motion>, TableError> {
    let columns = batch.columns();
    let ids: Vec<MotionId> = if columns.is_text(&schema::MOTION_ID) {
        columns.text(&schema::MOTION_ID)?.into_iter().map(MotionId::Name).collect()
    } else {
        columns.integers(&schema::MOTION_ID)?.into_iter().map(MotionId::Number).collect()
    };
    let suite = columns.optional_text(&schema::SUITE)?;
    let event = columns.optional_labels(&schema::EARTHQUAKE)?;
    let dt_s = columns.numbers(&schema::DT_S)?;
    let measure = |column| columns.optional_numbers(column);
    let (mw, re_km) = (measure(&schema::MW)?, measure(&schema::RE_KM)?);
    let (pga, pgv) = (measure(&schema::PGA_M_S2)?, measure(&schema::PGV_M_S)?);
    let (tm, tp) = (measure(&schema::TM_S)?, measure(&schema::TP_S)?);
    let samples = columns.samples(&schema::ACCELERATION_M_S2)?;
    let motion = |(row, (motion_id, acceleration_m_s2)): (usize, (MotionId, Samples))| Motion {
        motion_id,
        suite: suite[row].clone(),
        mw: mw[row],
        re_km: re_km[row],
        event: event[row].clone(),
        dt_s: dt_s[row],
        acceleration_m_s2,
        pga_m_s2: pga[row],
        pgv_m_s: pgv[row],
        tm_s: tm[row],
        tp_s: tp[row],
        row: batch.first_row + row as u64,
    };
    Ok(ids.into_iter().zip(samples).enumerate().map(motion).collect())
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

/// The schema of a table in which motions go by name or by number.
pub fn schema_of(table: &schema::Table, by_name: bool) -> SchemaRef {
    if by_name { schema_by_name(table) } else { table.schema() }
}

fn schema_by_name(table: &schema::Table) -> SchemaRef {
    let fields = table
        .schema()
        .fields()
        .iter()
        .map(|field| {
            let renamed = field.name() == schema::MOTION_ID.name;
            if renamed {
                field.as_ref().clone().with_data_type(DataType::Utf8)
            } else {
                field.as_ref().clone()
            }
        })
        .collect::<Vec<_>>();
    Arc::new(arrow_schema::Schema::new(fields))
}

/// The motion_id column: all numbers, or all names.
pub(super) fn id_column<'a>(ids: impl Iterator<Item = &'a MotionId>, by_name: bool) -> ArrayRef {
    if by_name {
        return Arc::new(StringArray::from_iter_values(ids.map(MotionId::to_string)));
    }
    Arc::new(
        ids.map(|id| match id {
            MotionId::Number(number) => Some(*number),
            MotionId::Name(_) => None,
        })
        .collect::<Int64Array>(),
    )
}
