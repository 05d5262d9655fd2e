//! A document as one static HTML page that needs nothing else: the result, a table and a figure first; then
//! figures; then what is folded.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::{Column, Document, Table, Tile};
use crate::chart::text::{html as marked, words};
use crate::chart::{Figure, html_of_panels};
use crate::table::provenance::CREATED_BY;

const STYLE: &str = include_str!("page.css");
/// Columns of a table that have room beside a figure.
const BESIDE: usize = 6;
/// What two words mean.
const ANGLES: &str = "Slenderness (*α*): the angle at which an object tips. Restitution (*η*): its angular \
                      velocity after an impact over that before.";

impl Document {
    /// # Errors
    /// If it has nothing to show.
    pub fn html(&self) -> anyhow::Result<String> {
        anyhow::ensure!(self.has_content(), "a page without content: expected answers, responses or fits");
        let (title, first) = (words(&self.title), self.figures.first());
        // The title of the page is not said again.
        let figure = |figure: &Figure| {
            let is_said = words(&figure.title) == title;
            write_figure(figure, if is_said { "" } else { &figure.title })
        };
        let is_beside = !self.tables.is_empty() && first.is_some_and(|first| first.panels.len() == 1);
        let mut columns: Vec<Column> = self.tables.iter().take(1).flat_map(Table::columns).collect();
        let mut below = Vec::new();
        if is_beside {
            // Labels stand behind the names, where there is room for both: each part has the names.
            let (labels, first): (Vec<_>, Vec<_>) = columns.into_iter().partition(|column| column.is_label);
            let (beside, others) = first.split_at(first.len().min(BESIDE));
            let names = &beside[..usize::from(!(labels.is_empty() && others.is_empty()))];
            below = [names, &labels, others].concat();
            columns = beside.to_vec();
        }
        let told = html! {
            @if !(self.tables.is_empty() && self.notes.is_empty()) {
                div {
                    (paragraphs(&self.gaps))
                    @if let Some(table) = self.tables.first() { (write_columns(&table.caption, &columns)) }
                    div class="notes" { (paragraphs(&self.notes)) }
                }
            }
        };
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
                        div class=(if is_beside { "first" } else { "" }) {
                            @if is_beside { (told) }
                            @if let Some(first) = first { (figure(first)) }
                            @if !is_beside { (told) }
                        }
                        div class="figures" { @for one in self.figures.iter().skip(1) { (figure(one)) } }
                        @if !below.is_empty() { (write_columns("", &below)) }
                        @for table in self.tables.iter().skip(1) { (write_table(table)) }
                        div class="facts" {
                            (paragraphs(&self.facts))
                            p { (write(ANGLES)) }
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

/// Marked text.
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
            @for figure in &section.figures { (write_figure(figure, &figure.title)) }
        }
    }
}

fn write_figure(figure: &Figure, title: &str) -> Markup {
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
    write_columns(&table.caption, &table.columns().collect::<Vec<_>>())
}

fn write_columns(caption: &str, columns: &[Column]) -> Markup {
    let class = |column: &Column| column.is_number.then_some("number");
    // What is wider than a small screen is scrolled, by keys too.
    html! {
        p class="caption" { (write(caption)) }
        div class="scroll" tabindex="0" role="group" aria-label=(words(caption)) {
            table {
                thead {
                    tr {
                        @for column in columns { th scope="col" class=[class(column)] { (write(column.head)) } }
                    }
                }
                tbody {
                    @for row in 0..columns.first().map_or(0, |column| column.cells.len()) {
                        tr {
                            @for column in columns {
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
