//! Provenance of a file: JSON in the footer of a table, or in the first lines of a page or figure.

use std::collections::BTreeMap;

use parquet::file::metadata::{FileMetaData, KeyValue, ParquetMetaData};
use serde::{Deserialize, Serialize};

use crate::warning::Warnings;

/// Key of the JSON among the key-value metadata.
const KEY: &str = "rockfrag";
/// The text before the JSON in a page or figure.
const META: &str = "name=\"rockfrag\" content=\"";
/// Writer of the file; another program that rewrites it puts its own name here.
pub const CREATED_BY: &str = concat!("rockfrag ", env!("CARGO_PKG_VERSION"));

#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    pub stage: String,
    /// Version of rockfrag.
    pub version: String,
    /// All arguments except files, defaults included.
    pub arguments: BTreeMap<String, Vec<String>>,
    /// Keys of its inputs.
    pub inputs: BTreeMap<String, String>,
    /// Names of the files of its inputs, which are not part of the key.
    #[serde(default)]
    pub files: BTreeMap<String, String>,
    /// Text printed by the stage.
    pub summary: String,
    pub warnings: Warnings,
}

/// Whether no other program has written the table since.
pub fn is_ours(footer: &FileMetaData) -> bool {
    footer.created_by().is_some_and(|program| program.starts_with("rockfrag "))
}

impl Provenance {
    /// Computes the hash of stage, version, arguments and keys of the inputs.
    pub fn key(&self) -> String {
        let text = serde_json::json!([self.stage, self.version, self.arguments, self.inputs]).to_string();
        blake3::hash(text.as_bytes()).to_hex().to_string()
    }

    /// Reads the provenance at the beginning of a page or figure; `None` if another program wrote it.
    pub fn of_text(text: &str) -> Option<Provenance> {
        let (_, rest) = text.split_once(META)?;
        let json = rest.split_once('"')?.0.replace("&quot;", "\"").replace("&lt;", "<").replace("&gt;", ">");
        serde_json::from_str(&json.replace("&amp;", "&")).ok()
    }

    /// Reads the provenance in a footer; `None` if another program wrote it.
    pub fn of_footer(metadata: &ParquetMetaData) -> Option<Provenance> {
        let footer = metadata.file_metadata();
        let pairs = footer.key_value_metadata().filter(|_| is_ours(footer))?;
        let pair = pairs.iter().find(|pair| pair.key == KEY)?;
        serde_json::from_str(pair.value.as_ref()?).ok()
    }

    /// Returns the entry of the footer.
    pub fn key_value(&self) -> KeyValue {
        KeyValue::new(KEY.to_string(), self.json())
    }

    pub fn json(&self) -> String {
        serde_json::json!(self).to_string()
    }

    /// Describes the first difference from the planned provenance.
    pub fn difference(&self, now: &Provenance) -> Option<String> {
        if self.stage != now.stage {
            return Some(format!("the file was made by {}", self.stage));
        }
        if self.version != now.version {
            return Some(format!("it is of rockfrag {}", self.version));
        }
        let text =
            |values: Option<&Vec<String>>| values.map_or("nothing".to_string(), |values| values.join(","));
        let is_other = |name: &&String| self.arguments.get(*name) != now.arguments.get(*name);
        if let Some(name) = now.arguments.keys().chain(self.arguments.keys()).find(is_other) {
            let [before, now] = [self, now].map(|made| text(made.arguments.get(name)));
            return Some(format!("--{name} changed from {before} to {now}"));
        }
        let other = now.inputs.iter().find(|(name, key)| self.inputs.get(*name) != Some(key));
        other.map(|(name, _)| format!("what --{name} reads changed"))
    }
}
