//! ida: every structure under every motion at rising intensity.

use std::collections::{BTreeMap, HashSet};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use arrow_array::RecordBatch;
use clap::Args;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::shared::motions::{Measures, expect_distinct, warnings};
use super::shared::objects::StructureArgs;
use crate::fragility::{Cluster, KnownCapacity, fit_capacities};
use crate::motion::{IntensityMeasures, MeasureScratch};
use crate::number::{THREE_DIGITS, counted, fixed, name, significant};
use crate::pipeline::context::Context;
use crate::pipeline::options::{MOST_LINES, first_lines, number};
use crate::pipeline::paths::{Input, Output, Read, part};
use crate::pipeline::stream::{Pool, batches, pipelined};
use crate::pipeline::{InRun, Stage, UsageError};
use crate::plausibility::MOST_SCALED;
use crate::rocking::{
    CapacityStatus, Problem, Record, Response, Scan, ScanPoint, ScanResponse, Structure, simulate_all,
};
use crate::statistics::FitStatus;
use crate::table::TableError;
use crate::table::capacities::{CapacityFitRow, CapacityRow, ScaledMeasure};
use crate::table::motions::{self, ACCELERATION, Motion, Part};
use crate::table::responses::{self, ResponseRow};
use crate::table::{frame, rows};
use crate::units::G_M_S2;
use crate::warning::{Warning, Warnings};

/// Motions that a thread takes at once: enough to keep the lanes of its registers busy while outcomes are
/// bisected.
const CHUNK: usize = 8;
/// Scaled samples that are held at once, or those of one motion.
const MOST_SAMPLES: usize = 1 << 20;

/// Scale motions until they overturn each structure (incremental dynamic analysis)
#[derive(Debug, Args, Serialize)]
#[serde(rename_all = "kebab-case")]
pub struct Ida {
    /// Motions to read, as in simulate
    #[arg(long = "in", id = "in", value_name = "FILE", default_value = "motions.parquet")]
    input: Input,
    /// Overturning intensities to write, with NAME.stripes.parquet and NAME.fragility.parquet beside
    #[arg(long, value_name = "FILE", default_value = "ida.parquet")]
    out: Output,
    /// Intensity to scale by: scale (a factor), pga (g), pgv (m/s), im4, im5 or im6
    #[arg(long, default_value = "scale")]
    measure: ScaledMeasure,
    /// Smallest intensity, in the unit of --measure
    #[arg(long, default_value = "0.1", value_name = "IM", value_parser = number(1e-9..=1e9, "an intensity above 0"))]
    from: f64,
    /// Largest intensity, in the unit of --measure
    #[arg(long, default_value = "10", value_name = "IM", value_parser = number(1e-9..=1e9, "an intensity above 0"))]
    to: f64,
    /// Number of steps, in equal ratios
    #[arg(long, default_value = "60", value_name = "N", value_parser = number(1..=10_000_usize, "1 to 10,000"))]
    steps: usize,
    #[command(flatten)]
    #[serde(flatten)]
    structures: StructureArgs,
}

/// What a stripe has besides the response: the intensity, and the share of those up to the next that
/// overturn.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct StripeRow {
    measure: ScaledMeasure,
    intensity: f64,
    scale: f64,
    overturning_above: Option<f64>,
}

/// What came of some motions.
struct Analysed {
    motion_ids: Vec<String>,
    stripes: RecordBatch,
    capacities: Vec<CapacityRow>,
    /// Whether the structure overturns at each level, for each of the capacities.
    overturns: Vec<Vec<bool>>,
    warnings: Warnings,
}

/// A structure under a motion.
struct Case<'a> {
    path: &'a Path,
    motion: &'a Motion,
    measures: Measures,
    structure: &'a Structure,
    /// The measure of the unscaled motion.
    unscaled: f64,
}

impl Stage for Ida {
    fn in_run(run: &InRun) -> Vec<(&'static str, &'static str)> {
        vec![("in", run.motions())]
    }

    fn inputs(&self) -> Vec<Read> {
        vec![Read::new("in", [&*self.input]), self.structures.input()]
    }

    fn is_answer(&self) -> bool {
        true
    }

    fn outputs(&self) -> Vec<PathBuf> {
        vec![part(&self.out, "stripes"), part(&self.out, "fragility"), self.out.to_path_buf()]
    }

    fn check(&self) -> anyhow::Result<()> {
        if self.to <= self.from {
            return Err(UsageError::because(format!(
                "to is {}; expected an intensity above {}",
                self.to, self.from
            )));
        }
        let (most, expected) = match self.measure {
            ScaledMeasure::Pga => (MOST_SCALED, "a PGA up to 20 g: is it in m/s2?"),
            ScaledMeasure::Pgv => (MOST_SCALED, "a PGV up to 20 m/s: is it in cm/s?"),
            _ => (f64::INFINITY, ""),
        };
        if self.to > most {
            return Err(UsageError::because(format!("to is {}; expected {expected}", self.to)));
        }
        self.structures.resolve().map(|_| ())
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let (structures, warnings) = self.structures.resolve()?;
        context.warn(warnings);
        let scan = Scan::new(self.from, self.to, self.steps);
        let motions = motions::open(&self.input, None)?;
        let [stripes_file, fragility_file] = ["stripes", "fragility"].map(|name| part(&self.out, name));
        let mut stripes = context.create(&stripes_file, &stripes_of(&[], &[], &[])?.schema())?;
        let (mut ids, mut capacities, mut overturns) = (HashSet::new(), Vec::new(), Vec::new());
        let pool = Pool::new(MeasureScratch::default);
        let bar = context.bar(motions.rows());
        let analyse = |(path, some): (Arc<Path>, Vec<Motion>)| {
            bar.advance(some.len())?;
            pool.with(|scratch| self.analyse(&scan, &structures, &path, &some, scratch))
        };
        pipelined(
            batches(motions::parts(&motions), rayon::current_num_threads()),
            |parts| {
                let read = |part: Part| {
                    motions::read_part(&motions, part, CHUNK)?.collect::<Result<Vec<_>, TableError>>()
                };
                let chunks = parts.into_iter().map(read).collect::<Result<Vec<_>, TableError>>()?;
                chunks.concat().into_par_iter().map(analyse).collect::<anyhow::Result<Vec<Analysed>>>()
            },
            |analysed| {
                for some in analysed {
                    expect_distinct(&mut ids, &self.input, some.motion_ids)?;
                    stripes.append(&some.stripes)?;
                    capacities.extend(some.capacities);
                    overturns.extend(some.overturns);
                    context.warn(some.warnings);
                }
                Ok(())
            },
        )?;
        let groups = frame::groups(capacities.iter().map(CapacityRow::group))?;
        let fit = |rows: &Vec<usize>| CapacityFitRow {
            half_overturn_at: half_overturn_at(&scan.levels, &overturns, rows),
            ..self.fit(&capacities, rows)
        };
        let fits: Vec<_> = groups.iter().map(fit).collect();
        context.warn(ends_early(&fits));
        let summary = summary(&fits, &self.out);
        context.finish(stripes, &summary)?;
        context.write(&fragility_file, &fits, &summary)?;
        context.write(&self.out, &capacities, &summary)?;
        Ok(summary)
    }
}

impl Ida {
    /// Scans each structure under each of some motions.
    fn analyse(
        &self,
        scan: &Scan,
        structures: &[Structure],
        path: &Path,
        motions: &[Motion],
        scratch: &mut MeasureScratch,
    ) -> anyhow::Result<Analysed> {
        let (mut cases, mut warned) = (Vec::new(), Warnings::default());
        for motion in motions {
            let record = motion.record(path)?;
            let measures = Measures::new(motion, &record, scratch);
            warned.extend(warnings(motion, &record));
            for structure in structures {
                let unscaled = self.measure.unscaled(&measures, structure).ok_or_else(|| {
                    let problem = "above 0 to scale; leave the motion out, or take --measure scale";
                    value_error(path, motion, format!("no {} {problem}", self.measure))
                })?;
                cases.push(Case { path, motion, measures, structure, unscaled });
            }
        }
        let scans = scan.run(cases.len(), |points| respond(&cases, points))?;
        let (mut responses, mut measured) = (Vec::new(), Vec::new());
        let (mut stripes, mut capacities, mut overturns) = (Vec::new(), Vec::new(), Vec::new());
        for (case, scanned) in cases.iter().zip(&scans) {
            let capacity = scan.capacity(scanned);
            capacities.push(CapacityRow {
                motion_id: case.motion.motion_id.clone(),
                suite: case.motion.suite.clone(),
                earthquake: case.motion.earthquake.clone(),
                mw: case.motion.mw,
                re_km: case.motion.re_km,
                structure: case.structure.name.clone(),
                measure: self.measure,
                unscaled: case.unscaled,
                capacity: capacity.status,
                safe_below: capacity.safe_below,
                overturning_intensity: capacity.overturning,
                safe_up_to: capacity.safe_up_to,
            });
            let shares = scan.overturning_shares(scanned).into_iter().map(Some).chain([None]);
            let is_level = |at: &&ScanResponse| {
                scan.levels.binary_search_by(|level| level.total_cmp(&at.intensity)).is_ok()
            };
            overturns.push(scanned.iter().filter(is_level).map(ScanResponse::overturns).collect());
            for (at, overturning_above) in scanned.iter().filter(is_level).zip(shares) {
                let scale = at.intensity / case.unscaled;
                let measures = case.measures.scaled(scale);
                responses.push(measures.response_row(case.motion, case.structure, at.response));
                measured.push(measures.of_structure(case.structure));
                let (measure, intensity) = (self.measure, at.intensity);
                stripes.push(StripeRow { measure, intensity, scale, overturning_above });
            }
        }
        Ok(Analysed {
            motion_ids: motions.iter().map(|motion| motion.motion_id.clone()).collect(),
            stripes: stripes_of(&responses, &measured, &stripes)?,
            capacities,
            overturns,
            warnings: warned,
        })
    }

    /// The lognormal distribution of the capacities of a suite and structure, which are these rows.
    fn fit(&self, capacities: &[CapacityRow], rows: &[usize]) -> CapacityFitRow {
        let rows: Vec<&CapacityRow> = rows.iter().map(|&row| &capacities[row]).collect();
        let known = |row: &&CapacityRow| match (row.capacity, row.overturning_intensity) {
            (CapacityStatus::Overturns, Some(intensity)) => KnownCapacity::At(intensity),
            (CapacityStatus::Below, _) => KnownCapacity::Below(self.from),
            _ => KnownCapacity::Above(self.to),
        };
        let clusters = clusters(&rows);
        let fit = fit_capacities(&rows.iter().map(known).collect::<Vec<_>>(), &clusters);
        let count = |status: CapacityStatus| rows.iter().filter(|row| row.capacity == status).count() as i64;
        CapacityFitRow {
            suite: rows[0].suite.clone(),
            structure: rows[0].structure.clone(),
            measure: rows[0].measure,
            n: rows.len() as i64,
            n_safe: count(CapacityStatus::Safe),
            n_below: count(CapacityStatus::Below),
            half_overturn_at: None,
            theta: fit.as_ref().map(|fit| fit.theta.into()).unwrap_or_default(),
            beta: fit.as_ref().map(|fit| fit.beta.into()).unwrap_or_default(),
            status: fit.err().unwrap_or(FitStatus::Ok),
        }
    }
}

/// Numbers the clusters of capacities as fits do: by earthquake, else by magnitude and distance; a motion
/// that shares nothing is its own.
fn clusters(rows: &[&CapacityRow]) -> Vec<u32> {
    let mut numbers: BTreeMap<Cluster, u32> = BTreeMap::new();
    let mut next = 0..;
    let mut number = |row: &&CapacityRow| {
        let [mw, re_km] = [row.mw, row.re_km].map(|value| value.unwrap_or(f64::NAN));
        let new = next.next().unwrap_or(u32::MAX);
        match Cluster::of(row.earthquake.as_deref(), mw, re_km) {
            Some(cluster) => *numbers.entry(cluster).or_insert(new),
            None => new,
        }
    };
    rows.iter().map(&mut number).collect()
}

/// The lowest level at which half of some motions overturn a structure, by the share in between: along ln
/// of the intensity. None if it is below the first level or above the last.
fn half_overturn_at(levels: &[f64], overturns: &[Vec<bool>], rows: &[usize]) -> Option<f64> {
    let share =
        |level: usize| rows.iter().filter(|&&row| overturns[row][level]).count() as f64 / rows.len() as f64;
    let at = (0..levels.len()).find(|&level| share(level) >= 0.5).filter(|&level| level > 0)?;
    let (before, after) = (share(at - 1), share(at));
    let fraction = (0.5 - before) / (after - before);
    Some(levels[at - 1] * (levels[at] / levels[at - 1]).powf(fraction))
}

impl ScaledMeasure {
    /// Its name and unit, as they are printed.
    fn words(self) -> (&'static str, &'static str) {
        match self {
            ScaledMeasure::Scale => ("scale factor", ""),
            ScaledMeasure::Pga => ("PGA", " g"),
            ScaledMeasure::Pgv => ("PGV", " m/s"),
            ScaledMeasure::Im4 => ("IM4", ""),
            ScaledMeasure::Im5 => ("IM5", ""),
            ScaledMeasure::Im6 => ("IM6", ""),
        }
    }

    /// That of the unscaled motion; `None` if it has none, or the ground does not move.
    fn unscaled(self, measures: &Measures, structure: &Structure) -> Option<f64> {
        let dimensionless = measures.of_structure(structure);
        let value = match self {
            ScaledMeasure::Scale => Some(1.0),
            ScaledMeasure::Pga => Some(measures.pga_m_s2 / G_M_S2),
            ScaledMeasure::Pgv => Some(measures.pgv_m_s),
            ScaledMeasure::Im4 => Some(dimensionless.im4),
            ScaledMeasure::Im5 => Some(dimensionless.im5),
            ScaledMeasure::Im6 => dimensionless.im6,
        };
        value.filter(|&value| value > 0.0)
    }
}

/// Responses and what stripes have besides, side by side.
fn stripes_of(
    responses: &[ResponseRow],
    measures: &[IntensityMeasures],
    stripes: &[StripeRow],
) -> anyhow::Result<RecordBatch> {
    rows::side_by_side(&[responses::batch(responses, measures)?, rows::batch(stripes)?])
}

/// Simulates scaled copies of motions, as many at once as fit.
fn respond(cases: &[Case], points: &[ScanPoint]) -> Result<Vec<Response>, TableError> {
    let mut responses = Vec::with_capacity(points.len());
    let samples = |point: &ScanPoint| cases[point.case].motion.acceleration_m_s2.len();
    let mut rest = points;
    while !rest.is_empty() {
        let mut held = 0;
        let fits = |point: &&ScanPoint| {
            held += samples(point);
            held <= MOST_SAMPLES
        };
        let (block, later) = rest.split_at(rest.iter().take_while(fits).count().max(1));
        let scaled = |point: &ScanPoint| {
            let Case { motion, unscaled, .. } = cases[point.case];
            let scale = point.intensity / unscaled;
            motion.acceleration_m_s2.iter().map(|sample| scale * sample).collect()
        };
        let scaled: Vec<Vec<f64>> = block.iter().map(scaled).collect();
        let problems = block.iter().zip(&scaled).map(|(point, samples)| {
            let Case { path, motion, structure, .. } = cases[point.case];
            let record = Record::new(samples, motion.dt_s);
            let record = record.map_err(|problem| {
                value_error(path, motion, format!("{problem}; scale less by a lower --to"))
            })?;
            Ok(Problem { structure, record })
        });
        responses.extend(simulate_all(&problems.collect::<Result<Vec<_>, TableError>>()?));
        rest = later;
    }
    Ok(responses)
}

fn value_error(path: &Path, motion: &Motion, problem: String) -> TableError {
    let problem = format!("motion '{}': {problem}", motion.motion_id);
    TableError::value(path, motion.row, ACCELERATION, problem)
}

/// Of the structures that half of the motions or more do not overturn, or overturn at the first intensity, so
/// that there is no median.
fn ends_early(fits: &[CapacityFitRow]) -> Warnings {
    let early = fits.iter().filter(|row| row.theta.value.is_none() && 2 * row.n_safe >= row.n);
    let late = fits.iter().filter(|row| 2 * row.n_below >= row.n);
    let late = late.map(|row| (Warning::ScanStartsLate, row.structure.clone()));
    early.map(|row| (Warning::ScanEndsEarly, row.structure.clone())).chain(late).collect()
}

/// A line a structure: where half of the motions overturn it, and the median of the lowest intensities that
/// do; of many structures, the weakest.
fn summary(fits: &[CapacityFitRow], out: &Path) -> String {
    let mut fits: Vec<&CapacityFitRow> = fits.iter().collect();
    if fits.len() > MOST_LINES {
        let weakness =
            |row: &CapacityFitRow| row.half_overturn_at.or(row.theta.value).unwrap_or(f64::INFINITY);
        fits.sort_by(|a, b| weakness(a).total_cmp(&weakness(b)));
    }
    first_lines(&fits.iter().map(|row| line(row)).collect::<String>(), 0, out)
}

fn line(row: &CapacityFitRow) -> String {
    let suite = row.suite.as_deref().map_or(String::new(), |suite| format!(" ({})", name(suite)));
    let (measure, unit) = row.measure.words();
    let half = match row.half_overturn_at {
        Some(at) => format!("half of the motions overturn it at {measure} {}{unit}", significant(at, 3)),
        None if 2 * row.n_below >= row.n => {
            "half of the motions overturn it at the first intensity".to_string()
        }
        None => {
            let motions = counted(row.n as usize, "motion");
            format!("{} of {motions} never overturn it, half of them at no intensity", row.n_safe)
        }
    };
    let lowest = row.theta.value.zip(row.beta.value).map_or(String::new(), |(theta, beta)| {
        let limits = THREE_DIGITS.limits(row.theta, "95 % limits ");
        let (theta, beta) = (significant(theta, 3), fixed(beta, 2));
        format!("; lowest that overturns, median {theta}{unit} {limits}, dispersion {beta}")
    });
    format!("{}{suite}: {half}{lowest}\n", name(&row.structure))
}
