//! Incremental dynamic analysis, validation and ranking.

use super::common::{by, label_of_scaled, observed_shares, ratios, title};
use crate::fragility::{Z_95, p_overturning};
use crate::number::Limited;
use crate::report::{Axis, Dash, Estimate, Figure, Ink, Layer, Panel};
use crate::rocking::CapacityStatus;
use crate::studies::{Form, RankedSet, ReliabilityBin, Target};
use crate::table::capacities::{CapacityFitRow, CapacityRow, Stripe};
use crate::table::responses::OutcomeWord;

/// The most panels, levels of an analysis, and steps of its curve.
const PANELS: usize = 24;
const LEVELS: usize = 15;
const STEPS: usize = 100;
/// The most sets of measures that are drawn, besides those of the paper.
const SETS: i64 = 6;
const PAPER: [&str; 2] = ["im3:im4", "im5"];

/// Values with their limits, each in a row of its name.
fn in_rows(title: &str, x: Axis, ink: Ink, rows: Vec<(String, Limited)>) -> Panel {
    let estimate = |(row, (_, limited)): (usize, &(String, Limited))| {
        let [x, low, high] =
            [limited.value, limited.low, limited.high].map(|number| number.unwrap_or(f64::NAN));
        Estimate { x, y: row as f64, low, high, n: f64::NAN }
    };
    let estimates = Layer::estimates("", ink, rows.iter().enumerate().map(estimate));
    Panel::new(title, x, Axis::names(rows.into_iter().map(|(name, _)| name)), vec![estimates])
}

/// Incremental dynamic analyses: the distribution of the lowest overturning intensities, and the share that
/// overturns at each level.
pub fn ida(fits: &[CapacityFitRow], rows: &[CapacityRow], stripes: &[Stripe]) -> Figure {
    let mut levels: Vec<f64> = stripes.iter().map(|stripe| stripe.intensity).collect();
    levels.sort_unstable_by(f64::total_cmp);
    levels.dedup();
    let ends = [levels.first(), levels.last()].map(|level| level.copied().unwrap_or(f64::NAN));
    let panel = |fit: &CapacityFitRow| {
        let its = stripes.iter().filter(|stripe| stripe.group() == fit.group());
        let cases: Vec<_> =
            its.map(|stripe| (stripe.intensity, stripe.outcome == OutcomeWord::Overturned)).collect();
        let shares = observed_shares(&cases, |x| levels.partition_point(|level| *level < x));
        let every = shares.len().div_ceil(LEVELS).max(1);
        let below = |row: &CapacityRow| Some(ends[0]).filter(|_| row.capacity == CapacityStatus::Below);
        let its = rows.iter().filter(|row| row.group() == fit.group());
        let mut capacities: Vec<f64> =
            its.filter_map(|row| row.overturning_intensity.or(below(row))).collect();
        capacities.sort_unstable_by(f64::total_cmp);
        let share = |k: usize| k as f64 / fit.n.max(1) as f64;
        let steps = capacities.iter().enumerate().flat_map(|(k, &x)| [[x, share(k)], [x, share(k + 1)]]);
        let curve = fit.theta.value.zip(fit.beta.value).map(|(theta, beta)| {
            ratios(ends, STEPS).map(|x| [x, p_overturning(x, theta.ln(), beta)]).collect()
        });
        let layers = vec![
            Layer::line("lognormal curve", Ink::Data(1), curve.unwrap_or_default()),
            Layer::line("at or below the intensity", Ink::Muted, steps.collect()),
            Layer::estimates("at the intensity", Ink::Data(0), shares.into_iter().step_by(every)),
        ];
        let (x, y) = (Axis::log(label_of_scaled(fit.measure)), Axis::probability("fraction that overturns"));
        Panel::new(&title(&fit.structure, fit.suite.as_deref()), x, y, layers)
    };
    let caption = "Grey: fraction of the motions that have overturned the structure at or below an \
                   intensity, with its lognormal curve (orange). Blue: fraction that overturns it at exactly \
                   this intensity, with 95 % limits; it is lower where a structure survives a stronger \
                   version of a motion that overturned it.";
    let panels = fits.iter().take(PANELS).map(panel).collect();
    Figure::new("ida", "Incremental dynamic analysis", caption, 2, 118.0, panels)
}

/// Validation: mean predicted probabilities against observed shares in bins; a panel a structure and suite, a
/// series an event and model.
pub fn validation(bins: &[ReliabilityBin]) -> Figure {
    let title = |bin: &ReliabilityBin| title(&bin.structure, bin.suite.as_deref());
    let estimate = |bin: &ReliabilityBin| {
        let ReliabilityBin { predicted: x, share: y, share_low: low, share_high: high, n, .. } = *bin;
        Estimate { x, y, low, high, n: n as f64 }
    };
    let series = |(number, bins): (usize, Vec<&ReliabilityBin>)| {
        let label = format!("{}, {}", bins[0].event, bins[0].model);
        Layer::estimates(&label, Ink::Data(number), bins.into_iter().map(estimate))
    };
    let panel = |bins: Vec<&ReliabilityBin>| {
        let title = title(bins[0]);
        let diagonal = vec![[0.0, 0.0], [1.0, 1.0]];
        let ideal = Layer::curve("predicted = observed", Ink::Muted, Dash::Short, diagonal, Vec::new());
        let series = by(bins, |bin| (bin.event, &bin.model)).into_iter().enumerate().map(series);
        let layers = std::iter::once(ideal).chain(series).collect();
        let (x, y) = (Axis::probability("predicted probability"), Axis::probability("observed fraction"));
        Panel::new(&title, x, y, layers)
    };
    let caption =
        "Cases in bins of predicted probability: its mean, and the observed fraction with 95 % limits.";
    let panels = by(bins, title).into_iter().take(PANELS).map(panel).collect();
    Figure::new("validation", "Predicted and observed", caption, 2, 140.0, panels)
}

/// Ranking of sets of measures by log score on held-out cases less that of the best, with limits; a panel a
/// structure, suite and target, a row a set of measures.
pub fn ranking(sets: &[RankedSet]) -> Figure {
    let row = |set: &RankedSet| {
        let planes = if set.form == Form::Biplanar { ", two planes" } else { "" };
        let name = format!("{}{planes}", set.measures.to_uppercase().replace(':', ", "));
        let [low, high] = [-Z_95, Z_95].map(|z| Some(set.loss? + z * set.loss_error?));
        (name, Limited { value: set.loss, low, high })
    };
    let title = |set: &RankedSet| {
        let target = if set.target == Target::Demand { "demand" } else { "overturning" };
        format!("{}: {target}", title(&set.structure, set.suite.as_deref()))
    };
    let is_shown = |set: &&RankedSet| {
        (set.rank <= SETS || PAPER.contains(&set.measures.as_str())) && set.loss.and(set.loss_error).is_some()
    };
    let panel = |sets: Vec<&RankedSet>| {
        let rows: Vec<_> = sets.iter().map(|set| row(set)).collect();
        let zero = vec![[0.0, -0.5], [0.0, rows.len() as f64 - 0.5]];
        let x = Axis::linear("log score, less that of the best");
        let mut panel = in_rows(&title(sets[0]), x, Ink::Data(0), rows);
        panel.layers.insert(0, Layer::curve("", Ink::Muted, Dash::Short, zero, Vec::new()));
        panel
    };
    let caption = "Log score on held-out cases, less that of the best set, with 95 % limits.";
    let panels = by(sets.iter().filter(is_shown), title).into_iter().take(PANELS).map(panel).collect();
    Figure::new("ranking", "Measures by how well they predict", caption, 1, 0.0, panels)
}
