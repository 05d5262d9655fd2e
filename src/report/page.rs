//! One static HTML page that needs nothing else: the result, a table and a figure first; then figures; then
//! what is folded.

use super::draw::html_of_panels;
use super::figure::Figure;
use super::text::{escape, html, words};

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
    /// When and by what it was made.
    pub made: String,
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

/// When and by what a page is made.
pub fn made_in_words() -> String {
    let today = chrono::Local::now().format("%-d %B %Y");
    format!("Made on {today} by rockfrag {}.", env!("CARGO_PKG_VERSION"))
}

impl Page {
    pub fn html(&self) -> String {
        let figures: Vec<String> = self.figures.iter().map(write_figure).collect();
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
        let words =
            format!("{}{}", self.table.iter().map(write_table).collect::<String>(), notes(&self.notes));
        let words = if words.is_empty() { words } else { format!("<div>\n{words}</div>\n") };
        let [before, after] = if is_beside { [words, first.concat()] } else { [first.concat(), words] };
        format!(
            include_str!("assets/page.html"),
            style = include_str!("assets/page.css"),
            title = escape(&self.title),
            key = escape(&self.key),
            byline = escape(&self.byline),
            place = html(&self.place),
            sentence = html(&self.sentence),
            tiles = tiles(&self.tiles),
            facts = paragraphs(&self.facts),
            class = class,
            before = before,
            after = after,
            beside = beside,
            moving = blocks(moving),
            figures = others.concat(),
            sections = self.sections.iter().map(write_section).collect::<String>(),
            made = escape(&self.made),
        )
    }
}

/// What moves, beside each other.
fn blocks(moving: &[String]) -> String {
    match moving {
        [] => String::new(),
        _ => format!("<div class=\"blocks\">\n{}</div>\n", moving.concat()),
    }
}

fn tiles(tiles: &[Tile]) -> String {
    let tile = |Tile { number, words }: &Tile| {
        format!("<div><b>{}</b><span>{}</span></div>\n", html(number), html(words))
    };
    match tiles {
        [] => String::new(),
        _ => format!("<div class=\"tiles\">\n{}</div>\n", tiles.iter().map(tile).collect::<String>()),
    }
}

fn notes(marked: &[String]) -> String {
    match marked {
        [] => String::new(),
        _ => format!("<div class=\"notes\">\n{}</div>\n", paragraphs(marked)),
    }
}

fn paragraphs(marked: &[String]) -> String {
    marked.iter().map(|words| format!("<p>{}</p>\n", html(words))).collect()
}

fn write_section(section: &Section) -> String {
    let (heading, words) = (escape(&section.heading), paragraphs(&section.paragraphs));
    let tables: String = section.tables.iter().map(write_table).collect();
    let figures: String = section.figures.iter().map(write_figure).collect();
    format!("<details><summary>{heading}</summary>\n{words}{tables}{figures}</details>\n")
}

fn write_figure(figure: &Figure) -> String {
    let panels = html_of_panels(figure);
    let title = match figure.title.as_str() {
        "" => String::new(),
        words => format!("<h2>{}</h2>\n", html(words)),
    };
    let caption = match figure.caption.as_str() {
        "" => String::new(),
        words => format!("<p class=\"caption\">{}</p>\n", html(words)),
    };
    let across = figure.panels.len().min(3);
    format!("<section class=\"figure\" style=\"--across:{across}\">\n{title}{panels}{caption}</section>\n")
}

fn write_table(Table { caption, columns, rows }: &Table) -> String {
    let class = |column: &Column| if column.is_number { " class=\"number\"" } else { "" };
    let heads = columns
        .iter()
        .map(|column| format!("<th scope=\"col\"{}>{}</th>", class(column), html(&column.head)));
    let row = |cells: &Vec<String>| {
        let cells = columns.iter().zip(cells).map(|(column, cell)| {
            let head = escape(&words(&column.head));
            format!("<td{} data-head=\"{head}\">{}</td>", class(column), html(cell))
        });
        format!("<tr>{}</tr>\n", cells.collect::<String>())
    };
    let (heads, body) = (heads.collect::<String>(), rows.iter().map(row).collect::<String>());
    let title = if caption.is_empty() {
        String::new()
    } else {
        format!("<p class=\"caption\">{}</p>\n", html(caption))
    };
    let table = format!("<table>\n<thead><tr>{heads}</tr></thead>\n<tbody>\n{body}</tbody>\n</table>\n");
    title + &scrolled(caption, &table)
}

/// Lets what is wider than a small screen be scrolled, by keys too.
fn scrolled(name: &str, inner: &str) -> String {
    let name = escape(&words(name));
    format!("<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"{name}\">\n{inner}</div>\n")
}
