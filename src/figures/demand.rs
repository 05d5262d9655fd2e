//! Figures 3, 4, 7, 8 and 9: outcomes and demand over velocity and period of the pulse; the demand over the
//! measures of Eq. 13; its planes.

use std::f64::consts::TAU;
use std::slice;

use rockfrag_core::fragility::{
    Case, Cases, CurveFit, DemandFit, DemandModel, Group, PLANE, ln_median_demand,
};
use rockfrag_core::motion::Suite;
use rockfrag_core::rocking::Outcome;
use rockfrag_core::statistics::scores::sample_quantile;
use rockfrag_core::statistics::{Interval, Range};

use super::common::{DEMAND, Fits, Row, compare, label, name, rows_panel, short_label, short_labels};
use crate::chart::text::file_words;
use crate::chart::{Axis, Figure, Ink, Layer, Mark, Panel, Symbol};
use crate::number;
use crate::table::rows::by;

/// The least demand of Figures 3 and 4: what is below hardly rocks.
const LEAST: f64 = 1e-3;
/// Where structures stand that do not rock and that overturn: so many times the least demand, and the largest
/// or 1.
const STRIPS: [f64; 2] = [0.18, 2.0];
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
    let c = sample_quantile(ratios.collect(), 0.5);
    let pulses = groups.iter().filter(|cases| cases.all.iter().any(|case| case.measures.im1.is_some()));
    let planes = pulses.clone().map(|cases| outcomes(cases, c));
    let of_velocity =
        |cases: &&Cases| demand_over(cases, velocity(cases, 0).1, |row| Some(velocity(cases, row).0));
    let over_period = pulses.clone().map(|cases| demand_over(cases, PERIOD, |row| period(cases, row)));
    let panels: Vec<Panel> = planes.chain(groups.iter().map(of_velocity)).chain(over_period).collect();
    let caption = format!(
        "Outcomes over velocity and period of the pulse, with Eq. 5 for the pulse alone, *V*_{{p}} = *g* \
         tan *α* *T*_{{p}} / *c* with the median *c* of PGA *T*_{{p}} / *V*_{{p}}; demand over each, from \
         {LEAST} on, and in strips below and above, motions that do not rock the structure and that overturn \
         it."
    );
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
fn outcomes(cases: &Cases, c: Option<f64>) -> Panel {
    let mut layers = marked(cases, |row| Some(Mark::new(period(cases, row)?, velocity(cases, row).0)));
    let velocities = Range::over(layers.iter().flat_map(|layer| &layer.marks).map(|mark| mark.y));
    let [rest, safe, fallen] = [0, 1, 2].map(|layer| number::count(layers[layer].marks.len()));
    let caption = format!("{rest} motions do not rock the structure, {safe} rock it, {fallen} overturn it.");
    layers.extend(c.map(|c| {
        let period_s = |velocity_m_s| c * velocity_m_s / cases.structure.uplift_acceleration_m_s2();
        let line = [velocities.low, velocities.high].map(|velocity| Mark::new(period_s(velocity), velocity));
        Layer::line("Eq. 5 for the pulse alone", Ink::Text, line)
    }));
    let y = Axis::log(velocity(cases, 0).1);
    Panel::new(&name(cases), Axis::log(PERIOD), y, layers).explained(caption)
}

fn demand_over(cases: &Cases, x: &str, value: impl Fn(usize) -> Option<f64>) -> Panel {
    let most = cases.all.iter().filter_map(|case| case.outcome.demand()).fold(1.0, f64::max);
    let edp = |row: usize| match cases.all[row].outcome {
        Outcome::NoRocking => Some(STRIPS[0] * LEAST),
        Outcome::SafeRocking(edp) => Some(edp).filter(|edp| *edp >= LEAST),
        Outcome::Overturned => Some(STRIPS[1] * most),
    };
    let layers = marked(cases, |row| Some(Mark::new(value(row)?, edp(row)?)));
    Panel::new(&name(cases), Axis::log(x), Axis::log(DEMAND), layers)
}

/// The modified dispersion |zeta| = beta / |b|.
fn zeta(fit: &DemandFit) -> Option<f64> {
    Some(fit.beta? / fit.coefficients[1].abs())
}

/// Figure 7: the demand in safe rocking over each measure that has a regression (Eq. 16).
pub fn regressions(fits: &Fits, cases: &Cases) -> Figure {
    let panels = fits.demand(cases, DemandModel::Univariate).map(|fit| regression(fit, cases)).collect();
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

fn regression(fit: &DemandFit, cases: &Cases) -> Panel {
    let sample = cases.sample(slice::from_ref(&fit.im_x), Case::ln_demand);
    let safe = sample.ln_im[0].iter().zip(&sample.y).map(|(im, edp)| Mark::new(im.exp(), edp.exp()));
    let line = law(fit, |im| Mark::new(im, ln_median_demand(&fit.coefficients, &[im]).exp()));
    let layers = vec![
        Layer::points("safe rocking", Ink::Data(0), Symbol::Dot, safe),
        Layer::line("regression", Ink::Data(1), line),
    ];
    let [r2, beta] = [fit.r2, fit.beta].map(|value| number::fixed(value.unwrap_or(f64::NAN), 2));
    let (im, zeta) = (short_label(&fit.im_x), number::significant(zeta(fit).unwrap_or(f64::NAN), 3));
    let title = format!("{im}\u{2003}*R*^{{2}} {r2}\u{2002}*β* {beta}\u{2002}|*ζ*| {zeta}");
    Panel::new(&title, Axis::log(label(&fit.im_x)), Axis::log(DEMAND), layers)
}

/// The marks of a law at the least and the largest value of its measure.
fn law(fit: &DemandFit, mark: impl Fn(f64) -> Mark) -> impl Iterator<Item = Mark> {
    [fit.ranges.im_x.low, fit.ranges.im_x.high].into_iter().flatten().map(mark)
}

fn of_floor(fits: &Fits) -> String {
    let floor = number::significant(fits.rotation_floor, 1);
    format!("Rotations are {floor} rad or more, as in the fits.")
}

/// Figure 8: R2, beta and zeta of the regressions, and how well curves of overturning predict held-out cases.
pub fn quality(fits: &Fits, groups: &[&Cases]) -> Figure {
    let regressions = |value: fn(&DemandFit) -> Option<f64>, x| {
        dots(fits.demand.iter().map(|fit| (fit.group(), row(fit), value(fit))), x, groups)
    };
    let scored = |fit| (CurveFit::group(fit), short_labels(&fit.predictors()), fit.held_out_log_score);
    let scores = Axis::linear("log score of overturning on held-out cases (more is better)");
    let panels = vec![
        regressions(|fit| fit.r2, Axis::linear("*R*^{2} (more is better)")),
        regressions(|fit| fit.beta, Axis::linear("*β* (less is better)")),
        regressions(zeta, Axis::log("|*ζ*| = *β* / |*b*| (less is better)")),
        dots(fits.curves.iter().map(scored), scores, groups),
    ];
    let caption = "Regressions of the demand and lognormal curves of overturning; without a dot, no fit. Of \
                   two measures, *b* is that of IM4; of two planes, *R*^{2} is about the own side's mean.";
    Figure::new("quality", "Quality of the measures", 2, 0.0, panels).explained(compare(caption, "Figure 8"))
}

fn row(fit: &DemandFit) -> String {
    match (fit.range_low, fit.range_high) {
        (None, None) => short_labels(&fit.predictors()),
        (None, Some(_)) => "two planes, below".to_string(),
        _ => "two planes, above".to_string(),
    }
}

/// A panel with a dot for each group in its rows; a number is that of a fit, of which group and row.
fn dots<'a>(
    numbers: impl Iterator<Item = (Group<'a>, String, Option<f64>)>,
    x: Axis,
    groups: &[&Cases],
) -> Panel {
    let numbers: Vec<_> = numbers.collect();
    let rows = by(&numbers, |(_, row, _)| row).into_iter().map(|its| {
        let values = its.iter().filter_map(|(group, _, value)| {
            let number = groups.iter().position(|cases| cases.group() == *group)?;
            let value = Interval { value: Some((*value)?), low: None, high: None };
            Some((value, Ink::Data(number), name(groups[number])))
        });
        Row { name: its[0].1.clone(), values: values.collect(), words: String::new() }
    });
    rows_panel("", x, rows.collect())
}

/// Figure 9: the demand and its two planes (Eqs. 17 and 18), seen along the line in which they meet.
pub fn planes(fits: &Fits, groups: &[&Cases]) -> Figure {
    let panels = groups.iter().filter_map(|cases| {
        let planes: Vec<&DemandFit> = fits.demand(cases, DemandModel::Biplanar).collect();
        planes_panel(cases, planes.try_into().ok()?)
    });
    let caption = format!(
        "Demand in safe rocking over IM4 with its two planes (Table II) at the median IM3, to which each \
         motion is moved along the line in which they meet. {}",
        of_floor(fits)
    );
    Figure::new("planes", "The two planes, seen edge-on", 2, 110.0, panels.collect())
        .explained(compare(&caption, "Figure 9"))
}

/// The panel of the planes below the transition and from there on.
fn planes_panel(cases: &Cases, planes: [&DemandFit; 2]) -> Option<Panel> {
    let sample = cases.sample(&PLANE, Case::ln_demand);
    let median = sample_quantile(sample.ln_im[1].clone(), 0.5)?;
    // By how much ln IM4 and ln EDP rise with ln IM3 along the line in which the planes meet.
    let [below, above] = planes.map(|fit| &fit.coefficients);
    let right = (above[2] - below[2]) / (below[1] - above[1]);
    let right = if right.is_finite() { right } else { 0.0 };
    let up = below[1] * right + below[2];
    let (mut layers, mut lines) = (Vec::new(), Vec::new());
    let sides = [("below the transition", Ink::Data(2)), ("above it", Ink::Data(0))];
    for (fit, (label, ink)) in planes.into_iter().zip(sides) {
        let rows = (0..sample.y.len()).filter(|row| fit.holds_at(sample.ln_im[0][*row].exp()));
        let points = rows.map(|row| {
            let off = sample.ln_im[1][row] - median;
            Mark::new(sample.ln_im[0][row] - right * off, sample.y[row] - up * off)
        });
        layers.push(Layer::points(label, ink, Symbol::Dot, points));
        let line =
            law(fit, |im4| Mark::new(im4.ln(), ln_median_demand(&fit.coefficients, &[im4, median.exp()])));
        lines.push(Layer::line("planes", Ink::Text, line));
    }
    layers.extend(lines);
    Some(Panel::new(&name(cases), Axis::linear("ln IM4"), Axis::linear("ln EDP"), layers))
}
