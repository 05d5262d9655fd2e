//! Rows of a text: cells between commas, semicolons, tabs or blanks.

use csv::{ReaderBuilder, StringRecord, Trim};

use super::error::{InputError, Result, expect_few_cells};
use super::grid::Source;
use super::layout::{RawRow, SHOWN, uncommented};
use super::numbers::is_number;

pub fn rows(text: &str) -> Result<(Vec<RawRow>, Source)> {
    let text = text.trim_end_matches(['\x1a', '\0', '\n', ' ']);
    let are_between_blanks = are_between_blanks(text);
    let mut best: Option<(Vec<RawRow>, f64)> = None;
    for separator in [',', '\t', ';'] {
        // Among numbers between blanks, a comma is a decimal one.
        if text.contains(separator) && !(separator == ',' && are_between_blanks) {
            let rows = parted(text, separator)?;
            let share = share_of_numbers(&rows);
            if share > best.as_ref().map_or(0.0, |(_, share)| *share) {
                best = Some((rows, share));
            }
        }
    }
    let Some((rows, ..)) = best else { return Ok((between_blanks(text), Source::Blanks)) };
    // A quotation mark that is never closed has all text behind it in one cell.
    let last = rows.last().filter(|_| !text.ends_with('"'));
    match last.filter(|row| row.cells.iter().next_back().is_some_and(|cell| cell.contains('\n'))) {
        Some(row) => Err(InputError::Quote { line: row.line }),
        None => Ok((rows, Source::Signs)),
    }
}

fn parted(text: &str, separator: char) -> Result<Vec<RawRow>> {
    expect_few_cells(text.matches([separator, '\n']).count())?;
    let mut reader = ReaderBuilder::new();
    reader.has_headers(false).flexible(true).trim(Trim::All).delimiter(separator as u8);
    let mut reader = reader.from_reader(text.as_bytes());
    let (mut rows, mut line, mut seen) = (Vec::new(), 1, 0);
    let mut cells = StringRecord::new();
    while let (at, true) =
        (reader.position().byte() as usize, reader.read_record(&mut cells).unwrap_or(false))
    {
        // The reader passes over empty lines.
        let start = at + text[at..].len() - text[at..].trim_start_matches(['\n', ' ', '\x0c']).len();
        line += text[seen..start].matches('\n').count();
        seen = start;
        rows.push(RawRow::new(line, std::mem::take(&mut cells), text[start..].lines().next()));
    }
    rows.retain(|row| row.cells.iter().any(|cell| !cell.is_empty()));
    Ok(rows)
}

fn between_blanks(text: &str) -> Vec<RawRow> {
    let rows = text.lines().zip(1..).map(|(line, number)| {
        // A unit in brackets belongs to its heading, and the sign of a comment to its first word.
        let bare = uncommented(line.trim());
        let words = bare.replace(" (", "(").replace(" [", "[");
        let sign = line.trim()[..line.trim().len() - bare.len()].trim_end();
        let mut words = words.split_whitespace();
        let first = words.next().map(|word| format!("{sign}{word}")).into_iter();
        RawRow::new(number, first.chain(words.map(str::to_string)).collect(), Some(line))
    });
    rows.filter(|row| !row.cells.is_empty()).collect()
}

/// Whether most of the last lines are numbers between blanks, without commas behind them.
fn are_between_blanks(text: &str) -> bool {
    let last: Vec<&str> = text.lines().rev().filter(|line| !line.trim().is_empty()).take(SHOWN).collect();
    let are_numbers = |line: &&&str| {
        let mut words = line.split_whitespace();
        line.trim().contains(' ') && words.all(|word| !word.ends_with(',') && is_number(word))
    };
    2 * last.iter().filter(are_numbers).count() > last.len()
}

/// The share of numbers among the cells of the last rows, by the share of rows that are parted; 0 where less
/// than a quarter are.
fn share_of_numbers(rows: &[RawRow]) -> f64 {
    let last: Vec<&RawRow> = rows.iter().rev().filter(|row| !row.is_comment).take(SHOWN).collect();
    let parted = last.iter().filter(|row| row.cells.len() > 1).count();
    let cells = || last.iter().flat_map(|row| &row.cells);
    let share = (parted * cells().filter(|cell| is_number(cell)).count().max(1)) as f64;
    if 4 * parted < last.len() { 0.0 } else { share / (last.len() * cells().count()) as f64 }
}
