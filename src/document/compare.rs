//! The document of several tables of answers for the same objects: before and after, or alternatives under
//! different hazards.

use std::collections::BTreeSet;

use rockfrag_core::hazard::Budget;
use rockfrag_core::object::UncertaintySource;
use rockfrag_core::statistics::Interval;

use super::Document;
use super::list::{named, not_assessed, pieces};
use crate::answer::{Answer, AnswerTable, Before};
use crate::number::{count, counted, length, significant};

const NAMED: usize = 20;

/// None where the tables are of other objects, or there is only one.
pub fn document(tables: &[AnswerTable]) -> Option<Document> {
    let [first, others @ ..] = tables else { return None };
    let hazard = |table: &AnswerTable| table.made.first()?.input("hazard");
    let is_alternative = |other: &AnswerTable| {
        let mut both = other.rows.iter().zip(partners(&first.rows, &other.rows));
        let are_equal = both.all(|(answer, one)| one.is_some_and(|one| changes([one, answer]).is_empty()));
        are_equal && first.rows.len() == other.rows.len() && hazard(first) != hazard(other)
    };
    match others {
        [] => None,
        _ if others.iter().all(is_alternative) => Some(alternatives(tables)),
        [after] => before_and_after(first, after, hazard(first) == hazard(after)),
        _ => None,
    }
}

/// The rows of the first table, each with what every table says of it.
fn alternatives(tables: &[AnswerTable]) -> Document {
    let joined = AnswerTable { details: Vec::new(), ..AnswerTable::joined(tables) };
    let mut all = AnswerTable { details: Vec::new(), made: joined.made.clone(), ..tables[0].clone() };
    for table in tables {
        for (answer, one) in all.rows.iter_mut().zip(partners(&table.rows, &tables[0].rows)) {
            answer.alternatives.extend(one.cloned());
        }
    }
    let (now, files) = (Document::of_answers(&all), Document::of_answers(&joined));
    let title = format!("{}, {} alternatives", now.title, tables.len());
    let facts = |table| Document::of_answers(table).facts.join(" ");
    let of_each = tables.iter().map(|table| format!("{}: {}", table.file(), facts(table)));
    let lead = files.lead.into_iter().take(1).chain(not_assessed(&all.rows)).collect();
    let Document { tiles, notes, .. } = files;
    Document { title, lead, tiles, notes, facts: of_each.collect(), overview: Vec::new(), ..now }
}

/// The list after, each object with what it was before; none where no object with an answer is in both.
fn before_and_after(before: &AnswerTable, after: &AnswerTable, is_same: bool) -> Option<Document> {
    let mut table = after.clone();
    let partners = partners(&before.rows, &after.rows);
    for (answer, one) in table.rows.iter_mut().zip(&partners) {
        let one = one.filter(|one| one.is_answered() || answer.is_answered());
        answer.before = one.map(|one| Box::new(before_of(one, answer, is_same)));
    }
    let in_both = table.rows.iter().filter(|answer| answer.before.is_some());
    let both = pieces(in_both.clone());
    let changed = count(pieces(in_both.filter(|answer| answer.is_news())));
    let is_there = |one: &&Answer| partners.iter().flatten().any(|partner| std::ptr::eq(*partner, *one));
    let gone: Vec<&Answer> = before.rows.iter().filter(|one| !is_there(one)).collect();
    let new = after.rows.iter().zip(&partners).filter(|(_, one)| one.is_none()).map(|(one, _)| one).collect();
    let unmatched = [("Removed", gone), ("Added", new)].into_iter().filter(|(_, only)| !only.is_empty());
    let unmatched = unmatched.map(|(what, only)| format!("{what}: {}.", named(only, NAMED)));
    let hazards = AnswerTable::joined(&[before.clone(), after.clone()]).conditions();
    let shared = if is_same { "" } else { ", but for PGV/PGA, as the hazards differ" };
    let ratios = format!(
        "The limits of a ratio leave out uncertainty that both rates share{shared}; restitution is taken as \
         the same before and after."
    );
    let mut now = Document::of_answers(&table);
    now.lead.insert(0, format!("{changed} of {} changed.", counted(both, "object")));
    for (tile, before) in now.tiles.iter_mut().zip(Document::of_answers(before).tiles) {
        tile.number = format!("{} → {}", before.number, tile.number);
    }
    (both > 0).then(|| Document {
        title: format!("{}, before and after", now.title),
        place: format!("Before: {}; after: {}{hazards}", before.file(), after.file()),
        facts: [vec![ratios], now.facts].concat(),
        notes: unmatched.chain(now.notes).collect(),
        ..now
    })
}

/// For each row of the second list the same object of the first: by the tags of both, where they have such a
/// column; else by a name that is no line of a list; else by the name without it and the size.
fn partners<'a>(before: &'a [Answer], after: &[Answer]) -> Vec<Option<&'a Answer>> {
    let tag = tags(before).find(|heading| tags(after).any(|other| other == *heading));
    let key = |one: &Answer, with_size: bool| {
        let name = without_line(&one.object.structure);
        match tag {
            Some(tag) => one.label(tag).map(str::to_string),
            None if with_size => Some(format!("{name} {}", one.object.size())),
            None => Some(name.to_string()).filter(|name| *name == one.object.structure),
        }
    };
    let (mut left, mut partners) = (Vec::from_iter(before), vec![None; after.len()]);
    for with_size in [false, true] {
        for (partner, answer) in partners.iter_mut().zip(after).filter(|(partner, _)| partner.is_none()) {
            let wanted = key(answer, with_size);
            let same = left.iter().position(|one| wanted.is_some() && key(one, with_size) == wanted);
            *partner = same.map(|same| left.remove(same));
        }
    }
    partners
}

/// Headings of a list under which each row has another text.
fn tags(rows: &[Answer]) -> impl Iterator<Item = &str> {
    let headings = rows.first().into_iter().flat_map(|first| &first.labels).map(|(heading, _)| &**heading);
    headings.filter(|heading| {
        let cells: BTreeSet<&str> = rows.iter().filter_map(|one| one.label(heading)).collect();
        cells.len() == rows.len() && !cells.contains("")
    })
}

/// A name without the line by which a list tells it from others of this name.
fn without_line(name: &str) -> &str {
    let name = name.split_once(" (line ").map_or(name, |(name, _)| name);
    if name.starts_with("line ") { "" } else { name }
}

/// PGV/PGA, and what is not known of the hazard, is the same only under the same hazard.
fn before_of(before: &Answer, after: &Answer, is_same_hazard: bool) -> Before {
    let [old, new] = [before, after].map(|answer| {
        let rate = answer.rates.overturning_per_year.value.filter(|rate| *rate > 0.0);
        Some((rate?, answer.rates.budget()?))
    });
    let is_shared = |part: UncertaintySource| {
        is_same_hazard || !matches!(part, UncertaintySource::Velocity | UncertaintySource::Hazard)
    };
    let ratio = old.zip(new).map(|((old, before), (new, after))| {
        Budget::of_ratio(&before, &after, is_shared).limit_rate(new / old, f64::INFINITY)
    });
    let ratio = ratio.map_or(Interval::default(), Interval::<Option<f64>>::from);
    Before { p: before.p.p_overturning, ratio, changes: changes([before, after]) }
}

/// What may differ between answers, and its name.
type Side = (&'static str, fn(&Answer) -> String);

const SIDES: [Side; 3] = [
    ("", |answer| answer.object.place()),
    ("", |answer| answer.object.size().replace(' ', "\u{a0}")),
    ("centre of mass at ", |answer| {
        answer.object.centre_height_m.map_or("-".to_string(), |it| length(it) + " m")
    }),
];
const PARAMETERS: [Side; 2] = [
    ("tips at ", |answer| significant(answer.object.alpha_rad.map_or(f64::NAN, f64::to_degrees), 3) + "°"),
    ("restitution ", |answer| significant(answer.object.eta.unwrap_or(f64::NAN), 3)),
];

/// What differs: `0.35 × 2.10 m → 0.50 × 2.10 m`; the angle or eta where nothing else does.
fn changes(both: [&Answer; 2]) -> Vec<String> {
    let arrow = |(name, side): &Side| {
        let [old, new] = both.map(side);
        (old != new).then(|| format!("{name}{old} → {new}"))
    };
    let mut changes: Vec<String> = SIDES.iter().filter_map(arrow).collect();
    let silent = both.into_iter().find(|answer| !answer.is_answered());
    let silent = silent.filter(|_| both[0].is_answered() != both[1].is_answered());
    changes.extend(silent.map(Answer::reason));
    if changes.is_empty() {
        changes.extend(PARAMETERS.iter().find_map(arrow));
    }
    changes
}
