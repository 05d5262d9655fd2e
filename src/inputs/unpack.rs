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

/// A file, or one of an archive.
#[derive(Debug, Clone, PartialEq)]
pub struct Member {
    /// Name within an archive; none of a file that is no archive.
    pub name: Option<String>,
    /// Bytes, unpacked.
    pub bytes: Vec<u8>,
}

/// Returns the files in an archive, or the bytes themselves, unpacked. A workbook stays as it is.
pub fn unpack(bytes: Vec<u8>) -> Result<Vec<Member>> {
    unpack_up_to(usize::MAX, bytes)
}

/// Returns the only file in an archive, or the bytes themselves, unpacked.
pub fn unpack_one(bytes: Vec<u8>) -> Result<Vec<u8>> {
    let only = unpack_up_to(1, bytes)?.pop();
    only.map(|member| member.bytes).ok_or(InputError::Members { found: Vec::new() })
}

fn unpack_up_to(most: usize, bytes: Vec<u8>) -> Result<Vec<Member>> {
    let mut left = LARGEST;
    let mut members = Vec::new();
    if bytes.starts_with(b"\xd0\xcf\x11\xe0") {
        expect_workbook(&String::from_utf8_lossy(&bytes))?;
    }
    let is_archive = bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06");
    let zipped = if is_archive { zipped(&bytes, most, &mut left)? } else { None };
    for Member { name, mut bytes } in zipped.unwrap_or_else(|| vec![Member { name: None, bytes }]) {
        if bytes.starts_with(b"\x1f\x8b") {
            bytes = read(MultiGzDecoder::new(bytes.as_slice()), &mut left)?;
        }
        match bytes.get(257..262) {
            Some(b"ustar") => members.extend(tarred(&bytes, &mut left)?),
            _ => members.push(Member { name, bytes }),
        }
    }
    expect_few(most, members.iter().filter_map(|one| one.name.as_ref()))?;
    Ok(members)
}

fn expect_few<'a>(most: usize, names: impl Iterator<Item = &'a String>) -> Result<()> {
    let found: Vec<String> = names.cloned().collect();
    if found.len() > most { Err(InputError::Members { found }) } else { Ok(()) }
}

/// Reads the files of a zip archive; none of a workbook, whose parts must be small all the same.
fn zipped(bytes: &[u8], most: usize, left: &mut u64) -> Result<Option<Vec<Member>>> {
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(InputError::damaged)?;
    let is_workbook = archive.file_names().any(|name| matches!(name, "[Content_Types].xml" | "mimetype"));
    let names = (0..archive.len()).filter_map(|at| Some((archive.name_for_index(at)?.to_string(), at)));
    let is_file = |name: &str| match is_workbook {
        true => !name.split('/').any(|part| matches!(part, "media" | "Pictures")),
        false => is_meant(name),
    };
    let mut files: Vec<(String, usize)> = names.filter(|(name, _)| is_file(name)).collect();
    files.sort();
    expect_few(if is_workbook { usize::MAX } else { most }, files.iter().map(|(name, _)| name))?;
    let mut members = Vec::new();
    for (name, at) in files {
        expect_workbook(&name)?;
        let bytes = read(archive.by_index(at).map_err(InputError::damaged)?, left)?;
        match is_workbook {
            true => expect_true_counts(&bytes)?,
            false => members.push(Member { name: Some(name), bytes }),
        }
    }
    Ok((!is_workbook).then_some(members))
}

fn tarred(bytes: &[u8], left: &mut u64) -> Result<Vec<Member>> {
    let mut members = Vec::new();
    for entry in tar::Archive::new(bytes).entries().map_err(InputError::damaged)? {
        let entry = entry.map_err(InputError::damaged)?;
        let name = String::from_utf8_lossy(&entry.path_bytes()).into_owned();
        if entry.header().entry_type().is_file() && is_meant(&name) {
            members.push(Member { bytes: read(entry, left)?, name: Some(name) });
        }
    }
    members.sort_by(|one, other| one.name.cmp(&other.name));
    Ok(members)
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
    for name in [" uniqueCount=", " si="] {
        for (at, _) in text.match_indices(name) {
            let value = text[at + name.len()..].trim_start_matches(['"', '\'']);
            let digits = value.split(|sign: char| !sign.is_ascii_digit()).next().unwrap_or_default();
            if digits.parse().is_ok_and(|count: usize| count > part.len() / LEAST_ENTRY) {
                return Err(InputError::damaged(format!("{}{digits}", name.trim())));
            }
        }
    }
    Ok(())
}
