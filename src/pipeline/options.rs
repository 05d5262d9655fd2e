//! The options of a call: one JSON object of what is given, whoever gives it (the command line, a pipeline file or
//! Python), in which each value is a text, a list or mapping of texts or, of a switch, true or false. Defaults, the
//! file and the user are merged, and serde makes the struct of a stage of it.

use std::ops::RangeInclusive;
use std::path::Path;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::number::{self, count, rounded};

/// What is given to a stage, by option.
pub type Given = Map<String, Value>;

/// What options of a stage exclude, and need.
#[derive(Debug, Clone, Copy)]
pub enum Rule {
    /// Those of either side exclude those of the other.
    Either(&'static [&'static str], &'static [&'static str]),
    /// Each of the first needs one of the second.
    Needs(&'static [&'static str], &'static [&'static str]),
}

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
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Steps(pub Vec<f64>);

/// Largest number of values of first:last:step.
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

/// Finds the first of some options that is given.
pub fn first_of(options: &'static [&'static str], given: &Given) -> Option<&'static str> {
    options
        .iter()
        .copied()
        .find(|option| given.get(*option).is_some_and(|value| *value != Value::Bool(false)))
}

/// Puts the options of the user over those of a file: one of the user drops its alternatives in the file, and
/// what needs these.
pub fn merge(file: &Given, user: &Given, rules: &[Rule]) -> Given {
    let mut kept = file.clone();
    for rule in rules {
        match rule {
            Rule::Either(these, those) => {
                for (given, dropped) in [(these, those), (those, these)] {
                    if first_of(given, user).is_some() {
                        kept.retain(|option, _| !dropped.contains(&option.as_str()));
                    }
                }
            }
            Rule::Needs(these, those) => {
                let is_met = |given| first_of(those, given).is_some();
                if is_met(file) && !is_met(&kept) && !is_met(user) {
                    kept.retain(|option, _| !these.contains(&option.as_str()));
                }
            }
        }
    }
    kept.extend(user.clone());
    kept
}

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
