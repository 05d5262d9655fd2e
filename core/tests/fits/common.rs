//! The data that other programs fitted too, their answers, and cases made of numbers.

use std::collections::HashMap;

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rockfrag_core::fragility::{Calibration, Case, Cases, Cluster};
use rockfrag_core::hazard::PairOfPeaks;
use rockfrag_core::motion::{IntensityMeasures, Peaks};
use rockfrag_core::random::{Purpose, stream};
use rockfrag_core::rocking::{Outcome, Structure};

pub use crate::shared::{Row, close};

/// Two measures, a demand and an event in each of 400 cases; 20 make a cell.
pub struct Data {
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    pub demand: Vec<f64>,
    pub event: Vec<bool>,
    pub cells: Vec<u32>,
}

pub fn read<T: serde::de::DeserializeOwned>(name: &str) -> Vec<T> {
    crate::shared::rows(&format!("fits/{name}"))
}

pub fn data() -> Data {
    let rows: Vec<(f64, f64, f64, u8)> = read("cases.csv");
    Data {
        x: rows.iter().map(|row| row.0).collect(),
        y: rows.iter().map(|row| row.1).collect(),
        demand: rows.iter().map(|row| row.2).collect(),
        event: rows.iter().map(|row| row.3 == 1).collect(),
        cells: (0..rows.len() as u32).map(|row| row / 20).collect(),
    }
}

impl Data {
    /// The predictors by the name that the answers have.
    pub fn predictors(&self, name: &str) -> Vec<&[f64]> {
        if name == "x" { vec![&self.x] } else { vec![&self.x, &self.y] }
    }

    /// As cases: x is ln IM4, y is ln IM3.
    fn cases(&self, overturns: impl Fn(usize) -> bool) -> Cases {
        let safe = |k: usize| Outcome::SafeRocking(self.demand[k].exp());
        let outcome = |k: usize| if overturns(k) { Outcome::Overturned } else { safe(k) };
        cases((0..self.x.len()).map(|k| (outcome(k), self.x[k].exp(), self.y[k].exp(), self.cells[k])))
    }

    pub fn safe(&self) -> Cases {
        self.cases(|_| false)
    }

    pub fn overturning(&self) -> Cases {
        self.cases(|k| self.event[k])
    }
}

/// Compares with the upper triangle of a covariance, such as column `v_01`.
#[track_caller]
pub fn expect_covariance(found: &Calibration, answer: &Row, name: &str, tolerance: f64) {
    for (k, found) in found.covariance.iter().enumerate() {
        let (row, column) = (k / 3, k % 3);
        let expected: f64 = answer.get(&format!("{name}_{}{}", row.min(column), row.max(column)));
        assert!((found - expected).abs() < tolerance, "{row} {column}: {found}, expected {expected}");
    }
}

/// Answers of other programs by name.
pub fn answers(name: &str) -> HashMap<String, f64> {
    read(name).into_iter().collect()
}

pub fn equipment() -> Structure {
    Structure::new("equipment", 2.5, 0.20, 0.92).unwrap()
}

/// Cases of these outcomes, IM4, IM3 and cells.
pub fn cases(rows: impl IntoIterator<Item = (Outcome, f64, f64, u32)>) -> Cases {
    let mut cases = Cases::new(Some("csgm"), equipment());
    for (outcome, im4, im3, cell) in rows {
        let measures = IntensityMeasures { im3: Some(im3), ..IntensityMeasures::from_peaks(im4, im4 / im3) };
        let peaks = Peaks { pga_m_s2: 1.0, pgv_m_s: 1.0 };
        let cluster = Cluster::new(None, Some(7.0), Some(1.0 + f64::from(cell)));
        cases.push(Case { outcome, measures, peaks, mw: None, cluster: 0 }, cluster);
    }
    cases.sort_clusters();
    cases
}

pub fn pair(pga_m_s2: f64, pgv_m_s: f64, annual_rate: f64) -> PairOfPeaks {
    PairOfPeaks { peaks: Peaks { pga_m_s2, pgv_m_s }, annual_rate, mw: None }
}

pub fn random(seed: u64) -> ChaCha8Rng {
    stream(seed, Purpose::Sample, 0)
}

/// Cases on demand and overturning that rise with IM4 and fall with IM3, in 30 cells.
pub fn rocking(n: u32) -> Cases {
    let mut random = random(11);
    cases((0..n).map(|k| {
        let (im4, im3) = (random.random_range(1.0..4.0f64), random.random_range(0.5..3.0f64));
        let overturns = im4 / im3.sqrt() + random.random_range(-1.0..1.0) > 3.0;
        let demand = 0.05 * im4.powi(3) * random.random_range(0.5..2.0);
        (if overturns { Outcome::Overturned } else { Outcome::SafeRocking(demand) }, im4, im3, k % 30)
    }))
}
