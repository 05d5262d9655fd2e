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
//! sheet      answers as people open them in a workbook
//! workbook   a frame as a workbook
//! ```

pub mod compare;
mod html;
mod list;
mod object;
pub mod phrases;
pub mod readings;
pub mod response;
mod sheet;
mod text;
mod workbook;

use anyhow::Context;
use clap::Args;
use serde::{Deserialize, Serialize};

use crate::answer::{AnswerTable, Detail};
use crate::chart::Figure;
use crate::chart::text::literal;
pub use sheet::sheet;
pub use workbook::workbook;

/// What is told of rows, from top to bottom. All texts are marked, see [`crate::chart::text`].
#[derive(Debug, Clone, Default)]
pub struct Document {
    pub title: String,
    /// Project, author and date, as far as given.
    pub byline: String,
    /// Where it stands and at which site.
    pub place: String,
    /// The result, in sentences. What the title is about is "It" in the first.
    pub lead: Vec<String>,
    /// Columns of files that are not understood: a sentence a file.
    pub gaps: Vec<String>,
    /// The numbers that answer what is asked first.
    pub tiles: Vec<Tile>,
    /// What is to be seen before the tables, on a page beside the first figure.
    pub overview: Vec<Table>,
    pub tables: Vec<Table>,
    /// What was asked, and what the result rests on.
    pub facts: Vec<String>,
    /// What else it rests on, on a page.
    pub assumptions: Vec<String>,
    /// Warnings that change a decision.
    pub notes: Vec<String>,
    pub figures: Vec<Figure>,
    /// Folded, each with a title, facts, tables and figures: tests, files.
    pub sections: Vec<Document>,
}

/// What its author writes on a page.
#[derive(Debug, Clone, Default, Args, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct PageArgs {
    /// Title of the page [default: from what it shows]
    #[arg(long, value_name = "TEXT")]
    title: Option<String>,
    /// Project, below the title
    #[arg(long, value_name = "TEXT")]
    project: Option<String>,
    /// Author, below the title
    #[arg(long, value_name = "TEXT")]
    author: Option<String>,
    /// Date, below the title
    #[arg(long, value_name = "TEXT")]
    date: Option<String>,
}

/// A number in large letters, with what it is.
#[derive(Debug, Clone, Default)]
pub struct Tile {
    pub number: String,
    pub words: String,
}

/// Rows of cells, the first their name, the last may be missing. A column without cells is not shown.
#[derive(Debug, Clone, Default)]
pub struct Table {
    pub caption: String,
    pub heads: Vec<String>,
    pub rows: Vec<Vec<String>>,
    /// Columns behind the first that are a list's own, which pages alone show.
    pub labels: usize,
}

#[derive(Clone)]
struct Column<'a> {
    head: &'a str,
    is_label: bool,
    /// Whether all its cells are numbers, which are set to the right.
    is_number: bool,
    /// Whether all its cells are so short that none is broken.
    is_short: bool,
    cells: Vec<&'a str>,
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
            let is_short = cells.iter().all(|cell| cell.chars().count() <= SHORT);
            Some(Column { head, is_label, is_number, is_short, cells })
        })
    }
}

/// Letters of a short cell.
const SHORT: usize = 9;

fn is_number(cell: &str) -> bool {
    cell.starts_with(|sign: char| "0123456789-\u{2212}<>".contains(sign)) && !cell.contains(['→', '×'])
}

impl Document {
    pub fn of_answers(table: &AnswerTable) -> Document {
        let mut sorted = table.clone();
        sorted.rows.sort_by(|a, b| b.severity().total_cmp(&a.severity()));
        let mut document = match &sorted.rows[..] {
            [one] if one.before.is_none() => {
                object::document(&sorted, one, table.details.first().unwrap_or(&Detail::default()))
            }
            _ => list::document(&sorted),
        };
        let readings = table.readings();
        document.gaps = readings.iter().filter_map(|reading| Some(literal(&reading.gaps()?))).collect();
        document.sections.extend(Some(readings::section(&readings)).filter(Document::has_content));
        document
    }

    pub fn signed(self, by: &PageArgs) -> Document {
        let PageArgs { title, author, date, project } = by;
        let byline = [project, author, date].into_iter().flatten().map(|text| literal(text));
        let title = title.as_ref().map_or(self.title, |title| literal(title));
        Document { title, byline: byline.collect::<Vec<_>>().join(", "), ..self }
    }

    pub fn has_content(&self) -> bool {
        self.lead.len() + self.facts.len() + self.tables.len() + self.figures.len() > 0
    }

    /// The figure that says most, by itself; an error if there is none.
    pub fn main_figure(&self) -> anyhow::Result<Figure> {
        let figure = self.figures.iter().find(|figure| !figure.panels.is_empty());
        figure.cloned().context("nothing to draw: expected an answer, or width and height of an object")
    }
}
