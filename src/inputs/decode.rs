//! Decodes text: UTF-8, UTF-16, Shift JIS or Windows-1252.

use std::borrow::Cow;

use encoding_rs::{Encoding, SHIFT_JIS, UTF_8, UTF_16BE, UTF_16LE, WINDOWS_1252};

use super::error::{InputError, Result};

/// Beginnings of files that are no tables.
const OTHERS: [(&[u8], &str); 8] = [
    (b"%PDF", "a PDF"),
    (b"7z\xbc\xaf", "a 7z archive"),
    (b"BZh", "bzip2"),
    (b"\xfd7zXZ", "xz"),
    (b"Rar!", "a RAR archive"),
    (b"\x28\xb5\x2f\xfd", "Zstandard"),
    (b"PAR1", "Parquet"),
    (b"\x89HDF", "HDF5"),
];

/// Decodes a text: its lines end in `\n`; typographic blanks, minus signs and wide letters become ASCII.
pub fn decode(bytes: &[u8]) -> Result<Cow<'_, str>> {
    if let Some((_, found)) = OTHERS.iter().find(|(start, _)| bytes.starts_with(start)) {
        return Err(InputError::NoTable { found });
    }
    let encoding = encoding(bytes);
    let is_wide = encoding == UTF_16LE || encoding == UTF_16BE;
    // Some real headers are padded with null bytes.
    let start = &bytes[..bytes.len().min(4096)];
    if !is_wide && start.iter().filter(|byte| **byte < b'\t').count() > start.len() / 50 {
        return Err(InputError::NoTable { found: "binary data" });
    }
    let (text, ..) = encoding.decode(bytes);
    let web_page = text.trim_start().get(..9).map(str::to_ascii_lowercase);
    if web_page.is_some_and(|start| start.starts_with("<!doctype") || start.starts_with("<html")) {
        return Err(InputError::NoTable { found: "a web page" });
    }
    let text = if text.contains('\r') { text.replace("\r\n", "\n").replace('\r', "\n").into() } else { text };
    Ok(if text.is_ascii() { text } else { Cow::Owned(text.chars().map(plain).collect()) })
}

/// A typographic blank, minus sign or wide letter in ASCII.
pub(super) fn plain(sign: char) -> char {
    match sign {
        '\u{2212}' => '-',
        '\u{a0}' | '\u{2009}' | '\u{202f}' | '\u{3000}' => ' ',
        '\u{2019}' => '\'',
        // Wide forms of ASCII.
        '\u{ff01}'..='\u{ff5e}' => char::from((u32::from(sign) - 0xfee0) as u8),
        _ => sign,
    }
}

/// Finds the encoding by a byte-order mark, by null bytes in every other place, by what is valid.
fn encoding(bytes: &[u8]) -> &'static Encoding {
    if let Some((encoding, _)) = Encoding::for_bom(bytes) {
        return encoding;
    }
    let start = &bytes[..bytes.len().min(4096)];
    let [even, odd] =
        [0, 1].map(|from| start.iter().skip(from).step_by(2).filter(|byte| **byte == 0).count());
    let most = start.len() / 5;
    if odd > most && even < odd / 10 {
        return UTF_16LE;
    }
    if even > most && odd < even / 10 {
        return UTF_16BE;
    }
    if std::str::from_utf8(bytes).is_ok() {
        return UTF_8;
    }
    // Japanese text has kana, which in Windows-1252 would be rare signs.
    let japanese = SHIFT_JIS.decode_without_bom_handling_and_without_replacement(bytes);
    let is_kana = |sign| matches!(sign, '\u{3041}'..='\u{30fe}');
    if japanese.is_some_and(|text| text.contains(is_kana)) { SHIFT_JIS } else { WINDOWS_1252 }
}
