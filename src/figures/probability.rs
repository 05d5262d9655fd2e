//! Figures 10, 11 and 12: probabilities over a measure, with the observed shares; and maps of overturning
//! over PGA and PGV.

use rockfrag_core::fragility::{Calibration, CurveFit, DemandFit, DemandModel, beta, lambda, mu};
use rockfrag_core::fragility::{Cases, Event, Measure, MotionKind, Predictors, Tau};
use rockfrag_core::motion::{IntensityMeasures, Peaks};
use rockfrag_core::statistics::numerics::{bisect_first_true, equal_ratios};
use rockfrag_core::statistics::scores::sample_quantile;
use rockfrag_core::statistics::{FitStatus, Interval, Range};
use rockfrag_core::units::G_M_S2;

use super::common::{Fits, called, compare, demands, estimate, label, name};
use super::common::{motions_of, observed_shares, order, ratio_bins, rocked, short_label, short_labels};
use crate::chart::text::minus;
use crate::chart::{Axis, Dash, Figure, Ink, LabelPosition, Layer, Mark, MarkStyle, Panel, Symbol, Words};
use crate::number;
use crate::table::rows::by;

/// Number of points of a curve; the most bins of observed shares, and cases for each on average.
const STEPS: usize = 120;
const BINS: usize = 14;
const CASES: usize = 8;
/// Quantiles of IM3 at which P_ex is drawn.
const SHARES: [(f64, Dash); 3] = [(0.1, Dash::Solid), (0.5, Dash::Long), (0.9, Dash::Short)];
const CONFIDENCE: f64 = 0.95;
/// The probabilities of which a map has lines.
const LEVELS: [(f64, Dash); 4] =
    [(0.02, Dash::Short), (0.1, Dash::Mixed), (0.5, Dash::Solid), (0.9, Dash::Long)];

/// Figure 10: probability of exceeding the limit state in safe rocking; a panel a group.
pub fn exceedance(fits: &Fits, groups: &[&Cases]) -> Figure {
    let panels = groups.iter().map(|cases| {
        // Structures of one suite have curves at the same IM3.
        let of_suite = groups.iter().filter(|other| other.suite == cases.suite);
        let im3 = of_suite.flat_map(|cases| demands(cases)).filter_map(|(case, _)| case.measures.im3);
        exceeding(fits, cases, &im3.collect::<Vec<f64>>())
    });
    let panels = panels.filter(|panel| !panel.layers.is_empty());
    let caption = format!(
        "Probability that |*θ*|_{{max}} exceeds {} *α* in safe rocking, by the two planes at quantiles of IM3, \
         with a gap at the transition (thin line), and by IM4 alone if it has a curve; bands: 95 %.",
        number::plain(fits.limit_state)
    );
    let title = "Exceeding the limit state in safe rocking";
    Figure::new("exceedance", title, 2, 118.0, panels.collect()).explained(compare(&caption, "Figure 10"))
}

/// P_ex by the planes at quantiles of IM3, and by IM4 alone.
fn exceeding(fits: &Fits, cases: &Cases, im3: &[f64]) -> Panel {
    let (x, y) = (Axis::log(label(&Measure::Im4)), Axis::fraction("*P*_{ex}"));
    let mut panel = Panel::new(&name(cases), x, y, Vec::new());
    let planes: Vec<&DemandFit> = fits.demand(cases, DemandModel::Biplanar).collect();
    let highest = demands(cases).map(|(case, _)| case.measures.im4).fold(1.5, f64::max);
    let p = |fit: &DemandFit, im4: f64, im3: f64| {
        let measures = IntensityMeasures::from_peaks(im4, im4 / im3);
        fit.p_exceeding(&measures, fits.limit_state, CONFIDENCE)
    };
    let transition = planes.last().and_then(|plane| plane.range_low);
    for (number, (share, dash)) in SHARES.into_iter().enumerate() {
        let Some((im3, from)) = sample_quantile(im3.to_vec(), share).zip(transition) else { continue };
        let p = |im4: f64| p(planes.iter().find(|fit| fit.holds_at(im4))?, im4, im3);
        let before = from * (1.0 - 1e-9);
        let below = equal_ratios(1.0, before, STEPS);
        let im4 = below.chain([f64::NAN]).chain(equal_ratios(from, highest, STEPS));
        let words = format!("IM3 at its {} % quantile", number::plain(100.0 * share));
        panel.layers.push(curve(&words, Ink::Data(number), dash, im4, p));
        if let Some((below, above)) = p(before).zip(p(from)).filter(|_| share == 0.5) {
            let [below, above] = [below, above].map(|p| number::fixed(p.value, 3));
            let from = number::significant(from, 3);
            panel.caption = format!(
                "As IM4 passes {from}, from one plane to the other, *P*_{{ex}} at the median IM3 changes from \
                 {below} to {above}."
            );
        }
    }
    let upright = |im4: f64| Layer::guide("transition", Ink::Muted, [0.0, 1.0].map(|p| Mark::new(im4, p)));
    panel.layers.extend(transition.map(upright));
    let alone = fits.demand(cases, DemandModel::Univariate).find(|fit| fit.im_x == Measure::Im4);
    panel.layers.extend(alone.map(|fit| {
        curve("IM4 alone", Ink::Muted, Dash::Mixed, equal_ratios(1.0, highest, STEPS), |im4| p(fit, im4, 1.0))
    }));
    panel
}

/// A curve with its band, broken where it has no value.
fn curve(
    name: &str,
    ink: Ink,
    dash: Dash,
    x: impl Iterator<Item = f64>,
    p: impl Fn(f64) -> Option<Interval>,
) -> Layer {
    let marks = x.map(|x| p(x).map_or(Mark::new(f64::NAN, f64::NAN), |p| estimate(x, p)));
    Layer::new(name, ink, MarkStyle::Line(dash), marks)
}

const CURVES: &str = "*μ* = ln *θ*, *θ* the median, *β* the dispersion (where *P*_{ro} falls, of the inverse \
                      measure). Curves that fall with a measure of strength have the wrong sign and are not \
                      drawn. Dots: observed fractions. Bands and bars: 95 %.";

/// Figure 11: probability of overturning over single measures; a panel a structure and measure.
pub fn overturning(fits: &Fits, groups: &[&Cases]) -> Figure {
    let caption = format!("Lognormal curves over single measures (Eq. 20): {CURVES}");
    let panels = over(fits, groups, |predictors| predictors.im_y.is_none());
    Figure::new("overturning", "Overturning over single measures", 2, 100.0, panels)
        .explained(compare(&caption, "Figure 11"))
}

/// Figure 12: probability of overturning over hybrid measures (Eq. 23); a panel a structure, pair and suite.
pub fn hybrids(fits: &Fits, groups: &[&Cases]) -> Figure {
    let caption = format!(
        "Lognormal curves over hybrid measures, each with its *λ*: IM_{{x}}^{{*λ*/(1+*λ*)}} \
         IM_{{y}}^{{1/(1+*λ*)}} (Eqs. 23 and 24): {CURVES} As IM5 = IM4 / IM3, the hybrids of any two of \
         these three are one model."
    );
    let panels = over(fits, groups, |predictors| predictors.im_y.is_some());
    Figure::new("hybrid", "Overturning over hybrid measures", 2, 118.0, panels)
        .explained(compare(&caption, "Figure 12"))
}

/// P_ro over measures that are wanted, a panel for each structure and, as a hybrid is of one fit, its suites.
fn over(fits: &Fits, groups: &[&Cases], is_wanted: fn(&Predictors) -> bool) -> Vec<Panel> {
    let mut panels = Vec::new();
    for groups in by(groups.iter().copied(), |cases| &cases.structure.name) {
        // In the order in which they first come.
        let its = fits.curves.iter().filter(|fit| groups.iter().any(|cases| cases.group() == fit.group()));
        let measures = by(its, CurveFit::predictors).into_iter().map(|fits| fits[0].predictors());
        for predictors in measures.filter(is_wanted) {
            let each = if predictors.im_y.is_some() { 1 } else { groups.len() };
            panels.extend(groups.chunks(each).map(|part| over_measure(fits, part, &predictors)));
        }
    }
    panels
}

/// The curves of suites of a structure, with their parameters in the corner that the first leaves free.
fn over_measure(fits: &Fits, groups: &[&Cases], predictors: &Predictors) -> Panel {
    let first = fits.curve(groups[0], predictors);
    let (of, x) = match (first, &predictors.im_y) {
        (Some(fit), Some(_)) => (name(groups[0]), hybrid(fit)),
        _ => (called(&groups[0].structure), label(&predictors.im_x).to_string()),
    };
    let title = format!("{of}: {}", short_labels(predictors));
    let mut panel = Panel::new(&title, Axis::log(&x), Axis::fraction("*P*_{ro}"), Vec::new());
    let mut texts = Vec::new();
    for cases in groups {
        let (ink, fit) = (Ink::Data(order(cases)), fits.curve(cases, predictors));
        let series = motions_of(cases.suite.as_deref().unwrap_or("motions"));
        texts.push((ink, format!("{series}: {}", fit.map_or("no curve".to_string(), parameters))));
        let layers = fit.map_or(Vec::new(), |fit| overturned(fit, cases));
        let coloured = |layer| Layer { ink, series: series.clone(), is_listed: false, ..layer };
        panel.layers.extend(layers.into_iter().map(coloured));
    }
    panel.layers.sort_by_key(|layer| layer.style == MarkStyle::Estimates);
    let span = Range::over(panel.layers.iter().flat_map(|layer| &layer.marks).map(|mark| mark.x));
    let falls = first.is_some_and(|fit| beta(&fit.coefficients).value < 0.0);
    let (x, position) =
        if falls { (span.high, LabelPosition::Left) } else { (span.low, LabelPosition::Right) };
    let heights = (0..).map(|line| 0.95 - 0.1 * f64::from(line));
    let words = texts.into_iter().zip(heights).map(|((ink, text), y)| Words { x, y, text, position, ink });
    Panel { words: words.collect(), ..panel }
}

/// The hybrid measure of a fit (Eq. 23).
fn hybrid(fit: &CurveFit) -> String {
    let lambda = lambda(&fit.coefficients).value;
    let [x, y] = [lambda, 1.0].map(|part| minus(number::fixed(part / (1.0 + lambda), 2)));
    let names: Vec<String> = fit.predictors().measures().map(short_label).collect();
    format!("({})^{{{x}}} ({})^{{{y}}}", names[0], names[1])
}

fn parameters(fit: &CurveFit) -> String {
    if fit.status == FitStatus::WrongSign {
        return "wrong sign".to_string();
    }
    let b = &fit.coefficients;
    let written = |value: f64| minus(number::significant(value, 2));
    let (mu, beta) = (mu(b).value, beta(b).value);
    let mut words = format!("*μ* {} (*θ* {}), *β* {}", written(mu), written(mu.exp()), written(beta.abs()));
    words.extend(fit.im_y.as_ref().map(|_| format!(", *λ* {}", written(lambda(b).value))));
    words + if beta < 0.0 { ", falls" } else { "" }
}

/// The curve of a fit and the observed shares, over its measure or the hybrid of its two.
fn overturned(fit: &CurveFit, cases: &Cases) -> Vec<Layer> {
    let measures: Vec<Measure> = fit.predictors().measures().cloned().collect();
    let sample = cases.sample(&measures, |case| Event::Overturning.happened(case.outcome, f64::INFINITY));
    let measure = |row: usize| {
        fit.measure_at(&sample.ln_im.iter().map(|column| column[row].exp()).collect::<Vec<f64>>())
    };
    let observed = sample.y.iter().enumerate().map(|(row, event)| (measure(row), *event));
    let observed: Vec<(f64, bool)> = observed.collect();
    let span = Range::over(observed.iter().map(|(value, _)| *value));
    // Of a hybrid, the second measure is at its median.
    let ln_y = sample.ln_im.get(1).and_then(|column| sample_quantile(column.clone(), 0.5));
    let p = |value: f64| {
        let of_hybrid = |ln_y: f64| {
            let lambda = lambda(&fit.coefficients).value;
            vec![(((1.0 + lambda) * value.ln() - ln_y) / lambda).exp(), ln_y.exp()]
        };
        Some(fit.probability_at(&ln_y.map_or(vec![value], of_hybrid), CONFIDENCE))
    };
    let curve =
        curve("lognormal curve", Ink::Muted, Dash::Solid, equal_ratios(span.low, span.high, STEPS), p);
    let bin = ratio_bins(span, (observed.len() / CASES).clamp(4, BINS));
    let shares = observed_shares(&observed, (observed.len() / 50).clamp(3, 20), bin);
    let mut layers = vec![Layer::new("observed fraction", Ink::Muted, MarkStyle::Estimates, shares)];
    layers.extend((fit.status != FitStatus::WrongSign).then_some(curve));
    layers
}

/// Maps of overturning, a panel a group.
pub fn maps(fits: &Fits, groups: &[&Cases]) -> Figure {
    let caption = "Points: motions in which the structure rocks. Lines: equal probability of overturning by \
                   the calibrated model.";
    let panels = groups.iter().map(|cases| map(fits, cases)).collect();
    Figure::new("map", "Overturning over PGA and PGV", 2, 150.0, panels).explained(caption)
}

fn map(fits: &Fits, cases: &Cases) -> Panel {
    let mut layers = Vec::new();
    for (label, ink, event) in [("rocks", Ink::Data(0), false), ("overturns", Ink::Data(1), true)] {
        let its = rocked(cases).filter(|(_, overturned)| *overturned == event);
        let its = its.map(|(case, _)| Mark::new(case.peaks.pga_m_s2 / G_M_S2, case.peaks.pgv_m_s));
        layers.push(Layer::points(label, ink, Symbol::Dot, its));
    }
    let all = Range::over(cases.all.iter().map(|case| case.peaks.pga_m_s2));
    let pga = Range { low: all.low.max(cases.structure.uplift_acceleration_m_s2()), high: all.high };
    let pgv = Range::over(cases.all.iter().map(|case| case.peaks.pgv_m_s));
    let pgv = Range { high: 1.5 * pgv.high, ..pgv };
    for (level, dash) in LEVELS {
        let line = line(fits, cases, level, pga, pgv);
        layers.push(Layer::new(&format!("probability {level}"), Ink::Text, MarkStyle::Line(dash), line));
    }
    Panel::new(&name(cases), Axis::log("PGA (g)"), Axis::log("PGV (m/s)"), layers)
}

/// The motions under which a structure overturns with this probability, within these PGA and PGV (m/s2 and
/// m/s): PGV of each PGA by bisection, as more PGV never lowers the probability.
fn line(fits: &Fits, cases: &Cases, level: f64, pga: Range, pgv: Range) -> Vec<Mark> {
    let structure = &cases.structure;
    let uncalibrated =
        || Calibration::uncalibrated(MotionKind::from_suite(cases.suite.as_deref()), structure, None);
    let calibration = fits.calibration(cases).cloned().unwrap_or_else(uncalibrated);
    let reaches = |pga: f64, ln_pgv: f64| {
        let peaks = Peaks { pga_m_s2: pga, pgv_m_s: ln_pgv.exp() };
        let measures = IntensityMeasures::new(structure, peaks, None, None);
        let p = calibration.probability(structure, &measures, None, Tau::Included);
        p.is_some_and(|p| p.value >= level && measures.im4 >= 1.0)
    };
    let (least, most) = (pgv.low.ln(), pgv.high.ln());
    let mut marks = Vec::new();
    for pga in equal_ratios(pga.low, pga.high, STEPS) {
        let is_crossed = reaches(pga, most) && !reaches(pga, least);
        let ln_pgv = is_crossed.then(|| bisect_first_true(least, most, |ln_pgv| reaches(pga, ln_pgv)));
        marks.push(Mark::new(pga / G_M_S2, ln_pgv.map_or(f64::NAN, f64::exp)));
    }
    marks
}
