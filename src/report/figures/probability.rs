//! Figures 10, 11 and 12: probabilities over a measure, with the observed shares.

use super::common::{Fits, by, compare, demand_fits, demands, ends, equal_ratios, label};
use super::common::{observed_shares, ratios, rocked};
use crate::fragility::{Case, Cases, CurveFit, DemandFit, DemandModel, Measure, hybrid_measure, lambda};
use crate::motion::IntensityMeasures;
use crate::number;
use crate::report::text::literal;
use crate::report::{Axis, Dash, Estimate, Figure, Ink, Layer, Panel};
use crate::statistics;
use crate::statistics::scores::sample_quantile;

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
    measure: &'static str,
    structures: Vec<Drawn<'a>>,
}

/// What is drawn of a structure.
struct Drawn<'a> {
    cases: &'a Cases,
    /// Up to four, told apart by dashes.
    curves: Vec<Curve>,
    shares: Vec<Estimate>,
}

/// A label, points, and limits at each of them.
type Curve = (String, Vec<[f64; 2]>, Vec<[f64; 2]>);

/// Figure 10: probability of exceeding the limit state in safe rocking by two measures and by one.
pub fn exceedance(fits: &Fits, suites: &[Vec<&Cases>]) -> Figure {
    let panels = panels("*P*_{ex}", suites.iter().map(|groups| exceeding(fits, groups)).collect());
    let caption = "Probability of exceeding the limit state by the two planes at quantiles of IM3, and by \
                   IM4 alone where it has a curve.";
    let caption = compare(caption, "Figure 10");
    Figure::new("exceedance", "Exceeding the limit state in safe rocking", caption, 2, 118.0, panels)
}

/// Figure 11: probability of overturning over single measures.
pub fn overturning(fits: &Fits, suites: &[Vec<&Cases>]) -> Figure {
    let over = |measure| suites.iter().map(move |groups| over(fits, groups, measure, None));
    let panels = panels("*P*_{ro}", over(Measure::Im4).chain(over(Measure::Im5)).collect());
    let caption = "Lognormal curves with 95 % bands, and observed fractions with 95 % limits.";
    let caption = compare(caption, "Figure 11");
    Figure::new("overturning", "Overturning over single measures", caption, 2, 118.0, panels)
}

/// Figure 12: probability of overturning over hybrid measures (Eq. 23).
pub fn hybrids(fits: &Fits, suites: &[Vec<&Cases>]) -> Figure {
    let hybrid = |groups: &Vec<_>| over(fits, groups, Measure::Im4, Some(Measure::Im3Inverse));
    let panels = panels("*P*_{ro}", suites.iter().map(hybrid).collect());
    let caption = "Lognormal curves over the hybrid measure of each structure (Eq. 23) with 95 % bands, and \
                   observed fractions with 95 % limits.";
    let caption = compare(caption, "Figure 12");
    Figure::new("overturning-hybrid", "Overturning over hybrid measures", caption, 2, 118.0, panels)
}

/// Draws what has a curve: a panel a suite, each structure in one colour in all panels.
fn panels(probability: &str, mut all: Vec<Over>) -> Vec<Panel> {
    all.retain(|over| over.structures.iter().any(|structure| !structure.curves.is_empty()));
    let names = all.iter().flat_map(|over| &over.structures).map(|drawn| &drawn.cases.structure.name);
    let names = by(names, |name| name);
    let panel = |Over { measure, structures }: &Over| {
        let ink = |cases: &Cases| {
            Ink::Data(names.iter().position(|same| *same[0] == cases.structure.name).unwrap_or(0))
        };
        let mut layers = Vec::new();
        for Drawn { cases, curves, .. } in structures {
            for (place, ((_, points, band), dash)) in curves.iter().zip(DASHES).enumerate() {
                // The legend names the structure by its first curve.
                let label = if place == 0 { literal(&cases.structure.name) } else { String::new() };
                layers.push(Layer::curve(&label, ink(cases), dash, points.clone(), band.clone()));
            }
        }
        // Layers of nothing, for the legend: what the dashes and the dots mean.
        let most = structures.iter().map(|structure| &structure.curves[..]).max_by_key(|curves| curves.len());
        let most = most.filter(|curves| curves.len() > 1).unwrap_or_default();
        for ((label, ..), dash) in most.iter().zip(DASHES) {
            layers.push(Layer::curve(label, Ink::Muted, dash, Vec::new(), Vec::new()));
        }
        let observed = structures.iter().filter(|structure| !structure.shares.is_empty());
        for Drawn { cases, shares, .. } in observed {
            layers.push(Layer::estimates("observed fraction", Ink::Muted, []));
            layers.push(Layer::estimates("", ink(cases), shares.clone()));
        }
        let suite = structures[0].cases.suite.as_deref().unwrap_or_default();
        Panel::new(suite, Axis::log(measure), Axis::probability(probability), layers)
    };
    all.iter().map(panel).collect()
}

/// A curve with its band, broken where it has no value.
fn curve(
    label: &str,
    x: impl Iterator<Item = f64>,
    p: impl Fn(f64) -> Option<statistics::Estimate>,
) -> Curve {
    let point = |x: f64| match p(x) {
        Some(statistics::Estimate { value, low, high }) => ([x, value], [low, high]),
        None => ([f64::NAN; 2], [f64::NAN; 2]),
    };
    let (points, band) = x.map(point).unzip();
    (label.to_string(), points, band)
}

/// The measures of a motion with these IM4 and IM3.
fn measures(im4: f64, im3: f64) -> IntensityMeasures {
    IntensityMeasures::from_peaks(im4, im4 / im3)
}

/// P_ex by the planes at quantiles of IM3, and by IM4 alone.
fn exceeding<'a>(fits: &Fits, groups: &[&'a Cases]) -> Over<'a> {
    let all = || groups.iter().flat_map(|cases| demands(cases)).map(|(case, _)| case.measures);
    let im3: Vec<f64> = all().filter_map(|measures| measures.im3).collect();
    let most = all().map(|measures| measures.im4).fold(1.5, f64::max);
    let limit_state = fits.limit_state;
    let structure = |&cases: &&'a Cases| {
        let planes: Vec<&DemandFit> = demand_fits(fits, cases, DemandModel::Biplanar).collect();
        let at_share = |share: f64| {
            let (im3, transition) = (sample_quantile(im3.clone(), share)?, planes.last()?.range_low?);
            let below = ratios([1.0, transition * (1.0 - 1e-9)], STEPS).chain([f64::NAN]);
            let p = |im4: f64| {
                let plane = planes.iter().find(|fit| fit.holds_at(im4))?;
                plane.p_exceeding(&measures(im4, im3), limit_state, CONFIDENCE)
            };
            let label = format!("IM3 at its {} % quantile", number::plain(100.0 * share));
            Some(curve(&label, below.chain(ratios([transition, most], STEPS)), p))
        };
        let alone = demand_fits(fits, cases, DemandModel::Univariate).find(|fit| fit.im_x == Measure::Im4);
        let p = |fit: &DemandFit, im4: f64| fit.p_exceeding(&measures(im4, 1.0), limit_state, CONFIDENCE);
        let alone = alone.map(|fit| curve("IM4 alone", ratios([1.0, most], STEPS), |im4| p(fit, im4)));
        let curves = SHARES.into_iter().filter_map(at_share).chain(alone).collect();
        Drawn { cases, curves, shares: Vec::new() }
    };
    Over { measure: label(Measure::Im4), structures: groups.iter().map(structure).collect() }
}

/// P_ro over a measure, or over a hybrid one at the median IM3.
fn over<'a>(fits: &Fits, groups: &[&'a Cases], im_x: Measure, im_y: Option<Measure>) -> Over<'a> {
    let structure = |&cases: &&'a Cases| {
        let fit = fits.curve(cases, im_x, im_y);
        let rising = fit.filter(|fit| fit.coefficients[1..].iter().sum::<f64>() > 0.0);
        let Some(fit) = rising else { return Drawn { cases, curves: Vec::new(), shares: Vec::new() } };
        let share = |(case, event): (&Case, bool)| Some((measure_of(fit, &case.measures)?, event));
        let observed: Vec<(f64, bool)> = rocked(cases).filter_map(share).collect();
        let im3 = sample_quantile(cases.all.iter().filter_map(|case| case.measures.im3).collect(), 0.5)
            .unwrap_or(1.0);
        let p = |value: f64| fit.probability(&motion_at(fit, value, im3), CONFIDENCE);
        let ends = ends(observed.iter().map(|(value, _)| *value));
        let bin = equal_ratios(ends, (observed.len() / CASES).clamp(4, BINS));
        let shares = observed_shares(&observed, bin);
        Drawn { cases, curves: vec![curve("", ratios(ends, STEPS), p)], shares }
    };
    let measure = if im_y.is_some() { "hybrid measure" } else { label(im_x) };
    Over { measure, structures: groups.iter().map(structure).collect() }
}

/// The measure of a curve, or the hybrid of its two (Eq. 23); none where one is missing.
fn measure_of(fit: &CurveFit, measures: &IntensityMeasures) -> Option<f64> {
    let x = fit.im_x.value_of(measures)?;
    let Some(im_y) = fit.im_y else { return Some(x) };
    Some(hybrid_measure(x, im_y.value_of(measures)?, lambda(&fit.coefficients).0))
}

/// The measures of a motion of this IM3 at which the measure of a curve of IM4, IM5 or the hybrid of
/// IM4 and 1/IM3 has a value: the inverse of [`measure_of`].
fn motion_at(fit: &CurveFit, value: f64, im3: f64) -> IntensityMeasures {
    let im4 = match (fit.im_x, &fit.coefficients[..]) {
        (_, [_, b1, b2]) => (((b1 + b2) * value.ln() + b2 * im3.ln()) / b1).exp(),
        (Measure::Im5, _) => value * im3,
        _ => value,
    };
    measures(im4, im3)
}
