//! What made a file: stage, version, parameters, inputs, fingerprints. It stands in the key-value metadata.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use parquet::file::metadata::{KeyValue, ParquetMetaData};
use serde_json::Value;

use super::TableError;
use super::folder;
use super::footer;
use super::partition::PARAMETER;
use super::source::Source;

/// How tables and metadata are laid out. It rises when a reader of the old layout would misread the new one; a column more
/// is no reason. Files without it are of the first format.
pub const FORMAT_VERSION: u32 = 1;

const FORMAT: &str = "rockfrag.format";
const STAGE: &str = "rockfrag.stage";
const VERSION: &str = "rockfrag.version";
const PARAMETERS: &str = "rockfrag.parameters";
const INPUTS: &str = "rockfrag.inputs";
const PLAN: &str = "rockfrag.plan";
const CONTENT: &str = "rockfrag.content";

/// How a file comes to be: enough to make it again, and to know that it need not be made again.
#[derive(Debug, Clone, PartialEq)]
pub struct Provenance {
    /// The subcommand.
    pub stage: String,
    /// Of rockfrag.
    pub version: String,
    /// All resolved parameters that the rows depend on.
    pub parameters: Value,
    /// The fingerprint of what each input holds, by the role it plays.
    pub inputs: BTreeMap<String, String>,
    /// Where the inputs are, by their roles, as far as they can be looked at again; the file does not say.
    pub sources: BTreeMap<String, PathBuf>,
}

impl Provenance {
    /// Of a file that this version of rockfrag makes.
    pub fn new(stage: &str, parameters: Value, inputs: BTreeMap<String, String>) -> Provenance {
        let version = env!("CARGO_PKG_VERSION").to_string();
        Provenance { stage: stage.to_string(), version, parameters, inputs, sources: BTreeMap::new() }
    }

    /// With the places of its inputs.
    pub fn of_sources(self, sources: BTreeMap<String, PathBuf>) -> Provenance {
        Provenance { sources, ..self }
    }

    /// That the inputs still hold what they held before they were read: rows of one file must not say that they come from
    /// another.
    ///
    /// # Errors
    /// If an input has changed or gone.
    pub fn expect_unchanged(&self) -> Result<(), TableError> {
        let changed = |(role, path): &(&String, &PathBuf)| {
            content_of(path).ok().as_ref() != self.inputs.get(role.as_str())
        };
        match self.sources.iter().find(changed) {
            Some((_, path)) => Err(TableError::Changed { path: path.clone() }),
            None => Ok(()),
        }
    }

    /// The fingerprint of what is to be done: equal plans give equal rows.
    pub fn plan(&self) -> String {
        let plan = serde_json::json!([self.stage, self.version, self.parameters, self.inputs]);
        blake3::hash(plan.to_string().as_bytes()).to_hex().to_string()
    }

    pub(super) fn key_values(&self, content: &str) -> Vec<KeyValue> {
        [
            (FORMAT, FORMAT_VERSION.to_string()),
            (STAGE, self.stage.clone()),
            (VERSION, self.version.clone()),
            (PARAMETERS, self.parameters.to_string()),
            (INPUTS, serde_json::json!(self.inputs).to_string()),
            (PLAN, self.plan()),
            (CONTENT, content.to_string()),
        ]
        .map(|(key, value)| KeyValue::new(key.to_string(), value))
        .to_vec()
    }
}

/// What a file says of itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Stamp {
    /// How it was made.
    pub provenance: Provenance,
    /// The fingerprint of what was to be done.
    pub plan: String,
    /// The fingerprint of the rows that it holds.
    pub content: String,
}

/// The stamp of a Parquet file, or `None` where another program wrote it. That of a folder is of what its files have in common:
/// no partition, the inputs of the first one, and the fingerprint of all.
///
/// # Errors
/// If the file is missing, not readable as Parquet, or of a later format than is known here, or the folder is incomplete.
pub fn stamp(path: &Path) -> Result<Option<Stamp>, TableError> {
    if !path.is_dir() {
        return stamp_of_file(path);
    }
    let stamps =
        folder::files(path)?.iter().map(|file| stamp_of_file(file)).collect::<Result<Option<Vec<_>>, _>>()?;
    let Some(stamps) = stamps else { return Ok(None) };
    let mut provenance = stamps[0].provenance.clone();
    if let Value::Object(parameters) = &mut provenance.parameters {
        parameters.remove(PARAMETER);
    }
    let content = hash_of_all(stamps.iter().map(|stamp| stamp.content.as_str()));
    Ok(Some(Stamp { plan: provenance.plan(), provenance, content }))
}

pub(super) fn stamp_of_file(path: &Path) -> Result<Option<Stamp>, TableError> {
    stamp_in(path, footer::open(path)?.metadata.metadata())
}

/// The stamp in the footer of a file.
pub(super) fn stamp_in(path: &Path, metadata: &ParquetMetaData) -> Result<Option<Stamp>, TableError> {
    let pairs = metadata.file_metadata().key_value_metadata().map_or(&[][..], Vec::as_slice);
    let get = |key: &str| pairs.iter().find(|pair| pair.key == key).and_then(|pair| pair.value.clone());
    if let Some(format) = get(FORMAT)
        && format.parse::<u32>().is_ok_and(|format| format > FORMAT_VERSION)
    {
        let version = get(VERSION).unwrap_or_default();
        return Err(TableError::Newer { path: path.to_path_buf(), version, format, known: FORMAT_VERSION });
    }
    let stamp = || {
        Some(Stamp {
            provenance: Provenance {
                stage: get(STAGE)?,
                version: get(VERSION)?,
                parameters: serde_json::from_str(&get(PARAMETERS)?).ok()?,
                inputs: serde_json::from_str(&get(INPUTS)?).ok()?,
                sources: BTreeMap::new(),
            },
            plan: get(PLAN)?,
            content: get(CONTENT)?,
        })
    };
    Ok(stamp())
}

/// The fingerprint of what an input holds: as recorded by rockfrag, or the hash of its bytes if another program wrote
/// it.
///
/// # Errors
/// As [`stamp`], or if a file is unreadable; or if the table is in memory, so that no file could say of
/// itself what it was made from.
pub fn content_of(source: impl Into<Source>) -> Result<String, TableError> {
    match source.into() {
        Source::Path(path) => {
            let files = folder::files(&path)?;
            let contents = files.iter().map(|file| content_of_file(file)).collect::<Result<Vec<_>, _>>()?;
            if path.is_dir() {
                Ok(hash_of_all(contents.iter().map(String::as_str)))
            } else {
                Ok(contents.concat())
            }
        }
        Source::Memory(table) => Err(TableError::InMemory { name: table.name.clone() }),
    }
}

fn hash_of_all<'a>(contents: impl Iterator<Item = &'a str>) -> String {
    let mut whole = blake3::Hasher::new();
    for content in contents {
        whole.update(content.as_bytes()).update(b"\n");
    }
    format!("folder:{}", whole.finalize().to_hex())
}

fn content_of_file(path: &Path) -> Result<String, TableError> {
    if let Some(stamp) = stamp_of_file(path)? {
        return Ok(stamp.content);
    }
    let mut hasher = blake3::Hasher::new();
    let file = std::fs::File::open(path).map_err(|source| TableError::io(path, source))?;
    hasher.update_reader(file).map_err(|source| TableError::io(path, source))?;
    Ok(format!("bytes:{}", hasher.finalize().to_hex()))
}
