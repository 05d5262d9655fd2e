//! The document of two tables of answers, before and after: the list of those after, each with what it was
//! before. They are joined by the names of the objects.

use rockfrag_core::hazard::Budget;
use rockfrag_core::object::UncertaintySource;
use rockfrag_core::statistics::Interval;

use super::Document;
use super::list::expected_number;
use crate::answer::{Answer, AnswerTable, Before};
use crate::number::{counted, listed, significant};

/// Objects that are named in a line.
const NAMED: usize = 20;

/// None where the tables have no object with an answer in common.
pub fn document(before: &AnswerTable, after: &AnswerTable) -> Option<Document> {
    let [old, new] = [before, after].map(|table| table.made.first()?.input("hazard"));
    let is_same = old == new;
    let mut table = after.clone();
    for answer in &mut table.rows {
        let one = namesake(answer, &before.rows).filter(|one| one.is_answered() || answer.is_answered());
        answer.before = one.map(|one| Box::new(before_of(one, answer, is_same)));
    }
    let both = table.rows.iter().filter(|answer| answer.before.is_some()).count();
    let changed = table.rows.iter().filter(|answer| answer.before.is_some() && answer.is_news()).count();
    let gone = before.rows.iter().filter(|one| namesake(one, &after.rows).is_none());
    let gone: Vec<String> = gone.map(|one| one.object.called()).collect();
    let gone = (!gone.is_empty()).then(|| format!("Only before: {}.", listed(&gone, NAMED)));
    let hazards = AnswerTable::joined(&[before.clone(), after.clone()]).conditions();
    let shared = if is_same { "" } else { ", but for PGV/PGA, as the hazards differ" };
    let ratios = format!(
        "The limits of a ratio leave out uncertainty that both rates share{shared}; restitution is taken as \
         the same before and after."
    );
    let mut now = Document::of_answers(&table);
    now.lead.insert(0, format!("{changed} of {} changed.", counted(both, "object")));
    for tile in now.tiles.iter_mut().take(1) {
        tile.number = format!("{} → {}", expected_number(&before.rows), tile.number);
    }
    (both > 0).then(|| Document {
        title: format!("{}, before and after", now.title),
        place: format!("Before: {}; after: {}{hazards}", before.file(), after.file()),
        facts: [vec![ratios], now.facts].concat(),
        notes: gone.into_iter().chain(now.notes).collect(),
        ..now
    })
}

fn namesake<'a>(answer: &Answer, others: &'a [Answer]) -> Option<&'a Answer> {
    others.iter().find(|other| other.object.structure == answer.object.structure)
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

const SIDES: [Side; 2] =
    [("", |answer| answer.object.place()), ("", |answer| answer.object.size().replace(' ', "\u{a0}"))];
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
    changes.extend(silent.map(Answer::reason));
    if changes.is_empty() {
        changes.extend(PARAMETERS.iter().find_map(arrow));
    }
    changes
}
