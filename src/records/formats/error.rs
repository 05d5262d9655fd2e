use super::unit::AccelerationUnit;

/// What is wrong with the file of a record: where, what was expected, and what to do. Lines count from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RecordFileError {
    #[error("the file is empty; expected a record: get it again")]
    Empty,
    #[error("{what}; expected the text of a record or a Parquet file: {cure}")]
    Binary { what: &'static str, cure: &'static str },
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
    #[error("line {line}: '{text}' is not a number; expected one: correct the line or leave the file out")]
    NoNumber { line: usize, text: String },
    #[error(
        "line {line}: '{text}' is a date or a time of day; expected seconds: leave the column out and give the time step with --dt"
    )]
    TimeOfDay { line: usize, text: String },
    #[error(
        "line {line}: '{text}' is not a number; expected one without thousands separators: write it plain"
    )]
    Thousands { line: usize, text: String },
    #[error(
        "line {line}: '{text}' has decimal commas among blanks; expected decimal points, or columns separated by semicolons or tabs"
    )]
    DecimalComma { line: usize, text: String },
    #[error(
        "line {line}: nothing in column {column}; expected a number: fill the gap, or leave the column out"
    )]
    EmptyField { line: usize, column: usize },
    #[error(
        "line {line}: {names} headings over {columns} columns of numbers; expected one for each: are there decimal commas, \
         or a column without a heading?"
    )]
    Headings { line: usize, names: usize, columns: usize },
    #[error(
        "line {line}: acceleration in '{unit}', which is not a unit of it; correct the heading, or convert the numbers"
    )]
    NoAccelerationUnit { line: usize, unit: String },
    #[error("line {line}: times in '{unit}'; expected them in s, ms, us or min: correct the heading")]
    TimeUnit { line: usize, unit: String },
    #[error("line {line}: the unit is {said}, --unit says {given}; leave --unit out, or correct the file")]
    OtherUnit { line: usize, said: AccelerationUnit, given: AccelerationUnit },
    #[error(
        "line {line}: the time step is {said_s:.6} s, --dt says {given_s} s; leave --dt out, or leave the column of times out"
    )]
    OtherTimeStep { line: usize, said_s: f64, given_s: f64 },
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
    #[error("line {line}: a gap of {gap_s} s among time steps of {dt_s} s; fill it, or cut the record there")]
    Gap { line: usize, gap_s: f64, dt_s: f64 },
    #[error(
        "line {line}: a time step of {step_s} s among steps of {dt_s} s; expected even ones: give --dt if the times are only \
         rounded, else interpolate the record to even times before it is imported"
    )]
    UnevenTime { line: usize, step_s: f64, dt_s: f64 },
    #[error(
        "line {line}: time {time_s} s, where steps of --dt {given_s} s lead to {expected_s} s; correct --dt, or interpolate the record to \
         even times before it is imported"
    )]
    OffStep { line: usize, time_s: f64, expected_s: f64, given_s: f64 },
    #[error(
        "line {line}: samples at uneven times, as digitised from film; import the corrected record instead"
    )]
    Uneven { line: usize },
    #[error(
        "line {line}: {found} columns after lines of {columns}; correct the line, or say --column all if the lines only wrap"
    )]
    Ragged { line: usize, found: usize, columns: usize },
    #[error(
        "line {line}: {columns}; say with --column which one is acceleration, by its number or name, or --column all if lines wrap"
    )]
    WhichColumn { line: usize, columns: String },
    #[error("line {line}: no column '{column}' among {columns}; choose another with --column")]
    NoColumn { line: usize, column: String, columns: String },
    #[error("{found} sample(s); expected 2 or more: get the file again")]
    TooShort { found: usize },
}

impl RecordFileError {
    /// The text that is no number on a line, with the reason where it is known.
    pub fn no_number(line: usize, text: String) -> RecordFileError {
        if text.contains(':') && text.starts_with(|c: char| c.is_ascii_digit()) {
            RecordFileError::TimeOfDay { line, text }
        } else if text.contains(',') {
            RecordFileError::Thousands { line, text }
        } else {
            RecordFileError::NoNumber { line, text }
        }
    }
}
