//! The page of fragilities: the intensities of one peak at which half of the motions overturn each object.

use super::answers::{Outline, SiteHazard};
use super::figure::{Axis, Figure, Ink, Layer, Mark, Panel, Side, Span, Words};
use super::object::{HEIGHT, model_in_words, once_in, sketch};
use super::page::{Page, Table};
use super::text::{literal, words};
use crate::fragility::LimitState;
use crate::hazard::{Fragility, Lognormal, intensity_in_words};
use crate::number::{self, significant};
use crate::table::answers::{Answer, FragilityRow, ObjectRow};

/// The most objects whose curves are drawn in one panel, each in a colour.
const DRAWN: usize = 6;

/// The curve of a limit state, in percent; with its limits if they are wanted.
fn curve(fragility: &Fragility, state: LimitState, has_limits: bool) -> Vec<Mark> {
    let (_, unit, _) = fragility.over.words();
    let marks = fragility.points.iter().map(|point| {
        let (x, p) = (point.intensity / unit, point.p.get(state).map(|p| 100.0 * p));
        if has_limits { Mark::estimate(x, p) } else { Mark::new(x, p.value) }
    });
    marks.collect()
}

fn axes(fragility: &Fragility) -> (Axis, Axis) {
    let (what, unit, symbol) = fragility.over.words();
    let ends = fragility.points.first().zip(fragility.points.last());
    let x = Axis::log(&format!("{what} ({symbol})"));
    let x = ends.map_or(x.clone(), |(first, last)| x.over(first.intensity / unit, last.intensity / unit));
    (x, Axis::linear("probability, %").over(0.0, 101.0))
}

/// The limit states of one object, with the usual intensities of a site.
pub fn fragility_panel(fragility: &Fragility, object: &ObjectRow, hazard: Option<&SiteHazard>) -> Panel {
    let too_far = object.too_far().replace("its slenderness", "*α*");
    let layers = vec![
        Layer::line("rocks", Ink::Muted, curve(fragility, LimitState::Rocking, false)),
        Layer::line(
            &format!("{too_far}, or overturns"),
            Ink::Data(0),
            curve(fragility, LimitState::Failure, false),
        ),
        Layer::line(
            "overturns, with 95 % limits",
            Ink::Data(1),
            curve(fragility, LimitState::Overturning, true),
        ),
    ];
    let (x, y) = axes(fragility);
    let ends = x.range;
    let (what, _, _) = fragility.over.words();
    let mut panel = Panel::new("Fragility", x, y, layers);
    for usual in
        hazard.filter(|hazard| hazard.peak == fragility.over).iter().flat_map(|hazard| hazard.usual())
    {
        let (x, text) = (usual.intensity, once_in(usual.years));
        if ends.is_some_and(|ends| ends.low <= x && x <= ends.high) {
            panel.add_upright(Words { x, y: 100.0, text, side: Side::Along, ink: Ink::Muted }, 0.0);
        }
    }
    let place = if hazard.is_some() { " at the site" } else { "" };
    panel.explained(format!(
        "Probability under a motion of this {what}{place}, averaged over what such motions have besides. One in two: \
         {}.",
        intensity_in_words(fragility.over, fragility.overturning.theta.value)
    ))
}

/// The fragility of one object with all its limit states, or overturning of several.
pub fn figure(all: &[Answer<FragilityRow>], outline: Option<Outline>) -> Figure {
    let known: Vec<(&ObjectRow, &Fragility)> =
        all.iter().filter_map(|one| Some((&one.object, one.row.curve.as_ref()?))).collect();
    match known[..] {
        [] => Figure::default(),
        [(object, curve)] => {
            let sketch = outline.map(|outline| sketch(&outline, object));
            let panels = sketch.into_iter().chain([fragility_panel(curve, object, None)]).collect();
            Figure::new("fragility", &object.marked_title(), 2, HEIGHT, panels)
        }
        [(_, first), ..] => {
            let mut layers = Vec::new();
            for (number, (object, fragility)) in known.iter().take(DRAWN).enumerate() {
                let marks = curve(fragility, LimitState::Overturning, known.len() < 3);
                layers.push(Layer::line(&object.marked_name(), Ink::Data(number), marks));
            }
            let ends = layers.iter().flat_map(|layer| &layer.marks).map(|mark| mark.x);
            let ends = Span::from_values(ends);
            let (x, y) = axes(first);
            let what = first.over.words().0;
            let rest = match known.len().saturating_sub(DRAWN) {
                0 => String::new(),
                rest => format!(" Not drawn: {} that need more.", number::counted(rest, "object")),
            };
            let caption = format!(
                "Probability of overturning under a motion of this {what}, averaged over what such motions have \
                 besides.{rest}"
            );
            let panel = Panel::new("", x.over(ends.low, ends.high), y, layers);
            Figure::new("fragility", "How strong a motion overturns each object", 1, HEIGHT, vec![panel])
                .explained(caption)
        }
    }
}

/// The page of fragilities, those that need least first; at a site, with its hazard in words.
pub fn page(all: &[Answer<FragilityRow>], outline: Option<Outline>, hazard: Option<&str>) -> Page {
    let known = all.iter().find_map(|one| Some((&one.object, one.row.curve.as_ref()?)));
    let Some((weakest, fragility)) = known else { return Page::default() };
    let what = fragility.over.words().0;
    let half = intensity_in_words(fragility.over, fragility.overturning.theta.value);
    let of = if fragility.overturning.theta.value.is_some() { "of " } else { "" };
    let (title, name) = match all {
        [one] => (words(&one.object.marked_title()), "it".to_string()),
        _ => (
            format!("{}: how strong a motion overturns them", number::counted(all.len(), "object")),
            weakest.marked_name(),
        ),
    };
    let mut notes = Vec::new();
    for one in all {
        let name = one.object.marked_name();
        notes.extend(one.doubts.warnings.as_ref().map(|doubts| format!("{name}: {}", literal(doubts))));
    }
    Page {
        title,
        place: match hazard {
            Some(hazard) => format!("Fragility over {what}; hazard: {}", literal(hazard)),
            None => format!("Fragility over {what}, of sites in general"),
        },
        sentence: format!("Half of the motions overturn {name} at a {what} {of}{half}."),
        facts: model_in_words(weakest).into_iter().collect(),
        table: Some(table(all, what)),
        notes,
        figures: vec![figure(all, outline)],
        ..Page::default()
    }
}

fn table(all: &[Answer<FragilityRow>], what: &str) -> Table {
    let half = format!("half overturn at a {what} of");
    let heads = ["object", &half, "95 % limits", "16 %", "84 %", "beta", "half rock too far, or overturn at"];
    let mut rows = Vec::new();
    for one in all {
        let mut row = vec![one.object.marked_name()];
        match &one.row.curve {
            None => row.push("no answer".to_string()),
            Some(Fragility { over, overturning, failure, .. }) => {
                let Lognormal { theta, at_16, at_84, beta, .. } = overturning;
                let limits = match theta.low {
                    None => String::new(),
                    low => format!(
                        "{} to {}",
                        intensity_in_words(*over, low),
                        intensity_in_words(*over, theta.high)
                    ),
                };
                row.extend([intensity_in_words(*over, theta.value), limits]);
                row.extend([at_16, at_84].map(|at| intensity_in_words(*over, at.value)));
                row.push(beta.map_or(String::new(), |beta| significant(beta, 2)));
                row.push(intensity_in_words(*over, failure.theta.value));
            }
        }
        row.resize(heads.len(), String::new());
        rows.push(row);
    }
    Table::new(&heads, rows)
}
