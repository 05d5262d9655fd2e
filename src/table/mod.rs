//! Parquet tables with unit and meaning of each column, and provenance in the footer.
//!
//! ```text
//! dictionary  name, unit and meaning of every column
//! rows        structs as rows of a table (serde)
//! file        a table on disk: a file, or a folder of files
//! columns     columns of a batch by name, from any program
//! lists       a column of lists of numbers, read without building lists
//! writer      atomic writing
//! provenance  stage, arguments and inputs of a file, and their key
//! keys        the keys of files, which show whether a file is up to date
//! motions     motions, one per row
//! responses   responses, one row for each motion and structure
//! frame       tables as polars frames, and their text, CSV and JSON
//! ```

pub mod columns;
pub mod dictionary;
pub mod file;
pub mod frame;
pub mod keys;
pub mod lists;
pub mod motions;
pub mod provenance;
pub mod responses;
pub mod rows;
pub mod writer;

use std::path::{Path, PathBuf};

use arrow_schema::DataType;

/// A table that cannot be read or written. Rows count from 0.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    #[error("{}: no such file", .0.display())]
    Missing(PathBuf),
    #[error("{}: {source}", path.display())]
    Io { path: PathBuf, source: std::io::Error },
    #[error("{}: not a readable Parquet file ({cause})", path.display())]
    Parquet { path: PathBuf, cause: String },
    #[error("{}: no column '{column}'; expected {expected}", path.display())]
    MissingColumn { path: PathBuf, column: String, expected: String },
    #[error("{}: column '{column}' is {found}; expected {expected}", path.display())]
    ColumnType { path: PathBuf, column: String, found: String, expected: &'static str },
    /// `row` counts from 0, in words from 1.
    #[error("{}: row {}, column '{column}': {problem}", path.display(), row + 1)]
    Value { path: PathBuf, row: u64, column: &'static str, problem: String },
    #[error("{}: {problem}", path.display())]
    Table { path: PathBuf, problem: String },
}

impl TableError {
    /// Makes the error of the operating system for `path`.
    pub fn io(path: &Path, source: std::io::Error) -> TableError {
        match source.kind() {
            std::io::ErrorKind::NotFound => TableError::Missing(path.to_path_buf()),
            _ => TableError::Io { path: path.to_path_buf(), source },
        }
    }

    /// Makes the error of the Parquet library for `path`.
    pub fn parquet(path: &Path, cause: impl ToString) -> TableError {
        TableError::Parquet { path: path.to_path_buf(), cause: cause.to_string() }
    }

    /// Makes the error of a table without a column.
    pub fn missing_column(path: &Path, column: &str) -> TableError {
        let (path, expected) = (path.to_path_buf(), dictionary::meaning(column));
        TableError::MissingColumn { path, column: column.to_string(), expected }
    }

    /// Makes the error of a column of another type.
    pub fn other_type(path: &Path, column: &str, found: &DataType, expected: &'static str) -> TableError {
        let (path, column, found) = (path.to_path_buf(), column.to_string(), found.to_string());
        TableError::ColumnType { path, column, found, expected }
    }

    /// Makes the error of a table as a whole.
    pub fn table(path: &Path, problem: impl Into<String>) -> TableError {
        TableError::Table { path: path.to_path_buf(), problem: problem.into() }
    }
}
