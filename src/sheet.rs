//! Reads tables as people and agencies write them: CSV of any country, or numbers between blanks.

use std::borrow::Cow;

use csv::{ReaderBuilder, StringRecord, Trim};

use crate::units::Unit;

/// An unreadable table. Lines count from 1.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SheetError {
    #[error("binary data; expected text: save a workbook as CSV")]
    Binary,
    #[error("line {line}: {found} cells; expected {expected}: between decimal commas, write semicolons")]
    Cells { line: usize, found: usize, expected: usize },
    #[error("line {line}, column '{heading}': '{found}'; expected {expected}")]
    Cell { line: usize, heading: String, found: String, expected: String },
}

#[derive(Debug, Clone, PartialEq)]
pub struct Heading {
    /// Text in the file.
    pub text: String,
    /// Letters and digits in lower case, joined by underscores: `pga` of `PGA [g]` and of `pga_g`.
    pub name: String,
    /// Unit at its end.
    pub unit: Option<Unit>,
}

impl Heading {
    pub fn of(text: &str) -> Heading {
        let unit = |end: &str| Unit::parse(end[1..].trim_matches(['(', ')', '[', ']', ' ']));
        let mut ends = text.match_indices(['(', '[', ' ', '_', ',']).map(|(at, _)| text.split_at(at));
        let found = ends.find_map(|(name, end)| Some((name, unit(end).filter(|_| !name.is_empty())?)));
        let (name, unit) = found.map_or((text, None), |(name, unit)| (name, Some(unit)));
        let words = name.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
        let name = words.collect::<Vec<_>>().join("_").to_lowercase();
        Heading { text: text.to_string(), name, unit }
    }
}

/// A table: rows of cells under headings.
#[derive(Debug, Clone, PartialEq)]
pub struct Sheet {
    /// Comments, and lines above the heading.
    pub notes: Vec<String>,
    /// One for each column; empty without a heading line.
    pub headings: Vec<Heading>,
    pub columns: usize,
    /// Line of each row in the file, from 1.
    pub lines: Vec<usize>,
    rows: Vec<StringRecord>,
    separator: char,
}

impl Sheet {
    /// Reads a table. Comments begin with `#`, `%` or `//`. The heading is the line with the most cells above
    /// the first row of numbers; a comment needs as many cells as the row with the most numbers.
    pub fn parse(bytes: &[u8]) -> Result<Sheet, SheetError> {
        let text = decode(bytes)?;
        let lines: Vec<&str> = text.lines().map(|line| line.trim_matches([' ', '\x0c', '\x1a'])).collect();
        // The last lines show the separator and the columns of numbers.
        let body = lines.iter().rev().filter(|line| !line.is_empty() && !is_comment(line));
        let body: Vec<&&str> = body.take(400).collect();
        let in_most = |c: &char| 2 * body.iter().filter(|line| is_parted(line, *c)).count() >= body.len();
        let separator = [';', '\t', ','].into_iter().find(in_most).unwrap_or(' ');
        let mut rows = rows(&lines, separator);
        let is_number = |cell: &str| number(cell, separator).is_some();
        let numbers = |(_, row): &&Row| row.iter().filter(|cell| is_number(cell)).count();
        let is_body = |(at, _): &&Row| !is_comment(lines[at - 1]);
        let last = rows.iter().rev().filter(is_body).take(400);
        let (_, model) = last.max_by_key(numbers).cloned().unwrap_or_default();
        let is_data = |(at, row): &Row| {
            let pairs = model.iter().zip(row).filter(|(like, cell)| is_number(like) && !cell.is_empty());
            let (numbers, words): (Vec<_>, Vec<_>) = pairs.partition(|(_, cell)| is_number(cell));
            !is_comment(lines[at - 1]) && numbers.len() > words.len()
        };
        let is_heading = |(at, row): &&Row| match is_comment(lines[at - 1]) || separator == ' ' {
            true => row.len() == model.len(),
            false => row.len() >= model.len().min(2),
        };
        let above = &rows[..rows.iter().position(is_data).unwrap_or(rows.len())];
        let filled = |(_, row): &&Row| row.iter().filter(|cell| !cell.is_empty()).count();
        let heading = above.iter().filter(is_heading).max_by_key(filled);
        let headings = heading.map_or(Vec::new(), |(_, row)| row.iter().map(Heading::of).collect());
        let columns = if headings.is_empty() { model.len() } else { headings.len() };
        let end = heading.or(above.last()).map_or(0, |(at, _)| *at);
        let is_note =
            |(at, line): &(usize, &&str)| at + usize::from(heading.is_some()) < end || is_comment(line);
        let notes = lines.iter().enumerate().filter(is_note).map(|(_, line)| line.to_string()).collect();
        rows.retain(|(at, _)| *at > end && !is_comment(lines[at - 1]));
        let is_long = |(_, row): &&Row| row.iter().skip(columns).any(|cell| !cell.is_empty());
        if let Some((line, row)) = rows.iter().find(is_long) {
            return Err(SheetError::Cells { line: *line, found: row.len(), expected: columns });
        }
        let (lines, rows) = rows.into_iter().unzip();
        Ok(Sheet { notes, headings, columns, lines, rows, separator })
    }

    /// Returns the index of the column with one of these names; see [`Heading::name`].
    pub fn column(&self, names: &[&str]) -> Option<usize> {
        self.headings.iter().position(|heading| names.contains(&heading.name.as_str()))
    }

    /// Returns the text of a cell; empty beyond the end of a short row.
    pub fn cell(&self, row: usize, column: usize) -> &str {
        self.rows[row].get(column).unwrap_or_default()
    }

    /// Reads the number in a cell; 10 % is 0.1.
    pub fn number(&self, row: usize, column: usize) -> Result<f64, SheetError> {
        number(self.cell(row, column), self.separator).ok_or_else(|| self.refusal(row, column, "a number"))
    }

    /// Makes the error of a cell with an unexpected value.
    pub fn refusal(&self, row: usize, column: usize, expected: impl Into<String>) -> SheetError {
        let heading = self.headings.get(column).map_or((column + 1).to_string(), |known| known.text.clone());
        let found = self.cell(row, column).chars().take(60).collect();
        SheetError::Cell { line: self.lines[row], heading, found, expected: expected.into() }
    }
}

fn is_comment(line: &str) -> bool {
    ["#", "%", "//"].iter().any(|sign| line.starts_with(sign))
}

/// Returns whether `c` separates cells of a line. Among numbers between blanks, a comma is a decimal one.
fn is_parted(line: &str, c: char) -> bool {
    let is_number = |word: &str| !word.ends_with(',') && number(word, ' ').is_some();
    let are_numbers = || line.contains(' ') && line.split_whitespace().all(is_number);
    line.split('"').step_by(2).any(|unquoted| unquoted.contains(c)) && !(c == ',' && are_numbers())
}

/// Line of a row in the file, and its cells.
type Row = (usize, StringRecord);

/// Reads the rows of lines that are not empty, without comment signs.
fn rows(lines: &[&str], separator: char) -> Vec<Row> {
    let mut text = String::new();
    let signs = ['#', '%', '/', ' '];
    for &line in lines {
        let line = if is_comment(line) { line.trim_start_matches(signs) } else { line };
        // Between blanks, a unit in brackets belongs to its heading.
        let units = || line.replace(" (", "(").replace(" [", "[");
        let words = |line: String| line.split_whitespace().collect::<Vec<_>>().join(" ");
        text += &if separator == ' ' { Cow::Owned(words(units())) } else { Cow::Borrowed(line) };
        // A row with one empty cell keeps the line count.
        text += if line.is_empty() { "\"\"\n" } else { "\n" };
    }
    let mut reader = ReaderBuilder::new();
    reader.has_headers(false).flexible(true).trim(Trim::All).delimiter(separator as u8);
    let rows = reader.from_reader(text.as_bytes()).into_records().map_while(Result::ok);
    let rows = rows.filter(|row| row.iter().any(|cell| !cell.is_empty()));
    rows.map(|row| (row.position().map_or(0, |at| at.line() as usize), row)).collect()
}

/// Reads a number; its comma is decimal unless commas separate cells.
fn number(cell: &str, separator: char) -> Option<f64> {
    let (text, size) = cell.strip_suffix('%').map_or((cell, 1.0), |share| (share.trim_end(), 0.01));
    let has_comma = separator != ',' && text.contains(',');
    let value = if has_comma { text.replacen(',', ".", 1).parse() } else { text.parse() };
    value.ok().filter(|value: &f64| value.is_finite()).map(|value| size * value)
}

/// Decodes a text in UTF-8 or Latin-1; typographic blanks and minus signs become ASCII.
pub fn decode(bytes: &[u8]) -> Result<Cow<'_, str>, SheetError> {
    // Some real headers are padded with null bytes.
    if bytes.iter().take(4096).filter(|byte| **byte < b'\t').count() > bytes.len().min(4096) / 50 {
        return Err(SheetError::Binary);
    }
    let latin_1 = |_| Cow::Owned(bytes.iter().map(|&byte| char::from(byte)).collect());
    let text = std::str::from_utf8(bytes).map_or_else(latin_1, Cow::Borrowed);
    if text.is_ascii() {
        return Ok(text);
    }
    let text = text.trim_start_matches('\u{feff}').replace('\u{2212}', "-");
    Ok(Cow::Owned(text.replace(['\u{a0}', '\u{2009}', '\u{202f}'], " ")))
}
