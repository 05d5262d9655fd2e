/// What is wrong with the file of a record: where, what was expected, and what to do. Lines count from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RecordFileError {
    #[error("the file is empty; expected a record: get it again")]
    Empty,
    #[error("binary data; expected the text of a record or a Parquet file: unpack it if it is an archive")]
    Binary,
    #[error(
        "line {line}: '{text}' begins no known format; name the format with --format, or leave the file out"
    )]
    Unrecognised { line: usize, text: String },
    #[error("line {line}: {quantity}, not acceleration; import the acceleration of the same record instead")]
    NotAcceleration { line: usize, quantity: &'static str },
    #[error("the file ends after line {line}; expected {expected}: get the file again")]
    EndsEarly { line: usize, expected: &'static str },
    #[error("line {line}: no {what}; expected {expected}")]
    Missing { line: usize, what: &'static str, expected: &'static str },
    #[error("line {line}: '{text}' is no number; expected one: correct the line or leave the file out")]
    NoNumber { line: usize, text: String },
    #[error(
        "the header announces {announced} samples but {found} follow; get the file again, or correct the header"
    )]
    Count { announced: u64, found: usize },
    #[error("line {line}: time step {dt_s} s; expected one above 0 s and up to 10 s: correct it")]
    TimeStep { line: usize, dt_s: f64 },
    #[error(
        "line {line}: unit '{unit}'; expected a unit of acceleration such as g or cm/s2: give it with --unit if it is one"
    )]
    Unit { line: usize, unit: String },
    #[error(
        "the header says PGA {header_m_s2:.5} m/s2, the samples peak at {found_m_s2:.5} m/s2; check unit and length, or \
         allow more with --pga-tolerance"
    )]
    Peak { header_m_s2: f64, found_m_s2: f64 },
    #[error(
        "line {line}: a time step of {step_s:.6} s among steps of {dt_s:.6} s; expected even ones: resample the record first, or give --dt"
    )]
    UnevenTime { line: usize, step_s: f64, dt_s: f64 },
    #[error(
        "line {line}: samples at uneven times, as digitised from film; import the corrected record instead"
    )]
    Uneven { line: usize },
    #[error(
        "line {line}: {found} columns after lines of {columns}; correct the line, or say --column all if the lines only wrap"
    )]
    Ragged { line: usize, found: usize, columns: usize },
    #[error(
        "line {line}: {columns} columns; say with --column which one is acceleration, by its number or name"
    )]
    WhichColumn { line: usize, columns: usize },
    #[error("line {line}: no column '{column}' among {columns}; choose another with --column")]
    NoColumn { line: usize, column: String, columns: usize },
    #[error("{found} sample(s); expected 2 or more: get the file again")]
    TooShort { found: usize },
}
