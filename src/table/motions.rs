//! The motions file: one row a ground motion, its samples as a list.

use std::ops::Range;
use std::path::Path;
use std::sync::Arc;

use arrow_array::builder::{Float32Builder, ListBuilder};
use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, StringArray};
use arrow_schema::{ArrowError, DataType, Field, SchemaRef};

use super::TableError;
use super::columns::Samples;
use super::measures;
use super::partition::Partition;
use super::provenance::Provenance;
use super::reader::{Batch, Batches, OpenTable, Run, expect_columns};
use super::scenarios;
use super::schema::{self, Column};
use super::source::{Source, Target};
use super::writer::TableWriter;
use crate::keyword::Keyword;
use crate::motion::{Measured, Scenario, Suite};

/// The stages whose output can stand as a motions file.
pub(super) const STAGES: [&str; 2] = ["synthesize-motions", "import-motions"];

/// The most motions that a thread reads at once.
const LARGEST_PART: usize = 128;
/// Motions of a row group that are decoded at once: few, since what decoding them takes besides is then soon used again. More
/// of it would be memory that the kernel has to clear first, which takes longer than to decode.
const DECODED_AT_ONCE: usize = 32;

/// What `simulate` cannot do without.
const REQUIRED: [Column; 3] = [schema::MOTION_ID, schema::DT_S, schema::ACCELERATION_M_S2];

/// What it reads where it is there.
const READ: [Column; 11] = [
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

/// A synthetic motion on its way into a file.
#[derive(Debug, Clone, PartialEq)]
pub struct SyntheticMotion {
    /// Unique in the file.
    pub motion_id: i64,
    /// Its kind.
    pub suite: Suite,
    /// The scenario it belongs to.
    pub scenario: Scenario,
    /// Time between samples, s.
    pub dt_s: f64,
    /// Samples, m/s2, as they are written.
    pub acceleration_m_s2: Vec<f32>,
    /// Intensity measures of these samples.
    pub measured: Measured,
}

/// The rows of the motions file in its schema, which has the spectral accelerations at its end.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn batch(motions: &[SyntheticMotion], schema: &SchemaRef) -> Result<RecordBatch, ArrowError> {
    let mut columns: Vec<ArrayRef> = vec![
        Arc::new(Int64Array::from_iter_values(motions.iter().map(|motion| motion.motion_id))),
        Arc::new(StringArray::from_iter_values(motions.iter().map(|motion| motion.suite.as_str()))),
    ];
    columns.extend(scenarios::columns(&motions.iter().map(|motion| motion.scenario).collect::<Vec<_>>()));
    columns.push(Arc::new(Float64Array::from_iter_values(motions.iter().map(|motion| motion.dt_s))));
    columns.extend(measures::columns(motions.iter().map(|motion| &motion.measured)));
    columns.push(samples(motions.iter().map(|motion| motion.acceleration_m_s2.as_slice())));
    columns.extend(measures::spectrum(motions.iter().map(|motion| &motion.measured)));
    RecordBatch::try_new(schema.clone(), columns)
}

/// The column of samples.
pub(super) fn samples<'a>(motions: impl Iterator<Item = &'a [f32]>) -> ArrayRef {
    let item = Field::new("item", DataType::Float32, false);
    let mut list = ListBuilder::new(Float32Builder::new()).with_field(item);
    for motion in motions {
        list.values().append_slice(motion);
        list.append(true);
    }
    Arc::new(list.finish())
}

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

/// A table of motions that several threads read.
pub struct MotionTable {
    table: OpenTable,
    rows: Range<u64>,
    by_name: bool,
}

/// Some motions, in order.
pub enum Part {
    /// Few, and not yet read.
    Unread(Run),
    /// Some of a row group that is too large to be read at once.
    Rows(Batch),
}

impl MotionTable {
    /// Opens a table of motions, or a partition of it.
    ///
    /// # Errors
    /// As [`MotionBatches::open`], or if motions go by name in one file and by number in another.
    pub fn open(source: impl Into<Source>, partition: Option<Partition>) -> Result<MotionTable, TableError> {
        let table = OpenTable::open(source, &STAGES, &READ)?;
        table.expect_rows(0)?;
        let schemas = table.schemas()?;
        schemas.iter().try_for_each(|(path, schema)| expect_columns(path, schema, &REQUIRED))?;
        let by_name = ids_are_names(&schemas[0].1);
        if let Some((path, schema)) = schemas.iter().find(|(_, schema)| ids_are_names(schema) != by_name) {
            let type_of = |schema: &SchemaRef| {
                schema
                    .field_with_name(schema::MOTION_ID.name)
                    .map_or(String::new(), |f| f.data_type().to_string())
            };
            return Err(TableError::WrongType {
                path: path.to_path_buf(),
                column: schema::MOTION_ID.name.to_string(),
                found: type_of(schema),
                expected: format!("{} as in {}", type_of(&schemas[0].1), schemas[0].0.display()),
            });
        }
        let total = table.rows();
        let rows = partition.map_or(0..total, |partition| partition.rows(total));
        Ok(MotionTable { table, rows, by_name })
    }

    /// How many motions there are.
    pub fn rows(&self) -> u64 {
        self.rows.end - self.rows.start
    }

    /// Whether motions go by name rather than by number.
    pub fn ids_are_names(&self) -> bool {
        self.by_name
    }

    /// All motions: row groups, which any thread may read, where they are small.
    pub fn parts(&self) -> impl Iterator<Item = Result<Part, TableError>> + Send {
        let runs = self.table.runs(self.rows.clone()).into_iter();
        runs.flat_map(|run| -> Box<dyn Iterator<Item = Result<Part, TableError>> + Send> {
            if run.rows <= LARGEST_PART as u64 {
                return Box::new(std::iter::once(Ok(Part::Unread(run))));
            }
            match self.table.batches_of(run, LARGEST_PART) {
                Ok(batches) => Box::new(batches.map(|batch| batch.map(Part::Rows))),
                Err(error) => Box::new(std::iter::once(Err(error))),
            }
        })
    }

    /// The file of a part, or the name of the table in memory.
    pub fn path_of(&self, part: &Part) -> Arc<Path> {
        match part {
            Part::Rows(batch) => batch.path.clone(),
            Part::Unread(run) => self.table.path_of(*run),
        }
    }

    /// The row groups in which these rows of the table lie, each with the rows of its file, all ascending.
    pub fn runs_of(&self, rows: &[u64]) -> Vec<(Run, Vec<u64>)> {
        let mut before = 0;
        let runs = self.table.runs(self.rows.clone()).into_iter().map(|run| {
            let inside = before..before + run.rows;
            before += run.rows;
            let rows = rows.iter().filter(|row| inside.contains(row));
            (run, rows.map(|row| run.first_row + (row - inside.start)).collect::<Vec<u64>>())
        });
        runs.filter(|(_, rows)| !rows.is_empty()).collect()
    }

    /// The motions of a run that `wanted` picks.
    ///
    /// # Errors
    /// If the file is damaged or a value cannot be used.
    pub fn pick(&self, run: Run, wanted: impl Fn(&Motion) -> bool) -> Result<Vec<Motion>, TableError> {
        let mut picked = Vec::new();
        for batch in self.table.batches_of(run, LARGEST_PART)? {
            picked.extend(motions_of(&batch?)?.into_iter().filter(&wanted));
        }
        Ok(picked)
    }

    /// The motions of a part.
    ///
    /// # Errors
    /// If the file is damaged or a value cannot be used.
    pub fn motions(&self, part: &Part) -> Result<Vec<Motion>, TableError> {
        match part {
            Part::Rows(batch) => motions_of(batch),
            Part::Unread(run) => {
                let batches = self.table.batches_of(*run, DECODED_AT_ONCE)?;
                let motions =
                    batches.map(|batch| motions_of(&batch?)).collect::<Result<Vec<_>, TableError>>()?;
                Ok(motions.into_iter().flatten().collect())
            }
        }
    }
}

fn ids_are_names(schema: &SchemaRef) -> bool {
    let field = schema.field_with_name(schema::MOTION_ID.name);
    field.is_ok_and(|field| !field.data_type().is_numeric())
}

fn motions_of(batch: &Batch) -> Result<Vec<Motion>, TableError> {
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
