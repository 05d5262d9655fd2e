//! The page of two evaluations, before and after: joined by the names of the objects.

use rockfrag_core::hazard::{RateBySource, ratio_of_rates};
use rockfrag_core::object::UncertaintySource;
use rockfrag_core::statistics::Interval;

use super::answers::{Evaluation, Expected, Rated};
use super::object::limits_in_words;
use super::page::{Page, Table, Tile};
use super::probabilities::{self, ProbabilityRow, Value};
use crate::chart::text::literal;
use crate::chart::{Figure, Ink};
use crate::number::{self, OF_HUNDRED, PERCENT, TWO_DIGITS};

/// Objects that are named in a sentence and in a line.
const NAMED: usize = 4;
const MANY: usize = 20;

/// An object in two evaluations.
pub struct Pair<'a> {
    pub before: &'a Rated,
    pub after: &'a Rated,
    /// The rate after over the rate before, with limits; none where one has no rate.
    pub ratio: Interval<Option<f64>>,
}

/// The objects of both evaluations that have an answer in one, by name: those that are changed first, of
/// these the most likely to overturn before.
pub fn pairs<'a>(before: &'a Evaluation, after: &'a Evaluation) -> Vec<Pair<'a>> {
    let same_hazard = before.hazard_key == after.hazard_key;
    let pairs = before.rows.iter().filter_map(|one| {
        let other = namesake(one, after).filter(|other| one.is_answered() || other.is_answered())?;
        Some(Pair { before: one, after: other, ratio: ratio(one, other, same_hazard) })
    });
    let mut pairs: Vec<Pair> = pairs.collect();
    pairs.sort_by(|a, b| b.before.severity().total_cmp(&a.before.severity()));
    pairs.sort_by_key(|pair| !pair.is_changed());
    pairs
}

/// PGV/PGA, and what is not known of the hazard, is the same only under the same hazard.
fn ratio(before: &Rated, after: &Rated, same_hazard: bool) -> Interval<Option<f64>> {
    let [before, after] = [before, after].map(|rated| {
        let rate = rated.row.overturning_per_year.value.filter(|rate| *rate > 0.0);
        rate.map(|rate| RateBySource { rate, sds: rated.doubts.source_sds() })
    });
    let Some((before, after)) = before.zip(after) else { return Interval::default() };
    let is_shared = |part: UncertaintySource| {
        same_hazard || !matches!(part, UncertaintySource::Velocity | UncertaintySource::Hazard)
    };
    ratio_of_rates(&before, &after, is_shared).into()
}

impl Pair<'_> {
    fn is_changed(&self) -> bool {
        self.before.row.p_overturning != self.after.row.p_overturning || !self.changes().is_empty()
    }

    /// What differs: `0.35 × 2.10 m → 0.50 × 2.10 m`; the angle or eta where nothing else does.
    fn changes(&self) -> Vec<String> {
        let both = [self.before, self.after].map(|rated| &rated.object);
        let places = both.map(|object| literal(&object.place()));
        let sizes = both.map(|object| object.size().replace(' ', "\u{a0}"));
        let mut changes: Vec<String> =
            [places, sizes].into_iter().filter_map(|pair| arrow("", pair)).collect();
        let reason = self.after.doubts.warnings.as_deref().filter(|_| !self.after.is_answered());
        changes.extend(reason.map(literal));
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

fn digits(value: Option<f64>) -> String {
    value.map_or("-".to_string(), |value| number::significant(value, 3))
}

/// Those that are drawn and have a row: the changed ones of several, else the one that there is.
fn told<'a, 'b>(pairs: &'b [Pair<'a>]) -> &'b [Pair<'a>] {
    let changed = pairs.iter().filter(|pair| pair.is_changed()).count();
    if changed > 0 { &pairs[..changed] } else { &pairs[..pairs.len().min(1)] }
}

/// Before and after in one row.
pub fn figure(pairs: &[Pair], when: &str, target: Option<f64>) -> Figure {
    let rows = told(pairs).iter().map(|pair| {
        let sides = [(pair.before, Ink::Muted, "before"), (pair.after, Ink::Data(1), "after")];
        let values = sides.map(|(rated, ink, label)| Value { p: rated.row.p_overturning, ink, label });
        let words = pair.ratio.value.map_or(String::new(), |_| format!("× {}", TWO_DIGITS.value(pair.ratio)));
        ProbabilityRow { name: pair.before.object.marked_name(), values: values.into(), words }
    });
    let rows: Vec<ProbabilityRow> = rows.collect();
    let panel = (!rows.is_empty()).then(|| probabilities::panel("", when, &rows, target));
    let caption = format!(
        "Probability of overturning {when} before and after, with 95 % limits; at the right the ratio of the \
         rates, after over before."
    );
    Figure::new("compared", "Before and after", 1, 0.0, panel.into_iter().collect()).explained(caption)
}

/// The page of two evaluations; none where they have no object with an answer in common.
pub fn page(before: &Evaluation, after: &Evaluation) -> Option<Page> {
    let pairs = Some(pairs(before, after)).filter(|pairs| !pairs.is_empty())?;
    let (when, target) = (&before.when, before.target.or(after.target));
    let is_same = before.hazard_key == after.hazard_key;
    let hazards =
        if is_same { before.hazard.clone() } else { format!("{}; {}", before.hazard, after.hazard) };
    let velocity = if is_same { "" } else { " PGV/PGA is not shared, as the hazards differ." };
    let cancels = format!("The limits of a ratio leave out uncertainty that both rates share.{velocity}");
    let rated: Vec<&Rated> = pairs.iter().map(|pair| pair.after).collect();
    let [file_before, file_after] = [before, after].map(Evaluation::file);
    Some(Page {
        title: match &pairs[..] {
            [pair] => format!("{}, before and after", pair.before.object.name().unwrap_or("One object")),
            _ => format!("{}, before and after", number::counted(pairs.len(), "object")),
        },
        place: format!("Before: {file_before}; after: {file_after}; {}", literal(&hazards)),
        sentence: sentence(&pairs, when, target),
        tiles: tiles(before, after, when, target),
        facts: [Some(cancels), limits_in_words(&rated)].into_iter().flatten().collect(),
        tables: vec![table(told(&pairs), when)],
        notes: others(before, after, &pairs),
        figures: vec![figure(&pairs, when, target)],
        ..Page::default()
    })
}

/// What has become of one object, or of all, and which are above the target still.
fn sentence(pairs: &[Pair], when: &str, target: Option<f64>) -> String {
    let percent = |rated: &Rated| PERCENT.value(rated.row.p_overturning);
    if let [Pair { before, after, .. }] = pairs {
        let name = before.object.marked_name();
        let target = target.map_or(String::new(), |target| format!(" {}", after.about_target(target)));
        let (before, after) = (percent(before), percent(after));
        return format!(
            "{name} overturns with a probability of {before} before and {after} after, {when}.{target}"
        );
    }
    let changed = number::count(pairs.iter().filter(|pair| pair.is_changed()).count());
    let changed = format!("{changed} of {} changed.", number::counted(pairs.len(), "object"));
    let mut after: Vec<&Rated> = pairs.iter().map(|pair| pair.after).collect();
    after.sort_by(|a, b| b.severity().total_cmp(&a.severity()));
    after.retain(|rated| target.is_none_or(|target| rated.severity() > target));
    let worst: Vec<String> = after.iter().map(|rated| with_number(rated)).collect();
    match target.map(|target| PERCENT.one(target)) {
        None => format!("{changed} The most likely to overturn {when} is now {}.", worst[0]),
        Some(target) if worst.is_empty() => format!("{changed} All now meet the target of {target} {when}."),
        Some(target) => {
            format!("{changed} Still above the target of {target} {when}: {}.", number::listed(&worst, NAMED))
        }
    }
}

/// The numbers of objects that are expected to overturn, and above the target.
fn tiles(before: &Evaluation, after: &Evaluation, when: &str, target: Option<f64>) -> Vec<Tile> {
    let both = [before, after].map(|one| &one.rows);
    if both.iter().all(|rows| rows.len() < 2) {
        return Vec::new();
    }
    let [old, new] = both.map(|rows| Expected::new(rows).number());
    let mut tiles = vec![Tile::new(format!("{old} → {new}"), format!("objects expected to overturn {when}"))];
    tiles.extend(target.map(|target| {
        let [old, new] = both.map(|rows| rows.iter().filter(|rated| rated.severity() > target).count());
        Tile::new(format!("{old} → {new}"), format!("objects above the target of {}", PERCENT.one(target)))
    }));
    tiles
}

fn table(pairs: &[Pair], when: &str) -> Table {
    let before = format!("before, % {when}");
    let (after, times) = (["after, %", "after, 95 % limits"], ["times as often", "times, 95 % limits"]);
    let heads = [&["object", "change", &before][..], &after, &times].concat();
    let rows = pairs.iter().map(|pair| {
        let [p, q] = [pair.before, pair.after].map(|rated| rated.row.p_overturning);
        vec![
            pair.before.object.marked_name(),
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
fn others(before: &Evaluation, after: &Evaluation, pairs: &[Pair]) -> Vec<String> {
    let same: Vec<&Rated> = pairs.iter().filter(|pair| !pair.is_changed()).map(|pair| pair.after).collect();
    let (mut silent, mut gone): (Vec<&Rated>, Vec<&Rated>) = Default::default();
    for rated in &before.rows {
        match namesake(rated, after) {
            None => gone.push(rated),
            Some(other) if !rated.is_answered() && !other.is_answered() => silent.push(rated),
            Some(_) => {}
        }
    }
    let new: Vec<&Rated> = after.rows.iter().filter(|rated| namesake(rated, before).is_none()).collect();
    let mut lines = Vec::new();
    for (heading, all) in [
        ("unchanged", same),
        ("not assessed before or after", silent),
        (&format!("only in {}", before.file()), gone),
        (&format!("only in {}", after.file()), new),
    ] {
        let names: Vec<String> = all.iter().map(|rated| with_number(rated)).collect();
        let (count, names) = (number::counted(all.len(), "object"), number::listed(&names, MANY));
        lines.extend((!all.is_empty()).then(|| format!("{count} {heading}: {names}.")));
    }
    lines
}

/// Names an object with its probability, if it has one.
fn with_number(rated: &Rated) -> String {
    let name = rated.object.marked_name();
    match rated.is_answered() {
        true => format!("{name} ({})", PERCENT.value(rated.row.p_overturning)),
        false => name,
    }
}

fn namesake<'a>(rated: &Rated, other: &'a Evaluation) -> Option<&'a Rated> {
    other.rows.iter().find(|one| one.object.structure == rated.object.structure)
}
