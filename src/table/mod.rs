//! The files: Parquet tables whose columns carry their unit and meaning, and whose footer says how they were made.
//!
//! ```text
//! dictionary  every column once: name, unit, meaning
//! rows        structs as rows of a table (serde)
//! file        a table on disk: a file, or a folder of files
//! columns     columns of a batch by name, whatever program wrote them
//! writer      writes beside the name and renames when whole
//! provenance  what made a file, and the key by which a stage knows that it is up to date
//! motions     one row a ground motion      responses  one row a motion and structure
//! frame       narrow tables as polars frames, and how they are shown      sheet  CSV of people as frames
//! ```

pub mod columns;
pub mod dictionary;
pub mod file;
pub mod frame;
pub mod motions;
pub mod provenance;
pub mod responses;
pub mod rows;
pub mod writer;

use std::path::{Path, PathBuf};

/// A table that cannot be read or written. Rows count from 0.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    #[error("{}: no such file; run the stage that makes it first", .0.display())]
    Missing(PathBuf),
    #[error("{}: {source}", path.display())]
    Io { path: PathBuf, source: std::io::Error },
    #[error("{}: not a readable Parquet file ({cause})", path.display())]
    Parquet { path: PathBuf, cause: String },
    #[error("{}: no column '{column}'; expected {expected}", path.display())]
    MissingColumn { path: PathBuf, column: String, expected: String },
    #[error("{}: column '{column}' is {found}; expected {expected}", path.display())]
    ColumnType { path: PathBuf, column: String, found: String, expected: &'static str },
    #[error("{}: row {row}, column '{column}': {problem}", path.display())]
    Value { path: PathBuf, row: u64, column: &'static str, problem: String },
    #[error("{}: {problem}", path.display())]
    Table { path: PathBuf, problem: String },
}

impl TableError {
    /// What the operating system says about `path`.
    pub fn io(path: &Path, source: std::io::Error) -> TableError {
        match source.kind() {
            std::io::ErrorKind::NotFound => TableError::Missing(path.to_path_buf()),
            _ => TableError::Io { path: path.to_path_buf(), source },
        }
    }

    /// What the Parquet library says about `path`.
    pub fn parquet(path: &Path, cause: impl ToString) -> TableError {
        TableError::Parquet { path: path.to_path_buf(), cause: cause.to_string() }
    }

    /// A problem of a table as a whole.
    pub fn table(path: &Path, problem: impl Into<String>) -> TableError {
        TableError::Table { path: path.to_path_buf(), problem: problem.into() }
    }
}
