//! Incremental dynamic analysis, validation and ranking.

use super::probability::Curve;
use crate::report::figure::{Axis, Dash, Estimate, Figure, Ink, Layer, Panel};

/// The lowest intensities that overturn a structure.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ida {
    pub name: String,
    /// Marked label of the intensity.
    pub intensity: String,
    /// Lowest overturning intensity of each motion that has one, in rising order.
    pub capacities: Vec<f64>,
    /// Number of motions.
    pub motions: usize,
    /// Observed share that overturns at each level.
    pub shares: Vec<Estimate>,
    /// The lognormal curve.
    pub curve: Curve,
}

/// A panel of named estimates: of series in one panel, or of rows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct NamedEstimates {
    pub title: String,
    pub series: Vec<(String, Vec<Estimate>)>,
}

/// Incremental dynamic analyses: the distribution of the lowest overturning intensities, and the share that
/// overturns at each level.
pub fn ida(analyses: &[Ida]) -> Figure {
    let panel = |of: &Ida| {
        let share = |k: usize| k as f64 / of.motions.max(1) as f64;
        let steps = of.capacities.iter().enumerate().flat_map(|(k, &x)| [[x, share(k)], [x, share(k + 1)]]);
        let Curve { points, band, .. } = of.curve.clone();
        Panel {
            title: of.name.clone(),
            x: Axis::log(&of.intensity),
            y: Axis::probability("fraction that overturns"),
            layers: vec![
                Layer::curve("lognormal curve", Ink::Data(1), Dash::Solid, points, band),
                Layer::line("at or below the intensity", Ink::Muted, steps.collect()),
                Layer::estimates("at the intensity", Ink::Data(0), of.shares.clone()),
            ],
            notes: Vec::new(),
        }
    };
    Figure {
        name: "ida".to_string(),
        title: "Incremental dynamic analysis".to_string(),
        caption: "Grey: fraction of the motions that have overturned the structure at or below an intensity, with its lognormal curve (orange). Blue: fraction that overturns it at exactly this intensity, with 95 % limits; it is lower where a structure survives a stronger version of a motion that overturned it.".to_string(),
        columns: analyses.len().min(2),
        height: 118.0,
        panels: analyses.iter().map(panel).collect(),
    }
}

/// Validation: mean predicted probabilities against observed shares in bins, a series of estimates each
/// probability.
pub fn validation(groups: &[NamedEstimates]) -> Figure {
    let panel = |NamedEstimates { title, series }: &NamedEstimates| {
        let equal = Layer::curve(
            "predicted = observed",
            Ink::Muted,
            Dash::Short,
            vec![[0.0, 0.0], [1.0, 1.0]],
            Vec::new(),
        );
        let of = |(number, (label, shares)): (usize, &(String, Vec<Estimate>))| {
            Layer::estimates(label, Ink::Data(number), shares.clone())
        };
        Panel {
            title: title.clone(),
            x: Axis::probability("predicted probability"),
            y: Axis::probability("observed fraction"),
            layers: [equal].into_iter().chain(series.iter().enumerate().map(of)).collect(),
            notes: Vec::new(),
        }
    };
    Figure {
        name: "validation".to_string(),
        title: "Predicted and observed".to_string(),
        caption:
            "Cases in bins of predicted probability: its mean, and the observed fraction with 95 % limits."
                .to_string(),
        columns: groups.len().min(2),
        height: 140.0,
        panels: groups.iter().map(panel).collect(),
    }
}

/// Ranking of sets of measures by log score on held-out cases less that of the best, with limits; each row
/// has its name and one estimate.
pub fn ranking(targets: &[NamedEstimates]) -> Figure {
    let panel = |NamedEstimates { title, series }: &NamedEstimates| {
        let last = series.len() as f64 - 0.5;
        let zero = Layer::curve("", Ink::Muted, Dash::Short, vec![[0.0, -0.5], [0.0, last]], Vec::new());
        let rows = series.iter().zip(0..).flat_map(|((_, estimates), row)| {
            estimates.iter().map(move |estimate| Estimate { y: f64::from(row), ..*estimate })
        });
        Panel {
            title: title.clone(),
            x: Axis::linear("log score, less that of the best"),
            y: Axis::names(series.iter().map(|(name, _)| name.clone())),
            layers: vec![zero, Layer::estimates("", Ink::Data(0), rows.collect())],
            notes: Vec::new(),
        }
    };
    Figure {
        name: "ranking".to_string(),
        title: "Measures by how well they predict".to_string(),
        caption: "Log score on held-out cases, less that of the best set, with 95 % limits.".to_string(),
        columns: 1,
        panels: targets.iter().map(panel).collect(),
        ..Figure::default()
    }
}
