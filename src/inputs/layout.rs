//! Where in a sheet the table is: each row is a heading, a row of units, a remark, a section or data.

use std::ops::Range;

use csv::StringRecord;
use rockfrag_core::units::Unit;

use super::error::{InputError, Result};
use super::grid::Source;
use super::heading::Heading;
use super::numbers::{is_missing, is_number};
use super::words::{are_known, joined, normal};

/// Rows at the end of a table that show how it is written.
pub const SHOWN: usize = 400;

/// A row of a file, before it is known what it is.
pub struct RawRow {
    pub line: usize,
    pub cells: StringRecord,
    pub is_comment: bool,
}

impl RawRow {
    pub fn new(line: usize, cells: StringRecord, text: Option<&str>) -> RawRow {
        RawRow { line, cells, is_comment: text.is_some_and(|text| is_comment(text.trim_start())) }
    }

    fn filled(&self) -> impl Iterator<Item = (usize, &str)> {
        self.cells.iter().enumerate().filter(|(_, cell)| !cell.is_empty())
    }

    /// Its only text, which a workbook may repeat over columns.
    fn alone(&self, source: Source) -> Option<&str> {
        let mut filled = self.filled();
        let (_, first) = filled.next()?;
        filled.all(|(_, cell)| cell == first && source == Source::Xlsx).then_some(first)
    }

    pub fn text(&self, source: Source) -> String {
        let filled: Vec<&str> = self.filled().map(|(_, cell)| cell).collect();
        self.alone(source)
            .map_or_else(|| filled.join(if source == Source::Blanks { " " } else { ", " }), str::to_string)
    }

    fn get(&self, column: usize) -> &str {
        self.cells.get(column).unwrap_or_default()
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RowRole {
    /// Headings, or their units.
    Head,
    /// A comment, a title, or what else stands above, below or between rows.
    Remark,
    /// The name of the rows below.
    Section,
    Data,
}

pub struct Layout {
    pub headings: Vec<Heading>,
    pub has_headings: bool,
    pub roles: Vec<RowRole>,
}

pub fn layout(rows: &[RawRow], source: Source) -> Result<Layout> {
    let is_number_column = number_columns(rows);
    let first = rows.iter().position(|row| !row.is_comment && is_data(row, &is_number_column));
    let above = &rows[..first.map_or(rows.len(), |first| first + 1)];
    let main = heading_row(above, &is_number_column, source);
    let of_heading = main.map(|main| heading_rows(rows, main, first, source));
    let (mut headings, mut end) = match of_heading.clone() {
        Some(range) => (joined_rows(&rows[range.clone()], source), range.end),
        None => (vec![Heading::new(""); is_number_column.len()], first.unwrap_or(0)),
    };
    while let Some(units) = rows.get(end).filter(|row| main.is_some() && is_units(row)) {
        headings = with_units(&headings, units)?;
        end += 1;
    }
    let mut roles = vec![RowRole::Remark; rows.len()];
    of_heading.into_iter().for_each(|range| roles[range.start..end].fill(RowRole::Head));
    // Between blanks, a comment above the numbers may have some too: dt 0.01.
    let start = first.filter(|_| source == Source::Blanks).unwrap_or(end);
    for (at, row) in rows.iter().enumerate().skip(end) {
        let is_named = is_number_column.first() == Some(&false) && headings.len() > 1;
        roles[at] = match row.alone(source) {
            // An object may be called #2.
            _ if row.is_comment && source == Source::Blanks && at < start => RowRole::Remark,
            alone if row.is_comment => {
                let is_data = is_named && alone.is_none() && source != Source::Blanks;
                let has_numbers = has_numbers_behind(&row.cells, &is_number_column);
                if is_data || has_numbers { RowRole::Data } else { RowRole::Remark }
            }
            _ if headings.len() < 2 || source == Source::Blanks => RowRole::Data,
            Some(cell) if !is_number(cell) => RowRole::Section,
            _ if main.is_some() && repeats(row, &headings) => RowRole::Head,
            _ if main.is_some() && speaks_of_columns(row, &is_number_column) => {
                let found = format!("line {}: other headings", row.line);
                return Err(InputError::unexpected(found, "one table: a file or a sheet for each"));
            }
            _ => RowRole::Data,
        };
    }
    // What has no rows below is a remark.
    let last = roles.iter().rposition(|role| *role == RowRole::Data).unwrap_or_default();
    roles[last..]
        .iter_mut()
        .filter(|role| **role == RowRole::Section)
        .for_each(|role| *role = RowRole::Remark);
    Ok(Layout { headings, has_headings: main.is_some(), roles })
}

/// The rows of the heading, around that which has the most words: above, what fills its gaps, is merged with
/// it or names groups in known words; below, what fills its gaps.
fn heading_rows(rows: &[RawRow], main: usize, first: Option<usize>, source: Source) -> Range<usize> {
    let (mut start, mut end) = (main, main + 1);
    if source == Source::Blanks {
        return start..end;
    }
    let width = rows[main].cells.len().max(first.map_or(0, |first| rows[first].cells.len()));
    let mut gaps: Vec<bool> = (0..width).map(|at| rows[main].get(at).is_empty()).collect();
    let mut fills = |row: &RawRow| {
        let filled = row.filled().map(|(at, _)| at).filter(|at| gaps.get(*at) == Some(&true));
        let filled: Vec<usize> = filled.collect();
        filled.iter().for_each(|at| gaps[*at] = false);
        !filled.is_empty()
    };
    while let Some(row) = start.checked_sub(1).map(|above| &rows[above]) {
        let is_title = row.is_comment || row.alone(source).is_some() && !row.get(0).is_empty();
        let is_next = row.line + 1 == rows[start].line && !is_title;
        let is_known = |cell: &str| Heading::new(cell).unit.is_some() || are_known(cell);
        let is_group = |(at, cell): (usize, &str)| at + 1 < width && ["", cell].contains(&row.get(at + 1));
        let are_groups = || row.filled().all(|(_, cell)| is_known(cell)) && row.filled().any(is_group);
        let is_merged = |(at, cell): (usize, &str)| rows[start].get(at) == cell;
        if !(is_next && (fills(row) || row.filled().any(is_merged) || are_groups())) {
            break;
        }
        start -= 1;
    }
    while first.is_some_and(|first| end < first)
        && !rows[end].is_comment
        && !is_units(&rows[end])
        && fills(&rows[end])
    {
        end += 1;
    }
    start..end
}

/// One heading a column, of all rows. What stands above several columns is in the first of them, unless a workbook
/// repeats it.
fn joined_rows(rows: &[RawRow], source: Source) -> Vec<Heading> {
    let width = rows.iter().map(|row| row.cells.len()).max().unwrap_or_default();
    let mut columns: Vec<Vec<&str>> = vec![Vec::new(); width];
    for (row, below) in rows.iter().zip(1..) {
        let is_below = |at: usize| rows[below..].iter().any(|row| !row.get(at).is_empty());
        let mut group = "";
        for (at, column) in columns.iter_mut().enumerate() {
            let cell = if row.is_comment { uncommented(row.get(at)) } else { row.get(at) };
            if !cell.is_empty() || !is_below(at) {
                // A merged cell tells itself above which columns it stands.
                let is_merged = source == Source::Xlsx
                    && [at.wrapping_sub(1), at + 1].iter().any(|of| row.get(*of) == cell);
                group = if is_below(at) && !is_merged { cell } else { "" };
            }
            column.push(if cell.is_empty() { group } else { cell });
        }
    }
    columns.into_iter().map(Heading::of_rows).collect()
}

fn repeats(row: &RawRow, headings: &[Heading]) -> bool {
    let mut filled = row.filled().peekable();
    let is_same = |(at, cell): (usize, &str)| {
        let text = headings.get(at).map_or("", |heading| &heading.text);
        let last = text.rsplit(" / ").next().unwrap_or_default();
        joined(cell) == joined(text) || joined(cell) == joined(last)
    };
    filled.peek().is_some() && filled.all(is_same)
}

/// Whether a row has words of headings where numbers are expected, and no number.
fn speaks_of_columns(row: &RawRow, is_number_column: &[bool]) -> bool {
    let expected = row.filled().filter(|(at, _)| is_number_column.get(*at) == Some(&true));
    let words: Vec<&str> = expected.map(|(_, cell)| cell).filter(|cell| !is_missing(cell)).collect();
    let speaks = |cell: &&&str| {
        Heading::new(cell).unit.is_some() && is_word(cell) || are_known(cell) && cell.len() > 2
    };
    words.iter().all(|cell| is_word(cell)) && words.iter().filter(speaks).count() > 1
}

fn is_comment(line: &str) -> bool {
    ["#", "%", "//"].iter().any(|sign| line.starts_with(sign))
}

pub fn uncommented(text: &str) -> &str {
    if is_comment(text) { text.trim_start_matches(['#', '%', '/', ' ']) } else { text }
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
fn heading_row(above: &[RawRow], is_number_column: &[bool], source: Source) -> Option<usize> {
    let width = is_number_column.len();
    // A comment that has numbers is one.
    let is_remark = |row: &RawRow| row.is_comment && row.cells.iter().any(is_number);
    let is_whole = |row: &RawRow| match row.is_comment || source == Source::Blanks {
        true => row.cells.len() == width && !is_remark(row),
        false => row.cells.len() >= width.min(2),
    };
    let is_merged = |row: &RawRow| row.cells.len() > 1 && row.alone(source).is_some();
    let words = above.iter().map(|row| count_words(row, is_number_column)).zip(above).enumerate();
    let rows =
        words.filter(|(_, (words, row))| *words > 0 && is_whole(row) && !is_units(row) && !is_merged(row));
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
    let cells =
        cells.map(|cell| normal(uncommented(cell)).trim_matches(['(', ')', '[', ']', ' ']).to_lowercase());
    let mut units = cells.filter(|cell| !OTHERS.contains(&cell.as_str())).peekable();
    units.peek().is_some() && units.all(|cell| cell == "%" || Unit::parse(&cell).is_some())
}

fn with_units(headings: &[Heading], units: &RawRow) -> Result<Vec<Heading>> {
    let with_unit = |(at, heading): (usize, &Heading)| match units.cells.get(at).unwrap_or_default() {
        "" | "-" => Ok(heading.clone()),
        "a" | "[a]" | "(a)" => Ok(heading.with_unit("years").unwrap_or(heading.clone())),
        unit => heading
            .with_unit(if Unit::parse(unit).is_some() { unit } else { uncommented(unit) })
            .ok_or_else(|| InputError::Units { heading: heading.text.clone(), unit: unit.to_string() }),
    };
    headings.iter().enumerate().map(with_unit).collect()
}
