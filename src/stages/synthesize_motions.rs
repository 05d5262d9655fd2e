//! synthesize-motions: the pulse, the high frequencies and their combination for every scenario.

use std::path::Path;

use anyhow::Context;
use clap::Args;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::measures::measure_plan;
use super::sample_scenarios::DEFAULT_SEED;
use crate::motion::stochastic::{LowCut, Site};
use crate::motion::{
    Difference, Epoch, IntensityScratch, MeasurePlan, MotionModel, Scenario, StochasticModel, Suite,
    Synthesizer,
};
use crate::pipeline::UsageError;
use crate::pipeline::console::Console;
use crate::pipeline::options::{Parsed, Several, Steps, Word, check, defaults};
use crate::pipeline::stage::Stage;
use crate::pipeline::stream::{Pool, pipelined};
use crate::table::partition::Partition;
use crate::table::provenance::Provenance;
use crate::table::scenarios;
use crate::table::schema::MOTIONS;
use crate::table::source::{Source, Target};
use crate::table::synthetic_motions::{self, SyntheticMotion};
use crate::table::text_file;
use crate::table::writer::TableWriter;

/// The largest table of site amplification.
const MOST_SITE_MIB: u64 = 1;

/// How motions are made.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct SynthesizeMotionsOptions {
    /// Seed of the noise [default: 42]
    #[arg(long)]
    pub seed: Option<u64>,
    /// Suites, parted by commas: pulse, csgm (pulse and high frequencies), hfc (high frequencies alone)
    #[arg(long, default_value = "pulse,csgm")]
    pub suite: Several<Word<Suite>>,
    /// Time between samples, s
    #[arg(long, default_value = "0.005")]
    pub dt: f64,
    /// What the high frequencies keep where the pulse is the stronger: absolute, signed, clamp or none (plain sum)
    #[arg(long, default_value = "absolute")]
    pub difference: Word<Difference>,
    /// When the pulse peaks: at the peak of the envelope, or of the acceleration or velocity of the high frequencies
    /// (envelope-peak, pga, pgv)
    #[arg(long, default_value = "envelope-peak")]
    pub epoch: Word<Epoch>,
    /// Site amplification: rock, soil, none, or a CSV file of frequency in Hz and factor
    #[arg(long, default_value = "rock")]
    pub site: String,
    /// Near-surface attenuation kappa, s
    #[arg(long, default_value = "0.03")]
    pub kappa: f64,
    /// Corner of the filter 1/sqrt(1 + (f/fmax)^8), Hz [default: none]
    #[arg(long)]
    pub fmax: Option<f64>,
    /// Corner of the high-pass filter 1/(1 + (fc/f)^(2n)), Hz [default: none]
    #[arg(long)]
    pub low_cut: Option<f64>,
    /// Order n of the high-pass filter
    #[arg(long, default_value = "4")]
    pub low_cut_order: u32,
    /// Also compute the Housner intensity, which doubles the time
    #[arg(long)]
    pub housner: bool,
    /// Periods of spectral accelerations (5 % damping) that become columns, s: first:last:step, or numbers parted by
    /// commas; sa_0p20_m_s2 is that at 0.2 s
    #[arg(long)]
    pub sa: Option<Steps>,
    /// Scenarios in a row group: what is held in memory and read at once; the rows do not depend on it
    #[arg(long, default_value = "128")]
    pub row_group: usize,
    /// Only partition i of n, i from 0 to n - 1: an equal share of the scenarios; the output is then a folder, in which it is
    /// part-0000i.parquet
    #[arg(long, value_name = "I/N")]
    pub partition: Option<Parsed<Partition>>,
}

impl Default for SynthesizeMotionsOptions {
    fn default() -> Self {
        defaults()
    }
}

impl SynthesizeMotionsOptions {
    fn model(&self) -> anyhow::Result<MotionModel> {
        check((1e-4..=0.1).contains(&self.dt), "dt", self.dt, "a time step from 0.0001 to 0.1 s")?;
        check((0.0..=1.0).contains(&self.kappa), "kappa", self.kappa, "0 to 1 s")?;
        for (option, corner) in [("fmax", self.fmax), ("low-cut", self.low_cut)] {
            if let Some(corner) = corner {
                check(corner > 0.0 && corner.is_finite(), option, corner, "a frequency above 0 Hz")?;
            }
        }
        check((1..=20).contains(&self.low_cut_order), "low-cut-order", self.low_cut_order, "1 to 20")?;
        check((1..=4096).contains(&self.row_group), "row-group", self.row_group, "1 to 4096 scenarios")?;
        let low_cut = self.low_cut.map(|corner_hz| LowCut { corner_hz, order: self.low_cut_order });
        Ok(MotionModel {
            dt_s: self.dt,
            difference: self.difference.0,
            epoch: self.epoch.0,
            stochastic: StochasticModel {
                site: self.site()?,
                kappa_s: self.kappa,
                fmax_hz: self.fmax,
                low_cut,
            },
            seed: self.seed.unwrap_or(DEFAULT_SEED),
        })
    }

    fn site(&self) -> anyhow::Result<Site> {
        match self.site.as_str() {
            "rock" => Ok(Site::Rock),
            "soil" => Ok(Site::Soil),
            "none" => Ok(Site::None),
            file => {
                let expected = || {
                    UsageError(format!(
                        "site is '{file}'; expected rock, soil, none, or a CSV file with a header line"
                    ))
                };
                let text = text_file::text(Path::new(file), MOST_SITE_MIB, "amplification by frequency")
                    .with_context(expected)?;
                let rows = csv::Reader::from_reader(text.as_bytes()).into_deserialize();
                let rows = rows.collect::<Result<Vec<(f64, f64)>, _>>().with_context(expected)?;
                Site::table(rows).with_context(expected)
            }
        }
    }

    fn suites(&self) -> anyhow::Result<Vec<Suite>> {
        let suites: Vec<Suite> = self.suite.0.iter().map(|word| word.0).collect();
        let made = |suite: &Suite| matches!(suite, Suite::Pulse | Suite::Csgm | Suite::Hfc);
        let distinct = (1..suites.len()).all(|k| !suites[..k].contains(&suites[k]));
        let words: Vec<String> = self.suite.0.iter().map(ToString::to_string).collect();
        let fine = !suites.is_empty() && suites.iter().all(made) && distinct;
        check(fine, "suite", words.join(","), "some of pulse, csgm and hfc, each once")?;
        Ok(suites)
    }
}

/// The stage, ready to run.
pub struct SynthesizeMotions {
    model: MotionModel,
    suites: Vec<Suite>,
    plan: MeasurePlan,
    row_group: usize,
    partition: Option<Partition>,
    input: Source,
    out: Target,
}

impl SynthesizeMotions {
    /// From the scenarios in `input`, into `out`.
    ///
    /// # Errors
    /// If an option is out of range or the site table cannot be read.
    pub fn new(
        options: &SynthesizeMotionsOptions,
        input: impl Into<Source>,
        out: impl Into<Target>,
    ) -> anyhow::Result<SynthesizeMotions> {
        let (model, suites) = (options.model()?, options.suites()?);
        Ok(SynthesizeMotions {
            model,
            suites,
            plan: measure_plan(options.housner, options.sa.as_ref())?,
            row_group: options.row_group,
            partition: options.partition.map(|Parsed(partition)| partition),
            input: input.into(),
            out: out.into(),
        })
    }

    fn motions_of(&self, scenario: &Scenario, scratch: &mut Scratch) -> Vec<SyntheticMotion> {
        let Scratch { synthesizer, intensity } = scratch;
        let synthetic = synthesizer.synthesize(scenario);
        let motion = |&suite| {
            let acceleration_m_s2: Vec<f32> = synthetic.samples(suite).iter().map(|&a| a as f32).collect();
            // Measured as it will be read.
            let written: Vec<f64> = acceleration_m_s2.iter().map(|&a| f64::from(a)).collect();
            SyntheticMotion {
                motion_id: suite.motion_id(scenario.scenario_id),
                suite,
                scenario: *scenario,
                dt_s: synthetic.dt_s,
                measured: self.plan.measure(&written, synthetic.dt_s, intensity),
                acceleration_m_s2,
            }
        };
        self.suites.iter().map(motion).collect()
    }
}

/// What a thread keeps from one scenario to the next.
struct Scratch {
    synthesizer: Synthesizer,
    intensity: IntensityScratch,
}

impl Stage for SynthesizeMotions {
    fn subcommand(&self) -> &'static str {
        MOTIONS.stage
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        vec![("scenarios", self.input.clone())]
    }

    fn targets(&self) -> Vec<Target> {
        vec![self.out.clone()]
    }

    fn parameters(&self) -> Value {
        let MotionModel { dt_s, difference, epoch, stochastic, seed } = &self.model;
        let StochasticModel { site, kappa_s, fmax_hz, low_cut } = stochastic;
        let site = match site {
            Site::Rock => json!("rock"),
            Site::Soil => json!("soil"),
            Site::None => json!("none"),
            Site::Table(rows) => json!(rows),
        };
        let suites: Vec<_> = self.suites.iter().map(|&suite| Word(suite)).collect();
        let parameters = json!({
            "suite": suites, "dt": dt_s, "difference": Word(*difference), "epoch": Word(*epoch), "site": site,
            "kappa": kappa_s, "fmax": fmax_hz, "low-cut": low_cut.map(|cut| (cut.corner_hz, cut.order)),
            "housner": self.plan.housner, "sa": self.plan.sa_periods_s, "seed": seed,
        });
        Partition::add_to(self.partition, parameters)
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let all = scenarios::read(&self.input)?;
        let rows = self.partition.map_or(0..all.len() as u64, |partition| partition.rows(all.len() as u64));
        let scenarios = &all[rows.start as usize..rows.end as usize];
        let (model, suites) = (self.model.clone(), self.suites.clone());
        let pool = Pool::new(move || Scratch {
            synthesizer: Synthesizer::new(model.clone(), &suites),
            intensity: IntensityScratch::default(),
        });
        let schema = MOTIONS.schema_with_spectrum(&self.plan.sa_periods_s);
        let mut writer =
            TableWriter::with_schema(self.out.clone(), &MOTIONS, schema.clone(), provenance.clone())?;
        let bar = console.bar(self.subcommand(), scenarios.len() as u64);
        pipelined(
            scenarios.chunks(self.row_group).map(Ok),
            |scenarios| {
                let motions: Vec<SyntheticMotion> = scenarios
                    .par_iter()
                    .flat_map_iter(|scenario| pool.lend(|scratch| self.motions_of(scenario, scratch)))
                    .collect();
                bar.inc(scenarios.len() as u64)?;
                Ok(synthetic_motions::batch(&motions, &schema)?)
            },
            |batch| Ok(writer.write_row_group(&batch)?),
        )?;
        writer.finish()?;
        bar.finish();
        Ok(format!("{} motions", scenarios.len() * self.suites.len()))
    }
}
