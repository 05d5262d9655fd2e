//! Provenance in files that are neither tables nor text: pictures and workbooks.

use std::io::{Cursor, Read};

use super::provenance::Provenance;

/// The words before the JSON in a PNG: the kind of the chunk, our name, no compression, no language.
const IN_PICTURE: &[u8] = b"iTXtrockfrag\0\0\0\0\0";
/// Where a PNG has its first chunk behind the head, and where the file of a workbook has our properties.
const BEHIND_HEAD: usize = 33;
const PROPERTIES: &str = "docProps/custom.xml";

impl Provenance {
    /// Reads the provenance in a PNG; `None` if another program wrote it.
    pub fn of_picture(png: &[u8]) -> Option<Provenance> {
        let (length, rest) = png.get(BEHIND_HEAD..)?.split_first_chunk::<4>()?;
        let chunk = rest.get(..u32::from_be_bytes(*length) as usize + 4)?;
        serde_json::from_slice(chunk.strip_prefix(IN_PICTURE)?).ok()
    }

    /// Reads the provenance in a workbook, which is written in parts; `None` if another program wrote it.
    pub fn of_workbook(bytes: Vec<u8>) -> Option<Provenance> {
        let mut archive = zip::ZipArchive::new(Cursor::new(bytes)).ok()?;
        let mut text = String::new();
        archive.by_name(PROPERTIES).ok()?.read_to_string(&mut text).ok()?;
        let parts = text.split("name=\"rockfrag").skip(1);
        let part =
            |part: &str| Some(part.split_once("<vt:lpwstr>")?.1.split_once("</vt:lpwstr>")?.0.to_string());
        let json = parts.map(part).collect::<Option<String>>()?;
        let json =
            json.replace("&quot;", "\"").replace("&lt;", "<").replace("&gt;", ">").replace("&amp;", "&");
        serde_json::from_str(&json).ok()
    }
}
