//! The motions file: one motion per row, its samples as a list. The required columns are motion_id, dt_s and
//! acceleration_m_s2.

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use arrow_array::builder::{Float32Builder, ListBuilder};
use arrow_array::{ArrayRef, Float64Array, RecordBatch};
use arrow_schema::{DataType, Field};
use rockfrag_core::motion::MotionMeasures;
use rockfrag_core::records::Origin;
use rockfrag_core::records::rotation::pairs;
use rockfrag_core::rocking::{Record, RecordError};
use serde::{Deserialize, Serialize};

use super::TableError;
use super::columns::Batch;
use super::file::{ParquetTable, Partition, RowGroup};
use super::rows::{self, side_by_side};

pub const ACCELERATION: &str = "acceleration_m_s2";
/// Row groups of more motions are read in parts.
const LARGEST_PART: usize = 128;

/// A motion, with the measures that the file has.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MotionRow {
    pub motion_id: String,
    pub suite: Option<String>,
    pub earthquake: Option<String>,
    pub scenario_id: Option<i64>,
    pub mw: Option<f64>,
    pub re_km: Option<f64>,
    pub dt_s: f64,
    pub pga_m_s2: Option<f64>,
    pub pgv_m_s: Option<f64>,
    pub tm_s: Option<f64>,
    pub tp_s: Option<f64>,
    #[serde(skip)]
    pub acceleration_m_s2: Vec<f64>,
    /// Its file, and its row there.
    #[serde(skip)]
    pub path: PathBuf,
    #[serde(skip)]
    pub row: usize,
}

impl MotionRow {
    pub fn record(&self) -> Result<Record<'_>, TableError> {
        Record::new(&self.acceleration_m_s2, self.dt_s).map_err(|problem| {
            let column = if matches!(problem, RecordError::TimeStep(_)) { "dt_s" } else { ACCELERATION };
            TableError::value(&self.path, self.row, column, problem)
        })
    }

    pub fn value_error(&self, problem: &str) -> TableError {
        let problem = format!("motion '{}': {problem}", self.motion_id);
        TableError::value(&self.path, self.row, ACCELERATION, problem)
    }
}

/// Some motions, and the columns that were wanted but for the samples.
pub struct Sampled {
    pub columns: Batch,
    pub motions: Vec<MotionRow>,
}

/// Some motions at a time of a part of a motions table, read when it is called.
pub type Part<'a> = Box<dyn FnOnce() -> Result<Vec<Sampled>, TableError> + Send + 'a>;

pub fn open(path: &Path, partition: Option<Partition>) -> Result<ParquetTable, TableError> {
    let table = ParquetTable::open_partition(path, partition)?;
    table.expect(["motion_id", "dt_s", ACCELERATION])?;
    match table.rows() {
        0 if partition.is_none() => Err(TableError::table(path, "no motions; expected at least one")),
        _ => Ok(table),
    }
}

pub fn is_motion_column(column: &str) -> bool {
    rows::schema::<MotionRow>().index_of(column).is_ok()
}

/// Returns all motions of a table in parts, with the columns that are `wanted`, `at_once` motions at a time:
/// a row group, or some motions, already read, of one too large to read at once.
pub fn parts(
    table: &ParquetTable,
    wanted: fn(&str) -> bool,
    at_once: usize,
) -> impl Iterator<Item = Part<'_>> + Send {
    table.row_groups().into_iter().flat_map(move |group| -> Box<dyn Iterator<Item = Part> + Send> {
        if group.rows.len() > LARGEST_PART {
            let read = read(table, &group, wanted, at_once);
            return Box::new(read.map(|some| Box::new(|| Ok(vec![some?])) as Part));
        }
        let part: Part = Box::new(move || read(table, &group, wanted, at_once).collect());
        Box::new(std::iter::once(part))
    })
}

fn read(
    table: &ParquetTable,
    group: &RowGroup,
    wanted: fn(&str) -> bool,
    at_once: usize,
) -> impl Iterator<Item = Result<Sampled, TableError>> + Send + use<> {
    table.read(group, &|name| name == ACCELERATION || wanted(name), at_once).map(|batch| {
        let mut columns = batch?;
        let samples = columns.lists(ACCELERATION)?;
        let place = columns.rows.schema().index_of(ACCELERATION);
        place.iter().for_each(|place| drop(columns.rows.remove_column(*place)));
        let mut motions = rows::from_batch::<MotionRow>(&columns)?;
        for ((row, motion), samples) in (columns.first_row..).zip(&mut motions).zip(samples) {
            motion.acceleration_m_s2 = samples;
            (motion.path, motion.row) = (columns.path.to_path_buf(), row);
        }
        Ok(Sampled { columns, motions })
    })
}

/// The names of motions, of a table or a partition of it, that are the second of two horizontal components of
/// an instrument.
pub fn second_of_pairs(path: &Path, partition: Option<Partition>) -> Result<HashSet<String>, TableError> {
    #[derive(Serialize, Deserialize)]
    struct Component {
        motion_id: String,
        dt_s: f64,
        origin: Origin,
    }
    let part = partition.filter(|_| path.is_dir());
    let file = part.map_or(Ok(path.to_path_buf()), |part| part.file_of(path))?;
    let components: Vec<Component> = rows::read(&file)?;
    if part.is_some() && components.iter().any(|one| one.origin.azimuth_deg.is_some()) {
        let problem = "components, whose pairs may be in other partitions; expected one file of all motions";
        return Err(TableError::table(&file, problem));
    }
    let origins: Vec<_> = components.iter().map(|one| (&one.origin, one.dt_s)).collect();
    Ok(pairs(&origins).into_iter().map(|[_, second]| components[second].motion_id.clone()).collect())
}

/// Makes a batch of `known` columns, the spectral accelerations at `periods_s`, and the samples as they are
/// written.
pub fn batch<'a>(
    known: &[RecordBatch],
    periods_s: &[f64],
    motions: impl Iterator<Item = (&'a MotionMeasures, &'a [f32])> + Clone,
) -> anyhow::Result<RecordBatch> {
    let item = Field::new("item", DataType::Float32, false);
    let mut lists = ListBuilder::new(Float32Builder::new()).with_field(item);
    for (_, samples) in motions.clone() {
        lists.values().append_slice(samples);
        lists.append(true);
    }
    let spectral = periods_s.iter().enumerate().map(|(place, period)| {
        let sa = motions.clone().map(|(measures, _)| measures.sa_m_s2[place]);
        (spectral_column(*period), Arc::new(Float64Array::from_iter(sa)) as ArrayRef, true)
    });
    let columns = spectral.chain([(ACCELERATION.to_string(), Arc::new(lists.finish()) as ArrayRef, false)]);
    side_by_side(&[known, &[RecordBatch::try_from_iter_with_nullable(columns)?]].concat())
}

/// Returns the column name of the spectral acceleration at a period (s): `sa_0p50_m_s2`.
fn spectral_column(period_s: f64) -> String {
    format!("sa_{}_m_s2", format!("{period_s:.2}").replace('.', "p"))
}

/// Returns the period (s) of a column of spectral accelerations; `None` for other columns.
pub fn spectral_period_s(column: &str) -> Option<f64> {
    column.strip_prefix("sa_")?.strip_suffix("_m_s2")?.replace('p', ".").parse().ok()
}
