//! Decodes text: UTF-8, UTF-16, Shift JIS and Windows-1252.

use std::borrow::Cow;

use chardetng::{EncodingDetector, Iso2022JpDetection, Utf8Detection};
use encoding_rs::{Encoding, SHIFT_JIS, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};

use super::error::{InputError, Result};

/// Beginnings of files that are no tables.
const OTHERS: [(&[&[u8]], &str); 4] = [
    (&[b"%PDF"], "a PDF"),
    (&[b"PAR1"], "Parquet"),
    (&[b"\x89HDF"], "HDF5"),
    (&[b"7z\xbc\xaf", b"BZh", b"\xfd7zXZ", b"Rar!", b"\x28\xb5\x2f\xfd"], "packed, but not as zip or gzip"),
];
/// Signs of numbers and units, which do not tell the language.
const SIGNS: &str = "\u{b0}\u{b1}\u{b2}\u{b3}\u{b5}\u{b7}\u{bd}\u{d7}\u{d8}";

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
