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
    /// Writes the page.
    pub fn html(&self) -> String {
        let Page { title, byline, sentence, facts, table, notes, figures, sections, key } = self;
        let numbered: Vec<String> =
            (1..).zip(figures).map(|(number, figure)| write_figure(figure, number)).collect();
        let (first, others) = numbered.split_at(numbered.len().min(1));
        let beside = format!(
            "<div>\n{}{}</div>\n",
            table.iter().map(write_table).collect::<String>(),
            paragraphs(notes)
        );
        let folded = (figures.len() + 1, String::new());
        let (_, folded) = sections.iter().fold(folded, |(number, written), section| {
            (number + section.figures.len(), written + &write_section(section, number))
        });
        let parts = [
            ("{title}", escape(title)),
            ("{key}", escape(key)),
            ("{byline}", escape(byline)),
            ("{sentence}", html(sentence)),
            ("{facts}", paragraphs(facts)),
            ("{first}", beside + &first.concat()),
            ("{figures}", others.concat()),
            ("{sections}", folded),
        ];
        fill(include_str!("assets/page.html"), &parts)
    }
}

/// Puts the parts into the template, in one pass, so that no part is searched for another.
fn fill(template: &str, parts: &[(&str, String)]) -> String {
    let mut page = String::new();
    let mut rest = template;
    while let Some((at, (mark, part))) =
        parts.iter().filter_map(|part| Some((rest.find(part.0)?, part))).min_by_key(|(at, _)| *at)
    {
        page.push_str(&rest[..at]);
        page.push_str(part);
        rest = &rest[at + mark.len()..];
    }
    page + rest
}

fn paragraphs(marked: &[String]) -> String {
    marked.iter().map(|words| format!("<p>{}</p>\n", html(words))).collect()
}

fn write_section(Section { heading, paragraphs: words, tables, figures }: &Section, first: usize) -> String {
    let tables: String = tables.iter().map(write_table).collect();
    let figures: String =
        (first..).zip(figures).map(|(number, figure)| write_figure(figure, number)).collect();
    let figures =
        if figures.is_empty() { figures } else { format!("<div class=\"figures\">\n{figures}</div>\n") };
    let (heading, words) = (escape(heading), paragraphs(words));
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
