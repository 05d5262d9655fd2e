//! Calls of stages, of the options of a user and of pipeline files: sections of options, the folder of
//! outputs and the seed.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use clap::Command;
use rockfrag_core::spelling::hint;
use saphyr::{ScalarStyle, Yaml, YamlLoader};
use saphyr_parser::Parser;
use serde_json::Value;

use crate::pipeline::UsageError;
use crate::pipeline::call::{Call, is_view};
use crate::pipeline::options::{Given, in_one_form};
use crate::source::{self, split_sheet};
use crate::stages::{self, StageKind};
use crate::table::keys::resolved;
use crate::table::provenance::text_of;

/// Makes the call of a stage from the options of the user, and its section in the file that `config` names.
pub fn of_stage(stage: &StageKind, user: Given) -> anyhow::Result<Call> {
    let user = in_one_form(&stage.command, user, &|path| path.into())?;
    let section = match user.get("config").and_then(Value::as_str) {
        Some(path) => PipelineFile::read(Path::new(path))?.section(&stage.command, None)?,
        None => Given::new(),
    };
    stage.call(&section, &user, Path::new(""))
}

/// Makes the calls of a pipeline file, in the order of a run.
pub fn of_run(pipeline: &Path, out: Option<PathBuf>, seed: Option<u64>) -> anyhow::Result<Vec<Call>> {
    let mut file = PipelineFile::read(pipeline)?;
    file.seed = seed.map(|seed| seed.to_string()).or(file.seed);
    let out = out.unwrap_or_else(|| file.path.with_file_name(&file.out));
    let refuse = |problem: String| Err(UsageError::because(format!("{}: {problem}", pipeline.display())));
    let (mut calls, mut written): (Vec<Call>, HashMap<PathBuf, String>) = Default::default();
    for stage in stages::all().iter().filter(|stage| file.sections.contains_key(stage.name())) {
        let (name, section) = (stage.name(), file.section(&stage.command, Some(&out))?);
        if let Some(line) = missing_line(name, &file, &section) {
            return refuse(format!("{name}: {line}"));
        }
        let call = stage.call(&section, &Given::new(), &out);
        let call = call.with_context(|| format!("{}: {name}", pipeline.display()))?;
        for path in call.stage.files().written {
            if let Some(first) = written.insert(resolved(&path), name.to_string()) {
                return refuse(format!("{first} and {name} both write {}", path.display()));
            }
        }
        calls.push(call);
    }
    for call in &calls {
        let read = call.stage.files().read.into_iter().flat_map(|read| read.paths);
        for path in read.map(|path| split_sheet(&path).0).filter(|path| is_view(path)) {
            if let Some(writer) = written.get(&resolved(&path)) {
                return refuse(format!("{writer} writes {}, which {} reads", path.display(), call.name));
            }
        }
    }
    if calls.is_empty() { refuse("no stage; expected at least one".to_string()) } else { Ok(calls) }
}

/// Says which line a section needs where another stage makes what it may read.
fn missing_line(stage: &str, file: &PipelineFile, section: &Given) -> Option<String> {
    let makes = |stage: &str| file.sections.contains_key(stage);
    let (lacks, out) = (|option: &str| !section.contains_key(option), file.out.display());
    match stage {
        "evaluate" | "export" | "validate" if makes("fit-pro") && lacks("fits") && lacks("model") => {
            Some(format!("add 'fits: {out}' to use the fits of this run, or 'model: calibrated'"))
        }
        "simulate" | "ida" if makes("floor-motions") && lacks("in") => Some(format!(
            "add 'in: {out}/floor.parquet' for the motions of the floor, or 'in: {out}/motions.parquet'"
        )),
        _ => None,
    }
}

struct PipelineFile {
    path: PathBuf,
    seed: Option<String>,
    /// The folder of outputs, as it is written.
    out: PathBuf,
    sections: Given,
}

impl PipelineFile {
    fn read(path: &Path) -> anyhow::Result<PipelineFile> {
        let place = || path.display().to_string();
        let missing = || UsageError::Mistake(format!("{} (`rockfrag init` writes one)", place()));
        let bytes = source::read(path).with_context(missing)?;
        PipelineFile::parse(path, bytes).map_err(UsageError::Mistake).with_context(place)
    }

    fn parse(path: &Path, text: Vec<u8>) -> Result<PipelineFile, String> {
        let text = String::from_utf8(text).map_err(|_| "not text in UTF-8")?;
        let mut sections = match texts(&text)? {
            Value::Object(sections) => sections,
            other => return Err(format!("{other}; expected sections of options")),
        };
        let mut text_at = |key| sections.remove(key).filter(|value| !value.is_null()).as_ref().map(text_of);
        let (seed, out) = (text_at("seed"), text_at("out").unwrap_or("out".to_string()).into());
        let stages = stages::all();
        let names: Vec<&str> = stages.iter().map(StageKind::name).chain(["seed", "out"]).collect();
        for (key, value) in &sections {
            match value {
                _ if !names.contains(&&**key) => {
                    return Err(format!("unknown section '{key}'{}", hint(key, &names)));
                }
                Value::Object(_) | Value::Null => {}
                _ => return Err(format!("{key} is {value}; expected a section of options")),
            }
        }
        Ok(PipelineFile { path: path.into(), seed, out, sections })
    }

    /// Returns the options of a stage; a run has its outputs in the folder `out`.
    fn section(&self, command: &Command, out: Option<&Path>) -> anyhow::Result<Given> {
        let (stage, path) = (command.get_name(), self.path.display());
        let mut section = self.sections.get(stage).and_then(Value::as_object).cloned().unwrap_or_default();
        if let Some(seed) = &self.seed
            && command.get_arguments().any(|arg| arg.get_id() == "seed")
        {
            section.entry("seed").or_insert(seed.as_str().into());
        }
        let located = |path: &str| match out.zip(Path::new(path).strip_prefix(&self.out).ok()) {
            Some((out, rest)) => out.iter().chain(rest).collect(),
            None => self.path.with_file_name(path),
        };
        in_one_form(command, section, &located).with_context(|| format!("{path}: {stage}"))
    }
}

/// Reads YAML as JSON of texts, as they are written: a name may be `007`. What is left empty is null.
fn texts(yaml: &str) -> Result<Value, String> {
    let mut loader = YamlLoader::<Yaml>::default();
    loader.early_parse(false);
    Parser::new_from_str(yaml).load(&mut loader, true).map_err(|error| error.to_string())?;
    if let Some(error) = loader.error() {
        return Err(error.to_string());
    }
    match &loader.into_documents()[..] {
        [document] => in_text(document),
        documents => Err(format!("{} documents; expected one", documents.len())),
    }
}

fn in_text(yaml: &Yaml) -> Result<Value, String> {
    match yaml {
        Yaml::Representation(text, ScalarStyle::Plain, _) if ["", "~", "null"].contains(&&**text) => {
            Ok(Value::Null)
        }
        Yaml::Representation(text, ..) => Ok(text.as_ref().into()),
        Yaml::Sequence(items) => items.iter().map(in_text).collect(),
        Yaml::Mapping(pairs) => {
            let pair = |(key, value): (&Yaml, &Yaml)| Ok((text_of(&in_text(key)?), in_text(value)?));
            Ok(Value::Object(pairs.iter().map(pair).collect::<Result<_, String>>()?))
        }
        _ => Err("a tag; expected texts, lists and mappings".to_string()),
    }
}
