//! What made a page, in its head: so that a run knows whether it is up to date.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::path::Path;

use serde_json::{Value, json};

use crate::table::TableError;
use crate::table::store::provenance::{Provenance, Recorded, Warnings};

/// Lines at the start of a page among which the record of how it was made is.
const LINES: usize = 8;
const BEFORE: &str = "<meta name=\"rockfrag\" content=\"";
const AFTER: &str = "\">";

/// What a page that is made like this records of it.
pub fn words(provenance: &Provenance) -> String {
    let Provenance { stage, version, parameters, inputs, .. } = provenance;
    json!({ "stage": stage, "version": version, "parameters": parameters, "inputs": inputs }).to_string()
}

/// What a page records of how it was made, or `None` where it has none.
///
/// # Errors
/// If the page is missing or unreadable.
pub fn read(path: &Path) -> Result<Option<Recorded>, TableError> {
    let file = match File::open(path) {
        Ok(file) => file,
        Err(source) if source.kind() == std::io::ErrorKind::NotFound => {
            return Err(TableError::Missing { path: path.to_path_buf(), hint: "run report".to_string() });
        }
        Err(source) => return Err(TableError::io(path, source)),
    };
    for line in BufReader::new(file).lines().take(LINES) {
        let line = line.map_err(|source| TableError::io(path, source))?;
        if let Some(words) = line.strip_prefix(BEFORE).and_then(|rest| rest.strip_suffix(AFTER)) {
            return Ok(parse(
                &words
                    .replace("&quot;", "\"")
                    .replace("&lt;", "<")
                    .replace("&gt;", ">")
                    .replace("&amp;", "&"),
            ));
        }
    }
    Ok(None)
}

fn parse(words: &str) -> Option<Recorded> {
    let value: Value = serde_json::from_str(words).ok()?;
    let text = |key: &str| value[key].as_str().map(str::to_string);
    let inputs: BTreeMap<String, String> = serde_json::from_value(value["inputs"].clone()).ok()?;
    let provenance = Provenance {
        stage: text("stage")?,
        version: text("version")?,
        parameters: value["parameters"].clone(),
        inputs,
        sources: BTreeMap::new(),
        warnings: Warnings::default(),
        shown: Value::Null,
    };
    let cache_key = provenance.cache_key();
    Some(Recorded { provenance, cache_key, content: String::new() })
}
