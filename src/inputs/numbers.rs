//! Numbers of a table: whether points and commas are decimal or stand between thousands, settled once from
//! all cells of all columns.

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
pub struct Style {
    point: Sign,
    comma: Sign,
}

/// What the cells of a column show.
#[derive(Debug, Clone, Default)]
pub struct Evidence {
    /// Signs that are decimal, that stand between thousands, and that may do either: one to three digits
    /// before them and three behind.
    decimal: Vec<char>,
    thousands: Vec<char>,
    either: Vec<char>,
    /// A number from 100 to 999 without signs.
    hundreds: bool,
    /// One of four digits or more: thousands are not parted.
    unparted: bool,
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
    let styles = [(Decimal, Decimal), (Thousands, Decimal), (Decimal, Thousands)];
    styles.into_iter().any(|(point, comma)| Style { point, comma }.number(cell).is_some())
}

/// Splits a percent sign off.
fn share(cell: &str) -> (&str, f64) {
    cell.strip_suffix('%').map_or((cell, 1.0), |share| (share.trim_end(), 0.01))
}

impl Evidence {
    /// Adds what a cell shows.
    pub fn add(&mut self, cell: &str) {
        if !cell.contains(|sign: char| sign.is_ascii_digit()) || !is_number(cell) {
            return;
        }
        let digits = share(cell).0.trim_start_matches(['+', '-']);
        let digits = digits.split(['e', 'E', 'd', 'D']).next().unwrap_or_default();
        match (digits.rfind('.'), digits.rfind(',')) {
            (None, None) => {
                self.hundreds |= digits.len() == 3;
                self.unparted |= digits.len() > 3 && digits.bytes().all(|digit| digit.is_ascii_digit());
            }
            (Some(point), Some(comma)) => {
                let (last, before) = if point > comma { ('.', ',') } else { (',', '.') };
                self.decimal.push(last);
                self.thousands.push(before);
            }
            (point, _) => {
                let sign = if point.is_some() { '.' } else { ',' };
                match digits.split(sign).collect::<Vec<_>>()[..] {
                    ["0" | "", _] => self.decimal.push(sign),
                    [whole, rest] if rest.len() == 3 && whole.len() <= 3 => self.either.push(sign),
                    [_, _] => self.decimal.push(sign),
                    _ => self.thousands.push(sign),
                }
            }
        }
    }

    /// What a sign is in this column, by its cells, else by those of others.
    fn sign(&self, sign: char, all: &[Evidence]) -> Sign {
        let other = if sign == '.' { ',' } else { '.' };
        let is_decimal = all.iter().any(|column| column.decimal.contains(&sign));
        let is_thousands =
            all.iter().any(|column| column.thousands.contains(&sign) || column.decimal.contains(&other));
        // 1,029 beside 999 is of a country of decimal points.
        let is_beside_hundreds = all.iter().any(|column| column.either.contains(&sign) && column.hundreds);
        let is_shown = self.either.contains(&sign) || self.thousands.contains(&sign);
        match (is_decimal, is_thousands) {
            _ if self.decimal.contains(&sign) || !is_shown => Sign::Decimal,
            _ if self.thousands.contains(&sign) => Sign::Thousands,
            _ if self.unparted => Sign::Decimal,
            (true, false) if !self.hundreds => Sign::Decimal,
            (false, true) => Sign::Thousands,
            (false, false) if sign == '.' && !self.hundreds => Sign::Decimal,
            (false, false) if sign == ',' && is_beside_hundreds => Sign::Thousands,
            _ => Sign::Unclear,
        }
    }
}

/// Settles how each column is written. In a workbook points are decimal.
pub fn styles(columns: &[Evidence], is_workbook: bool) -> Vec<Style> {
    let styles = columns.iter().map(|own| Style {
        point: if is_workbook { Sign::Decimal } else { own.sign('.', columns) },
        comma: own.sign(',', columns),
    });
    styles.collect()
}

impl Style {
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
