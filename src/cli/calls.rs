//! Calls of stages, of what is given to them.

use std::collections::HashMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::value_parser;
use serde_json::Value;

use super::command;
use super::pipeline_file::PipelineFile;
use crate::pipeline::UsageError;
use crate::pipeline::cache::is_view;
use crate::pipeline::call::Call;
use crate::pipeline::given::{by_user, defaults, name_of};
use crate::pipeline::options::{Given, Rule, first_of, merge};
use crate::source::split_sheet;
use crate::stages::{self, StageKind};
use crate::table::keys::resolved;

/// Makes the call of a stage from a command line, program name first.
pub fn of_line(stage: &StageKind, line: &[OsString]) -> anyhow::Result<Call> {
    // As part of the whole command line, which usage lines name. A pipeline file may have what is required.
    let whole = command().mut_subcommand(stage.name(), |stage| {
        stage.mut_args(|arg| arg.required(false).value_parser(value_parser!(OsString)))
    });
    let line = [OsString::from("rockfrag")].into_iter().chain(line.iter().skip(1).cloned());
    let matches = whole.try_get_matches_from(line)?;
    let matches = matches.subcommand_matches(stage.name()).cloned().unwrap_or_default();
    of_stage(stage, by_user(&stage.command, &matches)?)
}

/// Makes the call of a stage from the options of the user, and those of its section where `config` names a file.
pub fn of_stage(stage: &StageKind, user: Given) -> anyhow::Result<Call> {
    let file = match user.get("config").and_then(Value::as_str) {
        Some(path) => Some(PipelineFile::read(Path::new(path), &stages::all())?),
        None => None,
    };
    let section = file.as_ref().map_or(Ok(Given::new()), |file| file.section(&stage.command, &user, None))?;
    Options { stage, file: file.as_ref(), section, user }.call(Path::new(""))
}

/// Makes the calls of a pipeline file, in the order of a run.
pub fn of_run(pipeline: &Path, out: Option<PathBuf>, seed: Option<u64>) -> anyhow::Result<Vec<Call>> {
    let stages = stages::all();
    let mut file = PipelineFile::read(pipeline, &stages)?;
    file.seed = seed.map(|seed| seed.to_string()).or(file.seed);
    let out = out.unwrap_or_else(|| file.folder().join(&file.out));
    let (mut calls, mut written): (Vec<Call>, HashMap<PathBuf, &str>) = (Vec::new(), HashMap::new());
    for stage in stages.iter().filter(|stage| file.has(stage.name())) {
        let name = stage.name();
        let section = file.section(&stage.command, &Given::new(), Some(&out))?;
        if let Some(line) = missing_line(name, &file, &section) {
            return Err(refuse(pipeline, &format!("{name}: {line}")));
        }
        let call = Options { stage, file: Some(&file), section, user: Given::new() }.call(&out)?;
        for path in call.stage.outputs() {
            if let Some(first) = written.insert(resolved(&path), name) {
                return Err(refuse(pipeline, &format!("{first} and {name} both write {}", path.display())));
            }
        }
        if let Some(problem) = other_fits(&call, &calls) {
            return Err(refuse(pipeline, &format!("{name}: {problem}")));
        }
        calls.push(call);
    }
    for call in &calls {
        let read = call.stage.inputs().into_iter().flat_map(|read| read.paths);
        for path in read.map(|path| split_sheet(&path).0).filter(|path| is_view(path)) {
            if let Some(writer) = written.get(&resolved(&path)) {
                let problem = format!("{writer} writes {}, which {} reads", path.display(), call.name);
                return Err(refuse(pipeline, &problem));
            }
        }
    }
    match calls.is_empty() {
        true => Err(refuse(pipeline, "no stage; expected at least one")),
        false => Ok(calls),
    }
}

fn refuse(pipeline: &Path, problem: &str) -> anyhow::Error {
    UsageError::because(format!("{}: {problem}", pipeline.display()))
}

/// Says which line a section needs where another stage makes what it may read, or it would only print.
fn missing_line(stage: &str, file: &PipelineFile, section: &Given) -> Option<String> {
    let (lacks, out) = (|option: &str| !section.contains_key(option), file.out.display());
    match stage {
        "evaluate" | "export" | "validate" if file.has("fit-pro") && lacks("fits") && lacks("model") => {
            Some(format!(
                "add 'fits: {out}' to use the fits of this run, or 'model: calibrated' for the universal surface"
            ))
        }
        "simulate" | "ida" if file.has("floor-motions") && lacks("in") => Some(format!(
            "add 'in: {out}/floor.parquet' for the motions of the floor, or 'in: {out}/motions.parquet'"
        )),
        "evaluate" if lacks("out") => {
            Some(format!("add 'out: {out}/evaluated.parquet'; without a file it only prints"))
        }
        _ => None,
    }
}

/// Says that a stage reads other fits than those of the run.
fn other_fits(call: &Call, before: &[Call]) -> Option<String> {
    let inputs = call.stage.inputs();
    let read = inputs.iter().find(|read| read.flag == "fits")?.paths.first()?.parent()?;
    let made = before.iter().find(|call| call.name == "fit-pro")?.stage.outputs();
    let folder = made.last()?.parent()?;
    let (read_from, made_in) = (read.display(), folder.display());
    (resolved(read) != resolved(folder))
        .then(|| format!("fits is {read_from}; expected {made_in}, where fit-pro of this run writes"))
}

/// What is given to a stage, by whom.
struct Options<'a> {
    stage: &'a StageKind,
    file: Option<&'a PipelineFile>,
    section: Given,
    user: Given,
}

impl Options<'_> {
    /// Merges defaults, the file and the user, and makes the call. Default files are in `folder`.
    fn call(&self, folder: &Path) -> anyhow::Result<Call> {
        let StageKind { command, rules, .. } = self.stage;
        let given = merge(&self.section, &self.user, rules);
        for rule in rules {
            match rule {
                Rule::Either(these, those) => {
                    if let Some((one, other)) = first_of(these, &given).zip(first_of(those, &given)) {
                        return Err(self.refuse(&[one, other], ": expected one of them"));
                    }
                }
                Rule::Needs(these, those) => {
                    if let (Some(option), None) = (first_of(these, &given), first_of(those, &given)) {
                        let needed: Vec<String> =
                            those.iter().map(|needed| self.word(&[option], needed)).collect();
                        return Err(self.refuse(&[option], &format!(" needs {}", needed.join(" or "))));
                    }
                }
            }
        }
        let mut required = command.get_arguments().filter(|arg| arg.is_required_set()).map(name_of);
        if let Some(option) = required.find(|option| !given.contains_key(*option)) {
            return Err(self.refuse(&[option], " is missing"));
        }
        let mut all = defaults(command, folder);
        all.extend(given);
        let made = self.stage.make(all.clone());
        let (stage, options) = made.map_err(|error| self.refuse(&[], &error.to_string()))?;
        let common = serde_json::from_value(Value::Object(all))?;
        let inputs = stage.inputs();
        let piped = inputs.iter().filter(|read| read.paths.contains(&PathBuf::from("-")));
        let piped: Vec<&str> = piped.map(|read| read.flag).collect();
        if piped.len() > 1 {
            return Err(self.refuse(&piped, ": expected one of them from stdin"));
        }
        let (outputs, endings) = (stage.outputs(), stage.endings());
        let is_other = |out: &&PathBuf| match out.extension() {
            Some(ending) => !endings.iter().any(|known| ending == *known),
            None => endings.len() > 1,
        };
        if let Some(out) = outputs.last().filter(is_other) {
            let expected = format!("expected a name that ends in .{}", endings.join(", ."));
            return Err(self.refuse(&["out"], &format!(" is {}; {expected}", out.display())));
        }
        stage.check()?;
        Ok(Call { name: self.stage.name().to_string(), stage, common, options })
    }

    /// Names an option as who gave the first of these does.
    fn word(&self, given: &[&str], option: &str) -> String {
        let is_of_file = self.file.is_some() && !given.iter().any(|option| self.user.contains_key(*option));
        let mut positional = self.stage.command.get_positionals();
        match is_of_file || positional.any(|arg| name_of(arg) == option) {
            true => option.to_string(),
            false => format!("--{option}"),
        }
    }

    fn refuse(&self, options: &[&str], problem: &str) -> anyhow::Error {
        let words: Vec<String> = options.iter().map(|option| self.word(options, option)).collect();
        let text = format!("{}{problem}", words.join(" and "));
        let is_of_user = options.iter().any(|option| self.user.contains_key(*option));
        match self.file.filter(|_| !is_of_user) {
            Some(file) => refuse(&file.path, &format!("{}: {text}", self.stage.name())),
            None => UsageError::because(text),
        }
    }
}
