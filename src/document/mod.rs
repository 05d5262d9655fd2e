//! Documents of rows, and what writes them.
//!
//! ```text
//! phrases    every sentence about an answer
//! object     the document of one object
//! list       of several
//! compare    of two tables of answers
//! readings   how the files of people were read
//! response   of a response over time, and the block as it moves
//! text       a document for a terminal
//! html       as a page
//! workbook   a table as a workbook
//! ```

pub mod compare;
mod html;
mod list;
mod object;
pub mod phrases;
pub mod readings;
pub mod response;
mod text;
mod workbook;

use anyhow::Context;

use crate::answer::AnswerTable;
use crate::chart::Figure;
use crate::chart::text::literal;
pub use workbook::workbook;

/// What is told of rows, from top to bottom. All texts are marked, see [`crate::chart::text`].
#[derive(Debug, Clone, Default)]
pub struct Document {
    pub title: String,
    /// Author and date, as far as given.
    pub byline: String,
    /// Where it stands and at which site.
    pub place: String,
    /// The result, in sentences. What the title is about is "It" in the first.
    pub lead: Vec<String>,
    /// Columns of files that are not understood: a sentence a file.
    pub gaps: Vec<String>,
    /// The numbers that answer what is asked first.
    pub tiles: Vec<Tile>,
    /// Of a page, the first stands beside the first figure if that is of one panel, as far as it has room
    /// there, else below it; others below all figures.
    pub tables: Vec<Table>,
    /// What was asked, and what the result rests on.
    pub facts: Vec<String>,
    /// Warnings that change a decision.
    pub notes: Vec<String>,
    pub figures: Vec<Figure>,
    /// Folded, each with a title, facts, tables and figures: method, tests, files.
    pub sections: Vec<Document>,
}

/// A number in large letters, with what it is.
#[derive(Debug, Clone, Default)]
pub struct Tile {
    pub number: String,
    pub words: String,
}

/// Rows of cells, of which the last may be missing; the first column has their names. A column in which
/// nothing stands is not shown.
#[derive(Debug, Clone, Default)]
pub struct Table {
    pub caption: String,
    pub heads: Vec<String>,
    pub rows: Vec<Vec<String>>,
    /// Columns behind the first that are a list's own, which pages alone show.
    pub labels: usize,
}

/// A column of a table that is shown.
#[derive(Clone)]
struct Column<'a> {
    head: &'a str,
    is_label: bool,
    /// Whether all its cells are numbers, which are set to the right.
    is_number: bool,
    cells: Vec<&'a str>,
}

impl Tile {
    pub fn new(number: impl Into<String>, words: impl Into<String>) -> Tile {
        Tile { number: number.into(), words: words.into() }
    }
}

impl Table {
    pub fn new(heads: &[&str], rows: Vec<Vec<String>>) -> Table {
        let heads = heads.iter().map(|head| head.to_string()).collect();
        Table { heads, rows, ..Table::default() }
    }

    pub fn explained(self, caption: &str) -> Table {
        Table { caption: caption.to_string(), ..self }
    }

    fn columns(&self) -> impl Iterator<Item = Column<'_>> {
        self.heads.iter().enumerate().filter_map(|(at, head)| {
            let cells: Vec<&str> =
                self.rows.iter().map(|row| row.get(at).map_or("", String::as_str)).collect();
            let mut written = cells.iter().filter(|cell| !cell.is_empty()).peekable();
            written.peek()?;
            let is_number = at > 0 && written.all(|cell| is_number(cell));
            let is_label = (1..=self.labels).contains(&at);
            Some(Column { head, is_label, is_number, cells })
        })
    }
}

fn is_number(cell: &str) -> bool {
    cell.starts_with(|sign: char| "0123456789-\u{2212}<>".contains(sign)) && !cell.contains('→')
}

impl Document {
    /// The document of answers: of one object or of several.
    pub fn of_answers(table: &AnswerTable) -> Document {
        let mut sorted = table.clone();
        sorted.rows.sort_by(|a, b| b.severity().total_cmp(&a.severity()));
        let document = match &sorted.rows[..] {
            [one] if one.before.is_none() => object::document(&sorted, one),
            _ => list::document(&sorted),
        };
        let readings = table.readings();
        let gaps = readings.iter().filter_map(|reading| Some(literal(&reading.gaps()?)));
        let section = Some(readings::section(&readings)).filter(Document::has_content);
        Document { gaps: gaps.collect(), sections: section.into_iter().collect(), ..document }
    }

    pub fn has_content(&self) -> bool {
        self.lead.len() + self.facts.len() + self.tables.len() + self.figures.len() > 0
    }

    /// The figure that says most, by itself.
    ///
    /// # Errors
    /// If there is none.
    pub fn main_figure(&self) -> anyhow::Result<Figure> {
        let figure = self.figures.iter().find(|figure| !figure.panels.is_empty());
        figure.cloned().context("nothing to draw: expected an answer, or width and height of an object")
    }
}
