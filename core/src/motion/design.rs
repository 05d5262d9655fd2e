//! Samples the random parameters of scenarios (section 2.1.1).

use rand::RngExt;
use rand::seq::SliceRandom;

use super::scenario::Scenario;
use crate::random::{Purpose, stream};
use crate::spelling::unknown_word;

/// Sampling of the four random parameters in a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<Design>)]
pub enum Design {
    /// Latin hypercube: each parameter has as many strata as samples, and one sample in each.
    Lhs,
    Random,
}

/// Number of random parameters: Vp, Tp, gamma and nu.
const DIMENSIONS: usize = 4;

/// The magnitude-distance grid and how its cells are sampled (section 2.1.1).
#[derive(Debug, Clone, PartialEq)]
pub struct ScenarioGrid {
    pub mw: Vec<f64>,
    pub re_km: Vec<f64>,
    /// Scenarios in each cell.
    pub samples: usize,
    pub design: Design,
    pub seed: u64,
}

impl ScenarioGrid {
    pub fn cells(&self) -> usize {
        self.mw.len() * self.re_km.len()
    }

    /// The cells of a magnitude are adjacent.
    pub fn cell(&self, cell: usize) -> Cell<'_> {
        let strata = |dimension: usize| {
            let mut strata: Vec<u32> = (0..self.samples as u32).collect();
            let row = (cell * DIMENSIONS + dimension) as u64;
            strata.shuffle(&mut stream(self.seed, Purpose::Strata, row));
            strata
        };
        let is_lhs = self.design == Design::Lhs;
        Cell { grid: self, cell, strata: is_lhs.then(|| std::array::from_fn(strata)) }
    }

    pub fn scenarios_of_cell(&self, cell: usize) -> Vec<Scenario> {
        let cell = self.cell(cell);
        (0..self.samples).map(|sample| cell.scenario(sample)).collect()
    }
}

pub struct Cell<'a> {
    grid: &'a ScenarioGrid,
    cell: usize,
    /// The stratum of each sample, for each parameter of a Latin hypercube.
    strata: Option<[Vec<u32>; DIMENSIONS]>,
}

impl Cell<'_> {
    pub fn scenario(&self, sample: usize) -> Scenario {
        let ScenarioGrid { mw, re_km, .. } = self.grid;
        let (mw, re_km) = (mw[self.cell / re_km.len()], re_km[self.cell % re_km.len()]);
        Scenario {
            scenario_id: self.scenario_id(sample) as i64,
            cell: self.cell as i32,
            sample: sample as i32,
            ..Scenario::at_quantiles(mw, re_km, self.quantiles(sample))
        }
    }

    /// Draws the quantiles of Vp, Tp, gamma and nu.
    pub fn quantiles(&self, sample: usize) -> [f64; DIMENSIONS] {
        let mut random = stream(self.grid.seed, Purpose::Sample, self.scenario_id(sample));
        // The quantile of 0 is infinite.
        let within = std::array::from_fn(|_| random.random::<f64>().max(f64::EPSILON));
        let Some(strata) = &self.strata else { return within };
        std::array::from_fn(|d| (f64::from(strata[d][sample]) + within[d]) / self.grid.samples as f64)
    }

    fn scenario_id(&self, sample: usize) -> u64 {
        (self.cell * self.grid.samples + sample) as u64
    }
}
