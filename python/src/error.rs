//! What went wrong, as the exception of `rockfrag.errors` that says so.

use pyo3::prelude::*;
use rockfrag::pipeline::UsageError;
use rockfrag::table::TableError;

/// The exception for an error of the library.
pub fn to_python(py: Python, error: &anyhow::Error) -> PyErr {
    let class = class_of(error);
    let raise = || py.import("rockfrag.errors")?.getattr(class)?.call1((format!("{error:#}"),));
    raise().map_or_else(|failed| failed, PyErr::from_value)
}

fn class_of(error: &anyhow::Error) -> &'static str {
    if error.chain().any(|cause| cause.is::<UsageError>()) {
        return "OptionError";
    }
    match error.chain().find_map(|cause| cause.downcast_ref::<TableError>()) {
        Some(TableError::Missing { .. }) => "MissingFileError",
        Some(
            TableError::Io { .. }
            | TableError::NotParquet { .. }
            | TableError::NoParquet { .. }
            | TableError::Codec { .. }
            | TableError::Write { .. },
        ) => "FileError",
        Some(_) => "TableError",
        None => "RockfragError",
    }
}
