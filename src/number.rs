//! Numbers and tables as a person reads them: significant digits with their zeros (0.30), commas between
//! thousands (27,000), limits in brackets, columns in line.

use std::borrow::Cow;
use std::fmt::Display;
use std::path::Path;

pub use crate::statistics::Limited;

/// Writes a number with this many decimals.
pub fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    // What rounds to zero has no sign.
    let is_zero = text.bytes().all(|byte| b"-0.".contains(&byte));
    let text = if is_zero { text.trim_start_matches('-') } else { &text };
    let (first, whole) = (usize::from(text.starts_with('-')), text.find('.').unwrap_or(text.len()));
    let with_comma = |(place, sign): (usize, char)| {
        let comma = place > first && place < whole && (whole - place).is_multiple_of(3);
        [comma.then_some(','), Some(sign)].into_iter().flatten()
    };
    text.char_indices().flat_map(with_comma).collect()
}

pub fn count(value: usize) -> String {
    fixed(value as f64, 0)
}

/// Writes a count of things: `1 motion`, `3,500 motions`.
pub fn counted(value: usize, one: &str) -> String {
    format!("{} {one}{}", count(value), if value == 1 { "" } else { "s" })
}

/// Joins the items of a list, the first few by name: `a, b, c and 9 more`.
pub fn listed<T: Display>(items: &[T], named: usize) -> String {
    let first: Vec<String> = items.iter().take(named).map(T::to_string).collect();
    match items.len() - first.len() {
        0 => first.join(", "),
        more => format!("{} and {more} more", first.join(", ")),
    }
}

/// Writes a number as one types it, without zeros at its end.
pub fn plain(value: f64) -> String {
    fixed(value, 6).trim_end_matches('0').trim_end_matches('.').to_string()
}

/// Writes a number with this many significant digits, small and large ones with a power of ten: 2.9e-5.
pub fn significant(value: f64, digits: usize) -> String {
    let text = format!("{value:.*e}", digits - 1);
    let power: i32 = text.split_once('e').map_or(0, |(_, power)| power.parse().unwrap_or(0));
    match power {
        _ if value == 0.0 => "0".to_string(),
        _ if !value.is_finite() => "-".to_string(),
        -3..6 => fixed(value, (digits as i32 - 1 - power).max(0) as usize),
        _ => text,
    }
}

/// Rounds off what a change of unit leaves in the last digits: 1.8 mm are 0.0018 m, not
/// 0.0018000000000000002.
pub fn rounded(value: f64) -> f64 {
    format!("{value:.14e}").parse().unwrap_or(value)
}

/// Writes a length in m, to the centimetre or, where it has them, millimetres.
pub fn length(length_m: f64) -> String {
    let text = fixed(length_m, 3);
    text.strip_suffix('0').unwrap_or(&text).to_string()
}

/// Writes a return period in years with two digits.
pub fn period(years: f64) -> String {
    let unit = 10_f64.powf((years.log10().floor() - 1.0).max(0.0));
    match years {
        _ if years >= 1e9 => "more than 1e9".to_string(),
        _ if years < 10.0 => significant(years, 2),
        _ => fixed((years / unit).round() * unit, 0),
    }
}

/// How the numbers of a kind are written, and their unit.
#[derive(Debug, Clone, Copy)]
pub struct Style {
    number: fn(f64) -> String,
    unit: &'static str,
}

pub const PERCENT: Style = Style { number: in_percent, unit: " %" };
/// A probability in percent, in a column that names the unit.
pub const OF_HUNDRED: Style = Style { number: in_percent, unit: "" };
pub const RATE: Style = Style { number: rate, unit: "" };
pub const TWO_DIGITS: Style = Style { number: |value| significant(value, 2), unit: "" };
pub const THREE_DIGITS: Style = Style { number: |value| significant(value, 3), unit: "" };

fn in_percent(p: f64) -> String {
    match 100.0 * p {
        0.0 => "0".to_string(),
        x if x > 99.9 => ">99.9".to_string(),
        x if x >= 99.0 => fixed(x, 1),
        x if x < 0.001 => "<0.001".to_string(),
        x => significant(x, 2),
    }
}

fn rate(per_year: f64) -> String {
    if per_year == 0.0 { "0".to_string() } else { format!("{per_year:.1e}") }
}

impl Style {
    /// Writes one number: `0.69 %`.
    pub fn one(self, value: f64) -> String {
        (self.number)(value) + self.unit
    }

    fn range(self, low: f64, high: f64) -> String {
        format!("{} to {}", (self.number)(low), self.one(high))
    }

    /// Writes a value without its limits; without a value the limits: `0.50 to 0.98 %`.
    pub fn value(self, of: Limited) -> String {
        match (of.value, of.low, of.high) {
            (Some(value), ..) => self.one(value),
            (None, Some(low), Some(high)) => self.range(low, high),
            _ => "-".to_string(),
        }
    }

    /// Writes the limits of a value, after words that name them: `(95 % limits 0.50 to 0.98 %)`.
    pub fn limits(self, of: Limited, words: &str) -> String {
        let limits = of.low.zip(of.high).filter(|_| of.value.is_some());
        limits.map_or(String::new(), |(low, high)| format!("({words}{})", self.range(low, high)))
    }

    /// Writes the limits of a value alone.
    pub fn span(self, of: Limited) -> String {
        self.limits(of, "").replace(['(', ')'], "")
    }

    pub fn both(self, of: Limited, words: &str) -> String {
        format!("{} {}", self.value(of), self.limits(of, words)).trim_end().to_string()
    }
}

/// Letters of a name, and of any text, that are shown on a line.
const LONGEST_NAME: usize = 100;
pub const LONGEST_TEXT: usize = 1000;

/// Writes a name of the user: the beginning of a long one, as [`shown`].
pub fn name(name: &str) -> Cow<'_, str> {
    shown(name, LONGEST_NAME)
}

/// Whether a letter is none to read: it moves or colours a terminal, turns the letters beside it around, or
/// is no letter of XML.
pub fn is_hidden(letter: char) -> bool {
    letter.is_control()
        || matches!(letter, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}')
        || matches!(letter, '\u{2066}'..='\u{2069}' | '\u{fffe}' | '\u{ffff}')
}

/// Writes a text whose hidden letters, but those `kept`, are escapes as JSON has them: `\u001b`.
pub fn visible<'a>(text: &'a str, kept: &[char]) -> Cow<'a, str> {
    let is_escaped = |letter: char| is_hidden(letter) && !kept.contains(&letter);
    if !text.contains(is_escaped) {
        return Cow::Borrowed(text);
    }
    let letter = |letter: char| match letter {
        '\n' if is_escaped(letter) => "\\n".to_string(),
        _ if is_escaped(letter) => format!("\\u{:04x}", u32::from(letter)),
        _ => letter.to_string(),
    };
    Cow::Owned(text.chars().map(letter).collect())
}

/// Writes a text on one line, cut to this many letters.
pub fn shown(text: &str, most: usize) -> Cow<'_, str> {
    match text.char_indices().nth(most) {
        Some((end, _)) => Cow::Owned(visible(&text[..end], &[]).into_owned() + "..."),
        None => visible(text, &[]),
    }
}

/// Writes a path on one line.
pub fn path(path: &Path) -> String {
    shown(&path.to_string_lossy(), LONGEST_TEXT).into_owned()
}

/// Writes rows of cells as columns in line, those of numbers flush right.
pub fn aligned(rows: &[Vec<String>], is_number: impl Fn(usize) -> bool) -> String {
    let rows: Vec<Vec<Cow<str>>> =
        rows.iter().map(|row| row.iter().map(|cell| shown(cell, LONGEST_TEXT)).collect()).collect();
    let columns = rows.iter().map(Vec::len).max().unwrap_or(0);
    let width = |column: usize| {
        rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for row in &rows {
        let cell = |(column, cell): (usize, &Cow<str>)| match is_number(column) {
            true => format!("{cell:>0$}", widths[column]),
            false => format!("{cell:0$}", widths[column]),
        };
        let cells: Vec<String> = row.iter().enumerate().map(cell).collect();
        text += &format!("{}\n", cells.join("  ").trim_end());
    }
    text
}
