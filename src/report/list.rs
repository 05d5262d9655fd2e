//! The page of a list of objects: the worst first, and how many are to be expected.

use std::collections::BTreeSet;

use super::answers::{BANDS, Evaluation, Expected, Rated, base_in_words};
use super::figure::{Figure, Ink};
use super::figures::common::by;
use super::object::facts;
use super::page::{Column, Page, Table, Tile};
use super::probabilities::{self, Row};
use super::text::literal;
use crate::number::{self, Limited, OF_HUNDRED, PERCENT};
use crate::table::answers::Answer;

/// The most objects that are drawn, and files whose expected numbers are shown.
const DRAWN: usize = 60;
const FILES: usize = 3;
/// Objects that are named in a sentence.
const NAMED: usize = 4;
const GROUND: &str = "ground";

/// An object of one of several evaluations.
#[derive(Clone, Copy)]
struct Listed<'a> {
    evaluation: &'a Evaluation,
    rated: &'a Rated,
}

/// Objects of all evaluations, the worst first, those without an answer last.
fn sorted(evaluations: &[Evaluation]) -> Vec<Listed<'_>> {
    let mut all: Vec<Listed> = evaluations
        .iter()
        .flat_map(|evaluation| evaluation.rows.iter().map(move |rated| Listed { evaluation, rated }))
        .collect();
    all.sort_by(|a, b| b.rated.severity().total_cmp(&a.rated.severity()));
    all
}

/// How likely each object overturns, those on the ground and those on floors apart.
pub fn figure(evaluations: &[Evaluation]) -> Figure {
    let mut answered: Vec<&Rated> = sorted(evaluations).iter().map(|listed| listed.rated).collect();
    answered.retain(|rated| rated.is_answered());
    let drawn = &answered[..answered.len().min(DRAWN)];
    // Those on the ground and those on floors, the worst first.
    let (first, others): (Vec<&Rated>, Vec<&Rated>) =
        drawn.iter().partition(|rated| rated.object.floor().is_some() == drawn[0].object.floor().is_some());
    let is_split = !others.is_empty();
    let when = evaluations.first().map_or("", |evaluation| evaluation.when.as_str());
    let target = evaluations.iter().find_map(|evaluation| evaluation.target);
    let all = drawn.iter().map(|rated| rated.row.p_overturning).chain([Limited::value(target)]);
    let x = probabilities::axis(&format!("probability of overturning {when}"), all);
    let bands = [(Ink::Band(2), "above 10 %"), (Ink::Band(1), "2 to 10 %"), (Ink::Band(0), "below 2 %")];
    let mut panels = Vec::new();
    for group in [first, others] {
        let title = match group.first() {
            None => continue,
            Some(one) if one.object.floor().is_some() => "On floors",
            Some(_) => "On the ground",
        };
        let row = |rated: &&Rated| {
            Row::new(&rated.object.marked_name(), Ink::Band(rated.band()), &[rated.row.p_overturning])
        };
        let rows: Vec<Row> = group.iter().map(row).collect();
        let title = if is_split { title } else { "" };
        panels.push(probabilities::panel(title, x.clone(), &rows, &bands, target));
    }
    let rest = match answered.len() - drawn.len() {
        0 => String::new(),
        rest => format!(" Not drawn: {} that are less likely to overturn.", number::counted(rest, "object")),
    };
    let caption = format!("Probability of overturning {when} with 95 % limits.{rest}");
    Figure::new("list", "How likely each object is to overturn", 1, 0.0, panels).explained(caption)
}

/// The page of several objects, of one file or of several.
pub fn page(evaluations: &[Evaluation]) -> Page {
    let all = sorted(evaluations);
    let Some(Listed { evaluation, rated: worst }) = all.first() else { return Page::default() };
    let answered: Vec<&Rated> =
        all.iter().map(|listed| listed.rated).filter(|rated| rated.is_answered()).collect();
    let upstairs = answered.iter().filter(|rated| rated.object.floor().is_some()).count();
    let place = match upstairs {
        0 => "on the ground".to_string(),
        _ if upstairs == answered.len() => "on floors".to_string(),
        _ => format!("{} on the ground, {} on floors", answered.len() - upstairs, upstairs),
    };
    let mut hazards: Vec<&str> = evaluations.iter().map(|evaluation| evaluation.hazard.as_str()).collect();
    hazards.dedup();
    let several = evaluations.len() > 1;
    let file = if several { format!(" ({})", literal(&evaluation.file)) } else { String::new() };
    let title = format!("{}: how likely they are to overturn", number::counted(all.len(), "object"));
    let (table, same) = table(&all);
    if answered.is_empty() {
        return Page { title, sentence: not_assessed(&all), table: Some(table), ..Page::default() };
    }
    let friction = "With less friction than it needs, an object slides instead of rocking.".to_string();
    let facts = [same, Some(friction)].into_iter().flatten().chain(facts(&answered));
    Page {
        title,
        place: format!(
            "{} free-standing, {place}; {}",
            number::count(answered.len()),
            literal(&hazards.join("; "))
        ),
        sentence: format!(
            "{}{file} is the most likely to overturn: it {}. {}",
            worst.object.marked_name(),
            worst.sentence(&evaluation.when),
            not_assessed(&all)
        ),
        tiles: tiles(evaluations, &evaluation.when),
        facts: facts.collect(),
        table: Some(table),
        notes: doubts(&answered),
        figures: vec![figure(evaluations)],
        ..Page::default()
    }
}

/// The objects without an answer, and why.
fn not_assessed(all: &[Listed]) -> String {
    let silent = all.iter().map(|listed| listed.rated).filter(|rated| !rated.is_answered());
    let reason = |rated: &Rated| {
        let words = rated.doubts.warnings.as_deref()?.split(';').next()?;
        Some(format!(" ({})", literal(words)))
    };
    let names: Vec<String> =
        silent.map(|rated| rated.object.marked_name() + &reason(rated).unwrap_or_default()).collect();
    if names.is_empty() { String::new() } else { format!("Not assessed: {}.", number::listed(&names, NAMED)) }
}

fn tiles(evaluations: &[Evaluation], when: &str) -> Vec<Tile> {
    let mut tiles = Vec::new();
    // The same object may stand in several files, under several hazards: their sum would be of nothing.
    for evaluation in evaluations.iter().take(FILES) {
        let expected = Expected::new(&evaluation.rows);
        let file =
            if evaluations.len() > 1 { format!(" ({})", literal(&evaluation.file)) } else { String::new() };
        let words = format!("objects expected to overturn {when}, of {}{file}", number::plain(expected.all));
        tiles.push(Tile::new(expected.number(), words));
    }
    if let [one] = evaluations {
        let Expected { together, independent, .. } = Expected::new(&one.rows);
        tiles.push(Tile::new(
            format!("{} to {}", OF_HUNDRED.one(together), PERCENT.one(independent)),
            "probability that at least one does: if all fall together, to if each falls by itself",
        ));
        let most = one.target.unwrap_or(BANDS[0]);
        let above = one.rows.iter().filter(|rated| rated.severity() > most).count();
        let most = PERCENT.one(most) + if one.target.is_some() { ", the target" } else { "" };
        tiles.push(Tile::new(number::count(above), format!("more likely to overturn than {most}")));
    }
    tiles
}

/// The table, and what is the same for all objects: it has no column.
fn table(all: &[Listed]) -> (Table, Option<String>) {
    let when = &all[0].evaluation.when;
    let (overturns, too_far) = (format!("overturns {when}, %"), format!("rocks too far {when}, %"));
    let mut table = Table { rows: vec![Vec::new(); all.len()], ..Table::default() };
    let mut same = Vec::new();
    for (head, is_number, cell) in [
        ("object", false, name as fn(&Listed) -> String),
        (&overturns, true, probability),
        ("95 % limits", false, limits),
        ("once in years", true, |listed| {
            listed.rated.row.return_period_years.map_or(String::new(), number::period)
        }),
        (&too_far, true, |listed| match listed.rated.is_answered() {
            true => OF_HUNDRED.value(listed.rated.row.p_failure),
            false => String::new(),
        }),
        ("base for the target", false, base),
        ("friction needed", true, friction),
        ("size", false, |listed| listed.rated.object.set_size().replace(' ', "\u{a0}")),
        ("number", true, |listed| listed.rated.object.count.map_or(String::new(), number::plain)),
        ("where", false, place),
        ("file", false, |listed| literal(&listed.evaluation.file)),
    ] {
        let cells: Vec<String> = all.iter().map(cell).collect();
        let answered = all.iter().zip(&cells).filter(|(listed, _)| listed.rated.is_answered());
        let differ: BTreeSet<&String> = answered.map(|(_, cell)| cell).collect();
        if differ.len() > 1 || table.columns.len() < 5 {
            table.columns.push(Column { head: head.to_string(), is_number });
            table.rows.iter_mut().zip(cells).for_each(|(row, cell)| row.push(cell));
        } else if head != "file" {
            let value = differ.first().filter(|value| !["", GROUND].contains(&value.as_str()));
            same.extend(value.map(|value| format!("{head} {value}")));
        }
    }
    (table, (!same.is_empty()).then(|| format!("The same for all: {}.", same.join(", "))))
}

fn name(listed: &Listed) -> String {
    listed.rated.object.name().map_or("unnamed".to_string(), literal)
}

fn probability(Listed { rated, .. }: &Listed) -> String {
    if rated.is_answered() { OF_HUNDRED.value(rated.row.p_overturning) } else { "not assessed".to_string() }
}

/// The limits, or why there is no answer.
fn limits(Listed { rated, .. }: &Listed) -> String {
    match rated.is_answered() {
        true => OF_HUNDRED.limits(rated.row.p_overturning, "").replace(['(', ')'], ""),
        false => literal(rated.doubts.warnings.as_deref().unwrap_or_default()),
    }
}

/// The base with which an object meets the target, if there is one.
fn base(Listed { evaluation, rated }: &Listed) -> String {
    let p = rated.row.p_overturning;
    let is_met = evaluation.target.zip(p.value.or(p.high)).is_some_and(|(target, p)| p <= target);
    let base = base_in_words(rated.row.bases.target_width_m, rated.row.bases.target_sides_m);
    if is_met { "meets it".to_string() } else { base.unwrap_or_default() }
}

/// The friction that an object needs; nothing if it is known to have enough.
fn friction(Listed { rated, .. }: &Listed) -> String {
    let friction = rated.object.friction.filter(|_| !rated.object.is_friction_known);
    friction.map_or(String::new(), |friction| number::fixed(friction, 2))
}

fn place(listed: &Listed) -> String {
    let floor = listed.rated.object.floor();
    floor.map_or(GROUND.to_string(), |floor| {
        floor.replace(" of a", ",").replace(" building", "").replace(' ', "\u{a0}")
    })
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
