//! From the bytes of a file to text: unpacks gzip and archives of zip and tar; decodes UTF-8, UTF-16, Shift
//! JIS and Windows-1252.

use std::borrow::Cow;
use std::io::{Cursor, Read};

use chardetng::{EncodingDetector, Iso2022JpDetection, Utf8Detection};
use encoding_rs::{Encoding, SHIFT_JIS, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};
use flate2::read::MultiGzDecoder;
use zip::ZipArchive;

use super::error::{InputError, Result};

/// The most bytes that a file may unpack to, with all that is in it.
const LARGEST: u64 = 200 << 20;
/// Fewer bytes than an entry of a list takes in a workbook.
const LEAST_ENTRY: usize = 8;

/// What is in files that begin as workbooks do: streams of OLE, and words of the parts of other formats.
const PARTS: [(&str, &str); 7] = [
    ("E\0n\0c\0r\0y\0p\0t\0e\0d\0P\0a\0c\0k\0a\0g\0e\0", "a workbook with a password"),
    ("W\0o\0r\0d\0D\0o\0c\0u\0m\0e\0n\0t\0", "a Word document"),
    ("manifest:encryption-data", "a workbook with a password"),
    ("word/document.xml", "a Word document"),
    ("ppt/presentation.xml", "slides"),
    ("application/vnd.oasis.opendocument.text", "a text document"),
    (".iwa", "a document of Apple's Numbers or Pages"),
];
/// Beginnings of files that are no tables.
const OTHERS: [(&[&[u8]], &str); 4] = [
    (&[b"%PDF"], "a PDF"),
    (&[b"PAR1"], "Parquet"),
    (&[b"\x89HDF"], "HDF5"),
    (&[b"7z\xbc\xaf", b"BZh", b"\xfd7zXZ", b"Rar!", b"\x28\xb5\x2f\xfd"], "packed, but not as zip or gzip"),
];
/// Signs of numbers and units, which do not tell the language.
const SIGNS: &str = "\u{b0}\u{b1}\u{b2}\u{b3}\u{b5}\u{b7}\u{bd}\u{d7}\u{d8}";

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
    let other = PARTS.into_iter().find(|(sign, _)| text.contains(sign));
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

/// Decodes a text; its lines end in `\n`.
pub fn decode(bytes: &[u8]) -> Result<Cow<'_, str>> {
    let is_other = |(starts, _): &&(&[&[u8]], _)| starts.iter().any(|start| bytes.starts_with(start));
    if let Some((_, found)) = OTHERS.iter().find(is_other) {
        return Err(InputError::NoTable { found });
    }
    let (text, ..) = encoding(bytes)?.decode(bytes);
    match (text.trim_start().chars().next(), text.trim_end().chars().next_back()) {
        (Some('<'), Some('>')) => {
            return Err(InputError::NoTable { found: "XML: a web page, or OpenQuake's NRML" });
        }
        (Some('{'), Some('}')) | (Some('['), Some(']')) => {
            return Err(InputError::NoTable { found: "JSON, as of a web service" });
        }
        _ => {}
    }
    Ok(if text.contains('\r') { text.replace("\r\n", "\n").replace('\r', "\n").into() } else { text })
}

/// Finds the encoding by a byte-order mark, by null bytes in every other place, by what is valid, else by
/// the guess of browsers where it is certain.
fn encoding(bytes: &[u8]) -> Result<&'static Encoding> {
    if let Some((encoding, _)) = Encoding::for_bom(bytes) {
        return Ok(encoding);
    }
    let start = &bytes[..bytes.len().min(4096)];
    let zeros = |from| start.iter().skip(from).step_by(2).filter(|byte| **byte == 0).count();
    match (zeros(0), zeros(1)) {
        (even, odd) if odd > start.len() / 5 && even < odd / 10 => return Ok(UTF_16LE),
        (even, odd) if even > start.len() / 5 && odd < even / 10 => return Ok(UTF_16BE),
        _ => {}
    }
    // Some real headers are padded with null bytes.
    if start.iter().filter(|byte| **byte < b'\t').count() > start.len() / 50 {
        return Err(InputError::NoTable { found: "binary data" });
    }
    if std::str::from_utf8(bytes).is_ok() {
        return Ok(UTF_8);
    }
    let mut detector = EncodingDetector::new(Iso2022JpDetection::Deny);
    detector.feed(bytes, true);
    let guess = detector.guess(None, Utf8Detection::Deny);
    let [read, western] = [guess, WINDOWS_1252].map(|encoding| encoding.decode(bytes).0);
    if western.chars().all(|sign| sign.is_ascii() || SIGNS.contains(sign)) {
        return Ok(WINDOWS_1252);
    }
    if guess == SHIFT_JIS || read == western {
        return Ok(guess);
    }
    let found = format!("a text that may be {}, or not", guess.name());
    Err(InputError::unexpected(found, "UTF-8: save it as CSV UTF-8"))
}
