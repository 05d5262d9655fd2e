//! The document of two tables of answers, before and after: joined by the names of the objects.

use rockfrag_core::hazard::{RateBySource, ratio_of_rates};
use rockfrag_core::object::UncertaintySource;
use rockfrag_core::statistics::Interval;

use super::phrases::{Expected, limits_cover};
use super::{Document, Table, Tile};
use crate::answer::{Answer, AnswerTable};
use crate::chart::{Figure, Ink};
use crate::figures::answers::{ProbabilityRow, probabilities};
use crate::number::{self, OF_HUNDRED, PERCENT, TWO_DIGITS, counted, listed};

/// Objects that are named in a sentence and in a line.
const NAMED: usize = 4;
const MANY: usize = 20;
/// The most that are drawn.
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
    let (when, target) = (first.after.when().or(first.before.when())?, target(before).or(target(after)));
    let hazards = AnswerTable::joined(&[before.clone(), after.clone()]).conditions();
    let velocity = if is_same { "" } else { " PGV/PGA is not shared, as the hazards differ." };
    let has_ratio = pairs.iter().any(|pair| pair.ratio.value.is_some());
    let cancels = format!("The limits of a ratio leave out uncertainty that both rates share.{velocity}");
    let answers: Vec<&Answer> = pairs.iter().map(|pair| pair.after).collect();
    let [file_before, file_after] = [before, after].map(AnswerTable::file);
    let changed = pairs.iter().filter(|pair| pair.is_changed()).count();
    // The changed ones of several, else the one that there is.
    let told = if changed > 0 { &pairs[..changed] } else { &pairs[..1] };
    Some(Document {
        title: match &pairs[..] {
            [pair] => format!("{}, before and after", pair.before.object.called()),
            _ => format!("{}, before and after", counted(pairs.len(), "object")),
        },
        place: format!("Before: {file_before}; after: {file_after}{hazards}"),
        lead: vec![sentence(&pairs, changed, &when, target)],
        tiles: tiles(before, after, &when, target),
        facts: has_ratio.then_some(cancels).into_iter().chain(limits_cover(&answers)).collect(),
        tables: vec![table(told, &when)],
        notes: others(before, after, &pairs),
        figures: vec![figure(told, &when, target)],
        ..Document::default()
    })
}

fn target(table: &AnswerTable) -> Option<f64> {
    table.rows.iter().find_map(|answer| answer.rates.target)
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

impl Pair<'_> {
    fn is_changed(&self) -> bool {
        self.before.p.p_overturning != self.after.p.p_overturning || !self.changes().is_empty()
    }

    /// What differs: `0.35 × 2.10 m → 0.50 × 2.10 m`; the angle or eta where nothing else does.
    fn changes(&self) -> Vec<String> {
        let both = [self.before, self.after].map(|answer| &answer.object);
        let digits =
            |value: Option<f64>| value.map_or("-".to_string(), |value| number::significant(value, 3));
        let places = both.map(|object| object.place());
        let sizes = both.map(|object| object.size().replace(' ', "\u{a0}"));
        let mut changes: Vec<String> =
            [places, sizes].into_iter().filter_map(|pair| arrow("", pair)).collect();
        let silent = [self.before, self.after].into_iter().find(|answer| !answer.is_answered());
        changes.extend(silent.map(|answer| answer.reason()));
        if changes.is_empty() {
            let degrees = both.map(|object| digits(object.alpha_rad.map(f64::to_degrees)) + "°");
            let eta = both.map(|object| digits(object.eta));
            changes.extend(arrow("tips at ", degrees).or_else(|| arrow("restitution ", eta)));
        }
        changes
    }
}

fn arrow(name: &str, [old, new]: [String; 2]) -> Option<String> {
    (old != new).then(|| format!("{name}{old} → {new}"))
}

/// Before and after in one row.
fn figure(told: &[Pair], when: &str, target: Option<f64>) -> Figure {
    let rows = told.iter().take(DRAWN).map(|pair| {
        let sides = [(pair.before, Ink::Muted, "before"), (pair.after, Ink::Data(1), "after")];
        let values = sides.map(|(answer, ink, label)| (answer.p.p_overturning, ink, label)).into();
        let words = pair.ratio.value.map_or(String::new(), |_| format!("× {}", TWO_DIGITS.value(pair.ratio)));
        ProbabilityRow { name: pair.before.object.called(), values, words }
    });
    let panel = probabilities("", when, &rows.collect::<Vec<_>>(), target);
    let caption = format!(
        "Probability of overturning {when} before and after, with 95 % limits; at the right the ratio of \
         annual rates, after over before."
    );
    Figure::new("compared", "Before and after", 1, 0.0, vec![panel]).explained(caption)
}

/// What has become of one object, or of all, and which are above the target still.
fn sentence(pairs: &[Pair], changed: usize, when: &str, target: Option<f64>) -> String {
    if let [Pair { before, after, .. }] = pairs {
        let [p, q] = [before, after].map(|answer| match answer.is_answered() {
            true => PERCENT.value(answer.p.p_overturning),
            false => "no answer".to_string(),
        });
        let target = after.about_target().map_or(String::new(), |target| format!(" {target}"));
        let name = before.object.called();
        return format!("{name} overturns with a probability of {p} before and {q} after, {when}.{target}");
    }
    let changed = format!("{} of {} changed.", number::count(changed), counted(pairs.len(), "object"));
    let mut after: Vec<&Answer> = pairs.iter().map(|pair| pair.after).collect();
    after.sort_by(|a, b| b.severity().total_cmp(&a.severity()));
    after.retain(|answer| target.is_none_or(|target| answer.severity() > target));
    let worst: Vec<String> = after.iter().map(|answer| with_number(answer)).collect();
    match target.map(|target| PERCENT.one(target)) {
        None => format!("{changed} The most likely to overturn {when} is now {}.", worst[0]),
        Some(target) if worst.is_empty() => {
            format!("{changed} None is now known to be above the target of {target} {when}.")
        }
        Some(target) => {
            format!("{changed} Still above the target of {target} {when}: {}.", listed(&worst, NAMED))
        }
    }
}

/// The numbers of objects that are expected to overturn, and above the target.
fn tiles(before: &AnswerTable, after: &AnswerTable, when: &str, target: Option<f64>) -> Vec<Tile> {
    let both = [before, after].map(|table| &table.rows);
    if both.iter().all(|rows| rows.len() < 2) {
        return Vec::new();
    }
    let [old, new] = both.map(|rows| Expected::new(rows).number());
    let mut tiles = vec![Tile::new(format!("{old} → {new}"), format!("objects expected to overturn {when}"))];
    tiles.extend(target.map(|target| {
        let [old, new] = both.map(|rows| rows.iter().filter(|answer| answer.severity() > target).count());
        Tile::new(format!("{old} → {new}"), format!("objects above the target of {}", PERCENT.one(target)))
    }));
    tiles
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
            pair.ratio.value.map_or(String::new(), |_| TWO_DIGITS.value(pair.ratio)),
            TWO_DIGITS.span(pair.ratio),
        ]
    });
    Table::new(&heads, rows.collect())
}

/// Objects that are unchanged, those without an answer in both, and those of one file alone.
fn others(before: &AnswerTable, after: &AnswerTable, pairs: &[Pair]) -> Vec<String> {
    let same: Vec<&Answer> = pairs.iter().filter(|pair| !pair.is_changed()).map(|pair| pair.after).collect();
    let is_silent = |one: &&Answer| {
        namesake(one, &after.rows).is_some_and(|other| !one.is_answered() && !other.is_answered())
    };
    let [gone, new] = [(before, after), (after, before)].map(|(of, other)| {
        of.rows.iter().filter(|answer| namesake(answer, &other.rows).is_none()).collect::<Vec<_>>()
    });
    let mut lines = Vec::new();
    for (heading, all) in [
        ("unchanged", same),
        ("not assessed before or after", before.rows.iter().filter(is_silent).collect()),
        (&format!("only in {}", before.file()), gone),
        (&format!("only in {}", after.file()), new),
    ] {
        let names: Vec<String> = all.iter().map(|answer| with_number(answer)).collect();
        let (count, names) = (counted(all.len(), "object"), listed(&names, MANY));
        lines.extend((!all.is_empty()).then(|| format!("{count} {heading}: {names}.")));
    }
    lines
}

/// Names an object with its probability, if it has one.
fn with_number(answer: &Answer) -> String {
    let name = answer.object.called();
    match answer.is_answered() {
        true => format!("{name} ({})", PERCENT.value(answer.p.p_overturning)),
        false => name,
    }
}
