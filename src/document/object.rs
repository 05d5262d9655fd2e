//! The page of one object: to scale, its fragility, the hazard, what would change the answer, what is not
//! known.

use rockfrag_core::fragility::{LimitState, Peak};
use rockfrag_core::hazard::{Fragility, format_intensity};
use rockfrag_core::object::UncertaintySource;
use rockfrag_core::statistics::normal::Z_95;
use strum::VariantArray;

use super::answers::{Change, Evaluation, Outline, Portrait, Rated, SiteHazard, State};
use super::page::{Page, Table, Tile};
use super::probabilities::{self, ProbabilityRow};
use crate::chart::text::{literal, words};
use crate::chart::{Axis, Figure, Frame, Ink, LabelPosition, Layer, Mark, MarkStyle, Panel, Words};
use crate::number::{self, PERCENT, RATE};
use crate::table::answers::ObjectRow;

/// Height of the area of the data of a panel, points.
pub const HEIGHT: f64 = 150.0;
/// Return periods whose intensities are marked, years: those of the earthquakes that codes design for and
/// consider.
const USUAL_YEARS: [f64; 2] = [475.0, 2475.0];

/// The figure of an object: what there is of its panels.
pub fn figure(evaluation: &Evaluation, rated: &Rated) -> Figure {
    let Portrait { outline, fragility, hazard, changes } = &evaluation.portrait;
    let mut panels = Vec::new();
    panels.extend(outline.as_ref().map(|outline| sketch(outline, &rated.object)));
    panels.extend(fragility.as_ref().map(|curve| fragility_panel(curve, &rated.object, hazard.as_ref())));
    if changes.len() > 1 {
        panels.push(changes_panel(evaluation));
    }
    if let Some(hazard) = hazard {
        panels.push(hazard_panel(hazard));
        panels.extend(shares(hazard));
    }
    panels.extend(unknown(rated));
    Figure::new("object", &rated.object.marked_title(), 2, HEIGHT, panels)
}

/// The object as it stands, and as it is about to tip.
pub fn sketch(outline: &Outline, object: &ObjectRow) -> Panel {
    let Outline { width, height, centre_height, centre_offset, alpha_rad } = *outline;
    let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height), (0.0, 0.0)];
    let corners = corners.map(|(x, y)| Mark::new(x, y));
    // It tips over its nearer edge, which is drawn at the right.
    let edge = Mark::new(width, 0.0);
    let centre = Mark::new(0.5 * width + centre_offset.abs(), centre_height);
    let tipped = |mark: Mark| {
        let (sin, cos, away) = (alpha_rad.sin(), alpha_rad.cos(), mark.x - width);
        Mark::new(width + away * cos + mark.y * sin, mark.y * cos - away * sin)
    };
    let turned = corners.map(tipped);
    let room = 0.16 * height.max(width);
    let right = turned.iter().map(|corner| corner.x).fold(width, f64::max);
    let top = turned.iter().map(|corner| corner.y).fold(height, f64::max);
    let layers = vec![
        Layer::line("", Ink::Muted, [-2.0 * room, right + room].map(|x| Mark::new(x, 0.0))),
        Layer::line(
            "",
            Ink::Data(0),
            [0.0, width].map(|x| Mark { low: 0.0, high: height, ..Mark::new(x, height) }),
        ),
        Layer::line("", Ink::Text, corners),
        Layer::guide(Ink::Data(1), turned),
        Layer::guide(Ink::Data(1), [edge, tipped(centre)]),
        Layer::guide(Ink::Muted, [edge, centre]),
        Layer::points("", Ink::Data(1), [tipped(centre)]),
        Layer::points("", Ink::Text, [centre]),
    ];
    let [width_m, height_m] = [width, height].map(|side| format!("{} m", number::length(side)));
    let degrees = number::significant(alpha_rad.to_degrees(), 3);
    let caption = format!(
        "To scale, with its centre of mass, {}. It tips over its weaker side at {degrees}°.",
        literal(&object.place())
    );
    let x = Axis::linear("").over(-2.0 * room, right + 3.6 * room);
    let y = Axis::linear("").over(-1.1 * room, top + 0.3 * room);
    let words = vec![
        Words { x: 0.5 * width, y: 0.0, text: width_m, position: LabelPosition::Below, ink: Ink::Muted },
        Words { x: 0.0, y: 0.5 * height, text: height_m, position: LabelPosition::Left, ink: Ink::Muted },
        Words {
            x: turned[2].x,
            y: turned[2].y,
            text: format!("tips at {degrees}°"),
            position: LabelPosition::Right,
            ink: Ink::Data(1),
        },
    ];
    Panel { frame: Frame::ToScale, words, ..Panel::new("The object", x, y, layers).explained(caption) }
}

/// The curve of a limit state, in percent; with its limits if they are wanted.
pub fn curve(fragility: &Fragility, state: LimitState, has_limits: bool) -> Vec<Mark> {
    let (_, unit, _) = fragility.over.name_and_unit();
    let marks = fragility.points.iter().filter_map(|point| {
        let (x, p) = (point.intensity / unit, point.p.get(state).map(|p| 100.0 * p));
        Some(if has_limits { Mark::estimate(x, p.estimate()?) } else { Mark::new(x, p.value?) })
    });
    marks.collect()
}

fn peak_axis(peak: Peak) -> Axis {
    let (what, _, symbol) = peak.name_and_unit();
    Axis::log(&format!("{what} ({symbol})"))
}

/// The axes of fragility curves, and these.
pub fn curves_panel(over: Peak, layers: Vec<Layer>) -> Panel {
    Panel::new("", peak_axis(over), Axis::linear("probability, %").over(0.0, 101.0), layers)
}

/// The limit states of one object, with the usual intensities of a site.
pub fn fragility_panel(fragility: &Fragility, object: &ObjectRow, hazard: Option<&SiteHazard>) -> Panel {
    let too_far = format!("{}, or overturns", object.too_far().replace("its slenderness", "*α*"));
    let failure = curve(fragility, LimitState::Failure, false);
    let overturning = curve(fragility, LimitState::Overturning, true);
    let layers = vec![
        Layer::line(&too_far, Ink::Data(0), failure),
        Layer::line("overturns, with 95 % limits", Ink::Data(1), overturning),
    ];
    let mut panel = curves_panel(fragility.over, layers);
    panel.title = "Fragility".to_string();
    let hazard = hazard.filter(|hazard| hazard.peak == fragility.over);
    for Usual { intensity: x, years: period } in hazard.iter().flat_map(|hazard| hazard.usual()) {
        let words =
            Words { x, y: 100.0, text: years(period), position: LabelPosition::Along, ink: Ink::Muted };
        panel.add_upright(words, 0.0);
    }
    let (what, place) =
        (fragility.over.name_and_unit().0, if hazard.is_some() { " at the site" } else { "" });
    panel
        .explained(format!("Probability under a motion of this {what}{place}, {}.", averaged(fragility.over)))
}

/// Over what a fragility is averaged.
pub fn averaged(over: Peak) -> String {
    let other = if over == Peak::Pga { Peak::Pgv } else { Peak::Pga };
    format!("averaged over the {} of such motions", other.name_and_unit().0)
}

fn changes_panel(Evaluation { when, target, portrait, .. }: &Evaluation) -> Panel {
    let rows = portrait.changes.iter().enumerate().map(|(place, Change { words, p, .. })| {
        let ink = if place == 0 { Ink::Data(1) } else { Ink::Data(0) };
        ProbabilityRow::new(words, ink, "", p)
    });
    let rows: Vec<ProbabilityRow> = rows.collect();
    let caption = format!(
        "Probability of overturning {when} with 95 % limits, one thing changed at a time; restitution as a \
         test may find it (16 and 84 % quantiles). Anchored, it does not rock: for the forces see ASCE 7, \
         chapter 13, or EN 1998-1, 4.3.5."
    );
    probabilities::panel("What would change it", when, &rows, *target).explained(caption)
}

/// An intensity that comes once in so many years.
pub struct Usual {
    pub intensity: f64,
    pub years: f64,
}

impl SiteHazard {
    /// The intensities of usual return periods, as far as the curve has them, in the unit of the label.
    pub fn usual(&self) -> impl Iterator<Item = Usual> {
        let [(_, often), (_, rarely)] = self.curve.ends();
        let known = USUAL_YEARS.into_iter().filter(move |years| rarely < 1.0 / years && 1.0 / years <= often);
        known.map(|years| {
            let intensity = self.curve.intensity(1.0 / years) / self.peak.name_and_unit().1;
            Usual { intensity, years }
        })
    }
}

/// How rare an intensity is: `475 years`.
fn years(years: f64) -> String {
    format!("{} years", number::count(years as usize))
}

fn hazard_panel(hazard: &SiteHazard) -> Panel {
    let (what, unit, symbol) = hazard.peak.name_and_unit();
    let [_, (_, lowest)] = hazard.curve.ends();
    let mut panel =
        Panel::new("Hazard", peak_axis(hazard.peak), Axis::log("exceeded, times a year"), Vec::new());
    let (mut words, mut dots) = (Vec::new(), Vec::new());
    for Usual { intensity, years: period } in hazard.usual() {
        let (text, y) = (years(period), 1.0 / period);
        words.push(format!("{} {symbol} once in {text}", number::significant(intensity, 2)));
        dots.push(Mark::new(intensity, y));
        panel.add_upright(
            Words { x: intensity, y, text, position: LabelPosition::Along, ink: Ink::Muted },
            lowest,
        );
    }
    let curve = hazard.curve.points().iter().map(|(intensity, rate)| Mark::new(intensity / unit, *rate));
    panel.layers.push(Layer::line("", Ink::Text, curve));
    panel.layers.push(Layer::points("", Ink::Text, dots));
    let caption = format!("How often {what} is exceeded at the site: {}.", words.join(", "));
    panel.explained(caption)
}

/// The share of the rate of overturning by intensity, as a density: an area of the same size is the same
/// share.
fn shares(hazard: &SiteHazard) -> Option<Panel> {
    let (what, unit, _) = hazard.peak.name_and_unit();
    let parts = &hazard.parts;
    let all = parts.rates.iter().sum::<f64>() + parts.beyond;
    let mut outline = Vec::new();
    for (edge, rate) in parts.edges.windows(2).zip(&parts.rates) {
        let y = 100.0 * rate / all / (edge[1] / edge[0]).ln();
        outline.extend([edge[0], edge[1]].map(|x| Mark { low: 0.0, high: y, ..Mark::new(x / unit, y) }));
    }
    if outline.is_empty() || all <= 0.0 {
        return None;
    }
    let most = outline.iter().map(|mark| mark.y).fold(1e-9, f64::max);
    let beyond = match parts.beyond / all {
        share if share >= 0.0005 => format!(" {} lies beyond the hazard curve.", PERCENT.one(share)),
        _ => String::new(),
    };
    let caption = format!(
        "Which motions overturn it: its rate of overturning by {what}; the whole area is 100 %.{beyond}"
    );
    let y = Axis::linear(&format!("% of the rate per unit of ln {what}")).over(0.0, 1.08 * most);
    let layers = vec![Layer::line("", Ink::Data(1), outline)];
    Some(Panel::new("Where the rate comes from", peak_axis(hazard.peak), y, layers).explained(caption))
}

/// What is not known, by how far it moves the rate.
fn unknown(rated: &Rated) -> Option<Panel> {
    let mut parts = rated.doubts.source_sds();
    parts.sort_by(|a, b| b.1.total_cmp(&a.1));
    let most = (Z_95 * parts.first()?.1).exp();
    let what = if rated.row.overturning_per_year.value.is_some() { "rate" } else { "odds" };
    let x = Axis::log(&format!("factor on the {what}, either way")).over(1.0, 1.1 * most);
    let names = Axis::names(parts.iter().map(|(part, _)| what_to_measure(*part).to_string()));
    let (mut marks, mut words) = (Vec::new(), Vec::new());
    for (row, (_, sd)) in parts.iter().enumerate() {
        let (x, y) = ((Z_95 * sd).exp(), row as f64);
        marks.push(Mark { low: 1.0, high: x, ..Mark::new(x, y) });
        let text = format!("× {}", number::significant(x, 2));
        words.push(Words { x, y, text, position: LabelPosition::Margin, ink: Ink::Text });
    }
    let layers = vec![Layer::new("", Ink::Data(0), MarkStyle::Estimates, marks)];
    let caption = format!(
        "What is not known, and what would narrow it: how far each may raise or lower the {what} of \
         overturning (95 % limits)."
    );
    Some(Panel { words, ..Panel::new("What is not known", x, names, layers).explained(caption) })
}

/// What is not known, and what to measure.
fn what_to_measure(part: UncertaintySource) -> &'static str {
    match part {
        UncertaintySource::Fit => "fragility: records of the site",
        UncertaintySource::Magnitude => "magnitude: disaggregation",
        UncertaintySource::Velocity => "PGV: its hazard curve",
        UncertaintySource::Eta => "restitution: a rocking test",
        UncertaintySource::Object => "centre of mass: weigh it",
        UncertaintySource::Floor => "building: measure its period",
        UncertaintySource::Hazard => "hazard: its fractiles",
    }
}

/// The page of one object.
pub fn page(evaluation: &Evaluation, rated: &Rated) -> Page {
    let (object, hazard) = (&rated.object, literal(&evaluation.hazard));
    let place = if object.is_upstairs() { object.floor_after("") } else { object.place() };
    let answer = format!("It {}.", rated.sentence(&evaluation.when));
    let target = evaluation.target.map(|target| rated.about_target(target));
    Page {
        title: words(&object.marked_title()),
        place: format!("Stands {}; {hazard}", literal(&place)),
        sentence: [Some(answer), target].into_iter().flatten().collect::<Vec<_>>().join(" "),
        tiles: tiles(evaluation),
        facts: sliding(object).into_iter().chain(facts(&[rated])).collect(),
        notes: rated.doubts.warnings.iter().map(|doubts| literal(doubts)).collect(),
        tables: vec![numbers(evaluation, rated)],
        figures: vec![figure(evaluation, rated)],
        ..Page::default()
    }
}

/// The object as it is; the change that helps most, nothing that is only measured; another floor; and the
/// motion that overturns it.
fn tiles(Evaluation { when, portrait, .. }: &Evaluation) -> Vec<Tile> {
    let mut tiles = Vec::new();
    if let [as_it_is, others @ ..] = &portrait.changes[..] {
        let objects = others.iter().filter(|change| change.p.len() == 1);
        let best = objects.min_by(|a, b| a.probability().total_cmp(&b.probability()));
        let best = best.filter(|best| best.probability() < as_it_is.probability());
        let moved = others.iter().find(|change| change.is_moved && best.is_none_or(|best| !best.is_moved));
        let more = [format!(", {when}"), ", which helps most".to_string(), String::new()];
        for (change, more) in [Some(as_it_is), best, moved].into_iter().zip(more) {
            let Some(Change { words, p, .. }) = change else { continue };
            let limits = PERCENT.limits(p[0], "95 % limits ");
            tiles.push(Tile::new(PERCENT.value(p[0]), format!("overturns: {words}{more} {limits}")));
        }
    }
    if let Some(fragility) = &portrait.fragility {
        let hazard = portrait.hazard.as_ref();
        let site = hazard.and_then(|hazard| Some((hazard.peak, hazard.usual().next()?)));
        let site = site.map_or(String::new(), |(peak, Usual { intensity, years: period })| {
            let (intensity, symbol) = (number::significant(intensity, 2), peak.name_and_unit().2);
            format!("; {intensity} {symbol} comes once in {}", years(period))
        });
        let words =
            format!("{} at which half of the motions overturn it{site}", fragility.over.name_and_unit().0);
        tiles.push(Tile::new(format_intensity(fragility.over, fragility.overturning.theta.value), words));
    }
    tiles
}

/// What is so if it slides.
fn sliding(object: &ObjectRow) -> Option<String> {
    let friction = object.friction.filter(|_| !object.is_friction_known)?;
    Some(format!("Below a friction of {} it slides instead of rocking.", number::fixed(friction, 2)))
}

/// What the answer rests on.
pub fn facts(all: &[&Rated]) -> Vec<String> {
    let mut upstairs = all.iter().map(|rated| &rated.object).filter(|object| object.is_upstairs());
    let building = upstairs.clone().next().map(|_| {
        let percent = upstairs.any(|object| object.floor.is_none());
        let percent = if percent { "; 60 % up is at 60 % of its height" } else { "" };
        format!("The building is taken as linear{percent}.")
    });
    let model = all.first().and_then(|worst| model_in_words(&worst.object));
    let facts = [Some(ANGLES.to_string()), building, model, limits_in_words(all)];
    facts.into_iter().flatten().collect()
}

/// What two words mean.
pub const ANGLES: &str = "Slenderness (*α*): the angle at which an object tips. Restitution (*η*): its \
                          angular velocity after an impact over that before.";

/// What predicts.
pub fn model_in_words(object: &ObjectRow) -> Option<String> {
    object.model.as_ref().map(|model| format!("Model: {}.", literal(model)))
}

/// What the limits cover.
pub fn limits_in_words(all: &[&Rated]) -> Option<String> {
    let unknown: Vec<(UncertaintySource, f64)> =
        all.iter().flat_map(|rated| rated.doubts.source_sds()).collect();
    let parts =
        UncertaintySource::VARIANTS.iter().filter(|part| unknown.iter().any(|(other, _)| other == *part));
    let parts: Vec<&str> = parts.map(|part| part.description()).collect();
    let joined = match parts.split_last()? {
        (only, []) => (*only).to_string(),
        (last, others) => format!("{} and {last}", others.join(", ")),
    };
    Some(format!("The 95 % limits cover uncertainty in {joined} only.").replace("eta", "restitution"))
}

/// The answer, and what it is with one thing changed; under one motion there are no rates.
fn numbers(evaluation: &Evaluation, rated: &Rated) -> Table {
    let states = rated.states().into_iter().map(|State { name, p, per_year }| {
        let rate = rated.row.years.map_or(String::new(), |_| RATE.value(per_year));
        vec![name, PERCENT.value(p), PERCENT.span(p), rate]
    });
    let changes = evaluation.portrait.changes.iter().skip(1).map(|Change { words, p, .. }| {
        let values: Vec<String> = p.iter().map(|p| PERCENT.value(*p)).collect();
        let limits: Vec<String> = p.iter().map(|p| PERCENT.span(*p)).collect();
        vec![format!("overturns: {words}"), values.join(", "), limits.join(", ")]
    });
    Table::new(&["", &evaluation.when, "95 % limits", "rate a year"], states.chain(changes).collect())
}
