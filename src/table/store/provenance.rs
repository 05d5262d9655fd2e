//! What made a file: stage, version, parameters, inputs, fingerprints. It stands in the key-value metadata.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use parquet::file::metadata::{KeyValue, ParquetMetaData};
use serde_json::Value;

use super::footer;
use crate::table::TableError;

/// How tables and metadata are laid out. It rises when a reader of the old layout would misread the new one; a column more
/// is no reason. Files without it are of the first format.
pub const FORMAT_VERSION: u32 = 1;

const FORMAT: &str = "rockfrag.format";
const STAGE: &str = "rockfrag.stage";
const VERSION: &str = "rockfrag.version";
const PARAMETERS: &str = "rockfrag.parameters";
const INPUTS: &str = "rockfrag.inputs";
const CACHE_KEY: &str = "rockfrag.cache_key";
const CONTENT: &str = "rockfrag.content";
const WARNINGS: &str = "rockfrag.warnings";
const SHOWN: &str = "rockfrag.shown";

/// The version, and after a plus the fingerprint of the code that it was built from.
pub const CODE: &str = concat!(env!("CARGO_PKG_VERSION"), "+", env!("ROCKFRAG_CODE"));

/// The first parameter of `now` that is another one `before`: its name, the value before, and the value now; of what has
/// parts the first part that differs.
pub fn difference(before: &Value, now: &Value) -> Option<(String, String, String)> {
    let (Value::Object(old), Value::Object(new)) = (before, now) else { return None };
    let name = new.keys().chain(old.keys()).find(|name| old.get(*name) != new.get(*name))?;
    let (old, new) = match (old.get(name), new.get(name)) {
        (Some(old), Some(new)) => parts_that_differ(old, new),
        (old, new) => {
            let words = |value: Option<&Value>| value.map_or("nothing".to_string(), short);
            (words(old), words(new))
        }
    };
    Some((name.clone(), old, new))
}

fn parts_that_differ(old: &Value, new: &Value) -> (String, String) {
    match (old, new) {
        (Value::Array(before), Value::Array(now)) if before.len() == now.len() => {
            let differ = |(old, new): &(&Value, &Value)| old != new;
            before.iter().zip(now).find(differ).map(|(old, new)| parts_that_differ(old, new))
        }
        (Value::Object(_), Value::Object(_)) => {
            let named = |(name, old, new)| (format!("{name} {old}"), format!("{name} {new}"));
            difference(old, new).map(named)
        }
        _ => None,
    }
    .unwrap_or_else(|| (short(old), short(new)))
}

fn short(value: &Value) -> String {
    let text = value.to_string();
    if text.chars().count() > 60 { format!("{}...", text.chars().take(57).collect::<String>()) } else { text }
}

/// The warnings of a stage while it works; whoever writes its files takes them from here.
#[derive(Debug, Clone, Default)]
pub struct Warnings(Arc<Mutex<Vec<String>>>);

impl Warnings {
    /// Adds one.
    pub fn push(&self, warning: &str) {
        if let Ok(mut all) = self.0.lock() {
            all.push(warning.to_string());
        }
    }

    /// All so far.
    pub fn all(&self) -> Vec<String> {
        self.0.lock().map_or(Vec::new(), |all| all.clone())
    }
}

impl PartialEq for Warnings {
    fn eq(&self, other: &Warnings) -> bool {
        self.all() == other.all()
    }
}

/// How a file comes to be: enough to make it again, and to know that it need not be made again.
#[derive(Debug, Clone, PartialEq)]
pub struct Provenance {
    pub stage: String,
    /// Of rockfrag, with the fingerprint of its code: files of other code of the same version are made again.
    pub version: String,
    /// All resolved parameters that the rows depend on.
    pub parameters: Value,
    /// The fingerprint of what each input holds, by the role it plays.
    pub inputs: BTreeMap<String, String>,
    /// Where the inputs are, by their roles, as far as they can be looked at again; the file does not say.
    pub sources: BTreeMap<String, PathBuf>,
    /// What was warned of while the rows were made.
    pub warnings: Warnings,
    /// What a report shows of the inputs, beside the rows; null where it needs nothing.
    pub shown: Value,
}

impl Provenance {
    /// Of a file that this version of rockfrag makes.
    pub fn new(stage: &str, parameters: Value, inputs: BTreeMap<String, String>) -> Provenance {
        let version = CODE.to_string();
        let (sources, warnings, shown) = (BTreeMap::new(), Warnings::default(), Value::Null);
        Provenance { stage: stage.to_string(), version, parameters, inputs, sources, warnings, shown }
    }

    /// With the places of its inputs.
    pub fn of_sources(self, sources: BTreeMap<String, PathBuf>) -> Provenance {
        Provenance { sources, ..self }
    }

    /// The fingerprint of what is to be done: equal keys give equal rows.
    pub fn cache_key(&self) -> String {
        let key = serde_json::json!([self.stage, self.version, self.parameters, self.inputs]);
        blake3::hash(key.to_string().as_bytes()).to_hex().to_string()
    }

    pub(super) fn key_values(&self, content: &str) -> Vec<KeyValue> {
        let warnings = self.warnings.all();
        [
            (FORMAT, FORMAT_VERSION.to_string()),
            (STAGE, self.stage.clone()),
            (VERSION, self.version.clone()),
            (PARAMETERS, self.parameters.to_string()),
            (INPUTS, serde_json::json!(self.inputs).to_string()),
            (CACHE_KEY, self.cache_key()),
            (CONTENT, content.to_string()),
        ]
        .into_iter()
        .chain((!warnings.is_empty()).then(|| (WARNINGS, serde_json::json!(warnings).to_string())))
        .chain((!self.shown.is_null()).then(|| (SHOWN, self.shown.to_string())))
        .map(|(key, value)| KeyValue::new(key.to_string(), value))
        .collect()
    }
}

/// What a file says of itself.
#[derive(Debug, Clone, PartialEq)]
pub struct Recorded {
    /// How it was made.
    pub provenance: Provenance,
    /// The fingerprint of what was to be done.
    pub cache_key: String,
    /// The fingerprint of the rows that it holds.
    pub content: String,
}

pub(super) fn recorded_in_file(path: &Path) -> Result<Option<Recorded>, TableError> {
    recorded_in(path, footer::open(path)?.metadata.metadata())
}

/// What the footer of a file records of how it was made.
pub(super) fn recorded_in(path: &Path, metadata: &ParquetMetaData) -> Result<Option<Recorded>, TableError> {
    let pairs = metadata.file_metadata().key_value_metadata().map_or(&[][..], Vec::as_slice);
    let get = |key: &str| pairs.iter().find(|pair| pair.key == key).and_then(|pair| pair.value.clone());
    if let Some(format) = get(FORMAT)
        && format.parse::<u32>().is_ok_and(|format| format > FORMAT_VERSION)
    {
        let version = get(VERSION).unwrap_or_default();
        return Err(TableError::Newer { path: path.to_path_buf(), version, format, known: FORMAT_VERSION });
    }
    let warnings = get(WARNINGS).and_then(|words| serde_json::from_str(&words).ok()).unwrap_or_default();
    let shown = get(SHOWN).and_then(|shown| serde_json::from_str(&shown).ok()).unwrap_or_default();
    let recorded = || {
        Some(Recorded {
            provenance: Provenance {
                stage: get(STAGE)?,
                version: get(VERSION)?,
                parameters: serde_json::from_str(&get(PARAMETERS)?).ok()?,
                inputs: serde_json::from_str(&get(INPUTS)?).ok()?,
                sources: BTreeMap::new(),
                warnings: Warnings(Arc::new(Mutex::new(warnings))),
                shown,
            },
            cache_key: get(CACHE_KEY)?,
            content: get(CONTENT)?,
        })
    };
    Ok(recorded())
}
