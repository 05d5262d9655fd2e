//! Unpacks what is packed: gzip, and zip archives.

use std::io::{Cursor, Read};

use flate2::read::MultiGzDecoder;
use zip::ZipArchive;

use super::error::InputError;

/// The most bytes that a file may unpack to.
const LARGEST: u64 = 1 << 30;

/// A file, or one of an archive.
#[derive(Debug, Clone, PartialEq)]
pub struct Member {
    /// Name within an archive; none of a file that is no archive.
    pub name: Option<String>,
    /// Bytes, unpacked.
    pub bytes: Vec<u8>,
}

/// Returns the files in an archive, or the bytes themselves, unpacked. A workbook stays as it is.
pub fn unpack(bytes: Vec<u8>) -> Result<Vec<Member>, InputError> {
    let is_archive = bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06");
    let members = if is_archive { members(&bytes)? } else { None };
    let mut members = members.unwrap_or_else(|| vec![Member { name: None, bytes }]);
    for member in &mut members {
        if member.bytes.starts_with(b"\x1f\x8b") {
            member.bytes = read(MultiGzDecoder::new(member.bytes.as_slice()))?;
        }
        if member.bytes.get(257..262) == Some(b"ustar") {
            return Err(InputError::NoTable { found: "a tar archive" });
        }
    }
    Ok(members)
}

/// Reads the files of a zip archive, without those that systems add; none of a workbook.
fn members(bytes: &[u8]) -> Result<Option<Vec<Member>>, InputError> {
    let mut archive = ZipArchive::new(Cursor::new(bytes))?;
    if archive.file_names().any(|name| matches!(name, "[Content_Types].xml" | "mimetype")) {
        return Ok(None);
    }
    let mut members = Vec::new();
    for index in 0..archive.len() {
        let file = archive.by_index(index)?;
        let name = file.name().to_string();
        let is_hidden = name.split('/').any(|part| part.starts_with('.') || part == "__MACOSX");
        if !file.is_dir() && !is_hidden {
            members.push(Member { name: Some(name), bytes: read(file)? });
        }
    }
    members.sort_by(|a, b| a.name.cmp(&b.name));
    Ok(Some(members))
}

fn read(packed: impl Read) -> Result<Vec<u8>, InputError> {
    let mut bytes = Vec::new();
    let read = packed.take(LARGEST + 1).read_to_end(&mut bytes);
    match read.map_err(|error| InputError::Damaged(error.to_string()))? as u64 {
        0..=LARGEST => Ok(bytes),
        _ => Err(InputError::Damaged("it unpacks to more than 1 GB".to_string())),
    }
}
