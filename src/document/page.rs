//! One static HTML page that needs nothing else: the result, a table and a figure first; then figures; then
//! what is folded.

use crate::chart::Figure;
use crate::chart::html_of_panels;
use crate::chart::text::{escape, html, words};

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
    /// The first stands beside the first figure if that is of one panel, else below it; others below all
    /// figures.
    pub tables: Vec<Table>,
    /// Warnings that change a decision, under the first table.
    pub notes: Vec<String>,
    pub figures: Vec<Figure>,
    /// Folded: method, tests, files.
    pub sections: Vec<Section>,
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

/// Rows of cells, of which the last may be missing; the first column has their names. A column in which
/// nothing stands is not shown.
#[derive(Debug, Clone, Default)]
pub struct Table {
    pub caption: String,
    pub heads: Vec<String>,
    pub rows: Vec<Vec<String>>,
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
    pub fn new(heads: &[&str], rows: Vec<Vec<String>>) -> Table {
        let heads = heads.iter().map(|head| head.to_string()).collect();
        Table { heads, rows, ..Table::default() }
    }

    pub fn explained(self, caption: &str) -> Table {
        Table { caption: caption.to_string(), ..self }
    }
}

impl Page {
    /// The figure that says most, by itself.
    pub fn main_figure(&self) -> Figure {
        self.figures.first().cloned().unwrap_or_default()
    }

    pub fn html(&self) -> String {
        let mut figures = self.figures.iter().map(|figure| {
            // The title of the page is not said again.
            let is_said = words(&figure.title) == self.title;
            write_figure(figure, if is_said { "" } else { &figure.title })
        });
        let mut tables = self.tables.iter().map(write_table);
        let (figure, table) = (figures.next().unwrap_or_default(), tables.next().unwrap_or_default());
        let is_beside =
            !table.is_empty() && self.figures.first().is_some_and(|first| first.panels.len() == 1);
        let told = match (table.as_str(), &self.notes[..]) {
            ("", []) => String::new(),
            (_, notes) => {
                format!("<div>\n{table}<div class=\"notes\">{}</div></div>\n", paragraphs(notes))
            }
        };
        format!(
            include_str!("page.html"),
            style = include_str!("page.css"),
            title = escape(&self.title),
            byline = escape(&self.byline),
            place = html(&self.place),
            sentence = html(&self.sentence),
            tiles = self.tiles.iter().map(write_tile).collect::<String>(),
            facts = paragraphs(&self.facts),
            first = match is_beside {
                true => format!("<div class=\"first\">\n{told}{figure}</div>"),
                false => format!("<div class=\"\">\n{figure}{told}</div>"),
            },
            figures = figures.collect::<String>(),
            tables = tables.collect::<String>(),
            sections = self.sections.iter().map(write_section).collect::<String>(),
            version = env!("CARGO_PKG_VERSION"),
        )
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
    let (panels, moving) = (html_of_panels(figure), &figure.moving);
    let (title, across) = (html(title), figure.panels.len().min(3));
    let caption = format!("<p class=\"caption\">{}</p>\n", html(&figure.caption));
    let content = match moving.as_str() {
        "" => format!("{panels}{caption}"),
        _ => format!(
            "<div class=\"response\">\n<figure>{moving}{caption}</figure>\n<div>{panels}</div></div>\n"
        ),
    };
    format!("<section class=\"figure\" style=\"--across:{across}\">\n<h2>{title}</h2>\n{content}</section>\n")
}

fn write_table(table: &Table) -> String {
    let (mut heads, mut rows) = (String::new(), vec![String::new(); table.rows.len()]);
    for (column, head) in table.heads.iter().enumerate() {
        let cells = table.rows.iter().map(|row| row.get(column).map_or("", String::as_str));
        let mut written = cells.clone().filter(|cell| !cell.is_empty()).peekable();
        if written.peek().is_none() {
            continue;
        }
        let class = if column > 0 && written.all(is_number) { " class=\"number\"" } else { "" };
        heads += &format!("<th scope=\"col\"{class}>{}</th>", html(head));
        let head = escape(&words(head));
        for (row, cell) in rows.iter_mut().zip(cells) {
            *row += &format!("<td{class} data-head=\"{head}\">{}</td>", html(cell));
        }
    }
    let body: String = rows.iter().map(|row| format!("<tr>{row}</tr>\n")).collect();
    let (title, name) = (html(&table.caption), escape(&words(&table.caption)));
    // What is wider than a small screen is scrolled, by keys too.
    format!(
        "<p class=\"caption\">{title}</p>\n\
         <div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"{name}\">\n<table>\n\
         <thead><tr>{heads}</tr></thead>\n<tbody>\n{body}</tbody>\n</table>\n</div>\n"
    )
}

/// Whether a cell is a number: a column of them is set to the right.
fn is_number(cell: &str) -> bool {
    cell.starts_with(|sign: char| "0123456789-\u{2212}<>".contains(sign)) && !cell.contains('→')
}
