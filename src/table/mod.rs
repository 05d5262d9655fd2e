//! Parquet tables with unit and meaning of each column, and provenance in the footer.

mod checksums;
pub mod columns;
pub mod dictionary;
pub mod file;
pub mod frame;
pub mod keys;
pub mod motions;
pub mod provenance;
pub mod responses;
pub mod rows;
pub mod writer;

use std::path::{Path, PathBuf};

/// A table that cannot be read or written.
#[derive(Debug, thiserror::Error)]
pub enum TableError {
    #[error("{}: no such file", .0.display())]
    Missing(PathBuf),
    /// What may be read another time.
    #[error("{}: {cause}", path.display())]
    Io { path: PathBuf, cause: std::io::Error },
    #[error("{}: {problem}", path.display())]
    Table { path: PathBuf, problem: String },
}

impl TableError {
    pub fn io(path: &Path, cause: std::io::Error) -> TableError {
        match cause.kind() {
            std::io::ErrorKind::NotFound => TableError::Missing(path.to_path_buf()),
            _ => TableError::Io { path: path.to_path_buf(), cause },
        }
    }

    pub fn parquet(path: &Path, cause: impl ToString) -> TableError {
        TableError::table(path, format!("not a readable Parquet file ({})", cause.to_string()))
    }

    pub fn missing_column(path: &Path, column: &str) -> TableError {
        let expected = dictionary::meaning(column);
        TableError::table(path, format!("no column '{column}'; expected {expected}"))
    }

    /// A value that cannot be; `row` counts from 0, in words from 1.
    pub fn value(path: &Path, row: usize, column: &str, problem: impl ToString) -> TableError {
        let problem = problem.to_string();
        TableError::table(path, format!("row {}, column '{column}': {problem}", row + 1))
    }

    /// Any other problem with a table.
    pub fn table(path: &Path, problem: impl Into<String>) -> TableError {
        TableError::Table { path: path.to_path_buf(), problem: problem.into() }
    }
}
