//! Answers: an object to scale, its fragility, the hazard, what would change it, what is not known of it; and
//! lists of objects.

use rockfrag_core::fragility::{LimitState, Peak};
use rockfrag_core::hazard::FragilityPoint;
use rockfrag_core::statistics::Interval;
use rockfrag_core::statistics::normal::Z_95;

use super::common::{Row, estimate, rows_panel};
use crate::answer::{Answer, AtSite, ObjectColumns};
use crate::chart::text::literal;
use crate::chart::{Axis, Figure, Ink, LabelPosition, Layer, Mark, Panel, Symbol, Words};
use crate::document::phrases::of_source;
use crate::number::{self, PERCENT, count, counted, significant};

/// Height of the area of the data of a panel, points.
const HEIGHT: f64 = 150.0;
/// The most objects of a list, and the most curves in one panel.
const ROWS: usize = 60;
const CURVES: usize = 6;

/// The figure of an object: what there is of its panels.
pub fn object(answer: &Answer, variants: &[Answer], drawn: Option<&AtSite>) -> Figure {
    let mut panels: Vec<Panel> = sketch(&answer.object).into_iter().collect();
    let fragility = drawn.and_then(|drawn| drawn.fragility.as_ref());
    panels.extend(fragility.map(|curve| fragility_panel(curve.over, &curve.points, answer, drawn)));
    panels.extend((variants.len() > 1).then(|| variants_panel(variants, answer)));
    panels.extend(drawn.into_iter().flat_map(|drawn| [hazard_panel(drawn), shares(drawn)]));
    panels.push(unknown(answer));
    Figure::new("object", &answer.object.title(), 2, HEIGHT, panels)
}

/// The fragility of one object with all its limit states, or overturning of several, the weakest first: a
/// panel for each peak.
pub fn fragilities(answers: &[&Answer]) -> Figure {
    let over_pga: Vec<&Answer> = answers.iter().filter_map(|answer| answer.over_pga.as_deref()).collect();
    let peaks = [answers, &over_pga].into_iter();
    let (title, panels) = match answers {
        [answer] => {
            let curve = |one: &&Answer| Some(fragility_panel(one.fragility.over?, &one.points, one, None));
            let panels = sketch(&answer.object).into_iter().chain(peaks.flatten().filter_map(curve));
            (answer.object.title(), panels.collect())
        }
        _ => {
            ("How strong a motion overturns each object".to_string(), peaks.filter_map(overturning).collect())
        }
    };
    Figure::new("fragility", &title, 2, HEIGHT, panels)
}

/// Overturning of several objects over one peak.
fn overturning(answers: &[&Answer]) -> Option<Panel> {
    let over = answers.iter().find_map(|answer| answer.fragility.over)?;
    let layer = |(number, answer): (usize, &&Answer)| {
        let marks = curve(over, &answer.points, LimitState::Overturning, answers.len() < 3);
        Layer::line(&answer.object.called(), Ink::Data(number), marks)
    };
    let layers: Vec<Layer> = answers.iter().take(CURVES).enumerate().map(layer).collect();
    let (drawn, all) = (layers.len(), counted(answers.len(), "object"));
    Some(curves_panel(over, layers, &format!(": {drawn} of {all}")))
}

/// How likely each object of a list overturns, the worst first.
pub fn list(answers: &[&Answer], when: &str, target: Option<f64>) -> Figure {
    let answers: Vec<&&Answer> = answers.iter().filter(|answer| answer.is_answered()).collect();
    let drawn = &answers[..answers.len().min(ROWS)];
    let rows = drawn.iter().map(|answer| {
        let p = answer.p.p_overturning;
        let (values, words) = match (&answer.alternatives[..], &answer.before) {
            ([], None) => (vec![(p, Ink::Data(0), String::new())], PERCENT.value(p)),
            ([], Some(before)) => (
                vec![(before.p, Ink::Muted, "before".to_string()), (p, Ink::Data(1), "after".to_string())],
                before.ratio.value.map_or(String::new(), |times| format!("× {}", significant(times, 2))),
            ),
            (others, _) => {
                let value =
                    |(at, one): (usize, &Answer)| (one.p.p_overturning, Ink::Data(at), literal(&one.file));
                (others.iter().enumerate().map(value).collect(), String::new())
            }
        };
        Row { name: answer.object.called(), values, words }
    });
    let rows: Vec<Row> = rows.collect();
    let others = answers.len() - rows.len();
    let others = if others > 0 { format!("; {others} further rows are in the table") } else { String::new() };
    let caption = format!("Probability of overturning {when} with 95 % limits{others}.");
    let is_compared = drawn.iter().any(|answer| answer.before.is_some());
    let what = if is_compared { "changed object" } else { "object" };
    let title = &format!("How likely each {what} is to overturn");
    Figure::new("list", title, 1, 0.0, vec![probabilities("", rows, target)]).explained(caption)
}

/// The object as it stands over the side to which it falls first, and as it is about to tip.
fn sketch(object: &ObjectColumns) -> Option<Panel> {
    let (width, height, alpha_rad) = (object.width_m?, object.height_m?, object.alpha_rad?);
    let centre_height = object.centre_height_m.unwrap_or(0.5 * height);
    let arm = centre_height * alpha_rad.tan();
    let width = object.depth_m.filter(|depth| (0.5 * depth - arm).abs() < 1e-9 * depth).unwrap_or(width);
    let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height), (0.0, 0.0)];
    let corners = corners.map(|(x, y)| Mark::new(x, y));
    // It tips over its nearer edge, which is drawn at the right.
    let edge = Mark::new(width, 0.0);
    let centre = Mark::new(width - arm, centre_height);
    let tipped = |mark: Mark| {
        let (sin, cos, away) = (alpha_rad.sin(), alpha_rad.cos(), mark.x - width);
        Mark::new(width + away * cos + mark.y * sin, mark.y * cos - away * sin)
    };
    let turned = corners.map(tipped);
    let room = 0.16 * height.max(width);
    let (right, top) = (turned[2].x, height.max(turned[3].y));
    let ground = [-2.0 * room, right + room].map(|x| Mark::new(x, 0.0));
    let body = [0.0, width].map(|x| Mark { low: 0.0, high: height, ..Mark::new(x, height) });
    let layers = vec![
        Layer::line("ground", Ink::Muted, ground).unlisted(),
        Layer::line("body", Ink::Data(0), body).unlisted(),
        Layer::line("outline", Ink::Text, corners).unlisted(),
        Layer::guide("outline as it tips", Ink::Data(1), turned),
        Layer::guide("edge to centre as it tips", Ink::Data(1), [edge, tipped(centre)]),
        Layer::guide("edge to centre", Ink::Muted, [edge, centre]),
        Layer::points("centre of mass as it tips", Ink::Data(1), Symbol::Disc, [tipped(centre)]).unlisted(),
        Layer::points("centre of mass", Ink::Text, Symbol::Disc, [centre]).unlisted(),
    ];
    let [width_m, height_m] = [width, height].map(|side| format!("{} m", number::length(side)));
    let degrees = significant(alpha_rad.to_degrees(), 3);
    let x = Axis::linear("").over(-2.0 * room, right + 3.6 * room);
    let y = Axis::linear("").over(-1.1 * room, top + 0.3 * room);
    let words = [
        (0.5 * width, 0.0, width_m, LabelPosition::Below, Ink::Muted),
        (0.0, 0.5 * height, height_m, LabelPosition::Left, Ink::Muted),
        (turned[2].x, turned[2].y, format!("tips at {degrees}°"), LabelPosition::Right, Ink::Data(1)),
    ];
    let words = words.map(|(x, y, text, position, ink)| Words { x, y, text, position, ink }).into();
    let panel = Panel { is_to_scale: true, words, ..Panel::new("The object", x, y, layers) };
    Some(panel.explained(format!("To scale, {}; it tips over its weaker side.", object.place())))
}

/// The curve of a limit state, in percent, from where it can be seen; with its limits if they are wanted.
fn curve(over: Peak, points: &[FragilityPoint], state: LimitState, has_limits: bool) -> Vec<Mark> {
    let (_, unit, _) = over.name_and_unit();
    let marks = points.iter().filter(|point| point.p.get(state).value > Some(1e-3)).filter_map(|point| {
        let (x, p) = (point.intensity / unit, point.p.get(state).map(|p| 100.0 * p));
        Some(if has_limits { estimate(x, p.estimate()?) } else { Mark::new(x, p.value?) })
    });
    marks.collect()
}

fn peak_axis(peak: Peak) -> Axis {
    let (what, _, symbol) = peak.name_and_unit();
    Axis::log(&format!("{what} ({symbol})"))
}

/// Curves over a peak, averaged over the other; `which` says more of the motions or the curves.
fn curves_panel(over: Peak, layers: Vec<Layer>, which: &str) -> Panel {
    let other = if over == Peak::Pga { Peak::Pgv } else { Peak::Pga };
    let [what, averaged] = [over, other].map(|peak| peak.name_and_unit().0);
    let caption = format!(
        "Probability under a motion of this {what}, averaged over the {averaged} of such motions{which}."
    );
    let y = Axis::linear("probability, %").over(0.0, 101.0);
    Panel::new(&format!("Fragility over {what}"), peak_axis(over), y, layers).explained(caption)
}

/// The limit states of one object, with the usual intensities of a site.
fn fragility_panel(over: Peak, points: &[FragilityPoint], of: &Answer, drawn: Option<&AtSite>) -> Panel {
    let too_far = of.object.too_far().replace("its slenderness angle", "*α*");
    let [failure, overturning] = [(LimitState::Failure, false), (LimitState::Overturning, true)]
        .map(|(state, has_limits)| curve(over, points, state, has_limits));
    let layers = vec![
        Layer::line(&too_far, Ink::Data(0), failure),
        Layer::line("overturns, with 95 % limits", Ink::Data(1), overturning),
    ];
    let drawn = drawn.filter(|drawn| drawn.peak == over);
    let mut panel = curves_panel(over, layers, drawn.map_or("", |_| " at the site"));
    for (years, intensity) in drawn.iter().flat_map(|drawn| drawn.usual()) {
        panel.add_upright(intensity, [0.0, 100.0], in_years(years), LabelPosition::Along);
    }
    panel
}

fn in_years(years: f64) -> String {
    format!("{} years", count(years as usize))
}

fn variants_panel(variants: &[Answer], answer: &Answer) -> Panel {
    let rows = variants.iter().enumerate().map(|(place, Answer { variant, p, .. })| {
        let (ink, p) = (Ink::Data(usize::from(place == 0)), p.p_overturning);
        let name = variant.clone().unwrap_or_default();
        Row { name, values: vec![(p, ink, String::new())], words: PERCENT.value(p) }
    });
    let when = answer.when().unwrap_or_default();
    let caption = format!(
        "Probability of overturning {when} with 95 % limits, one thing changed at a time; restitution at its \
         16 and 84 % quantiles. Anchored, it does not rock."
    );
    probabilities("What would change it", rows.collect(), answer.rates.target).explained(caption)
}

fn hazard_panel(drawn: &AtSite) -> Panel {
    let (what, unit, _) = drawn.peak.name_and_unit();
    let [_, (_, lowest)] = drawn.curve.ends();
    let y = Axis::log("exceeded, times a year");
    let mut panel = Panel::new("Hazard", peak_axis(drawn.peak), y, Vec::new());
    for (years, intensity) in drawn.usual() {
        panel.add_upright(intensity, [lowest, 1.0 / years], in_years(years), LabelPosition::Along);
    }
    let curve = drawn.curve.points().iter().map(|(intensity, rate)| Mark::new(intensity / unit, *rate));
    panel.layers.push(Layer::line("hazard curve", Ink::Text, curve).unlisted());
    panel.explained(format!("How often {what} is exceeded at the site."))
}

/// The share of the rate of overturning by intensity, as a density.
fn shares(drawn: &AtSite) -> Panel {
    let (what, unit, _) = drawn.peak.name_and_unit();
    let parts = &drawn.parts;
    let all = parts.rates.iter().sum::<f64>() + parts.beyond;
    let mut outline = Vec::new();
    for (edge, rate) in parts.edges.windows(2).zip(&parts.rates).filter(|_| all > 0.0) {
        let y = 100.0 * rate / all / (edge[1] / edge[0]).ln();
        outline.extend([edge[0], edge[1]].map(|x| Mark { low: 0.0, high: y, ..Mark::new(x / unit, y) }));
    }
    let beyond = PERCENT.one(parts.beyond / all);
    let caption = format!("Rate of overturning by {what}; {beyond} of it lies beyond the hazard curve.");
    let y = Axis::linear(&format!("% of the rate per unit of ln {what}"));
    let layers = vec![Layer::line("", Ink::Data(1), outline)];
    Panel::new("Where the rate comes from", peak_axis(drawn.peak), y, layers).explained(caption)
}

/// What is not known, by how far it moves the rate.
fn unknown(answer: &Answer) -> Panel {
    let mut parts = answer.uncertainty.source_sds();
    parts.sort_by(|a, b| b.1.total_cmp(&a.1));
    let what = if answer.rates.overturning_per_year.value.is_some() { "rate" } else { "odds" };
    let rows = parts.into_iter().map(|(source, sd)| {
        let ([name, remedy], factor) = (of_source(source), (Z_95 * sd).exp());
        let value = Interval { value: factor, low: 1.0, high: factor }.into();
        let words = format!("× {}", significant(factor, 2));
        Row { name: format!("{name}: {remedy}"), values: vec![(value, Ink::Data(0), String::new())], words }
    });
    let caption = format!(
        "How far each may raise or lower the {what} of overturning (95 % limits), and what would narrow it."
    );
    let x = Axis::log(&format!("factor on the {what}, either way"));
    rows_panel("What is not known", x, rows.collect()).explained(caption)
}

/// Rows of probabilities in percent, with the target.
fn probabilities(title: &str, mut rows: Vec<Row>, target: Option<f64>) -> Panel {
    let ends = [rows.len() as f64 - 0.5, -0.5];
    for (p, ..) in rows.iter_mut().flat_map(|row| &mut row.values) {
        *p = p.map(|p| 100.0 * p);
    }
    let mut panel = rows_panel(title, Axis::log("probability of overturning, %"), rows);
    if let Some(target) = target {
        let text = format!("target {}", PERCENT.one(target));
        panel.add_upright(100.0 * target, ends, text, LabelPosition::Above);
    }
    panel
}
