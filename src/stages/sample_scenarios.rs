//! sample-scenarios: the magnitude-distance grid and the random parameters of the pulses.

use std::ops::RangeInclusive;
use std::path::PathBuf;

use clap::Args;
use clap::ValueHint::FilePath;
use rayon::prelude::*;
use rockfrag_core::motion::{Design, Scenario, ScenarioGrid};
use rockfrag_core::plausibility::{DISTANCES_KM, MAGNITUDES};
use rockfrag_core::warning::Warning;
use serde::{Deserialize, Serialize};

use crate::number::counted;
use crate::pipeline::Stage;
use crate::pipeline::context::Context;
use crate::pipeline::options::{Steps, number, steps};
use crate::pipeline::paths::Files;
use crate::table::rows;

/// Sample earthquake scenarios on a magnitude-distance grid
#[derive(Debug, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[command(after_help = "rockfrag sample-scenarios\n\
    rockfrag sample-scenarios --mw 6:7:0.5 --re 5,10,20 --samples 200 --seed 7 --out scenarios.parquet")]
pub struct SampleScenarios {
    /// Seed of the random parameters
    #[arg(long, default_value = "42", value_parser = number(0..=u64::MAX, "a whole number of 0 or more"))]
    seed: u64,
    /// Scenarios in each cell of the grid
    #[arg(long, default_value = "100", value_name = "N",
          value_parser = number(1..=10_000_000_usize, "1 to 10,000,000"))]
    samples: usize,
    /// Moment magnitudes: first:last:step, or numbers separated by commas
    #[arg(long, default_value = "5.5:7.5:0.5", value_name = "MW,...",
          value_parser = steps(MAGNITUDES, "expected moment magnitudes from 1 to 9.9"))]
    mw: Steps,
    /// Distances, km: first:last:step, or numbers separated by commas
    #[arg(long, default_value = "5:20:2.5", value_name = "KM,...",
          value_parser = steps(DISTANCES_KM, "expected distances from 0 to 1000 km"))]
    re: Steps,
    /// How to sample each cell: lhs (Latin hypercube) or random
    #[arg(long, default_value = "lhs")]
    design: Design,
    /// Scenarios to write
    #[arg(long, value_name = "FILE", value_hint = FilePath, default_value = "scenarios.parquet")]
    out: PathBuf,
}

const AT_ONCE: usize = 32_768;

/// Magnitudes that the paper samples, and distances up to those, km: Eqs. 2 and 3 hold near the fault.
const PAPER_MW: RangeInclusive<f64> = 5.5..=7.5;
const PAPER_RE_KM: RangeInclusive<f64> = 0.0..=20.0;

impl Stage for SampleScenarios {
    fn files(&self) -> Files {
        Files::tables([], [&self.out])
    }

    fn run(&self, context: &Context) -> anyhow::Result<String> {
        let SampleScenarios { samples, design, seed, .. } = *self;
        let (mw, re_km) = (self.mw.0.clone(), self.re.0.clone());
        let grid = ScenarioGrid { mw, re_km, samples, design, seed };
        let all = grid.cells() * samples;
        let summary = format!("{} in {}\n", counted(all, "scenario"), counted(grid.cells(), "cell"));
        let axes = [("mw", &grid.mw, PAPER_MW), ("re", &grid.re_km, PAPER_RE_KM)];
        let unusual = axes.iter().filter_map(|(name, values, usual)| {
            let value = values.iter().find(|value| !usual.contains(value))?;
            Some((Warning::UnusualScenario, format!("{name} {value}")))
        });
        context.warn(unusual.collect());
        let mut writer = context.create(&self.out, &rows::schema::<Scenario>())?;
        let bar = context.bar(all);
        for cell in (0..grid.cells()).map(|cell| grid.cell(cell)) {
            for first in (0..samples).step_by(AT_ONCE) {
                let some = first..samples.min(first + AT_ONCE);
                bar.advance(some.len())?;
                let some: Vec<Scenario> = some.into_par_iter().map(|sample| cell.scenario(sample)).collect();
                writer.append(&rows::batch(&some)?)?;
            }
        }
        context.finish(writer, &summary)?;
        Ok(summary)
    }
}
