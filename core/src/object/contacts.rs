//! What an object strikes as it rocks back: its base, and a wall behind it.

use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::field::Field;
use crate::spelling::unknown_word;
use crate::statistics::Interval;
use crate::statistics::normal::Z_95;

/// What an object stands on, or its feet: the rows of data/bases.csv.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case", parse_err_ty = String, parse_err_fn = unknown_word::<Base>)]
pub enum Base {
    Concrete,
    Stone,
    Timber,
    Steel,
    Felt,
    Rubber,
}

impl Base {
    /// Its restitution over that by conservation of angular momentum, with the standard deviation of this
    /// ratio between tests.
    pub(super) fn over_housner(self) -> [f64; 2] {
        let word: &str = self.into();
        let mut rows = include_str!("../../data/bases.csv").lines().map(|line| line.splitn(4, ','));
        let row = rows.find(|row| row.clone().next() == Some(word)).expect("the file has it");
        let mut numbers = row.skip(1).map(|cell| cell.parse().expect("a number"));
        std::array::from_fn(|_| numbers.next().expect("two numbers"))
    }
}

/// A wall behind an object, which rocks away from it alone.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Wall {
    /// With a rebound that is not known.
    Yes,
    /// The velocity after an impact on base and wall over that before it.
    #[serde(untagged)]
    Rebound(f64),
}

/// Of a rebound that is not known: our choice, from a soft wall to a hard one.
const USUAL_REBOUND: f64 = 0.5;
const SD_OF_REBOUND: f64 = 0.2;

impl Wall {
    /// With its 2.5 and 97.5 % quantiles.
    pub(super) fn rebound(self) -> Interval {
        match self {
            Wall::Rebound(rebound) => Interval::exact(rebound),
            Wall::Yes => Interval::around(USUAL_REBOUND, Z_95 * SD_OF_REBOUND),
        }
    }
}

impl FromStr for Wall {
    type Err = String;

    fn from_str(text: &str) -> Result<Wall, String> {
        match text {
            "yes" | "true" => Ok(Wall::Yes),
            _ => Field::Wall.parse_value(text).map(Wall::Rebound),
        }
    }
}
