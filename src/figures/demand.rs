//! Figures 3, 4, 7, 8 and 9: outcomes and demand over velocity and period of the pulse; the demand over the
//! measures of Eq. 13; its planes.

use std::f64::consts::TAU;

use nalgebra::Vector3;
use rockfrag_core::fragility::{
    Case, Cases, CurveFit, DemandFit, DemandModel, Group, Measure, PLANE, ln_median_demand,
};
use rockfrag_core::motion::Suite;
use rockfrag_core::rocking::Outcome;
use rockfrag_core::statistics::scores::sample_quantile;
use rockfrag_core::statistics::{Interval, Range};

use super::common::{DEMAND, Fits, compare, demands, estimate, label, name, short_label, short_labels};
use crate::chart::text::file_words;
use crate::chart::{Axis, Figure, Ink, LabelPosition, Layer, Mark, MarkStyle, Panel, Symbol, Words};
use crate::number::{self, PERCENT};
use crate::table::rows::by;

/// The least demand of Figures 3 and 4: what is below hardly rocks.
const LEAST: f64 = 1e-3;
/// Where structures stand that do not rock and that overturn, and the words above them: so many times the
/// least demand, and the largest or 1.
const STRIPS: [[f64; 2]; 2] = [[0.18, 0.4], [2.0, 4.4]];
/// The column of the velocity of the pulse.
pub const VP: &str = "vp_m_s";
const PERIOD: &str = "*T*_{p} (s)";

/// The velocity of the pulse of a motion, m/s, with its label; where only the whole motion is known, its PGV.
fn velocity(cases: &Cases, row: usize) -> (f64, &'static str) {
    let unit_m_s = cases.structure.uplift_acceleration_m_s2() / cases.structure.p_rad_s;
    let pulses = cases.columns.get(VP).map(|vp| (unit_m_s * vp[row], "*V*_{p} (m/s)"));
    pulses.unwrap_or((cases.all[row].peaks.pgv_m_s, "PGV (m/s)"))
}

/// The period of the pulse, s.
fn period(cases: &Cases, row: usize) -> Option<f64> {
    Some(TAU / (cases.all[row].measures.im1? * cases.structure.p_rad_s))
}

/// Figures 3 and 4: outcomes over velocity and period of the pulses, with Eq. 5; the demand over each.
pub fn demand(groups: &[&Cases]) -> Figure {
    let is_pulse = |cases: &&&Cases| cases.suite.as_deref() == Some(Suite::Pulse.into());
    // PGA Tp / Vp of the pulses.
    let ratios = groups.iter().filter(is_pulse).flat_map(|cases| {
        let ratio = |row: usize| cases.all[row].peaks.pga_m_s2 / velocity(cases, row).0;
        (0..cases.all.len()).filter_map(move |row| Some(ratio(row) * period(cases, row)?))
    });
    let ratios: Vec<f64> = ratios.collect();
    let quantile = |share| sample_quantile(ratios.clone(), share).unwrap_or(f64::NAN);
    let [low, value, high] = [0.05, 0.5, 0.95].map(quantile);
    let c = Interval { value, low, high };
    let pulses = groups.iter().filter(|cases| cases.all.iter().any(|case| case.measures.im1.is_some()));
    let planes = pulses.clone().map(|cases| outcomes(cases, c));
    let of_velocity =
        |cases: &&Cases| demand_over(cases, velocity(cases, 0).1, |row| Some(velocity(cases, row).0));
    let over_period = pulses.clone().map(|cases| demand_over(cases, PERIOD, |row| period(cases, row)));
    let panels: Vec<Panel> = planes.chain(groups.iter().map(of_velocity)).chain(over_period).collect();
    let mut caption = format!(
        "Outcomes over velocity and period of the pulse, and demand over each, from {LEAST} on; in strips \
         below and above, motions that do not rock the structure and that overturn it."
    );
    if value > 0.0 {
        let [value, low, high] = [value, low, high].map(|c| number::significant(c, 2));
        caption += &format!(
            " Line: Eq. 5 for the pulse alone, *V*_{{p}} = *g* tan *α* *T*_{{p}} / *c* with the median *c* = \
             {value} of PGA *T*_{{p}} / *V*_{{p}}; band: 90 % of the pulses, {low} to {high}."
        );
    }
    let columns = groups.len().clamp(2, 3);
    Figure::new("demand", "Rocking over velocity and period of the pulse", columns, 120.0, panels)
        .explained(compare(&caption, "Figures 3 and 4"))
}

/// Layers of what does not rock, rocks and is safe, and overturns, each with the places of its motions.
fn marked(cases: &Cases, place: impl Fn(usize) -> Option<Mark>) -> Vec<Layer> {
    let layer = |name: &str, ink, symbol, is_of: fn(Outcome) -> bool| {
        let rows = (0..cases.all.len()).filter(|row| is_of(cases.all[*row].outcome));
        Layer::points(name, ink, symbol, rows.filter_map(&place))
    };
    vec![
        layer("does not rock", Ink::Muted, Symbol::Cross, |one| one == Outcome::NoRocking),
        layer("rocks, safe", Ink::Data(0), Symbol::Circle, |one| matches!(one, Outcome::SafeRocking(_))),
        layer("overturns", Ink::Data(1), Symbol::Disc, |one| one == Outcome::Overturned),
    ]
}

/// Velocity over period, and the line of Eq. 5 with `c` = PGA Tp / Vp; without pulses it is not known.
fn outcomes(cases: &Cases, c: Interval) -> Panel {
    let mut layers = marked(cases, |row| Some(Mark::new(period(cases, row)?, velocity(cases, row).0)));
    let marks = layers.iter().flat_map(|layer| &layer.marks);
    let over = |value: fn(&Mark) -> f64| Range::over(marks.clone().map(value));
    let (periods, velocities) = (over(|mark| mark.x), over(|mark| mark.y));
    let [rest, safe, fallen] = [0, 1, 2].map(|layer| number::count(layers[layer].marks.len()));
    let mut caption =
        format!("{rest} motions do not rock the structure, {safe} rock it, {fallen} overturn it.");
    let limit = |period_s: f64, c: f64| cases.structure.uplift_acceleration_m_s2() * period_s / c;
    if c.value > 0.0 {
        let at_rest = |is_below: bool| {
            let side = |mark: &&Mark| (mark.y < limit(mark.x, c.value)) == is_below;
            let rest = layers[0].marks.iter().filter(side).count();
            PERCENT.one(rest as f64 / marks.clone().filter(side).count() as f64)
        };
        let [below, above] = [true, false].map(at_rest);
        caption += &format!(" Of those below the line {below} do not rock it, of those above {above}.");
        let limits = |x| Interval { value: limit(x, c.value), low: limit(x, c.high), high: limit(x, c.low) };
        let line = [periods.low, periods.high].map(|x| estimate(x, limits(x)));
        layers.push(Layer::line("Eq. 5 for the pulse alone, 90 % of pulses", Ink::Text, line));
    }
    let y = Axis::log(velocity(cases, 0).1).over(0.9 * velocities.low, 1.1 * velocities.high);
    Panel::new(&name(cases), Axis::log(PERIOD), y, layers).explained(caption)
}

fn demand_over(cases: &Cases, x: &str, value: impl Fn(usize) -> Option<f64>) -> Panel {
    let most = demands(cases).map(|(_, edp)| edp).fold(1.0, f64::max);
    let [[rest, rest_words], [fallen, fallen_words]] = STRIPS;
    let (symbol, _) = x.split_once(" (").unwrap_or((x, ""));
    let edp = |row: usize| match cases.all[row].outcome {
        Outcome::NoRocking => Some(rest * LEAST),
        Outcome::SafeRocking(edp) => Some(edp).filter(|edp| *edp >= LEAST),
        Outcome::Overturned => Some(fallen * most),
    };
    let layers = marked(cases, |row| Some(Mark::new(value(row)?, edp(row)?)));
    let ends = |layer: &Layer| Range::over(layer.marks.iter().map(|mark| mark.x));
    let [first, last] = [ends(&layers[0]).low, ends(&layers[2]).high];
    let words = [
        (&layers[0], first, rest_words * LEAST, LabelPosition::Right),
        (&layers[2], last, fallen_words * most, LabelPosition::Left),
    ];
    let words = words.into_iter().filter(|(layer, ..)| !layer.marks.is_empty());
    let words = words.map(|(layer, x, y, position)| {
        let (text, ink) = (layer.name.clone(), layer.ink);
        Words { x, y, text, position, ink }
    });
    let (words, title) = (words.collect(), format!("{}, over {}", name(cases), symbol));
    let y = Axis::log(DEMAND).over(0.11 * LEAST, 1.5 * fallen_words * most);
    Panel { words, ..Panel::new(&title, Axis::log(x), y, layers) }
}

/// The modified dispersion |zeta| = beta / |b|.
fn zeta(fit: &DemandFit) -> Option<f64> {
    Some(fit.beta? / fit.coefficients[1].abs())
}

/// Figure 7: the demand in safe rocking over each measure, with its regression (Eq. 16) if there is one.
pub fn regressions(fits: &Fits, cases: &Cases) -> Figure {
    let laws = fits.demand(cases, DemandModel::Univariate);
    let laws: Vec<&DemandFit> = laws.filter(|fit| Measure::SCALAR.contains(&fit.im_x)).collect();
    let mut panels = Vec::new();
    for measure in Measure::SCALAR.into_iter().filter(|_| !laws.is_empty()) {
        let value = |case: &Case| measure.value_of(&case.measures);
        let safe = demands(cases).filter_map(|(case, edp)| Some(Mark::new(value(case)?, edp)));
        let layers = vec![Layer::points("safe rocking", Ink::Data(0), Symbol::Dot, safe)];
        let (x, y) = (Axis::log(label(&measure)), Axis::log(DEMAND));
        let mut panel = Panel::new(&short_label(&measure), x, y, layers);
        let Range { low, high } = Range::over(demands(cases).filter_map(|(case, _)| value(case)));
        if let Some(fit) = laws.iter().find(|fit| fit.im_x == measure && low < high) {
            let line = [low, high].map(|im| Mark::new(im, ln_median_demand(&fit.coefficients, &[im]).exp()));
            panel.layers.push(Layer::line("regression", Ink::Data(1), line));
            let floor = [low, high].map(|im| Mark::new(im, fits.rotation_floor / cases.structure.alpha_rad));
            panel.layers.push(Layer::guide("floor", Ink::Muted, floor));
            let [r2, beta, zeta] = [fit.r2, fit.beta, zeta(fit)];
            let [r2, beta] = [r2, beta].map(|value| number::fixed(value.unwrap_or(f64::NAN), 2));
            let zeta = number::significant(zeta.unwrap_or(f64::NAN), 3);
            panel.title += &format!("\u{2003}*R*^{{2}} {r2}\u{2002}*β* {beta}\u{2002}|*ζ*| {zeta}");
        }
        panels.push(panel);
    }
    let group = name(cases);
    let caption = format!(
        "Demand in safe rocking with ln EDP = ln *a* + *b* ln IM; *β* is the dispersion, *ζ* = *β*/*b*. {}",
        of_floor(fits)
    );
    let suite = cases.suite.as_deref().unwrap_or_default();
    let file = format!("regressions-{}", file_words(&format!("{} {suite}", cases.structure.name)));
    Figure::new(&file, &format!("Demand over one measure: {group}"), 3, 90.0, panels)
        .explained(compare(&caption, "Figure 7"))
}

fn of_floor(fits: &Fits) -> String {
    let floor = number::significant(fits.rotation_floor, 1);
    format!("Rotations are {floor} rad or more (thin line), as in the fits.")
}

/// Figure 8: R2, beta and zeta of the regressions, and how well curves of overturning predict held-out cases.
pub fn quality(fits: &Fits, groups: &[&Cases]) -> Figure {
    let laws = fits.demand.iter().filter(|fit| fit.r2.is_some());
    let rows = |value: fn(&DemandFit) -> Option<f64>| -> Vec<Quality> {
        laws.clone().map(|fit| (fit.group(), row(fit), value(fit))).collect()
    };
    let from_zero = |value: fn(&DemandFit) -> Option<f64>, label: &str| {
        let most = laws.clone().filter_map(value).fold(0.0, f64::max);
        dots(rows(value), Axis::linear(label).over(-0.03 * most, 1.08 * most), groups)
    };
    let scored = |fit| (CurveFit::group(fit), short_labels(&fit.predictors()), fit.held_out_log_score);
    let scores = Axis::linear("log score of overturning on held-out cases (more is better)");
    let panels = [
        from_zero(|fit| fit.r2, "*R*^{2} (more is better)"),
        from_zero(|fit| fit.beta, "*β* (less is better)"),
        dots(rows(zeta), Axis::log("|*ζ*| = *β* / |*b*| (less is better)"), groups),
        dots(fits.curves.iter().map(scored).collect(), scores, groups),
    ];
    let caption = "Regressions of the demand and lognormal curves of overturning; without a dot, no fit. Of \
                   two measures, *b* is that of IM4; of two planes, *R*^{2} is about the own side's mean.";
    let panels = panels.into_iter().flatten().collect();
    Figure::new("quality", "Quality of the measures", 2, 0.0, panels).explained(compare(caption, "Figure 8"))
}

fn row(fit: &DemandFit) -> String {
    match (fit.range_low, fit.range_high) {
        (None, None) => short_labels(&fit.predictors()),
        (None, Some(_)) => "two planes, below".to_string(),
        _ => "two planes, above".to_string(),
    }
}

/// The number of a fit, of which group, and the row in which it stands.
type Quality<'a> = (Group<'a>, String, Option<f64>);

/// A panel with a dot for each group in its rows; none without a dot.
fn dots(all: Vec<Quality>, x: Axis, groups: &[&Cases]) -> Option<Panel> {
    let rows = by(&all, |(_, row, _)| row);
    let mut layers = Vec::new();
    for (number, cases) in groups.iter().enumerate() {
        let marks = rows.iter().zip(0_i32..).filter_map(|(row, place)| {
            let (_, _, value) = row.iter().find(|(group, _, _)| *group == cases.group())?;
            Some(Mark::new((*value)?, f64::from(place)))
        });
        layers.push(Layer::new(&name(cases), Ink::Data(number), MarkStyle::Estimates, marks));
    }
    layers.retain(|layer| !layer.marks.is_empty());
    let names = rows.iter().map(|row| row[0].1.clone());
    (!layers.is_empty()).then(|| Panel::new("", x, Axis::names(names), layers))
}

/// Figure 9: the demand and its two planes (Eqs. 17 and 18), seen along the line in which they meet.
pub fn planes(fits: &Fits, groups: &[&Cases]) -> Figure {
    let mut panels = Vec::new();
    for cases in groups {
        let planes: Vec<&DemandFit> = fits.demand(cases, DemandModel::Biplanar).collect();
        let [low, high] = planes[..] else { continue };
        let coefficients = [low, high].map(|fit| Vector3::from_column_slice(&fit.coefficients));
        panels.extend(high.range_low.map(|transition| planes_panel(fits, cases, transition, coefficients)));
    }
    let caption = format!(
        "Demand in safe rocking over ln IM4 and ln IM3 with its two planes (Table II), seen along the line \
         in which they meet. {} The line is at the median IM3.",
        of_floor(fits)
    );
    Figure::new("planes", "The two planes, seen edge-on", 2, 110.0, panels)
        .explained(compare(&caption, "Figure 9"))
}

/// The planes below the transition and from there on are ln a, b1 and b2 over ln IM4 and ln IM3.
fn planes_panel(fits: &Fits, cases: &Cases, transition: f64, planes: [Vector3<f64>; 2]) -> Panel {
    let floor = fits.rotation_floor / cases.structure.alpha_rad;
    let [right, up] = edge_on(planes);
    let view = |point: Vector3<f64>| Mark::new(right.dot(&point), up.dot(&point));
    let by_x = |a: &Mark, b: &Mark| a.x.total_cmp(&b.x);
    // ln IM4, ln IM3 and ln EDP of the cases that have them.
    let points = demands(cases).filter_map(|(case, edp)| {
        let [im4, im3] = PLANE.map(|measure| measure.value_of(&case.measures));
        Some(Vector3::new(im4?.ln(), im3?.ln(), edp.ln()))
    });
    let points: Vec<Vector3<f64>> = points.collect();
    let im3 = sample_quantile(points.iter().map(|case| case.y).collect(), 0.5).unwrap_or_default();
    let ends = [0.0, points.iter().map(|case| case.x).fold(0.0, f64::max)];
    let floor = ends.map(|im4| view(Vector3::new(im4, im3, floor.ln())));
    let (below, above): (Vec<_>, Vec<_>) = points.into_iter().partition(|case| case.x < transition.ln());
    let sides = [("below the transition", Ink::Data(2), below), ("above it", Ink::Data(0), above)];
    let (mut layers, mut lines) = (Vec::new(), Vec::new());
    for ((label, ink, its), plane) in sides.into_iter().zip(planes) {
        let [ln_a, b1, b2] = plane.into();
        let on_plane = |case: &Vector3<f64>| Vector3::new(case.x, case.y, ln_a + b1 * case.x + b2 * case.y);
        let line = its.iter().map(|case| view(on_plane(case)));
        let ends = line.clone().min_by(by_x).into_iter().chain(line.max_by(by_x));
        lines.push(Layer::line("planes", Ink::Text, ends));
        layers.push(Layer::points(label, ink, Symbol::Dot, its.into_iter().map(view)));
    }
    layers.extend(lines);
    layers.extend((fits.rotation_floor > 0.0).then(|| Layer::guide("floor", Ink::Muted, floor)));
    let [x, y] = [right, up].map(|direction| Axis::linear(&sum(direction)));
    Panel::new(&name(cases), x, y, layers)
}

/// To the right and upwards in a view along the line where the planes meet; of parallel ones along ln IM3.
fn edge_on(planes: [Vector3<f64>; 2]) -> [Vector3<f64>; 2] {
    let [first, second] = planes.map(|plane| Vector3::new(plane.y, plane.z, -1.0));
    let along = unit(first.cross(&second));
    let right = unit(along.cross(&Vector3::z()));
    let right = if right.x < 0.0 { -right } else { right };
    let up = right.cross(&along);
    [right, if up.z < 0.0 { -up } else { up }]
}

fn unit(vector: Vector3<f64>) -> Vector3<f64> {
    vector.try_normalize(1e-12).unwrap_or(Vector3::y())
}

/// Writes a direction as a sum without small terms: `0.85 ln IM4 − 0.52 ln IM3`.
fn sum(direction: Vector3<f64>) -> String {
    let mut terms = Vec::new();
    for (part, name) in direction.iter().zip(["ln IM4", "ln IM3", "ln EDP"]) {
        let sign = if *part < 0.0 { "\u{2212}" } else { "" };
        terms.extend(match part.abs() {
            size if size > 0.995 => Some(format!("{sign}{name}")),
            size if size >= 0.03 => Some(format!("{sign}{} {name}", number::fixed(size, 2))),
            _ => None,
        });
    }
    terms.join(" + ").replace("+ \u{2212}", "\u{2212} ")
}
