//! Headings: names and units.

use rockfrag_core::units::{Quantity, Unit};

use super::words::joined;

/// The longest text that may say a unit: a search for one in every part of a long line would not end.
const LONGEST: usize = 100;

#[derive(Debug, Clone, PartialEq)]
pub struct Heading {
    pub text: String,
    /// Letters and digits in lower case, joined by hyphens: `pga` of `PGA [g]` and of `pga_g`.
    pub name: String,
    /// The text without its unit.
    pub bare: String,
    /// Unit in brackets or at its end.
    pub unit: Option<Unit>,
    /// Whether a number stands before the unit, which then is not known: `acc (x10 m/s2)`.
    pub is_scaled: bool,
    /// Whether it has a percent sign that is not part of a unit.
    pub is_percent: bool,
}

impl Heading {
    pub fn new(text: &str) -> Heading {
        let (bare, unit, is_scaled) = match in_brackets(text).or_else(|| at_end(text)) {
            Some((bare, unit)) => (bare, unit, unit.is_none()),
            None => (text.to_string(), None, false),
        };
        // That behind a number is of a fractile: 16 %.
        let is_of_number = |at: usize| text[..at].trim_end().ends_with(|sign: char| sign.is_ascii_digit());
        let is_percent = unit.is_none() && text.match_indices('%').any(|(at, _)| !is_of_number(at));
        Heading { text: text.to_string(), name: joined(&bare), bare, unit, is_scaled, is_percent }
    }

    /// A cell without the unit behind its number, which is that of the heading: 40 cm below `Width (cm)`.
    pub fn without_unit<'a>(&self, cell: &'a str) -> &'a str {
        let end = cell.trim_end_matches(|sign: char| !sign.is_ascii_digit() && sign != '.').len();
        let is_own = |unit: &Unit| (1..cell.len()).contains(&end) && Unit::parse(&cell[end..]) == Some(*unit);
        self.unit.filter(is_own).map_or(cell, |_| cell[..end].trim_end())
    }

    /// The heading with the unit in a cell below it; none where it has another one.
    pub fn with_unit(&self, below: &str) -> Option<Heading> {
        let unit = below.trim_matches(['(', ')', '[', ']', ' ']);
        let both = Heading::new(&format!("{} ({unit})", self.text));
        let is_same = self.unit.is_none_or(|known| Unit::parse(unit).is_none_or(|unit| unit == known));
        let own = self.unit.map_or(both, |_| self.clone());
        let is_percent = own.is_percent || unit == "%";
        is_same.then_some(Heading { text: self.text.clone(), is_percent, ..own })
    }
}

/// The rest of a heading, and what brackets in it say: the last that hold a unit alone, else those that
/// explain one, such as `(g = 9.81 m/s2)`; no unit where a number stands before it.
fn in_brackets(text: &str) -> Option<(String, Option<Unit>)> {
    let mut explaining = None;
    for (start, sign) in text.char_indices().rev().filter(|(at, sign)| matches!(sign, '(' | '[') && *at > 0) {
        let close = if sign == '(' { ')' } else { ']' };
        let end = text[start..].find(close).map_or(text.len(), |end| start + end);
        let inside = Some(text[start + 1..end].trim()).filter(|inside| inside.len() <= LONGEST);
        let bare = || text[..start].to_string() + " " + text.get(end + 1..).unwrap_or_default();
        match (inside.and_then(Unit::parse), inside.and_then(explained)) {
            (Some(unit), _) => return Some((bare(), Some(unit))),
            (None, Some(unit)) => explaining = explaining.or_else(|| Some((bare(), unit))),
            (None, None) => {}
        }
    }
    explaining
}

/// The beginning of a heading, and the unit at its end; what stands in brackets is no end.
fn at_end(text: &str) -> Option<(String, Option<Unit>)> {
    let last = text.rfind([')', ']']).map_or(0, |at| at + 1);
    let first = last.max(1).max(text.len().saturating_sub(LONGEST));
    let mut ends = text.match_indices([' ', '_', ',']).filter(|(at, _)| *at >= first);
    ends.find_map(|(at, _)| {
        let end = text[at + 1..].trim_matches(['(', ')', '[', ']', ' ']);
        let is_told = end.contains('=') || end.starts_with(['x', 'X', '\u{d7}', '*']);
        let said = Unit::parse(end).map(Some).or_else(|| explained(end).filter(|_| is_told));
        Some((text[..at].to_string(), said?))
    })
}

/// What a text says of a unit: `g = 9.81 m/s2`, `gravity, 1g = 980.5 cm/s/s`, `in g`, `x10 m/s2`.
fn explained(text: &str) -> Option<Option<Unit>> {
    if let Some((left, _)) = text.split_once('=') {
        let mut words = left.split([' ', ',', ';']).filter(|word| !matches!(*word, "" | "in" | "1"));
        let unit = words.find_map(|word| Unit::parse(word.strip_prefix('1').unwrap_or(word)));
        return unit.filter(|unit| unit.quantity != Quantity::Time).map(Some);
    }
    let words = text.trim_start_matches("units of ").trim_start_matches("unit: ").trim_start_matches("in ");
    if let Some(unit) = Unit::parse(words) {
        return Some(Some(unit));
    }
    let unit =
        text.trim_start_matches(|sign: char| sign.is_ascii_digit() || "xX\u{d7}*.^+-eE/ ".contains(sign));
    let factor = text[..text.len() - unit.len()].trim();
    let known = Unit::parse(unit).filter(|_| factor.contains(|sign: char| sign.is_ascii_digit()))?;
    let is_size = matches!(known.quantity, Quantity::Acceleration | Quantity::Velocity | Quantity::Length);
    is_size.then_some(Some(known).filter(|_| factor == "1"))
}
