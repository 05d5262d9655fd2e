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

/// Decodes the bytes of a file: UTF-8, or else Latin-1.
///
/// # Errors
/// If it is empty or binary.
pub fn decode(bytes: &[u8]) -> Result<Cow<'_, str>, RecordFileError> {
    let sample = bytes.get(..SAMPLE).unwrap_or(bytes);
    let control = |byte: &&u8| **byte < b' ' && !matches!(**byte, b'\t' | b'\n' | b'\r' | b'\x0c' | b'\x1a');
    // Single null bytes pad the text of some real headers.
    if sample.iter().filter(control).count() * 50 > sample.len() {
        return Err(RecordFileError::Binary);
    }
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text.strip_prefix('\u{feff}').unwrap_or(text)),
        Err(_) => Cow::Owned(bytes.iter().map(|&byte| char::from(byte)).collect()),
    };
    if text.trim().is_empty() { Err(RecordFileError::Empty) } else { Ok(text) }
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
