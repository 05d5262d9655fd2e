//! The page of two evaluations, before and after: joined by the names of the objects.

use super::answers::{Evaluation, Expected, Rated};
use super::figure::{Figure, Ink};
use super::object::limits_in_words;
use super::page::{Page, Table, Tile};
use super::probabilities::{self, Row};
use super::text::literal;
use crate::hazard::{RateByParts, ratio_of_rates};
use crate::number::{self, Limited, OF_HUNDRED, PERCENT, TWO_DIGITS};
use crate::object::Part;
use crate::table::answers::ObjectRow;

/// Changed objects that stand under the lead.
const DRAWN: usize = 4;

/// An object in two evaluations.
pub struct Pair<'a> {
    pub before: &'a Rated,
    pub after: &'a Rated,
    /// The rate after over the rate before, with limits; none where one has no rate.
    pub ratio: Limited,
}

/// The objects of both evaluations, by name; one unnamed object of each, or one in each, are the same. Those
/// that are changed are first, of these the most likely to overturn before.
pub fn pairs<'a>(before: &'a Evaluation, after: &'a Evaluation) -> Vec<Pair<'a>> {
    let are_alone =
        [before, after].iter().all(|one| matches!(&one.rows[..], [rated] if rated.object.name().is_none()));
    let same_hazard = before.hazard_key == after.hazard_key;
    let mut pairs = Vec::new();
    for one in &before.rows {
        let name = one.object.name();
        let mut others = after.rows.iter();
        let other = others.find(|other| are_alone || (name.is_some() && name == other.object.name()));
        let Some(other) = other.filter(|other| one.is_answered() || other.is_answered()) else { continue };
        pairs.push(Pair { before: one, after: other, ratio: ratio(one, other, same_hazard) });
    }
    pairs.sort_by(|a, b| b.before.severity().total_cmp(&a.before.severity()));
    pairs.sort_by_key(|pair| !pair.is_changed());
    pairs
}

/// PGV/PGA, and what is not known of the hazard, is the same only under the same hazard.
fn ratio(before: &Rated, after: &Rated, same_hazard: bool) -> Limited {
    let [before, after] = [before, after].map(|rated| {
        let rate = rated.row.overturning_per_year.value.filter(|rate| *rate > 0.0);
        rate.map(|rate| RateByParts { rate, sds: rated.doubts.part_sds() })
    });
    let Some((before, after)) = before.zip(after) else { return Limited::default() };
    let is_shared = |part: Part| same_hazard || !matches!(part, Part::Velocity | Part::Hazard);
    ratio_of_rates(&before, &after, is_shared).into()
}

impl Pair<'_> {
    fn name(&self) -> String {
        self.before.object.marked_name()
    }

    fn is_changed(&self) -> bool {
        self.before.row.p_overturning != self.after.row.p_overturning || !self.changes().is_empty()
    }

    /// How many times as often, after this sign; nothing where one has no rate.
    fn times(&self, sign: &str) -> String {
        let ratio = self.ratio.value.map(|_| TWO_DIGITS.both(self.ratio, "95 % limits "));
        let ratio = ratio.map(|ratio| ratio.replacen(' ', " times as often ", 1));
        ratio.map_or(String::new(), |ratio| format!("{sign}{ratio}"))
    }

    /// The columns that differ: `width 0.35 → 0.50 m`; alpha and eta where nothing else does.
    fn changes(&self) -> Vec<String> {
        let [before, after] = [self.before, self.after].map(|rated| &rated.object);
        let [old, new] = [before, after].map(|object| object.floor().unwrap_or("ground".to_string()));
        let mut words: Vec<String> = (old != new).then(|| format!("{old} → {new}")).into_iter().collect();
        let reason = Some(self.after).filter(|after| !after.is_answered());
        words.extend(reason.and_then(|after| after.doubts.warnings.as_deref()).map(literal));
        for (name, unit, column) in [
            ("width", " m", (|object| object.width_m) as fn(&ObjectRow) -> Option<f64>),
            ("depth", " m", |object| object.depth_m),
            ("height", " m", |object| object.height_m),
            ("centre of mass: tips at", "°", |object| object.alpha_rad.map(f64::to_degrees)),
            ("restitution", "", |object| object.eta),
        ] {
            let is_length = unit == " m";
            let written =
                |value| if is_length { number::length(value) } else { number::significant(value, 3) };
            let [old, new] = [before, after].map(|object| column(object).map_or("-".to_string(), written));
            let is_told = is_length || words.is_empty();
            words.extend((old != new && is_told).then(|| format!("{name} {old} → {new}{unit}")));
        }
        words
    }

    fn what_changed(&self) -> String {
        let changes = self.changes().join(", ");
        if changes.is_empty() { "nothing of the object".to_string() } else { changes }
    }
}

/// Before and after in one row.
pub fn figure(pairs: &[Pair], when: &str, target: Option<f64>) -> Figure {
    let (before, after) = (Ink::Muted, Ink::Data(1));
    let mut rows = Vec::new();
    for pair in pairs {
        let values = vec![(before, pair.before.row.p_overturning), (after, pair.after.row.p_overturning)];
        let words = match pair.ratio.value {
            _ if !pair.is_changed() => "as before".to_string(),
            None => String::new(),
            Some(_) => format!("× {}", TWO_DIGITS.value(pair.ratio)),
        };
        rows.push(Row { name: pair.name(), values, words });
    }
    let all = rows.iter().flat_map(|row| &row.values).map(|(_, p)| *p).chain([Limited::value(target)]);
    let x = probabilities::axis(&format!("probability of overturning {when}"), all);
    let labels = [(before, "before"), (after, "after")];
    let panel = probabilities::panel("", x, &rows, &labels, target);
    let caption = format!(
        "Probability of overturning {when} before and after, with 95 % limits; beside it the ratio of the rates, \
         after over before."
    );
    let panels = if pairs.is_empty() { Vec::new() } else { vec![panel] };
    Figure::new("compared", "Before and after", 1, 0.0, panels).explained(caption)
}

/// The page of two evaluations.
pub fn page(before: &Evaluation, after: &Evaluation) -> Page {
    let pairs = pairs(before, after);
    let (when, target) = (&before.when, before.target.or(after.target));
    if pairs.is_empty() {
        return Page::default();
    }
    let (hazards, cancels) = match before.hazard_key == after.hazard_key {
        true => (before.hazard.clone(), "the same hazard, that is all but what only one of them has"),
        false => (format!("{}; {}", before.hazard, after.hazard), "different hazards, PGV/PGA does not"),
    };
    let joined = match &pairs[..] {
        [one] if one.before.object.name().is_none() => "The one object of each file is joined.".to_string(),
        _ => format!("Joined by name: {}.", number::counted(pairs.len(), "object")),
    };
    let cancels = format!("Ratio: uncertainties that move both alike cancel; under {cancels}.");
    let rated: Vec<&Rated> = pairs.iter().map(|pair| pair.after).collect();
    let facts = [Some(joined), Some(cancels), limits_in_words(&rated)];
    let [file_before, file_after, hazards] = [&before.file, &after.file, &hazards].map(|name| literal(name));
    Page {
        title: match &pairs[..] {
            [pair] => format!("{}, before and after", pair.before.object.name().unwrap_or("One object")),
            _ => format!("{}, before and after", number::counted(pairs.len(), "object")),
        },
        place: format!("Before: {file_before}; after: {file_after}; {hazards}"),
        sentence: sentence(&pairs, when, target),
        tiles: match &pairs[..] {
            [_] => Vec::new(),
            several => several.iter().filter(|pair| pair.is_changed()).take(DRAWN).map(tile).collect(),
        },
        facts: facts.into_iter().flatten().collect(),
        table: Some(table(&pairs, when)),
        notes: unpaired(before, after, &pairs),
        figures: vec![figure(&pairs, when, target)],
        ..Page::default()
    }
}

/// What has become of one object, or of all.
fn sentence(pairs: &[Pair], when: &str, target: Option<f64>) -> String {
    let percent = |rated: &Rated| PERCENT.value(rated.row.p_overturning);
    if let [pair] = pairs {
        let (name, old, new) = (pair.name(), percent(pair.before), percent(pair.after));
        let odds = format!("{name} overturns with a probability of {old} before and {new} after, {when}");
        return format!("{odds}{}. What changed: {}.", pair.times(": "), pair.what_changed());
    }
    let before: Vec<&Rated> = pairs.iter().map(|pair| pair.before).collect();
    let after: Vec<&Rated> = pairs.iter().map(|pair| pair.after).collect();
    let changed = pairs.iter().filter(|pair| pair.is_changed()).count();
    let mut sentences =
        vec![format!("{} of {} change.", number::count(changed), number::counted(pairs.len(), "object"))];
    if let Some((old, new)) = worst(&before).zip(worst(&after)) {
        let [was, is] =
            [old, new].map(|rated| format!("{} ({})", rated.object.marked_name(), percent(rated)));
        sentences.push(format!("The most likely to overturn {when} is {was} before, {is} after."));
    }
    let [old, new] = [&before, &after].map(|all| Expected::new(all.iter().copied()).number());
    sentences.push(format!("{old} objects are expected to overturn before, {new} after."));
    sentences.extend(target.map(|target| {
        let [old, new] = [&before, &after]
            .map(|all| number::count(all.iter().filter(|rated| rated.severity() > target).count()));
        format!("The target of {} is exceeded by {old} before, {new} after.", PERCENT.one(target))
    }));
    sentences.join(" ")
}

fn worst<'a>(all: &[&'a Rated]) -> Option<&'a Rated> {
    all.iter()
        .copied()
        .filter(|rated| rated.is_answered())
        .max_by(|a, b| a.severity().total_cmp(&b.severity()))
}

/// What is changed of an object, and what comes of it.
fn tile(pair: &Pair) -> Tile {
    let [before, after] = [pair.before, pair.after].map(|rated| rated.row.p_overturning);
    let number = format!("{} → {}", OF_HUNDRED.value(before), PERCENT.value(after));
    Tile::new(number, format!("{}: {}{}", pair.name(), pair.what_changed(), pair.times("; ")))
}

fn table(pairs: &[Pair], when: &str) -> Table {
    let before = format!("before, % {when}");
    let heads =
        ["object", &before, "after, %", "95 % limits of after", "times as often", "95 % limits of that"];
    let mut rows = Vec::new();
    for pair in pairs {
        let (times, limits) = match (pair.is_changed(), pair.ratio.value) {
            (false, _) => ("as before".to_string(), String::new()),
            (true, None) => Default::default(),
            (true, Some(_)) => (TWO_DIGITS.value(pair.ratio), TWO_DIGITS.limits(pair.ratio, "")),
        };
        let [p, q] = [pair.before, pair.after].map(|rated| rated.row.p_overturning);
        let limits_after = OF_HUNDRED.limits(q, "");
        let mut row = vec![pair.name(), OF_HUNDRED.value(p), OF_HUNDRED.value(q)];
        row.extend([limits_after, times, limits].map(|cell| cell.replace(['(', ')'], "")));
        rows.push(row);
    }
    Table::new(&heads, rows)
}

/// Objects of one file alone, and those without an answer in both.
fn unpaired(before: &Evaluation, after: &Evaluation, pairs: &[Pair]) -> Vec<String> {
    let paired: Vec<&str> = pairs
        .iter()
        .flat_map(|pair| [pair.before, pair.after])
        .map(|rated| rated.object.structure.as_str())
        .collect();
    let [only_before, only_after] = [before, after].map(|one| format!("Only in {}", literal(&one.file)));
    let mut lines = Vec::new();
    for (heading, own, other, is_in_both) in [
        (only_before, before, after, false),
        (only_after, after, before, false),
        ("Not assessed before or after".to_string(), before, after, true),
    ] {
        let others: Vec<&str> = other.rows.iter().map(|rated| rated.object.structure.as_str()).collect();
        let mut rows: Vec<&Rated> = own.rows.iter().collect();
        rows.retain(|rated| {
            let name = rated.object.structure.as_str();
            !paired.contains(&name) && others.contains(&name) == is_in_both
        });
        let names: Vec<String> = rows.iter().map(|rated| rated.object.marked_name()).collect();
        lines.extend((!names.is_empty()).then(|| format!("{heading}: {}.", names.join(", "))));
    }
    lines
}
