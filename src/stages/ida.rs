//! ida: every structure under every motion at rising intensity.

use std::collections::BTreeMap;
use std::path::PathBuf;

use arrow_array::RecordBatch;
use clap::Args;
use clap::ValueHint::FilePath;
use rockfrag_core::fragility::{Cluster, Group, KnownCapacity, fit_capacities};
use rockfrag_core::plausibility::MOST_SCALED;
use rockfrag_core::rocking::{
    Capacity, CapacityStatus, Problem, Record, Response, Scan, ScanPoint, ScanResponse, Structure,
    simulate_all,
};
use rockfrag_core::statistics::{FEW_EVENTS, FitStatus};
use rockfrag_core::units::G_M_S2;
use rockfrag_core::warning::{Warning, Warnings};
use serde::{Deserialize, Serialize};

use super::shared::fits::text;
use super::shared::motions::{Measures, process_in_order, warnings};
use super::shared::objects::StructureArgs;
use crate::pipeline::context::Context;
use crate::pipeline::options::number;
use crate::pipeline::paths::{Files, Read, part};
use crate::pipeline::{Stage, UsageError};
use crate::table::TableError;
use crate::table::motions::{self, MotionRow, Sampled, is_motion_column};
use crate::table::responses::{CapacityFitRow, CapacityRow, ResponseRow, ScaledMeasure};
use crate::table::{frame, rows};

/// Motions that a thread takes at once: enough to keep the lanes of its registers busy while outcomes are
/// bisected, and few enough to hear an interrupt within a second.
const MOTIONS: usize = 8;
const ANALYSES: usize = 480;
/// Scaled samples that are held at once, or those of one motion.
const MOST_SAMPLES: usize = 1 << 20;

/// What is printed of each structure.
const COLUMNS: &str = "suite structure measure theta theta_low theta_high beta n n_safe n_below \
                       half_overturn_at status";

/// Scale motions until they overturn each structure (incremental dynamic analysis)
#[derive(Debug, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[command(after_help = "rockfrag ida --width 0.5 --height 1.9 --measure pga --from 0.1 --to 3\n\
    rockfrag ida --in motions.parquet --structures objects.csv --out ida.parquet")]
pub struct Ida {
    /// Motions to read, as in simulate
    #[arg(long = "in", id = "in", value_name = "FILE", value_hint = FilePath, default_value = "motions.parquet")]
    #[serde(rename = "in")]
    input: PathBuf,
    /// Overturning intensities to write, with NAME.stripes.parquet and NAME.fragility.parquet beside
    #[arg(long, value_name = "FILE", value_hint = FilePath, default_value = "ida.parquet")]
    out: PathBuf,
    /// Intensity to scale by: scale (a factor), pga (g), pgv (m/s), im4, im5 or im6
    #[arg(long, default_value = "scale")]
    measure: ScaledMeasure,
    /// Smallest intensity, in the unit of --measure
    #[arg(long, default_value = "0.1", value_name = "IM",
          value_parser = number(1e-9..=1e9, "an intensity above 0"))]
    from: f64,
    /// Largest intensity, in the unit of --measure
    #[arg(long, default_value = "10", value_name = "IM",
          value_parser = number(1e-9..=1e9, "an intensity above 0"))]
    to: f64,
    /// Number of steps, in equal ratios
    #[arg(long, default_value = "60", value_name = "N",
          value_parser = number(1..=10_000_usize, "1 to 10,000"))]
    steps: usize,
    #[command(flatten)]
    #[serde(flatten)]
    structures: StructureArgs,
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct StripeRow {
    response: ResponseRow,
    measure: ScaledMeasure,
    intensity: f64,
    scale: f64,
}

struct Analysed {
    stripes: RecordBatch,
    scanned: Vec<Scanned>,
    warnings: Warnings,
}

struct Scanned {
    capacity: CapacityRow,
    /// Whether the structure overturns at each level.
    overturns: Vec<bool>,
}

struct SingleRecordIda<'a> {
    motion: &'a MotionRow,
    measures: Measures,
    structure: &'a Structure,
    /// The measure of the unscaled motion.
    unscaled: f64,
}

impl Stage for Ida {
    fn files(&self) -> Files {
        let beside = ["stripes", "fragility"].map(|name| part(&self.out, name));
        let read = [Read::new("in", [&self.input]), self.structures.input()];
        Files::tables(read, beside.iter().chain([&self.out]))
    }

    fn check(&self) -> anyhow::Result<()> {
        let Ida { from, to, .. } = self;
        let expected = match self.measure {
            _ if to <= from => format!("an intensity above {from}"),
            ScaledMeasure::Pga if *to > MOST_SCALED => "a PGA up to 20 g: is it in m/s2?".to_string(),
            ScaledMeasure::Pgv if *to > MOST_SCALED => "a PGV up to 20 m/s: is it in cm/s?".to_string(),
            _ => return self.structures.resolve(&mut self.structures.list.reader()).map(|_| ()),
        };
        Err(UsageError::because(format!("to is {to}; expected {expected}")))
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let mut reader = self.structures.list.reader();
        let objects = self.structures.resolve(&mut reader)?;
        context.tell(reader.warnings, reader.readings);
        let structures: Vec<&Structure> = objects.iter().map(|directions| &directions[0]).collect();
        let scan = Scan::new(self.from, self.to, self.steps);
        let motions = motions::open(&self.input, None)?;
        let [stripes_file, fragility_file] = ["stripes", "fragility"].map(|name| part(&self.out, name));
        let mut stripes = context.create(&stripes_file, &rows::schema::<StripeRow>())?;
        let mut scanned = Vec::new();
        process_in_order(
            &context.bar(motions.rows()),
            motions::parts(&motions, is_motion_column, (ANALYSES / self.steps).clamp(1, MOTIONS)),
            |some| self.analyse(&scan, &structures, some),
            |some| {
                stripes.append(&some.stripes)?;
                scanned.extend(some.scanned);
                context.warn(some.warnings);
                Ok(())
            },
        )?;
        let capacities = scanned.iter().map(|case| &case.capacity);
        let groups = frame::groups(capacities.map(|of| Group::of(&of.suite, &of.structure)))?;
        let groups = groups.iter().map(|rows| rows.iter().map(|&row| &scanned[row]).collect::<Vec<_>>());
        let fits: Vec<CapacityFitRow> = groups.map(|cases| self.fit(&scan.levels, &cases)).collect();
        context.warn(ends_early(&fits));
        let mut weakest_first: Vec<&CapacityFitRow> = fits.iter().collect();
        let median = |row: &CapacityFitRow| row.theta.value.unwrap_or(f64::INFINITY);
        weakest_first.sort_by(|a, b| median(a).total_cmp(&median(b)));
        let summary = text(weakest_first, COLUMNS, &fragility_file)?;
        let capacities: Vec<CapacityRow> = scanned.into_iter().map(|case| case.capacity).collect();
        context.finish(stripes, &summary)?;
        context.write(&fragility_file, &fits, &summary)?;
        context.write(&self.out, &capacities, &summary)?;
        Ok(summary)
    }
}

impl Ida {
    /// Scans each structure under each of some motions.
    fn analyse(&self, scan: &Scan, structures: &[&Structure], some: Sampled) -> anyhow::Result<Analysed> {
        let measure = self.measure;
        let (mut cases, mut warned) = (Vec::new(), Warnings::default());
        for motion in &some.motions {
            let record = motion.record()?;
            let measures = Measures::new(motion, &record);
            warned.extend(warnings(motion, &record));
            for &structure in structures {
                let unscaled = measure.unscaled(&measures, structure).ok_or_else(|| {
                    let problem = "above 0 to scale; leave the motion out, or take --measure scale";
                    motion.value_error(&format!("no {measure} {problem}"))
                })?;
                cases.push(SingleRecordIda { motion, measures, structure, unscaled });
            }
        }
        let responses = scan.run(cases.len(), |points| respond(&cases, points))?;
        let (mut stripes, mut scanned) = (Vec::new(), Vec::new());
        for (SingleRecordIda { motion, measures, structure, unscaled, .. }, responses) in
            cases.iter().zip(&responses)
        {
            let is_level = |at: &&ScanResponse| scan.levels.contains(&at.intensity);
            let at_levels = responses.iter().filter(is_level);
            let MotionRow { motion_id, suite, earthquake, mw, re_km, .. } = motion;
            let capacity = CapacityRow {
                motion_id: motion_id.clone(),
                suite: suite.clone(),
                earthquake: earthquake.clone(),
                mw: *mw,
                re_km: *re_km,
                structure: structure.name.clone(),
                measure,
                unscaled: *unscaled,
                found: Capacity::of(responses),
            };
            let overturns = at_levels.clone().map(ScanResponse::overturns).collect();
            scanned.push(Scanned { capacity, overturns });
            for &ScanResponse { intensity, response } in at_levels {
                let scale = intensity / unscaled;
                let response = measures.scaled(scale).response_row(motion, structure, response);
                stripes.push(StripeRow { response, measure, intensity, scale });
            }
        }
        Ok(Analysed { stripes: rows::batch(&stripes)?, scanned, warnings: warned })
    }

    fn fit(&self, levels: &[f64], cases: &[&Scanned]) -> CapacityFitRow {
        let found = cases.iter().map(|case| &case.capacity.found);
        let known = found.clone().map(|found| match (found.status, found.overturning) {
            (CapacityStatus::Overturns, Some(at)) => KnownCapacity::At(at),
            (CapacityStatus::Below, _) => KnownCapacity::Below(self.from),
            _ => KnownCapacity::Above(self.to),
        });
        // Clusters as in fits: by earthquake, else by magnitude and distance; what shares nothing is its own.
        let mut numbers = BTreeMap::new();
        let clusters = (0..).zip(cases).map(|(next, Scanned { capacity, .. })| {
            let cluster = Cluster::new(capacity.earthquake.as_deref(), capacity.mw, capacity.re_km);
            cluster.map_or(next, |cluster| *numbers.entry(cluster).or_insert(next))
        });
        let fit = fit_capacities(&known.collect::<Vec<_>>(), &clusters.collect::<Vec<_>>());
        let [n_safe, n_below] = [CapacityStatus::Safe, CapacityStatus::Below]
            .map(|status| found.clone().filter(|found| found.status == status).count() as i64);
        let first = &cases[0].capacity;
        CapacityFitRow {
            suite: first.suite.clone(),
            structure: first.structure.clone(),
            measure: first.measure,
            n: cases.len() as i64,
            n_safe,
            n_below,
            half_overturn_at: half_overturn_at(levels, cases),
            theta: fit.as_ref().map(|fit| fit.theta.into()).unwrap_or_default(),
            beta: fit.as_ref().map(|fit| fit.beta.into()).unwrap_or_default(),
            status: match fit {
                Ok(_) if cases.len() as i64 - n_safe - n_below < FEW_EVENTS as i64 => FitStatus::FewEvents,
                Ok(_) => FitStatus::Ok,
                Err(status) => status,
            },
        }
    }
}

/// The lowest level at which half of some motions overturn a structure, by the share in between: along ln
/// of the intensity. None if it is below the first level or above the last.
fn half_overturn_at(levels: &[f64], cases: &[&Scanned]) -> Option<f64> {
    let shares = (0..levels.len())
        .map(|level| cases.iter().filter(|case| case.overturns[level]).count() as f64 / cases.len() as f64);
    let shares: Vec<f64> = shares.collect();
    let at = shares.iter().position(|share| *share >= 0.5).filter(|&level| level > 0)?;
    let fraction = (0.5 - shares[at - 1]) / (shares[at] - shares[at - 1]);
    Some(levels[at - 1] * (levels[at] / levels[at - 1]).powf(fraction))
}

impl ScaledMeasure {
    /// The measure of a motion as it is; `None` if it has none, or the ground does not move.
    fn unscaled(self, measures: &Measures, structure: &Structure) -> Option<f64> {
        let dimensionless = measures.dimensionless(structure);
        let value = match self {
            ScaledMeasure::Scale => Some(1.0),
            ScaledMeasure::Pga => Some(measures.peaks.pga_m_s2 / G_M_S2),
            ScaledMeasure::Pgv => Some(measures.peaks.pgv_m_s),
            ScaledMeasure::Im4 => Some(dimensionless.im4),
            ScaledMeasure::Im5 => Some(dimensionless.im5),
            ScaledMeasure::Im6 => dimensionless.im6,
        };
        value.filter(|&value| value > 0.0)
    }
}

/// Simulates scaled copies of motions, as many at once as fit.
fn respond(cases: &[SingleRecordIda], points: &[ScanPoint]) -> Result<Vec<Response>, TableError> {
    let longest = cases.iter().map(|case| case.motion.acceleration_m_s2.len()).max().unwrap_or(0).max(1);
    let mut responses = Vec::with_capacity(points.len());
    for some in points.chunks((MOST_SAMPLES / longest).max(1)) {
        let scaled = some.iter().map(|point| {
            let SingleRecordIda { motion, unscaled, .. } = cases[point.case];
            let scale = point.intensity / unscaled;
            motion.acceleration_m_s2.iter().map(|sample| scale * sample).collect()
        });
        let scaled: Vec<Vec<f64>> = scaled.collect();
        let problems = some.iter().zip(&scaled).map(|(point, samples)| {
            let SingleRecordIda { motion, structure, .. } = cases[point.case];
            let record = Record::new(samples, motion.dt_s)
                .map_err(|problem| motion.value_error(&format!("{problem}; scale less by a lower --to")))?;
            Ok(Problem { structure, record })
        });
        responses.extend(simulate_all(&problems.collect::<Result<Vec<_>, TableError>>()?));
    }
    Ok(responses)
}

/// Warns of structures without a median: half of the motions or more do not overturn them, or do so at the
/// first intensity.
fn ends_early(fits: &[CapacityFitRow]) -> Warnings {
    let early = fits.iter().filter(|row| row.theta.value.is_none() && 2 * row.n_safe >= row.n);
    let late = fits.iter().filter(|row| 2 * row.n_below >= row.n);
    let early = early.map(|row| (Warning::ScanEndsEarly, row.structure.clone()));
    early.chain(late.map(|row| (Warning::ScanStartsLate, row.structure.clone()))).collect()
}
