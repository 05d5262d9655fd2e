//! Provenance of a table: JSON in its footer.

use std::collections::BTreeMap;
use std::path::PathBuf;

use parquet::file::metadata::{KeyValue, ParquetMetaData};
use rockfrag_core::warning::Warnings;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::inputs::Reading;

const KEY: &str = "rockfrag";
/// Files of an input that are named.
const MOST_NAMED: usize = 4;
/// Writer of the file; another program that rewrites it puts its own name here.
pub const CREATED_BY: &str = concat!("rockfrag ", env!("CARGO_PKG_VERSION"));

/// A hash of the sources, data and dependencies of this program.
const PROGRAM: &str = env!("ROCKFRAG_PROGRAM");

#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Provenance {
    pub stage: String,
    pub version: String,
    pub program: String,
    /// All options except files, defaults included, by flag.
    pub arguments: BTreeMap<String, Value>,
    /// The files that were read, by flag.
    pub inputs: BTreeMap<String, Vec<InputFile>>,
    /// Which of the files of the stage it is, from 0.
    pub output: usize,
    /// The options, and names of files, of all stages before, by stage and flag.
    pub before: BTreeMap<String, BTreeMap<String, String>>,
    pub summary: String,
    pub warnings: Warnings,
    /// How the files of people were read.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub readings: Vec<Reading>,
}

/// Returns what rockfrag put into a footer under a key; none if another program has written the table since.
pub fn own_entry<'a>(metadata: &'a ParquetMetaData, key: &str) -> Option<&'a str> {
    let footer = metadata.file_metadata();
    footer.created_by().filter(|program| program.starts_with("rockfrag "))?;
    footer.key_value_metadata()?.iter().find(|pair| pair.key == key)?.value.as_deref()
}

#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct InputFile {
    /// Its name, below the innermost folder that has all files of its flag.
    pub name: String,
    pub key: String,
    #[serde(skip)]
    pub path: PathBuf,
}

/// Returns the key of the files that are one input: that of a single file, else a hash of all.
pub fn joined(files: &[InputFile]) -> String {
    match files {
        [one] => one.key.clone(),
        _ => hash(&serde_json::json!(files)),
    }
}

fn hash(value: &Value) -> String {
    blake3::hash(value.to_string().as_bytes()).to_hex().to_string()
}

/// Returns the text of a value on a command line; a mapping becomes `name=frame,p=1`.
pub fn text_of(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Object(pairs) => {
            let pairs = pairs.iter().map(|(key, value)| format!("{key}={}", text_of(value)));
            pairs.collect::<Vec<_>>().join(",")
        }
        Value::Array(items) => items.iter().map(text_of).collect::<Vec<_>>().join(","),
        other => other.to_string(),
    }
}

/// Returns an option as a shell takes it, once for each structure; a switch that is off is not given.
pub fn on_command_line(name: &str, value: &Value) -> Vec<String> {
    match value {
        Value::Array(items) if items.iter().all(Value::is_object) => {
            items.iter().flat_map(|item| on_command_line(name, item)).collect()
        }
        Value::Bool(is_on) => is_on.then(|| format!("--{name}")).into_iter().collect(),
        other => vec![format!("--{name} {}", quoted(text_of(other)))],
    }
}

/// Quotes what a shell would not take as it is.
fn quoted(word: String) -> String {
    let is_plain = |letter: char| letter.is_ascii_alphanumeric() || "-_=.,:/+%".contains(letter);
    if word.chars().all(is_plain) { word } else { format!("'{}'", word.replace('\'', r"'\''")) }
}

impl Provenance {
    /// Begins the provenance of what a stage of this program makes.
    pub fn new(stage: &str, arguments: BTreeMap<String, Value>) -> Provenance {
        let [version, program] = [env!("CARGO_PKG_VERSION"), PROGRAM].map(str::to_string);
        Provenance { stage: stage.to_string(), version, program, arguments, ..Provenance::default() }
    }

    /// Computes the hash of stage, program, options, names and keys of the inputs, and which output it is.
    pub fn key(&self) -> String {
        let Provenance { stage, program, arguments, inputs, output, .. } = self;
        hash(&serde_json::json!([stage, program, arguments, inputs, output]))
    }

    /// Returns which part of a table it is; none if it is a whole one.
    pub fn partition(&self) -> Option<&str> {
        self.arguments.get("partition")?.as_str()
    }

    /// Returns the key that all parts of one table share: of how many parts, not of which.
    pub fn whole(&self) -> String {
        let mut options = self.arguments.clone();
        if let Some(Value::String(part)) = options.get_mut("partition") {
            part.drain(..part.find('/').unwrap_or_default());
        }
        let files = self.inputs.iter().flat_map(|(flag, files)| files.iter().map(move |file| (flag, file)));
        let keys: Vec<_> = files.map(|(flag, file)| (flag, file.key.split(' ').next())).collect();
        hash(&serde_json::json!([self.stage, self.program, options, keys]))
    }

    /// Returns the key by which other stages know the file: of a part the key of the whole, and which it is.
    pub fn key_of_content(&self) -> String {
        self.partition().map_or_else(|| self.key(), |part| format!("{} {part}", self.whole()))
    }

    pub fn input(&self, flag: &str) -> Option<String> {
        self.inputs.get(flag).map(|files| joined(files))
    }

    pub fn names(&self, flag: &str) -> Option<String> {
        let names = self.inputs.get(flag)?.iter().take(MOST_NAMED).map(|file| file.name.as_str());
        Some(names.collect::<Vec<_>>().join(", "))
    }

    /// Returns the options, and names of files, of this stage and all before.
    pub fn all_stated(self) -> BTreeMap<String, BTreeMap<String, String>> {
        let names = self.inputs.keys().filter_map(|flag| Some((flag.clone(), self.names(flag)?)));
        let options = self.arguments.iter().map(|(flag, value)| (flag.clone(), text_of(value)));
        let stated = names.chain(options).collect();
        self.before.into_iter().chain([(self.stage, stated)]).collect()
    }

    /// Reads the provenance in a footer, of another version stage, version and summary at least; `None` if
    /// another program wrote it.
    pub fn from_footer(metadata: &ParquetMetaData) -> Option<Provenance> {
        let value: Value = serde_json::from_str(own_entry(metadata, KEY)?).ok()?;
        let [stage, version, summary] =
            ["stage", "version", "summary"].map(|name| value[name].as_str().unwrap_or_default().to_string());
        let known = serde_json::from_value(value).ok();
        known.or(Some(Provenance { stage, version, summary, ..Provenance::default() }))
    }

    pub fn key_value(&self) -> KeyValue {
        KeyValue::new(KEY.to_string(), serde_json::json!(self).to_string())
    }

    /// Describes the first difference from the planned provenance.
    pub fn difference(&self, now: &Provenance) -> Option<String> {
        if self.stage != now.stage {
            return Some(format!("the file was made by {}", self.stage));
        }
        if (&self.version, &self.program) != (&now.version, &now.program) {
            return Some(format!("it was made by another build of rockfrag ({})", self.version));
        }
        let mut names = now.arguments.keys().chain(self.arguments.keys());
        if let Some(name) = names.find(|name| self.arguments.get(*name) != now.arguments.get(*name)) {
            let [before, now] =
                [self, now].map(|made| made.arguments.get(name).map_or("nothing".to_string(), text_of));
            return Some(format!("--{name} changed from {before} to {now}"));
        }
        let read = |made: &Provenance, name: &str| serde_json::json!(made.inputs.get(name));
        let mut names = now.inputs.keys().chain(self.inputs.keys());
        let other = names.find(|name| read(self, name) != read(now, name))?;
        Some(format!("what --{other} reads changed"))
    }
}
