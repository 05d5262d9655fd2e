//! The page of one object: to scale, its fragility, the hazard, what would change the answer, what is not
//! known.

use super::figure::{Axis, Dash, Estimate, Figure, Frame, Ink, Layer, Panel, Side, Words};
use super::page::{Column, Page, Section, Table, Tile};
use super::portrait::{HazardCurve, Outline, Portrait};
use super::rated::{Evaluation, Rated, percent_in_row};
use crate::fragility::{LimitState, Z_95};
use crate::hazard::{Fragility, FragilityPoint, intensity_in_words};
use crate::number::{self, Limited, PERCENT, RATE};
use crate::object::Part;

/// Height of the area of the data of a panel, points.
const HEIGHT: f64 = 150.0;

/// The figure of an object in the colours of a page: what there is of its panels.
pub fn figure(evaluation: &Evaluation, rated: &Rated) -> Figure {
    let portrait = &evaluation.portrait;
    let panels = [
        portrait.outline.as_ref().map(|outline| sketch(outline, rated)),
        portrait.fragility.as_ref().map(|curve| fragility(curve, evaluation, portrait.hazard.as_ref())),
        (portrait.changes.len() > 1).then(|| changes(evaluation, &portrait.changes)),
        portrait.hazard.as_ref().map(hazard),
        portrait.hazard.as_ref().filter(|hazard| !hazard.shares.is_empty()).map(shares),
        (!rated.sds.is_empty()).then(|| unknown(rated)),
    ];
    let panels: Vec<Panel> = panels.into_iter().flatten().collect();
    let panels = if panels.is_empty() { vec![states(evaluation, rated)] } else { panels };
    let title = format!("{}, {}", rated.title(), rated.size);
    Figure::new("object", &title, "", 2, HEIGHT, panels)
}

/// The object as it stands, and as it is about to tip.
fn sketch(outline: &Outline, rated: &Rated) -> Panel {
    let Outline { width, height, centre_height, centre_offset, alpha_rad } = *outline;
    let base = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
    // It tips over its nearer edge, which is drawn at the right.
    let centre = [0.5 * width + centre_offset.abs(), centre_height];
    let tipped = |[x, y]: [f64; 2]| {
        let ([sin, cos], away) = ([alpha_rad.sin(), alpha_rad.cos()], x - width);
        [width + away * cos + y * sin, y * cos - away * sin]
    };
    let closed = |corners: [[f64; 2]; 4]| corners.into_iter().chain([corners[0]]).collect::<Vec<_>>();
    let turned = base.map(tipped);
    let room = 0.16 * height.max(width);
    let right = turned.iter().map(|corner| corner[0]).fold(width, f64::max);
    let top = turned.iter().map(|corner| corner[1]).fold(height, f64::max);
    let ground = vec![[-2.0 * room, 0.0], [right + room, 0.0]];
    let word = |x: f64, y: f64, text: String, side: Side| Words { x, y, text, side };
    let length = |length: f64| format!("{} m", number::length(length));
    let layers = vec![
        Layer::line("", Ink::Muted, ground),
        Layer::area("", Ink::Data(0), closed(base)),
        Layer::line("", Ink::Text, closed(base)),
        Layer::curve("", Ink::Data(1), Dash::Short, closed(turned), Vec::new()),
        Layer::curve("", Ink::Data(1), Dash::Short, vec![[width, 0.0], tipped(centre)], Vec::new()),
        Layer::curve("", Ink::Muted, Dash::Short, vec![[width, 0.0], centre], Vec::new()),
        Layer::points("", Ink::Data(1), [tipped(centre)]),
        Layer::points("", Ink::Text, [centre]),
        Layer::words(
            Ink::Muted,
            [
                word(0.5 * width, 0.0, length(width), Side::Below),
                word(0.0, 0.5 * height, length(height), Side::Left),
            ],
        ),
        Layer::words(
            Ink::Data(1),
            [word(
                turned[2][0],
                turned[2][1],
                format!("tips at {}°", number::significant(alpha_rad.to_degrees(), 3)),
                Side::Right,
            )],
        ),
    ];
    let x = Axis::linear("").over(-2.0 * room, right + 3.6 * room);
    let y = Axis::linear("").over(-1.1 * room, top + 0.3 * room);
    let place = rated.floor.as_ref().map_or("on the ground".to_string(), |floor| format!("at {floor}"));
    let caption = format!(
        "To scale, with its centre of mass, standing {place}. It overturns beyond {}° of its weaker side if no \
         motion brings it back.",
        number::significant(alpha_rad.to_degrees(), 3)
    );
    Panel { frame: Frame::ToScale, ..Panel::new("The object", x, y, layers).explained(caption) }
}

fn fragility(of: &Fragility, evaluation: &Evaluation, hazard: Option<&HazardCurve>) -> Panel {
    let (what, unit, symbol) = of.over.words();
    let label = format!("{what} ({symbol})");
    let line = |state: LimitState| -> Vec<[f64; 2]> {
        of.points.iter().map(|point| [point.intensity / unit, 100.0 * point.p.get(state).value]).collect()
    };
    let limits =
        |point: &FragilityPoint| [point.p.overturning.low, point.p.overturning.high].map(|p| 100.0 * p);
    let overturning = line(LimitState::Overturning);
    let too_far = format!("rocks beyond {} of *α*, or overturns", PERCENT.one(evaluation.limit_state));
    let ends = [overturning.first(), overturning.last()].map(|point| point.map_or(1.0, |[x, _]| *x));
    let band = of.points.iter().map(limits).collect();
    let mut layers = vec![
        Layer::line("rocks", Ink::Muted, line(LimitState::Rocking)),
        Layer::line(&too_far, Ink::Data(0), line(LimitState::Failure)),
        Layer::curve("overturns, with 95 % limits", Ink::Data(1), Dash::Solid, overturning, band),
    ];
    for (intensity, years) in hazard.map_or(&[][..], |hazard| &hazard.usual) {
        let inside = (ends[0]..=ends[1]).contains(intensity) && hazard.is_some_and(|h| h.label == label);
        if inside {
            let words = format!("once in {} years", number::count(*years as usize));
            layers.extend(Layer::upright(*intensity, [0.0, 100.0], &words, Side::Along));
        }
    }
    let place = if hazard.is_some() { " at the site" } else { "" };
    let caption = format!(
        "Probability under a motion of this {what}{place}, averaged over what such motions have besides. One in two: \
         {}.",
        intensity_in_words(of.over, of.overturning.theta.value)
    );
    let (x, y) = (Axis::log(&label).over(ends[0], ends[1]), Axis::linear("probability, %").over(0.0, 101.0));
    Panel::new("Fragility", x, y, layers).explained(caption)
}

fn changes(evaluation: &Evaluation, changes: &[(String, Limited)]) -> Panel {
    let years = &evaluation.when;
    let rows = changes.iter().enumerate();
    let estimate = |(row, (_, p)): (usize, &(String, Limited))| percent_in_row(*p, row as f64);
    let (first, others): (Vec<Estimate>, Vec<Estimate>) = rows.map(estimate).partition(|e| e.y == 0.0);
    let mut layers = Vec::new();
    if let Some(target) = evaluation.target {
        let at = [changes.len() as f64 - 0.5, -0.5];
        let words = format!("target {}", PERCENT.one(target));
        layers.extend(Layer::upright(100.0 * target, at, &words, Side::Above));
    }
    layers.extend([
        Layer::estimates("", Ink::Data(1), first),
        Layer::estimates("", Ink::Data(0), others),
        Layer::words(Ink::Text, changes.iter().enumerate().filter_map(|(row, (_, p))| words_of(*p, row))),
    ]);
    let names = Axis::names(changes.iter().map(|(name, _)| name.clone()));
    let x = Axis::log(&format!("probability of overturning {years}, %"));
    let caption = format!(
        "Probability of overturning {years} with 95 % limits, as it is and with one thing changed. Anchored, it \
         does not rock: for the forces on anchors see ASCE 7, chapter 13, or EN 1998-1, 4.3.5."
    );
    Panel::new("What would change it", widened(x, changes.iter().map(|(_, p)| *p)), names, layers)
        .explained(caption)
}

/// An axis in percent with room for words at the right.
pub fn widened(x: Axis, all: impl Iterator<Item = Limited>) -> Axis {
    let ends = all.flat_map(|p| [p.value, p.low, p.high]).flatten();
    let values: Vec<f64> = ends.filter(|p| *p > 0.0).map(|p| 100.0 * p).collect();
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(0.0, f64::max);
    if low < high { x.over(low / 1.3, high * (high / low).powf(0.3).max(1.6)) } else { x }
}

/// The value beside the upper limit of a row.
pub fn words_of(p: Limited, row: usize) -> Option<Words> {
    let x = 100.0 * p.high.or(p.value)?;
    Some(Words { x, y: row as f64, text: PERCENT.value(p), side: Side::Right }).filter(|word| word.x > 0.0)
}

fn hazard(hazard: &HazardCurve) -> Panel {
    let [first, last] =
        [hazard.points.first(), hazard.points.last()].map(|point| point.map_or(1.0, |p| p[0]));
    let rates = hazard.points.iter().map(|point| point[1]);
    let lowest = rates.fold(f64::INFINITY, f64::min);
    let mut layers = Vec::new();
    for (intensity, years) in &hazard.usual {
        let words = format!("once in {} years", number::count(*years as usize));
        layers.extend(Layer::upright(*intensity, [lowest, 1.0 / years], &words, Side::Along));
    }
    layers.push(Layer::line("", Ink::Text, hazard.points.clone()));
    layers.push(Layer::points("", Ink::Text, hazard.usual.iter().map(|(im, years)| [*im, 1.0 / years])));
    let what = hazard.label.split(' ').next().unwrap_or_default();
    let usual: Vec<String> = hazard
        .usual
        .iter()
        .map(|(im, years)| {
            let unit = hazard.label.split(['(', ')']).nth(1).unwrap_or_default();
            format!("{} {unit} once in {} years", number::significant(*im, 2), number::count(*years as usize))
        })
        .collect();
    let caption = format!("How often {what} is exceeded at the site, as it was given: {}.", usual.join(", "));
    let x = Axis::log(&hazard.label).over(first, last);
    Panel::new("Hazard", x, Axis::log("exceeded, times a year"), layers).explained(caption)
}

/// The share of the rate of overturning by intensity, as a density: an area of the same size is the same
/// share.
fn shares(hazard: &HazardCurve) -> Panel {
    let mut outline = Vec::new();
    for ([low, high], share) in &hazard.shares {
        let density = 100.0 * share / (high / low).ln();
        outline.extend([[*low, density], [*high, density]]);
    }
    let [first, last] = [hazard.shares.first(), hazard.shares.last()];
    let [start, end] = [first.map_or(1.0, |bin| bin.0[0]), last.map_or(1.0, |bin| bin.0[1])];
    let closed = std::iter::once([start, 0.0]).chain(outline.iter().copied()).chain([[end, 0.0]]).collect();
    let what = hazard.label.split(' ').next().unwrap_or_default();
    let beyond = match hazard.beyond {
        share if share >= 0.0005 => format!(" {} of the rate lies beyond the curve.", PERCENT.one(share)),
        _ => String::new(),
    };
    let caption = format!(
        "Which motions overturn it: the share of the rate of overturning by {what}. Equal areas are equal \
         shares; all of it is 100 %.{beyond}"
    );
    let layers = vec![Layer::area("", Ink::Data(1), closed), Layer::line("", Ink::Data(1), outline)];
    let most = hazard.shares.iter().map(|([low, high], share)| 100.0 * share / (high / low).ln());
    let y = Axis::linear(&format!("% of the rate per unit of ln {what}"))
        .over(0.0, 1.08 * most.fold(1e-9, f64::max));
    let x = hazard.points.first().zip(hazard.points.last());
    let x = x.map_or(Axis::log(&hazard.label), |(a, b)| Axis::log(&hazard.label).over(a[0], b[0]));
    Panel::new("Where the rate comes from", x, y, layers).explained(caption)
}

/// What is not known, by how far it moves the rate.
fn unknown(rated: &Rated) -> Panel {
    let mut parts = rated.sds.clone();
    parts.sort_by(|a, b| b.1.total_cmp(&a.1));
    let factor = |sd: f64| (Z_95 * sd).exp();
    let bars = parts.iter().enumerate().map(|(row, (_, sd))| {
        let [y, x] = [row as f64, factor(*sd)];
        let outline = [[1.0, y - 0.3], [x, y - 0.3], [x, y + 0.3], [1.0, y + 0.3]];
        Layer::area("", Ink::Data(0), outline.to_vec())
    });
    let words = parts.iter().enumerate().map(|(row, (_, sd))| Words {
        x: factor(*sd),
        y: row as f64,
        text: format!("× {}", number::significant(factor(*sd), 2)),
        side: Side::Right,
    });
    let most = factor(parts[0].1);
    let layers = bars.chain([Layer::words(Ink::Text, words)]).collect();
    let names = Axis::names(parts.iter().map(|(part, _)| measured(*part).to_string()));
    let x = Axis::log("factor on the rate, either way").over(1.0, most * most.powf(0.35).max(1.2));
    let caption = "What is not known and what would tell: the factor by which each moves the rate of overturning, \
                   up or down, at its 95 % limits.";
    Panel::new("What is not known", x, names, layers).explained(caption)
}

/// What is not known, and what to measure.
fn measured(part: Part) -> &'static str {
    match part {
        Part::Fit => "fragility: records of the site",
        Part::Magnitude => "magnitude: disaggregation",
        Part::Velocity => "PGV: its hazard curve",
        Part::Eta => "restitution: a rocking test",
        Part::Object => "centre of mass: weigh it",
        Part::Floor => "building: measure its period",
        Part::Hazard => "hazard: its fractiles",
    }
}

/// The limit states, where nothing else is known of the object.
fn states(evaluation: &Evaluation, rated: &Rated) -> Panel {
    let too_far = format!("rocks beyond {} of *α*", PERCENT.one(evaluation.limit_state));
    let rows = [
        ("rocks".to_string(), Limited::value(rated.rocking)),
        (too_far, rated.failure),
        ("overturns".to_string(), rated.overturning),
    ];
    let layers = vec![
        Layer::estimates(
            "",
            Ink::Data(1),
            rows.iter().enumerate().map(|(row, (_, p))| percent_in_row(*p, row as f64)),
        ),
        Layer::words(Ink::Text, rows.iter().enumerate().filter_map(|(row, (_, p))| words_of(*p, row))),
    ];
    let x = Axis::log(&format!("probability {}, %", evaluation.when.clone()));
    let x = widened(x, rows.iter().map(|(_, p)| *p));
    let caption = "Probability of each limit state with 95 % limits.";
    Panel::new("How likely", x, Axis::names(rows.into_iter().map(|(name, _)| name)), layers)
        .explained(caption)
}

/// The page of one object.
pub fn page(evaluation: &Evaluation, rated: &Rated) -> Page {
    let portrait = &evaluation.portrait;
    let sentence = rated.sentence(&evaluation.when);
    let place =
        rated.floor.as_ref().map_or("On the ground".to_string(), |floor| format!("On a floor: {floor}"));
    let title = match &rated.name {
        Some(name) => format!("{name}, {}", rated.size),
        None => format!("{} of {}", rated.kind, rated.size),
    };
    Page {
        title,
        place: format!("{place}; hazard: {}", super::text::literal(&evaluation.hazard)),
        sentence: format!("It {sentence}."),
        tiles: tiles(evaluation, rated, portrait),
        facts: facts(evaluation, rated),
        notes: rated.doubts.iter().map(|doubts| super::text::literal(doubts)).collect(),
        figures: vec![Figure { title: String::new(), ..figure(evaluation, rated) }],
        sections: vec![Section {
            heading: "The numbers".to_string(),
            tables: vec![numbers(evaluation, rated), table_of_changes(evaluation, portrait)],
            ..Section::default()
        }],
        ..Page::default()
    }
}

fn tiles(evaluation: &Evaluation, rated: &Rated, portrait: &Portrait) -> Vec<Tile> {
    let years = &evaluation.when;
    let tile = |number: String, words: String| Tile { number, words };
    let limits = PERCENT.limits(rated.overturning, "95 % limits ");
    let mut tiles = vec![
        tile(PERCENT.value(rated.overturning), format!("overturns {years} {limits}")),
        tile(
            PERCENT.value(rated.failure),
            format!("rocks beyond {} of its slenderness, or overturns", PERCENT.one(evaluation.limit_state)),
        ),
    ];
    if let Some(Fragility { over, overturning, .. }) = &portrait.fragility {
        let words = format!("{} at which half of the motions overturn it", over.words().0);
        tiles.push(tile(intensity_in_words(*over, overturning.theta.value), words));
    }
    let by_value = |a: &&(String, Limited), b: &&(String, Limited)| {
        a.1.value.unwrap_or(1.0).total_cmp(&b.1.value.unwrap_or(1.0))
    };
    let others = portrait.changes.get(1..).unwrap_or_default();
    if let Some((name, p)) = others.iter().filter(|(_, p)| p.value < rated.overturning.value).min_by(by_value)
    {
        tiles.push(tile(PERCENT.value(*p), format!("with what helps most of the changes compared: {name}")));
    }
    tiles
}

/// What the answer rests on.
pub fn facts(evaluation: &Evaluation, rated: &Rated) -> Vec<String> {
    let friction = rated.friction.map(|friction| {
        format!(
            "Friction: valid above {}; with less, it slides instead of rocking.",
            number::fixed(friction, 2)
        )
    });
    let building = rated.floor.as_ref().map(|_| "The building is taken as linear.".to_string());
    let model = Some(rated.model.as_str()).filter(|model| !model.is_empty());
    let model = model.map(|model| format!("Model: {}.", super::text::literal(model)));
    let limits = limits_in_words(&rated.sds);
    let hazard = Some(format!("Hazard: {}.", super::text::literal(&evaluation.hazard)));
    [friction, building, hazard, model, limits].into_iter().flatten().collect()
}

/// What the limits cover.
pub fn limits_in_words(sds: &[(Part, f64)]) -> Option<String> {
    let parts: Vec<&str> =
        sds.iter().filter(|(part, _)| *part != Part::Hazard).map(|(part, _)| part.words()).collect();
    let has_hazard = sds.iter().any(|(part, _)| *part == Part::Hazard);
    let (last, others) = parts.split_last()?;
    let joined = match others {
        [] => (*last).to_string(),
        _ => format!("{} and {last}", others.join(", ")),
    };
    let hazard = if has_hazard { "and in the hazard" } else { "but not in the hazard" };
    Some(format!("The 95 % limits cover uncertainty in {joined}, {hazard}."))
}

fn numbers(evaluation: &Evaluation, rated: &Rated) -> Table {
    let row = |name: String, p: Limited, rate: Limited| {
        vec![name, PERCENT.value(p), PERCENT.limits(p, ""), RATE.value(rate)]
    };
    let too_far =
        format!("rocks beyond {} of its slenderness, or overturns", PERCENT.one(evaluation.limit_state));
    let none = Limited::default();
    Table {
        columns: columns(&["", &evaluation.when, "95 % limits", "rate a year"]),
        rows: vec![
            row("rocks".to_string(), Limited::value(rated.rocking), none),
            row(too_far, rated.failure, none),
            row("overturns".to_string(), rated.overturning, rated.rate),
        ],
        ..Table::default()
    }
}

fn table_of_changes(evaluation: &Evaluation, portrait: &Portrait) -> Table {
    let row = |(name, p): &(String, Limited)| vec![name.clone(), PERCENT.value(*p), PERCENT.limits(*p, "")];
    Table {
        columns: columns(&[
            "What would change it",
            &format!("overturns {}", evaluation.when.clone()),
            "95 % limits",
        ]),
        rows: portrait.changes.iter().map(row).collect(),
        ..Table::default()
    }
}

/// The first column is of names, the others of numbers.
pub fn columns(heads: &[&str]) -> Vec<Column> {
    heads.iter().enumerate().map(|(at, head)| Column { head: head.to_string(), is_number: at > 0 }).collect()
}
