//! Published values of Dimitrakopoulos & Paraskeva (2015): set-up, structures, Table II (the eight planes)
//! and other numbers. The constants of Eqs. 2 and 3 (median Vp and Tp) are in [`crate::motion::scenario`].

use serde::{Deserialize, Serialize};

use crate::motion::{IntensityMeasures, Peaks};
use crate::rocking::Structure;
use crate::units::G_M_S2;

/// PGA/(g tan alpha) at which the two planes meet (section 2.3.2).
pub const TRANSITION: f64 = 1.30;
/// Demand |theta|max / alpha of LS2, limited rocking (Table I).
pub const LIMIT_STATE: f64 = 0.10;
/// Coefficient of restitution of both structures.
pub const ETA: f64 = 0.92;
/// Name, p (rad/s) and alpha (rad) of the two structures.
pub const STRUCTURES: [(&str, f64, f64); 2] = [("frame", 1.0, 0.15), ("electrical-equipment", 2.5, 0.20)];
/// alpha (rad) that the text prints for the frame, and Table II for the equipment.
pub const OTHER_ALPHA: [f64; 2] = [0.149, 0.19];
/// Readings of section 2.1 among which the set-up was chosen by Table II (docs/review/choices.md).
pub const READINGS: usize = 255;

pub fn structures() -> Vec<Structure> {
    STRUCTURES.map(|(name, p, alpha)| Structure::new(name, p, alpha, ETA).expect("possible values")).into()
}

/// Exponent lambda implied by the hybrid measures of the worked example (section 3).
pub const EXAMPLE_LAMBDA: f64 = 1.5;

/// The worked example (section 3): PGA 0.5 g, PGA/PGV 2 1/s.
pub fn example(structure: &Structure) -> IntensityMeasures {
    let pga_m_s2 = 0.5 * G_M_S2;
    IntensityMeasures::new(structure, Peaks { pga_m_s2, pgv_m_s: pga_m_s2 / 2.0 }, None, None)
}

/// A published number: a row of data/paper.csv.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Published {
    pub quantity: String,
    /// Place in the paper.
    pub place: String,
    pub suite: String,
    pub structure: String,
    /// Of a number of a plane, its side of the transition: below or above.
    pub plane: Option<String>,
    pub published: f64,
    /// Least and largest number that round to the printed one.
    pub print_low: f64,
    pub print_high: f64,
}

impl Published {
    /// Whether both are the same number, or numbers of one plane.
    pub fn is_tested_with(&self, other: &Published) -> bool {
        let group = |one: &Published| (one.suite.clone(), one.structure.clone(), one.plane.clone());
        group(self) == group(other) && (self.plane.is_some() || self.quantity == other.quantity)
    }

    /// The variance of the rounding in print, width^2 / 12.
    pub fn rounding(&self) -> f64 {
        (self.print_high - self.print_low).powi(2) / 12.0
    }
}

/// Our value of a published quantity for one seed: a row of data/seed_spread.csv.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SeedValue {
    pub quantity: String,
    pub suite: String,
    pub structure: String,
    pub seed: u64,
    pub value: f64,
}

/// Where the limits of a mean lie of what a claim asks for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Support {
    For,
    /// They hold its bound.
    Undecided,
    Against,
}

/// A number over seeds, and whether it supports a claim: a row of data/claims.csv (scripts/claims.py).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Claim {
    pub claim: String,
    pub quantity: String,
    pub suite: String,
    pub structure: String,
    /// What the claim asks for.
    pub claimed: String,
    pub mean: f64,
    /// Limits of one more seed.
    pub low: f64,
    pub high: f64,
    pub support: Option<Support>,
    /// Of the claim as a whole.
    pub verdict: String,
    pub figure: String,
}

pub fn claims() -> Vec<Claim> {
    read(include_str!("../data/claims.csv"))
}

/// In the order of display.
pub fn published() -> Vec<Published> {
    read(include_str!("../data/paper.csv"))
}

/// For twenty seeds.
pub fn seed_values() -> Vec<SeedValue> {
    read(include_str!("../data/seed_spread.csv"))
}

/// Reads an embedded table. An invalid row is a fault of the build, which tests find.
fn read<T: for<'de> Deserialize<'de>>(text: &str) -> Vec<T> {
    let rows = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
    rows.into_deserialize().map(|row| row.expect("a table in data/")).collect()
}
