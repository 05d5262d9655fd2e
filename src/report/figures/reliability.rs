//! Reliability: predicted probabilities against observed shares.

use crate::fragility::{DemandModel, Measure};
use crate::normal;
use crate::report::axis::Axis;
use crate::report::data::{Group, ReportData, ReportResponse};
use crate::report::drawing::{Dash, Ink};
use crate::report::figure::{Figure, Grid};
use crate::report::panel::{Estimate, Mark, Panel};
use crate::report::text::Label;
use crate::studies::wilson_limits;

/// The predicted probability of an event in each case, and whether it happened.
type Forecasts = Vec<(f64, bool)>;

/// Number of classes of probability.
const CLASSES: usize = 10;

/// Draws one figure, one panel a group that has fits.
pub fn figures(data: &ReportData) -> Vec<Figure> {
    let panels: Vec<(&Group, [Forecasts; 2])> = data
        .groups
        .iter()
        .map(|group| (group, [overturning(group), exceeding(group, data.limit)]))
        .filter(|(_, forecasts)| forecasts.iter().any(|forecasts| !forecasts.is_empty()))
        .collect();
    if panels.is_empty() {
        return Vec::new();
    }
    let inks = [Ink::Data(1), Ink::Data(0)];
    let entries = [
        (Mark::Bar(inks[0]), Label::marked("*P*_{ro}")),
        (Mark::Bar(inks[1]), Label::marked("*P*_{ex}")),
        (Mark::Line(Ink::Muted.dashed(0.7, Dash::Short)), Label::plain("predicted = observed")),
    ];
    let (grid, mut drawing) = Grid::of(panels.len(), 140.0).with_legend(&entries);
    for (index, (group, forecasts)) in panels.iter().enumerate() {
        let (corner, width) = grid.place(index);
        let axis = |words: &str| Axis::linear([0.0, 1.0], Label::plain(words));
        let panel = Panel {
            corner,
            width,
            height: grid.panel_height,
            x: axis("predicted probability"),
            y: axis("share seen"),
        };
        panel.line(&mut drawing, &[[0.0, 0.0], [1.0, 1.0]], Ink::Muted.dashed(0.7, Dash::Short));
        for ((forecasts, ink), name) in forecasts.iter().zip(inks).zip(["P_ro", "P_ex"]) {
            panel.estimates(&mut drawing, name, &shares(forecasts), ink);
        }
        panel.frame(&mut drawing, Label::plain(group.name()).bold());
    }
    vec![Figure {
        name: "reliability".to_string(),
        title: "Reliability of the curves".to_string(),
        caption: "Cases gathered by the probability that the fits give them, in tenths: the mean of these against the share in which it happened, with 95 % limits (Wilson). Overturning by the hybrid curve (or over p PGV/(g tan α) where there is none), exceeding the limit state by the two planes. These are the cases that the curves were fitted to; the stage validate takes others.".to_string(),
        made: String::new(),
        drawing,
    }]
}

/// Predicts the probability of overturning of each case that rocked, and tells whether it did.
fn overturning(group: &Group) -> Forecasts {
    let curve = group.curve(Measure::Im4, Some(Measure::Im3Inverse)).or(group.curve(Measure::Im5, None));
    let Some(curve) = curve.filter(|_| group.has_curve()) else { return Vec::new() };
    let forecast = |(response, overturned): (&ReportResponse, bool)| {
        Some((normal::cdf(curve.index.at(&response.case.measures)?.value), overturned))
    };
    group.rocked().filter_map(forecast).collect()
}

/// Predicts the probability of exceeding the limit state of each case in safe rocking, and tells whether it did.
fn exceeding(group: &Group, limit: Option<f64>) -> Forecasts {
    let (Some(limit), Some(planes)) = (limit, group.planes) else { return Vec::new() };
    let [low, high] = planes.sides.map(|side| side.law);
    let model = DemandModel::Biplanar { transition: planes.transition, low, high };
    let forecast = |response: &ReportResponse| {
        let measures = &response.case.measures;
        Some((normal::cdf(model.law(measures).exceeding(measures, limit)?.value), response.case.edp > limit))
    };
    group.safe().filter_map(forecast).collect()
}

/// Gathers forecasts by class: mean probability and observed share, with the limits of the share.
fn shares(forecasts: &[(f64, bool)]) -> Vec<Estimate> {
    let class = |probability: f64| ((probability * CLASSES as f64) as usize).min(CLASSES - 1);
    let of = |wanted: usize| {
        let inside: Vec<&(f64, bool)> = forecasts.iter().filter(|(p, _)| class(*p) == wanted).collect();
        let (count, events) = (inside.len(), inside.iter().filter(|(_, event)| *event).count());
        let mean = inside.iter().map(|(p, _)| p).sum::<f64>() / count as f64;
        let limits = wilson_limits(events, count);
        let at = [mean, events as f64 / count as f64];
        let (low, high, n) = (limits.low, limits.high, count as f64);
        (count > 0).then_some(Estimate { at, low, high, n, radius: 1.8 })
    };
    (0..CLASSES).filter_map(of).collect()
}
