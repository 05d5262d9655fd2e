//! Recorded motions from the text files of the strong-motion networks: pure functions from text to accelerations.
//!
//! ```text
//! format    which format a file has, by its content
//! peer_at2  PEER's AT2, old and NGA
//! cosmos    COSMOS V1 and V2
//! csmip     CSMIP (CDMG) V1 and V2, which came before
//! esm       Engineering Strong Motion database
//! knet      K-NET and KiK-net
//! smc       USGS SMC
//! columns   plain numbers, with or without a column of time
//! text      bytes to text to numbered lines; what all headers share
//! numbers   numbers as Fortran and people write them
//! samples   a block of numbers of an announced length
//! unit      units of acceleration
//! error     what can be wrong with a file
//! ```

mod columns;
mod cosmos;
mod csmip;
mod error;
mod esm;
mod format;
mod knet;
mod numbers;
mod peer_at2;
mod samples;
mod smc;
mod text;
mod unit;

pub use columns::ColumnChoice;
pub use error::RecordFileError;
pub use format::{Format, read};
pub use unit::AccelerationUnit;

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
    /// That the samples peak where the header says, within a share of it and the rounding.
    ///
    /// # Errors
    /// If they do not: then the unit or the number of samples is not what the header says.
    pub fn check(&self, acceleration_m_s2: &[f64], tolerance: f64) -> Result<(), RecordFileError> {
        let found = super::intensity::peak(acceleration_m_s2);
        if (found - self.m_s2).abs() <= tolerance * self.m_s2 + self.rounding_m_s2 {
            return Ok(());
        }
        Err(RecordFileError::Peak { header_m_s2: self.m_s2, found_m_s2: found })
    }
}

/// What the user says of files that do not say it themselves.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Given {
    /// Time between samples, s.
    pub dt_s: Option<f64>,
    /// Unit of the samples.
    pub unit: Option<AccelerationUnit>,
    /// Which column of a plain file holds the acceleration.
    pub column: Option<ColumnChoice>,
}
