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
    /// None in a row with the test of a whole plane.
    pub published: Option<f64>,
    /// Least and largest number that round to the printed one.
    pub print_low: Option<f64>,
    pub print_high: Option<f64>,
    /// Hotelling's T2 of a plane against ours over seeds, and its p-value (scripts/seed_spread.py).
    pub t2: Option<f64>,
    pub t2_p: Option<f64>,
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
