//! Numbers of a table: one sign, point or comma, is decimal in all of it; the other stands between thousands.

use std::borrow::Cow;

use super::grid::Source;
use super::heading::Heading;
use super::words::{normal, normal_number};

/// What may be decimal or stand between thousands.
const SIGNS: [char; 2] = ['.', ','];

/// How the numbers of a column are written.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Notation {
    /// None where nothing in the table tells.
    decimal: Option<char>,
    /// Whether numbers below a percent sign may be percent, or shares that a workbook shows as percent.
    pub may_be_shares: bool,
}

/// What the numbers of a column show, if points are decimal and if commas are.
#[derive(Debug, Clone, Copy, Default)]
pub struct Evidence {
    /// Whether all can be read so.
    all: [bool; 2],
    /// Whether one can be read so alone.
    decides: [bool; 2],
    /// Whether one with this sign can be read in both ways: 1,029.
    either: [bool; 2],
    /// A number from 100 to 999 without signs.
    hundreds: bool,
    /// One of four digits or more: thousands are not parted.
    unparted: bool,
    /// A percent sign, in the heading too, and the largest number without one.
    has_percent: bool,
    largest: f64,
}

const MISSING: [&str; 11] = ["", "-", "--", "na", "n/a", "n.a.", "#n/a", "nan", "null", "none", "missing"];

pub fn is_missing(cell: &str) -> bool {
    MISSING.contains(&normal(cell.trim()).to_lowercase().as_str())
}

/// Whether a cell is a number in some country.
pub fn is_number(cell: &str) -> bool {
    SIGNS.iter().any(|decimal| read(cell, *decimal).is_some())
}

impl Evidence {
    pub fn under(heading: &Heading) -> Evidence {
        let has_percent = heading.is_percent || heading.unit.is_some_and(|unit| unit.name.contains('%'));
        Evidence { all: [true; 2], has_percent, ..Evidence::default() }
    }

    pub fn add(&mut self, cell: &str) {
        let can_be = SIGNS.map(|decimal| read(cell, decimal).is_some());
        if can_be == [false; 2] {
            return;
        }
        let cell = &*normal(cell);
        let has = SIGNS.map(|sign| cell.contains(sign));
        for (at, sign) in has.into_iter().enumerate() {
            self.all[at] &= can_be[at];
            self.decides[at] |= !can_be[1 - at];
            self.either[at] |= sign && can_be == [true; 2];
        }
        if has == [false; 2] {
            let digits = share(cell).0.trim_start_matches(['+', '-']);
            let digits = digits.split(['e', 'E', 'd', 'D']).next().unwrap_or_default();
            self.hundreds |= digits.len() == 3;
            self.unparted |= digits.len() > 3 && digits.bytes().all(|digit| digit.is_ascii_digit());
        }
        self.has_percent |= cell.ends_with('%');
        self.largest = self.largest.max(plain_number(cell).unwrap_or(0.0));
    }
}

/// Settles how each column is written: in the way in which all of the table can be read, in a workbook all of the
/// column.
pub fn notations(columns: &[Evidence], source: Source) -> Vec<Notation> {
    let all = [0, 1].map(|at| columns.iter().all(|column| column.all[at]));
    // 1,029 beside 999 is of a country of decimal points.
    let has_points = columns.iter().any(|column| column.either[1] && column.hundreds);
    let is_workbook = matches!(source, Source::Xlsx | Source::Workbook);
    let decimal = |own: &Evidence| match if is_workbook || all == [false; 2] { own.all } else { all } {
        [true, true] if own.either[1] && !has_points => None,
        [false, false] => None,
        [true, _] if is_workbook => Some(0),
        [points, _] => Some(usize::from(!points)).filter(|at| {
            // 1.029 beside 999 may be either; beside 0.999, or 1500, it is not.
            !own.either[*at] || own.decides[*at] || own.unparted || !own.hundreds
        }),
    };
    let notation = |own: &Evidence| Notation {
        decimal: decimal(own).map(|at| SIGNS[at]),
        may_be_shares: source == Source::Workbook
            && own.has_percent
            && own.largest > 0.0
            && own.largest <= 1.0,
    };
    columns.iter().map(notation).collect()
}

impl Notation {
    /// Reads a number; 10 % is 0.1. Where nothing else tells, a cell may still be a number in one way alone.
    pub fn number(self, cell: &str) -> Option<f64> {
        match self.decimal {
            Some(decimal) => read(cell, decimal),
            None => match SIGNS.map(|decimal| read(cell, decimal)) {
                [Some(one), Some(other)] if one != other => None,
                [one, other] => one.or(other),
            },
        }
    }
}

fn share(cell: &str) -> (&str, f64) {
    cell.strip_suffix('%').map_or((cell, 1.0), |share| (share.trim_end(), 0.01))
}

fn read(cell: &str, decimal: char) -> Option<f64> {
    let cell = normal_number(cell)?;
    let (text, size) = share(&cell);
    let mut text = Cow::Borrowed(text);
    for sign in ['.', ',', '\'', ' '].into_iter().filter(|sign| *sign != decimal) {
        if text.contains(sign) {
            text = without(&text, sign)?.into();
        }
    }
    if decimal == ',' {
        text = text.replacen(',', ".", 1).into();
    }
    plain_number(&text).map(|value| size * value)
}

/// Removes a sign between thousands; none where it stands elsewhere.
fn without(text: &str, sign: char) -> Option<String> {
    let (start, digits) = text.split_at(text.len() - text.trim_start_matches(['+', '-']).len());
    let end = digits.find(|c: char| !c.is_ascii_digit() && c != sign).unwrap_or(digits.len());
    let (whole, rest) = digits.split_at(end);
    let (first, others) = whole.split_once(sign)?;
    let are_groups = matches!(first.len(), 1..=3) && others.split(sign).all(|group| group.len() == 3);
    let is_parted = are_groups && !first.starts_with('0') && !rest.contains(sign);
    is_parted.then(|| format!("{start}{}{rest}", whole.replace(sign, "")))
}

/// Reads a number with a decimal point; Fortran's exponents begin with D.
pub fn plain_number(text: &str) -> Option<f64> {
    let value = text.parse().or_else(|_| text.replacen(['d', 'D'], "e", 1).parse());
    value.ok().filter(|value: &f64| value.is_finite())
}
