/// What can be wrong with the file of a record. Lines count from 1.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RecordFileError {
    /// Nothing in it.
    #[error("the file is empty; expected a record: get it again")]
    Empty,
    /// No text.
    #[error("binary data; expected the text of a record or a Parquet file: unpack it if it is an archive")]
    Binary,
    /// No format fits.
    #[error(
        "line {line}: '{text}' begins no known format; name the format with --format, or leave the file out"
    )]
    Unrecognised {
        /// The first line that says anything.
        line: usize,
        /// What it says.
        text: String,
    },
    /// Velocity or displacement.
    #[error("line {line}: {quantity}, not acceleration; import the acceleration of the same record instead")]
    NotAcceleration {
        /// Where it says so.
        line: usize,
        /// What it holds.
        quantity: &'static str,
    },
    /// The end came too soon.
    #[error("the file ends after line {line}; expected {expected}: get the file again")]
    EndsEarly {
        /// The last line.
        line: usize,
        /// What should have followed.
        expected: &'static str,
    },
    /// A part of the header is missing.
    #[error("line {line}: no {what}; expected {expected}")]
    Missing {
        /// Where it should be.
        line: usize,
        /// Which part.
        what: &'static str,
        /// What it looks like, and what to do without.
        expected: &'static str,
    },
    /// Something else stands where a number should.
    #[error("line {line}: '{text}' is no number; expected one: correct the line or leave the file out")]
    NoNumber {
        /// Where.
        line: usize,
        /// What stands there.
        text: String,
    },
    /// More or fewer samples than announced.
    #[error(
        "the header announces {announced} samples but {found} follow; get the file again, or correct the header"
    )]
    Count {
        /// By the header.
        announced: u64,
        /// In the file.
        found: usize,
    },
    /// A time step that cannot be.
    #[error("line {line}: time step {dt_s} s; expected one above 0 s and up to 10 s: correct it")]
    TimeStep {
        /// Where it is given.
        line: usize,
        /// Its value.
        dt_s: f64,
    },
    /// A unit that is none of acceleration.
    #[error(
        "line {line}: unit '{unit}'; expected a unit of acceleration such as g or cm/s2: give it with --unit if it is one"
    )]
    Unit {
        /// Where it is given.
        line: usize,
        /// What stands there.
        unit: String,
    },
    /// The samples do not peak where the header says.
    #[error(
        "the header says PGA {header_m_s2:.5} m/s2, the samples peak at {found_m_s2:.5} m/s2; check unit and length, or \
         allow more with --pga-tolerance"
    )]
    Peak {
        /// By the header.
        header_m_s2: f64,
        /// Of the samples.
        found_m_s2: f64,
    },
    /// Samples at uneven times.
    #[error(
        "line {line}: a time step of {step_s:.6} s among steps of {dt_s:.6} s; expected even ones: resample the record first, or give --dt"
    )]
    UnevenTime {
        /// Where.
        line: usize,
        /// The step there.
        step_s: f64,
        /// The usual step.
        dt_s: f64,
    },
    /// Time and acceleration in turn.
    #[error(
        "line {line}: samples at uneven times, as digitised from film; import the corrected record instead"
    )]
    Uneven {
        /// Where the header says so.
        line: usize,
    },
    /// A line of a table with more or fewer columns.
    #[error(
        "line {line}: {found} columns after lines of {columns}; correct the line, or say --column all if the lines only wrap"
    )]
    Ragged {
        /// Where.
        line: usize,
        /// Here.
        found: usize,
        /// Above.
        columns: usize,
    },
    /// Several columns, and no word on which one counts.
    #[error(
        "line {line}: {columns} columns; say with --column which one is acceleration, by its number or name"
    )]
    WhichColumn {
        /// The first line of numbers.
        line: usize,
        /// How many there are.
        columns: usize,
    },
    /// A column that is not there.
    #[error("line {line}: no column '{column}' among {columns}; choose another with --column")]
    NoColumn {
        /// The first line of numbers.
        line: usize,
        /// The one asked for.
        column: String,
        /// How many there are.
        columns: usize,
    },
    /// No samples, or a single one.
    #[error("{found} sample(s); expected 2 or more: get the file again")]
    TooShort {
        /// How many there are.
        found: usize,
    },
}
