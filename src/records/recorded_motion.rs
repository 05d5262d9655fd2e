//! A record as its file gives it, and what the user says about files that leave it open.

use std::convert::Infallible;
use std::fmt;
use std::str::FromStr;

use super::formats::{AccelerationUnit, RecordFileError};
use crate::motion::intensity::peak;

/// One component of a record, as its file gives it.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RecordedMotion {
    /// Time between samples, s.
    pub dt_s: f64,
    /// Samples, m/s2.
    pub acceleration_m_s2: Vec<f64>,
    /// The earthquake in the words of the file.
    pub event: Option<String>,
    /// The station in the words of the file.
    pub station: Option<String>,
    /// The component in the words of the file.
    pub component: Option<String>,
    /// Direction of positive acceleration, degrees clockwise from north; none of a vertical component.
    pub azimuth_deg: Option<f64>,
    /// Peak acceleration that the header gives.
    pub header_pga: Option<HeaderPga>,
    /// The format of the file, in a word.
    pub format: &'static str,
    /// The unit that the samples had.
    pub unit: Option<SaidUnit>,
}

/// A unit, and who says it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct SaidUnit {
    pub unit: AccelerationUnit,
    pub by: Teller,
}

/// Who says of samples what they are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Teller {
    /// The file or its format.
    File,
    User,
}

impl SaidUnit {
    /// The unit that the file says.
    pub fn by_file(unit: AccelerationUnit) -> SaidUnit {
        SaidUnit { unit, by: Teller::File }
    }

    /// The unit that the user says.
    pub fn by_user(unit: AccelerationUnit) -> SaidUnit {
        SaidUnit { unit, by: Teller::User }
    }
}

/// A peak acceleration as a header gives it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeaderPga {
    /// The value, m/s2, without its sign.
    pub m_s2: f64,
    /// Half of the unit of its last digit, m/s2.
    pub rounding_m_s2: f64,
}

impl HeaderPga {
    /// Checks that the samples peak where the header says, within a share of it and the rounding.
    ///
    /// # Errors
    /// If they do not: then the unit or the number of samples is not what the header says.
    pub fn check(&self, acceleration_m_s2: &[f64], tolerance: f64) -> Result<(), RecordFileError> {
        let found = peak(acceleration_m_s2);
        if (found - self.m_s2).abs() <= tolerance * self.m_s2 + self.rounding_m_s2 {
            return Ok(());
        }
        Err(RecordFileError::Peak { header_m_s2: self.m_s2, found_m_s2: found })
    }
}

/// What the user says about files that do not say it themselves.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Given {
    /// Time between samples, s.
    pub dt_s: Option<f64>,
    /// Unit of the samples.
    pub unit: Option<AccelerationUnit>,
    /// Which column of a plain file holds the acceleration.
    pub column: Option<ColumnChoice>,
}

/// Which column holds the acceleration.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ColumnChoice {
    /// By its number, from 1.
    Number(usize),
    /// By its name in the header.
    Name(String),
    /// All of them: one series that wraps.
    All,
}

impl FromStr for ColumnChoice {
    type Err = Infallible;

    fn from_str(text: &str) -> Result<ColumnChoice, Infallible> {
        Ok(match (text, text.parse()) {
            ("all", _) => ColumnChoice::All,
            (_, Ok(number)) => ColumnChoice::Number(number),
            _ => ColumnChoice::Name(text.to_string()),
        })
    }
}

impl fmt::Display for ColumnChoice {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            ColumnChoice::Number(number) => write!(f, "{number}"),
            ColumnChoice::Name(name) => f.write_str(name),
            ColumnChoice::All => f.write_str("all"),
        }
    }
}
