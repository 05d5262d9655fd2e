//! Header fields and blocks of numbers, common to several formats.

use rockfrag_core::records::HeaderPga;
use rockfrag_core::units::{Quantity, Unit};

use super::ReadOptions;
use crate::inputs::{InputError, Result, plain_number};

/// Accepted relative difference of a time step from the option.
const SAME_STEP: f64 = 0.01;
const ACCELERATION: &str = "one of acceleration, such as g or cm/s2, or --unit, such as --unit g";

/// Returns the time step (s) that a file says on a line, else the given one, which must not contradict it.
pub fn time_step(found: Option<f64>, options: &ReadOptions, line: usize) -> Result<f64> {
    let expected = "one in the header, a column of times, a comment such as dt = 0.005 s, or --dt 0.005";
    let missing = InputError::missing(line, "time step", expected);
    let dt_s = found.or(options.dt_s).ok_or(missing)?;
    if dt_s <= 0.0 {
        return Err(InputError::value(line, "time step", &format!("{dt_s} s"), "one above 0 s"));
    }
    expect_step(options.dt_s, dt_s, line)
}

pub fn expect_step(given: Option<f64>, dt_s: f64, line: usize) -> Result<f64> {
    let other = given.filter(|given| (dt_s - given).abs() > SAME_STEP * given);
    other.map_or(Ok(dt_s), |given| {
        let (found, given) = (format!("{dt_s} s"), format!("{given} s"));
        Err(InputError::Contradiction { line, field: "time step", found, given })
    })
}

/// Returns the unit at the start of a field, after which more may follow, else the given one; see [`unit`].
pub fn unit_of(Field { line, text }: Field, options: &ReadOptions) -> Result<Unit> {
    let ends = |c: char| c.is_whitespace() || matches!(c, ',' | '(' | ')' | ';');
    let found = Some(text).filter(|text| !text.is_empty()).map(|text| {
        let unit = text.split(ends).next().and_then(Unit::parse);
        unit.ok_or_else(|| InputError::value(line, "unit", text, ACCELERATION))
    });
    unit(found.transpose()?, options, line)
}

/// Returns the unit of acceleration that a file says on a line, else the given one, which must not contradict.
pub fn unit(found: Option<Unit>, options: &ReadOptions, line: usize) -> Result<Unit> {
    let missing = InputError::missing(line, "unit", ACCELERATION);
    let unit = found.or(options.unit).ok_or(missing)?;
    if unit.quantity != Quantity::Acceleration {
        return Err(InputError::value(line, "unit", unit.name, ACCELERATION));
    }
    let other = options.unit.filter(|given| unit.si != given.si);
    other.map_or(Ok(unit), |given| {
        let (found, given) = (unit.name.to_string(), given.name.to_string());
        Err(InputError::Contradiction { line, field: "unit", found, given })
    })
}

/// The text behind a key, and the number of its line.
#[derive(Clone, Copy)]
pub struct Field<'a> {
    pub line: usize,
    pub text: &'a str,
}

/// Finds the first line with text behind a key; without text, and on the last line, where there is none.
pub fn field<'a>(header: &[&'a str], key: &str) -> Field<'a> {
    let texts = header.iter().map(|line| after(line, key).unwrap_or_default().trim());
    let (line, text) = (1..).zip(texts).find(|(_, text)| !text.is_empty()).unwrap_or((header.len(), ""));
    Field { line, text }
}

pub fn label(header: &[&str], keys: &[&str]) -> Option<String> {
    let texts: Vec<&str> = keys.iter().map(|key| field(header, key).text).collect();
    single_spaced(&texts.join(" "))
}

/// Reads the peak acceleration in a text, in a unit of so many m/s2.
pub fn header_pga(text: &str, unit_m_s2: f64) -> Option<HeaderPga> {
    let value = number(text)?.abs();
    let decimals = text.split_once('.').map_or("", |(_, rest)| rest);
    let decimals = decimals.bytes().take_while(u8::is_ascii_digit).take(300).count();
    let rounding = 0.5 * 10f64.powi(-(decimals as i32));
    (value > 0.0).then_some(HeaderPga { m_s2: value * unit_m_s2, rounding_m_s2: rounding * unit_m_s2 })
}

/// Reads the azimuth (degrees clockwise from north) from the name of a component, if it has one.
pub fn azimuth_of(component: &str) -> Option<f64> {
    match component.trim().to_ascii_uppercase().as_str() {
        "N" | "NS" | "N-S" | "NORTH" => Some(0.0),
        "E" | "EW" | "E-W" | "EAST" => Some(90.0),
        "S" => Some(180.0),
        "W" => Some(270.0),
        number => number.parse().ok().filter(|degrees| (0.0..=360.0).contains(degrees)),
    }
}

/// Returns the text after an ASCII `key`, ignoring case.
pub fn after<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    let at =
        text.as_bytes().windows(key.len()).position(|bytes| bytes.eq_ignore_ascii_case(key.as_bytes()))?;
    text.get(at + key.len()..)
}

/// Joins the words of a text by single blanks; none without words.
pub fn single_spaced(text: &str) -> Option<String> {
    let words = text.replace('\0', " ").split_whitespace().collect::<Vec<_>>().join(" ");
    (!words.is_empty()).then_some(words)
}

/// Reads the first number in a text; letters may follow directly (`100Hz`).
pub fn number(text: &str) -> Option<f64> {
    let starts = text.match_indices(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.'));
    starts.map(|(at, _)| &text[at..]).find_map(|text| {
        let end = text.find(|c: char| !c.is_ascii_digit() && !"+-.eEdD".contains(c)).unwrap_or(text.len());
        (1..=end.min(40)).rev().find_map(|end| plain_number(&text[..end]))
    })
}

/// Splits a line into numbers: at blanks, and before a sign that Fortran left no room to separate.
pub fn numbers(line: &str) -> impl Iterator<Item = &str> {
    line.split_whitespace().flat_map(|word| {
        let signs = word.match_indices(['+', '-']).map(|(at, _)| at).filter(|at| *at > 0);
        let ends = signs.filter(|at| !word[..*at].ends_with(['e', 'E', 'd', 'D'])).chain([word.len()]);
        ends.scan(0, |start, end| Some(&word[std::mem::replace(start, end)..end]))
    })
}

/// Reads `announced` samples from the lines after the first `header` ones; `cells` splits a line. Further
/// numbers on the last line are padding.
pub fn samples<'a, I: Iterator<Item = &'a str>>(
    lines: &[&'a str],
    header: usize,
    announced: f64,
    cells: impl Fn(&'a str) -> I,
) -> Result<Vec<f64>> {
    let (mut values, mut on_last_line) = (Vec::new(), 1);
    for (at, line) in lines.iter().enumerate().skip(header) {
        let before = values.len();
        for cell in cells(line) {
            let value = plain_number(cell);
            values.push(value.ok_or_else(|| InputError::value(at + 1, "sample", cell, "a number"))?);
        }
        if values.len() > before {
            on_last_line = values.len() - before;
        }
    }
    let (announced, found) = (announced as u64, values.len());
    if announced < 2 || (found as u64) < announced || found as u64 - announced >= on_last_line as u64 {
        return Err(InputError::Count { announced, found });
    }
    values.truncate(announced as usize);
    Ok(values)
}
