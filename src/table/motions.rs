//! The motions file: one row a ground motion, its samples as a list.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use arrow_array::builder::{Float32Builder, ListBuilder};
use arrow_array::{ArrayRef, Float64Array, Int64Array, RecordBatch, StringArray};
use arrow_schema::{ArrowError, DataType, Field, SchemaRef};

use super::TableError;
use super::columns::{Columns, Samples};
use super::measures;
use super::provenance::Provenance;
use super::reader::{Batch, Batches, TableFile, expect_columns};
use super::scenarios;
use super::schema::{self, Column};
use super::writer::TableWriter;
use crate::keyword::Keyword;
use crate::motion::{Measured, Scenario, Suite};

/// The stages whose output can stand as a motions file.
pub(super) const STAGES: [&str; 2] = ["synthesize-motions", "import-motions"];

/// The most motions that a thread reads at once.
const LARGEST_PART: usize = 128;

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

/// The motions of a file, some at a time.
pub struct MotionBatches {
    path: std::path::PathBuf,
    batches: Batches,
}

impl MotionBatches {
    /// Opens a motions file, ours or anyone's with the three columns that count, `batch_size` motions at a time.
    ///
    /// # Errors
    /// If the file is missing, unreadable, empty, of another stage, or lacks a column.
    pub fn open(path: &Path, batch_size: usize) -> Result<MotionBatches, TableError> {
        let batches = Batches::open(path, &STAGES, &READ, batch_size)?;
        expect_columns(path, batches.schema(), &REQUIRED)?;
        Ok(MotionBatches { path: path.to_path_buf(), batches })
    }

    /// How many motions the file has.
    pub fn rows(&self) -> u64 {
        self.batches.rows()
    }

    /// Whether motions go by name rather than by number.
    pub fn ids_are_names(&self) -> bool {
        ids_are_names(self.batches.schema())
    }
}

/// A motions file that several threads read.
pub struct MotionFile {
    path: PathBuf,
    file: TableFile,
    by_name: bool,
}

/// Some motions of a file, in order.
pub enum Part {
    /// A row group that is not yet read.
    RowGroup(usize),
    /// Rows of a row group that is too large to be read at once.
    Rows(Batch),
}

impl MotionFile {
    /// Opens a motions file.
    ///
    /// # Errors
    /// As [`MotionBatches::open`].
    pub fn open(path: &Path) -> Result<MotionFile, TableError> {
        let file = TableFile::open(path, &STAGES, &READ)?;
        let schema = file.schema()?;
        expect_columns(path, &schema, &REQUIRED)?;
        let by_name = ids_are_names(&schema);
        Ok(MotionFile { path: path.to_path_buf(), file, by_name })
    }

    /// How many motions the file has.
    pub fn rows(&self) -> u64 {
        self.file.rows_of_groups().iter().sum()
    }

    /// Whether motions go by name rather than by number.
    pub fn ids_are_names(&self) -> bool {
        self.by_name
    }

    /// All motions: row groups, which any thread may read, where they are small.
    pub fn parts(&self) -> impl Iterator<Item = Result<Part, TableError>> {
        let groups = self.file.rows_of_groups().into_iter().enumerate().filter(|&(_, rows)| rows > 0);
        groups.flat_map(|(group, rows)| -> Box<dyn Iterator<Item = Result<Part, TableError>> + Send> {
            if rows <= LARGEST_PART as u64 {
                return Box::new(std::iter::once(Ok(Part::RowGroup(group))));
            }
            match self.file.row_group(group, LARGEST_PART) {
                Ok(batches) => Box::new(batches.map(|batch| batch.map(Part::Rows))),
                Err(error) => Box::new(std::iter::once(Err(error))),
            }
        })
    }

    /// The row groups in which these rows lie, each with the rows of it, all ascending.
    pub fn groups_of(&self, rows: &[u64]) -> Vec<(usize, Vec<u64>)> {
        let mut first = 0;
        let groups = self.file.rows_of_groups().into_iter().enumerate().map(|(group, count)| {
            let inside = first..first + count;
            first += count;
            (group, rows.iter().copied().filter(|row| inside.contains(row)).collect::<Vec<u64>>())
        });
        groups.filter(|(_, rows)| !rows.is_empty()).collect()
    }

    /// The motions of a row group that `wanted` picks.
    ///
    /// # Errors
    /// If the file is damaged or a value cannot be used.
    pub fn pick(&self, group: usize, wanted: impl Fn(&Motion) -> bool) -> Result<Vec<Motion>, TableError> {
        let mut picked = Vec::new();
        for batch in self.file.row_group(group, LARGEST_PART)? {
            let Batch { rows, first_row } = batch?;
            let motions = motions_of(&Columns::new(&self.path, &rows, first_row), first_row)?;
            picked.extend(motions.into_iter().filter(&wanted));
        }
        Ok(picked)
    }

    /// The motions of a part.
    ///
    /// # Errors
    /// If the file is damaged or a value cannot be used.
    pub fn motions(&self, part: &Part) -> Result<Vec<Motion>, TableError> {
        let of = |Batch { rows, first_row }: &Batch| {
            motions_of(&Columns::new(&self.path, rows, *first_row), *first_row)
        };
        match part {
            Part::Rows(batch) => of(batch),
            Part::RowGroup(group) => {
                let batches = self.file.row_group(*group, LARGEST_PART)?;
                let motions = batches.map(|batch| of(&batch?)).collect::<Result<Vec<_>, TableError>>()?;
                Ok(motions.into_iter().flatten().collect())
            }
        }
    }
}

fn ids_are_names(schema: &SchemaRef) -> bool {
    let field = schema.field_with_name(schema::MOTION_ID.name);
    field.is_ok_and(|field| !field.data_type().is_numeric())
}

impl Iterator for MotionBatches {
    type Item = Result<Vec<Motion>, TableError>;

    fn next(&mut self) -> Option<Self::Item> {
        let batch = self.batches.next()?;
        Some(batch.and_then(|Batch { rows, first_row }| {
            motions_of(&Columns::new(&self.path, &rows, first_row), first_row)
        }))
    }
}

fn motions_of(columns: &Columns, first_row: u64) -> Result<Vec<Motion>, TableError> {
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
        row: first_row + row as u64,
    };
    Ok(ids.into_iter().zip(samples).enumerate().map(motion).collect())
}

/// Starts a file of a table in which motions go by number or by name.
///
/// # Errors
/// As [`TableWriter::create`].
pub fn writer(
    path: &Path,
    table: &schema::Table,
    by_name: bool,
    provenance: &Provenance,
) -> Result<TableWriter, TableError> {
    TableWriter::with_schema(path, table, schema_of(table, by_name), provenance.clone())
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
