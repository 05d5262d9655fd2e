//! One static HTML page that needs nothing else: the result, a table and a figure first; then figures; then
//! what is folded.

use super::draw::html_of_panels;
use super::figure::Figure;
use super::text::{escape, html, words};
use crate::table::marks::sealed;

/// A page from top to bottom. Title, byline and headings are plain text; sentences, heads and cells are
/// marked text, see [`super::text`].
#[derive(Debug, Clone, Default)]
pub struct Page {
    pub title: String,
    /// Author and date, as far as given.
    pub byline: String,
    /// Where it stands and at which site.
    pub place: String,
    /// The result, in a sentence.
    pub sentence: String,
    /// The numbers that answer what is asked first.
    pub tiles: Vec<Tile>,
    /// What was asked, and what the result rests on.
    pub facts: Vec<String>,
    /// Beside the first figure if that is of one panel, else below it.
    pub table: Option<Table>,
    /// Warnings that change a decision, under the table.
    pub notes: Vec<String>,
    pub figures: Vec<Figure>,
    /// What moves: pictures of their own, as HTML. One stands beside the first figure.
    pub moving: Vec<String>,
    /// Folded: method, tests, files.
    pub sections: Vec<Section>,
    /// Provenance of the page, which shows whether it is up to date.
    pub key: String,
}

/// A number in large letters, with what it is.
#[derive(Debug, Clone, Default)]
pub struct Tile {
    pub number: String,
    pub words: String,
}

#[derive(Debug, Clone, Default)]
pub struct Section {
    pub heading: String,
    pub paragraphs: Vec<String>,
    pub tables: Vec<Table>,
    pub figures: Vec<Figure>,
}

#[derive(Debug, Clone, Default)]
pub struct Table {
    pub caption: String,
    pub columns: Vec<Column>,
    pub rows: Vec<Vec<String>>,
}

#[derive(Debug, Clone)]
pub struct Column {
    pub head: String,
    pub is_number: bool,
}

impl Section {
    pub fn new(heading: &str) -> Section {
        Section { heading: heading.to_string(), ..Section::default() }
    }
}

impl Tile {
    pub fn new(number: impl Into<String>, words: impl Into<String>) -> Tile {
        Tile { number: number.into(), words: words.into() }
    }
}

impl Table {
    /// The first column is of names, the others of numbers.
    pub fn new(heads: &[&str], rows: Vec<Vec<String>>) -> Table {
        let columns = heads.iter().enumerate();
        let columns = columns.map(|(at, head)| Column { head: head.to_string(), is_number: at > 0 });
        Table { columns: columns.collect(), rows, ..Table::default() }
    }
}

impl Page {
    /// The figure that says most, by itself.
    pub fn main_figure(&self) -> Figure {
        self.figures.first().cloned().unwrap_or_default()
    }

    pub fn html(&self) -> String {
        let mut figures = Vec::new();
        for figure in &self.figures {
            // The title of the page is not said again.
            let title = if words(&figure.title) == self.title { "" } else { &figure.title };
            figures.push(write_figure(figure, title));
        }
        let (first, others) = figures.split_at(figures.len().min(1));
        let is_beside = self.figures.first().is_some_and(|figure| figure.panels.len() == 1);
        let (beside, moving) = match &self.moving[..] {
            [one] => (one.as_str(), &[][..]),
            several => ("", several),
        };
        let class = match is_beside && self.table.is_some() {
            true => "first",
            false if !beside.is_empty() => "response",
            false => "",
        };
        let told = match (&self.table, &self.notes[..]) {
            (None, []) => String::new(),
            (table, notes) => format!(
                "<div>\n{}<div class=\"notes\">{}</div></div>\n",
                table.iter().map(write_table).collect::<String>(),
                paragraphs(notes)
            ),
        };
        let (before, after) = if is_beside { (told, first.concat()) } else { (first.concat(), told) };
        sealed(format!(
            include_str!("assets/page.html"),
            style = include_str!("assets/page.css"),
            title = escape(&self.title),
            key = escape(&self.key),
            byline = escape(&self.byline),
            place = html(&self.place),
            sentence = html(&self.sentence),
            tiles = self.tiles.iter().map(write_tile).collect::<String>(),
            facts = paragraphs(&self.facts),
            class = class,
            before = before,
            after = after,
            beside = beside,
            moving = moving.concat(),
            figures = others.concat(),
            sections = self.sections.iter().map(write_section).collect::<String>(),
            version = env!("CARGO_PKG_VERSION"),
        ))
    }
}

fn write_tile(Tile { number, words }: &Tile) -> String {
    format!("<div><b>{}</b><span>{}</span></div>", html(number), html(words))
}

fn paragraphs(marked: &[String]) -> String {
    marked.iter().map(|words| format!("<p>{}</p>\n", html(words))).collect()
}

fn write_section(section: &Section) -> String {
    let (heading, words) = (escape(&section.heading), paragraphs(&section.paragraphs));
    let tables: String = section.tables.iter().map(write_table).collect();
    let figures: String = section.figures.iter().map(|figure| write_figure(figure, &figure.title)).collect();
    format!("<details><summary>{heading}</summary>\n{words}{tables}{figures}</details>\n")
}

fn write_figure(figure: &Figure, title: &str) -> String {
    let panels = html_of_panels(figure);
    let (title, caption, across) = (html(title), html(&figure.caption), figure.panels.len().min(3));
    format!(
        "<section class=\"figure\" style=\"--across:{across}\">\n\
         <h2>{title}</h2>\n{panels}<p class=\"caption\">{caption}</p>\n</section>\n"
    )
}

fn write_table(Table { caption, columns, rows }: &Table) -> String {
    let (mut heads, mut body) = (String::new(), String::new());
    for column in columns {
        heads += &format!("<th scope=\"col\"{}>{}</th>", column.class(), html(&column.head));
    }
    for row in rows {
        body += "<tr>";
        for (column, cell) in columns.iter().zip(row) {
            let (class, head) = (column.class(), escape(&words(&column.head)));
            body += &format!("<td{class} data-head=\"{head}\">{}</td>", html(cell));
        }
        body += "</tr>\n";
    }
    let (title, name) = (html(caption), escape(&words(caption)));
    // What is wider than a small screen is scrolled, by keys too.
    format!(
        "<p class=\"caption\">{title}</p>\n\
         <div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"{name}\">\n<table>\n\
         <thead><tr>{heads}</tr></thead>\n<tbody>\n{body}</tbody>\n</table>\n</div>\n"
    )
}

impl Column {
    fn class(&self) -> &'static str {
        if self.is_number { " class=\"number\"" } else { "" }
    }
}
