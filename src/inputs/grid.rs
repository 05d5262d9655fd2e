//! A table: cells under headings, as people and agencies write it.

use std::borrow::Cow;
use std::path::Path;

use csv::{ReaderBuilder, StringRecord, Trim};

use super::decode::decode;
use super::error::InputError;
use super::heading::Heading;
use super::numbers::{self, Evidence, Style, is_missing, is_number};
use super::unpack::{Member, unpack};
use super::workbook;
use crate::source;
use crate::units::Unit;

/// Rows at the end of a table that show how it is written.
const SHOWN: usize = 400;

/// Rows of cells under headings.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// Comments, and lines above the heading.
    pub notes: Vec<String>,
    /// One for each column; empty without a heading line.
    pub headings: Vec<Heading>,
    pub columns: usize,
    /// Line of each row in the file, from 1.
    pub lines: Vec<usize>,
    rows: Vec<StringRecord>,
    styles: Vec<Style>,
}

/// A row of a file, before it is known what it is.
struct Row {
    line: usize,
    cells: StringRecord,
    is_comment: bool,
}

/// The rows of a file.
struct Rows {
    rows: Vec<Row>,
    /// All lines as they stand in the file.
    lines: Vec<String>,
    /// What stands between cells; none in a workbook.
    separator: Option<char>,
}

impl Grid {
    /// Reads the table in a file, or in a sheet of a workbook: `list.xlsx#Sheet2`.
    pub fn read(path: &Path) -> Result<Grid, InputError> {
        let (file, sheet) = source::split_sheet(path);
        let bytes =
            source::read(&file).map_err(|error| InputError::Unreadable(error.kind(), error.to_string()))?;
        Grid::parse(&bytes, sheet.as_deref())
    }

    /// Reads a table, packed or not: text, or a sheet of a workbook.
    pub fn parse(bytes: &[u8], sheet: Option<&str>) -> Result<Grid, InputError> {
        let members = unpack(bytes.to_vec())?;
        let [Member { bytes, .. }] = &members[..] else {
            let found = members.into_iter().filter_map(|member| member.name).collect();
            return Err(InputError::Members { found });
        };
        if workbook::is_workbook(bytes) {
            let (first, cells) = workbook::cells(bytes, sheet)?;
            return Grid::new(Rows::of_sheet(first, cells));
        }
        Grid::new(Rows::of_text(&decode(bytes)?)?)
    }

    /// Finds headings, units and comments. The heading is the row above the numbers, or first of them, that
    /// has the most words where others have numbers; a comment needs as many cells as a row.
    fn new(file: Rows) -> Result<Grid, InputError> {
        let Rows { rows, lines, separator } = file;
        let is_number_column = number_columns(&rows);
        let width = is_number_column.len();
        let words = |row: &Row| words(row, &is_number_column);
        let is_heading = |row: &Row| {
            let cells = row.cells.len();
            let is_whole = match row.is_comment || separator == Some(' ') {
                true => cells == width,
                false => cells >= width.min(2),
            };
            is_whole && words(row) > 0 && !is_units(row)
        };
        let first = rows.iter().position(|row| !row.is_comment && is_data(row, &is_number_column));
        let above = &rows[..first.map_or(rows.len(), |first| first + 1)];
        // Of equal rows the last one is that above the numbers; without numbers, all but the first are rows.
        let candidates = above.iter().enumerate().filter(|(_, row)| is_heading(row));
        let heading = match is_number_column.contains(&true) {
            true => candidates.max_by_key(|(_, row)| words(row)),
            false => candidates.rev().max_by_key(|(_, row)| words(row)),
        };
        let mut headings: Vec<Heading> =
            heading.map_or(Vec::new(), |(_, row)| row.cells.iter().map(heading_of).collect());
        let mut end = heading.map_or(first.unwrap_or(0), |(at, _)| at + 1);
        while let Some(units) = rows.get(end).filter(|row| !headings.is_empty() && is_units(row)) {
            headings = with_units(&headings, units)?;
            end += 1;
        }
        let columns = if headings.is_empty() { width } else { headings.len() };
        let is_named = separator.is_none_or(|separator| separator != ' ')
            && columns > 1
            && is_number_column.first().is_some_and(|is_number| !is_number);
        // An object may be called #2.
        let is_row =
            |row: &Row| !is_ruler(row) && (!row.is_comment || is_named && row.cells.len() == columns);
        let below = end;
        let note = |(at, row): (usize, &Row)| {
            let is_note = heading.is_none_or(|(heading, _)| heading != at) && (at < below || !is_row(row));
            is_note.then(|| lines.get(row.line - 1).cloned()).flatten()
        };
        let notes = rows.iter().enumerate().filter_map(note).collect();
        let kept: Vec<Row> = rows.into_iter().skip(end).filter(is_row).collect();
        let is_long = |row: &&Row| row.cells.iter().skip(columns).any(|cell| !cell.is_empty());
        if let Some(row) = kept.iter().find(is_long) {
            let found = row.cells.len();
            return Err(InputError::Cells { line: row.line, found, expected: columns });
        }
        let mut evidence = vec![Evidence::default(); columns];
        for row in &kept {
            evidence.iter_mut().zip(&row.cells).for_each(|(column, cell)| column.add(cell));
        }
        let styles = numbers::styles(&evidence, separator.is_none());
        let (lines, rows) = kept.into_iter().map(|row| (row.line, row.cells)).unzip();
        Ok(Grid { notes, headings, columns, lines, rows, styles })
    }

    /// Returns the index of the column with one of these names; see [`Heading::name`].
    pub fn column(&self, names: &[&str]) -> Option<usize> {
        self.headings.iter().position(|heading| names.contains(&heading.name.as_str()))
    }

    /// Returns the text of a cell; empty beyond the end of a short row.
    pub fn cell(&self, row: usize, column: usize) -> &str {
        self.rows[row].get(column).unwrap_or_default()
    }

    /// Whether the numbers of a cell are percent.
    pub fn is_percent(&self, row: usize, column: usize) -> bool {
        self.headings.get(column).is_some_and(|heading| heading.is_percent)
            || self.cell(row, column).ends_with('%')
    }

    /// Reads the number in a cell; 10 % is 0.1, also where the heading has the sign.
    pub fn number(&self, row: usize, column: usize) -> Result<f64, InputError> {
        let (cell, style) = (self.cell(row, column), self.styles[column]);
        let size = if self.is_percent(row, column) && !cell.ends_with('%') { 0.01 } else { 1.0 };
        let number = style.number(cell).map(|number| size * number);
        number.ok_or_else(|| match style.is_unclear(cell) {
            true => {
                let (line, heading) = (self.lines[row], self.name_of(column));
                InputError::Thousands { line, heading, found: cell.to_string() }
            }
            false => self.refusal(row, column, "a number"),
        })
    }

    /// Makes the error of a cell with an unexpected value.
    pub fn refusal(&self, row: usize, column: usize, expected: impl Into<String>) -> InputError {
        let found = self.cell(row, column).chars().take(60).collect();
        let (line, heading) = (self.lines[row], self.name_of(column));
        InputError::Cell { line, heading, found, expected: expected.into() }
    }

    /// The headings, for messages.
    pub fn found(&self) -> String {
        let texts: Vec<&str> = self.headings.iter().map(|heading| heading.text.as_str()).collect();
        if texts.is_empty() { "no headings".to_string() } else { format!("headings {}", texts.join(", ")) }
    }

    fn name_of(&self, column: usize) -> String {
        self.headings.get(column).map_or((column + 1).to_string(), |known| known.text.clone())
    }
}

impl Rows {
    fn of_text(text: &str) -> Result<Rows, InputError> {
        let trim = |line: &str| line.trim_matches([' ', '\x0c', '\x1a', '\0']).to_string();
        let lines: Vec<String> = text.lines().map(trim).collect();
        let separator = separator(&lines);
        let joined = joined(&lines, separator);
        let mut reader = ReaderBuilder::new();
        reader.has_headers(false).flexible(true).trim(Trim::All).delimiter(separator as u8);
        let records: Vec<StringRecord> =
            reader.from_reader(joined.as_bytes()).into_records().map_while(Result::ok).collect();
        if let Some(line) = records.last().and_then(|last| never_closed(last, &joined)) {
            return Err(InputError::Quote { line });
        }
        let row = |cells: StringRecord| {
            let line = cells.position().map_or(1, |at| at.line() as usize);
            Row { line, is_comment: lines.get(line - 1).is_some_and(|line| is_comment(line)), cells }
        };
        let filled = |cells: &StringRecord| cells.iter().any(|cell| !cell.is_empty());
        let rows = records.into_iter().filter(filled).map(row).collect();
        Ok(Rows { rows, lines, separator: Some(separator) })
    }

    fn of_sheet(first: usize, cells: Vec<Vec<String>>) -> Rows {
        let blank = std::iter::repeat_n(String::new(), first - 1);
        let lines = blank.chain(cells.iter().map(|row| row.join(" ").trim().to_string())).collect();
        let filled = |(_, cells): &(usize, Vec<String>)| cells.iter().any(|cell| !cell.is_empty());
        let row = |(at, cells): (usize, Vec<String>)| Row {
            line: first + at,
            is_comment: cells.iter().find(|cell| !cell.is_empty()).is_some_and(|cell| is_comment(cell)),
            cells: StringRecord::from(cells),
        };
        let rows = cells.into_iter().enumerate().filter(filled).map(row).collect();
        Rows { rows, lines, separator: None }
    }
}

fn is_comment(line: &str) -> bool {
    ["#", "%", "//"].iter().any(|sign| line.starts_with(sign))
}

/// Removes the sign of a comment.
fn uncommented(text: &str) -> &str {
    if is_comment(text) { text.trim_start_matches(['#', '%', '/', ' ']) } else { text }
}

fn heading_of(cell: &str) -> Heading {
    Heading::new(uncommented(cell))
}

/// Finds what separates cells: what parts most of the last lines, and parts the most of them into numbers.
fn separator(lines: &[String]) -> char {
    let body = lines.iter().rev().filter(|line| !line.is_empty() && !is_comment(line));
    let body: Vec<&String> = body.take(SHOWN).collect();
    let (mut best, mut most) = (' ', -1.0);
    for sign in [';', '\t', ','] {
        let parted = body.iter().filter(|line| is_parted(line, sign)).count();
        let cells =
            || body.iter().flat_map(|line| line.split(sign)).map(|cell| cell.trim_matches([' ', '"']));
        let numbers = cells().filter(|cell| is_number(cell)).count();
        let share = (parted * numbers) as f64 / (body.len() * cells().count()) as f64;
        if 2 * parted >= body.len() && share > most {
            (best, most) = (sign, share);
        }
    }
    best
}

/// Whether `c` separates cells of a line. Among numbers between blanks, a comma is a decimal one.
fn is_parted(line: &str, c: char) -> bool {
    let is_whole = |word: &str| !word.ends_with(',') && is_number(word);
    let are_numbers = || line.contains(' ') && line.split_whitespace().all(is_whole);
    line.split('"').step_by(2).any(|unquoted| unquoted.contains(c)) && !(c == ',' && are_numbers())
}

/// Joins lines for the reader of rows, which counts them.
fn joined(lines: &[String], separator: char) -> String {
    let mut text = String::new();
    for line in lines {
        // Between blanks, a unit in brackets belongs to its heading.
        let words = || {
            let line = uncommented(line).replace(" (", "(").replace(" [", "[");
            line.split_whitespace().collect::<Vec<_>>().join(" ")
        };
        let is_quoted = line.matches('"').count() % 2 == 0;
        text += &match separator {
            ' ' => Cow::Owned(words()),
            _ if is_comment(line) && !is_quoted => Cow::Owned(line.replace('"', "")),
            _ => Cow::Borrowed(line.as_str()),
        };
        // A row with one empty cell keeps the line count.
        text += if line.is_empty() { "\"\"\n" } else { "\n" };
    }
    text
}

/// The line where a quotation mark opens in the last row and never closes.
fn never_closed(last: &StringRecord, text: &str) -> Option<usize> {
    let at = last.position().filter(|_| last.iter().any(|cell| cell.contains('\n')))?;
    let rest = text.get(at.byte() as usize..)?;
    (rest.matches('"').count() % 2 == 1).then_some(at.line() as usize)
}

/// In which columns numbers stand, by the row of the last ones that has the most.
fn number_columns(rows: &[Row]) -> Vec<bool> {
    let numbers = |row: &&Row| row.cells.iter().filter(|cell| is_number(cell)).count();
    let last = rows.iter().rev().filter(|row| !row.is_comment).take(SHOWN);
    let model = last.max_by_key(numbers);
    model.map_or(Vec::new(), |model| model.cells.iter().map(is_number).collect())
}

/// Whether numbers are more than words where numbers are expected.
fn is_data(row: &Row, is_number_column: &[bool]) -> bool {
    let cells = is_number_column.iter().zip(&row.cells).filter(|(is_number, _)| **is_number);
    let cells = cells.map(|(_, cell)| cell).filter(|cell| !is_missing(cell));
    let (numbers, words): (Vec<&str>, Vec<&str>) = cells.partition(|cell| is_number(cell));
    numbers.len() > words.len()
}

/// How many cells have words where numbers are expected, or at all if none are. What begins with a digit is a
/// damaged number.
fn words(row: &Row, is_number_column: &[bool]) -> usize {
    let expects = |at: usize| is_number_column.get(at).is_some_and(|is_number| *is_number);
    let is_anywhere = !is_number_column.contains(&true);
    let is_word = |cell: &str| {
        let start = cell.trim_start_matches(['+', '-', '.', '<', '>', '~', ' ']);
        !is_missing(cell) && !is_number(cell) && !start.starts_with(|sign: char| sign.is_ascii_digit())
    };
    let cells = row.cells.iter().enumerate().filter(|(at, _)| is_anywhere || expects(*at));
    cells.filter(|(_, cell)| is_word(cell)).count()
}

/// Whether a row has units and nothing else.
fn is_units(row: &Row) -> bool {
    const OTHERS: [&str; 8] = ["", "-", "%", "1/yr", "1/year", "1/a", "1/years", "text"];
    let plain = |cell: &str| uncommented(cell).trim_matches(['(', ')', '[', ']', ' ']).to_lowercase();
    let is_known = |cell: &str| Unit::parse(cell).is_some() || cell == "%";
    let cells: Vec<String> = row.cells.iter().map(plain).collect();
    cells.iter().any(|cell| is_known(cell))
        && cells.iter().all(|cell| is_known(cell) || OTHERS.contains(&cell.as_str()))
}

/// Whether a row is a line drawn with signs.
fn is_ruler(row: &Row) -> bool {
    let drawn = |cell: &str| cell.len() > 1 && cell.chars().all(|sign| "-=_+|:".contains(sign));
    row.cells.iter().all(|cell| cell.is_empty() || drawn(cell))
}

/// Headings with the units in a row below.
fn with_units(headings: &[Heading], units: &Row) -> Result<Vec<Heading>, InputError> {
    let with = |(at, heading): (usize, &Heading)| match units.cells.get(at).unwrap_or_default() {
        "" | "-" => Ok(heading.clone()),
        unit => heading
            .with_unit(uncommented(unit))
            .ok_or_else(|| InputError::Units { heading: heading.text.clone(), unit: unit.to_string() }),
    };
    headings.iter().enumerate().map(with).collect()
}
