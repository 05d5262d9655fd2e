//! Pipeline files: sections of options, the folder of outputs and the seed.

use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};

use clap::Command;
use rockfrag_core::spelling::hint;
use serde::de::{Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use serde_json::{Map, Value};
use serde_saphyr::{Spanned, UserMessageFormatter};

use crate::pipeline::UsageError;
use crate::pipeline::given::{Base, in_one_form, name_of};
use crate::pipeline::options::Given;
use crate::source;
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
    /// Reads a pipeline file, whose sections must be among these commands.
    pub fn read(path: &Path, commands: &[Command]) -> anyhow::Result<PipelineFile> {
        PipelineFile::parse(path, commands)
            .map_err(|problem| UsageError::because(format!("{}: {problem}", path.display())))
    }

    fn parse(path: &Path, commands: &[Command]) -> Result<PipelineFile, String> {
        let text = source::read(path).map(String::from_utf8).map_err(|error| error.to_string())?;
        let parsed = match texts(&text.map_err(|_| "not text in UTF-8".to_string())?)? {
            Value::Object(parsed) => parsed,
            Value::Null => Map::new(),
            other => return Err(format!("{other}; expected sections of options")),
        };
        let mut file =
            PipelineFile { path: path.into(), seed: None, out: "out".into(), sections: BTreeMap::new() };
        let names: Vec<&str> = commands.iter().map(Command::get_name).chain(["seed", "out"]).collect();
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
    let read = serde_saphyr::from_str::<Option<Spanned<Node>>>(yaml).map_err(|error| {
        let told = error.without_snippet().render_with_formatter(&UserMessageFormatter);
        told.lines().next().unwrap_or_default().to_string()
    });
    Ok(read?.map_or(Value::Null, |node| in_text(&node, yaml)))
}

fn in_text(node: &Spanned<Node>, yaml: &str) -> Value {
    match &node.value {
        Node::Null => Value::Null,
        Node::Text(text) => text.as_str().into(),
        Node::Plain => {
            // Of an alias, where its value stands.
            let span = node.defined.span();
            let start = span.byte_offset().unwrap_or_default() as usize;
            yaml.get(start..start + span.byte_len().unwrap_or_default() as usize)
                .unwrap_or_default()
                .trim()
                .into()
        }
        Node::List(items) => items.iter().map(|item| in_text(item, yaml)).collect(),
        Node::Mapping(pairs) => {
            pairs.iter().map(|(key, value)| (key.clone(), in_text(value, yaml))).collect::<Map<_, _>>().into()
        }
    }
}

enum Node {
    Null,
    Text(String),
    /// A number or truth value, whose text its place in the file tells.
    Plain,
    List(Vec<Spanned<Node>>),
    Mapping(Vec<(String, Spanned<Node>)>),
}

impl<'de> Deserialize<'de> for Node {
    fn deserialize<D: Deserializer<'de>>(yaml: D) -> Result<Node, D::Error> {
        yaml.deserialize_any(Nodes)
    }
}

struct Nodes;

impl<'de> Visitor<'de> for Nodes {
    type Value = Node;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a text, a list or a mapping")
    }

    fn visit_unit<E>(self) -> Result<Node, E> {
        Ok(Node::Null)
    }

    fn visit_bool<E>(self, _: bool) -> Result<Node, E> {
        Ok(Node::Plain)
    }

    fn visit_i64<E>(self, _: i64) -> Result<Node, E> {
        Ok(Node::Plain)
    }

    fn visit_u64<E>(self, _: u64) -> Result<Node, E> {
        Ok(Node::Plain)
    }

    fn visit_f64<E>(self, _: f64) -> Result<Node, E> {
        Ok(Node::Plain)
    }

    fn visit_str<E>(self, text: &str) -> Result<Node, E> {
        Ok(Node::Text(text.to_string()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Node, A::Error> {
        Ok(Node::List(std::iter::from_fn(|| items.next_element().transpose()).collect::<Result<_, _>>()?))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut pairs: A) -> Result<Node, A::Error> {
        Ok(Node::Mapping(std::iter::from_fn(|| pairs.next_entry().transpose()).collect::<Result<_, _>>()?))
    }
}
