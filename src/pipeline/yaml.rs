//! What is wrong with a YAML file, in one line.

use crate::keyword::nearest;

/// One line: where, what, and for an unknown key the nearest known one.
pub fn explain(error: &serde_saphyr::Error) -> String {
    let error = error.without_snippet();
    let place = error
        .location()
        .map(|at| format!("line {}, column {}: ", at.line(), at.column()))
        .unwrap_or_default();
    if let serde_saphyr::Error::SerdeUnknownField { field, expected, .. } = error {
        let hint = match nearest(field, expected) {
            Some(near) => format!("did you mean '{near}'?"),
            None => format!("expected one of {}", expected.join(", ")),
        };
        return format!("{place}unknown key '{field}'; {hint}");
    }
    let message = error.to_string();
    let mut lines = message.lines();
    format!("{place}{}", lines.next().unwrap_or_default())
}
