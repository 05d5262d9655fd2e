//! The options of a call: one JSON object of what is given, whoever gives it (the command line, a pipeline
//! file or Python), in which each value is a text, a number, a switch, an object or a list of them. Defaults,
//! the file and the user are merged, and serde makes the struct of a stage of it.

use std::error::Error;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::builder::BoolishValueParser;
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Command, ValueHint};
use rockfrag_core::object::{Object, Restitution, Wall};
use rockfrag_core::plausibility::Expected;
use rockfrag_core::spelling::hint;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use super::paths::is_word;
use crate::number::{self, count, rounded};
use crate::table::provenance::text_of;

pub type Given = Map<String, Value>;

/// What options of a stage exclude, and need: by their names, or a name and the word that is given.
#[derive(Debug, Clone, Copy)]
pub enum Rule {
    /// Those of either side exclude those of the other.
    Either(&'static [&'static str], &'static [&'static str]),
    /// Each of the first needs one of the second.
    Needs(&'static [&'static str], &'static [&'static str]),
}

fn first_of(options: &'static [&'static str], given: &Given) -> Option<&'static str> {
    let is_given = |option: &&str| match option.split_once('=') {
        Some((option, word)) => given.get(option).is_some_and(|value| value == word),
        None => given.get(*option).is_some_and(|value| *value != Value::Bool(false)),
    };
    options.iter().copied().find(is_given)
}

impl Rule {
    /// What is wrong with the options given to a command.
    pub fn broken(&self, given: &Given, command: &Command) -> Option<String> {
        match self {
            Rule::Either(these, those) => {
                let (one, other) = first_of(these, given).zip(first_of(those, given))?;
                Some(format!("--{one} and --{other}: expected one of them"))
            }
            Rule::Needs(_, those) if first_of(those, given).is_some() => None,
            Rule::Needs(these, those) => {
                let option = first_of(these, given)?;
                let has = |of: &&str| command.get_arguments().any(|arg| name_of(arg) == *of);
                let needed: Vec<&str> = those.iter().copied().filter(has).collect();
                Some(format!("--{option} needs --{}", needed.join(" or --")))
            }
        }
    }
}

/// Puts the options of the user over those of a file: one of the user drops its alternatives in the file, and
/// what needs these.
pub fn merge(file: &Given, user: &Given, rules: &[Rule]) -> Given {
    let mut kept = file.clone();
    for rule in rules {
        let dropped = match rule {
            Rule::Either(these, those) => {
                [(these, those), (those, these)].map(|(one, other)| first_of(one, user).map(|_| *other))
            }
            Rule::Needs(these, those) => {
                let is_met = |given| first_of(those, given).is_some();
                [(is_met(file) && !is_met(&kept) && !is_met(user)).then_some(*these), None]
            }
        };
        kept.retain(|option, _| !dropped.iter().flatten().any(|some| some.contains(&option.as_str())));
    }
    kept.extend(user.clone());
    kept
}

pub fn name_of(arg: &Arg) -> &str {
    arg.get_long().unwrap_or(arg.get_id().as_str())
}

pub fn is_path(arg: &Arg) -> bool {
    !matches!(arg.get_value_hint(), ValueHint::Unknown)
}

/// Brings options of any form into one, with paths where they lead; null and an empty list are not given.
///
/// # Errors
/// If there is no such option, or its value cannot be read.
pub fn in_one_form(
    command: &Command,
    options: Given,
    located: &dyn Fn(&str) -> PathBuf,
) -> Result<Given, UsageError> {
    let mut given = Given::new();
    for (option, value) in options {
        let mut args = command.get_arguments();
        let Some(arg) = args.find(|arg| arg.get_id() == &*option || name_of(arg) == option) else {
            let known: Vec<&str> = command.get_arguments().map(name_of).collect();
            let hint = hint(&option, &known);
            return Err(UsageError::UnknownOption(format!("unknown option '{option}'{hint}")));
        };
        if value.is_null() || value.as_array().is_some_and(Vec::is_empty) {
            continue;
        }
        let refuse = |problem: &str| UsageError::Mistake(format!("--{} is {problem}", name_of(arg)));
        let form = form(arg, &value, located);
        let form = form.map_err(|why| refuse(&format!("{}; {why}", text_of(&value))))?;
        if given.insert(name_of(arg).to_string(), form).is_some() {
            return Err(refuse("given twice; expected one value"));
        }
    }
    Ok(given)
}

/// Returns the value of an option: a list of what may be given several times, else one.
fn form(arg: &Arg, value: &Value, located: &dyn Fn(&str) -> PathBuf) -> Result<Value, String> {
    let items = match (arg.get_action(), value) {
        (ArgAction::Append, Value::Array(items)) => items,
        (ArgAction::Append, item) => std::slice::from_ref(item),
        _ => return one(arg, text_of(value).into(), located),
    };
    let parts = items.iter().flat_map(|item| match (item, text_of(item)) {
        (Value::Object(_), _) => vec![item.clone()],
        // The name of a file may have a comma.
        (_, text) if is_path(arg) && (arg.is_positional() || located(&text).exists()) => vec![text.into()],
        (_, text) if is_path(arg) || arg.get_value_delimiter().is_some() => {
            text.split(',').map(Value::from).collect()
        }
        (_, text) => vec![text.into()],
    });
    parts.map(|part| one(arg, part, located)).collect()
}

fn one(arg: &Arg, value: Value, located: &dyn Fn(&str) -> PathBuf) -> Result<Value, String> {
    match value {
        Value::String(text) if text.is_empty() => Err("expected a value".to_string()),
        Value::String(text) if text == "-" || is_word(name_of(arg), &text) => Ok(text.into()),
        Value::String(text) if is_path(arg) => Ok(located(&text).to_string_lossy().into()),
        Value::String(text) => read(arg, text.trim()),
        Value::Object(mut fields) if name_of(arg) == "structure" => {
            fields.retain(|_, value| !value.is_null());
            let texts: Vec<String> = fields.values().map(text_of).collect();
            let fields = fields.keys().map(String::as_str).zip(texts.iter().map(String::as_str));
            Object::of_fields(fields).map(|object| json!(object))
        }
        _ => Err("expected no mapping".to_string()),
    }
}

/// Reads the text of an option by its parser: switches, numbers and objects are typed, all else stays text.
fn read(arg: &Arg, text: &str) -> Result<Value, String> {
    let id = arg.get_id().as_str();
    let mut alone = arg.clone().action(ArgAction::Set).long("option");
    if let ArgAction::SetTrue = arg.get_action() {
        alone = alone.value_parser(BoolishValueParser::new());
    }
    let line = Command::new("").no_binary_name(true).arg(alone);
    let read = line
        .try_get_matches_from([format!("--option={text}")])
        .map_err(|error| error.source().map_or(error.to_string(), |reason| reason.to_string()))?;
    fn typed<T: Serialize + Clone + Send + Sync + 'static>(read: &ArgMatches, id: &str) -> Option<Value> {
        read.try_get_one::<T>(id).ok().flatten().map(|value| json!(value))
    }
    let plain = [typed::<bool>, typed::<f64>, typed::<u64>, typed::<usize>, typed::<u32>];
    let types = [typed::<Steps>, typed::<Restitution>, typed::<Wall>, typed::<Object>];
    let typed = plain.iter().chain(&types).find_map(|typed| typed(&read, id));
    Ok(typed.unwrap_or(text.into()))
}

pub fn on_line(command: &Command, matches: &ArgMatches) -> Given {
    let texts = command.get_arguments().filter_map(|arg| {
        let id = arg.get_id().as_str();
        let is_given = matches.value_source(id) == Some(ValueSource::CommandLine);
        let texts = matches.get_raw(id).filter(|_| is_given)?;
        Some((name_of(arg).to_string(), texts.map(|text| text.to_string_lossy()).collect()))
    });
    texts.collect()
}

pub fn defaults(command: &Command, folder: &Path) -> Given {
    let default = |arg: &Arg| {
        let text = arg.get_default_values().first().map(|text| text.to_string_lossy());
        let default = match (text, arg.get_action()) {
            (Some(text), _) => form(arg, &text.into(), &|path| folder.join(path)).ok()?,
            (None, ArgAction::SetTrue) => Value::Bool(false),
            (None, ArgAction::Append) => json!([]),
            _ => return None,
        };
        Some((name_of(arg).to_string(), default))
    };
    command.get_arguments().filter_map(default).collect()
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

/// A parser of what a person gives.
pub fn given((range, expected): Expected) -> impl Fn(&str) -> Result<f64, String> + Clone {
    number(range, expected)
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

pub fn steps(
    range: RangeInclusive<f64>,
    expected: &'static str,
) -> impl Fn(&str) -> Result<Steps, &'static str> + Clone {
    move |text| {
        let steps: Steps = text.parse()?;
        if steps.0.iter().all(|value| range.contains(value)) { Ok(steps) } else { Err(expected) }
    }
}

pub fn periods(text: &str) -> Result<Steps, &'static str> {
    steps(0.01..=20.0, "expected periods in s, from 0.01 to 20")(text)
}

/// A mistake in a call, rather than in a file: the command exits with 2.
#[derive(Debug, thiserror::Error)]
pub enum UsageError {
    #[error("{0}")]
    Mistake(String),
    #[error("{0}")]
    UnknownOption(String),
}

impl UsageError {
    pub fn because(message: impl Into<String>) -> anyhow::Error {
        UsageError::Mistake(message.into()).into()
    }
}

/// Several things that are wrong, a line each.
#[derive(Debug, thiserror::Error)]
#[error("{}", .0.join("; "))]
pub struct SeveralErrors(pub Vec<String>);

const MOST_LINES: usize = 16;

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
