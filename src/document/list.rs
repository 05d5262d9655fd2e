//! The document of several objects, the worst first, and how many are to be expected.

use std::collections::BTreeSet;

use super::phrases::{facts, intensity, intensity_cells};
use super::{Document, Table, Tile};
use crate::answer::{Answer, AnswerTable, Before, StateColumns};
use crate::chart::text::literal;
use crate::figures::answers::{self, BANDS};
use crate::figures::common::by;
use crate::number::{OF_HUNDRED, PERCENT, TWO_DIGITS, count, counted, fixed, listed, period, plain};

/// The most files whose expected numbers are shown, and objects that are named in a sentence.
const FILES: usize = 3;
const NAMED: usize = 4;

/// Of one table, or of several that were joined; sorted, the worst first.
pub fn document(table: &AnswerTable) -> Document {
    let Some(worst) = table.rows.first() else { return Document::default() };
    let answered: Vec<&Answer> = table.rows.iter().filter(|answer| answer.is_answered()).collect();
    let when = Answer::when_of_all(&table.rows);
    let over = table.rows.iter().find_map(|answer| answer.fragility.over);
    let what = if over.is_some() { "what motions overturn" } else { "how likely to overturn" };
    let title = format!("{}: {what}", counted(table.rows.len(), "object"));
    let news: Vec<&Answer> = table.rows.iter().filter(|answer| answer.is_news()).collect();
    let (all, same) = table_of(&news, &when);
    if answered.is_empty() {
        let lead = not_assessed(&table.rows).into_iter().collect();
        return Document { title, lead, tables: vec![all], ..Document::default() };
    }
    let upstairs = answered.iter().filter(|answer| answer.object.is_upstairs()).count();
    let [all_free, upstairs] = [answered.len(), upstairs].map(count);
    let whose = format!(" of {}", worst.object.called());
    let lead = [Some(worst_of(table)), worst.about_target(&whose), not_assessed(&table.rows)];
    Document {
        title,
        place: format!("{all_free} free-standing ({upstairs} on floors){}", table.conditions()),
        lead: lead.into_iter().flatten().collect(),
        tiles: if over.is_some() || table.rows.len() == 1 { Vec::new() } else { tiles(table, &when) },
        facts: same.into_iter().chain(facts(&answered, table.hazard.as_ref())).collect(),
        tables: [all].into_iter().chain(changes(&table.variants, &when)).collect(),
        notes: doubts(&answered),
        figures: match over {
            Some(_) => answers::fragilities(&answered),
            None => vec![answers::list(&news, &when, worst.rates.target)],
        },
        ..Document::default()
    }
}

/// The object that is the most likely to overturn, if one may.
fn worst_of(table: &AnswerTable) -> String {
    let worst = &table.rows[0];
    let name = format!("{}{}, {},", worst.object.called(), file_of(worst, table), worst.object.place());
    let how_often = worst.how_often();
    match how_often.strip_prefix("overturns ") {
        _ if table.rows.len() == 1 => format!("{name} {how_often}."),
        Some(often) => format!("{name} is the most likely to overturn: {often}."),
        None if worst.fragility.over.is_some() => format!("{name} is the weakest: it {how_often}."),
        None => "Nothing overturns.".to_string(),
    }
}

/// The file of an answer, where there are several.
fn file_of(answer: &Answer, table: &AnswerTable) -> String {
    let several = table.rows.iter().any(|other| other.file != answer.file);
    if several { format!(" ({})", literal(&answer.file)) } else { String::new() }
}

/// The objects without an answer; the table says why.
fn not_assessed(answers: &[Answer]) -> Option<String> {
    let silent = answers.iter().filter(|answer| !answer.is_answered());
    let names: Vec<String> = silent.map(|answer| answer.object.called()).collect();
    let [some, all] = [names.len(), answers.len()].map(count);
    (!names.is_empty()).then(|| format!("Not assessed, {some} of {all}: {}.", listed(&names, NAMED)))
}

fn tiles(table: &AnswerTable, when: &str) -> Vec<Tile> {
    let mut tiles = Vec::new();
    // The same object may stand in several files, under several hazards: their sum would be of nothing.
    let files = by(&table.rows, |answer| &answer.file);
    for answers in files.iter().take(FILES) {
        let answered = answers.iter().filter(|answer| answer.is_answered());
        let all: f64 = answered.map(|answer| answer.object.count.unwrap_or(1.0)).sum();
        let (all, file) = (counted(all as usize, "object"), file_of(answers[0], table));
        let limits = TWO_DIGITS.limits(answers[0].list.expected_number, "95 % limits ");
        let words = format!("of {all} expected to overturn {when}{limits}{file}");
        tiles.push(Tile::new(expected_number(answers.iter().copied()), words));
    }
    if files.len() == 1 {
        let any = table.rows[0].list.at_least_one;
        let words = format!("probability that at least one overturns{}", PERCENT.limits(any, "95 % limits "));
        tiles.extend(any.value.or(any.high).map(|_| Tile::new(PERCENT.value(any), words)));
        let target = table.rows[0].rates.target;
        let most = target.unwrap_or(BANDS[0]);
        let above = table.rows.iter().filter(|answer| answer.severity() > most).count();
        let words = if target.is_some() { "above the target of" } else { "above" };
        tiles.push(Tile::new(count(above), format!("{words} {}", PERCENT.one(most))));
    }
    tiles
}

/// The expected number of the objects of a file that overturn.
pub fn expected_number<'a>(answers: impl IntoIterator<Item = &'a Answer>) -> String {
    let mut answers = answers.into_iter().peekable();
    let of_list = answers.peek().and_then(|answer| answer.list.expected_number.value);
    let number = |answer: &Answer| Some(answer.object.count.unwrap_or(1.0) * answer.p.p_overturning.value?);
    TWO_DIGITS.one(of_list.unwrap_or_else(|| answers.filter_map(number).sum()))
}

/// What stands in a cell of an answer.
type Cell = fn(&Answer) -> String;

/// The columns; of those in the time of exposure there is an @.
const COLUMNS: [(&str, Cell); 24] = [
    ("change", |answer| of_before(answer, |before| before.changes.join("; "))),
    ("before, %", |answer| of_before(answer, |before| OF_HUNDRED.value(before.p))),
    ("overturns @, %", |answer| answer.p.p_overturning.value.map_or(String::new(), |p| OF_HUNDRED.one(p))),
    ("half overturn at", |answer| of_fragility(answer, 0)),
    ("95 % limits", limits),
    ("times as often", |answer| of_before(answer, Before::times)),
    ("times, 95 % limits", |answer| of_before(answer, |before| TWO_DIGITS.span(before.ratio))),
    ("16 %", |answer| of_fragility(answer, 2)),
    ("84 %", |answer| of_fragility(answer, 3)),
    ("beta", |answer| of_fragility(answer, 4)),
    ("over PGA half at", |answer| answer.over_pga.as_deref().map_or(String::new(), |of| of_fragility(of, 0))),
    ("over PGA, limits", |answer| answer.over_pga.as_deref().map_or(String::new(), |of| of_fragility(of, 1))),
    ("place", |answer| answer.object.short_place()),
    ("file", |answer| literal(&answer.file)),
    ("base for the target", base),
    ("half rock too far, or overturn at", |Answer { fragility, .. }| {
        fragility.over.map_or(String::new(), |over| intensity(over, fragility.failure.theta.value))
    }),
    ("years", |answer| answer.rates.years.map_or(String::new(), plain)),
    ("return period, years", |answer| answer.rates.return_period_years.map_or(String::new(), period)),
    ("rocks too far @, %", |answer| of_states(answer, |p| OF_HUNDRED.value(p.p_failure))),
    ("friction needed", |answer| answer.object.friction_needed().map_or(String::new(), |of| fixed(of, 2))),
    ("size", |answer| answer.object.size().replace(' ', "\u{a0}")),
    ("number", |answer| answer.object.count.map_or(String::new(), plain)),
    ("responses", |answer| answer.object.responses.map_or(String::new(), |n| count(n as usize))),
    ("not assessed", |answer| if answer.is_answered() { String::new() } else { answer.reason() }),
];
/// Columns that are there although all objects have the same; others are then said once, but for these.
const ALWAYS: [&str; 7] = [
    "change",
    "before, %",
    "overturns @, %",
    "95 % limits",
    "times as often",
    "times, 95 % limits",
    "not assessed",
];
const UNSAID: [&str; 4] = ["place", "file", "years", "responses"];

/// The answers, and what is the same for all objects.
fn table_of(answers: &[&Answer], when: &str) -> (Table, Option<String>) {
    let mut rows: Vec<Vec<String>> = answers.iter().map(|answer| vec![answer.object.called()]).collect();
    let (mut heads, mut same) = (vec!["object".to_string()], Vec::new());
    for (heading, _) in answers.iter().flat_map(|answer| &answer.labels) {
        let head = literal(heading);
        if !heads.contains(&head) {
            heads.push(head);
            for (row, answer) in rows.iter_mut().zip(answers) {
                let label = answer.labels.iter().find(|(other, _)| other == heading);
                row.push(label.map_or(String::new(), |(_, cell)| literal(cell)));
            }
        }
    }
    let labels = heads.len() - 1;
    for (name, cell) in &COLUMNS {
        let head = name.replace('@', when);
        let known = answers.iter().filter(|answer| answer.is_answered());
        let differ: BTreeSet<String> = known.map(|answer| cell(answer)).collect();
        if differ.len() > 1 || ALWAYS.contains(name) {
            heads.push(head);
            rows.iter_mut().zip(answers).for_each(|(row, answer)| row.push(cell(answer)));
        } else if !UNSAID.contains(name) {
            same.extend(
                differ.first().filter(|value| !value.is_empty()).map(|value| format!("{head} {value}")),
            );
        }
    }
    let same = (!same.is_empty()).then(|| format!("The same for all: {}.", same.join(", ")));
    (Table { heads, rows, labels, ..Table::default() }, same)
}

/// What would change the worst objects.
fn changes(variants: &[Answer], when: &str) -> Option<Table> {
    let rows = variants.iter().map(|one| {
        let (p, words) = (one.p.p_overturning, one.variant.clone().unwrap_or_default());
        vec![one.object.called(), words, OF_HUNDRED.value(p), OF_HUNDRED.span(p)]
    });
    let heads = ["object", "changed", &format!("overturns {when}, %"), "95 % limits"];
    (!variants.is_empty()).then(|| {
        Table::new(&heads, rows.collect()).explained("What would change the worst, one thing at a time")
    })
}

/// A cell of the probabilities of an object that has them.
fn of_states(answer: &Answer, cell: fn(&StateColumns) -> String) -> String {
    let has_them = answer.is_answered() && answer.fragility.over.is_none();
    if has_them { cell(&answer.p) } else { String::new() }
}

fn of_before(answer: &Answer, cell: fn(&Before) -> String) -> String {
    answer.before.as_deref().map_or(String::new(), cell)
}

/// A cell of the intensities that overturn an object.
fn of_fragility(Answer { fragility, .. }: &Answer, cell: usize) -> String {
    fragility.over.map_or(String::new(), |over| intensity_cells(over, &fragility.overturning)[cell].clone())
}

fn limits(answer: &Answer) -> String {
    of_fragility(answer, 1) + &of_states(answer, |p| OF_HUNDRED.span(p.p_overturning))
}

/// The base with which an object meets the target, if there is one.
fn base(answer: &Answer) -> String {
    match answer.rates.target.filter(|_| answer.is_answered()) {
        None => String::new(),
        Some(target) if answer.severity() <= target => "meets it".to_string(),
        Some(_) => {
            answer.base(|side| side.value).map_or("none".to_string(), |base| base.replace(' ', "\u{a0}"))
        }
    }
}

/// What speaks against answers: a line for those of the same words.
pub fn doubts(answers: &[&Answer]) -> Vec<String> {
    let doubted =
        answers.iter().filter_map(|answer| Some((*answer, answer.uncertainty.warnings.as_deref()?)));
    let mut lines = Vec::new();
    for same in by(doubted, |(_, words)| words) {
        let names: Vec<String> = same.iter().map(|(answer, _)| answer.object.called()).collect();
        lines.push(format!("{}: {}", listed(&names, NAMED), literal(same[0].1)));
    }
    lines
}
