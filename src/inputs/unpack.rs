//! Unpacks what is packed: gzip, and zip archives.

use std::io::{Cursor, Read};

use flate2::read::MultiGzDecoder;
use zip::ZipArchive;

use super::error::{InputError, Result};

/// The most bytes that a file may unpack to, with all that is in it.
const LARGEST: u64 = 200 << 20;
/// Fewer bytes than an entry of a list takes in a workbook.
const LEAST_ENTRY: usize = 8;

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
    let is_archive = bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(b"PK\x05\x06");
    let members = if is_archive { members(&bytes, most, &mut left)? } else { None };
    let mut members = members.unwrap_or_else(|| vec![Member { name: None, bytes }]);
    for member in &mut members {
        if member.bytes.starts_with(b"\x1f\x8b") {
            member.bytes = read(MultiGzDecoder::new(member.bytes.as_slice()), &mut left)?;
        }
        if member.bytes.get(257..262) == Some(b"ustar") {
            return Err(InputError::NoTable { found: "a tar archive" });
        }
    }
    Ok(members)
}

/// Reads the files of a zip archive, without those that systems add; none of a workbook, whose parts must be
/// small all the same.
fn members(bytes: &[u8], most: usize, left: &mut u64) -> Result<Option<Vec<Member>>> {
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(InputError::damaged)?;
    let is_workbook = archive.file_names().any(|name| matches!(name, "[Content_Types].xml" | "mimetype"));
    let is_left_out = |part: &str| match is_workbook {
        true => matches!(part, "media" | "Pictures"),
        false => part.starts_with('.') || part == "__MACOSX",
    };
    let names = (0..archive.len()).filter_map(|at| Some((archive.name_for_index(at)?.to_string(), at)));
    let is_file = |name: &str| !name.ends_with(['/', '\\']) && !name.split('/').any(is_left_out);
    let mut files: Vec<(String, usize)> = names.filter(|(name, _)| is_file(name)).collect();
    files.sort();
    if !is_workbook && files.len() > most {
        return Err(InputError::Members { found: files.into_iter().map(|(name, _)| name).collect() });
    }
    let mut members = Vec::new();
    for (name, at) in files {
        let bytes = read(archive.by_index(at).map_err(InputError::damaged)?, left)?;
        match is_workbook {
            true => expect_true_counts(&bytes)?,
            false => members.push(Member { name: Some(name), bytes }),
        }
    }
    Ok((!is_workbook).then_some(members))
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

/// Refuses a part of a workbook with a count or an index for which it is too small: its reader would reserve
/// memory for it.
fn expect_true_counts(part: &[u8]) -> Result<()> {
    let text = String::from_utf8_lossy(part);
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
