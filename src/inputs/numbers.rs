//! Numbers of a table: whether points and commas are decimal or stand between thousands, settled once from
//! all cells of all columns.

use std::borrow::Cow;

use super::grid::Source;
use super::heading::Heading;
use super::words::{normal, normal_number};

/// What may be decimal or stand between thousands.
const SIGNS: [char; 2] = ['.', ','];

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sign {
    Decimal,
    Thousands,
    /// Nothing in the table tells.
    Unclear,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DecimalNotation {
    /// Of points and of commas.
    signs: [Sign; 2],
    /// Whether numbers below a percent sign may be percent, or shares that a workbook shows as percent.
    pub may_be_shares: bool,
}

/// What cells show of a sign: that it is decimal, between thousands, or that it may be either.
#[derive(Debug, Clone, Copy, Default)]
struct Seen {
    decimal: bool,
    thousands: bool,
    either: bool,
}

/// What the cells of a column show.
#[derive(Debug, Clone, Copy, Default)]
pub struct Evidence {
    /// Of points and of commas.
    signs: [Seen; 2],
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

/// The number in a cell if points are decimal, and if commas are.
fn by_country(cell: &str) -> [Option<f64>; 2] {
    use Sign::{Decimal, Thousands};
    [[Decimal, Thousands], [Thousands, Decimal]]
        .map(|signs| DecimalNotation { signs, may_be_shares: false }.number(cell))
}

/// Whether a cell is a number in some country.
pub fn is_number(cell: &str) -> bool {
    by_country(cell).iter().any(Option::is_some)
}

fn share(cell: &str) -> (&str, f64) {
    cell.strip_suffix('%').map_or((cell, 1.0), |share| (share.trim_end(), 0.01))
}

impl Evidence {
    pub fn under(heading: &Heading) -> Evidence {
        let has_percent = heading.is_percent || heading.unit.is_some_and(|unit| unit.name.contains('%'));
        Evidence { has_percent, ..Evidence::default() }
    }

    pub fn add(&mut self, cell: &str) {
        let by_country = by_country(cell);
        if by_country == [None; 2] {
            return;
        }
        let cell = &*normal(cell);
        self.has_percent |= cell.ends_with('%');
        self.largest = self.largest.max(plain_number(cell).unwrap_or(0.0));
        let [has_point, has_comma] = SIGNS.map(|sign| cell.contains(sign));
        let [point, comma] = &mut self.signs;
        match by_country {
            [Some(_), None] => {
                point.decimal |= has_point;
                comma.thousands |= has_comma;
            }
            [None, _] => {
                comma.decimal |= has_comma;
                point.thousands |= has_point;
            }
            _ if has_point => point.either = true,
            _ if has_comma => comma.either = true,
            _ => {
                let digits = share(cell).0.trim_start_matches(['+', '-']);
                let digits = digits.split(['e', 'E', 'd', 'D']).next().unwrap_or_default();
                self.hundreds |= digits.len() == 3;
                self.unparted |= digits.len() > 3 && digits.bytes().all(|digit| digit.is_ascii_digit());
            }
        }
    }

    /// What a sign is in this column, by its cells, else by those of others.
    fn sign(&self, at: usize, all: &[Seen; 2]) -> Sign {
        let own = self.signs[at];
        match (all[at].decimal, all[at].thousands || all[1 - at].decimal) {
            _ if own.decimal || !(own.either || own.thousands) => Sign::Decimal,
            _ if own.thousands => Sign::Thousands,
            _ if self.unparted => Sign::Decimal,
            (true, false) if !self.hundreds => Sign::Decimal,
            (false, true) => Sign::Thousands,
            (false, false) if at == 0 && !self.hundreds => Sign::Decimal,
            // 1,029 beside 999 is of a country of decimal points.
            (false, false) if at == 1 && all[at].either => Sign::Thousands,
            _ => Sign::Unclear,
        }
    }
}

/// Settles how each column is written. In a workbook points are decimal.
pub fn notations(columns: &[Evidence], source: Source) -> Vec<DecimalNotation> {
    let is_workbook = matches!(source, Source::Xlsx | Source::Workbook);
    let all = [0, 1].map(|at| Seen {
        decimal: columns.iter().any(|column| column.signs[at].decimal),
        thousands: columns.iter().any(|column| column.signs[at].thousands),
        either: columns.iter().any(|column| column.signs[at].either && column.hundreds),
    });
    let notations = columns.iter().map(|own| DecimalNotation {
        signs: [if is_workbook { Sign::Decimal } else { own.sign(0, &all) }, own.sign(1, &all)],
        may_be_shares: source == Source::Workbook
            && own.has_percent
            && own.largest > 0.0
            && own.largest <= 1.0,
    });
    notations.collect()
}

impl DecimalNotation {
    /// Reads a number; 10 % is 0.1.
    pub fn number(self, cell: &str) -> Option<f64> {
        let cell = normal_number(cell)?;
        let (text, size) = share(&cell);
        let mut text = Cow::Borrowed(text);
        let others = [('\'', Sign::Thousands), (' ', Sign::Thousands)];
        for (sign, known) in SIGNS.into_iter().zip(self.signs).chain(others) {
            match known {
                _ if !text.contains(sign) => {}
                Sign::Thousands => text = without(&text, sign)?.into(),
                Sign::Decimal if sign == ',' => text = text.replacen(sign, ".", 1).into(),
                Sign::Decimal => {}
                Sign::Unclear => return None,
            }
        }
        plain_number(&text).map(|value| size * value)
    }

    /// Whether a cell is a number but for a sign that may be decimal or not.
    pub fn is_unclear(self, cell: &str) -> bool {
        let mut signs = SIGNS.into_iter().zip(self.signs);
        signs.any(|(sign, known)| known == Sign::Unclear && cell.contains(sign)) && is_number(cell)
    }
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
