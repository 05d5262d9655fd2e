//! Options as they stand on the command line and in pipeline.yaml: one struct serves both.

use std::any::TypeId;
use std::error::Error;
use std::ffi::OsStr;
use std::fmt;
use std::marker::PhantomData;
use std::str::FromStr;

use clap::builder::{PossibleValue, TypedValueParser, ValueParserFactory};
use clap::{Arg, Args, Command};
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::UsageError;
use crate::keyword::{self, Keyword, UnknownKeyword, nearest};
use crate::rocking::Bound;

/// The defaults of an options struct: what an empty command line gives.
pub fn defaults<T: Args>() -> T {
    let matches = T::augment_args(Command::new("defaults")).get_matches_from(["defaults"]);
    T::from_arg_matches(&matches).expect("every option has a default or is optional")
}

/// The seed where none is given.
pub const DEFAULT_SEED: u64 = 42;

/// A word of a fixed list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Word<T>(pub T);

impl<T: Keyword> FromStr for Word<T> {
    type Err = UnknownKeyword;

    fn from_str(word: &str) -> Result<Word<T>, UnknownKeyword> {
        keyword::parse(word).map(Word)
    }
}

impl<T: Keyword> fmt::Display for Word<T> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.0.as_str())
    }
}

/// Reads what [`FromStr`] understands, and knows the words of `T` that it is made of: Python's functions name them in their types.
pub struct WordsParser<T, V>(PhantomData<fn() -> (T, V)>);

impl<T, V> Clone for WordsParser<T, V> {
    fn clone(&self) -> Self {
        WordsParser(PhantomData)
    }
}

impl<T, V> TypedValueParser for WordsParser<T, V>
where
    T: Keyword,
    V: FromStr<Err: Into<Box<dyn Error + Send + Sync>>> + Clone + Send + Sync + 'static,
{
    type Value = V;

    fn parse_ref(&self, command: &Command, arg: Option<&Arg>, value: &OsStr) -> Result<V, clap::Error> {
        TypedValueParser::parse_ref(&V::from_str, command, arg, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(T::ALL.iter().map(|word| PossibleValue::new(word.as_str()))))
    }
}

impl<T: Keyword + Send + Sync> ValueParserFactory for Word<T> {
    type Parser = WordsParser<T, Word<T>>;

    fn value_parser() -> Self::Parser {
        WordsParser(PhantomData)
    }
}

impl<T: Keyword + Send + Sync> ValueParserFactory for Several<Word<T>> {
    type Parser = WordsParser<T, Several<Word<T>>>;

    fn value_parser() -> Self::Parser {
        WordsParser(PhantomData)
    }
}

/// A value that stands as text in options, or as a bare number in the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Parsed<T>(pub T);

impl<T: FromStr> FromStr for Parsed<T> {
    type Err = T::Err;

    fn from_str(text: &str) -> Result<Parsed<T>, T::Err> {
        text.parse().map(Parsed)
    }
}

impl<T: fmt::Display> fmt::Display for Parsed<T> {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        self.0.fmt(f)
    }
}

/// The command with words of ours about flags whose numbers are none.
pub fn with_number_messages(command: Command) -> Command {
    let of_flag = |arg: Arg| match arg.get_value_parser().type_id() {
        id if id == TypeId::of::<f64>() => arg.value_parser(number::<f64>),
        id if id == TypeId::of::<u32>() => arg.value_parser(number::<u32>),
        id if id == TypeId::of::<u64>() => arg.value_parser(number::<u64>),
        id if id == TypeId::of::<usize>() => arg.value_parser(number::<usize>),
        _ => arg,
    };
    command.mut_args(of_flag).mut_subcommands(|subcommand| subcommand.mut_args(of_flag))
}

/// The number that a text is, or what was expected.
///
/// # Errors
/// If it is none.
pub fn number<T: FromStr + 'static>(text: &str) -> Result<T, String> {
    text.parse().map_err(|_| match TypeId::of::<T>() == TypeId::of::<f64>() {
        true => format!("expected a number, such as 2.5{}", comma_slip(text)),
        false => "expected a whole number, 0 or more".to_string(),
    })
}

/// What to say of a text besides, if it is a number but for a decimal comma.
pub fn comma_slip(text: &str) -> &'static str {
    let is_one = text.contains(',') && text.replace(',', ".").parse::<f64>().is_ok();
    if is_one { ": write a point before the decimals, not a comma" } else { "" }
}

/// Several values, separated by commas on the command line, a list (or such text) in the file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Several<T>(pub Vec<T>);

impl<T: FromStr> FromStr for Several<T> {
    type Err = T::Err;

    fn from_str(text: &str) -> Result<Several<T>, T::Err> {
        text.split(',').map(|part| part.trim().parse()).collect::<Result<_, _>>().map(Several)
    }
}

/// Numbers: one, some separated by commas, or first:last:step.
#[derive(Debug, Clone, PartialEq)]
pub struct Steps {
    text: String,
    /// Ascending.
    pub values: Vec<f64>,
}

/// More values than any grid needs.
const MOST_STEPS: f64 = 10_000.0;

impl FromStr for Steps {
    type Err = String;

    fn from_str(text: &str) -> Result<Steps, String> {
        let comma = text.split(':').map(str::trim).map(comma_slip).max().filter(|_| text.contains(':'));
        let expected = || {
            let comma = comma.unwrap_or_default();
            format!("'{text}': expected a number, numbers separated by commas, or first:last:step{comma}")
        };
        let numbers = |separator| {
            let parts = text.split(separator).map(|part| part.trim().parse::<f64>());
            let numbers = parts.collect::<Result<Vec<f64>, _>>().map_err(|_| expected())?;
            if numbers.iter().all(|number| number.is_finite()) { Ok(numbers) } else { Err(expected()) }
        };
        let values = if text.contains(':') {
            let [first, last, step] = numbers(':')?[..] else { return Err(expected()) };
            let steps = ((last - first) / step + 1e-9).floor();
            if !(step > 0.0 && last >= first && steps < MOST_STEPS) {
                return Err(format!("'{text}': expected first <= last and a step above 0"));
            }
            (0..=steps as usize).map(|k| first + step * k as f64).collect()
        } else {
            numbers(',')?
        };
        if values.windows(2).any(|pair| pair[0] >= pair[1]) {
            return Err(format!("'{text}': expected rising numbers"));
        }
        Ok(Steps { text: text.to_string(), values })
    }
}

impl fmt::Display for Steps {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// A value that the file may give as a number, as text, or as a list of them.
#[derive(Deserialize)]
#[serde(untagged, expecting = "expected a number, text, or a list of them")]
enum Plain {
    Number(f64),
    Text(String),
    List(Vec<Plain>),
}

impl Plain {
    fn text(self) -> String {
        match self {
            Plain::Number(number) => number.to_string(),
            Plain::Text(text) => text,
            Plain::List(parts) => parts.into_iter().map(Plain::text).collect::<Vec<_>>().join(","),
        }
    }
}

/// Reads what [`FromStr`] understands, from text, from a bare number, or from a list as separated by commas.
pub fn from_scalar<'de, D: Deserializer<'de>, T: FromStr<Err: fmt::Display>>(
    deserializer: D,
) -> Result<T, D::Error> {
    Plain::deserialize(deserializer)?.text().parse().map_err(D::Error::custom)
}

macro_rules! as_text {
    ([$($generics:tt)*] $type:ty) => {
        impl<$($generics)*> Serialize for $type {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.collect_str(self)
            }
        }

        impl<'de, $($generics)*> Deserialize<'de> for $type {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                from_scalar(deserializer)
            }
        }
    };
}

as_text!([T: Keyword] Word<T>);
as_text!([T: FromStr<Err: fmt::Display> + fmt::Display] Parsed<T>);
as_text!([] Steps);

impl<T: Serialize> Serialize for Several<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl<'de, T: FromStr<Err: fmt::Display>> Deserialize<'de> for Several<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Several<T>, D::Error> {
        match Plain::deserialize(deserializer)? {
            Plain::List(parts) => {
                let values = parts.into_iter().map(|part| part.text().parse().map_err(D::Error::custom));
                Ok(Several(values.collect::<Result<_, _>>()?))
            }
            one => one.text().parse().map_err(D::Error::custom),
        }
    }
}

/// That a number of an option lies where it must.
///
/// # Errors
/// With the name of the option and what was expected.
pub fn check(ok: bool, option: &str, value: impl fmt::Display, expected: &str) -> anyhow::Result<()> {
    if ok { Ok(()) } else { Err(UsageError::because(format!("{option} is {value}; expected {expected}"))) }
}

/// That a number lies where it can be right, or what slip it may be.
///
/// # Errors
/// As [`check`].
pub fn check_bound(bound: &Bound, value: f64) -> anyhow::Result<()> {
    let refusal = bound.refusal(value);
    check(refusal.is_none(), bound.parameter, value, &refusal.unwrap_or_default())
}

/// What the reader of YAML says of a value of another type, and what was expected.
const VALUES: [(&str, &str); 4] = [
    ("invalid floating point", "a number such as 0.3, with a decimal point and no unit"),
    ("invalid u", "a whole number such as 10"),
    ("invalid i", "a whole number such as 10"),
    ("expected string scalar", "one word or number"),
];

/// The key that stands before a value in a line of YAML, and the value up to where it ends.
fn entry(text: &str, line: u64, column: u64) -> Option<(&str, &str)> {
    let line = text.lines().nth(usize::try_from(line).ok()?.checked_sub(1)?)?;
    let (at, _) = line.char_indices().nth(usize::try_from(column).ok()?.checked_sub(1)?)?;
    let (before, value) = line.split_at(at);
    let key = before.trim_end().strip_suffix(':')?.rsplit(['{', ',', ' ']).next()?;
    // A list goes on after its commas.
    let end = if value.starts_with('[') { "]" } else { ", " };
    let value = value.split(['}', '#']).next().and_then(|value| value.split_inclusive(end).next())?;
    let value = value.trim().trim_end_matches(',');
    (!key.is_empty() && !value.is_empty()).then_some((key, value))
}

/// What is wrong with a YAML file of this text, in one line: where, what, and for an unknown key the nearest known one.
pub fn explain(error: &serde_saphyr::Error, text: &str) -> String {
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
    let line = message.lines().next().unwrap_or_default();
    // What it says of the place stands in front already.
    let said = line.rsplit_once(" at line ").map_or(line, |(said, _)| said);
    let expected = VALUES.iter().find(|(begins, _)| said.starts_with(begins)).map(|(_, expected)| expected);
    let entry = error.location().and_then(|at| entry(text, at.line(), at.column()));
    match (expected, entry) {
        (Some(expected), Some((key, value))) => format!("{place}{key} is {value}; expected {expected}"),
        (Some(expected), None) => format!("{place}expected {expected}"),
        _ => format!("{place}{said}"),
    }
}
