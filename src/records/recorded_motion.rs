//! A record as its file gives it, and what the user says of files that leave something open.

use super::formats::Format;
use crate::units::Unit;

/// One component of a record, as its file gives it.
#[derive(Debug, Clone, PartialEq)]
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
    pub unit: Unit,
    pub unit_source: UnitSource,
}

/// Where the unit of the samples is stated.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum UnitSource {
    File,
    User,
}

impl RecordedMotion {
    /// Creates a record of samples in a unit of acceleration, `dt_s` apart, of which nothing else is known.
    pub fn new(dt_s: f64, samples: Vec<f64>, (unit, unit_source): (Unit, UnitSource)) -> RecordedMotion {
        RecordedMotion {
            dt_s,
            acceleration_m_s2: samples.into_iter().map(|value| value * unit.si).collect(),
            event: None,
            station: None,
            component: None,
            azimuth_deg: None,
            header_pga: None,
            format: "",
            unit,
            unit_source,
        }
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

/// How files are read, and what the user says of those that leave it open.
#[derive(Debug, Clone, PartialEq)]
pub struct ReadOptions {
    /// None: the format that the content shows.
    pub format: Option<Format>,
    /// Time between samples, s.
    pub dt_s: Option<f64>,
    /// Unit of the samples.
    pub unit: Option<Unit>,
    /// Which column of a CSV file holds the acceleration: its number from 1, its heading, or `all` where one
    /// series wraps over lines.
    pub column: Option<String>,
    /// Share by which samples may miss the peak that the header gives.
    pub pga_tolerance: f64,
}

impl Default for ReadOptions {
    fn default() -> ReadOptions {
        ReadOptions { format: None, dt_s: None, unit: None, column: None, pga_tolerance: 0.05 }
    }
}
