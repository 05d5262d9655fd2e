//! The document of two tables of answers, before and after: that of the latter, with what has changed. They
//! are joined by the names of the objects.

use rockfrag_core::hazard::{RateBySource, ratio_of_rates};
use rockfrag_core::object::UncertaintySource;
use rockfrag_core::statistics::Interval;

use super::phrases::Expected;
use super::{Document, Table};
use crate::answer::{Answer, AnswerTable};
use crate::chart::{Figure, Ink};
use crate::figures::answers::{ProbabilityRow, probabilities};
use crate::number::{OF_HUNDRED, TWO_DIGITS, counted, listed, significant};

/// Objects that are named in a line, and the most that are drawn.
const NAMED: usize = 20;
const DRAWN: usize = 60;

/// An object in two tables.
struct Pair<'a> {
    before: &'a Answer,
    after: &'a Answer,
    /// The rate after over the rate before, with limits; none where one has no rate.
    ratio: Interval<Option<f64>>,
}

/// None where the tables have no object with an answer in common.
pub fn document(before: &AnswerTable, after: &AnswerTable) -> Option<Document> {
    let is_same = before.hazard_key() == after.hazard_key();
    let pairs = pairs(&before.rows, &after.rows, is_same);
    let first = pairs.first()?;
    let when = first.after.when().or(first.before.when())?;
    let hazards = AnswerTable::joined(&[before.clone(), after.clone()]).conditions();
    let velocity = if is_same { "" } else { " PGV/PGA is not shared, as the hazards differ." };
    let has_ratio = pairs.iter().any(|pair| pair.ratio.value.is_some());
    let cancels = format!("The limits of a ratio leave out uncertainty that both rates share.{velocity}");
    let changed = pairs.iter().filter(|pair| pair.is_changed()).count();
    // The changed ones of several, else the one that there is.
    let told = &pairs[..changed.max(1)];
    let mut now = Document::of_answers(after);
    if pairs.len() > 1 {
        now.lead.insert(0, format!("{changed} of {} changed.", counted(pairs.len(), "object")));
        let tile = now.tiles.iter_mut().take(1);
        tile.for_each(|tile| {
            tile.number = format!("{} → {}", Expected::new(&before.rows).number(), tile.number)
        });
    }
    Some(Document {
        title: format!("{}, before and after", now.title),
        place: format!("Before: {}; after: {}{hazards}", before.file(), after.file()),
        facts: has_ratio.then_some(cancels).into_iter().chain(now.facts).collect(),
        tables: [vec![table(told, &when)], now.tables].concat(),
        notes: [others(before, after, &pairs), now.notes].concat(),
        figures: vec![figure(told, &when, after.rows.iter().find_map(|answer| answer.rates.target))],
        ..now
    })
}

/// The objects of both tables that have an answer in one, by name: those that are changed first, of these the
/// most likely to overturn before.
fn pairs<'a>(before: &'a [Answer], after: &'a [Answer], is_same_hazard: bool) -> Vec<Pair<'a>> {
    let pairs = before.iter().filter_map(|one| {
        let other = namesake(one, after).filter(|other| one.is_answered() || other.is_answered())?;
        Some(Pair { before: one, after: other, ratio: ratio(one, other, is_same_hazard) })
    });
    let mut pairs: Vec<Pair> = pairs.collect();
    pairs.sort_by(|a, b| b.before.severity().total_cmp(&a.before.severity()));
    pairs.sort_by_key(|pair| !pair.is_changed());
    pairs
}

fn namesake<'a>(answer: &Answer, others: &'a [Answer]) -> Option<&'a Answer> {
    others.iter().find(|other| other.object.structure == answer.object.structure)
}

/// PGV/PGA, and what is not known of the hazard, is the same only under the same hazard.
fn ratio(before: &Answer, after: &Answer, is_same_hazard: bool) -> Interval<Option<f64>> {
    let [before, after] = [before, after].map(|answer| {
        let rate = answer.rates.overturning_per_year.value.filter(|rate| *rate > 0.0);
        rate.map(|rate| RateBySource { rate, sds: answer.uncertainty.source_sds() })
    });
    let Some((before, after)) = before.zip(after) else { return Interval::default() };
    let is_shared = |part: UncertaintySource| {
        is_same_hazard || !matches!(part, UncertaintySource::Velocity | UncertaintySource::Hazard)
    };
    ratio_of_rates(&before, &after, is_shared).into()
}

/// What may differ between answers, and its name.
type Side = (&'static str, fn(&Answer) -> String);

const SIDES: [Side; 2] =
    [("", |answer| answer.object.place()), ("", |answer| answer.object.size().replace(' ', "\u{a0}"))];
const PARAMETERS: [Side; 2] = [
    ("tips at ", |answer| {
        answer.object.alpha_rad.map_or("-".to_string(), |a| significant(a.to_degrees(), 3)) + "°"
    }),
    ("restitution ", |answer| answer.object.eta.map_or("-".to_string(), |eta| significant(eta, 3))),
];

impl Pair<'_> {
    fn is_changed(&self) -> bool {
        self.before.p.p_overturning != self.after.p.p_overturning || !self.changes().is_empty()
    }

    /// What differs: `0.35 × 2.10 m → 0.50 × 2.10 m`; the angle or eta where nothing else does.
    fn changes(&self) -> Vec<String> {
        let both = [self.before, self.after];
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

    fn times(&self) -> String {
        self.ratio.value.map_or(String::new(), |_| TWO_DIGITS.value(self.ratio))
    }
}

/// Before and after in one row.
fn figure(told: &[Pair], when: &str, target: Option<f64>) -> Figure {
    let rows = told.iter().take(DRAWN).map(|pair| {
        let sides = [(pair.before, Ink::Muted, "before"), (pair.after, Ink::Data(1), "after")];
        let values = sides.map(|(answer, ink, label)| (answer.p.p_overturning, ink, label)).into();
        let words = pair.ratio.value.map_or(String::new(), |_| format!("× {}", pair.times()));
        ProbabilityRow { name: pair.before.object.called(), values, words }
    });
    let panel = probabilities("", when, &rows.collect::<Vec<_>>(), target);
    let caption = format!(
        "Probability of overturning {when} before and after, with 95 % limits; at the right the ratio of \
         annual rates, after over before."
    );
    Figure::new("compared", "Before and after", 1, 0.0, vec![panel]).explained(caption)
}

fn table(told: &[Pair], when: &str) -> Table {
    let before = format!("before, % {when}");
    let (after, times) = (["after, %", "after, 95 % limits"], ["times as often", "times, 95 % limits"]);
    let heads = [&["object", "change", &before][..], &after, &times].concat();
    let rows = told.iter().map(|pair| {
        let [p, q] = [pair.before, pair.after].map(|answer| answer.p.p_overturning);
        vec![
            pair.before.object.called(),
            pair.changes().join("; "),
            OF_HUNDRED.value(p),
            OF_HUNDRED.value(q),
            OF_HUNDRED.span(q),
            pair.times(),
            TWO_DIGITS.span(pair.ratio),
        ]
    });
    Table::new(&heads, rows.collect())
}

/// Objects that are unchanged, and those of one file alone.
fn others(before: &AnswerTable, after: &AnswerTable, pairs: &[Pair]) -> Vec<String> {
    let same = pairs.iter().filter(|pair| !pair.is_changed()).map(|pair| pair.after).collect();
    let mut all: Vec<(String, Vec<&Answer>)> = vec![("unchanged".to_string(), same)];
    for (of, other) in [(before, after), (after, before)] {
        let alone = of.rows.iter().filter(|answer| namesake(answer, &other.rows).is_none());
        all.push((format!("only in {}", of.file()), alone.collect()));
    }
    all.retain(|(_, answers)| !answers.is_empty());
    let lines = all.iter().map(|(what, answers)| {
        let names: Vec<String> = answers.iter().map(|answer| answer.object.called()).collect();
        format!("{} {what}: {}.", counted(names.len(), "object"), listed(&names, NAMED))
    });
    lines.collect()
}
