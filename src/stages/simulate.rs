//! simulate: every structure through every motion.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use anyhow::bail;
use clap::Args;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::structures::{StructureSpec, Structures};
use crate::motion::{IntensityMeasures, IntensityScratch, intensity};
use crate::pipeline::console::Console;
use crate::pipeline::options::{Several, defaults};
use crate::pipeline::stage::{Stage, with_part};
use crate::pipeline::stream::{Pool, pipelined};
use crate::rocking::{Record, RecordError, Structure, simulate, trace};
use crate::table::TableError;
use crate::table::motions::{Motion, MotionBatches, MotionId, schema_by_name};
use crate::table::provenance::Provenance;
use crate::table::responses::{self, ResponseRow};
use crate::table::schema::{self, RESPONSES, TRACE, Table};
use crate::table::trace::{self as trace_table, TraceRow};
use crate::table::writer::TableWriter;

/// Motions that are read at once.
const BATCH: usize = 64;
/// Quiet time after a traced record in which free rocking shows, s.
const TRACE_TAIL_S: f64 = 10.0;

/// Which structures, and which motions to look at.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct SimulateOptions {
    /// Frequency parameter of the structure, rad/s
    #[arg(long, default_value = "2.5")]
    pub p: f64,
    /// Slenderness of the structure, rad
    #[arg(long, default_value = "0.20")]
    pub alpha: f64,
    /// Coefficient of restitution
    #[arg(long, default_value = "0.92")]
    pub eta: f64,
    /// Structures from a YAML or CSV file: p, alpha, eta; or width and height of a block (m), with beam-mass-ratio for
    /// a frame
    #[arg(long, conflicts_with_all = ["p", "alpha", "eta"])]
    pub structures: Option<Structures>,
    /// Motions whose response over time is written too, beside the output as NAME.trace.parquet
    #[arg(long, value_name = "ID,...")]
    pub trace: Option<Several<String>>,
}

impl Default for SimulateOptions {
    fn default() -> Self {
        defaults()
    }
}

impl SimulateOptions {
    /// Makes the path of a structures file relative to `folder`, that of the pipeline file.
    pub fn resolve_paths(&mut self, folder: &Path) {
        if let Some(Structures::File(path)) = &mut self.structures {
            *path = folder.join(&*path);
        }
    }

    fn structures(&self) -> anyhow::Result<Vec<Structure>> {
        match &self.structures {
            Some(structures) => structures.resolve(),
            None => {
                let one = StructureSpec {
                    p: Some(self.p),
                    alpha: Some(self.alpha),
                    eta: Some(self.eta),
                    ..StructureSpec::default()
                };
                Ok(vec![one.structure()?])
            }
        }
    }
}

/// The stage, ready to run.
pub struct Simulate {
    structures: Vec<Structure>,
    traced: Vec<String>,
    input: PathBuf,
    out: PathBuf,
}

impl Simulate {
    /// With the motions in `input`, into the file `out`.
    ///
    /// # Errors
    /// If the structures cannot be read or are impossible.
    pub fn new(options: &SimulateOptions, input: PathBuf, out: PathBuf) -> anyhow::Result<Simulate> {
        let traced = options.trace.clone().map_or(Vec::new(), |Several(ids)| ids);
        Ok(Simulate { structures: options.structures()?, traced, input, out })
    }

    fn respond(&self, motion: &Motion, scratch: &mut IntensityScratch) -> Result<Responded, TableError> {
        let record = self.record(motion)?;
        let peaks = Peaks::of(motion, &record, scratch);
        let rows = self.structures.iter().map(|structure| ResponseRow {
            motion_id: motion.motion_id.clone(),
            suite: motion.suite.clone(),
            structure: structure.clone(),
            response: simulate(structure, &record),
            mw: motion.mw,
            re_km: motion.re_km,
            pga_m_s2: peaks.pga_m_s2,
            pgv_m_s: peaks.pgv_m_s,
            tp_s: motion.tp_s,
            tm_s: peaks.tm_s,
            measures: IntensityMeasures::new(
                structure,
                peaks.pga_m_s2,
                peaks.pgv_m_s,
                motion.tp_s,
                peaks.tm_s,
            ),
        });
        let traced = self.traced.contains(&motion.motion_id.to_string());
        let traces = if traced { self.trace(motion) } else { Vec::new() };
        Ok(Responded { rows: rows.collect(), traces })
    }

    fn record<'a>(&self, motion: &'a Motion) -> Result<Record<'a>, TableError> {
        Record::new(&motion.acceleration_m_s2, motion.dt_s).map_err(|problem| TableError::Value {
            path: self.input.clone(),
            row: motion.row,
            column: match problem {
                RecordError::TimeStep(_) => schema::DT_S.name.to_string(),
                _ => schema::ACCELERATION_M_S2.name.to_string(),
            },
            problem: problem.to_string(),
        })
    }

    fn trace(&self, motion: &Motion) -> Vec<TraceRow> {
        let quiet = (TRACE_TAIL_S / motion.dt_s).ceil() as usize;
        let ended = [motion.acceleration_m_s2.as_slice(), &vec![0.0; quiet]].concat();
        let Ok(record) = Record::new(&ended, motion.dt_s) else { return Vec::new() };
        let rows = |structure: &Structure| {
            let (_, points) = trace(structure, &record);
            let row = |point| TraceRow {
                motion_id: motion.motion_id.clone(),
                structure: structure.name.clone(),
                alpha_rad: structure.alpha_rad,
                point,
                ground_m_s2: record.acceleration_at(point.time_s),
            };
            points.into_iter().map(row).collect::<Vec<_>>()
        };
        self.structures.iter().flat_map(rows).collect()
    }

    fn trace_path(&self) -> PathBuf {
        with_part(&self.out, "trace")
    }

    fn writer(
        &self,
        path: &Path,
        table: &Table,
        by_name: bool,
        provenance: &Provenance,
    ) -> Result<TableWriter, TableError> {
        let schema = if by_name { schema_by_name(table) } else { table.schema() };
        TableWriter::with_schema(path, table, schema, provenance.clone())
    }

    fn expect_traced(&self, traces: &[TraceRow]) -> anyhow::Result<()> {
        let seen: HashSet<String> = traces.iter().map(|row| row.motion_id.to_string()).collect();
        match self.traced.iter().find(|id| !seen.contains(*id)) {
            Some(id) => {
                bail!("{}: no motion '{id}' to trace; expected one of its motion_id", self.input.display())
            }
            None => Ok(()),
        }
    }
}

/// The motions so far; numbers take little room, as there may be millions.
#[derive(Default)]
struct SeenIds {
    numbers: HashSet<i64>,
    names: HashSet<String>,
}

impl SeenIds {
    /// Whether this one is new.
    fn insert(&mut self, id: &MotionId) -> bool {
        match id {
            MotionId::Number(number) => self.numbers.insert(*number),
            MotionId::Name(name) => self.names.insert(name.clone()),
        }
    }
}

/// What came of one motion.
struct Responded {
    rows: Vec<ResponseRow>,
    traces: Vec<TraceRow>,
}

/// Measures of the file, or of the record where the file has none.
struct Peaks {
    pga_m_s2: f64,
    pgv_m_s: f64,
    tm_s: Option<f64>,
}

impl Peaks {
    fn of(motion: &Motion, record: &Record, scratch: &mut IntensityScratch) -> Peaks {
        let (samples, dt_s) = (record.acceleration_m_s2(), record.dt_s());
        let pgv = || intensity::peak(&intensity::velocity(samples, dt_s));
        Peaks {
            pga_m_s2: motion.pga_m_s2.unwrap_or_else(|| intensity::peak(samples)),
            pgv_m_s: motion.pgv_m_s.unwrap_or_else(pgv),
            tm_s: motion.tm_s.or_else(|| intensity::mean_period(samples, dt_s, scratch)),
        }
    }
}

impl Stage for Simulate {
    fn subcommand(&self) -> &'static str {
        RESPONSES.stage
    }

    fn inputs(&self) -> Vec<(&'static str, PathBuf)> {
        vec![("motions", self.input.clone())]
    }

    fn outputs(&self) -> Vec<PathBuf> {
        if self.traced.is_empty() {
            vec![self.out.clone()]
        } else {
            vec![self.trace_path(), self.out.clone()]
        }
    }

    fn parameters(&self) -> Value {
        let structure =
            |s: &Structure| json!({ "name": s.name, "p": s.p_rad_s, "alpha": s.alpha_rad, "eta": s.eta });
        let structures: Vec<Value> = self.structures.iter().map(structure).collect();
        json!({ "structures": structures, "trace": self.traced, "path": "scalar" })
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let motions = MotionBatches::open(&self.input, BATCH)?;
        let (total, by_name) = (motions.rows(), motions.ids_are_names());
        let mut writer = self.writer(&self.out, &RESPONSES, by_name, provenance)?;
        let mut seen = SeenIds::default();
        let mut traces: Vec<TraceRow> = Vec::new();
        let pool = Pool::new(IntensityScratch::default);
        let bar = console.bar(self.subcommand(), total);
        pipelined(
            motions.map(|batch| Ok(batch?)),
            |motions| {
                let respond = |motion| pool.lend(|scratch| self.respond(motion, scratch));
                let responded =
                    motions.par_iter().map(respond).collect::<Result<Vec<Responded>, TableError>>()?;
                bar.inc(motions.len() as u64);
                Ok(responded)
            },
            |responded| {
                for motion in &responded {
                    if let Some(row) = motion.rows.first()
                        && !seen.insert(&row.motion_id)
                    {
                        bail!(
                            "{}: two motions are called '{}'; expected distinct motion_id",
                            self.input.display(),
                            row.motion_id
                        );
                    }
                }
                let (rows, traced): (Vec<_>, Vec<_>) =
                    responded.into_iter().map(|r| (r.rows, r.traces)).unzip();
                traces.extend(traced.into_iter().flatten());
                Ok(writer.append(&responses::batch(&rows.concat(), by_name)?)?)
            },
        )?;
        if !self.traced.is_empty() {
            self.expect_traced(&traces)?;
            let mut trace_writer = self.writer(&self.trace_path(), &TRACE, by_name, provenance)?;
            trace_writer.append(&trace_table::batch(&traces, by_name)?)?;
            trace_writer.finish()?;
        }
        writer.finish()?;
        bar.finish_and_clear();
        Ok(format!(
            "{} responses of {} structure(s)",
            total * self.structures.len() as u64,
            self.structures.len()
        ))
    }
}
