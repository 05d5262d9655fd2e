//! Numbers of a table: whether points and commas are decimal or stand between thousands, settled once from
//! all cells of all columns.

/// What a sign between digits is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Sign {
    #[default]
    Decimal,
    Thousands,
    /// Nothing in the table tells.
    Unclear,
}

/// How the numbers of a column are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Style {
    point: Sign,
    comma: Sign,
}

/// What the cells of a column show of one sign.
#[derive(Debug, Clone, Copy, Default)]
struct Shown {
    decimal: bool,
    thousands: bool,
    /// One to three digits before it and three behind: it may be either.
    either: bool,
}

/// What the cells of a column show.
#[derive(Debug, Clone, Copy, Default)]
pub struct Evidence {
    point: Shown,
    comma: Shown,
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
                let point_is_last = point > comma;
                self.point.decimal |= point_is_last;
                self.comma.thousands |= point_is_last;
                self.comma.decimal |= !point_is_last;
                self.point.thousands |= !point_is_last;
            }
            (Some(_), None) => self.point.add(digits, '.'),
            (None, Some(_)) => self.comma.add(digits, ','),
        }
    }
}

impl Shown {
    fn add(&mut self, digits: &str, sign: char) {
        let parts: Vec<&str> = digits.split(sign).collect();
        match parts[..] {
            [whole, rest] if rest.len() == 3 && (1..=3).contains(&whole.len()) && whole != "0" => {
                self.either = true;
            }
            [_, _] => self.decimal = true,
            _ => self.thousands = true,
        }
    }
}

/// Settles how each column is written. In a workbook points are decimal.
pub fn styles(columns: &[Evidence], is_workbook: bool) -> Vec<Style> {
    let style = |own: &Evidence| Style {
        point: if is_workbook { Sign::Decimal } else { point(own, columns) },
        comma: comma(own, columns),
    };
    columns.iter().map(style).collect()
}

fn point(own: &Evidence, all: &[Evidence]) -> Sign {
    let by_others = sign(own, |column| column.point, |column| column.comma, all);
    by_others.unwrap_or(if own.hundreds { Sign::Unclear } else { Sign::Decimal })
}

fn comma(own: &Evidence, all: &[Evidence]) -> Sign {
    // 1,029 beside 999 is of a country of decimal points.
    let are_thousands = all.iter().any(|column| column.comma.either && column.hundreds);
    let by_others = sign(own, |column| column.comma, |column| column.point, all);
    by_others.unwrap_or(if are_thousands { Sign::Thousands } else { Sign::Unclear })
}

/// What a sign is in a column, by its cells, else by those of other columns; none where none tells.
fn sign(
    own: &Evidence,
    this: fn(&Evidence) -> Shown,
    other: fn(&Evidence) -> Shown,
    all: &[Evidence],
) -> Option<Sign> {
    let is_decimal = all.iter().any(|column| this(column).decimal);
    let is_thousands = all.iter().any(|column| this(column).thousands || other(column).decimal);
    match this(own) {
        Shown { decimal: true, .. } | Shown { thousands: false, either: false, .. } => Some(Sign::Decimal),
        Shown { thousands: true, .. } => Some(Sign::Thousands),
        _ if own.unparted => Some(Sign::Decimal),
        _ => match (is_decimal, is_thousands) {
            (true, false) if !own.hundreds => Some(Sign::Decimal),
            (false, true) => Some(Sign::Thousands),
            (false, false) => None,
            _ => Some(Sign::Unclear),
        },
    }
}

impl Style {
    /// Reads a number; 10 % is 0.1.
    pub fn number(self, cell: &str) -> Option<f64> {
        let (text, size) = share(cell);
        let is_plain = self.point == Sign::Decimal && !text.contains([',', '\'', ' ']);
        let value = if is_plain { plain(text) } else { self.unparted(text).and_then(|text| plain(&text)) };
        value.map(|value| size * value)
    }

    /// Whether a cell is a number but for a sign that may be decimal or not.
    pub fn is_unclear(self, cell: &str) -> bool {
        let has = |sign: char, known: Sign| known == Sign::Unclear && cell.contains(sign);
        (has('.', self.point) || has(',', self.comma)) && is_number(cell)
    }

    /// The number with a decimal point, without what stands between its thousands.
    fn unparted(self, text: &str) -> Option<String> {
        let mut text = text.to_string();
        for (sign, known) in [('.', self.point), (',', self.comma)] {
            text = match known {
                Sign::Decimal => text,
                Sign::Thousands => without(&text, sign)?,
                Sign::Unclear if text.contains(sign) => return None,
                Sign::Unclear => text,
            };
        }
        let text = without(&without(&text, '\'')?, ' ')?;
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
fn plain(text: &str) -> Option<f64> {
    let value = text.parse().or_else(|_| text.replacen(['d', 'D'], "e", 1).parse());
    value.ok().filter(|value: &f64| value.is_finite())
}
