//! The document of several objects, the worst first, and how many are to be expected.

use std::collections::BTreeSet;

use super::phrases::{assumptions, facts, intensity_cells};
use super::{Document, Table, Tile, object};
use crate::answer::{Answer, AnswerTable, Before, Detail};
use crate::chart::text::literal;
use crate::figures::answers;
use crate::inputs::SECTION;
use crate::number::{OF_HUNDRED, PERCENT, TWO_DIGITS, count, counted, length, listed, plain};
use crate::table::rows::{by, distinct};

/// The most files whose expected numbers are shown, and objects that are named in a sentence.
const FILES: usize = 3;
const NAMED: usize = 4;

/// Of one table, or of several that were joined; sorted, the worst first.
pub fn document(table: &AnswerTable) -> Document {
    let Some(worst) = table.rows.first() else { return Document::default() };
    let answered: Vec<&Answer> = table.rows.iter().filter(|answer| answer.is_answered()).collect();
    let when = Answer::when_of_all(&table.rows);
    let over = table.rows.iter().find_map(|answer| answer.fragility.over);
    let all = pieces(&table.rows);
    let several = table.rows.iter().any(|answer| answer.file != worst.file);
    let of_what = if several { "Objects of several files".to_string() } else { counted(all, "object") };
    let title = match over {
        Some(_) => format!("{of_what}: what motions overturn"),
        None => format!("{of_what}: how likely to overturn {when}"),
    };
    // What is changed comes first.
    let (news, others): (Vec<&Answer>, Vec<&Answer>) = table.rows.iter().partition(|answer| answer.is_news());
    let (rows, same) = table_of(&[&news[..], &others].concat(), &when);
    if answered.is_empty() {
        let lead = not_assessed(&table.rows).into_iter().collect();
        return Document { title, lead, tables: vec![rows], ..Document::default() };
    }
    let assessed = count(pieces(answered.iter().copied()));
    let whose = format!(" of {}", worst.object.called());
    let target = worst.about_target(&whose).filter(|_| worst.rates.target < Some(worst.severity()));
    let lead = [Some(worst_of(table)), target, not_assessed(&table.rows)];
    let sections = table.details.iter().filter_map(|detail| section(table, detail));
    let of_section = |answer: &Answer| literal(answer.label(SECTION).unwrap_or_default());
    let floors = by_place(&answered, "floor", |answer| answer.object.short_place());
    let mut places = Vec::from_iter(floors.into_iter().chain(by_place(&answered, "section", of_section)));
    // Sections may be the floors.
    places.dedup_by_key(|table| table.rows.iter().map(|row| row[1..].to_vec()).collect::<BTreeSet<_>>());
    Document {
        title,
        place: format!("{assessed} of {} assessed{}", count(all), table.conditions()),
        lead: lead.into_iter().flatten().collect(),
        tiles: if over.is_some() || table.rows.len() == 1 { Vec::new() } else { tiles(table, &when) },
        facts: same.into_iter().chain(facts(&answered, table.hazard.as_ref())).collect(),
        assumptions: assumptions(&answered),
        overview: remedies(table, &when).into_iter().chain(places).filter(|_| !several).collect(),
        tables: vec![rows],
        notes: doubts(&answered),
        figures: vec![match over {
            Some(_) => answers::fragilities(&answered),
            None => answers::list(&news, &when, worst.rates.target),
        }],
        sections: sections.collect(),
        ..Document::default()
    }
}

/// The number of objects: a row of a list may have several.
pub fn pieces<'a>(answers: impl IntoIterator<Item = &'a Answer>) -> usize {
    answers.into_iter().map(|answer| answer.object.count.unwrap_or(1.0)).sum::<f64>() as usize
}

/// The document of one of the worst objects, folded.
fn section(table: &AnswerTable, detail: &Detail) -> Option<Document> {
    let as_it_is = detail.variants.first()?;
    let mut document = object::document(table, as_it_is, detail);
    let tiles = document.tiles.iter().skip(2).map(|tile| format!("{}: {}.", tile.number, tile.words));
    document.facts = document.lead.drain(..).chain(tiles).chain(document.notes.drain(..)).collect();
    Some(document)
}

/// How many objects of each of several places are above the target, and are expected to overturn.
fn by_place(answers: &[&Answer], head: &str, place: fn(&Answer) -> String) -> Option<Table> {
    let mut groups = by(answers.iter().copied(), place);
    groups.sort_by(|a, b| number_of(b).total_cmp(&number_of(a)));
    let target = answers[0].rates.target;
    let row = |group: &Vec<&Answer>| {
        let its = || group.iter().copied();
        let above = |most: f64| count(pieces(its().filter(|answer| answer.severity() > most)));
        let above = target.map_or(String::new(), above);
        vec![place(group[0]), count(pieces(its())), above, TWO_DIGITS.one(number_of(group))]
    };
    let above = target.map_or(String::new(), |target| format!("above {}", PERCENT.one(target)));
    let heads = [head, "objects", &above, "expected to overturn"];
    let is_told = groups.len() > 1 && answers[0].fragility.over.is_none();
    is_told.then(|| Table::new(&heads, groups.iter().map(row).collect()).explained(&format!("By {head}")))
}

/// What the worst objects come to with one thing changed, in percent.
fn remedies(table: &AnswerTable, when: &str) -> Option<Table> {
    let worst = &table.details;
    let changes = worst.iter().flat_map(Detail::remedies).filter_map(|change| change.variant.as_deref());
    let heads = [vec!["object", "as it is"], distinct(changes)].concat();
    let row = |detail: &Detail| {
        let of = |head: &&str| {
            let one = detail.variants.iter().find(|one| one.variant.as_deref() == Some(*head));
            one.map_or(String::new(), |one| OF_HUNDRED.value(one.p.p_overturning))
        };
        let name = detail.variants[0].object.called();
        std::iter::once(name).chain(heads[1..].iter().map(of)).collect()
    };
    let rows: Vec<Vec<String>> = worst.iter().map(row).collect();
    let caption = format!(
        "The worst, if one thing is changed: probability of overturning {when}, %. Anchored, none rocks (forces \
         by ASCE 7 chapter 13 or EN 1998-1 4.3.5)"
    );
    (!rows.is_empty()).then(|| Table::new(&heads, rows).explained(&caption))
}

fn worst_of(table: &AnswerTable) -> String {
    let worst = &table.rows[0];
    let name = format!("{}{}, {},", worst.object.called(), file_of(worst, table), worst.object.place());
    let how_often = worst.how_often();
    let is_whole = table.rows.iter().all(Answer::is_answered);
    match how_often.strip_prefix("overturns ") {
        _ if table.rows.len() == 1 => format!("{name} {how_often}."),
        Some(often) => {
            let of = if is_whole { "" } else { " of those assessed" };
            format!("{name} is the most likely to overturn{of}: {often}.")
        }
        None => "Nothing overturns.".to_string(),
    }
}

fn file_of(answer: &Answer, table: &AnswerTable) -> String {
    let several = table.rows.iter().any(|other| other.file != answer.file);
    if several { format!(" ({})", literal(&answer.file)) } else { String::new() }
}

/// The objects without an answer; the table says why.
pub fn not_assessed(answers: &[Answer]) -> Option<String> {
    let silent: Vec<&Answer> = answers.iter().filter(|answer| !answer.is_answered()).collect();
    let [some, all] = [pieces(silent.iter().copied()), pieces(answers)].map(count);
    (!silent.is_empty()).then(|| format!("Not assessed, {some} of {all}: {}.", named(silent, NAMED)))
}

/// The names of objects, and how many there are beyond the most.
pub fn named<'a>(answers: impl IntoIterator<Item = &'a Answer>, most: usize) -> String {
    listed(&answers.into_iter().map(|answer| answer.object.called()).collect::<Vec<_>>(), most)
}

fn tiles(table: &AnswerTable, when: &str) -> Vec<Tile> {
    let mut tiles = Vec::new();
    // The same object may stand in several files, under several hazards: their sum would be of nothing.
    let files = by(&table.rows, |answer| &answer.file);
    for answers in files.iter().take(FILES) {
        let answered = answers.iter().copied().filter(|answer| answer.is_answered());
        let (all, file) = (counted(pieces(answered), "object"), file_of(answers[0], table));
        let limits = TWO_DIGITS.limits(answers[0].list.expected_number, "95 % limits ");
        let words = format!("of {all} expected to overturn {when}{limits}{file}");
        let expected = answers[0].list.expected_number.value.unwrap_or_else(|| number_of(answers));
        tiles.push(Tile { number: TWO_DIGITS.one(expected), words });
    }
    if files.len() == 1 {
        let any = table.rows[0].list.at_least_one;
        let limits = PERCENT.limits(any, "95 % limits ");
        let words =
            format!("probability that at least one overturns{limits}; one earthquake may overturn many");
        tiles.extend(any.value.or(any.high).map(|_| Tile { number: PERCENT.value(any), words }));
        tiles.extend(table.rows[0].rates.target.map(|target| {
            let above = pieces(table.rows.iter().filter(|answer| answer.severity() > target));
            let all = pieces(table.rows.iter().filter(|answer| answer.is_answered()));
            let words = format!("of {} above the target of {}", counted(all, "object"), PERCENT.one(target));
            Tile { number: count(above), words }
        }));
    }
    tiles
}

fn number_of(some: &[&Answer]) -> f64 {
    let number = |answer: &&Answer| Some(answer.object.count.unwrap_or(1.0) * answer.p.p_overturning.value?);
    some.iter().filter_map(number).sum()
}

type Cell = fn(&Answer) -> String;

/// The columns behind the list's own; of those in the time of exposure there is an @.
const COLUMNS: [(&str, Cell); 20] = [
    ("size", |answer| answer.object.size()),
    ("centre of mass, m", |answer| answer.object.raised_centre_m().map_or(String::new(), length)),
    ("number", |answer| answer.object.count.map_or(String::new(), plain)),
    ("place", place),
    ("file", |answer| literal(&answer.file)),
    ("change", |answer| of_before(answer, |before| before.changes.join("; "))),
    ("before, %", |answer| of_before(answer, |before| OF_HUNDRED.value(before.p))),
    (OVERTURNS, |answer| answer.p.p_overturning.value.map_or(String::new(), |p| OF_HUNDRED.one(p))),
    ("half overturn at", |answer| of_fragility(answer, 0)),
    (LIMITS, |answer| of_fragility(answer, 1) + &OF_HUNDRED.span(answer.p.p_overturning)),
    ("times as often", |answer| of_before(answer, |before| TWO_DIGITS.value(before.ratio))),
    ("times, 95 % limits", |answer| of_before(answer, |before| TWO_DIGITS.span(before.ratio))),
    ("16 %", |answer| of_fragility(answer, 2)),
    ("84 %", |answer| of_fragility(answer, 3)),
    ("beta", |answer| of_fragility(answer, 4)),
    ("over PGA half at", |answer| answer.over_pga.as_deref().map_or(String::new(), |of| of_fragility(of, 0))),
    ("over PGA, limits", |answer| answer.over_pga.as_deref().map_or(String::new(), |of| of_fragility(of, 1))),
    ("years", |answer| answer.rates.years.map_or(String::new(), plain)),
    (BASE, base),
    ("not assessed", |answer| if answer.is_answered() { String::new() } else { answer.reason() }),
];
const OVERTURNS: &str = "overturns @, %";
const BASE: &str = "base that meets the target";
const LIMITS: &str = "95 % limits";
/// Columns that are there although all objects have the same; others are then said once, but for these.
const ALWAYS: [&str; 8] =
    ["change", "before, %", OVERTURNS, LIMITS, "times as often", "times, 95 % limits", BASE, "not assessed"];
const UNSAID: [&str; 3] = ["place", "file", "years"];

/// The answers, and what is the same for all objects.
fn table_of(answers: &[&Answer], when: &str) -> (Table, Option<String>) {
    let column = |cell: &dyn Fn(&Answer) -> String| answers.iter().map(|answer| cell(answer)).collect();
    let mut columns: Vec<(String, Vec<String>)> =
        vec![("object".to_string(), column(&|answer| answer.object.called()))];
    for heading in headings(answers.iter().copied()) {
        let label = |answer: &Answer| literal(answer.label(heading).unwrap_or_default());
        columns.push((literal(heading), column(&label)));
    }
    let (labels, mut same) = (columns.len() - 1, Vec::new());
    let files = answers.first().map_or(0, |answer| answer.alternatives.len());
    for (name, cell) in &COLUMNS {
        let head = name.replace('@', when);
        let known = answers.iter().filter(|answer| answer.is_answered());
        let differ: BTreeSet<String> = known.map(|answer| cell(answer)).collect();
        if files > 0 && *name == OVERTURNS {
            // A column and its limits for each file.
            for at in 0..files {
                let file = literal(&answers[0].alternatives[at].file);
                let p = |answer: &Answer| answer.alternatives[at].p.p_overturning;
                columns.push((format!("{file}: {head}"), column(&|answer| OF_HUNDRED.value(p(answer)))));
                columns.push((LIMITS.to_string(), column(&|answer| OF_HUNDRED.span(p(answer)))));
            }
        } else if (differ.len() > 1 || ALWAYS.contains(name)) && (files == 0 || *name != LIMITS) {
            columns.push((head, column(cell)));
        } else if !UNSAID.contains(name) {
            let value = differ.first().filter(|value| !value.is_empty());
            same.extend(value.map(|value| format!("{head} {value}")));
        }
    }
    let same = (!same.is_empty()).then(|| format!("The same for all: {}.", same.join(", ")));
    let cells = |row: usize| columns.iter().map(|(_, cells)| cells[row].clone()).collect();
    let rows = (0..answers.len()).map(cells).collect();
    let heads = columns.iter().map(|(head, _)| head.clone()).collect();
    (Table { heads, rows, labels, ..Table::default() }, same)
}

/// Headings of the list's own columns.
pub fn headings<'a>(answers: impl IntoIterator<Item = &'a Answer>) -> Vec<&'a str> {
    let all = answers.into_iter().flat_map(|answer| &answer.labels).map(|(heading, _)| heading.as_str());
    distinct(all.filter(|heading| *heading != "object"))
}

/// Where an object stands; nothing of one that is not assessed.
pub fn place(answer: &Answer) -> String {
    if answer.is_answered() { answer.object.short_place() } else { String::new() }
}

fn of_before(answer: &Answer, cell: fn(&Before) -> String) -> String {
    answer.before.as_deref().map_or(String::new(), cell)
}

/// A cell of the intensities that overturn an object.
fn of_fragility(Answer { fragility, .. }: &Answer, cell: usize) -> String {
    fragility.over.map_or(String::new(), |over| intensity_cells(over, &fragility.overturning)[cell].clone())
}

/// The base with which an object meets the target, if there is one.
pub fn base(answer: &Answer) -> String {
    match answer.rates.target.filter(|_| answer.is_answered()) {
        None => String::new(),
        Some(target) if answer.severity() <= target => "not needed".to_string(),
        _ => answer.base(|side| side.value).map_or("none".to_string(), |base| base.replace(' ', "\u{a0}")),
    }
}

/// What speaks against answers: a line for those of the same words.
pub fn doubts(answers: &[&Answer]) -> Vec<String> {
    let doubted =
        answers.iter().filter_map(|answer| Some((*answer, answer.uncertainty.warnings.as_deref()?)));
    let line = |same: &Vec<(&Answer, &str)>| {
        format!("{}: {}", named(same.iter().map(|of| of.0), NAMED), literal(same[0].1))
    };
    by(doubted, |(_, words)| words).iter().map(line).collect()
}
