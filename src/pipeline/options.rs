//! Options as they stand on the command line and in pipeline.yaml: one struct serves both.

use std::fmt;
use std::str::FromStr;

use clap::parser::ValueSource;
use clap::{ArgMatches, Args, Command};
use serde::de::{DeserializeOwned, Error as _};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::Value;

use super::UsageError;
use crate::keyword::{self, Keyword, UnknownKeyword};

/// The defaults of an options struct: what an empty command line gives.
pub fn defaults<T: Args>() -> T {
    let matches = T::augment_args(Command::new("defaults")).get_matches_from(["defaults"]);
    T::from_arg_matches(&matches).expect("every option has a default or is optional")
}

/// Options as resolved: a flag wins over `file`, the file over the default.
///
/// # Errors
/// If flag and file do not fit together into the options.
pub fn resolve<T>(matches: &ArgMatches, file: Option<&T>) -> anyhow::Result<T>
where
    T: Args + Serialize + DeserializeOwned + Default,
{
    let to_object = |options: &T| match serde_json::to_value(options) {
        Ok(Value::Object(object)) => Ok(object),
        _ => Err(UsageError::because("options that are no list of names and values")),
    };
    let flags = to_object(&T::from_arg_matches(matches)?)?;
    let mut resolved = to_object(file.unwrap_or(&T::default()))?;
    for (name, value) in flags {
        if matches.value_source(&name.replace('-', "_")) != Some(ValueSource::CommandLine) {
            continue;
        }
        if value.is_null() {
            return Err(UsageError::because(format!("{name} is no finite number")));
        }
        resolved.insert(name, value);
    }
    serde_json::from_value(Value::Object(resolved)).map_err(|error| UsageError::because(error.to_string()))
}

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

/// Several values, parted by commas on the command line, a list (or such text) in the file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Several<T>(pub Vec<T>);

impl<T: FromStr> FromStr for Several<T> {
    type Err = T::Err;

    fn from_str(text: &str) -> Result<Several<T>, T::Err> {
        text.split(',').map(|part| part.trim().parse()).collect::<Result<_, _>>().map(Several)
    }
}

/// Numbers: one, some parted by commas, or first:last:step.
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
        let expected =
            || format!("'{text}': expected a number, numbers parted by commas, or first:last:step");
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

/// A value that the file may give as a number or as text.
#[derive(Deserialize)]
#[serde(untagged)]
enum Scalar {
    Number(f64),
    Text(String),
}

/// Reads what [`FromStr`] understands, from text or from a bare number.
pub fn from_scalar<'de, D: Deserializer<'de>, T: FromStr<Err: fmt::Display>>(
    deserializer: D,
) -> Result<T, D::Error> {
    let text = match Scalar::deserialize(deserializer)? {
        Scalar::Number(number) => number.to_string(),
        Scalar::Text(text) => text,
    };
    text.parse().map_err(D::Error::custom)
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

impl<'de, T: Deserialize<'de> + FromStr<Err: fmt::Display>> Deserialize<'de> for Several<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Several<T>, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum OneOrMore<T> {
            More(Vec<T>),
            Text(String),
        }
        match OneOrMore::deserialize(deserializer)? {
            OneOrMore::More(values) => Ok(Several(values)),
            OneOrMore::Text(text) => text.parse().map_err(D::Error::custom),
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
