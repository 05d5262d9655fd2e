//! Headings: names and units.

use rockfrag_core::units::{Quantity::*, Unit};

use super::words::{are_known, joined, normal};

/// The longest text that may say a unit: a search for one in every part of a long line would not end.
const LONGEST: usize = 100;

/// Signs before a factor.
const TIMES: [char; 4] = ['x', 'X', '\u{d7}', '*'];

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
        let plain = normal(text);
        let (bare, unit, is_scaled) = match in_brackets(&plain).or_else(|| at_end(&plain)) {
            Some((bare, unit)) => (bare, unit, unit.is_none()),
            None => (plain.to_string(), None, false),
        };
        // That behind a number is of a fractile: 16 %.
        let is_of_number = |at: usize| plain[..at].trim_end().ends_with(|sign: char| sign.is_ascii_digit());
        let is_percent = unit.is_none() && plain.match_indices('%').any(|(at, _)| !is_of_number(at));
        Heading { text: text.to_string(), name: joined(&bare), bare, unit, is_scaled, is_percent }
    }

    /// A heading in several rows, of which the unit may stand in any: `Dimensions (mm) / W`.
    pub fn of_rows(mut rows: Vec<&str>) -> Heading {
        rows.retain(|row| !row.is_empty());
        rows.dedup();
        let parts: Vec<Heading> = rows.iter().map(|row| Heading::new(row)).collect();
        let whole = |of: fn(&Heading) -> &str| parts.iter().map(of).collect::<Vec<_>>().join(" / ");
        let (text, bare) = (whole(|part| &part.text), whole(|part| &part.bare));
        Heading {
            name: joined(&bare),
            unit: parts.iter().rev().find_map(|part| part.unit),
            is_scaled: parts.iter().any(|part| part.is_scaled),
            is_percent: parts.iter().any(|part| part.is_percent),
            text,
            bare,
        }
    }

    /// Three headings in one, `W x D x H (mm)`, of cells such as 600x400x2000; none where it is no such.
    pub fn parted(&self) -> Option<Vec<Heading>> {
        let plain = normal(&self.bare).replace(['*', '\u{d7}'], "x");
        let words: Vec<&str> = plain.split([' ', '(', ')', '/', '[', ']', ':']).collect();
        let joined = words.join(" ").replace(" x ", "x");
        let sides =
            joined.split(' ').map(|word| word.split('x').collect::<Vec<_>>()).find(|of| of.len() == 3)?;
        let heading = |side: &str| Heading {
            text: format!("{}: {side}", self.text),
            ..Heading { unit: self.unit, is_scaled: self.is_scaled, ..Heading::new(side) }
        };
        sides.iter().all(|side| are_known(side)).then(|| sides.iter().map(|side| heading(side)).collect())
    }

    /// A cell without the unit behind its number, if that is the unit of the heading: 40 cm below `Width (cm)`.
    pub fn without_unit<'a>(&self, cell: &'a str) -> &'a str {
        let parted = number_with_unit(cell).filter(|(_, unit)| self.unit == Some(*unit));
        parted.map_or(cell, |(number, _)| number)
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

pub fn number_with_unit(cell: &str) -> Option<(&str, Unit)> {
    let end = cell.trim_end_matches(|sign: char| !sign.is_ascii_digit() && sign != '.').len();
    if end == 0 || end == cell.len() {
        return None;
    }
    Some((cell[..end].trim_end(), Unit::parse(&normal(&cell[end..]))?))
}

/// The rest of a heading, and what brackets in it say: the last that hold a unit alone, else those with one.
fn in_brackets(text: &str) -> Option<(String, Option<Unit>)> {
    let mut explaining = None;
    for (start, sign) in text.char_indices().rev().filter(|(at, sign)| matches!(sign, '(' | '[') && *at > 0) {
        let close = if sign == '(' { ')' } else { ']' };
        let end = text[start..].find(close).map_or(text.len(), |end| start + end);
        let inside = Some(text[start + 1..end].trim()).filter(|inside| inside.len() <= LONGEST);
        let bare = || text[..start].to_string() + " " + text.get(end + 1..).unwrap_or_default();
        match (inside.and_then(Unit::parse), inside.and_then(explained)) {
            (Some(unit), _) => return Some((bare(), Some(unit).filter(|_| !is_factor(text.get(end + 1..))))),
            (None, Some(unit)) => explaining = explaining.or_else(|| Some((bare(), unit))),
            (None, None) => {}
        }
    }
    explaining
}

/// The beginning of a heading, and the unit at its end, where letters of another script or a word end too;
/// what stands in brackets is no end.
fn at_end(text: &str) -> Option<(String, Option<Unit>)> {
    let last = text.rfind([')', ']']).map_or(0, |at| at + 1);
    let first = last.max(1).max(text.len().saturating_sub(LONGEST));
    let signs =
        text.char_indices().zip(text.chars().skip(1)).filter(|((at, sign), _)| at + sign.len_utf8() > first);
    let ends = signs.filter_map(|((at, sign), next)| match sign {
        ' ' | '_' | ',' | '/' => Some((at, at + 1)),
        _ if next == '"' || !sign.is_ascii() && next.is_ascii_alphabetic() => {
            Some(at + sign.len_utf8()).map(|end| (end, end))
        }
        _ => None,
    });
    ends.into_iter().find_map(|(at, start)| {
        let end = text[start..].trim_matches(['(', ')', '[', ']', ' ']);
        let is_told = end.contains('=') || end.starts_with(TIMES);
        let unit = Unit::parse(end.strip_prefix("in ").unwrap_or(end));
        let said = unit.map(Some).or_else(|| explained(end).filter(|_| is_told));
        Some((text[..at].to_string(), said?))
    })
}

/// Whether a text is a factor: ` x 10`.
fn is_factor(text: Option<&str>) -> bool {
    let text = text.unwrap_or_default().trim();
    text.starts_with(TIMES) && text.ends_with(|sign: char| sign.is_ascii_digit())
}

/// What a text says of a unit: `in g`; none where a number stands beside it: `x10 m/s2`, `g = 9.81 m/s2`.
fn explained(text: &str) -> Option<Option<Unit>> {
    let words = text.trim_start_matches("units of ").trim_start_matches("unit: ").trim_start_matches("in ");
    if let Some(unit) = Unit::parse(words) {
        return Some(Some(unit));
    }
    let is_digit = |sign: char| sign.is_ascii_digit();
    let (left, is_told) =
        text.split_once('=').map_or((text, text.contains(is_digit)), |(left, _)| (left, true));
    let is_size = |word: &str| {
        let unit =
            Unit::parse(word.trim_start_matches(|sign: char| is_digit(sign) || "x\u{d7}*.".contains(sign)));
        unit.is_some_and(|unit| matches!(unit.quantity, Acceleration | Velocity | Length))
    };
    (is_told && left.split([' ', ',', ';']).any(is_size)).then_some(None)
}
