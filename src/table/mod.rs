//! The Parquet files that the stages hand on.
//!
//! ```text
//! schema       every column once: name, type, unit, words; every table as a list of columns (one file a subject)
//! row          a table as the struct of its rows; cell the values of a field
//! columns      the columns of one batch, by name, checked
//! source       where a table is read from and written to: a path, or memory
//! folder       a folder of files as one table; partition one of its parts
//! footer       the end of a file, which says what is in it
//! limits       what a file may ask of memory
//! compact      the protocol in which files describe themselves; description the fields of which they do
//! guarded      damage that stops the decoder
//! table_file   one file, open at some columns; piece that or a table in memory
//! row_group    some rows of one, column by column; lists the samples of them
//! reader       batches from a table
//! frame        narrow tables whole, as polars frames
//! shared_file  a file that several threads read at once
//! writer       batches to a file, written beside its name and renamed when whole
//! fingerprint  the hash of what a file holds
//! provenance   what made a file, in its metadata
//! motion_table a motions file that several threads read; synthetic_motions what synthesize-motions writes
//! scenarios, motions, records, responses, trace, pex, pro, paper
//!              one file a table: its rows as Rust structs
//! ranking      sets of intensity measures by how well they predict; ranking_verdict the same in words
//! motion_measures  the measures of a motions file, without its samples
//! fits         the rows of pex and pro files as the fits they hold
//! intensities  any table with PGA and PGV, as evaluate takes it
//! hazard       hazard curves and joint hazards, in CSV files
//! evaluated    probabilities and annual rates: what evaluate answers
//! ida          the same motions at rising intensity
//! validation   forecasts beside what happened
//! universality the curve of one structure on others, and curves of all
//! text         any table as aligned text, CSV or JSON; text_file text files whole
//! ```

mod cell;
pub mod columns;
mod compact;
mod description;
pub mod evaluated;
pub mod fingerprint;
pub mod fits;
pub mod folder;
pub mod footer;
pub mod frame;
pub mod guarded;
pub mod hazard;
pub mod ida;
pub mod intensities;
mod limits;
mod lists;
pub mod motion_measures;
pub mod motion_table;
pub mod motions;
pub mod paper;
pub mod partition;
pub mod pex;
mod piece;
pub mod pro;
pub mod provenance;
pub mod ranking;
pub mod ranking_verdict;
pub mod reader;
pub mod records;
pub mod responses;
pub mod row;
mod row_group;
pub mod scenarios;
pub mod schema;
mod shared_file;
pub mod source;
pub mod synthetic_motions;
mod table_file;
pub mod text;
pub mod text_file;
pub mod trace;
pub mod universality;
pub mod validation;
pub mod writer;

use std::path::{Path, PathBuf};

/// What can be wrong with a table in a file. Every message names the file and says what to do.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    /// The file is not there.
    #[error("{}: no such file; {hint}", path.display())]
    Missing {
        /// The file.
        path: PathBuf,
        /// How to get it.
        hint: String,
    },
    /// The operating system refused.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What it said.
        source: std::io::Error,
    },
    /// The file cannot be read as Parquet.
    #[error("{}: not a readable Parquet file ({source}); make it again", path.display())]
    NotParquet {
        /// The file.
        path: PathBuf,
        /// What the reader said.
        source: parquet::errors::ParquetError,
    },
    /// The file is compressed in a way that is not built in.
    #[error("{}: compressed in a way that rockfrag does not read ({message}); write it with zstd or snappy, or uncompressed", path.display())]
    Codec {
        /// The file.
        path: PathBuf,
        /// What the reader said.
        message: String,
    },
    /// The file cannot be written.
    #[error("{}: cannot write: {message}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the writer said.
        message: String,
    },
    /// The file was made by another stage than the one whose output is read here.
    #[error("{}: made by {found}; expected the output of {expected}", path.display())]
    OtherStage {
        /// The file.
        path: PathBuf,
        /// The stage in its metadata.
        found: String,
        /// The stage whose output it should be.
        expected: String,
    },
    /// A later version of rockfrag has written the file in a way that is not yet known here.
    #[error("{}: written by rockfrag {version} in format {format}; this is rockfrag {}, which reads formats up to {known}: update it, or make the file again", path.display(), env!("CARGO_PKG_VERSION"))]
    Newer {
        /// The file.
        path: PathBuf,
        /// The version that wrote it.
        version: String,
        /// Its format.
        format: String,
        /// The last format that is known here.
        known: u32,
    },
    /// The file became another one while it was read.
    #[error("{}: changed or removed while it was read; run again", path.display())]
    Changed {
        /// The file.
        path: PathBuf,
    },
    /// The file says that it has more rows than it can hold.
    #[error("{}: {rows} rows in a file of {bytes} bytes; expected a byte a row at least: write it plain, without dictionaries and compression", path.display())]
    TooManyRows {
        /// The file.
        path: PathBuf,
        /// How many rows it announces.
        rows: u64,
        /// Its size.
        bytes: u64,
    },
    /// A column is missing.
    #[error("{}: no column '{column}'; expected {expected}", path.display())]
    MissingColumn {
        /// The file.
        path: PathBuf,
        /// The column.
        column: String,
        /// Its type and meaning.
        expected: String,
    },
    /// A column has a type that cannot serve.
    #[error("{}: column '{column}' is {found}; expected {expected}", path.display())]
    WrongType {
        /// The file.
        path: PathBuf,
        /// The column.
        column: String,
        /// Its type in the file.
        found: String,
        /// The type it should have.
        expected: String,
    },
    /// A folder does not stand for a whole table.
    #[error("{}: {problem}", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What is wrong with it and what to do.
        problem: String,
    },
    /// A file can only be made from files.
    #[error("{}: a table in memory; write it to a Parquet file and name that, so that what is made from it can say so", name.display())]
    InMemory {
        /// What it is called.
        name: PathBuf,
    },
    /// The table has no rows.
    #[error("{}: the table is empty; expected at least one row", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
    },
    /// A value cannot be used. `row` counts from 0.
    #[error("{}: row {row}, column '{column}': {problem}", path.display())]
    Value {
        /// The file.
        path: PathBuf,
        /// Where in the table.
        row: u64,
        /// Which column.
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
