//! What is given to a stage by the command line, a pipeline file or a call from Python, in one form.

use std::error::Error;
use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Command, ValueHint};
use rockfrag_core::object::{Object, Restitution};
use rockfrag_core::spelling::hint;
use serde::Serialize;
use serde_json::{Value, json};

use super::options::{Given, Steps, UsageError};
use super::paths::{is_word, split_list};
use crate::table::provenance::text_of;

/// There is no such option.
#[derive(Debug, thiserror::Error)]
#[error("unknown option '{1}'{0}")]
pub struct UnknownOption(String, String);

/// Where relative paths begin.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Base {
    pub folder: PathBuf,
    /// The folder of outputs as a pipeline file names it, and the one that a run has in its place.
    pub out: Option<(PathBuf, PathBuf)>,
}

impl Base {
    fn located(&self, path: &str) -> Result<Value, String> {
        let out =
            self.out.as_ref().and_then(|(named, out)| Some((out, Path::new(path).strip_prefix(named).ok()?)));
        let located = match out {
            Some((out, rest)) if rest == Path::new("") => out.clone(),
            Some((out, rest)) => out.join(rest),
            None => self.folder.join(path),
        };
        Ok(located.to_str().ok_or("expected a folder whose name is UTF-8")?.into())
    }
}

/// The name of an option.
pub fn name_of(arg: &Arg) -> &str {
    arg.get_long().unwrap_or(arg.get_id().as_str())
}

pub fn is_path(arg: &Arg) -> bool {
    !matches!(arg.get_value_hint(), ValueHint::Unknown)
}

/// Brings options of any form into the one that serde makes stages of; null and an empty list are not given.
///
/// # Errors
/// If there is no such option, or its value cannot be read.
pub fn in_one_form(
    command: &Command,
    options: impl IntoIterator<Item = (String, Value)>,
    base: &Base,
) -> anyhow::Result<Given> {
    let mut given = Given::new();
    for (option, value) in options {
        let mut args = command.get_arguments();
        let Some(arg) = args.find(|arg| arg.get_id() == &*option || name_of(arg) == option) else {
            let known: Vec<&str> = command.get_arguments().map(name_of).collect();
            return Err(UnknownOption(hint(&option, &known), option).into());
        };
        if value.is_null() || value.as_array().is_some_and(Vec::is_empty) {
            continue;
        }
        let form = form(arg, &value, base);
        let refused = |why| UsageError::because(format!("{} is {}; {why}", name_of(arg), text_of(&value)));
        if given.insert(name_of(arg).to_string(), form.map_err(refused)?).is_some() {
            return Err(UsageError::because(format!("{} is given twice; expected one value", name_of(arg))));
        }
    }
    Ok(given)
}

/// Returns the value of an option: true or false of a switch, a list of what may be given several times, or one
/// text, number or path.
fn form(arg: &Arg, value: &Value, base: &Base) -> Result<Value, String> {
    match (arg.get_action(), value) {
        (ArgAction::SetTrue, value) => match text_of(value).to_lowercase().as_str() {
            "true" | "yes" | "on" => Ok(Value::Bool(true)),
            "false" | "no" | "off" => Ok(Value::Bool(false)),
            _ => Err("expected true or false".to_string()),
        },
        (ArgAction::Append, value) => {
            let items = value.as_array().map_or(std::slice::from_ref(value), Vec::as_slice);
            items.iter().flat_map(|item| parts(arg, item, base)).map(|part| one(arg, part, base)).collect()
        }
        (_, value) => one(arg, text_of(value).into(), base),
    }
}

/// Splits what stands for several values of an option.
fn parts(arg: &Arg, item: &Value, base: &Base) -> Vec<Value> {
    match item {
        Value::Object(_) => vec![item.clone()],
        _ if is_path(arg) && !arg.is_positional() => {
            split_list(&base.folder, &text_of(item)).into_iter().map(Value::from).collect()
        }
        _ if arg.get_value_delimiter().is_some() => text_of(item).split(',').map(Value::from).collect(),
        _ => vec![text_of(item).into()],
    }
}

fn one(arg: &Arg, value: Value, base: &Base) -> Result<Value, String> {
    match value {
        Value::String(text) if text.is_empty() => Err("expected a value".to_string()),
        Value::String(text) if text == "-" || is_word(name_of(arg), &text) => Ok(text.into()),
        Value::String(text) if is_path(arg) => base.located(&text),
        Value::String(text) => read(arg, text.trim()),
        Value::Object(fields) if name_of(arg) == "structure" => {
            let fields = fields.iter().filter(|(_, value)| !value.is_null());
            let fields: Vec<(&str, String)> =
                fields.map(|(name, value)| (name.as_str(), text_of(value))).collect();
            Object::of_fields(fields.iter().map(|(name, text)| (*name, text.as_str())))
                .map(|object| json!(object))
        }
        _ => Err("expected no mapping".to_string()),
    }
}

/// Reads the text of an option by its parser: numbers and objects are typed, all else stays text.
fn read(arg: &Arg, text: &str) -> Result<Value, String> {
    let id = arg.get_id().as_str();
    let one = arg.clone().required(false).action(ArgAction::Set).long("option");
    let line = Command::new("").no_binary_name(true).arg(one);
    let read = line
        .try_get_matches_from([format!("--option={text}")])
        .map_err(|error| error.source().map_or(error.to_string(), |reason| reason.to_string()))?;
    fn typed<T: Serialize + Clone + Send + Sync + 'static>(read: &ArgMatches, id: &str) -> Option<Value> {
        read.try_get_one::<T>(id).ok().flatten().map(|value| json!(value))
    }
    let numbers = [typed::<f64>, typed::<u64>, typed::<usize>, typed::<u32>];
    let mut types = numbers.into_iter().chain([typed::<Steps>, typed::<Restitution>, typed::<Object>]);
    Ok(types.find_map(|typed| typed(&read, id)).unwrap_or(text.into()))
}

/// Gathers the options on a command line.
pub fn by_user(command: &Command, matches: &ArgMatches) -> anyhow::Result<Given> {
    let args = command.get_arguments().filter_map(|arg| {
        let id = arg.get_id().as_str();
        let is_given = matches.value_source(id) == Some(ValueSource::CommandLine);
        let texts = matches.get_raw(id).filter(|_| is_given)?.map(|text| text.to_str().map(Value::from));
        Some((arg, texts.collect::<Option<Value>>()))
    });
    let options = args.map(|(arg, texts)| {
        let refused = || UsageError::because(format!("--{}: expected UTF-8", name_of(arg)));
        Ok((name_of(arg).to_string(), texts.ok_or_else(refused)?))
    });
    let options: Vec<(String, Value)> = options.collect::<anyhow::Result<_>>()?;
    in_one_form(command, options, &Base::default()).map_err(|error| UsageError::because(format!("--{error}")))
}

/// Returns the defaults of a stage, whose files are in a folder.
pub fn defaults(command: &Command, folder: &Path) -> Given {
    let base = Base { folder: folder.to_path_buf(), out: None };
    let default = |arg: &Arg| {
        let text = arg.get_default_values().first().and_then(|text| text.to_str());
        let none = match arg.get_action() {
            ArgAction::SetTrue => Some(Value::Bool(false)),
            ArgAction::Append => Some(json!([])),
            _ => None,
        };
        let default = text.and_then(|text| form(arg, &text.into(), &base).ok());
        Some((name_of(arg).to_string(), default.or(none)?))
    };
    command.get_arguments().filter_map(default).collect()
}
