//! simulate: every structure through every motion.

use std::cmp::Reverse;
use std::collections::{BTreeSet, HashSet};
use std::path::{Path, PathBuf};

use arrow_array::RecordBatch;
use clap::Args;
use clap::ValueHint::FilePath;
use rockfrag_core::rocking::{Outcome, Problem, Record, Structure, simulate_all, trace};
use rockfrag_core::warning::{Warning, Warnings};
use serde::{Deserialize, Serialize};

use super::shared::motions::{Measures, process_in_order, warnings};
use super::shared::objects::StructureArgs;
use crate::number::{self, counted, name};
use crate::pipeline::Stage;
use crate::pipeline::context::Context;
use crate::pipeline::options::first_lines;
use crate::pipeline::paths::{Files, Read, out_of_partition, part};
use crate::table::file::{ParquetTable, Partition};
use crate::table::motions::{self, MotionRow, Sampled, is_motion_column};
use crate::table::responses::{ResponseRow, TraceRow};
use crate::table::rows;

/// Motions that a thread takes at once: enough to keep the lanes of its registers busy, and few enough for
/// its caches.
const CHUNK: usize = 32;
/// Quiet time after a traced record in which free rocking shows, s.
const TRACE_TAIL_S: f64 = 10.0;
const ALL: &str = "all";
/// What is said where no structure is given.
const ASSUMED: &str = "frame and electrical-equipment of the paper; --width and --height for your own\n";

/// Simulate the rocking response of structures to motions: the paper's two structures, or your own
#[derive(Debug, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[command(after_help = "rockfrag simulate\n\
    rockfrag simulate --in motions.parquet --width 0.5 --height 1.9 --out responses.parquet\n\
    rockfrag simulate --structures objects.csv --trace all\n\
    rockfrag simulate --structure name=frame,p=1,alpha=0.15,eta=0.92 --partition 0/8")]
pub struct Simulate {
    /// Motions to read: motion_id, dt_s and acceleration_m_s2
    #[arg(long = "in", id = "in", value_name = "FILE", value_hint = FilePath, default_value = "motions.parquet")]
    #[serde(rename = "in")]
    input: PathBuf,
    /// Responses to write
    #[arg(long, value_name = "FILE", value_hint = FilePath, default_value = "responses.parquet")]
    out: PathBuf,
    #[command(flatten)]
    #[serde(flatten)]
    structures: StructureArgs,
    /// Also write the response to these motions over time, or to all, to NAME.trace.parquet: by a plain
    /// solver, which may disagree with the outcome when a structure nearly overturns
    #[arg(long, value_name = "ID,...", value_delimiter = ',', help_heading = None::<&str>)]
    trace: Vec<String>,
    /// Only part i of n (0 to n - 1), into the folder --out
    #[arg(long, value_name = "I/N", help_heading = None::<&str>)]
    partition: Option<Partition>,
}

impl Stage for Simulate {
    fn files(&self) -> Files {
        let traced = (!self.trace.is_empty()).then(|| part(&self.out, "trace"));
        let read = [Read::partition("in", &self.input, self.partition), self.structures.input()];
        Files::tables(read, traced.into_iter().chain([out_of_partition(&self.out, self.partition)]))
    }

    fn check(&self) -> anyhow::Result<()> {
        self.structures.or_paper().resolve(&mut self.structures.list.reader()).map(|_| ())
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let (structures, mut reader) = (self.structures.or_paper(), self.structures.list.reader());
        let objects = structures.resolve(&mut reader)?;
        let motions = motions::open(&self.input, self.partition)?;
        self.expect_traced(&motions)?;
        let mut second = HashSet::new();
        if objects.iter().any(|directions| directions.len() > 1) {
            second = motions::second_of_pairs(&self.input, self.partition)?;
        }
        if !second.is_empty() {
            reader.warnings.remove(Warning::OneDirection);
        }
        context.tell(reader.warnings, reader.readings);
        let [out, trace_file] = [out_of_partition(&self.out, self.partition), part(&self.out, "trace")];
        let mut writer = context.create(&out, &rows::schema::<ResponseRow>())?;
        let create_traces = || context.create(&trace_file, &rows::schema::<TraceRow>());
        let mut traces = (!self.trace.is_empty()).then(create_traces).transpose()?;
        let mut overturning = vec![0; objects.len()];
        process_in_order(
            &context.bar(motions.rows()),
            motions::parts(&motions, is_motion_column, CHUNK),
            |some| self.respond(some, &objects, &second),
            |some| {
                some.overturned.into_iter().for_each(|structure| overturning[structure] += 1);
                context.warn(some.warnings);
                traces.iter_mut().try_for_each(|traces| traces.append(&some.traces))?;
                Ok(writer.append(&some.rows)?)
            },
        )?;
        let assumed = if self.structures.is_given() { "" } else { ASSUMED };
        let summary = assumed.to_string() + &summary(&objects, &overturning, motions.rows(), &self.out);
        match traces {
            Some(traces) => context.finish(traces, &summary)?,
            None => context.remove_former(&out, trace_file),
        }
        context.finish(writer, &summary)?;
        Ok(summary)
    }
}

struct Responded {
    rows: RecordBatch,
    traces: RecordBatch,
    warnings: Warnings,
    /// Indices of structures, one for each motion that overturns them.
    overturned: Vec<usize>,
}

impl Simulate {
    /// Checks, before anything is simulated, that the motions to trace are there.
    fn expect_traced(&self, motions: &ParquetTable) -> anyhow::Result<()> {
        let mut unknown: BTreeSet<&str> = self.trace.iter().map(String::as_str).collect();
        unknown.remove(ALL);
        for batch in motions.batches(|name| name == "motion_id").take_while(|_| !self.trace.is_empty()) {
            for id in batch?.required_texts("motion_id")? {
                unknown.remove(&*id);
            }
        }
        let Some(id) = unknown.first() else { return Ok(()) };
        let file = self.input.display();
        anyhow::bail!("{file}: no motion '{id}' to trace; expected one of its motion_id, or {ALL}")
    }

    /// Runs all objects, each by its directions, on some motions: the weaker direction, but the other one on
    /// the second motion of a pair.
    fn respond(
        &self,
        some: Sampled,
        objects: &[Vec<Structure>],
        second: &HashSet<String>,
    ) -> anyhow::Result<Responded> {
        let motions = some.motions;
        let structures = |motion: &MotionRow| {
            let is_second = second.contains(&motion.motion_id);
            objects.iter().filter_map(move |all| if is_second { all.last() } else { all.first() })
        };
        let records = motions.iter().map(MotionRow::record).collect::<Result<Vec<_>, _>>()?;
        let pairs = motions.iter().zip(&records);
        let problems = pairs.clone().flat_map(|(motion, &record)| {
            structures(motion).map(move |structure| Problem { structure, record })
        });
        let mut responses = simulate_all(&problems.collect::<Vec<_>>()).into_iter();
        let (mut rows, mut overturned) = (Vec::new(), Vec::new());
        let (mut traces, mut warned) = (Vec::new(), Warnings::default());
        for (motion, record) in pairs {
            let measures = Measures::new(motion, record);
            let is_traced = self.trace.iter().any(|traced| *traced == ALL || *traced == motion.motion_id);
            for (index, (structure, response)) in structures(motion).zip(&mut responses).enumerate() {
                if response.outcome == Outcome::Overturned {
                    overturned.push(index);
                }
                rows.push(measures.response_row(motion, structure, response));
                if is_traced {
                    traces.extend(trace_rows(motion, record, structure));
                }
            }
            warned.extend(warnings(motion, record));
        }
        Ok(Responded {
            rows: rows::batch(&rows)?,
            traces: rows::batch(&traces)?,
            warnings: warned,
            overturned,
        })
    }
}

fn trace_rows(motion: &MotionRow, record: &Record, structure: &Structure) -> Vec<TraceRow> {
    let points = trace(structure, record, TRACE_TAIL_S).1;
    let ground = record.ground_at(points.iter().map(|point| point.time_s));
    let diagonal_m = structure.block_diagonal_m();
    let rows = points.into_iter().zip(ground).map(|(point, ground)| TraceRow {
        motion_id: motion.motion_id.clone(),
        structure: structure.name.clone(),
        time_s: point.time_s,
        theta_rad: point.theta_rad,
        theta_dot_rad_s: point.theta_dot_rad_s,
        theta_over_alpha: point.theta_rad / structure.alpha_rad,
        ground_acceleration_m_s2: ground.acceleration_m_s2,
        ground_velocity_m_s: ground.velocity_m_s,
        solver_event: point.solver_event,
        p_rad_s: structure.p_rad_s,
        alpha_rad: structure.alpha_rad,
        eta: structure.eta,
        block_width_m: diagonal_m * structure.alpha_rad.sin(),
        block_height_m: diagonal_m * structure.alpha_rad.cos(),
    });
    rows.collect()
}

/// How many motions overturn each structure, the weakest first.
fn summary(objects: &[Vec<Structure>], overturning: &[usize], motions: usize, out: &Path) -> String {
    let mut all: Vec<_> = objects.iter().zip(overturning).collect();
    all.sort_by_key(|(_, count)| Reverse(**count));
    let motions = counted(motions, "motion");
    let lines = all.into_iter().map(|(directions, count)| {
        format!("{}: overturned by {} of {motions}\n", name(&directions[0].name), number::count(*count))
    });
    first_lines(&lines.collect::<String>(), 0, out)
}
