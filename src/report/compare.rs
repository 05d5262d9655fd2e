//! The page of two evaluations, before and after: joined by the names of the objects.

use super::answers::{Evaluation, Expected, Rated};
use super::figure::{Figure, Ink};
use super::object::limits_in_words;
use super::page::{Page, Table, Tile};
use super::probabilities::{self, Row};
use super::text::literal;
use crate::hazard::{RateByParts, ratio_of_rates};
use crate::number::{self, Limited, PERCENT, TWO_DIGITS};
use crate::object::Part;

/// An object in two evaluations.
pub struct Pair<'a> {
    pub before: &'a Rated,
    pub after: &'a Rated,
    /// The rate after over the rate before, with limits; none where one has no rate.
    pub ratio: Limited,
}

/// The objects of both evaluations, by name; one unnamed object of each, or one in each, are the same. The
/// most likely to overturn before are first.
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
        let is_other_rate = self.before.row.overturning_per_year != self.after.row.overturning_per_year;
        is_other_rate || place(self.before) != place(self.after)
    }
}

/// The size and the place of an object.
fn place(rated: &Rated) -> String {
    let floor = rated.object.floor().map_or(String::new(), |floor| format!(", {floor}"));
    rated.object.set_size() + &floor
}

/// Before and after in one row.
pub fn figure(pairs: &[Pair], when: &str, target: Option<f64>) -> Figure {
    let (before, after) = (Ink::Muted, Ink::Data(1));
    let mut rows = Vec::new();
    for pair in pairs {
        let values = vec![(before, pair.before.row.p_overturning), (after, pair.after.row.p_overturning)];
        let words = match pair.ratio.value {
            None => String::new(),
            Some(_) if pair.is_changed() => format!("× {}", TWO_DIGITS.value(pair.ratio)),
            Some(_) => "as before".to_string(),
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
    let when = &before.when;
    let Some(worst) = pairs.first() else { return Page::default() };
    let p = [worst.before, worst.after].map(|rated| PERCENT.value(rated.row.p_overturning));
    let ratio = match worst.ratio.value {
        Some(_) => format!(
            "; it overturns {} times as often {}",
            TWO_DIGITS.value(worst.ratio),
            TWO_DIGITS.limits(worst.ratio, "95 % limits ")
        ),
        None => String::new(),
    };
    let joined = match pairs.len() {
        1 if worst.before.object.name().is_none() => "The one object of each file.".to_string(),
        _ => format!("{} of the same name in both files.", number::counted(pairs.len(), "object")),
    };
    let (hazards, cancels) = match before.hazard_key == after.hazard_key {
        true => (before.hazard.clone(), "the same hazard, that is all but what only one of them has"),
        false => (format!("{}; {}", before.hazard, after.hazard), "different hazards, PGV/PGA does not"),
    };
    let cancels = format!("Ratio: uncertainties that move both alike cancel; under {cancels}.");
    let [file_before, file_after, hazards] = [&before.file, &after.file, &hazards].map(|name| literal(name));
    let facts =
        [what_changed(&pairs), Some(joined), Some(cancels), limits_in_words(&worst.after.doubts.part_sds())];
    Page {
        title: match &pairs[..] {
            [pair] => format!("{}, before and after", pair.before.object.name().unwrap_or("One object")),
            _ => format!("{}, before and after", number::counted(pairs.len(), "object")),
        },
        place: format!("Before: {file_before}. After: {file_after}. Hazard: {hazards}."),
        sentence: format!(
            "{} overturns with a probability of {} before and {} after, {when}{ratio}.{}",
            worst.name(),
            p[0],
            p[1],
            worst_after(&pairs)
        ),
        tiles: tiles(&pairs, when),
        facts: facts.into_iter().flatten().collect(),
        table: Some(table(&pairs, when)),
        notes: unpaired(before, after, &pairs),
        figures: vec![figure(&pairs, when, before.target.or(after.target))],
        ..Page::default()
    }
}

/// The object that is the worst after, where it is another one than before.
fn worst_after(pairs: &[Pair]) -> String {
    let after = |pair: &&Pair| pair.after.row.p_overturning.value.unwrap_or(0.0);
    match pairs.iter().rev().max_by(|a, b| after(a).total_cmp(&after(b))) {
        Some(worst) if !std::ptr::eq(worst, &pairs[0]) => {
            format!(" Now the worst is {}: {}.", worst.name(), PERCENT.value(worst.after.row.p_overturning))
        }
        _ => String::new(),
    }
}

fn tiles(pairs: &[Pair], when: &str) -> Vec<Tile> {
    let worst = &pairs[0];
    let mut tiles = Vec::new();
    for (word, rated) in [("after", worst.after), ("before", worst.before)] {
        let (p, limits) = (rated.row.p_overturning, PERCENT.limits(rated.row.p_overturning, "95 % limits "));
        tiles.push(Tile::new(PERCENT.value(p), format!("{word}: overturns {when} {limits}")));
    }
    tiles.extend(worst.ratio.value.map(|_| {
        let limits = TWO_DIGITS.limits(worst.ratio, "95 % limits ");
        Tile::new(format!("× {}", TWO_DIGITS.value(worst.ratio)), format!("as often as before {limits}"))
    }));
    if pairs.len() > 1 {
        let before = Expected::new(pairs.iter().map(|pair| pair.before)).number();
        let after = Expected::new(pairs.iter().map(|pair| pair.after)).number();
        let words = format!("objects expected to overturn {when}");
        tiles.push(Tile::new(format!("{before} → {after}"), words));
    }
    tiles
}

fn table(pairs: &[Pair], when: &str) -> Table {
    let before = format!("before, {when}");
    let heads = ["object", &before, "after", "95 % limits", "times as often", "95 % limits"];
    let mut rows = Vec::new();
    for pair in pairs {
        let (times, limits) = match (pair.is_changed(), pair.ratio.value) {
            (false, _) => ("as before".to_string(), String::new()),
            (true, None) => Default::default(),
            (true, Some(_)) => (TWO_DIGITS.value(pair.ratio), TWO_DIGITS.limits(pair.ratio, "")),
        };
        let [p, q] = [pair.before, pair.after].map(|rated| rated.row.p_overturning);
        let limits_after = PERCENT.limits(q, "");
        let mut row = vec![pair.name(), PERCENT.value(p), PERCENT.value(q)];
        row.extend([limits_after, times, limits].map(|cell| cell.replace(['(', ')'], "")));
        rows.push(row);
    }
    Table::new(&heads, rows)
}

/// The size and the place of what is changed.
fn what_changed(pairs: &[Pair]) -> Option<String> {
    let mut lines = Vec::new();
    for pair in pairs {
        let [before, after] = [pair.before, pair.after].map(place);
        if before != after {
            lines.push(format!("{}: {before}, then {after}", pair.name()));
        }
    }
    (!lines.is_empty()).then(|| format!("What changed: {}.", lines.join("; ")))
}

/// Objects of one file alone, and those without an answer in both.
fn unpaired(before: &Evaluation, after: &Evaluation, pairs: &[Pair]) -> Vec<String> {
    let mut lines = Vec::new();
    for (one, other) in [(before, after), (after, before)] {
        let (mut alone, mut silent) = (Vec::new(), Vec::new());
        for rated in &one.rows {
            let is_paired =
                pairs.iter().any(|pair| std::ptr::eq(pair.before, rated) || std::ptr::eq(pair.after, rated));
            let is_in_both = other.rows.iter().any(|o| o.object.structure == rated.object.structure);
            match (is_paired, is_in_both) {
                (true, _) => {}
                (false, true) => silent.push(rated.object.marked_name()),
                (false, false) => alone.push(rated.object.marked_name()),
            }
        }
        if !alone.is_empty() {
            lines.push(format!("Only in {}: {}.", literal(&one.file), alone.join(", ")));
        }
        if !silent.is_empty() && std::ptr::eq(one, before) {
            lines.push(format!("No answer before or after: {}.", silent.join(", ")));
        }
    }
    lines
}
