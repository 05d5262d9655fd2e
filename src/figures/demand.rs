//! Figures 3, 4, 7, 8 and 9: the demand over peak velocity, period and the measures of Eq. 13; its planes.

use std::f64::consts::TAU;

use nalgebra::Vector3;
use rockfrag_core::fragility::{
    Case, Cases, DemandFit, DemandModel, Group, Measure, PLANE, Predictors, ln_median_demand,
};
use rockfrag_core::statistics::Range;

use super::common::{DEMAND, Fits, by, compare, demands, label, name, rocked, short_label};
use crate::chart::text::file_words;
use crate::chart::{Axis, Figure, Ink, Layer, Mark, MarkStyle, Panel};
use crate::number;

/// The least demand of Figures 3 and 4: what is below hardly rocks.
const LEAST: f64 = 1e-3;
/// Where overturned structures stand: so many times the largest demand, or 1.
const TOP: f64 = 2.0;
/// Largest zeta of Figure 8, over the least: what lies beyond predicts nothing.
const MOST_ZETA: f64 = 5.0;

/// The demand in safe rocking of some cases over a value of theirs.
fn panel(title: &str, x: &str, cases: &Cases, value: &dyn Fn(&Case) -> Option<f64>) -> Panel {
    let safe = demands(cases).filter_map(|(case, edp)| Some(Mark::new(value(case)?, edp)));
    let layers = vec![Layer::points("safe rocking", Ink::Data(0), safe)];
    Panel::new(title, Axis::log(x), Axis::log(DEMAND), layers)
}

/// Figures 3 and 4: the demand over peak velocity and pulse period, one row of panels a group.
pub fn demand(groups: &[&Cases]) -> Figure {
    let mut panels = Vec::new();
    for cases in groups {
        let top = TOP * demands(cases).map(|(_, edp)| edp).fold(1.0, f64::max);
        let mut draw = |label: &str, value: &dyn Fn(&Case) -> Option<f64>| {
            let mut panel = panel(&name(cases), label, cases, value);
            let fallen = rocked(cases).filter(|(_, overturned)| *overturned);
            let fallen = fallen.filter_map(|(case, _)| Some(Mark::new(value(case)?, top)));
            panel.layers.push(Layer::points("overturning, at the top", Ink::Data(1), fallen));
            panel.y = panel.y.over(LEAST, 1.3 * top);
            panels.push(panel);
        };
        draw("PGV (m/s)", &|case| Some(case.peaks.pgv_m_s));
        draw("*T*_{p} (s)", &|case| Some(TAU / (case.measures.im1? * cases.structure.p_rad_s)));
    }
    let caption = format!(
        "Each point is a motion in which the structure rocks. The right-hand panels omit motions \
         without a pulse period; demands below {LEAST} are not drawn."
    );
    Figure::new("demand", "Demand over peak velocity and pulse period", 2, 105.0, panels)
        .explained(compare(&caption, "Figures 3 and 4"))
}

/// The modified dispersion beta / b; none where the demand falls with the measure.
fn zeta(fit: &DemandFit) -> Option<f64> {
    let b = fit.coefficients[1];
    Some(fit.beta? / b).filter(|_| b > 0.0)
}

/// Figure 7: the demand in safe rocking over each measure, with its regression, ln EDP = ln a + b ln IM
/// (Eq. 16), if there is one; nothing without any regression.
pub fn regressions(fits: &Fits, cases: &Cases) -> Figure {
    let laws = fits.demand(cases, DemandModel::Univariate);
    let laws: Vec<&DemandFit> = laws.filter(|fit| Measure::SCALAR.contains(&fit.im_x)).collect();
    let mut panels = Vec::new();
    for measure in Measure::SCALAR.into_iter().filter(|_| !laws.is_empty()) {
        let value = |case: &Case| measure.value_of(&case.measures);
        let mut panel = panel(&short_label(&measure), label(&measure), cases, &value);
        let Range { low, high } = Range::over(demands(cases).filter_map(|(case, _)| value(case)));
        if let Some(fit) = laws.iter().find(|fit| fit.im_x == measure && low < high) {
            let line = [low, high].map(|im| Mark::new(im, ln_median_demand(&fit.coefficients, &[im]).exp()));
            panel.layers.push(Layer::line("regression", Ink::Data(1), line));
            let zeta = zeta(fit).map_or("none".to_string(), |zeta| number::significant(zeta, 3));
            let [r2, beta] = [fit.r2, fit.beta].map(|value| number::fixed(value.unwrap_or(f64::NAN), 2));
            panel.title += &format!("\u{2003}*R*^{{2}} {r2}\u{2002}*β* {beta}\u{2002}*ζ* {zeta}");
        }
        panels.push(panel);
    }
    let group = name(cases);
    let caption = "Demand in safe rocking over each measure of Eq. 13, with ln EDP = ln *a* + *b* ln IM. *β* \
                   is the dispersion and *ζ* = *β*/*b*, which a falling regression does not have.";
    let file = format!("regressions-{}", file_words(&group));
    Figure::new(&file, &format!("Demand over one measure: {group}"), 3, 90.0, panels)
        .explained(compare(caption, "Figure 7"))
}

/// Figure 8: R2, beta and zeta of the regressions of each group over all cases, and how well its curves of
/// overturning predict held-out cases.
pub fn quality(fits: &Fits, groups: &[&Cases]) -> Figure {
    let laws = fits.demand.iter().filter(|fit| fit.model != DemandModel::Biplanar && fit.r2.is_some());
    let panel = |value: fn(&DemandFit) -> Option<f64>, label: &str| {
        let range = Range::over(laws.clone().filter_map(value));
        let most = 1.08 * range.high.min(MOST_ZETA * range.low.max(0.2));
        let all = laws.clone().map(|fit| (fit.group(), fit.predictors(), value(fit)));
        dots(all.collect(), Axis::linear(label).over(0.0, most), groups)
    };
    let scores = fits.curves.iter().map(|fit| (fit.group(), fit.predictors(), fit.held_out_log_score));
    let score = Axis::linear("log score of overturning on held-out cases (more is better)");
    let panels = [
        panel(|fit| fit.r2, "*R*^{2} (more is better)"),
        panel(|fit| fit.beta, "*β* (less is better)"),
        panel(zeta, "*ζ* = *β* / *b* (less is better)"),
        dots(scores.collect(), score, groups),
    ];
    let caption = "Of the regressions of the demand over all cases, and of the lognormal curves of \
                   overturning. A measure without a dot has no such number, or one far to the right.";
    let figure =
        Figure::new("quality", "Quality of the measures", 2, 0.0, panels.into_iter().flatten().collect());
    figure.explained(compare(caption, "Figure 8"))
}

/// The number of a fit, of which group, and its measures.
type Quality<'a> = (Group<'a>, Predictors, Option<f64>);

/// A panel with a row for each set of measures and a dot for each group; none without a dot.
fn dots(all: Vec<Quality>, x: Axis, groups: &[&Cases]) -> Option<Panel> {
    let rows = by(&all, |(_, predictors, _)| predictors);
    let names = rows.iter().map(|row| row[0].1.measures().map(short_label).collect::<Vec<_>>().join(", "));
    let mut layers = Vec::new();
    for (number, cases) in groups.iter().enumerate() {
        let apart = (number as f64 - 0.5 * (groups.len() as f64 - 1.0)) * 0.6 / groups.len() as f64;
        let marks = rows.iter().zip(0_i32..).filter_map(|(row, place)| {
            let (_, _, value) = row.iter().find(|(group, _, _)| *group == cases.group())?;
            Some(Mark::new((*value)?, f64::from(place) + apart))
        });
        layers.push(Layer::new(&name(cases), Ink::Data(number), MarkStyle::Estimates, marks));
    }
    layers.retain(|layer| !layer.marks.is_empty());
    (!layers.is_empty()).then(|| Panel::new("", x, Axis::names(names), layers))
}

/// Figure 9: the demand in safe rocking and its two planes (Eqs. 17 and 18, Table II), seen along the line in
/// which they meet; one panel a group.
pub fn planes(fits: &Fits, groups: &[&Cases]) -> Figure {
    let mut panels = Vec::new();
    for cases in groups {
        let planes: Vec<&DemandFit> = fits.demand(cases, DemandModel::Biplanar).collect();
        let [low, high] = planes[..] else { continue };
        let coefficients = [low, high].map(|fit| Vector3::from_column_slice(&fit.coefficients));
        panels.extend(high.range_low.map(|transition| planes_panel(cases, transition, coefficients)));
    }
    let caption = "Demand in safe rocking in the space of ln IM4, ln IM3 and ln EDP, seen along the line in \
                   which the planes meet.";
    let caption =
        compare(caption, "Figure 9") + " There, velocity and period stand in place of the two measures.";
    Figure::new("planes", "The two planes, seen edge-on", 2, 110.0, panels).explained(caption)
}

/// The planes below the transition and from there on are ln a, b1 and b2 over ln IM4 and ln IM3.
fn planes_panel(cases: &Cases, transition: f64, planes: [Vector3<f64>; 2]) -> Panel {
    let [right, up] = edge_on(planes);
    let view = |point: Vector3<f64>| Mark::new(right.dot(&point), up.dot(&point));
    let by_x = |a: &Mark, b: &Mark| a.x.total_cmp(&b.x);
    // ln IM4, ln IM3 and ln EDP of the cases that have them.
    let points = demands(cases).filter_map(|(case, edp)| {
        let [im4, im3] = PLANE.map(|measure| measure.value_of(&case.measures));
        Some(Vector3::new(im4?.ln(), im3?.ln(), edp.ln()))
    });
    let (below, above): (Vec<_>, Vec<_>) = points.partition(|case| case.x < transition.ln());
    let sides = [("below the transition", Ink::Data(2), below), ("above it", Ink::Data(0), above)];
    let (mut layers, mut lines) = (Vec::new(), Vec::new());
    for ((label, ink, its), plane) in sides.into_iter().zip(planes) {
        let [ln_a, b1, b2] = plane.into();
        let on_plane = |case: &Vector3<f64>| Vector3::new(case.x, case.y, ln_a + b1 * case.x + b2 * case.y);
        let line = its.iter().map(|case| view(on_plane(case)));
        let ends = line.clone().min_by(by_x).into_iter().chain(line.max_by(by_x));
        lines.push(Layer::line("planes", Ink::Text, ends));
        layers.push(Layer::points(label, ink, its.into_iter().map(view)));
    }
    layers.extend(lines);
    let [x, y] = [right, up].map(|direction| Axis::linear(&sum(direction)));
    Panel::new(&name(cases), x, y, layers)
}

/// Returns the directions to the right and upwards in a view along the line in which the planes meet; of
/// parallel planes, which meet nowhere, along ln IM3.
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
