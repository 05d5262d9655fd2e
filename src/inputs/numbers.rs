//! Numbers of a table: whether points and commas are decimal or stand between thousands, settled once from
//! all cells of all columns.

use super::heading::Heading;

/// What a sign between digits is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Sign {
    Decimal,
    Thousands,
    /// Nothing in the table tells.
    Unclear,
}

/// How the numbers of a column are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DecimalNotation {
    point: Sign,
    comma: Sign,
    /// Whether numbers below a percent sign may be percent, or shares that a workbook shows as percent.
    pub may_be_shares: bool,
}

/// Where a sign stands: where it is decimal, between thousands, or where it may be either: with one to three
/// digits before it and three behind.
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

/// Cells without a value.
const MISSING: [&str; 12] =
    ["", "-", "--", "\u{2013}", "na", "n/a", "n.a.", "#n/a", "nan", "null", "none", "missing"];

/// Whether a cell says that it has no value.
pub fn is_missing(cell: &str) -> bool {
    MISSING.contains(&cell.trim().to_lowercase().as_str())
}

/// Whether a cell is a number in some country.
pub fn is_number(cell: &str) -> bool {
    use Sign::{Decimal, Thousands};
    let notations = [(Decimal, Decimal), (Thousands, Decimal), (Decimal, Thousands)];
    let notation = |(point, comma)| DecimalNotation { point, comma, may_be_shares: false };
    notations.into_iter().any(|signs| notation(signs).number(cell).is_some())
}

/// Splits a percent sign off.
fn share(cell: &str) -> (&str, f64) {
    cell.strip_suffix('%').map_or((cell, 1.0), |share| (share.trim_end(), 0.01))
}

impl Evidence {
    pub fn under(heading: &Heading) -> Evidence {
        let has_percent = heading.is_percent || heading.unit.is_some_and(|unit| unit.name.contains('%'));
        Evidence { has_percent, ..Evidence::default() }
    }

    /// Adds what a cell shows.
    pub fn add(&mut self, cell: &str) {
        if !cell.contains(|sign: char| sign.is_ascii_digit()) || !is_number(cell) {
            return;
        }
        self.has_percent |= cell.ends_with('%');
        self.largest = self.largest.max(plain_number(cell).unwrap_or(0.0));
        let digits = share(cell).0.trim_start_matches(['+', '-']);
        let digits = digits.split(['e', 'E', 'd', 'D']).next().unwrap_or_default();
        match (digits.rfind('.'), digits.rfind(',')) {
            (None, None) => {
                self.hundreds |= digits.len() == 3;
                self.unparted |= digits.len() > 3 && digits.bytes().all(|digit| digit.is_ascii_digit());
            }
            (Some(point), Some(comma)) => {
                let last = usize::from(comma > point);
                self.signs[last].decimal = true;
                self.signs[1 - last].thousands = true;
            }
            (point, _) => {
                let (at, sign) = if point.is_some() { (0, '.') } else { (1, ',') };
                let seen = &mut self.signs[at];
                match digits.split(sign).collect::<Vec<_>>()[..] {
                    ["0" | "", _] => seen.decimal = true,
                    [whole, rest] if rest.len() == 3 && whole.len() <= 3 => seen.either = true,
                    [_, _] => seen.decimal = true,
                    _ => seen.thousands = true,
                }
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
pub fn notations(columns: &[Evidence], is_workbook: bool) -> Vec<DecimalNotation> {
    let in_any = |is_seen: fn(&Seen, &Evidence) -> bool, at: usize| {
        columns.iter().any(|column| is_seen(&column.signs[at], column))
    };
    let all = [0, 1].map(|at| Seen {
        decimal: in_any(|seen, _| seen.decimal, at),
        thousands: in_any(|seen, _| seen.thousands, at),
        either: in_any(|seen, column| seen.either && column.hundreds, at),
    });
    let notations = columns.iter().map(|own| DecimalNotation {
        point: if is_workbook { Sign::Decimal } else { own.sign(0, &all) },
        comma: own.sign(1, &all),
        may_be_shares: is_workbook && own.has_percent && own.largest > 0.0 && own.largest <= 1.0,
    });
    notations.collect()
}

impl DecimalNotation {
    /// Reads a number; 10 % is 0.1.
    pub fn number(self, cell: &str) -> Option<f64> {
        let (text, size) = share(cell);
        let is_plain = self.point == Sign::Decimal && !text.contains([',', '\'', ' ']);
        let value = if is_plain {
            plain_number(text)
        } else {
            self.unparted(text).and_then(|text| plain_number(&text))
        };
        value.map(|value| size * value)
    }

    /// Whether a cell is a number but for a sign that may be decimal or not.
    pub fn is_unclear(self, cell: &str) -> bool {
        let has_open = self.point == Sign::Unclear && cell.contains('.')
            || self.comma == Sign::Unclear && cell.contains(',');
        has_open && is_number(cell)
    }

    /// The number with a decimal point, without what stands between its thousands.
    fn unparted(self, text: &str) -> Option<String> {
        let mut text = text.to_string();
        for (sign, known) in
            [('.', self.point), (',', self.comma), ('\'', Sign::Thousands), (' ', Sign::Thousands)]
        {
            match known {
                Sign::Thousands => text = without(&text, sign)?,
                Sign::Unclear if text.contains(sign) => return None,
                Sign::Unclear | Sign::Decimal => {}
            }
        }
        Some(text.replacen(',', ".", 1))
    }
}

/// Removes a sign between thousands; none where it stands elsewhere.
fn without(text: &str, sign: char) -> Option<String> {
    if !text.contains(sign) {
        return Some(text.to_string());
    }
    let (start, digits) = text.split_at(text.len() - text.trim_start_matches(['+', '-']).len());
    let end = digits.find(|c: char| !c.is_ascii_digit() && c != sign).unwrap_or(digits.len());
    let (whole, rest) = digits.split_at(end);
    let (first, others) = whole.split_once(sign)?;
    let are_groups = (1..=3).contains(&first.len()) && others.split(sign).all(|group| group.len() == 3);
    (are_groups && !rest.contains(sign)).then(|| format!("{start}{}{rest}", whole.replace(sign, "")))
}

/// Reads a number with a decimal point; Fortran's exponents begin with D.
pub fn plain_number(text: &str) -> Option<f64> {
    let value = text.parse().or_else(|_| text.replacen(['d', 'D'], "e", 1).parse());
    value.ok().filter(|value: &f64| value.is_finite())
}
