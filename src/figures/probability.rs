//! Figures 10, 11 and 12: probabilities over a measure, with the observed shares; and maps of overturning
//! over PGA and PGV.

use rockfrag_core::fragility::{
    Calibration, Cases, CurveFit, DemandFit, DemandModel, Measure, MotionKind, Tau, hybrid_measure, lambda,
};
use rockfrag_core::motion::{IntensityMeasures, Peaks};
use rockfrag_core::statistics::numerics::{bisect_first_true, equal_ratios};
use rockfrag_core::statistics::scores::sample_quantile;
use rockfrag_core::statistics::{Interval, Range};
use rockfrag_core::units::G_M_S2;

use super::common::{Fits, by, called, compare, demands, estimate, label, name};
use super::common::{observed_shares, ratio_bins, rocked};
use crate::chart::{Axis, Dash, Figure, Ink, Layer, Mark, MarkStyle, Panel};
use crate::number;

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

/// Figure 10: probability of exceeding the limit state in safe rocking by two measures and by one.
pub fn exceedance(fits: &Fits, suites: &[Vec<&Cases>]) -> Figure {
    let axes = [label(&Measure::Im4), "*P*_{ex}"];
    let panels = suites.iter().filter_map(|groups| {
        let rocking = || groups.iter().flat_map(|cases| demands(cases)).map(|(case, _)| &case.measures);
        let im3: Vec<f64> = rocking().filter_map(|measures| measures.im3).collect();
        let span = Range { low: 1.0, high: rocking().map(|measures| measures.im4).fold(1.5, f64::max) };
        panel(axes, suites, groups, |cases| exceeding(fits, cases, span, &im3))
    });
    let caption = "Probability of exceeding the limit state by the two planes at quantiles of IM3, and by \
                   IM4 alone where it has a curve.";
    let title = "Exceeding the limit state in safe rocking";
    Figure::new("exceedance", title, 2, 118.0, panels.collect()).explained(compare(caption, "Figure 10"))
}

/// Figure 11: probability of overturning over single measures.
pub fn overturning(fits: &Fits, suites: &[Vec<&Cases>]) -> Figure {
    let panels = [&Measure::Im4, &Measure::Im5].map(|measure| over(fits, suites, measure, None));
    let caption = "Lognormal curves with 95 % bands, and observed fractions with 95 % limits.";
    Figure::new("overturning", "Overturning over single measures", 2, 118.0, panels.concat())
        .explained(compare(caption, "Figure 11"))
}

/// Figure 12: probability of overturning over hybrid measures (Eq. 23).
pub fn hybrids(fits: &Fits, suites: &[Vec<&Cases>]) -> Figure {
    let panels = over(fits, suites, &Measure::Im4, Some(&Measure::Im3Inverse));
    let caption = "Lognormal curves over the hybrid measure of each structure (Eq. 23) with 95 % bands, and \
                   observed fractions with 95 % limits.";
    Figure::new("overturning-hybrid", "Overturning over hybrid measures", 2, 118.0, panels)
        .explained(compare(caption, "Figure 12"))
}

/// A panel of the structures of a suite that have layers, each in one colour in all panels.
fn panel(
    [x, y]: [&str; 2],
    suites: &[Vec<&Cases>],
    groups: &[&Cases],
    layers_of: impl Fn(&Cases) -> Vec<Layer>,
) -> Option<Panel> {
    let names = by(suites.iter().flatten(), |cases| &cases.structure.name);
    // Layers of nothing, for the legend: the colours, then what the dashes and the dots mean.
    let (mut colours, mut keys, mut layers) = (Vec::new(), Vec::new(), Vec::new());
    for (Cases { structure, .. }, its) in groups.iter().map(|cases| (cases, layers_of(cases))) {
        let number = names.iter().position(|same| same[0].structure.name == structure.name);
        let (called, ink) = (called(structure), Ink::Data(number.unwrap_or(0)));
        colours.extend(its.first().map(|_| Layer::line(&called, ink, [])));
        keys.extend(its.iter().map(|layer| Layer { marks: Vec::new(), ..layer.clone() }));
        layers.extend(its.into_iter().map(|layer| {
            let name = format!("{called}, {}", layer.name);
            Layer { name, ink, is_listed: false, ..layer }
        }));
    }
    layers.sort_by_key(|layer| layer.style == MarkStyle::Estimates);
    let suite = groups.first()?.suite.clone().unwrap_or_default();
    let has_curves = !layers.is_empty();
    let layers = [colours, keys, layers].concat();
    has_curves.then(|| Panel::new(&suite, Axis::log(x), Axis::fraction(y), layers))
}

/// A curve with its band, broken where it has no value.
fn curve(name: &str, dash: Dash, x: impl Iterator<Item = f64>, p: impl Fn(f64) -> Option<Interval>) -> Layer {
    let marks = x.map(|x| p(x).map_or(Mark::new(f64::NAN, f64::NAN), |p| estimate(x, p)));
    Layer::new(name, Ink::Muted, MarkStyle::Line(dash), marks)
}

/// The measures of a motion with these IM4 and IM3.
fn measures(im4: f64, im3: f64) -> IntensityMeasures {
    IntensityMeasures::from_peaks(im4, im4 / im3)
}

/// P_ex by the planes at quantiles of IM3, and by IM4 alone.
fn exceeding(fits: &Fits, cases: &Cases, span: Range, im3: &[f64]) -> Vec<Layer> {
    let planes: Vec<&DemandFit> = fits.demand(cases, DemandModel::Biplanar).collect();
    let transition = planes.last().and_then(|plane| plane.range_low);
    let mut curves = Vec::new();
    for (share, dash) in SHARES {
        let Some((im3, transition)) = sample_quantile(im3.to_vec(), share).zip(transition) else { continue };
        let below = equal_ratios(span.low, transition * (1.0 - 1e-9), STEPS);
        let im4 = below.chain([f64::NAN]).chain(equal_ratios(transition, span.high, STEPS));
        let p = |im4: f64| {
            let plane = planes.iter().find(|fit| fit.holds_at(im4))?;
            plane.p_exceeding(&measures(im4, im3), fits.limit_state, CONFIDENCE)
        };
        curves.push(curve(&format!("IM3 at its {} % quantile", number::plain(100.0 * share)), dash, im4, p));
    }
    let alone = fits.demand(cases, DemandModel::Univariate).find(|fit| fit.im_x == Measure::Im4);
    curves.extend(alone.map(|fit| {
        let p = |im4: f64| fit.p_exceeding(&measures(im4, 1.0), fits.limit_state, CONFIDENCE);
        curve("IM4 alone", Dash::Mixed, equal_ratios(span.low, span.high, STEPS), p)
    }));
    curves
}

/// P_ro over a measure, or over a hybrid one at the median IM3; a panel a suite.
fn over(fits: &Fits, suites: &[Vec<&Cases>], im_x: &Measure, im_y: Option<&Measure>) -> Vec<Panel> {
    let axes = [if im_y.is_some() { "hybrid measure" } else { label(im_x) }, "*P*_{ro}"];
    let panels = suites.iter().filter_map(|groups| {
        panel(axes, suites, groups, |cases| {
            let fit = fits.curve(cases, im_x, im_y);
            let rising = fit.filter(|fit| fit.coefficients[1..].iter().sum::<f64>() > 0.0);
            rising.map_or(Vec::new(), |fit| overturned(fit, cases))
        })
    });
    panels.collect()
}

fn overturned(fit: &CurveFit, cases: &Cases) -> Vec<Layer> {
    let observed = rocked(cases).filter_map(|(case, event)| Some((measure_of(fit, &case.measures)?, event)));
    let observed: Vec<(f64, bool)> = observed.collect();
    let im3 = cases.all.iter().filter_map(|case| case.measures.im3).collect();
    let im3 = sample_quantile(im3, 0.5).unwrap_or(1.0);
    let span = Range::over(observed.iter().map(|(value, _)| *value));
    let bin = ratio_bins(span, (observed.len() / CASES).clamp(4, BINS));
    let p = |value: f64| fit.probability(&motion_at(fit, value, im3), CONFIDENCE);
    let curve = curve("lognormal curve", Dash::Solid, equal_ratios(span.low, span.high, STEPS), p);
    let shares = observed_shares(&observed, bin);
    let shares = Layer::new("observed fraction", Ink::Muted, MarkStyle::Estimates, shares);
    vec![curve.unlisted(), shares]
}

/// The measure of a curve, or the hybrid of its two (Eq. 23); none where one is missing.
fn measure_of(fit: &CurveFit, measures: &IntensityMeasures) -> Option<f64> {
    let x = fit.im_x.value_of(measures)?;
    let Some(im_y) = &fit.im_y else { return Some(x) };
    Some(hybrid_measure(x, im_y.value_of(measures)?, lambda(&fit.coefficients).value))
}

/// The measures of a motion of this IM3 at which the measure of a curve of IM4, IM5 or the hybrid of
/// IM4 and 1/IM3 has a value: the inverse of [`measure_of`].
fn motion_at(fit: &CurveFit, value: f64, im3: f64) -> IntensityMeasures {
    let im4 = match (&fit.im_x, &fit.coefficients[..]) {
        (_, [_, b1, b2]) => (((b1 + b2) * value.ln() + b2 * im3.ln()) / b1).exp(),
        (Measure::Im5, _) => value * im3,
        _ => value,
    };
    measures(im4, im3)
}

/// Maps of overturning, one panel per suite: of its first structure, with a line for each of the others.
pub fn maps(fits: &Fits, suites: &[Vec<&Cases>]) -> Figure {
    let caption = "Each point is a motion in which the structure rocks. Lines join motions of equal \
                   probability of overturning by the model, calibrated with these responses; coloured lines \
                   are those of probability 0.5 of other structures.";
    let panels = suites.iter().filter_map(|groups| Some(map(fits, groups.split_first()?)));
    Figure::new("map", "Overturning over PGA and PGV", 2, 150.0, panels.collect()).explained(caption)
}

fn map(fits: &Fits, (cases, others): (&&Cases, &[&Cases])) -> Panel {
    let mut layers = Vec::new();
    for (label, ink, event) in [("rocks", Ink::Data(0), false), ("overturns", Ink::Data(1), true)] {
        let its = rocked(cases).filter(|(_, overturned)| *overturned == event);
        let its = its.map(|(case, _)| Mark::new(case.peaks.pga_m_s2 / G_M_S2, case.peaks.pgv_m_s));
        layers.push(Layer::points(label, ink, its));
    }
    let all = Range::over(cases.all.iter().map(|case| case.peaks.pga_m_s2));
    let pga = Range { low: all.low.max(cases.structure.uplift_acceleration_m_s2()), high: all.high };
    let pgv = Range::over(cases.all.iter().map(|case| case.peaks.pgv_m_s));
    let pgv = Range { high: 1.5 * pgv.high, ..pgv };
    for (level, dash) in LEVELS {
        let line = line(fits, cases, level, pga, pgv);
        layers.push(Layer::new(&format!("probability {level}"), Ink::Text, MarkStyle::Line(dash), line));
    }
    for (number, other) in (2..).zip(others) {
        let label = format!("{}, 0.5", called(&other.structure));
        layers.push(Layer::line(&label, Ink::Data(number), line(fits, other, 0.5, pga, pgv)));
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
