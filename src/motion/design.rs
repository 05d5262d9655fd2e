//! Which points of the unit cube sample the random parameters of a scenario (section 2.1.1).

use rand::seq::SliceRandom;
use rand::{Rng, RngExt};

use super::scenario::{PulseParameters, Scenario};
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
    pub design: Design,
    pub seed: u64,
}

impl Grid {
    /// Returns the number of cells: magnitudes times distances.
    pub fn cells(&self) -> usize {
        self.mw.len() * self.re_km.len()
    }

    /// Samples the scenarios of a cell, the same whichever other cells are sampled. The cells of one magnitude follow each
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

    /// Samples the points of a cell in the unit cube.
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

/// Moves a uniform number of [0, 1) away from 0, where quantiles are infinite.
fn open_unit(u: f64) -> f64 {
    u.max(f64::EPSILON)
}

/// Points of Sobol's sequence in four dimensions as 32 binary digits each, after Joe and Kuo (2008), in the order of
/// Gray codes; the first point is 0.
#[derive(Debug, Clone, Default)]
struct SobolSequence {
    index: u32,
    digits: [u32; 4],
}

/// A primitive polynomial, without its first and last coefficient, and the initial direction numbers.
struct Direction {
    polynomial: u32,
    initial: &'static [u32],
}

/// The dimensions after the first, which is van der Corput's sequence.
const DIRECTIONS: [Direction; 3] = [
    Direction { polynomial: 0, initial: &[1] },
    Direction { polynomial: 1, initial: &[1, 3] },
    Direction { polynomial: 1, initial: &[1, 3, 1] },
];

impl Iterator for SobolSequence {
    type Item = [u32; 4];

    fn next(&mut self) -> Option<[u32; 4]> {
        let point = self.digits;
        let bit = self.index.trailing_ones();
        for (dimension, digits) in self.digits.iter_mut().enumerate() {
            *digits ^= direction_number(dimension, bit as usize);
        }
        self.index = self.index.checked_add(1)?;
        Some(point)
    }
}

fn direction_number(dimension: usize, bit: usize) -> u32 {
    if dimension == 0 {
        return 1 << (31 - bit);
    }
    let Direction { polynomial, initial } = &DIRECTIONS[dimension - 1];
    let degree = initial.len();
    let mut numbers: Vec<u32> = initial.iter().enumerate().map(|(k, m)| m << (31 - k)).collect();
    for k in degree..=bit {
        let mut number = numbers[k - degree] ^ (numbers[k - degree] >> degree);
        for j in 1..degree {
            if polynomial >> (degree - 1 - j) & 1 == 1 {
                number ^= numbers[k - j];
            }
        }
        numbers.push(number);
    }
    numbers[bit]
}
