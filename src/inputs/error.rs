use std::path::Path;

use rockfrag_core::hazard::{HazardError, MatchError};

/// Of numbers that may be read in two ways.
pub(super) const THOUSANDS: &str = "1029 or 1.0290: a sign may be decimal, or between thousands";
pub(super) const PERCENT: &str = "the sheet saved as CSV, or 0.1 for 10 % under a heading without %: the \
                                  workbook may show a share as percent";

pub type Result<T, E = InputError> = std::result::Result<T, E>;

/// What is wrong with a file. Lines count from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum InputError {
    #[error("{1}")]
    Unreadable(std::io::ErrorKind, String),
    #[error("damaged, or not what its beginning says: {0}")]
    Damaged(String),
    #[error("{found}; expected a table: save it as CSV or .xlsx")]
    NoTable { found: &'static str },
    #[error("{} files: {}; expected one table: unpack them, and give those meant", .found.len(), .found.join(", "))]
    Members { found: Vec<String> },
    #[error("sheets {}; expected one of them: FILE#SHEET", .found.join(", "))]
    Sheets { found: Vec<String> },
    #[error("line {line}: a quotation mark opens here and never closes")]
    Quote { line: usize },
    #[error("line {line}: {found} cells; expected {expected}: between decimal commas, write semicolons")]
    Cells { line: usize, found: usize, expected: usize },
    #[error("line {line}, column '{heading}': '{found}'; expected {expected}")]
    Cell { line: usize, heading: String, found: String, expected: String },
    #[error("'{heading}' and '{unit}' contradict each other: a unit, years or a measure")]
    Units { heading: String, unit: String },
    #[error("{found}; expected {expected}")]
    Unexpected { found: String, expected: &'static str },
    #[error("line {line}: no {field}; expected {expected}")]
    Missing { line: usize, field: &'static str, expected: &'static str },
    #[error("no heading '{heading}' in any file; found {seen}")]
    Renamed { heading: String, seen: String },
    #[error(transparent)]
    Curve(#[from] HazardError),
    #[error(transparent)]
    Match(#[from] MatchError),
    #[error("{0}")]
    Implausible(String),
    #[error("'{found}'; expected AT2, COSMOS, ESM, K-NET, KiK-net or CSV: ObsPy converts other formats")]
    Unrecognised { found: String },
    #[error("line {line}: {found}; expected acceleration: import that of the same record")]
    NotAcceleration { line: usize, found: String },
    #[error("line {line}: {field} '{found}'; expected {expected}")]
    Value { line: usize, field: &'static str, found: String, expected: &'static str },
    #[error("line {line}: {field} {found}, but {given} was given; correct the one or leave out the other")]
    Contradiction { line: usize, field: &'static str, found: String, given: String },
    #[error("the header announces {announced} samples, {found} follow; get the file again")]
    Count { announced: u64, found: usize },
    #[error("PGA {header_m_s2:.5} m/s2 in the header, {found_m_s2:.5} m/s2 in the samples; check the unit")]
    Peak { header_m_s2: f64, found_m_s2: f64 },
    #[error("line {line}: {found} cells among lines of {expected}: several series, or damage?")]
    ShortLine { line: usize, found: usize, expected: usize },
    #[error(
        "line {line}: a step of {found_s:.6} s among {expected_s:.6} s: a gap, or exchanged headings? Rounded \
         times? Give --dt"
    )]
    UnevenTime { line: usize, found_s: f64, expected_s: f64 },
    #[error("{columns}; expected one of acceleration: choose with --column, or --column all if lines wrap")]
    Column { columns: String },
    #[error("{path}: {error}")]
    File { path: String, error: Box<InputError> },
}

impl InputError {
    pub(super) fn unexpected(found: impl Into<String>, expected: &'static str) -> InputError {
        InputError::Unexpected { found: found.into(), expected }
    }

    /// The error of a line in the header of a record.
    pub(super) fn value(line: usize, field: &'static str, text: &str, expected: &'static str) -> InputError {
        let found = text.trim().chars().filter(|c| !c.is_control()).take(60).collect();
        InputError::Value { line, field, found, expected }
    }

    pub(super) fn missing(line: usize, field: &'static str, expected: &'static str) -> InputError {
        InputError::Missing { line, field, expected }
    }

    pub(super) fn damaged(error: impl ToString) -> InputError {
        InputError::Damaged(error.to_string())
    }

    pub fn in_file(self, path: &Path) -> InputError {
        InputError::File { path: path.display().to_string(), error: Box::new(self) }
    }
}

/// Checks that a table is not too large, as one with a stray cell far away is.
pub(super) fn expect_few_cells(cells: usize) -> Result<()> {
    const MOST: usize = 20_000_000;
    let expected = "20 million at most: does one stand far from the table?";
    if cells > MOST { Err(InputError::unexpected(format!("{cells} cells"), expected)) } else { Ok(()) }
}
