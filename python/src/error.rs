//! What went wrong, as the exception of `rockfrag.errors` that says so.

use std::io;

use pyo3::prelude::*;
use rockfrag::pipeline::UsageError;
use rockfrag::table::TableError;

/// What has another name in Python than on the command line.
const OTHER_WORDS: [(&str, &str); 3] = [
    ("--in TABLE", "intensities=TABLE"),
    ("--columns pga_g=HEADING", "columns=\"pga_g=HEADING\""),
    ("beam-mass-ratio", "beam_mass_ratio"),
];

/// A message in the words of Python: `--limit-state` is `limit_state`.
pub fn in_python(message: &str) -> String {
    let message = OTHER_WORDS
        .iter()
        .fold(message.to_string(), |message, (words, python)| message.replace(words, python));
    let word = |word: &str| match word.split_once("--") {
        Some((before, option))
            if before.chars().all(|c| !c.is_alphanumeric()) && option.starts_with(char::is_lowercase) =>
        {
            format!("{before}{}", option.replace('-', "_"))
        }
        _ => word.to_string(),
    };
    message.split_inclusive(char::is_whitespace).map(word).collect()
}

/// The exception for an error of the library.
pub fn to_python(py: Python, error: &anyhow::Error) -> PyErr {
    let class = class_of(error);
    let raise = || py.import("rockfrag.errors")?.getattr(class)?.call1((in_python(&format!("{error:#}")),));
    raise().map_or_else(|failed| failed, PyErr::from_value)
}

fn class_of(error: &anyhow::Error) -> &'static str {
    let of_system = error.chain().find_map(|cause| cause.downcast_ref::<io::Error>());
    match error.chain().find_map(|cause| cause.downcast_ref::<TableError>()) {
        Some(TableError::Missing { .. }) => "MissingFileError",
        _ if of_system.is_some_and(|error| error.kind() == io::ErrorKind::NotFound) => "MissingFileError",
        _ if error.chain().any(|cause| cause.is::<UsageError>()) => "OptionError",
        Some(
            TableError::Io { .. }
            | TableError::NotParquet { .. }
            | TableError::NoParquet { .. }
            | TableError::Codec { .. }
            | TableError::Write { .. },
        ) => "FileError",
        Some(_) => "TableError",
        None if of_system.is_some() => "FileError",
        None => "RockfragError",
    }
}
