//! Provenance of a file, and the key that shows whether it is up to date: JSON in the footer of a table, or
//! in the first lines of a page or figure.

use std::collections::{BTreeMap, HashMap};
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use parquet::file::metadata::{KeyValue, ParquetMetaData};
use serde::{Deserialize, Serialize};

use super::TableError;
use super::file;
use crate::warning::Warnings;

/// Key of the JSON among the key-value metadata.
const KEY: &str = "rockfrag";
/// The text before the JSON in a page or figure, and the bytes that are searched for it.
const META: &str = "name=\"rockfrag\" content=\"";
const HEAD: u64 = 8192;
/// Writer of the file; another program that rewrites it puts its own name here.
pub const CREATED_BY: &str = concat!("rockfrag ", env!("CARGO_PKG_VERSION"));

/// The provenance of a file.
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
    /// Warnings about the results.
    pub warnings: Warnings,
}

impl Provenance {
    /// Computes the hash of stage, version, arguments and keys of the inputs.
    pub fn key(&self) -> String {
        let text = serde_json::json!([self.stage, self.version, self.arguments, self.inputs]).to_string();
        blake3::hash(text.as_bytes()).to_hex().to_string()
    }

    /// Reads the provenance of a table, page or figure; `None` if another program wrote it.
    pub fn of_file(path: &Path) -> Result<Option<Provenance>, TableError> {
        let is_text = path.extension().is_some_and(|ending| ending == "html" || ending == "svg");
        match is_text {
            true => Ok(Provenance::of_text(&head(path)?)),
            false => Ok(Provenance::of_footer(file::metadata(path)?.metadata())),
        }
    }

    /// Reads it from the beginning of a page or figure.
    fn of_text(text: &str) -> Option<Provenance> {
        let (_, rest) = text.split_once(META)?;
        let json = rest.split_once('"')?.0.replace("&quot;", "\"").replace("&lt;", "<").replace("&gt;", ">");
        serde_json::from_str(&json.replace("&amp;", "&")).ok()
    }

    /// Reads the provenance in a footer; `None` if another program wrote it.
    pub fn of_footer(metadata: &ParquetMetaData) -> Option<Provenance> {
        let footer = metadata.file_metadata();
        footer.created_by().filter(|program| program.starts_with("rockfrag "))?;
        let pair = footer.key_value_metadata()?.iter().find(|pair| pair.key == KEY)?;
        serde_json::from_str(pair.value.as_ref()?).ok()
    }

    /// Returns the entry of the footer.
    pub fn key_value(&self) -> KeyValue {
        KeyValue::new(KEY.to_string(), self.json())
    }

    /// As text.
    pub fn json(&self) -> String {
        serde_json::json!(self).to_string()
    }

    /// Describes the first difference from the planned provenance.
    pub fn difference(&self, now: &Provenance) -> Option<String> {
        if self.stage != now.stage {
            return Some(format!("the file is of {}", self.stage));
        }
        if self.version != now.version {
            return Some(format!("it is of rockfrag {}", self.version));
        }
        let text =
            |values: Option<&Vec<String>>| values.map_or("nothing".to_string(), |values| values.join(","));
        let names = now.arguments.keys().chain(self.arguments.keys());
        for name in names {
            let (before, now) = (self.arguments.get(name), now.arguments.get(name));
            if before != now {
                return Some(format!("--{name} changed from {} to {}", text(before), text(now)));
            }
        }
        let other = now.inputs.iter().find(|(name, key)| self.inputs.get(*name) != Some(key));
        other.map(|(name, _)| format!("what --{name} reads changed"))
    }
}

/// Returns all files, those in folders included, in the order of their names, without hidden files.
pub fn files_below(paths: &[PathBuf]) -> Result<Vec<PathBuf>, TableError> {
    let mut files = Vec::new();
    for path in paths {
        if !path.is_dir() {
            files.push(path.clone());
            continue;
        }
        let entries = std::fs::read_dir(path).map_err(|source| TableError::io(path, source))?;
        let mut inside: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
        inside.retain(|path| path.file_name().is_some_and(|name| !name.to_string_lossy().starts_with('.')));
        inside.sort_unstable();
        files.extend(files_below(&inside)?);
    }
    Ok(files)
}

/// Reads the beginning of a file as text.
pub fn head(path: &Path) -> Result<String, TableError> {
    let mut head = Vec::new();
    let read = File::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut head));
    read.map_err(|source| TableError::io(path, source))?;
    Ok(String::from_utf8_lossy(&head).into_owned())
}

/// Computes the key of an input: the one in the file if rockfrag wrote it, otherwise the hash of its bytes;
/// for a folder, the hash of the keys of its tables, or of all files if there is no table.
pub fn key_of(path: &Path) -> Result<String, TableError> {
    key_with(path, &HashMap::new())
}

/// Computes the same with the keys of files that are not made yet.
pub fn key_with(path: &Path, planned: &HashMap<PathBuf, String>) -> Result<String, TableError> {
    if let Some(key) = planned.get(path) {
        return Ok(key.clone());
    }
    let is_table = |path: &Path| path.extension().is_some_and(|extension| extension == "parquet");
    if path.is_dir() {
        let mut files = files_below(&[path.to_path_buf()])?;
        let to_come = planned.keys().filter(|file| file.starts_with(path) && !file.exists());
        files.extend(to_come.cloned());
        files.sort_unstable();
        if files.iter().any(|file| is_table(file)) {
            files.retain(|file| is_table(file));
        }
        let keys = files.iter().map(|file| key_with(file, planned)).collect::<Result<Vec<_>, _>>()?;
        return Ok(blake3::hash(keys.join(" ").as_bytes()).to_hex().to_string());
    }
    if is_table(path)
        && let Ok(Some(made)) = Provenance::of_file(path)
    {
        return Ok(made.key());
    }
    let mut hasher = blake3::Hasher::new();
    let read = File::open(path).and_then(|file| hasher.update_reader(file).map(|_| ()));
    read.map_err(|source| TableError::io(path, source))?;
    Ok(hasher.finalize().to_hex().to_string())
}
