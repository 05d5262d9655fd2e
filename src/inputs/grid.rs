//! A table: cells under headings, as people and agencies write it.

use std::collections::HashSet;
use std::ops::Range;
use std::path::Path;

use csv::StringRecord;
use rockfrag_core::plausibility::range_of_column;

use super::bytes::{decode, unpack_one};
use super::error::{InputError, PERCENT, Result, THOUSANDS, expect_few_cells};
use super::heading::{Heading, number_with_unit};
use super::layout::{Layout, RawRow, RowRole, layout};
use super::numbers::{self, Evidence, Notation, is_missing, is_number};
use super::reader::{ColumnReading, Meaning, Reading};
use super::roles::is_unread;
use super::separated;
use super::words::{means, synonyms};
use super::workbook::{self, Sheet};
use crate::number::{counted, rounded};
use crate::source;

/// The heading of the column of sections.
pub const SECTION: &str = "Section";

/// Numbers below this stand for what is not known.
const UNKNOWN: f64 = -99.0;

#[derive(Debug, Clone, Default, PartialEq)]
pub struct Grid {
    /// Comments, lines above, below and between the rows, and the name of the sheet.
    pub notes: Vec<String>,
    /// Other lines that are no rows, and what they were taken for.
    others: Vec<String>,
    /// One for each column, without a text where there is no heading line.
    pub headings: Vec<Heading>,
    pub has_headings: bool,
    /// Line of each row in the file, from 1.
    pub lines: Vec<usize>,
    rows: Vec<StringRecord>,
    notations: Vec<Notation>,
    /// Columns that the user leaves out.
    ignored: Vec<ColumnReading>,
    /// Lines and columns of cells that are merged over rows.
    repeated: HashSet<(usize, usize)>,
}

/// What a table is read from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Source {
    /// Text between signs, or between blanks.
    Signs,
    Blanks,
    /// A workbook that tells which cells are merged and percent, or one that does not.
    Xlsx,
    Workbook,
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
            let Sheet { rows, repeated, source, name } = workbook::read(&bytes, sheet)?;
            let mut grid = Grid::new(rows, source, &repeated)?;
            // As a comment: most names say nothing.
            grid.notes.push(format!("# {name}"));
            return Ok(grid);
        }
        let (rows, source) = separated::rows(&decode(&bytes)?)?;
        Grid::new(rows, source, &HashSet::new())
    }

    /// Takes a table whose cells have points for decimals, as those of a workbook.
    pub fn from_cells(rows: &[Vec<String>]) -> Result<Grid> {
        expect_few_cells(rows.iter().map(Vec::len).sum())?;
        let rows = (1..).zip(rows).filter(|(_, cells)| cells.iter().any(|cell| !cell.is_empty()));
        let rows = rows.map(|(line, cells)| RawRow::new(line, cells.iter().collect(), None));
        Grid::new(rows.collect(), Source::Xlsx, &HashSet::new())
    }

    fn new(rows: Vec<RawRow>, source: Source, repeated: &HashSet<(usize, usize)>) -> Result<Grid> {
        let Layout { headings, has_headings, roles } = layout(&rows, source)?;
        let width = headings.len();
        let parts: Vec<Vec<Heading>> =
            headings.into_iter().map(|heading| heading.parted().unwrap_or(vec![heading])).collect();
        let has_sections = roles.contains(&RowRole::Section);
        let (mut grid, mut section) = (Grid::default(), String::new());
        for (row, role) in rows.into_iter().zip(roles) {
            match role {
                RowRole::Head if grid.rows.is_empty() => {}
                RowRole::Head => grid.others.push(format!("line {}: headings again", row.line)),
                RowRole::Remark => grid.notes.push(row.text(source)),
                RowRole::Section => {
                    section = row.text(source);
                    grid.others.push(format!("line {}: section '{section}'", row.line));
                }
                RowRole::Data => {
                    if row.cells.iter().skip(width).any(|cell| !cell.is_empty()) {
                        let (line, found) = (row.line, row.cells.len());
                        return Err(InputError::Cells { line, found, expected: width });
                    }
                    let mut cells = parted(&row.cells, &parts);
                    if has_sections {
                        cells.resize(parts.iter().map(Vec::len).sum(), "");
                        cells.push(&section);
                    }
                    grid.lines.push(row.line);
                    grid.rows.push(cells.into());
                }
            }
        }
        // A heading of several columns before a merged cell moves it.
        let moved = |at: usize| parts.iter().take(at).map(Vec::len).sum();
        grid.repeated = repeated.iter().map(|(line, at)| (*line, moved(*at))).collect();
        grid.has_headings = has_headings;
        grid.headings =
            parts.into_iter().flatten().chain(has_sections.then(|| Heading::new(SECTION))).collect();
        grid.take_units();
        let mut evidence: Vec<Evidence> = grid.headings.iter().map(Evidence::under).collect();
        for row in &grid.rows {
            evidence.iter_mut().zip(row).for_each(|(column, cell)| column.add(cell));
        }
        grid.notations = numbers::notations(&evidence, source);
        Ok(grid)
    }

    /// Takes the units behind numbers off: that of the heading, or that of all numbers of a column.
    fn take_units(&mut self) {
        for (at, heading) in self.headings.iter_mut().enumerate() {
            if heading.unit.is_none() && !heading.is_scaled {
                let cells = self.rows.iter().filter_map(|row| row.get(at).filter(|cell| !is_missing(cell)));
                let parted = cells.map(|cell| number_with_unit(cell).filter(|(number, _)| is_number(number)));
                heading.unit = only(parted.map(|parted| parted.map(|(_, unit)| unit))).flatten();
            }
        }
        if self.headings.iter().all(|heading| heading.unit.is_none()) {
            return;
        }
        for row in &mut self.rows {
            let cells = row.iter().zip(&self.headings).map(|(cell, heading)| heading.without_unit(cell));
            *row = cells.collect();
        }
    }

    /// Leaves rows out, and tells what they were taken for.
    pub fn leave_out(&mut self, what: &str, is_out: impl Fn(&Grid, usize) -> bool) {
        let out: Vec<usize> = self.rows().filter(|row| is_out(self, *row)).collect();
        self.others.extend(out.iter().map(|row| format!("line {}: {what}", self.lines[*row])));
        let is_kept = |row: &usize| out.binary_search(row).is_err();
        let kept: Vec<usize> = self.rows().filter(is_kept).collect();
        self.rows = kept.iter().map(|row| self.rows[*row].clone()).collect();
        self.lines = kept.iter().map(|row| self.lines[*row]).collect();
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

    /// Whether the cell is merged over rows.
    pub fn is_repeated(&self, row: usize, column: usize) -> bool {
        self.repeated.contains(&(self.lines[row], column))
    }

    /// Whether the cells of a column are texts: one is no number and not yes or no, or none says anything.
    pub fn is_text(&self, column: usize) -> bool {
        let mut values = self.rows().filter(|row| self.value(*row, column).is_some()).peekable();
        let is_answer = |cell| means(cell, "yes") || means(cell, "free");
        values.peek().is_none()
            || values.any(|row| self.number(row, column).is_err() && !is_answer(self.cell(row, column)))
    }

    pub fn is_percent(&self, row: usize, column: usize) -> bool {
        self.headings[column].is_percent || self.cell(row, column).ends_with('%')
    }

    /// Reads the number in a cell; 10 % is 0.1, also where the heading has the sign.
    pub fn number(&self, row: usize, column: usize) -> Result<f64> {
        let (cell, notation) = (self.cell(row, column), self.notations[column]);
        let has_sign = cell.ends_with('%');
        let size = if self.is_percent(row, column) && !has_sign { 0.01 } else { 1.0 };
        let expected = match notation.number(cell) {
            Some(_) if notation.may_be_shares && !has_sign => PERCENT,
            Some(number) => return Ok(size * number),
            // The table does not tell which sign is decimal.
            None if is_number(cell) => THOUSANDS,
            None => "a number",
        };
        Err(self.refusal(row, column, expected))
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

    pub fn not_understood(&self, headings: &[&str], expected: &'static str) -> InputError {
        let is_named = self.has_headings && !headings.is_empty();
        let named = || format!("heading '{}' is not understood", headings.join(","));
        InputError::unexpected(if is_named { named() } else { self.found() }, expected)
    }

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
        let moved = |(line, at): &(usize, usize)| Some((*line, kept.iter().position(|kept| kept == at)?));
        self.repeated = self.repeated.iter().filter_map(moved).collect();
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
            unread: self.notes.iter().filter(|note| is_unread(note)).cloned().collect(),
            columns: columns.chain(self.ignored.iter().cloned()).collect(),
            others: [self.others.clone(), self.notes.iter().map(|note| format!("remark: {note}")).collect()]
                .concat(),
        }
    }

    fn column_reading(&self, at: usize, meaning: Meaning) -> ColumnReading {
        let heading = &self.headings[at];
        let filled: Vec<usize> = self.rows().filter(|row| self.value(*row, at).is_some()).collect();
        let size = heading.unit.filter(|_| matches!(meaning, Meaning::Known(_))).map_or(1.0, |unit| unit.si);
        let shown = |row: &usize| match self.number(*row, at) {
            Ok(number) => rounded(size * number).to_string(),
            Err(_) => self.cell(*row, at).to_string(),
        };
        ColumnReading {
            heading: self.name_of(at),
            unit: heading.unit.map(|unit| unit.name.to_string()),
            filled: filled.len(),
            first: filled.first().map(shown).unwrap_or_default(),
            last: filled.last().map(shown).unwrap_or_default(),
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

/// What all say alike, if there are any.
pub(super) fn only<T: PartialEq>(mut all: impl Iterator<Item = T>) -> Option<T> {
    let first = all.next()?;
    all.all(|other| other == first).then_some(first)
}

/// The cells of a row, of which one under several headings is parted: 600x400x2000.
fn parted<'a>(cells: &'a StringRecord, parts: &[Vec<Heading>]) -> Vec<&'a str> {
    let sides = cells.iter().zip(parts).map(|(cell, headings)| {
        let sides: Vec<&str> = cell.split(['x', 'X', '\u{d7}', '*']).map(str::trim).collect();
        if sides.len() == headings.len() {
            sides
        } else {
            [vec![cell], vec![""; headings.len() - 1]].concat()
        }
    });
    sides.flatten().collect()
}
