//! Samples the random parameters of scenarios (section 2.1.1).

use rand::RngExt;
use rand::seq::SliceRandom;

use super::scenario::Scenario;
use crate::keyword::keywords;
use crate::random::{Purpose, stream};

keywords! {
    /// Sampling of the four random parameters in a cell.
    pub enum Design {
        /// Latin hypercube: each parameter has one sample in each of as many strata as samples.
        Lhs = "lhs",
        /// Independent samples.
        Random = "random",
    }
}

/// Number of random parameters: Vp, Tp, gamma and nu.
const DIMENSIONS: usize = 4;

/// The magnitude-distance grid and how its cells are sampled (section 2.1.1).
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// Moment magnitudes.
    pub mw: Vec<f64>,
    /// Distances, km.
    pub re_km: Vec<f64>,
    /// Scenarios in each cell.
    pub samples: usize,
    /// How a cell is sampled.
    pub design: Design,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl Grid {
    /// Returns the number of cells: magnitudes times distances.
    pub fn cells(&self) -> usize {
        self.mw.len() * self.re_km.len()
    }

    /// Samples the scenarios of a cell, independently of other cells. The cells of a magnitude are adjacent.
    pub fn scenarios_of_cell(&self, cell: usize) -> Vec<Scenario> {
        let mw = self.mw[cell / self.re_km.len()];
        let re_km = self.re_km[cell % self.re_km.len()];
        let scenario = |(sample, u)| {
            let scenario_id = self.scenario_id(cell, sample) as i64;
            Scenario::at_quantiles(scenario_id, cell as i32, sample as i32, mw, re_km, u)
        };
        self.quantiles_of_cell(cell).into_iter().enumerate().map(scenario).collect()
    }

    /// Samples a cell in the unit cube. Returns `samples` points.
    pub fn quantiles_of_cell(&self, cell: usize) -> Vec<[f64; DIMENSIONS]> {
        let uniform = (0..self.samples).map(|sample| {
            let mut random = stream(self.seed, Purpose::Sample, self.scenario_id(cell, sample));
            // The quantile of 0 is infinite.
            std::array::from_fn(|_| random.random::<f64>().max(f64::EPSILON))
        });
        if self.design == Design::Random {
            return uniform.collect();
        }
        let strata: [Vec<u32>; DIMENSIONS] = std::array::from_fn(|dimension| {
            let mut strata: Vec<u32> = (0..self.samples as u32).collect();
            let row = (cell * DIMENSIONS + dimension) as u64;
            strata.shuffle(&mut stream(self.seed, Purpose::Strata, row));
            strata
        });
        let point = |(sample, within): (usize, [f64; DIMENSIONS])| {
            std::array::from_fn(|d| (f64::from(strata[d][sample]) + within[d]) / self.samples as f64)
        };
        uniform.enumerate().map(point).collect()
    }

    fn scenario_id(&self, cell: usize, sample: usize) -> u64 {
        (cell * self.samples + sample) as u64
    }
}
