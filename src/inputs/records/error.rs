use crate::inputs::InputError;

/// An error in the file of a record: place (lines count from 1), value found, value expected.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the message says it")]
pub enum RecordFileError {
    #[error(transparent)]
    Input(#[from] InputError),
    #[error("'{found}'; expected AT2, COSMOS, ESM, K-NET, KiK-net or CSV: ObsPy converts other formats")]
    Unrecognised { found: String },
    #[error("line {line}: {found}; expected acceleration: import that of the same record")]
    NotAcceleration { line: usize, found: String },
    #[error("line {line}: no {field}; expected {expected}")]
    Missing { line: usize, field: &'static str, expected: &'static str },
    #[error("line {line}: {field} '{found}'; expected {expected}")]
    Value { line: usize, field: &'static str, found: String, expected: &'static str },
    #[error("line {line}: {field} {found}, but {given} was given; correct the one or leave out the other")]
    Contradiction { line: usize, field: &'static str, found: String, given: String },
    #[error("the header announces {announced} samples, {found} follow; get the file again")]
    Count { announced: u64, found: usize },
    #[error("PGA {header_m_s2:.5} m/s2 in the header, {found_m_s2:.5} m/s2 in the samples; check the unit")]
    Peak { header_m_s2: f64, found_m_s2: f64 },
    #[error(
        "line {line}: {found} cells among lines of {expected}; expected a short line at the end alone: several \
         series, or damage?"
    )]
    ShortLine { line: usize, found: usize, expected: usize },
    #[error(
        "line {line}: a step of {found_s:.6} s among {expected_s:.6} s; expected even times: a gap, or exchanged \
         headings? Rounded times? Give --dt"
    )]
    UnevenTime { line: usize, found_s: f64, expected_s: f64 },
    #[error("{columns}; expected one of acceleration: choose with --column, or --column all if lines wrap")]
    Column { columns: String },
}

impl RecordFileError {
    pub(super) fn missing(line: usize, field: &'static str, expected: &'static str) -> RecordFileError {
        RecordFileError::Missing { line, field, expected }
    }

    pub(super) fn value(
        line: usize,
        field: &'static str,
        found: &str,
        expected: &'static str,
    ) -> RecordFileError {
        let found = found.trim().chars().filter(|c| !c.is_control()).take(60).collect();
        RecordFileError::Value { line, field, found, expected }
    }
}
