//! The page of a list of objects: the worst first, and how many are to be expected.

use std::collections::BTreeSet;

use super::answers::{BANDS, Evaluation, Expected, Rated};
use super::object::facts;
use super::page::{Page, Table, Tile};
use super::probabilities::{self, ProbabilityRow};
use crate::chart::text::literal;
use crate::chart::{Figure, Ink};
use crate::figures::common::by;
use crate::number::{self, OF_HUNDRED, PERCENT};
use crate::table::answers::Answer;

/// The most objects that are drawn, and files whose expected numbers are shown.
const DRAWN: usize = 60;
const FILES: usize = 3;
/// Objects that are named in a sentence.
const NAMED: usize = 4;

/// How likely each object overturns, the worst first; those on floors with their floor.
pub fn figure(evaluation: &Evaluation) -> Figure {
    let when = &evaluation.when;
    let answered: Vec<&Rated> = evaluation.rows.iter().filter(|rated| rated.is_answered()).collect();
    let drawn = &answered[..answered.len().min(DRAWN)];
    let bands = ["below 2 %", "2 to 10 %", "above 10 %"];
    let rows = drawn.iter().map(|rated| {
        let band = BANDS.iter().filter(|end| rated.severity() > **end).count();
        let name = rated.object.name_and_floor();
        ProbabilityRow::new(&name, Ink::Band(band), bands[band], &[rated.row.p_overturning])
    });
    let rows: Vec<ProbabilityRow> = rows.collect();
    let rest = match answered.len() - drawn.len() {
        0 => String::new(),
        rest => format!(" Not drawn: {} that are less likely to overturn.", number::counted(rest, "object")),
    };
    let caption = format!("Probability of overturning {when} with 95 % limits.{rest}");
    let panel = (!rows.is_empty()).then(|| probabilities::panel("", when, &rows, evaluation.target));
    let title = "How likely each object is to overturn";
    Figure::new("list", title, 1, 0.0, panel.into_iter().collect()).explained(caption)
}

/// The page of several objects, of one file or of several.
pub fn page(evaluation: &Evaluation) -> Page {
    let Evaluation { when, target, hazard, rows, .. } = evaluation;
    let Some(worst) = rows.first() else { return Page::default() };
    let answered: Vec<&Rated> = rows.iter().filter(|rated| rated.is_answered()).collect();
    let title = format!("{}: how likely they are to overturn", number::counted(rows.len(), "object"));
    let (tables, same) = tables(evaluation);
    if answered.is_empty() {
        return Page { title, sentence: not_assessed(rows), tables, ..Page::default() };
    }
    let upstairs = answered.iter().filter(|rated| rated.object.is_upstairs()).count();
    let place = match upstairs {
        0 => "on the ground".to_string(),
        _ if upstairs == answered.len() => "on floors".to_string(),
        _ => format!("{} on the ground, {} on floors", answered.len() - upstairs, upstairs),
    };
    let several = rows.iter().any(|rated| rated.object.file != worst.object.file);
    let file = if several { format!(" ({})", literal(&worst.object.file)) } else { String::new() };
    let sentences = [
        format!(
            "{}{}, {}, is the most likely to overturn: {}.",
            worst.object.marked_name(),
            file,
            literal(&worst.object.place()),
            worst.sentence(when).trim_start_matches("overturns with a probability of ")
        ),
        target.map_or(String::new(), |target| worst.about_target(target)),
        not_assessed(rows),
    ];
    let friction = "With less friction than it needs, an object slides instead of rocking.".to_string();
    Page {
        title,
        place: format!("{} free-standing, {place}; {}", number::count(answered.len()), literal(hazard)),
        sentence: sentences.join(" "),
        tiles: tiles(evaluation),
        facts: same.into_iter().chain([friction]).chain(facts(&answered)).collect(),
        tables,
        notes: doubts(&answered),
        figures: vec![figure(evaluation)],
        ..Page::default()
    }
}

/// The objects without an answer, and why.
fn not_assessed(rows: &[Rated]) -> String {
    let silent = rows.iter().filter(|rated| !rated.is_answered());
    let names: Vec<String> =
        silent.map(|rated| format!("{} ({})", rated.object.marked_name(), reason(rated))).collect();
    if names.is_empty() { String::new() } else { format!("Not assessed: {}.", number::listed(&names, NAMED)) }
}

/// Why there is no answer.
fn reason(rated: &Rated) -> String {
    let words = rated.doubts.warnings.as_deref().and_then(|words| words.split(';').next());
    literal(words.unwrap_or("no reason known"))
}

fn tiles(evaluation: &Evaluation) -> Vec<Tile> {
    let Evaluation { when, target, rows, .. } = evaluation;
    let mut tiles = Vec::new();
    // The same object may stand in several files, under several hazards: their sum would be of nothing.
    let files = by(rows, |rated| &rated.object.file);
    for rows in files.iter().take(FILES) {
        let expected = Expected::new(rows.iter().copied());
        let file = literal(&rows[0].object.file);
        let file = if files.len() > 1 { format!(" ({file})") } else { String::new() };
        let words = format!("of {} objects expected to overturn {when}{file}", number::plain(expected.all));
        tiles.push(Tile::new(expected.number(), words));
    }
    if files.len() == 1 {
        let Expected { together, independent, .. } = Expected::new(rows);
        tiles.push(Tile::new(
            format!("{} to {}", OF_HUNDRED.one(together), PERCENT.one(independent)),
            "probability that at least one overturns: lower if they fall together, higher if independently",
        ));
        let most = target.unwrap_or(BANDS[0]);
        let above = rows.iter().filter(|rated| rated.severity() > most).count();
        let words = if target.is_some() { "objects above the target of" } else { "objects above" };
        tiles.push(Tile::new(number::count(above), format!("{words} {}", PERCENT.one(most))));
    }
    tiles
}

/// A table of the answers and one of what else is known, and what is the same for all objects: it has no
/// column.
fn tables(evaluation: &Evaluation) -> (Vec<Table>, Option<String>) {
    let Evaluation { when, target, rows, .. } = evaluation;
    let (overturns, too_far) = (format!("overturns {when}, %"), format!("rocks too far {when}, %"));
    let column = |cell: &dyn Fn(&Rated) -> String| -> Vec<String> { rows.iter().map(cell).collect() };
    let names = column(&|rated| rated.object.name().map_or("unnamed".to_string(), literal));
    let mut answers = vec![
        ("object", names.clone()),
        (&overturns, column(&overturns_in_words)),
        ("95 % limits", column(&limits)),
    ];
    let (mut others, mut same) = (vec![("object", names)], Vec::new());
    for (is_answer, head, cells) in [
        (true, "place", column(&|rated| rated.object.short_place())),
        (true, "file", column(&|rated| literal(&rated.object.file))),
        (true, "base for the target", column(&|rated| base(rated, *target))),
        (
            false,
            "return period, years",
            column(&|rated| rated.row.return_period_years.map_or(String::new(), number::period)),
        ),
        (false, &too_far, column(&|rated| answered(rated, OF_HUNDRED.value(rated.row.p_failure)))),
        (false, "friction needed", column(&friction)),
        (false, "size", column(&|rated| rated.object.size().replace(' ', "\u{a0}"))),
        (false, "number", column(&|rated| rated.object.count.map_or(String::new(), number::plain))),
    ] {
        let answered = rows.iter().zip(&cells).filter(|(rated, _)| rated.is_answered());
        let differ: BTreeSet<&String> = answered.map(|(_, cell)| cell).collect();
        if differ.len() > 1 {
            if is_answer { &mut answers } else { &mut others }.push((head, cells));
        } else if !["place", "file"].contains(&head) {
            let value = differ.first().filter(|value| !value.is_empty());
            same.extend(value.map(|value| format!("{head} {value}")));
        }
    }
    let tables = [answers, others].into_iter().filter(|columns| columns.len() > 1).map(|columns| Table {
        heads: columns.iter().map(|(head, _)| head.to_string()).collect(),
        rows: (0..rows.len())
            .map(|row| columns.iter().map(|(_, cells)| cells[row].clone()).collect())
            .collect(),
        ..Table::default()
    });
    (tables.collect(), (!same.is_empty()).then(|| format!("The same for all: {}.", same.join(", "))))
}

/// The cell of an object that has an answer.
fn answered(rated: &Rated, cell: String) -> String {
    if rated.is_answered() { cell } else { String::new() }
}

/// The probability of overturning, or why there is no answer.
fn overturns_in_words(rated: &Rated) -> String {
    let value = rated.row.p_overturning.value.map_or(String::new(), |p| OF_HUNDRED.one(p));
    if rated.is_answered() { value } else { reason(rated) }
}

/// The limits, or the range without a value.
fn limits(rated: &Rated) -> String {
    let p = rated.row.p_overturning;
    answered(rated, if p.value.is_some() { OF_HUNDRED.span(p) } else { OF_HUNDRED.value(p) })
}

/// The base with which an object meets the target, if there is one.
fn base(rated: &Rated, target: Option<f64>) -> String {
    match rated.base() {
        _ if target.is_some_and(|target| rated.meets(target)) => "meets it".to_string(),
        None if target.is_some() && rated.is_answered() => "none".to_string(),
        base => base.unwrap_or_default().replace(' ', "\u{a0}"),
    }
}

/// The friction that an object needs; nothing if it is known to have enough.
fn friction(rated: &Rated) -> String {
    let friction = rated.object.friction.filter(|_| !rated.object.is_friction_known);
    friction.map_or(String::new(), |friction| number::fixed(friction, 2))
}

/// What speaks against answers: a line for those of the same words.
pub fn doubts<R>(all: &[&Answer<R>]) -> Vec<String> {
    let doubted = all.iter().filter_map(|answer| Some((*answer, answer.doubts.warnings.as_deref()?)));
    let mut lines = Vec::new();
    for same in by(doubted, |(_, words)| words) {
        let names: Vec<String> = same.iter().map(|(answer, _)| answer.object.marked_name()).collect();
        lines.push(format!("{}: {}", number::listed(&names, NAMED), literal(same[0].1)));
    }
    lines
}
