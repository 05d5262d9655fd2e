//! Option types of several stages, and mistakes in options.

use std::ops::RangeInclusive;
use std::path::Path;
use std::str::FromStr;

use serde::Serialize;

use crate::number::{self, count, rounded};

/// A mistake in a call, rather than in a file: the command exits with 2.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct UsageError(String);

impl UsageError {
    pub fn because(message: impl Into<String>) -> anyhow::Error {
        UsageError(message.into()).into()
    }
}

/// Several things that are wrong, a line each.
#[derive(Debug, thiserror::Error)]
#[error("{}", .0.join("; "))]
pub struct SeveralErrors(pub Vec<String>);

/// Returns a parser of numbers in a range; `expected` describes them, with unit and range.
pub fn number<T: FromStr + PartialOrd + Clone>(
    range: RangeInclusive<T>,
    expected: &'static str,
) -> impl Fn(&str) -> Result<T, String> + Clone {
    move |text| match text.parse::<T>() {
        Ok(number) if range.contains(&number) => Ok(number),
        _ if text.contains(',') => Err(format!("expected {expected}, with a point before the decimals")),
        _ => Err(format!("expected {expected}")),
    }
}

/// Ascending numbers: one, several separated by commas, or first:last:step.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Steps(pub Vec<f64>);

/// Largest number of values.
const MOST_STEPS: f64 = 10_000.0;
const EXPECTED_STEPS: &str = "expected rising numbers separated by commas, or first:last:step";

impl FromStr for Steps {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Steps, &'static str> {
        let separator = if text.contains(':') { ':' } else { ',' };
        let numbers = text.split(separator).map(|part| part.trim().parse());
        let mut values = numbers.collect::<Result<Vec<f64>, _>>().map_err(|_| EXPECTED_STEPS)?;
        if separator == ':' {
            let [first, last, step] = values[..] else { return Err(EXPECTED_STEPS) };
            let steps = ((last - first) / step + 1e-9).floor();
            if !(step > 0.0 && (0.0..MOST_STEPS).contains(&steps)) {
                return Err(EXPECTED_STEPS);
            }
            values = (0..=steps as usize).map(|k| rounded(first + step * k as f64)).collect();
        }
        let is_rising = values.iter().all(|value| value.is_finite()) && values.is_sorted_by(|a, b| a < b);
        if is_rising { Ok(Steps(values)) } else { Err(EXPECTED_STEPS) }
    }
}

/// Returns a parser of ascending numbers in a range; `expected` describes them.
pub fn steps(
    range: RangeInclusive<f64>,
    expected: &'static str,
) -> impl Fn(&str) -> Result<Steps, &'static str> + Clone {
    move |text| {
        let steps: Steps = text.parse()?;
        if steps.0.iter().all(|value| range.contains(value)) { Ok(steps) } else { Err(expected) }
    }
}

/// Parses periods of spectral accelerations, s.
pub fn periods(text: &str) -> Result<Steps, &'static str> {
    steps(0.01..=20.0, "expected periods in s, from 0.01 to 20")(text)
}

/// Lines that are printed of a list.
pub const MOST_LINES: usize = 10;

/// Returns the first lines of a printed list after its headings, and where all are.
pub fn first_lines(text: &str, headings: usize, file: &Path) -> String {
    let (lines, most) = (text.lines().count(), headings + MOST_LINES);
    if lines <= most {
        return text.to_string();
    }
    let first: String = text.lines().take(most - 1).map(|line| format!("{line}\n")).collect();
    let file = number::path(file.file_name().unwrap_or_default().as_ref());
    format!("{first}and {} more, in {file}\n", count(lines + 1 - most))
}

/// Returns what clap refuses and proposes in one line, without the usage of the command.
pub fn in_one_line(refused: &clap::Error) -> String {
    let text = refused.to_string();
    let lines = text.trim_start_matches("error: ").lines().map(str::trim);
    let lines =
        lines.take_while(|line| !line.starts_with("Usage:") && !line.starts_with("For more information"));
    lines.filter(|line| !line.is_empty()).collect::<Vec<_>>().join("; ")
}
