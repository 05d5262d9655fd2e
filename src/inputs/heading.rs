//! Headings: names and units.

use crate::units::{Quantity, Unit};

#[derive(Debug, Clone, PartialEq)]
pub struct Heading {
    /// Text in the file.
    pub text: String,
    /// Letters and digits in lower case, joined by underscores: `pga` of `PGA [g]` and of `pga_g`.
    pub name: String,
    /// Unit in brackets or at its end.
    pub unit: Option<Unit>,
    /// Whether a number stands before the unit, which then is not known: `acc (x10 m/s2)`.
    pub is_scaled: bool,
    /// Whether it has a percent sign that is not part of a unit.
    pub is_percent: bool,
}

/// What a text in brackets or at the end of a heading says of a unit.
enum Said {
    Unit(Unit),
    /// A unit with a number before it.
    Scaled,
}

impl Heading {
    pub fn new(text: &str) -> Heading {
        let found = in_brackets(text).or_else(|| at_end(text));
        let (name, said) = found.map_or((text.to_string(), None), |(name, said)| (name, Some(said)));
        let words = name.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
        let unit = match said {
            Some(Said::Unit(unit)) => Some(unit),
            _ => None,
        };
        Heading {
            text: text.to_string(),
            name: words.collect::<Vec<_>>().join("_").to_lowercase(),
            unit,
            is_scaled: matches!(said, Some(Said::Scaled)),
            is_percent: unit.is_none() && text.contains('%'),
        }
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
/// explain one, such as `(g = 9.81 m/s2)`.
fn in_brackets(text: &str) -> Option<(String, Said)> {
    let mut groups = Vec::new();
    for (start, sign) in text.char_indices().filter(|(at, sign)| matches!(sign, '(' | '[') && *at > 0) {
        let close = if sign == '(' { ')' } else { ']' };
        let end = text[start..].find(close).map_or(text.len(), |end| start + end);
        groups.push((start, end));
    }
    let without = |&(start, end): &(usize, usize)| {
        text[..start].to_string() + " " + text.get(end + 1..).unwrap_or_default()
    };
    let inside = |&(start, end): &(usize, usize)| text[start + 1..end].trim();
    let plain = groups.iter().rev().find_map(|group| Some((without(group), Unit::parse(inside(group))?)));
    plain
        .map(|(name, unit)| (name, Said::Unit(unit)))
        .or_else(|| groups.iter().rev().find_map(|group| Some((without(group), explained(inside(group))?))))
}

/// The beginning of a heading, and the unit at its end; what stands in brackets is no end.
fn at_end(text: &str) -> Option<(String, Said)> {
    let last = text.rfind([')', ']']).map_or(0, |at| at + 1);
    let mut ends = text.match_indices([' ', '_', ',']).filter(|(at, _)| *at >= last.max(1));
    ends.find_map(|(at, _)| {
        let end = text[at + 1..].trim_matches(['(', ')', '[', ']', ' ']);
        let is_told = end.contains('=') || end.starts_with(['x', 'X', '\u{d7}', '*']);
        let said = Unit::parse(end).map(Said::Unit).or_else(|| explained(end).filter(|_| is_told));
        Some((text[..at].to_string(), said?))
    })
}

/// What a text says of a unit: `g = 9.81 m/s2`, `gravity, 1g = 980.5 cm/s/s`, `in g`, `x10 m/s2`.
fn explained(text: &str) -> Option<Said> {
    if let Some((left, _)) = text.split_once('=') {
        let mut words = left.split([' ', ',', ';']).filter(|word| !matches!(*word, "" | "in" | "1"));
        let unit = |word: &str| Unit::parse(word.strip_prefix('1').unwrap_or(word));
        return words.find_map(unit).filter(|unit| unit.quantity != Quantity::Time).map(Said::Unit);
    }
    let words = text.trim_start_matches("units of ").trim_start_matches("unit: ").trim_start_matches("in ");
    if let Some(unit) = Unit::parse(words) {
        return Some(Said::Unit(unit));
    }
    let is_factor = |sign: char| sign.is_ascii_digit() || "xX\u{d7}*.^+-eE/ ".contains(sign);
    let unit = text.trim_start_matches(is_factor);
    let factor = text[..text.len() - unit.len()].trim();
    let known = Unit::parse(unit).filter(|_| factor.contains(|sign: char| sign.is_ascii_digit()))?;
    let is_size = matches!(known.quantity, Quantity::Acceleration | Quantity::Velocity | Quantity::Length);
    is_size.then_some(if factor == "1" { Said::Unit(known) } else { Said::Scaled })
}
