//! simulate: every structure through every motion.

mod options;

use std::path::Path;

use anyhow::bail;
use arrow_array::RecordBatch;
use rayon::prelude::*;
use serde_json::{Value, json};

pub use self::options::SimulateOptions;
use super::motions::{Peaks, SeenIds, record};
use super::partitions::Share;
use super::structures::parameters;
use crate::motion::IntensityScratch;
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::options::{Parsed, Several};
use crate::pipeline::stage::Stage;
use crate::pipeline::stream::{Pool, batches, pipelined};
use crate::rocking::{Path as SolverPath, Problem, Record, Structure, simulate_all, trace, with_tail};
use crate::table::TableError;
use crate::table::motion_table::{MotionTable, Part};
use crate::table::motions::{self, Motion, MotionId};
use crate::table::partition::Partition;
use crate::table::provenance::Provenance;
use crate::table::responses::{RESPONSES, ResponseRow};
use crate::table::row::{WriteRow, schema_of};
use crate::table::source::{Source, Target};
use crate::table::trace::{TRACE, TraceRow};

/// Parts of the file that are read at once, for each thread.
const PARTS_A_THREAD: usize = 4;
/// Motions that a thread takes at once: enough to keep the lanes of its registers busy, and few enough for its caches.
const CHUNK: usize = 32;
/// Quiet time after a traced record in which free rocking shows, s.
const TRACE_TAIL_S: f64 = 10.0;

/// The stage, ready to run.
pub struct Simulate {
    structures: Vec<Structure>,
    path: SolverPath,
    traced: Vec<String>,
    share: Share,
    out: Target,
}

impl Simulate {
    /// With the motions in `input`, into `out`.
    ///
    /// # Errors
    /// If the structures cannot be read or are impossible, or there is no such partition.
    pub fn new(
        options: &SimulateOptions,
        input: impl Into<Source>,
        out: impl Into<Target>,
    ) -> anyhow::Result<Simulate> {
        let partition = options.partition.map(|Parsed(partition)| partition);
        if partition.is_some() && options.trace.is_some() {
            return Err(UsageError::because(
                "trace and partition exclude each other; trace motions of one file",
            ));
        }
        Ok(Simulate {
            structures: options.structures()?,
            path: options.path()?,
            traced: options.trace.clone().map_or(Vec::new(), |Several(ids)| ids),
            share: Share::of(input.into(), partition)?,
            out: out.into(),
        })
    }

    /// Each motion is read once, and all structures run on it while it is at hand.
    fn respond(
        &self,
        path: &Path,
        motions: &[Motion],
        by_name: bool,
        scratch: &mut Scratch,
    ) -> anyhow::Result<Responded> {
        let Scratch { samples, intensity } = scratch;
        let records = records(path, motions, samples)?;
        let problems: Vec<Problem> = records
            .iter()
            .flat_map(|&record| self.structures.iter().map(move |structure| Problem { structure, record }))
            .collect();
        let mut responses = simulate_all(&problems, self.path).into_iter();
        let mut rows = Vec::with_capacity(problems.len());
        for (motion, record) in motions.iter().zip(&records) {
            let peaks = Peaks::of(motion, record, intensity);
            let each = self.structures.iter().zip(&mut responses);
            rows.extend(each.map(|(structure, response)| peaks.response_row(motion, structure, response)));
        }
        let traced = motions.iter().zip(&records);
        let traced = traced.filter(|(motion, _)| self.traced.contains(&motion.motion_id.to_string()));
        let traces = traced.map(|(motion, record)| self.trace(&motion.motion_id, record, by_name));
        Ok(Responded {
            motion_ids: motions.iter().map(|motion| motion.motion_id.clone()).collect(),
            rows: ResponseRow::batch_in(&rows, &schema_of(&RESPONSES, by_name))?,
            traces: traces.collect::<anyhow::Result<_>>()?,
        })
    }

    /// Traces all structures under a motion.
    fn trace(&self, motion_id: &MotionId, record: &Record, by_name: bool) -> anyhow::Result<Trace> {
        let ended = with_tail(record, TRACE_TAIL_S);
        let record = Record::new(&ended, record.dt_s())?;
        let mut rows = Vec::new();
        for structure in &self.structures {
            let (_, points) = trace(structure, &record);
            rows.extend(points.into_iter().map(|point| TraceRow {
                motion_id,
                structure: &structure.name,
                time_s: point.time_s,
                theta_rad: point.theta_rad,
                theta_dot_rad_s: point.theta_dot_rad_s,
                theta_over_alpha: point.theta_rad / structure.alpha_rad,
                ground_m_s2: record.acceleration_at(point.time_s),
                solver_event: point.event,
            }));
        }
        let rows = TraceRow::batch_in(&rows, &schema_of(&TRACE, by_name))?;
        Ok(Trace { motion_id: motion_id.to_string(), rows })
    }

    fn trace_target(&self) -> Target {
        self.out.part("trace")
    }

    fn expect_traced(&self, traces: &[Trace]) -> anyhow::Result<()> {
        match self.traced.iter().find(|id| traces.iter().all(|trace| trace.motion_id != **id)) {
            Some(id) => {
                bail!(
                    "{}: no motion '{id}' to trace; expected one of its motion_id",
                    self.share.input.name().display()
                )
            }
            None => Ok(()),
        }
    }
}

/// The records of some motions, whose samples are laid out in `samples`.
fn records<'a>(
    path: &Path,
    motions: &[Motion],
    samples: &'a mut Vec<f64>,
) -> Result<Vec<Record<'a>>, TableError> {
    samples.clear();
    samples.reserve(motions.iter().map(|motion| motion.acceleration_m_s2.len()).sum());
    let mut ends = Vec::with_capacity(motions.len());
    for motion in motions {
        motion.acceleration_m_s2.append_to(samples);
        ends.push(samples.len());
    }
    let starts = std::iter::once(0).chain(ends.iter().copied());
    let ranges = starts.zip(ends.iter().copied());
    ranges.zip(motions).map(|((start, end), motion)| record(path, motion, &samples[start..end])).collect()
}

/// What came of some motions.
struct Responded {
    motion_ids: Vec<MotionId>,
    rows: RecordBatch,
    traces: Vec<Trace>,
}

/// The trace of a motion.
struct Trace {
    motion_id: String,
    rows: RecordBatch,
}

/// What a thread keeps from some motions to the next.
#[derive(Default)]
struct Scratch {
    samples: Vec<f64>,
    intensity: IntensityScratch,
}

impl Stage for Simulate {
    fn subcommand(&self) -> &'static str {
        RESPONSES.stage
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        vec![("motions", self.share.input.clone())]
    }

    fn targets(&self) -> Vec<Target> {
        if self.traced.is_empty() {
            vec![self.out.clone()]
        } else {
            vec![self.trace_target(), self.out.clone()]
        }
    }

    fn parameters(&self) -> Value {
        let parameters = json!({
            "structures": parameters(&self.structures), "trace": self.traced, "path": self.path.arithmetic()
        });
        Partition::add_to(self.share.partition, parameters)
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let motions = MotionTable::open(&self.share.input, self.share.rows)?;
        let (total, by_name) = (motions.rows(), motions.ids_are_names());
        let mut writer = motions::writer(self.out.clone(), &RESPONSES, by_name, provenance)?;
        let mut seen = SeenIds::default();
        let mut traces: Vec<Trace> = Vec::new();
        let pool = Pool::new(Scratch::default);
        let bar = console.bar(self.subcommand(), total);
        pipelined(
            batches(motions.parts(), PARTS_A_THREAD * rayon::current_num_threads()),
            |parts| {
                let respond = |part: &Part| -> anyhow::Result<Vec<Responded>> {
                    let path = motions.path_of(part);
                    let respond = |motions: Result<Vec<Motion>, TableError>| {
                        let motions = motions?;
                        let responded =
                            pool.lend(|scratch| self.respond(&path, &motions, by_name, scratch))?;
                        bar.inc(motions.len() as u64)?;
                        Ok(responded)
                    };
                    motions.chunks(part, CHUNK)?.map(respond).collect()
                };
                let responded: Vec<Vec<Responded>> =
                    parts.par_iter().map(respond).collect::<anyhow::Result<_>>()?;
                Ok(responded.into_iter().flatten())
            },
            |responded| {
                for Responded { motion_ids, rows, traces: traced } in responded {
                    seen.note(self.share.input.name(), &motion_ids)?;
                    traces.extend(traced);
                    writer.append(&rows)?;
                }
                Ok(())
            },
        )?;
        // Its footer is read once more at the end, to see that the file is the same: not two of them at a time.
        drop(motions);
        if !self.traced.is_empty() {
            self.expect_traced(&traces)?;
            let mut trace_writer = motions::writer(self.trace_target(), &TRACE, by_name, provenance)?;
            traces.iter().try_for_each(|trace| trace_writer.append(&trace.rows))?;
            trace_writer.finish()?;
        }
        writer.finish()?;
        bar.finish();
        Ok(format!(
            "{} responses of {} structure(s)",
            total * self.structures.len() as u64,
            self.structures.len()
        ))
    }
}
