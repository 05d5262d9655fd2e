//! Pipeline files: sections of options, the folder of outputs and the seed.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::Command;
use rockfrag_core::spelling::hint;
use saphyr::{ScalarStyle, Yaml, YamlLoader};
use saphyr_parser::Parser;
use serde_json::{Map, Value};

use crate::pipeline::UsageError;
use crate::pipeline::given::{Base, in_one_form, name_of};
use crate::pipeline::options::Given;
use crate::source;
use crate::stages::StageKind;
use crate::table::provenance::text_of;

#[derive(Debug, Clone, PartialEq)]
pub struct PipelineFile {
    pub path: PathBuf,
    pub seed: Option<String>,
    /// The folder of outputs, as it is written.
    pub out: PathBuf,
    sections: BTreeMap<String, Map<String, Value>>,
}

impl PipelineFile {
    /// Reads a pipeline file, whose sections must be of these stages.
    pub fn read(path: &Path, stages: &[StageKind]) -> anyhow::Result<PipelineFile> {
        PipelineFile::parse(path, stages)
            .map_err(|problem| UsageError::because(format!("{}: {problem}", path.display())))
    }

    fn parse(path: &Path, stages: &[StageKind]) -> Result<PipelineFile, String> {
        let text = source::read(path).map(String::from_utf8).map_err(|error| error.to_string())?;
        let parsed = match texts(&text.map_err(|_| "not text in UTF-8".to_string())?)? {
            Value::Object(parsed) => parsed,
            Value::Null => Map::new(),
            other => return Err(format!("{other}; expected sections of options")),
        };
        let mut file =
            PipelineFile { path: path.into(), seed: None, out: "out".into(), sections: BTreeMap::new() };
        let names: Vec<&str> = stages.iter().map(StageKind::name).chain(["seed", "out"]).collect();
        for (key, value) in parsed {
            match (key.as_str(), value) {
                ("out" | "seed", Value::Null) => {}
                ("out", value) => file.out = text_of(&value).into(),
                ("seed", value) => file.seed = Some(text_of(&value)),
                (name, _) if !names.contains(&name) => {
                    return Err(format!("unknown section '{key}'{}", hint(&key, &names)));
                }
                (_, Value::Object(section)) => drop(file.sections.insert(key, section)),
                (_, Value::Null) => drop(file.sections.insert(key, Map::new())),
                (_, value) => return Err(format!("{key} is {value}; expected a section of options")),
            }
        }
        Ok(file)
    }

    pub fn has(&self, stage: &str) -> bool {
        self.sections.contains_key(stage)
    }

    pub fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new(""))
    }

    /// Returns the options of a stage but those of the user; a run has its outputs in the folder `out`.
    pub fn section(&self, command: &Command, user: &Given, out: Option<&Path>) -> anyhow::Result<Given> {
        let mut section = self.sections.get(command.get_name()).cloned().unwrap_or_default();
        section.retain(|option, _| !user.contains_key(option));
        if let Some(seed) = &self.seed
            && command.get_arguments().any(|arg| name_of(arg) == "seed" && !user.contains_key("seed"))
        {
            section.entry("seed").or_insert(seed.as_str().into());
        }
        let out = out.map(|out| (self.out.clone(), out.to_path_buf()));
        let (stage, base) = (command.get_name(), Base { folder: self.folder().to_path_buf(), out });
        in_one_form(command, section, &base)
            .map_err(|error| UsageError::because(format!("{}: {stage}: {error}", self.path.display())))
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
        [] => Ok(Value::Null),
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
