//! The shared data and what other programs make of it.

use std::collections::HashMap;

use rockfrag::fragility::{Case, Measure, Sample};
use rockfrag::motion::IntensityMeasures;
use rockfrag::rocking::Outcome;

/// Two measures, a demand and an event in each of 400 cases; 20 make a cell.
pub struct Data {
    pub x: Vec<f64>,
    pub y: Vec<f64>,
    pub demand: Vec<f64>,
    pub event: Vec<bool>,
    pub cells: Vec<usize>,
}

fn folder(name: &str) -> String {
    format!("{}/tests/reference/fits/{name}", env!("CARGO_MANIFEST_DIR"))
}

pub fn read<T: serde::de::DeserializeOwned>(name: &str) -> Vec<T> {
    csv::Reader::from_path(folder(name)).unwrap().into_deserialize().map(Result::unwrap).collect()
}

pub fn data() -> Data {
    let rows: Vec<(f64, f64, f64, u8)> = read("cases.csv");
    Data {
        x: rows.iter().map(|row| row.0).collect(),
        y: rows.iter().map(|row| row.1).collect(),
        demand: rows.iter().map(|row| row.2).collect(),
        event: rows.iter().map(|row| row.3 == 1).collect(),
        cells: (0..rows.len()).map(|row| row / 20).collect(),
    }
}

impl Data {
    /// The predictors by the name that the answers have.
    pub fn predictors(&self, name: &str) -> Vec<&[f64]> {
        if name == "x" { vec![&self.x] } else { vec![&self.x, &self.y] }
    }

    /// Keeps only the first cases.
    pub fn first(&mut self, cases: usize) {
        [&mut self.x, &mut self.y, &mut self.demand].into_iter().for_each(|column| column.truncate(cases));
        self.event.truncate(cases);
        self.cells.truncate(cases);
    }

    /// These cases, each as often as it is named.
    pub fn rows(&self, rows: impl Iterator<Item = usize> + Clone) -> Data {
        let of = |column: &[f64]| rows.clone().map(|row| column[row]).collect();
        Data {
            x: of(&self.x),
            y: of(&self.y),
            demand: of(&self.demand),
            event: rows.clone().map(|row| self.event[row]).collect(),
            cells: rows.clone().map(|row| self.cells[row]).collect(),
        }
    }

    /// The measures whose logarithms these are.
    pub fn measures(name: &str) -> Vec<Measure> {
        if name == "x" { vec![Measure::Im4] } else { vec![Measure::Im4, Measure::Im3] }
    }

    /// As cases of the fits: every second meaning of `outcome` serves one of them.
    pub fn cases(&self, outcome: impl Fn(usize) -> Outcome) -> Vec<Case> {
        let measures = |k: usize| IntensityMeasures {
            im1: None,
            im2: None,
            im3: Some(self.y[k].exp()),
            im4: self.x[k].exp(),
            im5: 1.0,
            im6: None,
        };
        let case = |k: usize| Case { outcome: outcome(k), edp: self.demand[k].exp(), measures: measures(k) };
        (0..self.x.len()).map(case).collect()
    }

    pub fn event_sample(&self, name: &str) -> Sample {
        let outcome = |k: usize| if self.event[k] { Outcome::Overturning } else { Outcome::SafeRocking };
        let event = |case: &Case| Some(case.outcome == Outcome::Overturning);
        Sample::of_events(&self.cases(outcome), &Data::measures(name), event)
    }

    pub fn demand_sample(&self, name: &str) -> Sample {
        let cases = self.cases(|_| Outcome::SafeRocking);
        Sample::of_demands(&cases, &Data::measures(name), 0.0..f64::INFINITY)
    }
}

/// The answers by name.
pub struct Answers(HashMap<String, f64>);

pub fn answers() -> Answers {
    Answers(read("uncertainty_answers.csv").into_iter().collect())
}

/// Those for the ranking of measures (scripts/reference/ranking.py).
pub fn ranking_answers() -> Answers {
    Answers(read("ranking_answers.csv").into_iter().collect())
}

impl Answers {
    pub fn get(&self, name: &str) -> f64 {
        *self.0.get(name).unwrap_or_else(|| panic!("no answer '{name}'"))
    }

    /// That a value equals the answer to an absolute tolerance.
    #[track_caller]
    pub fn check_absolute(&self, name: &str, value: f64, tolerance: f64) {
        let expected = self.get(name);
        assert!((value - expected).abs() <= tolerance, "{name}: {value:e}, expected {expected:e}");
    }

    /// That a value equals the answer to a relative tolerance.
    #[track_caller]
    pub fn check(&self, name: &str, value: f64, tolerance: f64) {
        let expected = self.get(name);
        assert!(
            (value - expected).abs() <= tolerance * expected.abs(),
            "{name}: {value:e}, expected {expected:e}"
        );
    }
}

/// scipy's replicates of a statistic.
pub fn distribution(statistic: &str) -> Vec<f64> {
    let rows: Vec<(String, f64)> = read("bootstrap_distribution.csv");
    rows.into_iter().filter(|row| row.0 == statistic).map(|row| row.1).collect()
}

/// Safe-rocking cases of two planes that pass into one another.
pub fn smooth_cases() -> Vec<Case> {
    let case = |(ln_im4, ln_im3, ln_edp): (f64, f64, f64)| Case {
        outcome: Outcome::SafeRocking,
        edp: ln_edp.exp(),
        measures: IntensityMeasures {
            im1: None,
            im2: None,
            im3: Some(ln_im3.exp()),
            im4: ln_im4.exp(),
            im5: 1.0,
            im6: None,
        },
    };
    read("smooth.csv").into_iter().map(case).collect()
}
