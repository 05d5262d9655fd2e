//! synthesize-motions: the pulse, the high frequencies and their combination for every scenario.

mod options;

use rayon::prelude::*;
use serde_json::{Value, json};

pub use self::options::SynthesizeMotionsOptions;
use super::sample_scenarios::SampleScenarios;
use super::shared::measures::measure_plan;
use super::shared::partitions::out_of_partition;
use crate::motion::Site;
use crate::motion::{
    IntensityScratch, MeasurePlan, MotionModel, Scenario, StochasticModel, Suite, Synthesizer,
};
use crate::pipeline::console::Console;
use crate::pipeline::declare::{Declare, Files, Input, Output};
use crate::pipeline::options::{Parsed, Word};
use crate::pipeline::stage::Stage;
use crate::pipeline::stream::{Pool, pipelined};
use crate::table::scenarios;
use crate::table::store::partition::Partition;
use crate::table::store::provenance::Provenance;
use crate::table::store::source::{Source, Target};
use crate::table::store::writer::TableWriter;
use crate::table::synthetic_motions::{self, MOTIONS, SyntheticMotion};

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

impl Declare for SynthesizeMotions {
    type Options = SynthesizeMotionsOptions;
    const NAME: &'static str = MOTIONS.stage;
    const ABOUT: &'static str =
        "Synthesize near-fault ground motions: coherent pulse and stochastic high frequencies";
    const EXAMPLES: &'static str = "rockfrag synthesize-motions --in scenarios.parquet\n\
        rockfrag synthesize-motions --suite csgm --dt 0.01 --out combined.parquet";
    const INPUTS: &'static [Input] =
        &[Input::file("scenarios", "in", SampleScenarios::OUTPUT.file, "Scenarios to read")];
    const OUTPUT: Output = Output::file(
        "motions.parquet",
        "Motions file to write, or folder of partitions [default: motions.parquet beside the input; for partitions, the folder motions]",
    );

    fn create(options: &SynthesizeMotionsOptions, files: &Files) -> anyhow::Result<SynthesizeMotions> {
        let partition = options.partition.map(|Parsed(partition)| partition);
        let out = out_of_partition(files, Self::OUTPUT.file, partition)?;
        SynthesizeMotions::new(options, files.input("scenarios")?, out)
    }
}

impl Stage for SynthesizeMotions {
    fn name(&self) -> &'static str {
        Self::NAME
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
        let bar = console.bar(self.name(), scenarios.len() as u64);
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
