//! The page of two evaluations, before and after: joined by the names of the objects.

use super::figure::{Axis, Estimate, Figure, Ink, Layer, Panel, Side, Words};
use super::object::{columns, limits_in_words, widened};
use super::page::{Page, Table, Tile};
use super::rated::{Evaluation, Rated, percent_in_row};
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
    let alone = |of: &Evaluation| of.rows.len() == 1 && of.rows[0].name.is_none();
    let both_alone = alone(before) && alone(after);
    let is_same = |a: &Rated, b: &Rated| both_alone || (a.name.is_some() && a.name == b.name);
    let same_hazard = before.hazard_key == after.hazard_key;
    let pair = |one: &'a Rated| {
        let other = after.rows.iter().find(|other| is_same(one, other))?;
        Some(Pair { before: one, after: other, ratio: ratio(one, other, same_hazard) })
    };
    let mut pairs: Vec<Pair> = before.rows.iter().filter_map(pair).collect();
    pairs.retain(|pair| pair.before.is_answered() || pair.after.is_answered());
    pairs.sort_by(|a, b| b.before.severity().total_cmp(&a.before.severity()));
    pairs
}

/// PGV/PGA, and what is not known of the hazard, is the same only under the same hazard.
fn ratio(before: &Rated, after: &Rated, same_hazard: bool) -> Limited {
    let known = |of: &Rated| {
        Some(RateByParts { rate: of.rate.value.filter(|rate| *rate > 0.0)?, sds: of.sds.clone() })
    };
    let Some((before, after)) = known(before).zip(known(after)) else { return Limited::default() };
    let is_shared = |part: Part| same_hazard || !matches!(part, Part::Velocity | Part::Hazard);
    ratio_of_rates(&before, &after, is_shared).into()
}

/// Before and after in one row.
pub fn figure(pairs: &[Pair], when: &str, target: Option<f64>) -> Figure {
    let both = pairs.iter().flat_map(|pair| [pair.before.overturning, pair.after.overturning]);
    let x = Axis::log(&format!("probability of overturning {}, %", when));
    let x = widened(x, both.chain([Limited::value(target)]));
    let estimates = |of: fn(&Pair) -> Limited, off: f64| -> Vec<Estimate> {
        pairs.iter().enumerate().map(|(row, pair)| percent_in_row(of(pair), row as f64 + off)).collect()
    };
    let word = |(row, pair): (usize, &Pair)| {
        let ends =
            [pair.before, pair.after].map(|of| of.overturning.high.or(of.overturning.value).unwrap_or(0.0));
        let x = 100.0 * ends[0].max(ends[1]);
        let text = match is_changed(pair) {
            true => format!("× {}", TWO_DIGITS.value(pair.ratio)),
            false => "as before".to_string(),
        };
        Some(Words { x, y: row as f64, text, side: Side::Right })
            .filter(|_| x > 0.0 && pair.ratio.value.is_some())
    };
    let mut layers = Vec::new();
    if let Some(target) = target {
        let at = [pairs.len() as f64 - 0.5, -0.5];
        layers.extend(Layer::upright(
            100.0 * target,
            at,
            &format!("target {}", PERCENT.one(target)),
            Side::Above,
        ));
    }
    layers.extend([
        Layer::estimates("before", Ink::Muted, estimates(|pair| pair.before.overturning, -0.17)),
        Layer::estimates("after", Ink::Data(1), estimates(|pair| pair.after.overturning, 0.17)),
        Layer::words(Ink::Text, pairs.iter().enumerate().filter_map(word)),
    ]);
    let name = |pair: &Pair| pair.before.name.as_deref().map_or("the object".to_string(), literal);
    let panel = Panel::new("", x, Axis::names(pairs.iter().map(name)), layers);
    let caption = format!(
        "Probability of overturning {} before and after, with 95 % limits; beside it the ratio of the rates, \
         after over before.",
        when
    );
    let panels = if pairs.is_empty() { Vec::new() } else { vec![panel] };
    Figure::new("compared", "Before and after", caption, 1, 0.0, panels)
}

/// The page of two evaluations.
pub fn page(before: &Evaluation, after: &Evaluation) -> Page {
    let pairs = pairs(before, after);
    let when = &before.when;
    let target = before.target.or(after.target);
    let Some(worst) = pairs.first() else { return Page::default() };
    let name = worst.before.name.as_deref().map_or("The object".to_string(), literal);
    let p = [worst.before, worst.after].map(|of| PERCENT.value(of.overturning));
    let ratio = match worst.ratio.value {
        Some(_) => format!(
            "; it overturns {} times as often {}",
            TWO_DIGITS.value(worst.ratio),
            TWO_DIGITS.limits(worst.ratio, "95 % limits ")
        ),
        None => String::new(),
    };
    let same_hazard = before.hazard_key == after.hazard_key;
    let joined = match pairs.len() {
        1 if worst.before.name.is_none() => "The one object of each file.".to_string(),
        _ => format!("{} of the same name in both files.", number::counted(pairs.len(), "object")),
    };
    let hazard = if same_hazard { "the same hazard" } else { "different hazards" };
    let cancels = format!(
        "Ratio: what is not known of both, and moves both alike, cancels; under {hazard}, {}.",
        if same_hazard { "that is all but what only one of them has" } else { "PGV/PGA does not" }
    );
    let files = format!(
        "Before: {}. After: {}. Hazard: {}.",
        literal(&before.file),
        literal(&after.file),
        literal(&if same_hazard {
            before.hazard.clone()
        } else {
            format!("{}; {}", before.hazard, after.hazard)
        })
    );
    let alone = pairs.len() == 1;
    Page {
        title: match alone {
            true => format!("{}, before and after", worst.before.name.as_deref().unwrap_or("One object")),
            false => format!("{}, before and after", number::counted(pairs.len(), "object")),
        },
        place: files,
        sentence: format!(
            "{name} overturns with a probability of {} before and {} after, {}{ratio}.",
            p[0], p[1], when
        ),
        tiles: tiles(&pairs, when),
        facts: [what_changed(&pairs), Some(joined), Some(cancels), limits_in_words(&worst.after.sds)]
            .into_iter()
            .flatten()
            .collect(),
        table: Some(table(&pairs, when)),
        notes: unpaired(before, after, &pairs),
        figures: vec![figure(&pairs, when, target)],
        ..Page::default()
    }
}

fn tiles(pairs: &[Pair], when: &str) -> Vec<Tile> {
    let worst = &pairs[0];
    let tile = |number: String, words: String| Tile { number, words };
    let limits = |p: Limited| PERCENT.limits(p, "95 % limits ");
    let [p, q] = [worst.before.overturning, worst.after.overturning];
    let mut tiles = vec![
        tile(PERCENT.value(q), format!("after: overturns {when} {}", limits(q))),
        tile(PERCENT.value(p), format!("before: overturns {when} {}", limits(p))),
        tile(
            format!("× {}", TWO_DIGITS.value(worst.ratio)),
            format!("as often as before {}", TWO_DIGITS.limits(worst.ratio, "95 % limits ")),
        ),
    ];
    if pairs.len() > 1 {
        let before = super::list::expected(pairs.iter().map(|pair| pair.before)).number();
        let after = super::list::expected(pairs.iter().map(|pair| pair.after)).number();
        tiles.push(tile(format!("{before} → {after}"), format!("objects expected to overturn {when}")));
    }
    tiles
}

fn table(pairs: &[Pair], when: &str) -> Table {
    let heads =
        ["object", &format!("before, {when}"), "after", "95 % limits", "times as often", "95 % limits"];
    let row = |pair: &Pair| {
        let [times, limits] = match (is_changed(pair), pair.ratio.value) {
            (false, _) => ["as before".to_string(), String::new()],
            (true, None) => [String::new(), String::new()],
            (true, Some(_)) => {
                [TWO_DIGITS.value(pair.ratio), TWO_DIGITS.limits(pair.ratio, "").replace(['(', ')'], "")]
            }
        };
        vec![
            pair.before.name.as_deref().map_or("unnamed".to_string(), literal),
            PERCENT.value(pair.before.overturning),
            PERCENT.value(pair.after.overturning),
            PERCENT.limits(pair.after.overturning, "").replace(['(', ')'], ""),
            times,
            limits,
        ]
    };
    Table { columns: columns(&heads), rows: pairs.iter().map(row).collect(), ..Table::default() }
}

fn place(rated: &Rated) -> String {
    rated.floor.as_ref().map_or(rated.size.clone(), |floor| format!("{}, {floor}", rated.size))
}

fn is_changed(pair: &Pair) -> bool {
    pair.before.rate != pair.after.rate || place(pair.before) != place(pair.after)
}

/// The size and the place of what is changed.
fn what_changed(pairs: &[Pair]) -> Option<String> {
    let line = |pair: &Pair| {
        let name = pair.before.name.as_deref().map_or("the object".to_string(), literal);
        format!("{name}: {}, then {}", place(pair.before), place(pair.after))
    };
    let lines: Vec<String> =
        pairs.iter().filter(|pair| place(pair.before) != place(pair.after)).map(line).collect();
    (!lines.is_empty()).then(|| format!("What changed: {}.", lines.join("; ")))
}

/// Objects of one file alone, and those without an answer in both.
fn unpaired(before: &Evaluation, after: &Evaluation, pairs: &[Pair]) -> Vec<String> {
    let line = |of: &Evaluation, words: String, is_told: &dyn Fn(&Rated) -> bool| {
        let told = of.rows.iter().filter(|rated| is_told(rated));
        let names: Vec<String> = told.map(Rated::title).collect();
        (!names.is_empty()).then(|| format!("{words}: {}.", names.join(", ")))
    };
    let in_both =
        |rated: &Rated| [before, after].iter().all(|of| of.rows.iter().any(|o| o.name == rated.name));
    let is_paired = |rated: &Rated| {
        pairs.iter().any(|pair| std::ptr::eq(pair.before, rated) || std::ptr::eq(pair.after, rated))
    };
    let only = |of: &Evaluation| {
        line(of, format!("Only in {}", literal(&of.file)), &|rated| !is_paired(rated) && !in_both(rated))
    };
    let silent =
        line(before, "No answer before or after".to_string(), &|rated| !is_paired(rated) && in_both(rated));
    [only(before), only(after), silent].into_iter().flatten().collect()
}
