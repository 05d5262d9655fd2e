//! The Parquet files that stages hand on: each table is declared once, as the struct of its rows.
//!
//! ```text
//! schema       the dictionary: every column once, with name, type, unit and meaning
//! row          a table as the struct of its rows; cell what a field can hold
//! store        reads and writes any table
//! the others   one file a subject: its tables, and how the results of the science become rows
//! ```

pub mod cell;
pub mod evaluated;
pub mod fits;
pub mod ida;
pub mod intensities;
pub mod motion_measures;
pub mod motion_table;
pub mod motions;
pub mod paper;
pub mod pex;
pub mod pro;
pub mod ranking;
pub mod records;
pub mod responses;
pub mod row;
pub mod scenarios;
pub mod schema;
pub mod store;
pub mod synthetic_motions;
pub mod universality;
pub mod validation;

use std::path::{Path, PathBuf};

/// What can be wrong with a table in a file. Every message names the file and says what to do.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    /// The file is not there.
    #[error("{}: no such file; {hint}", path.display())]
    Missing {
        path: PathBuf,
        /// How to get it.
        hint: String,
    },
    /// The operating system refused.
    #[error("{}: {source}", path.display())]
    Io {
        path: PathBuf,
        /// What it said.
        source: std::io::Error,
    },
    /// The file cannot be read as Parquet.
    #[error("{}: not a readable Parquet file ({cause}); make it again; if rockfrag made it, by the same command with --overwrite", path.display())]
    NotParquet {
        path: PathBuf,
        /// What the reader said.
        cause: parquet::errors::ParquetError,
    },
    /// The file is of another kind.
    #[error("{}: not a Parquet file; expected {expected}", path.display())]
    NoParquet {
        /// The file.
        path: PathBuf,
        /// What it should be.
        expected: String,
    },
    /// The file is compressed in a way that is not built in.
    #[error("{}: compressed in a way that rockfrag does not read ({message}); write it with zstd or snappy, or uncompressed", path.display())]
    Codec {
        path: PathBuf,
        /// What the reader said.
        message: String,
    },
    /// The table cannot be read as a frame.
    #[error("{}: cannot read: {message}", path.display())]
    Read {
        path: PathBuf,
        /// What the reader said.
        message: String,
    },
    /// The file cannot be written.
    #[error("{}: cannot write: {message}", path.display())]
    Write {
        path: PathBuf,
        /// What the writer said.
        message: String,
    },
    /// The file was made by another stage than the one whose output is read here.
    #[error("{}: made by {found}; expected the output of {expected}", path.display())]
    OtherStage {
        path: PathBuf,
        /// The stage in its metadata.
        found: String,
        /// The stage whose output it should be.
        expected: String,
    },
    /// A later version of rockfrag has written the file in a way that is not yet known here.
    #[error("{}: written by rockfrag {version} in format {format}; this is rockfrag {}, which reads formats up to {known}: update it, or make the file again", path.display(), env!("CARGO_PKG_VERSION"))]
    Newer {
        path: PathBuf,
        /// The version that wrote it.
        version: String,
        format: String,
        /// The last format that is known here.
        known: u32,
    },
    /// The file became another one while it was read.
    #[error("{}: changed or removed while it was read; run again", path.display())]
    Changed { path: PathBuf },
    /// The file says that it has more rows than it can hold.
    #[error("{}: {rows} rows in a file of {bytes} bytes; expected a byte a row at least: write it plain, without dictionaries and compression", path.display())]
    TooManyRows {
        path: PathBuf,
        /// How many rows it announces.
        rows: u64,
        bytes: u64,
    },
    /// A column is missing.
    #[error("{}: no column '{column}'; expected {expected}", path.display())]
    MissingColumn {
        path: PathBuf,
        column: String,
        /// Its type and meaning.
        expected: String,
    },
    /// A column has a type that cannot serve.
    #[error("{}: column '{column}' is {found}; expected {expected}: convert it", path.display())]
    WrongType {
        path: PathBuf,
        column: String,
        /// Its type in the file.
        found: String,
        /// The type it should have.
        expected: String,
    },
    /// A folder does not stand for a whole table.
    #[error("{}: {problem}", path.display())]
    Folder {
        path: PathBuf,
        /// What is wrong with it and what to do.
        problem: String,
    },
    /// The table has no rows.
    #[error("{}: the table is empty; expected at least one row", path.display())]
    Empty { path: PathBuf },
    /// A value cannot be used. `row` counts from 0.
    #[error("{}: row {row}, column '{column}': {problem}", path.display())]
    Value {
        path: PathBuf,
        /// Where in the table.
        row: u64,
        column: String,
        /// What stands there and what should.
        problem: String,
    },
}

impl TableError {
    /// What the operating system said about `path`.
    pub fn io(path: &Path, source: std::io::Error) -> TableError {
        TableError::Io { path: path.to_path_buf(), source }
    }
}
