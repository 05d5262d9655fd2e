//! What went wrong, as the exception of Python that fits.

use std::io;

use pyo3::exceptions::{PyFileNotFoundError, PyRuntimeError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use rockfrag::inputs::InputError;
use rockfrag::pipeline::UsageError;
use rockfrag::table::TableError;

pyo3::create_exception!(
    rockfrag,
    Error,
    PyRuntimeError,
    "A stage failed; the message names the file and what was expected."
);

/// The exception of an error: TypeError for an unknown option, ValueError for another mistake in the call,
/// FileNotFoundError, else [`Error`].
pub fn to_python(error: &anyhow::Error) -> PyErr {
    let is_missing = |cause: &(dyn std::error::Error + 'static)| {
        let mut input = cause.downcast_ref::<InputError>();
        while let Some(InputError::File { error, .. }) = input {
            input = Some(error);
        }
        matches!(input, Some(InputError::Unreadable(io::ErrorKind::NotFound, _)))
            || matches!(cause.downcast_ref(), Some(TableError::Missing(_)))
            || cause.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == io::ErrorKind::NotFound)
    };
    let message = in_python(&format!("{error:#}"));
    if error.chain().any(is_missing) {
        PyFileNotFoundError::new_err(message)
    } else {
        match error.chain().find_map(|cause| cause.downcast_ref()) {
            Some(UsageError::UnknownOption(_)) => PyTypeError::new_err(message),
            Some(UsageError::Mistake(_)) => PyValueError::new_err(message),
            None => Error::new_err(message),
        }
    }
}

/// A message in the words of Python: `--limit-state` is `limit_state`.
pub fn in_python(message: &str) -> String {
    let word = |word: &str| match word.split_once("--") {
        Some((before, option))
            if option.starts_with(|c: char| c.is_ascii_lowercase())
                && !before.ends_with(char::is_alphanumeric) =>
        {
            format!("{before}{}", option.replace('-', "_"))
        }
        _ => word.to_string(),
    };
    message.split_inclusive(char::is_whitespace).map(word).collect()
}
