//! Pipeline files: a section, or a call from Python, becomes arguments of the command line.

use std::collections::BTreeMap;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Command};
use rockfrag_core::spelling::hint;
use serde_json::{Map, Value};

use super::yaml;
use crate::pipeline::UsageError;
use crate::pipeline::paths::{PathKind, path_kind, split_list};
use crate::source;
use crate::stages::run;
use crate::table::provenance::text_of;

#[derive(Debug, Clone, PartialEq)]
pub struct Config {
    /// Folder of relative paths.
    folder: PathBuf,
    /// Folder of all outputs.
    pub out: PathBuf,
    pub seed: Option<String>,
    sections: BTreeMap<String, Map<String, Value>>,
}

impl Config {
    /// Reads a pipeline file, whose sections must be among these commands.
    pub fn read(path: &Path, commands: &[Command]) -> anyhow::Result<Config> {
        Config::parse(path, commands)
            .map_err(|problem| UsageError::because(format!("{}: {problem}", path.display())))
    }

    fn parse(path: &Path, commands: &[Command]) -> Result<Config, String> {
        let text = source::read(path).map(String::from_utf8).map_err(|error| error.to_string())?;
        let parsed = match yaml::parse(&text.map_err(|_| "not text in UTF-8".to_string())?)? {
            Value::Object(parsed) => parsed,
            Value::Null => Map::new(),
            other => return Err(format!("{other}; expected sections of options")),
        };
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        let mut config = Config { out: folder.join("out"), seed: None, sections: BTreeMap::new(), folder };
        let names: Vec<&str> = commands.iter().map(Command::get_name).chain(["seed", "out"]).collect();
        for (key, value) in parsed {
            match (key.as_str(), value) {
                ("out" | "seed", Value::Null) => {}
                ("out", value) => config.out = config.folder.join(text_of(&value)),
                ("seed", value) => config.seed = Some(text_of(&value)),
                (section, Value::Object(_) | Value::Null) if !names.contains(&section) => {
                    return Err(format!("unknown section '{key}'{}", hint(&key, &names)));
                }
                (_, Value::Object(section)) => drop(config.sections.insert(key, section)),
                (_, Value::Null) => drop(config.sections.insert(key, Map::new())),
                (_, value) => return Err(format!("{key} is {value}; expected a section of options")),
            }
        }
        Ok(config)
    }

    pub fn has(&self, command: &str) -> bool {
        self.sections.contains_key(command)
    }

    /// Returns the arguments of a section, except those that the user's own name or exclude.
    pub fn section(&self, command: &Command, user: Option<&ArgMatches>) -> anyhow::Result<Vec<OsString>> {
        let mut section = self.sections.get(command.get_name()).cloned().unwrap_or_default();
        if let Some(seed) = self.seed.clone().filter(|_| argument(command, "seed").is_some()) {
            section.entry("seed".to_string()).or_insert(Value::String(seed));
        }
        section.retain(|flag, _| {
            let (Some(arg), Some(user)) = (argument(command, flag), user) else { return true };
            let mut others = command.get_arg_conflicts_with(arg).into_iter().chain([arg]);
            !others.any(|arg| user.value_source(arg.get_id().as_str()) == Some(ValueSource::CommandLine))
        });
        arguments(command, section, &self.folder)
    }

    /// Returns the arguments of a section in a run; default files are in `folder`.
    pub fn section_of_run(&self, command: &Command, folder: &Path) -> anyhow::Result<Vec<OsString>> {
        let mut arguments = self.section(command, None)?;
        let section = &self.sections[command.get_name()];
        let stated = run::files(command.get_name(), &self.sections);
        for arg in command.get_arguments() {
            let (Some(kind), Some(flag)) = (path_kind(arg), arg.get_long()) else { continue };
            let default = arg.get_default_values().first().and_then(|default| default.to_str());
            let stated = stated.iter().find(|(of, _)| *of == flag).map(|(_, file)| *file);
            let file = stated.or(default.filter(|file| !kind.words.contains(file)));
            if let Some(file) = file.filter(|_| !section.contains_key(flag)) {
                arguments.push(assigned(flag, folder.join(file).as_os_str()));
            }
        }
        Ok(arguments)
    }
}

fn argument<'a>(command: &'a Command, name: &str) -> Option<&'a Arg> {
    command.get_arguments().find(|arg| arg.get_id() == name || arg.get_long() == Some(name))
}

/// Converts options to arguments. Paths are relative to `folder`.
pub fn arguments(
    command: &Command,
    options: impl IntoIterator<Item = (String, Value)>,
    folder: &Path,
) -> anyhow::Result<Vec<OsString>> {
    let mut arguments = Vec::new();
    for (flag, value) in options.into_iter().filter(|(_, value)| !value.is_null()) {
        let Some(arg) = argument(command, &flag) else {
            let known: Vec<&str> = command.get_arguments().filter_map(|arg| arg.get_long()).collect();
            let (name, hint) = (command.get_name(), hint(&flag, &known));
            return Err(UsageError::because(format!("{name}: unknown option '{flag}'{hint}")));
        };
        if matches!(arg.get_action(), ArgAction::SetTrue) {
            match text_of(&value).to_lowercase().as_str() {
                "true" | "yes" | "on" => arguments.push(format!("--{flag}").into()),
                "false" | "no" | "off" => {}
                other => {
                    let problem = format!("{flag} is {other}; expected true or false");
                    return Err(UsageError::because(problem));
                }
            }
            continue;
        }
        let (kind, is_list) = (path_kind(arg), matches!(arg.get_action(), ArgAction::Append));
        let texts = match value {
            Value::Bool(false) => continue,
            Value::Array(items) if is_list => items.iter().map(structure_or_text).collect(),
            value if is_list && kind.is_some() => split_list(folder, &text_of(&value)),
            value => vec![structure_or_text(&value)],
        };
        let values = texts.into_iter().map(|text| match kind {
            Some(kind) => path_in(folder, kind, &text),
            None => text.into(),
        });
        match arg.get_long() {
            Some(long) => arguments.extend(values.map(|value| assigned(long, &value))),
            None => arguments.extend(values),
        }
    }
    Ok(arguments)
}

/// Returns a path relative to a folder, as an argument that is no option; words stay.
fn path_in(folder: &Path, kind: PathKind, text: &str) -> OsString {
    match folder.join(text) {
        _ if kind.words.contains(&text) || text == "-" => text.into(),
        path if path.to_string_lossy().starts_with('-') => Path::new(".").join(path).into(),
        path => path.into(),
    }
}

/// Returns the text of a value; a mapping stays JSON, in which a name may have a comma.
fn structure_or_text(value: &Value) -> String {
    if value.is_object() { value.to_string() } else { text_of(value) }
}

/// Returns `--flag=value`; the value may begin with a minus sign.
pub fn assigned(flag: &str, value: &OsStr) -> OsString {
    let mut argument = OsString::from(format!("--{flag}="));
    argument.push(value);
    argument
}
