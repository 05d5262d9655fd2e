//! Figures 10, 11 and 12: probabilities over a measure, with the observed shares.

use rockfrag_core::fragility::{Cases, CurveFit, DemandFit, DemandModel, Measure, hybrid_measure, lambda};
use rockfrag_core::motion::IntensityMeasures;
use rockfrag_core::statistics::numerics::equal_ratios;
use rockfrag_core::statistics::scores::sample_quantile;
use rockfrag_core::statistics::{Interval, Range};

use super::common::{Fits, by, called, compare, demands, label};
use super::common::{observed_shares, ratio_bins, rocked};
use crate::chart::{Axis, Dash, Figure, Ink, Layer, Mark, MarkStyle, Panel};
use crate::number;

/// Number of points of a curve; the most bins of observed shares, and cases for each on average.
const STEPS: usize = 120;
const BINS: usize = 14;
const CASES: usize = 8;
/// Quantiles of IM3 at which P_ex is drawn.
const SHARES: [f64; 3] = [0.1, 0.5, 0.9];
const CONFIDENCE: f64 = 0.95;
const DASHES: [Dash; 4] = [Dash::Solid, Dash::Long, Dash::Short, Dash::Mixed];

/// The structures of a suite over one measure.
struct Over<'a> {
    measure: &'a str,
    structures: Vec<Drawn<'a>>,
}

/// What is drawn of a structure.
struct Drawn<'a> {
    cases: &'a Cases,
    /// Up to four with their labels, told apart by dashes.
    curves: Vec<(String, Vec<Mark>)>,
    shares: Vec<Mark>,
}

/// Figure 10: probability of exceeding the limit state in safe rocking by two measures and by one.
pub fn exceedance(fits: &Fits, suites: &[Vec<&Cases>]) -> Figure {
    let panels = panels("*P*_{ex}", suites.iter().map(|groups| exceeding(fits, groups)).collect());
    let caption = "Probability of exceeding the limit state by the two planes at quantiles of IM3, and by \
                   IM4 alone where it has a curve.";
    Figure::new("exceedance", "Exceeding the limit state in safe rocking", 2, 118.0, panels)
        .explained(compare(caption, "Figure 10"))
}

/// Figure 11: probability of overturning over single measures.
pub fn overturning(fits: &Fits, suites: &[Vec<&Cases>]) -> Figure {
    let single = [&Measure::Im4, &Measure::Im5].into_iter();
    let all = single.flat_map(|measure| suites.iter().map(move |groups| over(fits, groups, measure, None)));
    let panels = panels("*P*_{ro}", all.collect());
    let caption = "Lognormal curves with 95 % bands, and observed fractions with 95 % limits.";
    Figure::new("overturning", "Overturning over single measures", 2, 118.0, panels)
        .explained(compare(caption, "Figure 11"))
}

/// Figure 12: probability of overturning over hybrid measures (Eq. 23).
pub fn hybrids(fits: &Fits, suites: &[Vec<&Cases>]) -> Figure {
    let all = suites.iter().map(|groups| over(fits, groups, &Measure::Im4, Some(&Measure::Im3Inverse)));
    let panels = panels("*P*_{ro}", all.collect());
    let caption = "Lognormal curves over the hybrid measure of each structure (Eq. 23) with 95 % bands, and \
                   observed fractions with 95 % limits.";
    Figure::new("overturning-hybrid", "Overturning over hybrid measures", 2, 118.0, panels)
        .explained(compare(caption, "Figure 12"))
}

/// Draws what has a curve: a panel a suite, each structure in one colour in all panels.
fn panels(probability: &str, mut all: Vec<Over>) -> Vec<Panel> {
    all.retain(|over| over.structures.iter().any(|structure| !structure.curves.is_empty()));
    let names = all.iter().flat_map(|over| &over.structures).map(|drawn| &drawn.cases.structure.name);
    let names = by(names, |name| name);
    let ink = |cases: &Cases| {
        Ink::Data(names.iter().position(|same| *same[0] == cases.structure.name).unwrap_or(0))
    };
    let mut panels = Vec::new();
    for Over { measure, structures } in &all {
        let mut layers = Vec::new();
        for Drawn { cases, curves, .. } in structures {
            for (place, ((_, marks), dash)) in curves.iter().zip(DASHES).enumerate() {
                // The legend names the structure by its first curve.
                let label = if place == 0 { called(&cases.structure) } else { String::new() };
                layers.push(Layer::new(&label, ink(cases), MarkStyle::Line(dash), marks.clone()));
            }
        }
        // Layers of nothing, for the legend: what the dashes and the dots mean.
        let most = structures.iter().map(|structure| &structure.curves[..]).max_by_key(|curves| curves.len());
        let most = most.filter(|curves| curves.len() > 1).unwrap_or_default();
        for ((label, _), dash) in most.iter().zip(DASHES) {
            layers.push(Layer::new(label, Ink::Muted, MarkStyle::Line(dash), []));
        }
        for Drawn { cases, shares, .. } in structures.iter().filter(|drawn| !drawn.shares.is_empty()) {
            layers.push(Layer::new("observed fraction", Ink::Muted, MarkStyle::Estimates, []));
            layers.push(Layer::new("", ink(cases), MarkStyle::Estimates, shares.clone()));
        }
        let suite = structures[0].cases.suite.as_deref().unwrap_or_default();
        panels.push(Panel::new(suite, Axis::log(measure), Axis::probability(probability), layers));
    }
    panels
}

/// A curve with its band, broken where it has no value.
fn curve(x: impl Iterator<Item = f64>, p: impl Fn(f64) -> Option<Interval>) -> Vec<Mark> {
    x.map(|x| p(x).map_or(Mark::new(f64::NAN, f64::NAN), |p| Mark::estimate(x, p))).collect()
}

/// The measures of a motion with these IM4 and IM3.
fn measures(im4: f64, im3: f64) -> IntensityMeasures {
    IntensityMeasures::from_peaks(im4, im4 / im3)
}

/// P_ex by the planes at quantiles of IM3, and by IM4 alone.
fn exceeding<'a>(fits: &Fits, groups: &[&'a Cases]) -> Over<'a> {
    let mut im3 = Vec::new();
    let mut span = Range { low: 1.0, high: 1.5 };
    for cases in groups {
        for (case, _) in demands(cases) {
            im3.extend(case.measures.im3);
            span.high = span.high.max(case.measures.im4);
        }
    }
    let structures = groups.iter().map(|cases| Drawn {
        cases,
        curves: exceeding_curves(fits, cases, span, &im3),
        shares: Vec::new(),
    });
    Over { measure: label(&Measure::Im4), structures: structures.collect() }
}

fn exceeding_curves(fits: &Fits, cases: &Cases, span: Range, im3: &[f64]) -> Vec<(String, Vec<Mark>)> {
    let planes: Vec<&DemandFit> = fits.demand(cases, DemandModel::Biplanar).collect();
    let mut curves = Vec::new();
    for share in SHARES {
        let im3 = sample_quantile(im3.to_vec(), share);
        let transition = planes.last().and_then(|plane| plane.range_low);
        let Some((im3, transition)) = im3.zip(transition) else { continue };
        let below = Range { high: transition * (1.0 - 1e-9), ..span };
        let above = Range { low: transition, ..span };
        let im4 = equal_ratios(below.low, below.high, STEPS)
            .chain([f64::NAN])
            .chain(equal_ratios(above.low, above.high, STEPS));
        let p = |im4: f64| {
            let plane = planes.iter().find(|fit| fit.holds_at(im4))?;
            plane.p_exceeding(&measures(im4, im3), fits.limit_state, CONFIDENCE)
        };
        curves.push((format!("IM3 at its {} % quantile", number::plain(100.0 * share)), curve(im4, p)));
    }
    let alone = fits.demand(cases, DemandModel::Univariate).find(|fit| fit.im_x == Measure::Im4);
    curves.extend(alone.map(|fit| {
        let p = |im4: f64| fit.p_exceeding(&measures(im4, 1.0), fits.limit_state, CONFIDENCE);
        ("IM4 alone".to_string(), curve(equal_ratios(span.low, span.high, STEPS), p))
    }));
    curves
}

/// P_ro over a measure, or over a hybrid one at the median IM3.
fn over<'a>(fits: &Fits, groups: &[&'a Cases], im_x: &'static Measure, im_y: Option<&Measure>) -> Over<'a> {
    let mut structures = Vec::new();
    for &cases in groups {
        let mut drawn = Drawn { cases, curves: Vec::new(), shares: Vec::new() };
        let fit = fits.curve(cases, im_x, im_y);
        if let Some(fit) = fit.filter(|fit| fit.coefficients[1..].iter().sum::<f64>() > 0.0) {
            let observed: Vec<(f64, bool)> = rocked(cases)
                .filter_map(|(case, event)| Some((measure_of(fit, &case.measures)?, event)))
                .collect();
            let im3 = cases.all.iter().filter_map(|case| case.measures.im3).collect();
            let im3 = sample_quantile(im3, 0.5).unwrap_or(1.0);
            let span = Range::over(observed.iter().map(|(value, _)| *value));
            let bin = ratio_bins(span, (observed.len() / CASES).clamp(4, BINS));
            let p = |value: f64| fit.probability(&motion_at(fit, value, im3), CONFIDENCE);
            drawn.shares = observed_shares(&observed, bin);
            drawn.curves.push((String::new(), curve(equal_ratios(span.low, span.high, STEPS), p)));
        }
        structures.push(drawn);
    }
    let measure = if im_y.is_some() { "hybrid measure" } else { label(im_x) };
    Over { measure, structures }
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
