use std::borrow::Cow;

use super::HeaderPga;
use super::error::RecordFileError;
use super::numbers::leading_number;
use super::unit::AccelerationUnit;

/// Bytes that are looked at to tell text from binary data.
const SAMPLE: usize = 4096;
/// The longest time step of a record, s.
const LONGEST_STEP_S: f64 = 10.0;
/// Characters of a line that a message quotes.
const QUOTED: usize = 60;

/// A line and its number, which counts from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Line<'a> {
    /// Which one.
    pub number: usize,
    /// Without its end.
    pub text: &'a str,
}

/// The lines of a text.
pub fn lines(text: &str) -> impl Iterator<Item = Line<'_>> + Clone {
    text.lines().enumerate().map(|(index, text)| Line { number: index + 1, text })
}

/// The text of a file: UTF-8, or else Latin-1.
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

/// Text with single blanks, or nothing if it says nothing.
pub fn words(text: &str) -> Option<String> {
    let text = text.split(|c: char| c.is_whitespace() || c == '\0').filter(|word| !word.is_empty());
    let words = text.collect::<Vec<_>>().join(" ");
    (!words.is_empty()).then_some(words)
}

/// The beginning of a line, for a message.
pub fn quoted(text: &str) -> String {
    text.trim().chars().filter(|c| !c.is_control()).take(QUOTED).collect()
}

/// What follows `key` in a text, whatever the case; the key is ASCII.
pub fn after<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    let at =
        text.as_bytes().windows(key.len()).position(|bytes| bytes.eq_ignore_ascii_case(key.as_bytes()))?;
    text.get(at + key.len()..)
}

/// A time step that can be.
///
/// # Errors
/// If it cannot.
pub fn time_step(dt_s: f64, line: usize) -> Result<f64, RecordFileError> {
    if dt_s > 0.0 && dt_s <= LONGEST_STEP_S {
        Ok(dt_s)
    } else {
        Err(RecordFileError::TimeStep { line, dt_s })
    }
}

/// The peak acceleration at the beginning of a text.
pub fn header_pga(text: &str, unit: AccelerationUnit) -> Option<HeaderPga> {
    let text = text.trim_start();
    let value = leading_number(text)?.abs();
    let digits = text.split(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '+' | '-'))).next()?;
    let decimals = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len().min(300));
    let rounding = 0.5 * libm::exp10(-(decimals as f64));
    let scale = unit.in_m_s2();
    (value > 0.0).then_some(HeaderPga { m_s2: value * scale, rounding_m_s2: rounding * scale })
}

/// The azimuth of a component, degrees clockwise from north, from its name: a number, or a direction of the compass. None
/// of a vertical or unnamed one.
pub fn azimuth_of(component: &str) -> Option<f64> {
    const COMPASS: [(&str, f64); 10] = [
        ("N", 0.0),
        ("NS", 0.0),
        ("N-S", 0.0),
        ("NORTH", 0.0),
        ("E", 90.0),
        ("EW", 90.0),
        ("E-W", 90.0),
        ("EAST", 90.0),
        ("S", 180.0),
        ("W", 270.0),
    ];
    let component = component.trim();
    let compass = COMPASS.iter().find(|(name, _)| name.eq_ignore_ascii_case(component));
    let number = || component.parse().ok().filter(|degrees| (0.0..=360.0).contains(degrees));
    compass.map(|(_, degrees)| *degrees).or_else(number)
}
