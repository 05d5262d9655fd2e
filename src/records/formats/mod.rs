//! The formats of text files in which networks publish records: from text to accelerations.
//!
//! ```text
//! peer_at2  PEER's AT2, old and NGA
//! cosmos    COSMOS V1 and V2
//! csmip     CSMIP (CDMG) V1 and V2, which came before
//! esm       Engineering Strong Motion database
//! knet      K-NET and KiK-net
//! smc       USGS SMC
//! columns   plain numbers, with or without a column of time
//! heading   what headings and comments above plain numbers say of them
//! table     plain numbers as rows and columns
//! times     the step of a column of times
//! text      bytes to text to numbered lines
//! numbers   numbers as Fortran and people write them, and blocks of them
//! header    time steps, peaks and azimuths
//! unit      units of acceleration
//! error     what can be wrong with a file
//! ```

mod columns;
mod cosmos;
mod csmip;
mod error;
mod esm;
mod header;
mod heading;
mod knet;
mod numbers;
mod peer_at2;
mod smc;
mod table;
mod text;
mod times;
mod unit;

pub use error::RecordFileError;
pub use unit::AccelerationUnit;

use self::text::{decode, lines, quoted};
use super::{Given, RecordedMotion};
use crate::keyword::{Keyword, keywords};

/// A format of text files, those with the surest signs first: plain numbers stand in files of all of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// COSMOS V1 and V2.
    Cosmos,
    /// USGS SMC.
    Smc,
    /// CSMIP V1 and V2.
    Csmip,
    /// K-NET and KiK-net.
    Knet,
    /// Engineering Strong Motion database.
    Esm,
    /// PEER AT2.
    PeerAt2,
    /// Plain numbers.
    Columns,
}

keywords!(Format {
    Cosmos = "cosmos",
    Smc = "smc",
    Csmip = "csmip",
    Knet = "knet",
    Esm = "esm",
    PeerAt2 = "at2",
    Columns = "columns",
});

impl Format {
    fn of(text: &str) -> Result<Format, RecordFileError> {
        let found = Format::ALL.iter().find(|format| format.recognises(text));
        let first = || lines(text).find(|line| !line.text.trim().is_empty());
        let unknown = || match first() {
            Some(line) => RecordFileError::Unrecognised { line: line.number, text: quoted(line.text) },
            None => RecordFileError::Empty,
        };
        found.copied().ok_or_else(unknown)
    }

    fn recognises(self, text: &str) -> bool {
        match self {
            Format::Cosmos => cosmos::recognises(text),
            Format::Smc => smc::recognises(text),
            Format::Csmip => csmip::recognises(text),
            Format::Knet => knet::recognises(text),
            Format::Esm => esm::recognises(text),
            Format::PeerAt2 => peer_at2::recognises(text),
            Format::Columns => columns::recognises(text),
        }
    }

    fn parse(self, text: &str, given: &Given) -> Result<Vec<RecordedMotion>, RecordFileError> {
        let one = |motion: Result<RecordedMotion, RecordFileError>| motion.map(|motion| vec![motion]);
        match self {
            Format::Cosmos => cosmos::parse(text, given),
            Format::Csmip => csmip::parse(text, given),
            Format::Smc => one(smc::parse(text, given)),
            Format::Knet => one(knet::parse(text, given)),
            Format::Esm => one(esm::parse(text, given)),
            Format::PeerAt2 => one(peer_at2::parse(text, given)),
            Format::Columns => one(columns::parse(text, given)),
        }
    }
}

/// Reads the motions in the bytes of a file, in the format that its content shows unless one is given.
///
/// # Errors
/// If it is of no known format, holds no acceleration, or is damaged: line, what was expected, and what to do.
pub fn read(
    bytes: &[u8],
    format: Option<Format>,
    given: &Given,
) -> Result<Vec<RecordedMotion>, RecordFileError> {
    let text = decode(bytes)?;
    let format = format.map_or_else(|| Format::of(&text), Ok)?;
    let mut motions = format.parse(&text, given)?;
    motions.iter_mut().for_each(|motion| motion.format = format.as_str());
    Ok(motions)
}
