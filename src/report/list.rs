//! The page of a list of objects: the worst first, and how many are to be expected.

use super::answers::{BAND_NAMES, Evaluation, Expected, Rated, words_of_silent};
use super::figure::{Figure, Ink};
use super::object::{limits_in_words, model_in_words};
use super::page::{Page, Table, Tile};
use super::probabilities::{self, Row};
use super::text::literal;
use crate::keyword::Keyword;
use crate::number::{self, Limited, OF_HUNDRED, PERCENT};
use crate::object::Part;

/// The most objects that are drawn, and files whose expected numbers are shown.
const DRAWN: usize = 60;
const FILES: usize = 3;

/// An object of one of several evaluations.
#[derive(Clone, Copy)]
struct Listed<'a> {
    evaluation: &'a Evaluation,
    rated: &'a Rated,
}

/// Objects of all evaluations, the worst first, those without an answer last.
fn sorted(evaluations: &[Evaluation]) -> Vec<Listed<'_>> {
    let mut all: Vec<Listed> = evaluations
        .iter()
        .flat_map(|evaluation| evaluation.rows.iter().map(move |rated| Listed { evaluation, rated }))
        .collect();
    all.sort_by(|a, b| b.rated.severity().total_cmp(&a.rated.severity()));
    all
}

/// How likely each object overturns, those on the ground and those on floors apart.
pub fn figure(evaluations: &[Evaluation]) -> Figure {
    let mut answered: Vec<&Rated> = sorted(evaluations).iter().map(|listed| listed.rated).collect();
    answered.retain(|rated| rated.is_answered());
    let drawn = &answered[..answered.len().min(DRAWN)];
    let (upstairs, ground): (Vec<&Rated>, Vec<&Rated>) =
        drawn.iter().partition(|rated| rated.object.floor().is_some());
    let is_split = !upstairs.is_empty() && !ground.is_empty();
    let when = evaluations.first().map_or("", |evaluation| evaluation.when.as_str());
    let target = evaluations.iter().find_map(|evaluation| evaluation.target);
    let all = drawn.iter().map(|rated| rated.row.p_overturning).chain([Limited::value(target)]);
    let x = probabilities::axis(&format!("probability of overturning {when}"), all);
    let bands: Vec<(Ink, &str)> = (0..3).rev().map(|band| (Ink::Band(band), BAND_NAMES[band])).collect();
    let mut panels = Vec::new();
    for (title, group) in [("On the ground", ground), ("On floors", upstairs)] {
        let row = |rated: &&Rated| {
            Row::new(rated.object.marked_name(), Ink::Band(rated.band()), rated.row.p_overturning)
        };
        let rows: Vec<Row> = group.iter().map(row).collect();
        if !rows.is_empty() {
            let title = if is_split { title } else { "" };
            panels.push(probabilities::panel(title, x.clone(), &rows, &bands, target));
        }
    }
    let rest = match answered.len() - drawn.len() {
        0 => String::new(),
        rest => format!(" Not drawn: {} that are less likely to overturn.", number::counted(rest, "object")),
    };
    let caption = format!(
        "Probability of overturning {when} with 95 % limits. The colours part at 2 and 10 %, in 50 years those of \
         the earthquakes that codes consider and design for.{rest}"
    );
    Figure::new("list", "How likely each object is to overturn", 1, 0.0, panels).explained(caption)
}

/// The page of several objects, of one file or of several.
pub fn page(evaluations: &[Evaluation]) -> Page {
    let all = sorted(evaluations);
    let Some(Listed { evaluation, rated: worst }) = all.first() else { return Page::default() };
    let answered: Vec<&Rated> =
        all.iter().map(|listed| listed.rated).filter(|rated| rated.is_answered()).collect();
    let upstairs = answered.iter().filter(|rated| rated.object.floor().is_some()).count();
    let place = match upstairs {
        0 => "on the ground".to_string(),
        _ if upstairs == answered.len() => "on floors".to_string(),
        _ => format!("{} on the ground, {} on floors", answered.len() - upstairs, upstairs),
    };
    let mut hazards: Vec<&str> = evaluations.iter().map(|evaluation| evaluation.hazard.as_str()).collect();
    hazards.dedup();
    let mut largest_sds: Vec<(Part, f64)> = Vec::new();
    for part in Part::ALL {
        let sds = all.iter().flat_map(|listed| listed.rated.doubts.part_sds());
        let sds = sds.filter(|(other, _)| other == part).map(|(_, sd)| sd);
        largest_sds.extend(sds.reduce(f64::max).map(|sd| (*part, sd)));
    }
    let several = evaluations.len() > 1;
    let file = if several { format!(" ({})", literal(&evaluation.file)) } else { String::new() };
    let friction = "With less friction than shown, an object slides instead of rocking.".to_string();
    let building = (upstairs > 0).then(|| "Buildings are taken as linear.".to_string());
    let facts = [Some(friction), building, limits_in_words(&largest_sds), model_in_words(&worst.object)];
    let silent = words_of_silent(all.len() - answered.len(), all.len());
    Page {
        title: format!("{}: how likely they are to overturn", number::counted(all.len(), "object")),
        place: format!(
            "{} free-standing, {place}; hazard: {}",
            number::count(answered.len()),
            literal(&hazards.join("; "))
        ),
        sentence: format!(
            "{}{file} {}. {}",
            worst.object.marked_name(),
            worst.sentence(&evaluation.when),
            silent.unwrap_or_default()
        ),
        tiles: tiles(evaluations, worst, &evaluation.when),
        facts: facts.into_iter().flatten().collect(),
        table: Some(table(&all, several)),
        notes: doubts(&answered),
        figures: vec![figure(evaluations)],
        ..Page::default()
    }
}

fn tiles(evaluations: &[Evaluation], worst: &Rated, when: &str) -> Vec<Tile> {
    let (p, name) = (worst.row.p_overturning, worst.object.marked_name());
    let limits = PERCENT.limits(p, "95 % limits ");
    let mut tiles = vec![Tile::new(PERCENT.value(p), format!("{name} overturns {when} {limits}"))];
    // The same object may stand in several files, under several hazards: their sum would be of nothing.
    for evaluation in evaluations.iter().take(FILES) {
        let expected = Expected::new(&evaluation.rows);
        let file =
            if evaluations.len() > 1 { format!(" ({})", literal(&evaluation.file)) } else { String::new() };
        let words = format!("objects expected to overturn {when}, of {}{file}", number::plain(expected.all));
        tiles.push(Tile::new(expected.number(), words));
    }
    if let [one] = evaluations {
        let Expected { together, independent, .. } = Expected::new(&one.rows);
        tiles.push(Tile::new(
            format!("{} to {}", OF_HUNDRED.one(together), PERCENT.one(independent)),
            "probability that at least one does: if all fall together, to if each falls by itself",
        ));
        let above = one.rows.iter().filter(|rated| rated.band() > 0).count();
        let are = if above == 1 { "is" } else { "are" };
        tiles.push(Tile::new(number::count(above), format!("{are} more likely than 2 % to overturn")));
    }
    tiles
}

fn table(all: &[Listed], several: bool) -> Table {
    let when = &all[0].evaluation.when;
    let has_floors = all.iter().any(|listed| listed.rated.object.floor().is_some());
    let has_counts = all.iter().any(|listed| listed.rated.object.count.is_some());
    let (overturns, too_far) = (format!("overturns {when}, %"), format!("rocks too far {when}, %"));
    let mut heads = vec!["object", &overturns, "95 % limits", "once in years", &too_far, "friction needed"];
    heads.extend(["size"]);
    heads.extend(has_counts.then_some("number"));
    heads.extend(has_floors.then_some("where"));
    heads.extend(several.then_some("file"));
    let mut rows = Vec::new();
    for Listed { evaluation, rated } in all {
        let (object, row) = (&rated.object, &rated.row);
        let mut cells = vec![object.name().map_or("unnamed".to_string(), literal)];
        if rated.is_answered() {
            let friction = object.friction.filter(|_| !object.is_friction_known);
            cells.extend([
                OF_HUNDRED.value(row.p_overturning),
                OF_HUNDRED.limits(row.p_overturning, "").replace(['(', ')'], ""),
                row.return_period_years.map_or(String::new(), number::period),
                OF_HUNDRED.value(row.p_failure),
                friction.map_or(String::new(), |friction| number::fixed(friction, 2)),
            ]);
        } else {
            let reason = literal(rated.doubts.warnings.as_deref().unwrap_or_default());
            cells.extend(["no answer".to_string(), reason, String::new(), String::new(), String::new()]);
        }
        cells.push(object.set_size().replace(' ', "\u{a0}"));
        cells.extend(has_counts.then(|| object.count.map_or(String::new(), number::plain)));
        cells.extend(has_floors.then(|| object.floor().unwrap_or("on the ground".to_string())));
        cells.extend(several.then(|| literal(&evaluation.file)));
        rows.push(cells);
    }
    let mut table = Table::new(&heads, rows);
    for column in &mut table.columns {
        column.is_number &= !["95 % limits", "size", "where", "file"].contains(&column.head.as_str());
    }
    table
}

/// What speaks against answers: a line for those of the same words.
fn doubts(answered: &[&Rated]) -> Vec<String> {
    const NAMED: usize = 4;
    let mut lines: Vec<(&str, Vec<String>)> = Vec::new();
    for rated in answered {
        let Some(words) = rated.doubts.warnings.as_deref() else { continue };
        match lines.iter_mut().find(|(other, _)| *other == words) {
            Some((_, names)) => names.push(rated.object.marked_name()),
            None => lines.push((words, vec![rated.object.marked_name()])),
        }
    }
    let lines = lines.into_iter();
    lines.map(|(words, names)| format!("{}: {}", number::listed(&names, NAMED), literal(words))).collect()
}
