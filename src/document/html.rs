//! A document as one static HTML page that needs nothing else: the result, a table and a figure first; then
//! figures; then what is folded.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::{Column, Document, Table, Tile};
use crate::chart::text::{html as marked, words};
use crate::chart::{Figure, html_of_panels};
use crate::table::provenance::CREATED_BY;

const STYLE: &str = include_str!("page.css");

impl Document {
    /// An error if it has nothing to show.
    pub fn html(&self) -> anyhow::Result<String> {
        anyhow::ensure!(self.has_content(), "a page without content: expected answers, responses or fits");
        let (title, first) = (words(&self.title), self.figures.first());
        let figure = |figure: &Figure| write_figure(figure, &self.title);
        let is_beside = !self.overview.is_empty() && first.is_some_and(|first| first.panels.len() == 1);
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta name="generator" content=(CREATED_BY);
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    meta name="color-scheme" content="light dark";
                    title { (title) }
                    link rel="icon" href="data:,";
                    style { (PreEscaped(STYLE)) }
                }
                body {
                    header {
                        h1 { (write(&self.title)) }
                        p class="place" { (write(&self.place)) }
                        p class="by" { (write(&self.byline)) }
                        p class="lead" { (write(&self.lead.join(" "))) }
                        div class="tiles" {
                            @for Tile { number, words } in &self.tiles {
                                div { b { (write(number)) } span { (write(words)) } }
                            }
                        }
                    }
                    main {
                        @for gaps in &self.gaps { p class="caption" { (write(gaps)) } }
                        div class=(if is_beside { "first" } else { "" }) {
                            div { @for table in &self.overview { (write_table(table)) } }
                            @if let Some(first) = first { (figure(first)) }
                        }
                        @for table in self.tables.iter().take(1) { (write_table(table)) }
                        div class="notes" { (paragraphs(&self.notes)) }
                        div class="figures" { @for one in self.figures.iter().skip(1) { (figure(one)) } }
                        @for table in self.tables.iter().skip(1) { (write_table(table)) }
                        section class="basis" {
                            h2 { (if self.assumptions.is_empty() { "" } else { "Assumptions and limits" }) }
                            div class="facts" { (paragraphs(&self.facts)) (paragraphs(&self.assumptions)) }
                        }
                        @for section in &self.sections { (write_section(section)) }
                    }
                    footer { "Made by " (CREATED_BY) "." }
                }
            }
        };
        Ok(page.into_string())
    }
}

fn write(text: &str) -> Markup {
    PreEscaped(marked(text))
}

fn paragraphs(all: &[String]) -> Markup {
    html! { @for words in all { p { (write(words)) } } }
}

fn write_section(section: &Document) -> Markup {
    html! {
        details {
            summary { (write(&section.title)) }
            (paragraphs(&section.facts))
            @for table in &section.tables { (write_table(table)) }
            @for figure in &section.figures { (write_figure(figure, &section.title)) }
        }
    }
}

/// The title of what it stands in is not said again.
fn write_figure(figure: &Figure, said: &str) -> Markup {
    let title = if figure.title == said { "" } else { &figure.title };
    let panels = PreEscaped(html_of_panels(figure));
    let caption = html! { p class="caption" { (write(&figure.caption)) } };
    html! {
        section class="figure" style={ "--across:" (figure.panels.len().min(3)) } {
            h2 { (write(title)) }
            @if figure.beside.is_empty() {
                (panels) (caption)
            } @else {
                div class="response" {
                    figure { (PreEscaped(&figure.beside)) (caption) }
                    div { (panels) }
                }
            }
        }
    }
}

fn write_table(table: &Table) -> Markup {
    let columns: Vec<Column> = table.columns().collect();
    let class = |column: &Column| match (column.is_number, column.is_short) {
        (true, _) => Some("number"),
        (_, true) => Some("short"),
        _ => None,
    };
    // What is wider than a small screen is scrolled, by keys too.
    html! {
        p class="caption" { (write(&table.caption)) }
        div class="scroll" tabindex="0" role="group" aria-label=(words(&table.caption)) {
            table {
                thead {
                    tr {
                        @for column in &columns { th scope="col" class=[class(column)] { (write(column.head)) } }
                    }
                }
                tbody {
                    @for row in 0..table.rows.len() {
                        tr {
                            @for column in &columns {
                                td class=[class(column)] data-head=(words(column.head)) {
                                    (write(column.cells[row]))
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}
