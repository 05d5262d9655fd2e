//! Incremental dynamic analysis and validation.

use rockfrag_core::fragility::Group;
use rockfrag_core::rocking::CapacityStatus;
use rockfrag_core::statistics::Range;
use rockfrag_core::studies::ReliabilityBin;

use super::common::{lognormal, name_of, observed_shares, scaled_label, title};
use crate::chart::{Axis, Dash, Figure, Ink, Layer, Mark, MarkStyle, Panel};
use crate::table::responses::{CapacityFitRow, CapacityRow, OutcomeWord, Stripe};
use crate::table::rows::by;

/// The most panels, and levels of an analysis.
const PANELS: usize = 24;
const LEVELS: usize = 15;

/// Incremental dynamic analyses: the lowest overturning intensities, and the share overturned at each level.
pub fn ida(fits: &[CapacityFitRow], rows: &[CapacityRow], stripes: &[Stripe]) -> Figure {
    let panels = fits.iter().take(PANELS).map(|fit| capacity_panel(fit, rows, stripes)).collect();
    let caption = "Fractions of the motions that overturn the structure at or below an intensity and, with \
                   95 % limits, at it: fewer, where it survives a stronger version of a motion.";
    Figure::new("ida", "Incremental dynamic analysis", 2, 118.0, panels).explained(caption)
}

fn capacity_panel(fit: &CapacityFitRow, rows: &[CapacityRow], stripes: &[Stripe]) -> Panel {
    let group = Group::of(&fit.suite, &fit.structure);
    let its = stripes.iter().filter(|of| Group::of(&of.suite, &of.structure) == group);
    let its = its.map(|stripe| (stripe.intensity, stripe.outcome == OutcomeWord::Overturned));
    let cases: Vec<(f64, bool)> = its.collect();
    let levels = Range::over(cases.iter().map(|(intensity, _)| *intensity));
    // Each level is a bin.
    let shares = observed_shares(&cases, 1, |level| level.to_bits() as usize);
    let every = shares.len().div_ceil(LEVELS).max(1);
    let its = rows.iter().filter(|of| Group::of(&of.suite, &of.structure) == group);
    let capacities = its.filter_map(|row| match row.found.status {
        CapacityStatus::Below => row.found.overturning.or(Some(levels.low)),
        _ => row.found.overturning,
    });
    let mut capacities: Vec<f64> = capacities.collect();
    capacities.sort_unstable_by(f64::total_cmp);
    let mut steps = Vec::new();
    for (k, &x) in capacities.iter().enumerate() {
        steps.extend([k, k + 1].map(|k| Mark::new(x, k as f64 / fit.n.max(1) as f64)));
    }
    let fitted = fit.theta.value.zip(fit.beta.value).filter(|_| levels.low < levels.high).into_iter();
    let curve = fitted.flat_map(|(theta, beta)| lognormal(levels, theta.ln(), beta));
    let layers = vec![
        Layer::line("lognormal curve", Ink::Data(1), curve),
        Layer::line("at or below the intensity", Ink::Muted, steps),
        Layer::new("at the intensity", Ink::Data(0), MarkStyle::Estimates, shares.into_iter().step_by(every)),
    ];
    let (x, y) = (Axis::log(scaled_label(fit.measure)), Axis::fraction("fraction that overturns"));
    Panel::new(&title(&name_of(&fit.structure), fit.suite.as_deref()), x, y, layers)
}

/// Validation in bins: a panel a structure and suite, a series an event and model.
pub fn validation(bins: &[ReliabilityBin]) -> Figure {
    let mut panels = Vec::new();
    let name = |bin: &ReliabilityBin| title(&name_of(&bin.structure), bin.suite.as_deref());
    for bins in by(bins, name).into_iter().take(PANELS) {
        let name = name(bins[0]);
        let (ideal, dashed) = ([0.0, 1.0].map(|p| Mark::new(p, p)), MarkStyle::Line(Dash::Short));
        let mut layers = vec![Layer::new("predicted = observed", Ink::Muted, dashed, ideal)];
        for (number, bins) in by(bins, |bin| (bin.event, &bin.model)).into_iter().enumerate() {
            let label = format!("{}, {}", bins[0].event, bins[0].model);
            let marks = bins.into_iter().map(|bin| {
                let ReliabilityBin { predicted: x, share: y, share_low: low, share_high: high, n, .. } = *bin;
                Mark { x, y, low, high, n: n as f64 }
            });
            layers.push(Layer::new(&label, Ink::Data(number), MarkStyle::Estimates, marks));
        }
        let (x, y) = (Axis::fraction("predicted probability"), Axis::fraction("observed fraction"));
        panels.push(Panel::new(&name, x, y, layers));
    }
    let caption = "Mean predicted probability and observed fraction, with 95 % limits, in bins.";
    Figure::new("validation", "Predicted and observed", 2, 140.0, panels).explained(caption)
}
