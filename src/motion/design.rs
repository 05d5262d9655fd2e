use rand::seq::SliceRandom;
use rand::{Rng, RngExt};

use super::scenario::{PulseParameters, Scenario};
use super::sobol::SobolSequence;
use crate::keyword::keywords;
use crate::random::{Purpose, stream};

/// How the four random parameters of a cell are sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Design {
    /// Latin hypercube: one sample in each of as many strata as samples, in every parameter.
    Lhs,
    /// Independent samples.
    Random,
    /// A Sobol sequence under a random digital shift.
    Sobol,
}

keywords!(Design { Lhs = "lhs", Random = "random", Sobol = "sobol" });

/// Random parameters of a pulse: Vp, Tp, gamma and nu.
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
    /// How they are sampled.
    pub design: Design,
    /// Seed of all random numbers.
    pub seed: u64,
}

impl Grid {
    /// How many cells there are: magnitudes times distances.
    pub fn cells(&self) -> usize {
        self.mw.len() * self.re_km.len()
    }

    /// The scenarios of a cell, the same whichever other cells are sampled. The cells of one magnitude follow each
    /// other.
    pub fn scenarios_of_cell(&self, cell: usize) -> Vec<Scenario> {
        let mw = self.mw[cell / self.re_km.len()];
        let re_km = self.re_km[cell % self.re_km.len()];
        let scenario = |(sample, u)| {
            let PulseParameters { vp_m_s, tp_s, gamma, nu_rad } = PulseParameters::at_quantiles(mw, re_km, u);
            Scenario {
                scenario_id: self.scenario_id(cell, sample) as i64,
                cell: cell as i32,
                sample: sample as i32,
                mw,
                re_km,
                vp_m_s,
                tp_s,
                gamma,
                nu_rad,
            }
        };
        self.quantiles_of_cell(cell).into_iter().enumerate().map(scenario).collect()
    }

    /// The points of a cell in the unit cube.
    pub fn quantiles_of_cell(&self, cell: usize) -> Vec<[f64; DIMENSIONS]> {
        match self.design {
            Design::Lhs => self.latin_hypercube(cell),
            Design::Random => (0..self.samples).map(|sample| self.uniform(cell, sample)).collect(),
            Design::Sobol => self.shifted_sobol(cell),
        }
    }

    fn latin_hypercube(&self, cell: usize) -> Vec<[f64; DIMENSIONS]> {
        let strata: [Vec<u32>; DIMENSIONS] = std::array::from_fn(|dimension| {
            let mut strata: Vec<u32> = (0..self.samples as u32).collect();
            let row = (cell * DIMENSIONS + dimension) as u64;
            strata.shuffle(&mut stream(self.seed, Purpose::Strata, row));
            strata
        });
        let point = |sample| {
            let within = self.uniform(cell, sample);
            std::array::from_fn(|d| (f64::from(strata[d][sample]) + within[d]) / self.samples as f64)
        };
        (0..self.samples).map(point).collect()
    }

    fn uniform(&self, cell: usize, sample: usize) -> [f64; DIMENSIONS] {
        let mut random = stream(self.seed, Purpose::Sample, self.scenario_id(cell, sample));
        std::array::from_fn(|_| open_unit(random.random::<f64>()))
    }

    fn shifted_sobol(&self, cell: usize) -> Vec<[f64; DIMENSIONS]> {
        let mut random = stream(self.seed, Purpose::SobolShift, cell as u64);
        let shift: [u32; DIMENSIONS] = std::array::from_fn(|_| random.next_u32());
        let point = |digits: [u32; DIMENSIONS]| {
            std::array::from_fn(|d| (f64::from(digits[d] ^ shift[d]) + 0.5) / 2f64.powi(32))
        };
        SobolSequence::default().take(self.samples).map(point).collect()
    }

    fn scenario_id(&self, cell: usize, sample: usize) -> u64 {
        (cell * self.samples + sample) as u64
    }
}

/// A uniform number of [0, 1) away from 0, where quantiles are infinite.
fn open_unit(u: f64) -> f64 {
    u.max(f64::EPSILON)
}
