//! Unpacks what is packed: gzip, and archives of zip and tar.

use std::io::{Cursor, Read};

use flate2::read::MultiGzDecoder;
use zip::ZipArchive;

use super::error::{InputError, Result};

/// The most bytes that a file may unpack to, with all that is in it.
const LARGEST: u64 = 200 << 20;
/// Fewer bytes than an entry of a list takes in a workbook.
const LEAST_ENTRY: usize = 8;

/// What is in files that begin as workbooks do: streams of OLE, and words of the parts of other formats.
const OTHERS: [(&str, &str); 7] = [
    ("E\0n\0c\0r\0y\0p\0t\0e\0d\0P\0a\0c\0k\0a\0g\0e\0", "a workbook with a password"),
    ("W\0o\0r\0d\0D\0o\0c\0u\0m\0e\0n\0t\0", "a Word document"),
    ("manifest:encryption-data", "a workbook with a password"),
    ("word/document.xml", "a Word document"),
    ("ppt/presentation.xml", "slides"),
    ("application/vnd.oasis.opendocument.text", "a text document"),
    (".iwa", "a document of Apple's Numbers or Pages"),
];

#[derive(Debug, Clone, PartialEq)]
pub struct Member {
    /// Name within an archive; none of a file that is no archive.
    pub name: Option<String>,
    pub bytes: Vec<u8>,
}

/// Returns the only file in an archive, or the bytes themselves, unpacked.
pub fn unpack_one(bytes: Vec<u8>) -> Result<Vec<u8>> {
    match <[Member; 1]>::try_from(unpack(bytes)?) {
        Ok([only]) => Ok(only.bytes),
        Err(all) => Err(InputError::Members { found: all.into_iter().filter_map(|one| one.name).collect() }),
    }
}

/// Returns the files in an archive, or the bytes themselves, unpacked. A workbook stays as it is.
pub fn unpack(bytes: Vec<u8>) -> Result<Vec<Member>> {
    let (mut left, mut members) = (LARGEST, Vec::new());
    let mut packed = vec![Member { name: None, bytes }];
    while let Some(Member { name, bytes }) = packed.pop() {
        if bytes.starts_with(b"\x1f\x8b") {
            packed.push(Member { name, bytes: read(MultiGzDecoder::new(bytes.as_slice()), &mut left)? });
        } else if bytes.get(257..262) == Some(b"ustar") {
            for entry in tar::Archive::new(bytes.as_slice()).entries().map_err(InputError::damaged)? {
                let entry = entry.map_err(InputError::damaged)?;
                let name = String::from_utf8_lossy(&entry.path_bytes()).into_owned();
                if entry.header().entry_type().is_file() && is_meant(&name) {
                    packed.push(Member { bytes: read(entry, &mut left)?, name: Some(name) });
                }
            }
        } else if bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06") {
            match zipped(&bytes, &mut left)? {
                Some(files) => packed.extend(files),
                None => members.push(Member { name, bytes }),
            }
        } else {
            if bytes.starts_with(b"\xd0\xcf\x11\xe0") {
                expect_workbook(&String::from_utf8_lossy(&bytes))?;
            }
            members.push(Member { name, bytes });
        }
    }
    members.sort_by(|one, other| one.name.cmp(&other.name));
    Ok(members)
}

/// Reads the files of a zip archive; none of a workbook, whose parts must be small all the same.
fn zipped(bytes: &[u8], left: &mut u64) -> Result<Option<Vec<Member>>> {
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(InputError::damaged)?;
    let is_workbook = archive.file_names().any(|name| matches!(name, "[Content_Types].xml" | "mimetype"));
    let mut files = Vec::new();
    for at in 0..archive.len() {
        let file = archive.by_index(at).map_err(InputError::damaged)?;
        let name = file.name().to_string();
        expect_workbook(&name)?;
        if is_workbook && !name.split('/').any(|part| matches!(part, "media" | "Pictures")) {
            expect_true_counts(&read(file, left)?)?;
        } else if !is_workbook && is_meant(&name) {
            files.push(Member { bytes: read(file, left)?, name: Some(name) });
        }
    }
    Ok((!is_workbook).then_some(files))
}

/// Whether a name in an archive is that of a file which no system has added.
fn is_meant(name: &str) -> bool {
    let is_added = |part: &str| part.starts_with('.') && part != "." || part == "__MACOSX";
    !name.ends_with(['/', '\\']) && !name.split('/').any(is_added)
}

fn read(packed: impl Read, left: &mut u64) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let read = packed.take(*left + 1).read_to_end(&mut bytes);
    let read = read.map_err(InputError::damaged)? as u64;
    *left = left.checked_sub(read).ok_or_else(|| {
        InputError::unexpected("it unpacks to more than 200 MB", "less: unpack it, and give the files meant")
    })?;
    Ok(bytes)
}

fn expect_workbook(text: &str) -> Result<()> {
    let other = OTHERS.into_iter().find(|(sign, _)| text.contains(sign));
    other.map_or(Ok(()), |(_, found)| Err(InputError::NoTable { found }))
}

/// Refuses a part of a workbook with a count or an index for which it is too small: its reader would reserve
/// memory for it.
fn expect_true_counts(part: &[u8]) -> Result<()> {
    let text = String::from_utf8_lossy(part);
    expect_workbook(&text)?;
    let values = [" uniqueCount=", " si="].into_iter().flat_map(|name| text.split(name).skip(1));
    for value in values.filter_map(|rest| rest.get(1..)?.split(['"', '\'']).next()) {
        if value.parse().is_ok_and(|count: usize| count > part.len() / LEAST_ENTRY) {
            return Err(InputError::damaged(format!("a count of {value}")));
        }
    }
    Ok(())
}
