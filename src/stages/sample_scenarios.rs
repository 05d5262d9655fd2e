//! sample-scenarios: the magnitude-distance grid and the random parameters of the pulses.

use clap::Args;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::motion::{Design, Grid};
use crate::pipeline::console::Console;
use crate::pipeline::declare::{Declare, Files, Output, StageOptions};
use crate::pipeline::options::{DEFAULT_SEED, Steps, Word, check, defaults};
use crate::pipeline::stage::Stage;
use crate::table::row::WriteRow;
use crate::table::scenarios::{SCENARIOS, ScenarioRow};
use crate::table::store::provenance::Provenance;
use crate::table::store::source::{Source, Target};
use crate::table::store::writer::TableWriter;

/// Cells in a row group.
const CELLS_AT_ONCE: usize = 64;
/// More than this is a slip of the finger.
const MOST_SAMPLES: usize = 10_000_000;

/// Which scenarios.
#[derive(Debug, Clone, PartialEq, Args, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct SampleScenariosOptions {
    /// Seed of the random parameters [default: 42]
    #[arg(long)]
    pub seed: Option<u64>,
    /// Scenarios in each cell of the grid
    #[arg(long, default_value = "100", value_name = "N")]
    pub samples: usize,
    /// Moment magnitudes: first:last:step, or numbers separated by commas
    #[arg(long, default_value = "5.5:7.5:0.5", value_name = "MW,...")]
    pub mw: Steps,
    /// Distances, km: first:last:step, or numbers separated by commas
    #[arg(long, default_value = "5:20:2.5", value_name = "KM,...")]
    pub re: Steps,
    /// How to sample each cell: lhs (Latin hypercube), random or sobol
    #[arg(long, default_value = "lhs")]
    pub design: Word<Design>,
}

impl Default for SampleScenariosOptions {
    fn default() -> Self {
        defaults()
    }
}

impl StageOptions for SampleScenariosOptions {
    fn seed(&mut self) -> Option<&mut Option<u64>> {
        Some(&mut self.seed)
    }
}

impl SampleScenariosOptions {
    fn grid(&self) -> anyhow::Result<Grid> {
        let within = |values: &[f64], low, high| values.iter().all(|value| (low..=high).contains(value));
        check(within(&self.mw.values, 3.0, 10.0), "mw", &self.mw, "moment magnitudes from 3 to 10")?;
        check(within(&self.re.values, 0.0, 1000.0), "re", &self.re, "distances from 0 to 1000 km")?;
        let possible = (1..=MOST_SAMPLES).contains(&self.samples);
        check(possible, "samples", self.samples, "1 to 10,000,000 scenarios a cell")?;
        Ok(Grid {
            mw: self.mw.values.clone(),
            re_km: self.re.values.clone(),
            samples: self.samples,
            design: self.design.0,
            seed: self.seed.unwrap_or(DEFAULT_SEED),
        })
    }
}

/// The stage, ready to run.
pub struct SampleScenarios {
    grid: Grid,
    out: Target,
}

impl SampleScenarios {
    /// Into `out`.
    ///
    /// # Errors
    /// If an option is out of range.
    pub fn new(options: &SampleScenariosOptions, out: impl Into<Target>) -> anyhow::Result<SampleScenarios> {
        Ok(SampleScenarios { grid: options.grid()?, out: out.into() })
    }
}

impl Declare for SampleScenarios {
    type Options = SampleScenariosOptions;
    const NAME: &'static str = SCENARIOS.stage;
    const ABOUT: &'static str = "Sample earthquake scenarios on a magnitude-distance grid";
    const EXAMPLES: &'static str = "rockfrag sample-scenarios\n\
        rockfrag sample-scenarios --mw 6.5,7 --re 5:15:5 --samples 50 --out near.parquet";
    const OUTPUT: Output =
        Output::file("scenarios.parquet", "Scenarios file to write [default: scenarios.parquet]");

    fn create(options: &SampleScenariosOptions, files: &Files) -> anyhow::Result<SampleScenarios> {
        SampleScenarios::new(options, files.out(Self::OUTPUT.file)?)
    }
}

impl Stage for SampleScenarios {
    fn name(&self) -> &'static str {
        Self::NAME
    }

    fn inputs(&self) -> Vec<(&'static str, Source)> {
        Vec::new()
    }

    fn targets(&self) -> Vec<Target> {
        vec![self.out.clone()]
    }

    fn parameters(&self) -> Value {
        let Grid { mw, re_km, samples, design, seed } = &self.grid;
        json!({ "mw": mw, "re": re_km, "samples": samples, "design": Word(*design), "seed": seed })
    }

    fn execute(&self, provenance: &Provenance, console: &Console) -> anyhow::Result<String> {
        let mut writer = TableWriter::create(self.out.clone(), &SCENARIOS, provenance.clone())?;
        let cells: Vec<usize> = (0..self.grid.cells()).collect();
        let bar = console.bar(self.name(), cells.len() as u64);
        for cells in cells.chunks(CELLS_AT_ONCE) {
            let scenarios: Vec<_> = cells.par_iter().map(|&cell| self.grid.scenarios_of_cell(cell)).collect();
            let rows: Vec<ScenarioRow> = scenarios.iter().flatten().map(ScenarioRow::from).collect();
            writer.write_row_group(&ScenarioRow::batch(&rows)?)?;
            bar.inc(cells.len() as u64)?;
        }
        bar.finish();
        writer.finish()?;
        Ok(format!("{} scenarios", self.grid.cells() * self.grid.samples))
    }
}
