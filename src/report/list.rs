//! The page of a list of objects: the worst first, and how many are to be expected.

use super::figure::{Axis, Figure, Layer, Panel, Side};
use super::object::{columns, facts, limits_in_words, widened, words_of};
use super::page::{Page, Table, Tile};
use super::rated::{BAND_NAMES, Evaluation, Rated, percent_in_row};
use super::text::literal;
use crate::keyword::Keyword;
use crate::number::{self, Limited, OF_HUNDRED, PERCENT};
use crate::object::Part;

/// The most objects that are drawn.
const DRAWN: usize = 60;

/// Objects of all evaluations, the worst first, those without an answer last.
fn sorted(evaluations: &[Evaluation]) -> Vec<(&Evaluation, &Rated)> {
    let mut all: Vec<(&Evaluation, &Rated)> =
        evaluations.iter().flat_map(|of| of.rows.iter().map(move |rated| (of, rated))).collect();
    all.sort_by(|(_, a), (_, b)| b.severity().total_cmp(&a.severity()));
    all
}

/// How likely each object overturns, those on the ground and those on floors apart.
pub fn figure(evaluations: &[Evaluation]) -> Figure {
    let all = sorted(evaluations);
    let answered: Vec<&Rated> =
        all.iter().map(|(_, rated)| *rated).filter(|rated| rated.is_answered()).collect();
    let drawn = &answered[..answered.len().min(DRAWN)];
    let (upstairs, ground): (Vec<&Rated>, Vec<&Rated>) =
        drawn.iter().partition(|rated| rated.floor.is_some());
    let places = [("On the ground", ground), ("On floors", upstairs)];
    let when = evaluations.first().map_or("", |of| of.when.as_str());
    let target = evaluations.iter().find_map(|of| of.target);
    let x = Axis::log(&format!("probability of overturning {when}, %"));
    let x = widened(x, drawn.iter().map(|rated| rated.overturning).chain([Limited::value(target)]));
    let several = places.iter().all(|(_, rows)| !rows.is_empty());
    let panels = places.into_iter().filter(|(_, rows)| !rows.is_empty()).map(|(title, rows)| {
        let title = if several { title } else { "" };
        panel(title, x.clone(), &rows, target)
    });
    let left_out = answered.len() - drawn.len();
    let rest = match left_out {
        0 => String::new(),
        _ => format!(" Not drawn: {} that are less likely to overturn.", number::counted(left_out, "object")),
    };
    let caption = format!(
        "Probability of overturning {when} with 95 % limits. The colours part at 2 and 10 %, in 50 years those of \
         the earthquakes that codes consider and design for.{rest}"
    );
    Figure::new("list", "How likely each object is to overturn", caption, 1, 0.0, panels.collect())
}

fn panel(title: &str, x: Axis, rows: &[&Rated], target: Option<f64>) -> Panel {
    let mut layers = Vec::new();
    if let Some(target) = target {
        let words = format!("target {}", PERCENT.one(target));
        layers.extend(Layer::upright(100.0 * target, [rows.len() as f64 - 0.5, -0.5], &words, Side::Above));
    }
    for (band, name) in BAND_NAMES.iter().enumerate().rev() {
        let its = rows.iter().enumerate().filter(|(_, rated)| rated.band() == band);
        let estimates: Vec<_> =
            its.map(|(row, rated)| percent_in_row(rated.overturning, row as f64)).collect();
        if let Some(rated) = rows.iter().find(|rated| rated.band() == band) {
            layers.push(Layer::estimates(name, rated.ink(), estimates));
        }
    }
    let words = rows.iter().enumerate().filter_map(|(row, rated)| words_of(rated.overturning, row));
    layers.push(Layer::words(super::figure::Ink::Text, words));
    Panel::new(title, x, Axis::names(rows.iter().map(|rated| rated.title())), layers)
}

/// The page of several objects, of one file or of several.
pub fn page(evaluations: &[Evaluation]) -> Page {
    let all = sorted(evaluations);
    let Some((of_worst, worst)) = all.first() else { return Page::default() };
    let when = &of_worst.when;
    let answered = all.iter().filter(|(_, rated)| rated.is_answered()).count();
    let upstairs = all.iter().filter(|(_, rated)| rated.is_answered() && rated.floor.is_some()).count();
    let place = match upstairs {
        0 => "on the ground".to_string(),
        _ if upstairs == answered => "on floors".to_string(),
        _ => format!("{} on the ground, {} on floors", answered - upstairs, upstairs),
    };
    let mut hazards: Vec<&str> = evaluations.iter().map(|of| of.hazard.as_str()).collect();
    hazards.dedup();
    let parts = |part: Part| {
        let largest = all.iter().flat_map(|(_, rated)| &rated.sds).filter(|(of, _)| *of == part);
        largest.map(|(_, sd)| *sd).reduce(f64::max).map(|sd| (part, sd))
    };
    let sds: Vec<(Part, f64)> = Part::ALL.iter().filter_map(|part| parts(*part)).collect();
    let several = evaluations.len() > 1;
    let file = if several { format!(" ({})", literal(&of_worst.file)) } else { String::new() };
    let mut models = facts(of_worst, &Rated { friction: None, floor: None, ..(*worst).clone() });
    models.retain(|fact| !fact.starts_with("The 95 %") && !fact.starts_with("Hazard"));
    let friction = "With less friction than shown, an object slides instead of rocking.".to_string();
    let building = (upstairs > 0).then(|| "Buildings are taken as linear.".to_string());
    let facts = [Some(friction), building, limits_in_words(&sds)].into_iter().flatten();
    Page {
        title: format!("{}: how likely they are to overturn", number::counted(all.len(), "object")),
        place: format!(
            "{} free-standing, {place}; hazard: {}",
            number::count(answered),
            literal(&hazards.join("; "))
        ),
        sentence: format!("{}{file} {}.", worst.title(), worst.sentence(when)),
        tiles: tiles(&all, when),
        facts: facts.chain(models).collect(),
        table: Some(table(&all, several)),
        notes: doubts(&all),
        figures: vec![figure(evaluations)],
        ..Page::default()
    }
}

/// The expected number of objects that overturn, of how many, and the probability that one or more do:
/// between that of the worst, where all fall together, and that of independent ones. Of an object of which only
/// a range is known both ends count.
pub struct Expected {
    pub least: f64,
    pub most: f64,
    pub of: f64,
    pub at_least_one: [f64; 2],
}

pub fn expected<'a>(all: impl Iterator<Item = &'a Rated>) -> Expected {
    let mut sum = Expected { least: 0.0, most: 0.0, of: 0.0, at_least_one: [0.0; 2] };
    let mut independent = 0.0;
    for rated in all {
        let (count, Limited { value, low, high }) = (rated.count.unwrap_or(1.0), rated.overturning);
        let Some((low, high)) = value.or(low).zip(value.or(high)).filter(|_| count > 0.0) else { continue };
        sum.of += count;
        sum.least += count * low;
        sum.most += count * high;
        sum.at_least_one[0] = sum.at_least_one[0].max(low);
        independent -= count * (-high).ln_1p();
    }
    sum.at_least_one[1] = -(-independent).exp_m1();
    sum
}

impl Expected {
    /// The expected number, or its range.
    pub fn number(&self) -> String {
        let (low, high) = (number::significant(self.least, 2), number::significant(self.most, 2));
        if low == high { low } else { format!("{low} to {high}") }
    }
}

fn tiles(all: &[(&Evaluation, &Rated)], years: &str) -> Vec<Tile> {
    let tile = |number: String, words: String| Tile { number, words };
    let (_, worst) = all[0];
    let expected = expected(all.iter().map(|(_, rated)| *rated));
    let [together, independent] = expected.at_least_one;
    let limits = PERCENT.limits(worst.overturning, "95 % limits ");
    let above = all.iter().filter(|(_, rated)| rated.band() > 0).count();
    vec![
        tile(PERCENT.value(worst.overturning), format!("{} overturns {years} {limits}", worst.title())),
        tile(
            expected.number(),
            format!("objects expected to overturn {years}, of {}", number::plain(expected.of)),
        ),
        tile(
            format!("{} to {}", OF_HUNDRED.one(together), PERCENT.one(independent)),
            "probability that at least one does: if all fall together, to if each falls by itself"
                .to_string(),
        ),
        tile(
            number::count(above),
            format!("{} more likely than 2 % to overturn", if above == 1 { "is" } else { "are" }),
        ),
    ]
}

fn table(all: &[(&Evaluation, &Rated)], several: bool) -> Table {
    let years = &all[0].0.when;
    let has = |what: fn(&Rated) -> bool| all.iter().any(|(_, rated)| what(rated));
    let (floors, counts) = (has(|rated| rated.floor.is_some()), has(|rated| rated.count.is_some()));
    let too_far = format!("rocks too far {years}, %");
    let mut heads =
        vec!["object", "overturns, %", "95 % limits", "once in years", &too_far, "friction needed"];
    let overturns = format!("overturns {years}, %");
    heads[1] = &overturns;
    heads.extend(["size"]);
    heads.extend(counts.then_some("number"));
    heads.extend(floors.then_some("where"));
    heads.extend(several.then_some("file"));
    let row = |(of, rated): &(&Evaluation, &Rated)| {
        let number = |count: Option<f64>| count.map_or(String::new(), number::plain);
        let mut cells = vec![rated.name.as_deref().map_or("unnamed".to_string(), literal)];
        match rated.is_answered() {
            true => cells.extend([
                OF_HUNDRED.value(rated.overturning),
                OF_HUNDRED.limits(rated.overturning, "").replace(['(', ')'], ""),
                rated.once_in_years.map_or(String::new(), number::period),
                OF_HUNDRED.value(rated.failure),
                rated.friction.map_or(String::new(), |friction| number::fixed(friction, 2)),
            ]),
            false => {
                let reason = literal(rated.doubts.as_deref().unwrap_or_default());
                cells.extend(["no answer".to_string(), reason, String::new(), String::new(), String::new()]);
            }
        }
        cells.push(rated.size.replace(' ', "\u{a0}"));
        cells.extend(counts.then(|| number(rated.count)));
        cells.extend(floors.then(|| rated.floor.clone().unwrap_or("on the ground".to_string())));
        cells.extend(several.then(|| literal(&of.file)));
        cells
    };
    let mut columns = columns(&heads);
    for column in &mut columns {
        column.is_number &= !["95 % limits", "size", "where", "file"].contains(&column.head.as_str());
    }
    Table { columns, rows: all.iter().map(row).collect(), ..Table::default() }
}

/// What speaks against answers: a line for those of the same words.
fn doubts(all: &[(&Evaluation, &Rated)]) -> Vec<String> {
    let warned = all.iter().map(|(_, rated)| *rated).filter(|rated| rated.is_answered());
    let mut lines: Vec<(&str, Vec<String>)> = Vec::new();
    for rated in warned {
        let Some(words) = rated.doubts.as_deref() else { continue };
        match lines.iter_mut().find(|(other, _)| *other == words) {
            Some((_, names)) => names.push(rated.title()),
            None => lines.push((words, vec![rated.title()])),
        }
    }
    let line = |(words, names): (&str, Vec<String>)| {
        let rest = names.len().saturating_sub(4);
        let names = names.into_iter().take(4).collect::<Vec<_>>().join(", ");
        let rest = if rest > 0 { format!(" and {rest} more") } else { String::new() };
        format!("{names}{rest}: {}", literal(words))
    };
    lines.into_iter().map(line).collect()
}
