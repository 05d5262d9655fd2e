//! A document for a terminal.

use std::path::Path;

use super::{Document, Table};
use crate::chart::text::words;
use crate::number::{self, LONGEST_TEXT, aligned, shown};

/// Rows of a table that are printed, of one that goes to a file or is longer than the second number.
const PRINTED: [usize; 2] = [20, 40];

impl Document {
    /// The result, its table, of a long one or one that goes to a file the first rows, and what it rests on.
    pub fn text(&self, out: Option<&Path>) -> String {
        let mut lines = Vec::new();
        let mut lead = self.lead.iter().map(|sentence| words(sentence));
        let first = lead.next().unwrap_or_default();
        let of_title = first.strip_prefix("It ").map(|rest| format!("{}: {rest}", words(&self.title)));
        lines.push(of_title.as_ref().unwrap_or(&first).trim_end_matches('.').to_string());
        lines.extend(self.gaps.iter().map(|gaps| words(gaps)));
        lines.extend(self.tables.first().map(|table| table.text(out)));
        for table in self.overview.iter().chain(self.tables.iter().skip(1)) {
            lines.extend([words(&table.caption), table.text(None)]);
        }
        lines.extend(lead);
        // What is of one thing stands in its table.
        let tiles = self.tiles.iter().filter(|_| of_title.is_none());
        lines.extend(tiles.map(|tile| format!("{} {}.", words(&tile.number), words(&tile.words))));
        lines.extend(self.facts.iter().map(|fact| words(fact)));
        lines.extend(Some(words(&self.place)).filter(|place| !place.is_empty()).map(|place| place + "."));
        let mut text = String::new();
        for line in lines.iter().flat_map(|lines| lines.lines()) {
            text += &format!("{}\n", shown(line, LONGEST_TEXT));
        }
        text
    }
}

impl Table {
    pub fn text(&self, out: Option<&Path>) -> String {
        let columns: Vec<_> = self.columns().filter(|column| !column.is_label).collect();
        let all = self.rows.len();
        let most = if out.is_some() || all > PRINTED[1] { all.min(PRINTED[0]) } else { all };
        let plain = |cell: &str| words(cell).replace('\u{a0}', " ");
        let heads = columns.iter().map(|column| plain(column.head)).collect();
        let rows = (0..most).map(|row| columns.iter().map(|column| plain(column.cells[row])).collect());
        let lines: Vec<Vec<String>> = std::iter::once(heads).chain(rows).collect();
        let others = match (all - most, out) {
            (0, _) => String::new(),
            (others, Some(out)) => format!("and {} more, in {}\n", number::count(others), out.display()),
            (others, None) => format!("and {} more, by --out or --format csv\n", number::count(others)),
        };
        aligned(&lines, |column| columns[column].is_number) + &others
    }
}
