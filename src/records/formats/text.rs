//! From the bytes of a file to numbered lines and words.

use std::borrow::Cow;

use super::error::RecordFileError;

/// Bytes that are looked at to tell text from binary data.
const SAMPLE: usize = 4096;
/// Characters of a line that a message quotes.
const QUOTED: usize = 60;

/// A line and its number, which counts from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Line<'a> {
    pub number: usize,
    /// Without its end.
    pub text: &'a str,
}

/// Splits a text into its lines.
pub fn lines(text: &str) -> impl Iterator<Item = Line<'_>> + Clone {
    text.lines().enumerate().map(|(index, text)| Line { number: index + 1, text })
}

/// How files begin that hold no text, what they are, and what to do.
const ARCHIVES: [(&[u8], &str, &str); 8] = [
    (b"PK\x03\x04", "an Excel workbook or another zip archive", "save it as CSV, or unpack it"),
    (b"\xd0\xcf\x11\xe0", "an old Excel workbook", "save it as CSV"),
    (b"\x1f\x8b", "a gzip archive", "unpack it"),
    (b"\x89HDF", "an HDF5 file", TO_PARQUET),
    (b"\x93NUMPY", "a NumPy array", TO_PARQUET),
    (b"MATLAB 5.0 MAT-file", "a MAT-file of MATLAB", TO_PARQUET),
    (b"MATLAB 7.3 MAT-file", "a MAT-file of MATLAB", TO_PARQUET),
    (b"MS\x03", "miniSEED", TO_PARQUET),
];
/// What to do with files that other programs read.
const TO_PARQUET: &str =
    "write a Parquet file with motion_id, dt_s and acceleration_m_s2 (docs/records.md shows how)";

/// What binary data are that have no sure beginning, and what to do.
fn binary(bytes: &[u8]) -> RecordFileError {
    // Records of miniSEED 2 begin with their number, a quality and a blank.
    let is_miniseed = bytes.first_chunk().is_some_and(|[number @ .., quality, blank]: &[u8; 8]| {
        number.iter().all(u8::is_ascii_digit) && b"DRQM".contains(quality) && *blank == b' '
    });
    // The version of a SAC header stands behind seventy real numbers and six whole ones.
    let version = bytes.get(304..).and_then(<[u8]>::first_chunk);
    let is_sac = version.is_some_and(|&version: &[u8; 4]| {
        matches!(i32::from_le_bytes(version), 6 | 7) || matches!(i32::from_be_bytes(version), 6 | 7)
    });
    let (what, cure) = match (is_miniseed, is_sac) {
        (true, _) => ("miniSEED", TO_PARQUET),
        (_, true) => ("a SAC file", TO_PARQUET),
        _ => ("binary data", "unpack it if it is an archive"),
    };
    RecordFileError::Binary { what, cure }
}

/// Decodes the bytes of a file: UTF-16 or UTF-8 by their marks, else UTF-8, else Latin-1; with plain blanks, signs and
/// line ends.
///
/// # Errors
/// If it is empty or binary.
pub fn decode(bytes: &[u8]) -> Result<Cow<'_, str>, RecordFileError> {
    if let Some((_, what, cure)) = ARCHIVES.iter().find(|(magic, ..)| bytes.starts_with(magic)) {
        return Err(RecordFileError::Binary { what, cure });
    }
    let text = match bytes {
        [0xff, 0xfe, rest @ ..] => Cow::Owned(utf_16(rest, u16::from_le_bytes)),
        [0xfe, 0xff, rest @ ..] => Cow::Owned(utf_16(rest, u16::from_be_bytes)),
        _ => eight_bits(bytes)?,
    };
    let text = plain(text);
    if text.trim().is_empty() { Err(RecordFileError::Empty) } else { Ok(text) }
}

fn utf_16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> String {
    let (pairs, _) = bytes.as_chunks::<2>();
    String::from_utf16_lossy(&pairs.iter().map(|pair| unit(*pair)).collect::<Vec<_>>())
}

fn eight_bits(bytes: &[u8]) -> Result<Cow<'_, str>, RecordFileError> {
    let sample = bytes.get(..SAMPLE).unwrap_or(bytes);
    let control = |byte: &&u8| **byte < b' ' && !matches!(**byte, b'\t' | b'\n' | b'\r' | b'\x0c' | b'\x1a');
    // Single null bytes pad the text of some real headers.
    if sample.iter().filter(control).count() * 50 > sample.len() {
        return Err(binary(bytes));
    }
    Ok(match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text.strip_prefix('\u{feff}').unwrap_or(text)),
        Err(_) => Cow::Owned(bytes.iter().map(|&byte| char::from(byte)).collect()),
    })
}

/// The text with plain blanks for typographic ones, minus signs that numbers have, and line ends where only returns stand.
fn plain(text: Cow<str>) -> Cow<str> {
    let is_blank = |c: char| matches!(c, '\u{a0}' | '\u{2000}'..='\u{200a}' | '\u{202f}');
    let only_returns = text.contains('\r') && !text.contains('\n');
    if !only_returns && (text.is_ascii() || !text.contains(|c| is_blank(c) || c == '\u{2212}')) {
        return text;
    }
    let letter = |c: char| match c {
        '\r' if only_returns => '\n',
        '\u{2212}' => '-',
        c if is_blank(c) => ' ',
        c => c,
    };
    Cow::Owned(text.chars().map(letter).collect())
}

/// Joins the words of a text by single blanks; none if there are no words.
pub fn words(text: &str) -> Option<String> {
    let text = text.split(|c: char| c.is_whitespace() || c == '\0').filter(|word| !word.is_empty());
    let words = text.collect::<Vec<_>>().join(" ");
    (!words.is_empty()).then_some(words)
}

/// Quotes the beginning of a line in a message.
pub fn quoted(text: &str) -> String {
    text.trim().chars().filter(|c| !c.is_control()).take(QUOTED).collect()
}

/// Returns what follows `key` in a text, whatever the case; the key is ASCII.
pub fn after<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    let at =
        text.as_bytes().windows(key.len()).position(|bytes| bytes.eq_ignore_ascii_case(key.as_bytes()))?;
    text.get(at + key.len()..)
}
