//! simulate: every structure through every motion.

mod options;
mod overturned;

use std::path::{Path, PathBuf};

use anyhow::bail;
use arrow_array::RecordBatch;
use rayon::prelude::*;
use serde_json::{Value, json};

pub use self::options::{SimulateOptions, simd};
use self::overturned::Overturned;
use super::shared::motions::{DistinctIds, FOR_RANKING, Judge, Peaks, note_passed_over, record};
use super::shared::partitions::{PartitionedInput, is_folder, out_of_partition};
use super::shared::reasons::{Case, Reasons};
use super::shared::structures::{parameters, warn_of_size};
use super::synthesize_motions::SynthesizeMotions;
use crate::motion::IntensityScratch;
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::declare::{Declare, Files, Input, Output};
use crate::pipeline::options::{Parsed, Several};
use crate::pipeline::stage::Stage;
use crate::pipeline::stream::{Pool, batches, pipelined};
use crate::rocking::{Problem, Record, Simd, Structure, simulate_all, trace, with_tail};
use crate::table::TableError;
use crate::table::motion_measures::own_columns;
use crate::table::motion_table::{MotionTable, Part};
use crate::table::motions::{self, Motion, MotionId};
use crate::table::responses::{RESPONSES, ResponseRow};
use crate::table::responses::{TRACE, TraceRow};
use crate::table::row::{WriteRow, schema_of};
use crate::table::store::folder;
use crate::table::store::provenance::Provenance;
use crate::table::store::source::{Source, Target};

/// Parts of the file that are read at once, for each thread.
const PARTS_A_THREAD: usize = 4;
/// Motions that a thread takes at once: enough to keep the lanes of its registers busy, and few enough for its caches.
const CHUNK: usize = 32;
/// Quiet time after a traced record in which free rocking shows, s.
const TRACE_TAIL_S: f64 = 10.0;

/// The stage, ready to run.
pub struct Simulate {
    structures: Vec<Structure>,
    simd: Simd,
    traced: Vec<String>,
    input: PartitionedInput,
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
            structures: options.structure.resolve()?,
            simd: simd(options.simd)?,
            traced: options.trace.clone().map_or(Vec::new(), |Several(ids)| ids),
            input: PartitionedInput::new(input.into(), partition)?,
            out: out.into(),
        })
    }

    /// Each motion is read once, and all structures run on it while it is at hand.
    fn respond(
        &self,
        path: &Path,
        motions: &[Motion],
        by_name: bool,
        judge: &Judge,
        scratch: &mut Scratch,
    ) -> anyhow::Result<Responded> {
        let Scratch { samples, intensity } = scratch;
        let records = records(path, motions, samples)?;
        let problems: Vec<Problem> = records
            .iter()
            .flat_map(|&record| self.structures.iter().map(move |structure| Problem { structure, record }))
            .collect();
        let mut responses = simulate_all(&problems, self.simd).into_iter();
        let mut rows = Vec::with_capacity(problems.len());
        let mut overturned = Overturned::new(&self.structures);
        for (motion, record) in motions.iter().zip(&records) {
            let peaks = Peaks::of(motion, record, intensity);
            for (place, (structure, response)) in self.structures.iter().zip(&mut responses).enumerate() {
                overturned.add(place, motion, record, &response);
                rows.push(peaks.response_row(motion, structure, response));
            }
        }
        let traced = motions.iter().zip(&records);
        let traced = traced.filter(|(motion, _)| self.traced.contains(&motion.motion_id.to_string()));
        let traces = traced.map(|(motion, record)| self.trace(&motion.motion_id, record, by_name));
        let judged = motions.iter().zip(&records);
        let doubts = judged
            .filter_map(|(motion, record)| judge.doubt(path, motion, record.acceleration_m_s2()))
            .collect();
        Ok(Responded {
            doubts,
            overturned,
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
                solver_event: point.solver_event,
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
                    self.input.source.name().display()
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
    doubts: Vec<Case>,
    overturned: Overturned,
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

impl Declare for Simulate {
    type Options = SimulateOptions;
    const NAME: &'static str = RESPONSES.stage;
    const ABOUT: &'static str = "Simulate the rocking response of structures to motions";
    const EXAMPLES: &'static str = "rockfrag simulate --width 0.5 --height 2.0\n\
        rockfrag simulate --structures paper --out both.parquet";
    const INPUTS: &'static [Input] = &[Input::file(
        "motions",
        "in",
        SynthesizeMotions::OUTPUT.file,
        "Motions to read; those of other programs need motion_id, dt_s and acceleration_m_s2",
    )];
    const OUTPUT: Output = Output::file(
        "responses.parquet",
        "Responses file to write, or folder of partitions [default: responses.parquet beside the input; for partitions, the folder responses]",
    )
    .with_parts(&["trace"]);

    fn create(options: &SimulateOptions, files: &Files) -> anyhow::Result<Simulate> {
        let partition = options.partition.map(|Parsed(partition)| partition);
        let out = out_of_partition(files, Self::OUTPUT.file, partition)?;
        Simulate::new(options, files.input("motions")?, out)
    }

    fn create_all(options: &SimulateOptions, files: &Files) -> anyhow::Result<Vec<Box<dyn Stage>>> {
        if let (Source::Path(input), Some(Target::Path(out))) =
            (files.input("motions")?, files.asked(Self::OUTPUT.file))
            && input.is_dir()
            && (is_folder(&out) || out.extension().is_none())
            && options.partition.is_none()
        {
            return each_file(options, &input, &out);
        }
        Ok(vec![Box::new(Simulate::create(options, files)?)])
    }
}

/// From a folder into a folder: a stage for each file.
fn each_file(options: &SimulateOptions, input: &Path, out: &Path) -> anyhow::Result<Vec<Box<dyn Stage>>> {
    if options.trace.is_some() {
        return Err(UsageError::because("trace needs one file; name it with --in or --out"));
    }
    let stage = |file: &PathBuf| -> anyhow::Result<Box<dyn Stage>> {
        let partition = folder::partition_of(file)?.map(Parsed);
        let options = SimulateOptions { partition, ..options.clone() };
        let out = out.join(file.file_name().unwrap_or_default());
        Ok(Box::new(Simulate::new(&options, file, out)?))
    };
    folder::files(input)?.iter().map(stage).collect()
}

impl Stage for Simulate {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        vec![("motions", self.input.source.clone())]
    }

    fn targets(&self) -> Vec<Target> {
        if self.traced.is_empty() {
            vec![self.out.clone()]
        } else {
            vec![self.trace_target(), self.out.clone()]
        }
    }

    fn parameters(&self) -> Value {
        let parameters = json!({ "structures": parameters(&self.structures), "trace": self.traced });
        self.input.add_to(parameters)
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        warn_of_size(&self.structures, console);
        let motions = MotionTable::open(&self.input.source, self.input.rows)?;
        note_passed_over(&self.input.source, &own_columns(&self.input.source)?, FOR_RANKING, console);
        let (total, by_name) = (motions.rows(), motions.ids_are_names());
        let mut writer = motions::writer(self.out.clone(), &RESPONSES, by_name, provenance)?;
        let of_others = motions.of_others();
        let (from_others, mut ids, judge) =
            (!of_others.is_empty(), DistinctIds::default(), Judge::new(of_others));
        let (mut traces, mut doubts): (Vec<Trace>, Reasons) = (Vec::new(), Reasons::default());
        let mut overturned = Overturned::new(&self.structures);
        let pool = Pool::new(Scratch::default);
        let bar = console.bar(self.name(), total);
        pipelined(
            batches(motions.parts(), PARTS_A_THREAD * rayon::current_num_threads()),
            |parts| {
                let simulate_part = |part: &Part| -> anyhow::Result<Vec<Responded>> {
                    let path = motions.path_of(part);
                    let simulate_chunk = |chunk: Result<Vec<Motion>, TableError>| {
                        let chunk = chunk?;
                        let responded =
                            pool.lend(|scratch| self.respond(&path, &chunk, by_name, &judge, scratch))?;
                        bar.inc(chunk.len() as u64)?;
                        Ok(responded)
                    };
                    motions.chunks(part, CHUNK)?.map(simulate_chunk).collect()
                };
                let responded: Vec<Vec<Responded>> =
                    parts.par_iter().map(simulate_part).collect::<anyhow::Result<_>>()?;
                Ok(responded.into_iter().flatten())
            },
            |responded| {
                for Responded { motion_ids, rows, traces: traced, doubts: doubtful, overturned: more } in
                    responded
                {
                    overturned.append(more);
                    ids.add(self.input.source.name(), &motion_ids)?;
                    traces.extend(traced);
                    doubtful.into_iter().for_each(|case| doubts.add(case));
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
        doubts.lines("motions").for_each(|line| console.warn(&line));
        if let Some(question) = overturned.question().filter(|_| from_others) {
            console.warn(&question);
        }
        console.note(&overturned.words(&self.structures, total));
        Ok(format!(
            "{} responses of {} structure(s)",
            total * self.structures.len() as u64,
            self.structures.len()
        ))
    }
}
