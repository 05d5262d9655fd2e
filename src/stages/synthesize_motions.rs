//! synthesize-motions: the pulse, the high frequencies and their combination for every scenario.

use std::path::{Path, PathBuf};
use std::sync::Mutex;

use anyhow::Context as _;
use clap::Args;
use clap::ValueHint::FilePath;
use rockfrag_core::motion::{
    Difference, Epoch, LONGEST_MOTION, MeasurePlan, MotionMeasures, MotionModel, Scenario, SiteAmplification,
    StochasticModel, Suite, Synthesizer,
};
use serde::{Deserialize, Serialize};

use crate::inputs::{Grid, Heading};
use crate::number::{count, counted};
use crate::pipeline::context::Context;
use crate::pipeline::options::{Steps, number, periods};
use crate::pipeline::paths::{Files, Read, out_of_partition};
use crate::pipeline::stream::pipelined;
use crate::pipeline::{Stage, UsageError};
use crate::table::file::{ParquetTable, Partition};
use crate::table::{motions, rows};

const CHUNK: usize = 4;
/// Scenarios that are held in memory together, and samples of their longest motions.
const AT_ONCE: usize = 128;
const MOST_SAMPLES: usize = 1 << 23;

/// Synthesize near-fault ground motions: coherent pulse and stochastic high frequencies
#[derive(Debug, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[command(after_help = "rockfrag synthesize-motions\n\
    rockfrag synthesize-motions --in scenarios.parquet --suite csgm --dt 0.01 --site soil --seed 7 \
    --out motions.parquet\n\
    rockfrag synthesize-motions --sa 0.2,1.0 --partition 0/8")]
pub struct SynthesizeMotions {
    /// Scenarios to read
    #[arg(long = "in", id = "in", value_name = "FILE", value_hint = FilePath, default_value = "scenarios.parquet")]
    #[serde(rename = "in")]
    input: PathBuf,
    /// Motions to write
    #[arg(long, value_name = "FILE", value_hint = FilePath, default_value = "motions.parquet")]
    out: PathBuf,
    /// Seed of the noise
    #[arg(long, default_value = "42", value_parser = number(0..=u64::MAX, "a whole number of 0 or more"))]
    seed: u64,
    /// Suites: pulse (alone), hfc (high frequencies alone), csgm (both)
    #[arg(long, default_value = "pulse,csgm", value_delimiter = ',')]
    suite: Vec<Suite>,
    /// Time between samples, s
    #[arg(long, default_value = "0.005", value_name = "S",
          value_parser = number(1e-4..=0.1, "a time step from 0.0001 to 0.1 s"))]
    dt: f64,
    /// High frequencies where the pulse is stronger: left out (clamp), or as they are (none, the plain sum)
    #[arg(long, default_value = "clamp")]
    difference: Difference,
    /// Where the pulse peaks: envelope-peak, pga or pgv of the high frequencies
    #[arg(long, default_value = "envelope-peak")]
    epoch: Epoch,
    /// Site: rock, soil, none, or a CSV file of frequencies (Hz) and factors
    #[arg(long, default_value = "rock", value_hint = FilePath)]
    site: PathBuf,
    /// Window of the high frequencies, in durations of the earthquake
    #[arg(long, default_value = "1", value_name = "TIMES",
          value_parser = number(0.1..=10.0, "0.1 to 10 durations"))]
    window: f64,
    /// Shear-wave velocity of the crust, km/s
    #[arg(long, default_value = "3.7", value_name = "KM/S",
          value_parser = number(0.1..=10.0, "0.1 to 10 km/s"))]
    shear_velocity: f64,
    /// Near-surface attenuation kappa, s
    #[arg(long, default_value = "0.035", value_name = "S", value_parser = number(0.0..=1.0, "0 to 1 s"))]
    kappa: f64,
    /// Corner of the filter 1/sqrt(1 + (f/fmax)^8), Hz; 1e6 for none
    #[arg(long, default_value = "15", value_name = "HZ",
          value_parser = number(1e-6..=1e6, "a frequency above 0 Hz"))]
    fmax: f64,
    /// Corner of the high-pass filter 1/(1 + (fc/f)^8), Hz [default: none]
    #[arg(long, value_name = "HZ", value_parser = number(1e-6..=1e6, "a frequency above 0 Hz"))]
    low_cut: Option<f64>,
    /// Also compute the Housner intensity (15 times as slow)
    #[arg(long)]
    housner: bool,
    /// Add spectral accelerations (5 % damping) at these periods, s, as sa_0p20_m_s2
    #[arg(long, value_name = "S,...", value_parser = periods)]
    sa: Option<Steps>,
    /// Only part i of n (0 to n - 1), into the folder --out
    #[arg(long, value_name = "I/N")]
    partition: Option<Partition>,
}

/// A synthetic motion, its scenario, and the measures of its samples as they are written.
#[derive(Serialize, Deserialize)]
struct SyntheticMotion {
    motion_id: String,
    suite: Suite,
    dt_s: f64,
    scenario_id: i64,
    cell: i32,
    sample: i32,
    mw: f64,
    re_km: f64,
    /// The parameters of the pulse; high frequencies alone have none.
    vp_m_s: Option<f64>,
    tp_s: Option<f64>,
    gamma: Option<f64>,
    nu_rad: Option<f64>,
    measures: MotionMeasures,
    #[serde(skip)]
    acceleration_m_s2: Vec<f32>,
}

impl Stage for SynthesizeMotions {
    fn files(&self) -> Files {
        let read = [Read::new("in", [&self.input]), Read::new("site", [&self.site])];
        Files::tables(read, [out_of_partition(&self.out, self.partition)])
    }

    fn check(&self) -> anyhow::Result<()> {
        let is_once = |k: usize| self.suite[k] != Suite::Record && !self.suite[..k].contains(&self.suite[k]);
        let problem = "suite: expected some of pulse, csgm and hfc, each once";
        anyhow::ensure!((0..self.suite.len()).all(is_once), UsageError::because(problem));
        Ok(())
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let table = ParquetTable::open(&self.input)?.part(self.partition);
        let suites = &self.suite;
        let sa_periods_s = self.sa.as_ref().map_or(Vec::new(), |steps| steps.0.clone());
        let plan = MeasurePlan { housner: self.housner, sa_periods_s };
        let stochastic = StochasticModel {
            site: site(&self.site)?,
            shear_velocity_km_s: self.shear_velocity,
            window: self.window,
            kappa_s: self.kappa,
            fmax_hz: self.fmax,
            low_cut_hz: self.low_cut,
        };
        let Self { difference, epoch, seed, .. } = *self;
        let model = MotionModel { dt_s: self.dt, difference, epoch, stochastic, seed };
        // Of threads that are between two chunks.
        let idle: Mutex<Vec<Synthesizer>> = Mutex::default();
        let mut writer = context.create(&context.plan.outputs[0], &batch(&[], &plan)?.schema())?;
        let bar = context.bar(table.rows());
        let scenarios = rows::stream::<Scenario>(&table)?.flat_map(|read| {
            let parts = read.map_err(Into::into).and_then(|some| together(&some, &model));
            parts.map_or_else(|error| vec![Err(error)], |parts| parts.into_iter().map(Ok).collect())
        });
        pipelined(
            scenarios,
            |some| {
                bar.advance(some.len())?;
                let kept = idle.lock().ok().and_then(|mut idle| idle.pop());
                let mut synthesizer = kept.unwrap_or_else(|| Synthesizer::new(model.clone(), suites));
                let motions = some.iter().flat_map(|one| synthesize(one, suites, &plan, &mut synthesizer));
                let motions: Vec<SyntheticMotion> = motions.collect();
                let _ = idle.lock().map(|mut idle| idle.push(synthesizer));
                batch(&motions, &plan)
            },
            |batch| Ok(writer.append(&batch)?),
        )?;
        let motions = counted(table.rows() * suites.len(), "motion");
        let summary = format!("{motions} of {}\n", counted(table.rows(), "scenario"));
        context.finish(writer, &summary)?;
        Ok(summary)
    }
}

/// Parts scenarios into those whose motions fit into memory together, some for each thread.
fn together(some: &[Scenario], model: &MotionModel) -> anyhow::Result<Vec<Vec<Vec<Scenario>>>> {
    let lengths = some.iter().map(|scenario| (model.sample_count(scenario), scenario.scenario_id));
    let (longest, scenario) = lengths.max().unwrap_or_default();
    anyhow::ensure!(
        longest <= LONGEST_MOTION,
        "scenario {scenario}: a motion of {} samples; expected {} at most: choose a larger --dt",
        count(longest),
        count(LONGEST_MOTION)
    );
    let together = some.chunks((MOST_SAMPLES / longest.max(1)).min(AT_ONCE));
    Ok(together.map(|some| some.chunks(CHUNK).map(<[_]>::to_vec).collect()).collect())
}

fn site(name: &Path) -> anyhow::Result<SiteAmplification> {
    match name.to_str() {
        Some("rock") => Ok(SiteAmplification::rock()),
        Some("soil") => Ok(SiteAmplification::soil()),
        Some("none") => Ok(SiteAmplification::none()),
        _ => site_factors(name).with_context(|| {
            let name = name.display();
            format!("{name}: expected rock, soil, none, or a CSV file of frequency_hz and factor")
        }),
    }
}

fn site_factors(path: &Path) -> anyhow::Result<SiteAmplification> {
    let grid = Grid::read(path)?;
    let is_frequency = |Heading { name, unit, .. }: &Heading| match unit {
        Some(unit) => unit.name == "Hz",
        None => name.starts_with("freq") || name == "f",
    };
    let columns = match grid.headings.iter().map(is_frequency).collect::<Vec<_>>()[..] {
        [true, false] => [0, 1],
        [false, true] => [1, 0],
        [_, _] if !grid.has_headings => [0, 1],
        _ => anyhow::bail!("{}; expected frequency_hz and factor", grid.found()),
    };
    let [frequencies, factors] = columns.map(|column| grid.numbers(column));
    Ok(SiteAmplification::table(frequencies?.into_iter().zip(factors?).collect())?)
}

/// The motions of a scenario, each measured as it will be read.
fn synthesize(
    scenario: &Scenario,
    suites: &[Suite],
    plan: &MeasurePlan,
    synthesizer: &mut Synthesizer,
) -> Vec<SyntheticMotion> {
    let synthetic = synthesizer.synthesize(scenario);
    let dt_s = synthetic.dt_s;
    let Scenario { scenario_id, cell, sample, mw, re_km, vp_m_s, tp_s, gamma, nu_rad } = *scenario;
    let motions = suites.iter().map(|&suite| {
        let samples = synthetic.samples(suite).iter().copied();
        let (acceleration_m_s2, measures) = plan.measure_written(samples, dt_s);
        let motion_id = suite.motion_id(scenario_id).to_string();
        let [vp_m_s, tp_s, gamma, nu_rad] =
            [vp_m_s, tp_s, gamma, nu_rad].map(|of_pulse| Some(of_pulse).filter(|_| suite != Suite::Hfc));
        SyntheticMotion {
            motion_id,
            suite,
            dt_s,
            scenario_id,
            cell,
            sample,
            mw,
            re_km,
            vp_m_s,
            tp_s,
            gamma,
            nu_rad,
            measures,
            acceleration_m_s2,
        }
    });
    motions.collect()
}

fn batch(some: &[SyntheticMotion], plan: &MeasurePlan) -> anyhow::Result<arrow_array::RecordBatch> {
    let sampled = some.iter().map(|motion| (&motion.measures, motion.acceleration_m_s2.as_slice()));
    motions::batch(&[rows::batch(some)?], &plan.sa_periods_s, sampled)
}
