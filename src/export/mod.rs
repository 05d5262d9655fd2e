//! Fragility in the files and units of other risk programs: limit states over one intensity.
//!
//! ```text
//! openquake  NRML 0.5 of OpenQuake
//! pelicun    the fragility parameters of pelicun, and their metadata
//! ```

mod openquake;
mod pelicun;

pub use openquake::discrete;
pub use pelicun::{metadata, parameters};
use rockfrag_core::fragility::{LimitStates, Peak};

/// Distance below a jump of the last level before it, relative to the intensity of the jump: far enough for
/// pelicun, which keeps six digits where it converts units.
pub const GAP: f64 = 2e-5;

/// Functions of one file.
#[derive(Debug, Clone, PartialEq)]
pub struct FragilityModel {
    pub id: String,
    /// What each limit state is, in their order.
    pub limit_states: Vec<String>,
    pub functions: Vec<Function>,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Function {
    /// Letters, digits and underscores: the programs give other signs a meaning. No other function has it.
    pub id: String,
    pub peak: Peak,
    /// What falls and what predicts it, for a reader.
    pub description: String,
    /// Intensities, m/s2 or m/s, rising from uplift, below which all probabilities are 0, to the largest for
    /// which there are data and that was ever recorded.
    pub levels: Vec<f64>,
    /// Probability of each limit state at the levels.
    pub probabilities: Vec<LimitStates<f64>>,
}

/// Makes an id for each name, without the signs that have a meaning in these programs: names that are told
/// apart by these alone get numbers.
pub fn distinct_ids<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut ids: Vec<String> = Vec::new();
    for name in names {
        let id = format!("rockfrag_{}", name.replace(|sign: char| !sign.is_ascii_alphanumeric(), "_"));
        let numbered = (2..).map(|number| format!("{id}_{number}"));
        let is_new = |id: &String| ids.iter().all(|other| !other.eq_ignore_ascii_case(id));
        ids.extend(std::iter::once(id.clone()).chain(numbered).find(is_new));
    }
    ids
}
