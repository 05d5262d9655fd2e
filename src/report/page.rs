//! One static HTML page that needs nothing else: the result, a table and a figure first; then figures; then
//! what is folded.

use super::draw::svg_in_page;
use super::figure::Figure;
use super::text::{escape, html};

/// A page from top to bottom. Title, byline and names are plain text; sentences, heads and cells are marked
/// text, see [`super::text`].
#[derive(Debug, Clone, Default)]
pub struct Page {
    pub title: String,
    /// Author and date, as far as given.
    pub byline: String,
    /// The result, in a sentence.
    pub sentence: String,
    /// What was asked, and what the result rests on.
    pub facts: Vec<String>,
    pub table: Option<Table>,
    /// Warnings that change a decision, under the table.
    pub notes: Vec<String>,
    /// The first one stands beside the table.
    pub figures: Vec<Figure>,
    /// Folded: method, tests, files.
    pub sections: Vec<Section>,
    /// Provenance of the page, which shows whether it is up to date.
    pub key: String,
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

impl Page {
    pub fn html(&self) -> String {
        let mut numbers = 1..;
        let mut numbered = |figures: &[Figure]| -> Vec<String> {
            figures.iter().zip(&mut numbers).map(|(figure, number)| write_figure(figure, number)).collect()
        };
        let seen = numbered(&self.figures);
        let (first, others) = seen.split_at(seen.len().min(1));
        let sections = self.sections.iter().map(|section| write_section(section, numbered(&section.figures)));
        format!(
            include_str!("assets/page.html"),
            style = include_str!("assets/page.css"),
            title = escape(&self.title),
            key = escape(&self.key),
            byline = escape(&self.byline),
            sentence = html(&self.sentence),
            facts = paragraphs(&self.facts),
            table = self.table.iter().map(write_table).collect::<String>(),
            notes = paragraphs(&self.notes),
            first = first.concat(),
            figures = others.concat(),
            sections = sections.collect::<String>(),
        )
    }
}

fn paragraphs(marked: &[String]) -> String {
    marked.iter().map(|words| format!("<p>{}</p>\n", html(words))).collect()
}

fn write_section(section: &Section, figures: Vec<String>) -> String {
    let (heading, words) = (escape(&section.heading), paragraphs(&section.paragraphs));
    let tables: String = section.tables.iter().map(write_table).collect();
    let figures = match &figures[..] {
        [] => String::new(),
        _ => format!("<div class=\"figures\">\n{}</div>\n", figures.concat()),
    };
    format!("<details><summary>{heading}</summary>\n{words}{tables}{figures}</details>\n")
}

fn write_figure(figure: &Figure, number: usize) -> String {
    let (title, caption) = (html(&figure.title), html(&figure.caption));
    let picture = scrolled(&figure.title, &svg_in_page(figure));
    format!("<figure>\n<h2>{number}. {title}</h2>\n{picture}<figcaption>{caption}</figcaption>\n</figure>\n")
}

fn write_table(Table { caption, columns, rows }: &Table) -> String {
    let class = |column: &Column| if column.is_number { " class=\"number\"" } else { "" };
    let heads = columns
        .iter()
        .map(|column| format!("<th scope=\"col\"{}>{}</th>", class(column), html(&column.head)));
    let row = |cells: &Vec<String>| {
        let cells = columns
            .iter()
            .zip(cells)
            .map(|(column, cell)| format!("<td{}>{}</td>", class(column), html(cell)));
        format!("<tr>{}</tr>\n", cells.collect::<String>())
    };
    let (heads, body) = (heads.collect::<String>(), rows.iter().map(row).collect::<String>());
    let words =
        if caption.is_empty() { String::new() } else { format!("<p class=\"by\">{}</p>\n", html(caption)) };
    let table = format!("<table>\n<thead><tr>{heads}</tr></thead>\n<tbody>\n{body}</tbody>\n</table>\n");
    words + &scrolled(caption, &table)
}

/// Lets what is wider than a small screen be scrolled, by keys too.
fn scrolled(name: &str, inner: &str) -> String {
    let name = escape(&super::text::words(name));
    format!("<div class=\"scroll\" tabindex=\"0\" role=\"group\" aria-label=\"{name}\">\n{inner}</div>\n")
}
