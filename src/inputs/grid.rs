//! A table: cells under headings, as people and agencies write it.

use std::ops::Range;
use std::path::Path;

use csv::{ReaderBuilder, StringRecord, Trim};
use rockfrag_core::plausibility::range_of_column;
use rockfrag_core::units::Unit;

use super::decode::decode;
use super::error::{InputError, PERCENT, Result, THOUSANDS, expect_few_cells};
use super::heading::Heading;
use super::numbers::{self, DecimalNotation, Evidence, is_missing, is_number};
use super::reading::{ColumnReading, Meaning, Reading};
use super::unpack::unpack_one;
use super::words::synonyms;
use super::workbook;
use crate::number::{counted, rounded};
use crate::source;

/// Rows at the end of a table that show how it is written.
const SHOWN: usize = 400;
/// Numbers below this stand for what is not known.
const UNKNOWN: f64 = -99.0;

/// Rows of cells under headings.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    /// Comments, and lines above the heading.
    pub notes: Vec<String>,
    /// One for each column, without a text where there is no heading line.
    pub headings: Vec<Heading>,
    pub has_headings: bool,
    /// Line of each row in the file, from 1.
    pub lines: Vec<usize>,
    rows: Vec<StringRecord>,
    notations: Vec<DecimalNotation>,
    /// Columns that the user leaves out.
    ignored: Vec<ColumnReading>,
}

/// A row of a file, before it is known what it is.
struct RawRow {
    line: usize,
    cells: StringRecord,
    is_comment: bool,
}

impl Grid {
    /// Reads the table in a file, or in a sheet of a workbook: `list.xlsx#Sheet2`.
    pub fn read(path: &Path) -> Result<Grid> {
        let (file, sheet) = source::split_sheet(path);
        let bytes =
            source::read(&file).map_err(|error| InputError::Unreadable(error.kind(), error.to_string()))?;
        Grid::parse(&bytes, sheet.as_deref())
    }

    /// Reads a table, packed or not: text, or a sheet of a workbook.
    pub fn parse(bytes: &[u8], sheet: Option<&str>) -> Result<Grid> {
        let bytes = unpack_one(bytes.to_vec())?;
        if workbook::is_workbook(&bytes) {
            let sheet = workbook::cells(&bytes, sheet)?;
            let first = sheet.start().map_or(1, |(row, _)| row as usize + 1);
            return Grid::new(rows_of_cells(first, sheet.rows()), None);
        }
        let text = decode(&bytes)?;
        let lines: Vec<&str> =
            text.lines().map(|line| line.trim_matches([' ', '\x0c', '\x1a', '\0'])).collect();
        let separator = separator(&lines);
        Grid::new(rows_of_text(&lines, separator)?, Some(separator))
    }

    /// Takes a table whose cells have points for decimals, as those of a workbook.
    pub fn from_cells(rows: &[Vec<String>]) -> Result<Grid> {
        expect_few_cells(rows.iter().map(Vec::len).sum())?;
        Grid::new(rows_of_cells(1, rows.iter().map(Vec::as_slice)), None)
    }

    /// Parts headings, units and comments from rows. No `separator` stands between cells of a workbook.
    fn new(rows: Vec<RawRow>, separator: Option<char>) -> Result<Grid> {
        let is_number_column = number_columns(&rows);
        let first = rows.iter().position(|row| !row.is_comment && is_data(row, &is_number_column));
        let above = &rows[..first.map_or(rows.len(), |first| first + 1)];
        let heading = heading_row(above, &is_number_column, separator);
        let mut headings: Vec<Heading> = match heading {
            Some(at) => rows[at].cells.iter().map(|cell| Heading::new(uncommented(cell))).collect(),
            None => vec![Heading::new(""); is_number_column.len()],
        };
        let mut end = heading.map_or(first.unwrap_or(0), |at| at + 1);
        while let Some(units) = rows.get(end).filter(|row| heading.is_some() && is_units(row)) {
            headings = with_units(&headings, units)?;
            end += 1;
        }
        let columns = headings.len();
        // An object may be called #2.
        let are_named = separator != Some(' ') && columns > 1 && is_number_column.first() == Some(&false);
        // Between blanks, a comment above the numbers may have some too: dt 0.01.
        let start = first.filter(|_| separator == Some(' ')).unwrap_or(end);
        let is_row = |at: usize, cells: &StringRecord| {
            are_named && cells.len() == columns || at >= start && has_numbers_behind(cells, &is_number_column)
        };
        let mut evidence: Vec<Evidence> = headings.iter().map(Evidence::under).collect();
        let (mut notes, mut lines, mut kept) = (Vec::new(), Vec::new(), Vec::new());
        for (at, RawRow { line, cells, is_comment }) in rows.into_iter().enumerate() {
            if at < end || is_ruler(&cells) || is_comment && !is_row(at, &cells) {
                if heading != Some(at) {
                    let filled: Vec<&str> = cells.iter().filter(|cell| !cell.is_empty()).collect();
                    notes.push(filled.join(if separator == Some(' ') { " " } else { ", " }));
                }
                continue;
            }
            if cells.iter().skip(columns).any(|cell| !cell.is_empty()) {
                return Err(InputError::Cells { line, found: cells.len(), expected: columns });
            }
            let cells = cells.iter().zip(&headings).map(|(cell, heading)| heading.without_unit(cell));
            let cells: StringRecord = cells.collect();
            evidence.iter_mut().zip(&cells).for_each(|(column, cell)| column.add(cell));
            lines.push(line);
            kept.push(cells);
        }
        let notations = numbers::notations(&evidence, separator.is_none());
        Ok(Grid {
            notes,
            headings,
            has_headings: heading.is_some(),
            lines,
            rows: kept,
            notations,
            ignored: Vec::new(),
        })
    }

    pub fn rows(&self) -> Range<usize> {
        0..self.lines.len()
    }

    /// Returns the index of the first column about this; see [`synonyms`].
    pub fn about(&self, meaning: &str) -> Option<usize> {
        synonyms(meaning).find_map(|word| self.headings.iter().position(|heading| heading.name == word))
    }

    /// Returns the text of a cell; empty beyond the end of a short row.
    pub fn cell(&self, row: usize, column: usize) -> &str {
        self.rows[row].get(column).unwrap_or_default()
    }

    /// What a cell says; none where there is nothing to say. An error of a workbook says something.
    pub fn value(&self, row: usize, column: usize) -> Option<&str> {
        Some(self.cell(row, column)).filter(|cell| cell.starts_with('#') || !is_missing(cell))
    }

    /// Whether the cells of a column are texts.
    pub fn is_text(&self, column: usize) -> bool {
        let mut values = self.rows().filter(|row| self.value(*row, column).is_some());
        values.any(|row| self.number(row, column).is_err())
    }

    pub fn is_percent(&self, row: usize, column: usize) -> bool {
        self.headings[column].is_percent || self.cell(row, column).ends_with('%')
    }

    /// Reads the number in a cell; 10 % is 0.1, also where the heading has the sign.
    pub fn number(&self, row: usize, column: usize) -> Result<f64> {
        let (cell, notation) = (self.cell(row, column), self.notations[column]);
        let has_sign = cell.ends_with('%');
        let size = if self.is_percent(row, column) && !has_sign { 0.01 } else { 1.0 };
        let question = match notation.number(cell) {
            Some(_) if notation.may_be_shares && !has_sign => PERCENT,
            Some(number) => return Ok(size * number),
            None if notation.is_unclear(cell) => THOUSANDS,
            None => return Err(self.refusal(row, column, "a number")),
        };
        let (line, heading, found) = (self.lines[row], self.name_of(column), cell.to_string());
        Err(InputError::Unclear { line, heading, found, question })
    }

    pub fn numbers(&self, column: usize) -> Result<Vec<f64>> {
        self.rows().map(|row| self.number(row, column)).collect()
    }

    /// Reads the intensities of a column, in a unit of this size.
    pub fn intensities(&self, column: usize, unit: f64) -> Result<Vec<f64>> {
        let numbers = self.numbers(column)?;
        match numbers.iter().position(|number| *number < 0.0) {
            Some(row) => Err(self.refusal(row, column, "an intensity of 0 or more")),
            None => Ok(numbers.into_iter().map(|number| unit * number).collect()),
        }
    }

    /// Reads the numbers of a column, if there is one, of what a column of this name has in tables; those that
    /// are known: PEER writes -999 for what is not.
    pub fn known(&self, column: Option<usize>, name: &str) -> Result<Vec<Option<f64>>> {
        let (range, expected) = range_of_column(name);
        let numbers = self.rows().map(|row| match column.filter(|at| self.value(row, *at).is_some()) {
            None => Ok(None),
            Some(at) => match self.number(row, at)? {
                ..=UNKNOWN => Ok(None),
                number if range.contains(&number) => Ok(Some(number)),
                _ => Err(self.refusal(row, at, expected)),
            },
        });
        numbers.collect()
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
        match self.has_headings {
            true => format!("headings {}", texts.join(", ")),
            false => format!("{} without headings", counted(texts.len(), "column")),
        }
    }

    /// Takes the columns with these headings out.
    pub fn ignore(&mut self, headings: &[String]) {
        let is_ignored = |at: &usize| headings.contains(&self.headings[*at].text);
        let (ignored, kept): (Vec<usize>, Vec<usize>) = (0..self.headings.len()).partition(is_ignored);
        if ignored.is_empty() {
            return;
        }
        self.ignored = ignored.iter().map(|at| self.column_reading(*at, Meaning::Ignored)).collect();
        self.headings = kept.iter().map(|at| self.headings[*at].clone()).collect();
        self.notations = kept.iter().map(|at| self.notations[*at]).collect();
        for row in &mut self.rows {
            *row = kept.iter().map(|at| row.get(*at).unwrap_or_default()).collect();
        }
    }

    /// How it was read, by the meaning of each column.
    pub fn reading(&self, path: &Path, meanings: Vec<Meaning>) -> Reading {
        let columns = meanings.into_iter().enumerate().map(|(at, of)| self.column_reading(at, of));
        Reading {
            file: path.display().to_string(),
            rows: self.lines.len(),
            columns: columns.chain(self.ignored.iter().cloned()).collect(),
            others: self.notes.clone(),
        }
    }

    fn column_reading(&self, at: usize, meaning: Meaning) -> ColumnReading {
        let heading = &self.headings[at];
        let filled: Vec<usize> = self.rows().filter(|row| self.value(*row, at).is_some()).collect();
        let size = heading.unit.filter(|_| matches!(meaning, Meaning::Known(_))).map_or(1.0, |unit| unit.si);
        let shown = |row: Option<&usize>| {
            let number =
                |row: usize| self.number(row, at).ok().map(|number| rounded(size * number).to_string());
            row.map_or(String::new(), |row| number(*row).unwrap_or_else(|| self.cell(*row, at).to_string()))
        };
        ColumnReading {
            heading: self.name_of(at),
            unit: heading.unit.map(|unit| unit.name.to_string()),
            filled: filled.len(),
            first: shown(filled.first()),
            last: shown(filled.last()),
            meaning,
        }
    }

    fn name_of(&self, column: usize) -> String {
        match self.headings[column].text.as_str() {
            "" => (column + 1).to_string(),
            text => text.to_string(),
        }
    }
}

fn rows_of_text(lines: &[&str], separator: char) -> Result<Vec<RawRow>> {
    let joined = join_lines(lines, separator)?;
    expect_few_cells(joined.matches([separator, '\n']).count())?;
    let mut reader = ReaderBuilder::new();
    reader.has_headers(false).flexible(true).trim(Trim::All).delimiter(separator as u8);
    let records = reader.from_reader(joined.as_bytes()).into_records().map_while(Result::ok);
    let rows = records.filter(|cells| cells.iter().any(|cell| !cell.is_empty())).map(|cells| {
        let line = cells.position().map_or(1, |at| at.line() as usize);
        RawRow { line, is_comment: lines.get(line - 1).is_some_and(|line| is_comment(line)), cells }
    });
    Ok(rows.collect())
}

fn rows_of_cells<'a>(first: usize, rows: impl Iterator<Item = &'a [String]>) -> Vec<RawRow> {
    let rows = (first..).zip(rows).filter(|(_, cells)| cells.iter().any(|cell| !cell.is_empty()));
    rows.map(|(line, cells)| RawRow { line, is_comment: false, cells: cells.iter().collect() }).collect()
}

fn is_comment(line: &str) -> bool {
    ["#", "%", "//"].iter().any(|sign| line.starts_with(sign))
}

fn uncommented(text: &str) -> &str {
    if is_comment(text) { text.trim_start_matches(['#', '%', '/', ' ']) } else { text }
}

/// Finds what separates cells: what parts most of the last lines, and parts the most of them into numbers.
fn separator(lines: &[&str]) -> char {
    let body = lines.iter().rev().filter(|line| !line.is_empty() && !is_comment(line));
    let body: Vec<&str> = body.take(SHOWN).copied().collect();
    let shares = [',', '\t', ';'].map(|sign| {
        let parted = body.iter().filter(|line| is_parted(line, sign)).count();
        let cells: Vec<&str> = body.iter().flat_map(|line| line.split(sign)).collect();
        let numbers = cells.iter().filter(|cell| is_number(cell.trim_matches([' ', '"']))).count();
        let share = (parted * numbers) as f64 / (body.len() * cells.len()) as f64;
        (sign, Some(share).filter(|_| parted > 0 && 2 * parted >= body.len()))
    });
    let shares = shares.into_iter().filter_map(|(sign, share)| Some((sign, share?)));
    shares.max_by(|(_, a), (_, b)| a.total_cmp(b)).map_or(' ', |(sign, _)| sign)
}

/// Whether a sign separates cells of a line. Among numbers between blanks, a comma is a decimal one.
fn is_parted(line: &str, sign: char) -> bool {
    let is_unquoted = line.split('"').step_by(2).any(|unquoted| unquoted.contains(sign));
    let mut words = line.split_whitespace();
    let are_numbers = line.contains(' ') && words.all(|word| !word.ends_with(',') && is_number(word));
    is_unquoted && !(sign == ',' && are_numbers)
}

/// Joins lines for the reader of rows, which counts them.
fn join_lines(lines: &[&str], separator: char) -> Result<String> {
    let (mut text, mut quoted_from) = (String::new(), None);
    for (line, number) in lines.iter().zip(1..) {
        let (start, was_quoted) = (text.len(), quoted_from.is_some());
        if separator == ' ' && !was_quoted {
            // A unit in brackets belongs to its heading, and the sign of a comment to its first word.
            let bare = uncommented(line);
            let words = bare.replace(" (", "(").replace(" [", "[");
            text += line[..line.len() - bare.len()].trim_end();
            text += &words.split_whitespace().collect::<Vec<_>>().join(" ");
        } else {
            text += line;
        }
        let is_quoted = is_quoted_behind(&text[start..], separator, was_quoted);
        if is_quoted && !was_quoted && is_comment(line) {
            text.truncate(start);
            text += &line.replace('"', "");
        } else {
            quoted_from = is_quoted.then_some(quoted_from.unwrap_or(number));
        }
        // A row with one empty cell keeps the line count.
        text += if line.is_empty() && quoted_from.is_none() { "\"\"\n" } else { "\n" };
    }
    let never_closed = quoted_from.filter(|line| lines[*line..].iter().any(|line| !line.is_empty()));
    never_closed.map_or(Ok(text), |line| Err(InputError::Quote { line }))
}

/// Whether a quotation mark is open behind a line: one opens at the beginning of a cell, or again behind one.
fn is_quoted_behind(line: &str, separator: char, is_quoted: bool) -> bool {
    let next = |(is_quoted, may_open): (bool, bool), sign: char| match sign {
        '"' => (!is_quoted && may_open, is_quoted),
        _ => (is_quoted, sign == separator),
    };
    line.chars().fold((is_quoted, true), next).0
}

/// In which columns numbers stand, by the row of the last ones that has the most.
fn number_columns(rows: &[RawRow]) -> Vec<bool> {
    let last = rows.iter().rev().filter(|row| !row.is_comment).take(SHOWN);
    let model = last.max_by_key(|row| row.cells.iter().filter(|cell| is_number(cell)).count());
    model.map_or(Vec::new(), |model| model.cells.iter().map(is_number).collect())
}

/// Finds the heading: the row above the numbers, or first of them, that has the most words where others have
/// numbers; a comment needs as many cells as a row. Of equal rows the last one is that above the numbers;
/// without numbers, all but the first are rows.
fn heading_row(above: &[RawRow], is_number_column: &[bool], separator: Option<char>) -> Option<usize> {
    let width = is_number_column.len();
    let is_whole = |row: &RawRow| match row.is_comment || separator == Some(' ') {
        true => row.cells.len() == width,
        false => row.cells.len() >= width.min(2),
    };
    let words = above.iter().map(|row| count_words(row, is_number_column)).zip(above).enumerate();
    let rows = words.filter(|(_, (words, row))| *words > 0 && is_whole(row) && !is_units(row));
    let words = |(_, (words, _)): &(usize, (usize, &RawRow))| *words;
    let best = match is_number_column.contains(&true) {
        true => rows.max_by_key(words),
        false => rows.rev().max_by_key(words),
    };
    best.map(|(at, _)| at)
}

/// Whether numbers are more than words where numbers are expected.
fn is_data(row: &RawRow, is_number_column: &[bool]) -> bool {
    let cells = is_number_column.iter().zip(&row.cells).filter(|(is_number, _)| **is_number);
    cells.filter(|(_, cell)| is_number(cell)).count() > count_words(row, is_number_column)
}

/// Whether all that stands behind the first cell where numbers are expected is numbers.
fn has_numbers_behind(cells: &StringRecord, is_number_column: &[bool]) -> bool {
    let expected = cells.iter().zip(is_number_column).skip(1).filter(|(_, is_number)| **is_number);
    let mut filled = expected.map(|(cell, _)| cell).filter(|cell| !is_missing(cell)).peekable();
    filled.peek().is_some() && filled.all(is_number)
}

/// How many cells have words where numbers are expected, or at all if none are. What begins with a digit is a
/// damaged number.
fn count_words(row: &RawRow, is_number_column: &[bool]) -> usize {
    let is_anywhere = !is_number_column.contains(&true);
    let cells = row.cells.iter().enumerate();
    let cells = cells.filter(|(at, _)| is_anywhere || is_number_column.get(*at) == Some(&true));
    cells.filter(|(_, cell)| is_word(cell)).count()
}

fn is_word(cell: &str) -> bool {
    let start = cell.trim_start_matches(['+', '-', '.', '<', '>', '~', ' ']);
    !is_missing(cell) && !is_number(cell) && !start.starts_with(|sign: char| sign.is_ascii_digit())
}

/// Whether a row has units and nothing else.
fn is_units(row: &RawRow) -> bool {
    const OTHERS: [&str; 9] = ["", "-", "a", "1/yr", "1/year", "1/a", "1/years", "text", "yes/no"];
    let cells = row.cells.iter();
    let cells = cells.map(|cell| uncommented(cell).trim_matches(['(', ')', '[', ']', ' ']).to_lowercase());
    let mut units = cells.filter(|cell| !OTHERS.contains(&cell.as_str())).peekable();
    units.peek().is_some() && units.all(|cell| cell == "%" || Unit::parse(&cell).is_some())
}

/// Whether a row is a line drawn with signs.
fn is_ruler(cells: &StringRecord) -> bool {
    let mut cells = cells.iter().filter(|cell| !cell.is_empty());
    cells.all(|cell| cell.len() > 1 && cell.chars().all(|sign| "-=_+|:".contains(sign)))
}

/// Headings with the units in a row below.
fn with_units(headings: &[Heading], units: &RawRow) -> Result<Vec<Heading>> {
    let with_unit = |(at, heading): (usize, &Heading)| match units.cells.get(at).unwrap_or_default() {
        "" | "-" => Ok(heading.clone()),
        "a" | "[a]" | "(a)" => Ok(heading.with_unit("years").unwrap_or(heading.clone())),
        unit => heading
            .with_unit(uncommented(unit))
            .ok_or_else(|| InputError::Units { heading: heading.text.clone(), unit: unit.to_string() }),
    };
    headings.iter().enumerate().map(with_unit).collect()
}
