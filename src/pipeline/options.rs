//! Option types of several stages.

use std::error::Error;
use std::fmt::Display;
use std::ops::RangeInclusive;
use std::path::Path;
use std::str::FromStr;

use clap::error::{ContextKind, ErrorKind};
use serde::Serialize;

use crate::number::count;

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

impl FromStr for Steps {
    type Err = String;

    fn from_str(text: &str) -> Result<Steps, String> {
        let expected = || "expected rising numbers separated by commas, or first:last:step".to_string();
        let numbers =
            |separator| text.split(separator).map(|part| part.trim().parse().map_err(|_| expected()));
        let values: Vec<f64> = if text.contains(':') {
            let parts = numbers(':').collect::<Result<Vec<f64>, _>>()?;
            let [first, last, step] = parts[..] else { return Err(expected()) };
            let steps = ((last - first) / step + 1e-9).floor();
            if !(step > 0.0 && (0.0..MOST_STEPS).contains(&steps)) {
                return Err(expected());
            }
            (0..=steps as usize).map(|k| first + step * k as f64).collect()
        } else {
            numbers(',').collect::<Result<_, _>>()?
        };
        let rising = values.iter().all(|value| value.is_finite()) && values.is_sorted_by(|a, b| a < b);
        if rising { Ok(Steps(values)) } else { Err(expected()) }
    }
}

/// Parses periods of spectral accelerations, s.
pub fn periods(text: &str) -> Result<Steps, String> {
    let steps: Steps = text.parse()?;
    let is_within = steps.0.iter().all(|period| (0.01..=20.0).contains(period));
    if is_within { Ok(steps) } else { Err("expected periods in s, from 0.01 to 20".to_string()) }
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
    let file = file.file_name().unwrap_or_default().to_string_lossy();
    format!("{first}and {} more, in {file}\n", count(lines + 1 - most))
}

/// Returns a refusal of options that are not on the command line, in one line.
pub fn in_one_line(refused: &clap::Error) -> String {
    let word = |kind| refused.get(kind).map(|word| word.to_string());
    let option = |kind| Some(word(kind)?.split(' ').next()?.trim_start_matches('-').to_string());
    let value = word(ContextKind::InvalidValue).unwrap_or_default();
    match (refused.kind(), option(ContextKind::InvalidArg), refused.source()) {
        (ErrorKind::ValueValidation, Some(name), Some(expected)) => format!("{name} is {value}; {expected}"),
        (ErrorKind::UnknownArgument, Some(name), _) => {
            let similar = option(ContextKind::SuggestedArg);
            let hint = similar.map_or(String::new(), |similar| format!("; did you mean '{similar}'?"));
            format!("unknown option '{name}'{hint}")
        }
        _ => {
            let text = refused.to_string();
            let message = text.split("\n\n").next().unwrap_or_default().trim_start_matches("error: ");
            message.split_whitespace().collect::<Vec<_>>().join(" ")
        }
    }
}

/// Joins the items of a list, the first few by name: `a, b, c and 9 more`.
pub fn listed<T: Display>(items: &[T], named: usize) -> String {
    let first: Vec<String> = items.iter().take(named).map(T::to_string).collect();
    match items.len() - first.len() {
        0 => first.join(", "),
        more => format!("{} and {more} more", first.join(", ")),
    }
}
