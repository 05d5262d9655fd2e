//! Fragility as the risk programs of others take it: limit states over one intensity, in their files and units.
//!
//! ```text
//! levels     at which intensities to tabulate, so that lines between them err no more than a tolerance
//! openquake  NRML 0.5 of OpenQuake
//! pelicun    the fragility parameters of pelicun, and what it wants to know of them
//! ```

mod levels;
mod openquake;
mod pelicun;

pub use levels::{levels, whole_curve_end};
pub use openquake::{continuous, discrete};
pub use pelicun::{metadata, parameters};

use crate::fragility::{Lognormal, Peak};

/// How close below a jump a table has its last level, relative to the intensity of the jump: near enough to it, and far
/// enough for pelicun, which keeps six digits where it converts units.
pub const GAP: f64 = 2e-5;

/// What all functions of a file have in common.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    /// What it is called.
    pub id: String,
    /// Where it comes from, for a reader.
    pub description: String,
    /// What each limit state is.
    pub limit_states: [String; 3],
}

/// The fragility of one structure along one peak.
#[derive(Debug, Clone, PartialEq)]
pub struct Function {
    /// What it is called: letters, digits and underscores, since the programs give other signs a meaning.
    pub id: String,
    /// The peak that is the intensity.
    pub peak: Peak,
    /// Intensities, m/s2 or m/s, rising from uplift: below the first all probabilities are 0.
    pub levels: Vec<f64>,
    /// The probability of each limit state at these.
    pub probabilities: Vec<[f64; 3]>,
    /// Overturning as a lognormal curve over the intensity, above uplift.
    pub overturning: Lognormal,
    /// Uplift, and the largest intensity for which there are data.
    pub range_of_data: [f64; 2],
}

/// The same name without signs that have a meaning in these programs.
pub fn plain_id(name: &str) -> String {
    let plain = |sign: char| if sign.is_ascii_alphanumeric() { sign } else { '_' };
    name.chars().map(plain).collect()
}
