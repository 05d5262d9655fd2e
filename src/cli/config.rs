//! Pipeline files: a section, or a call from Python, becomes arguments of the command line.

use std::collections::BTreeMap;
use std::ffi::{OsStr, OsString};
use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Command};
use serde_json::{Map, Value};

use super::yaml;
use crate::keyword::hint;
use crate::pipeline::paths::{PathKind, Role, listed, path_kind};
use crate::pipeline::{InRun, UsageError};
use crate::stages::Stages;
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
        let failed = |problem: String| UsageError::because(format!("{}: {problem}", path.display()));
        let text = std::fs::read_to_string(path).map_err(|error| failed(error.to_string()))?;
        let parsed = match yaml::parse(&text).map_err(failed)? {
            Value::Object(parsed) => parsed,
            Value::Null => Map::new(),
            other => return Err(failed(format!("{other}; expected sections of options"))),
        };
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        let mut config = Config { out: folder.join("out"), seed: None, sections: BTreeMap::new(), folder };
        for (key, value) in parsed {
            match (key.as_str(), value) {
                ("out" | "seed", Value::Null) => {}
                ("out", value) => config.out = config.folder.join(text_of(&value)),
                ("seed", value) => config.seed = Some(text_of(&value)),
                (_, Value::Object(section)) => drop(config.sections.insert(key, section)),
                (_, Value::Null) => drop(config.sections.insert(key, Map::new())),
                (_, value) => return Err(failed(format!("{key} is {value}; expected a section of options"))),
            }
        }
        let names: Vec<&str> = commands.iter().map(Command::get_name).chain(["seed", "out"]).collect();
        match config.sections.keys().find(|section| !names.contains(&section.as_str())) {
            Some(section) => Err(failed(format!("unknown section '{section}'{}", hint(section, &names)))),
            None => Ok(config),
        }
    }

    pub fn has(&self, command: &str) -> bool {
        self.sections.contains_key(command)
    }

    /// Returns the arguments of a section, except those that `user` names or excludes.
    pub fn section(&self, command: &Command, user: &[OsString]) -> anyhow::Result<Vec<OsString>> {
        let mut section = self.sections.get(command.get_name()).cloned().unwrap_or_default();
        let of_flag = |flag: &str| command.get_arguments().find(|arg| arg.get_long() == Some(flag));
        if let Some(seed) = self.seed.clone().filter(|_| of_flag("seed").is_some()) {
            section.entry("seed".to_string()).or_insert(Value::String(seed));
        }
        let matches = lenient(command, user);
        let source = |id: &str| matches.as_ref().and_then(|matches| matches.value_source(id));
        let is_named = |arg: &&Arg| source(arg.get_id().as_str()) == Some(ValueSource::CommandLine);
        section.retain(|flag, _| {
            let Some(arg) = of_flag(flag) else { return true };
            !command.get_arg_conflicts_with(arg).iter().chain([&arg]).any(is_named)
        });
        arguments(command, section, &self.folder)
    }

    /// Returns the arguments of a section in a run; default files are in `folder`.
    pub fn section_of_run(&self, command: &Command, folder: &Path) -> anyhow::Result<Vec<OsString>> {
        let mut arguments = self.section(command, &[])?;
        let section = &self.sections[command.get_name()];
        let run = InRun { stages: &|stage| self.has(stage), given: &|flag| section.contains_key(flag) };
        let stated = Stages::in_run(command.get_name(), &run);
        for arg in command.get_arguments().filter(|arg| path_kind(arg).is_some()) {
            let Some(flag) = arg.get_long().filter(|flag| !section.contains_key(*flag)) else { continue };
            let default = arg.get_default_values().first().and_then(|default| default.to_str());
            let is_word = |file: &&str| path_kind(arg).is_some_and(|kind| kind.words.contains(file));
            let stated = stated.iter().find(|(of, _)| *of == flag).map(|(_, file)| *file);
            if let Some(file) = stated.or(default.filter(|file| !is_word(file))) {
                arguments.push(assigned(flag, folder.join(file).as_os_str()));
            }
        }
        Ok(arguments)
    }
}

/// Converts options to arguments. Paths are relative to `folder`.
pub fn arguments(
    command: &Command,
    options: impl IntoIterator<Item = (String, Value)>,
    folder: &Path,
) -> anyhow::Result<Vec<OsString>> {
    let mut arguments = Vec::new();
    for (flag, value) in options.into_iter().filter(|(_, value)| !value.is_null()) {
        let Some(arg) = command
            .get_arguments()
            .find(|arg| arg.get_id() == flag.as_str() || arg.get_long() == Some(&flag))
        else {
            let known: Vec<&str> = command.get_arguments().filter_map(|arg| arg.get_long()).collect();
            let (name, hint) = (command.get_name(), hint(&flag, &known));
            return Err(UsageError::because(format!("{name}: unknown option '{flag}'{hint}")));
        };
        let values: Vec<OsString> = match (&value, path_kind(arg)) {
            (Value::Bool(false), _) => continue,
            (value, _) if matches!(arg.get_action(), ArgAction::SetTrue) => {
                match text_of(value).to_lowercase().as_str() {
                    "true" | "yes" | "on" => arguments.push(format!("--{flag}").into()),
                    "false" | "no" | "off" => {}
                    other => {
                        return Err(UsageError::because(format!(
                            "{flag} is {other}; expected true or false"
                        )));
                    }
                }
                continue;
            }
            (Value::Array(items), kind) if matches!(arg.get_action(), ArgAction::Append) => {
                let items = items.iter().map(structure_or_text);
                items
                    .map(|item| kind.map_or(item.clone().into(), |kind| path_in(folder, kind, &item)))
                    .collect()
            }
            (value, Some(kind)) if kind.role == Role::List => {
                let paths = listed(folder, &text_of(value)).into_iter();
                paths.map(|path| path_in(folder, kind, &path)).collect()
            }
            (value, Some(kind)) => vec![path_in(folder, kind, &text_of(value))],
            (value, None) => vec![structure_or_text(value).into()],
        };
        match arg.get_long() {
            Some(long) => arguments.extend(values.iter().map(|value| assigned(long, value))),
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

/// Parses the arguments of a stage without errors, which later parsing reports.
pub fn lenient(command: &Command, user: &[OsString]) -> Option<ArgMatches> {
    let words = [&[OsString::from(command.get_name())], user].concat();
    command.clone().ignore_errors(true).try_get_matches_from(words).ok()
}
