//! Values with their limits and tables as a person reads them, by core's numbers.

use std::borrow::Cow;
use std::path::Path;

pub use rockfrag_core::number::*;
use rockfrag_core::statistics::Interval;
use unicode_width::UnicodeWidthStr;

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

    /// Writes a value without its limits.
    pub fn value(self, of: Interval<Option<f64>>) -> String {
        of.value.map_or("-".to_string(), |value| self.one(value))
    }

    /// Writes the limits of a value behind it, after words that name them: ` (95 % limits 0.50 to 0.98 %)`.
    pub fn limits(self, of: Interval<Option<f64>>, words: &str) -> String {
        let span = self.span(of);
        if span.is_empty() { span } else { format!(" ({words}{span})") }
    }

    /// Writes the limits of a value alone.
    pub fn span(self, of: Interval<Option<f64>>) -> String {
        let limits = of.low.zip(of.high).filter(|_| of.value.is_some());
        limits.map_or(String::new(), |(low, high)| format!("{} to {}", (self.number)(low), self.one(high)))
    }

    pub fn both(self, of: Interval<Option<f64>>, words: &str) -> String {
        self.value(of) + &self.limits(of, words)
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
    let width = |column: usize| rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.width()).max();
    let widths: Vec<usize> = (0..columns).map(|column| width(column).unwrap_or(0)).collect();
    let mut text = String::new();
    for row in &rows {
        let cell = |(column, cell): (usize, &Cow<str>)| {
            // Some letters are two columns of a terminal wide.
            let room = " ".repeat(widths[column] - cell.width());
            if is_number(column) { room + cell } else { cell.to_string() + &room }
        };
        let cells: Vec<String> = row.iter().enumerate().map(cell).collect();
        text += &format!("{}\n", cells.join("  ").trim_end());
    }
    text
}
