//! The motions file: one motion per row, its samples as a list. The required columns are motion_id, dt_s and
//! acceleration_m_s2.

use std::collections::HashSet;
use std::path::Path;
use std::sync::Arc;

use arrow_array::builder::{Float32Builder, ListBuilder};
use arrow_array::{ArrayRef, Float64Array, RecordBatch};
use arrow_schema::{DataType, Field, Schema};
use serde::{Deserialize, Serialize};

use super::TableError;
use super::columns::Batch;
use super::dictionary;
use super::file::{Partition, RowGroup, Table, or_error};
use super::rows::{self, side_by_side};
use crate::motion::MotionMeasures;
use crate::records::Origin;
use crate::records::rotation::pairs;
use crate::rocking::{Record, RecordError};

/// Column of the samples.
pub const ACCELERATION: &str = "acceleration_m_s2";
/// Row groups of more motions are read in parts of this size.
const LARGEST_PART: usize = 128;

/// A motion, with the measures that the file has.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    pub motion_id: String,
    pub suite: Option<String>,
    pub earthquake: Option<String>,
    pub mw: Option<f64>,
    pub re_km: Option<f64>,
    pub dt_s: f64,
    pub pga_m_s2: Option<f64>,
    pub pgv_m_s: Option<f64>,
    pub tm_s: Option<f64>,
    pub tp_s: Option<f64>,
    #[serde(skip)]
    pub acceleration_m_s2: Vec<f64>,
    #[serde(skip)]
    pub row: usize,
}

impl Motion {
    /// The record of a motion of the file at `path`.
    pub fn record(&self, path: &Path) -> Result<Record<'_>, TableError> {
        record(path, self.row, &self.acceleration_m_s2, self.dt_s)
    }
}

/// Columns of some motions, and their samples.
pub type Sampled = (Batch, Vec<Vec<f64>>);

/// Motions, and the file they are in.
type MotionsOfFile = (Arc<Path>, Vec<Motion>);

/// A part of a motions table.
pub enum Part {
    /// A row group, not yet read.
    Unread(RowGroup),
    /// Motions of a row group too large to read at once.
    Read(MotionsOfFile),
}

/// Opens a motions table, or a partition of it.
pub fn open(path: &Path, partition: Option<Partition>) -> Result<Table, TableError> {
    let table = Table::open_partition(path, partition)?;
    table.expect(path, ["motion_id", "dt_s", ACCELERATION])?;
    match table.rows() {
        0 if partition.is_none() => Err(TableError::table(path, "no motions; expected at least one")),
        _ => Ok(table),
    }
}

/// Returns all motions of a table in parts.
pub fn parts(table: &Table) -> impl Iterator<Item = Result<Part, TableError>> + Send {
    table.row_groups().into_iter().flat_map(|group| -> Box<dyn Iterator<Item = _> + Send> {
        if group.rows.len() <= LARGEST_PART {
            return Box::new(std::iter::once(Ok(Part::Unread(group))));
        }
        let read = or_error(read_group(table, &group, LARGEST_PART));
        Box::new(read.map(|read| read.map(Part::Read)))
    })
}

/// Reads the motions of a part, `at_once` at a time.
pub fn read_part(
    table: &Table,
    part: Part,
    at_once: usize,
) -> Result<Box<dyn Iterator<Item = Result<MotionsOfFile, TableError>>>, TableError> {
    match part {
        Part::Unread(group) => Ok(Box::new(read_group(table, &group, at_once)?)),
        Part::Read((path, mut motions)) => Ok(Box::new(std::iter::from_fn(move || {
            let next: Vec<Motion> = motions.drain(..at_once.min(motions.len())).collect();
            (!next.is_empty()).then(|| Ok((path.clone(), next)))
        }))),
    }
}

fn read_group(
    table: &Table,
    group: &RowGroup,
    at_once: usize,
) -> Result<impl Iterator<Item = Result<MotionsOfFile, TableError>> + Send + use<>, TableError> {
    let schema = rows::schema::<Motion>();
    let read = read(table, group, &|name| schema.index_of(name).is_ok(), at_once)?;
    Ok(read.map(|read| read.and_then(motions)))
}

/// Reads the `wanted` columns of motions besides the samples, and these, `at_once` at a time.
pub fn read(
    table: &Table,
    group: &RowGroup,
    wanted: &dyn Fn(&str) -> bool,
    at_once: usize,
) -> Result<impl Iterator<Item = Result<Sampled, TableError>> + Send + use<>, TableError> {
    let batches = table.read(group, &|name| name == ACCELERATION || wanted(name), at_once)?;
    Ok(batches.map(|batch| {
        let mut batch = batch?;
        let samples = batch.lists(ACCELERATION)?;
        if let Ok(place) = batch.rows.schema().index_of(ACCELERATION) {
            batch.rows.remove_column(place);
        }
        Ok((batch, samples))
    }))
}

fn motions((batch, samples): Sampled) -> Result<MotionsOfFile, TableError> {
    let mut motions = rows::from_batch::<Motion>(&batch)?;
    for (row, (motion, samples)) in (batch.first_row..).zip(motions.iter_mut().zip(samples)) {
        (motion.row, motion.acceleration_m_s2) = (row, samples);
    }
    Ok((batch.path, motions))
}

/// The record of samples in a row of the file at `path`.
pub fn record<'a>(
    path: &Path,
    row: usize,
    acceleration_m_s2: &'a [f64],
    dt_s: f64,
) -> Result<Record<'a>, TableError> {
    Record::new(acceleration_m_s2, dt_s).map_err(|problem| {
        let column = if matches!(problem, RecordError::TimeStep(_)) { "dt_s" } else { ACCELERATION };
        TableError::value(path, row, column, problem)
    })
}

/// The names of motions that are the second of two horizontal components of an instrument.
pub fn second_of_pairs(path: &Path) -> Result<HashSet<String>, TableError> {
    #[derive(Serialize, Deserialize)]
    struct Component {
        motion_id: String,
        earthquake: Option<String>,
        station: Option<String>,
        dt_s: f64,
        azimuth_deg: Option<f64>,
    }
    let (mut names, mut origins) = (Vec::new(), Vec::new());
    for Component { motion_id, earthquake, station, dt_s, azimuth_deg } in rows::read(path)? {
        names.push(motion_id);
        origins.push((Origin { earthquake, station, azimuth_deg, ..Origin::default() }, dt_s));
    }
    let origins: Vec<_> = origins.iter().map(|(origin, dt_s)| (origin, *dt_s)).collect();
    Ok(pairs(&origins).into_iter().map(|[_, second]| std::mem::take(&mut names[second])).collect())
}

/// Makes a batch of `known` columns, the spectral accelerations at `periods_s`, and the samples.
pub fn batch<'a>(
    known: &[RecordBatch],
    periods_s: &[f64],
    motions: impl Iterator<Item = (&'a MotionMeasures, &'a [f32])> + Clone,
) -> anyhow::Result<RecordBatch> {
    let mut fields: Vec<Field> = Vec::new();
    let mut columns: Vec<ArrayRef> = Vec::new();
    for (place, period) in periods_s.iter().enumerate() {
        let field = Field::new(spectral_column(*period), DataType::Float64, true);
        fields.push(dictionary::with_meaning(field));
        let sa = motions.clone().map(|(measures, _)| measures.sa_m_s2[place]);
        columns.push(Arc::new(Float64Array::from_iter(sa)));
    }
    let item = Arc::new(Field::new("item", DataType::Float32, false));
    let mut lists = ListBuilder::new(Float32Builder::new()).with_field(item.clone());
    for (_, samples) in motions {
        lists.values().append_slice(samples);
        lists.append(true);
    }
    fields.push(dictionary::with_meaning(Field::new(ACCELERATION, DataType::List(item), false)));
    columns.push(Arc::new(lists.finish()));
    let made = RecordBatch::try_new(Arc::new(Schema::new(fields)), columns)?;
    side_by_side(&[known, &[made]].concat())
}

/// Returns the column name of the spectral acceleration at a period (s): `sa_0p50_m_s2`.
pub fn spectral_column(period_s: f64) -> String {
    format!("sa_{}_m_s2", format!("{period_s:.2}").replace('.', "p"))
}

/// Returns the period (s) of a column of spectral accelerations; `None` for other columns.
pub fn spectral_period_s(column: &str) -> Option<f64> {
    column.strip_prefix("sa_")?.strip_suffix("_m_s2")?.replace('p', ".").parse().ok()
}
