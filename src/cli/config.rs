//! Pipeline files: a section, or a call from Python, becomes arguments of the command line.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, Command};
use serde_json::{Map, Value};

use crate::keyword::hint;
use crate::pipeline::UsageError;
use crate::pipeline::files::{assigned, in_run, role};

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
        let parsed: Option<BTreeMap<String, Value>> = serde_saphyr::from_str(&text).map_err(|error| {
            failed(error.without_snippet().to_string().lines().next().unwrap_or_default().to_string())
        })?;
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        let mut config = Config { out: folder.join("out"), seed: None, sections: BTreeMap::new(), folder };
        for (key, value) in parsed.unwrap_or_default() {
            match (key.as_str(), value) {
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
        for arg in command.get_arguments() {
            let Some(flag) = arg.get_long().filter(|flag| !section.contains_key(*flag)) else { continue };
            if let Some(file) = in_run(command.get_name(), arg, |stage| self.has(stage)) {
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
    for (flag, value) in options {
        let Some(arg) = command
            .get_arguments()
            .find(|arg| arg.get_id() == flag.as_str() || arg.get_long() == Some(&flag))
        else {
            let known: Vec<&str> = command.get_arguments().filter_map(|arg| arg.get_long()).collect();
            let (name, hint) = (command.get_name(), hint(&flag, &known));
            return Err(UsageError::because(format!("{name}: unknown option '{flag}'{hint}")));
        };
        let text = |value: &Value| -> OsString {
            let text = text_of(value);
            let path = folder.join(&text);
            // An input may be a word, such as a site name, in place of a file.
            if role(arg).is_read()
                && (path.exists() || !folder.as_os_str().is_empty() && text.contains(['/', '.']))
            {
                path.into()
            } else {
                text.into()
            }
        };
        let values: Vec<OsString> = match &value {
            Value::Null | Value::Bool(false) => continue,
            Value::Bool(true) => {
                arguments.push(format!("--{flag}").into());
                continue;
            }
            Value::Array(items) if matches!(arg.get_action(), ArgAction::Append) => {
                items.iter().map(text).collect()
            }
            Value::Array(items) => vec![items.iter().map(text_of).collect::<Vec<_>>().join(",").into()],
            value => vec![text(value)],
        };
        match arg.get_long() {
            Some(long) => arguments.extend(values.iter().map(|value| assigned(long, value))),
            None => arguments.extend(values),
        }
    }
    Ok(arguments)
}

/// Converts a value to command-line text; a mapping becomes `name=frame,p=1`.
fn text_of(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Object(pairs) => {
            let pair = |(key, value): (&String, &Value)| format!("{key}={}", text_of(value));
            pairs.iter().map(pair).collect::<Vec<_>>().join(",")
        }
        other => other.to_string(),
    }
}

/// Parses the arguments of a stage without errors, which later parsing reports.
pub fn lenient(command: &Command, user: &[OsString]) -> Option<ArgMatches> {
    let words = [&[OsString::from(command.get_name())], user].concat();
    command.clone().ignore_errors(true).try_get_matches_from(words).ok()
}
