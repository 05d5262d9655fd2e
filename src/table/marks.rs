//! Marks of our own files, by which one is told from a file of another program before it is replaced, and
//! found up to date: provenance in pages, pictures and workbooks; headings and keys of CSV and JSON.

use std::collections::BTreeSet;
use std::io::{Cursor, Read};
use std::path::Path;

use serde_json::Value;

use super::TableError;
use super::file;
use super::provenance::Provenance;

/// The words before the JSON in a PNG: the kind of the chunk, our name, no compression, no language.
const IN_PICTURE: &[u8] = b"iTXtrockfrag\0\0\0\0\0";
/// The text before the JSON in a page or figure, and after it.
const META: [&str; 2] = ["name=\"rockfrag\" content=\"", "\""];
/// The start of a second line of XML.
const XML: &str = "<!-- rockfrag ";
/// How the names of structures begin in an export.
const OWN_NAME: &str = "rockfrag_";
/// The start of the last line of a page or figure, before its hash.
const SEAL: &str = "<!-- hash ";
/// Where a PNG has its first chunk behind the head, and the bytes of a hash and of the sum of a chunk.
const BEHIND_HEAD: usize = 33;
const HASH: usize = 64;
const SUM: usize = 4;
/// Where the file of a workbook has our properties, and when it was written.
const PROPERTIES: &str = "docProps/custom.xml";
const CORE: &str = "docProps/core.xml";
const WRITTEN: &str = ">2000-01-01T00:00:00Z<";

impl Provenance {
    /// Reads the provenance in a PNG; `None` if another program wrote or changed it.
    pub fn from_picture(png: &[u8]) -> Option<Provenance> {
        let (head, rest) = png.split_at_checked(BEHIND_HEAD)?;
        let (length, rest) = rest.split_first_chunk::<4>()?;
        let (chunk, rest) = rest.split_at_checked(u32::from_be_bytes(*length) as usize + 4)?;
        let (hash, json) = chunk.strip_prefix(IN_PICTURE)?.split_at_checked(HASH)?;
        let drawn = [head, rest.get(SUM..)?].concat();
        let is_whole = blake3::hash(&drawn).to_hex().as_bytes() == hash;
        is_whole.then(|| Provenance::from_json(&String::from_utf8_lossy(json)))?
    }

    /// Reads the provenance in a workbook, which is written in parts; `None` if another program wrote it.
    pub fn from_workbook(bytes: Vec<u8>) -> Option<Provenance> {
        let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).ok()?;
        let mut text = String::new();
        archive.by_name(CORE).ok()?.read_to_string(&mut text).ok()?;
        // Whoever saves it states when.
        if text.matches(WRITTEN).count() != 2 {
            return None;
        }
        text.clear();
        archive.by_name(PROPERTIES).ok()?.read_to_string(&mut text).ok()?;
        let parts = text.split("name=\"rockfrag").skip(1);
        let json =
            parts.map(|part| between(part, ["<vt:lpwstr>", "</vt:lpwstr>"])).collect::<Option<String>>()?;
        Provenance::from_json(&unescaped(&json))
    }

    /// Reads the provenance in a file; `None` if another program wrote it, or if files of its kind have none.
    pub fn read(path: &Path) -> Result<Option<Provenance>, TableError> {
        let read = || std::fs::read(path).map_err(|source| TableError::io(path, source));
        match path.extension().and_then(|ending| ending.to_str()) {
            Some("html" | "svg") => {
                let bytes = read()?;
                let text = String::from_utf8_lossy(&bytes);
                let before = text.rfind(SEAL).map(|at| text[..at].to_string());
                let whole = before.filter(|before| sealed(before.clone()) == text);
                let json = whole.and_then(|text| between(&text, META).map(unescaped));
                Ok(json.and_then(|json| Provenance::from_json(&json)))
            }
            Some("png") => Ok(Provenance::from_picture(&read()?)),
            Some("xlsx") => Ok(Provenance::from_workbook(read()?)),
            Some("csv" | "json" | "xml") => read().map(|_| None),
            _ => Ok(Provenance::from_footer(file::metadata(path)?.metadata())),
        }
    }
}

/// Ends a page or figure with a hash of it: one that another program changes is not ours any more.
pub fn sealed(text: String) -> String {
    let hash = blake3::hash(text.as_bytes()).to_hex();
    format!("{text}{SEAL}{hash} -->\n")
}

/// The comment that marks XML as ours, on its second line.
pub fn xml_mark() -> String {
    format!("{XML}{} -->", env!("CARGO_PKG_VERSION"))
}

/// Returns whether the file at `path` is ours, or has the headings or keys of what would be written there.
pub fn is_ours(path: &Path, content: &[u8]) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str());
    if !matches!(ending, Some("csv" | "json" | "xml")) {
        return Provenance::read(path).is_ok_and(|made| made.is_some());
    }
    let there = std::fs::read(path).unwrap_or_default();
    match ending {
        Some("csv") => heading(&there) == heading(content),
        Some("json") => keys(&there).is_some_and(|found| Some(found) == keys(content)),
        _ => String::from_utf8_lossy(&there).lines().nth(1).is_some_and(|line| line.starts_with(XML)),
    }
}

fn heading(csv: &[u8]) -> &[u8] {
    csv.split(|byte| *byte == b'\n').next().unwrap_or_default().trim_ascii_end()
}

/// The keys of an object, or of the first of a list; names of structures are all one.
fn keys(json: &[u8]) -> Option<BTreeSet<String>> {
    let value: Value = serde_json::from_slice(json).ok()?;
    let object = value.as_array().map_or(Some(&value), |items| items.first())?;
    let key = |key: &String| if key.starts_with(OWN_NAME) { OWN_NAME } else { key }.to_string();
    Some(object.as_object()?.keys().map(key).collect())
}

fn between<'a>(text: &'a str, [before, after]: [&str; 2]) -> Option<&'a str> {
    text.split_once(before)?.1.split_once(after).map(|(inside, _)| inside)
}

fn unescaped(text: &str) -> String {
    let text = text.replace("&quot;", "\"").replace("&lt;", "<").replace("&gt;", ">");
    text.replace("&apos;", "'").replace("&amp;", "&")
}
