//! Figures 10, 11 and 12: probabilities over a measure, with the observed shares.

use super::compare;
use crate::report::figure::{Axis, Dash, Estimate, Figure, Ink, Layer, Panel};

/// A curve over a measure: values, and limits at each of them, or none.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Curve {
    /// What it is, for the legend where a structure has several.
    pub label: String,
    pub points: Vec<[f64; 2]>,
    pub band: Vec<[f64; 2]>,
}

/// The curves of one structure, drawn in one colour, and the observed shares of its motions (may be empty).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StructureCurves {
    pub name: String,
    /// Up to four, told apart by dashes: curves of the same place must have the same label for all
    /// structures.
    pub curves: Vec<Curve>,
    pub shares: Vec<Estimate>,
}

/// Structures over one measure.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ProbabilityPanel {
    pub title: String,
    /// Marked label of the measure.
    pub measure: String,
    pub structures: Vec<StructureCurves>,
    /// Short lines within the panel, such as how well each structure's curve predicts the other.
    pub notes: Vec<String>,
}

/// What the notes in a panel say.
const SCORES: &str = "In the corner, for each structure: the mean log score of its own curve and of the other's on its cases, the nearer to 0 the better.";
const DASHES: [Dash; 4] = [Dash::Solid, Dash::Long, Dash::Short, Dash::Mixed];

/// Figure 10: probability of exceeding the limit state in safe rocking by two measures and by one.
pub fn exceedance(panels: &[ProbabilityPanel]) -> Figure {
    figure(
        ["exceedance", "Exceeding the limit state in safe rocking", "*P*_{ex}"],
        format!(
            "Probability of exceeding the limit state by the two planes, at quantiles of IM3, and by IM4 alone. {}",
            compare("Figure 10")
        ),
        panels,
    )
}

/// Figure 11: probability of overturning over single measures.
pub fn overturning(panels: &[ProbabilityPanel]) -> Figure {
    figure(
        ["overturning", "Overturning over single measures", "*P*_{ro}"],
        format!(
            "Lognormal curves with 95 % bands, and observed fractions with 95 % limits. {SCORES} {}",
            compare("Figure 11")
        ),
        panels,
    )
}

/// Figure 12: probability of overturning over hybrid measures (Eq. 23).
pub fn hybrids(panels: &[ProbabilityPanel]) -> Figure {
    figure(
        ["overturning-hybrid", "Overturning over hybrid measures", "*P*_{ro}"],
        format!(
            "Lognormal curves over the hybrid measure of each structure (Eq. 23) with 95 % bands, and observed fractions with 95 % limits. {SCORES} {}",
            compare("Figure 12")
        ),
        panels,
    )
}

fn figure([name, title, probability]: [&str; 3], caption: String, panels: &[ProbabilityPanel]) -> Figure {
    let mut names: Vec<&str> = Vec::new();
    for structure in panels.iter().flat_map(|panel| &panel.structures) {
        if !names.contains(&structure.name.as_str()) {
            names.push(&structure.name);
        }
    }
    Figure {
        name: name.to_string(),
        title: title.to_string(),
        caption,
        columns: panels.len().min(2),
        height: 118.0,
        panels: panels.iter().map(|of| panel(of, probability, &names)).collect(),
    }
}

/// Draws each structure in the colour of its place among the names, so that it has one in all panels.
fn panel(of: &ProbabilityPanel, probability: &str, names: &[&str]) -> Panel {
    let ink = |structure: &StructureCurves| {
        Ink::Data(names.iter().position(|name| *name == structure.name).unwrap_or(0))
    };
    let mut layers = Vec::new();
    for structure in &of.structures {
        for (place, (curve, dash)) in structure.curves.iter().zip(DASHES).enumerate() {
            // The legend names the structure by its first curve.
            let label = if place == 0 { structure.name.as_str() } else { "" };
            layers.push(Layer::curve(label, ink(structure), dash, curve.points.clone(), curve.band.clone()));
        }
    }
    // Layers of nothing, for the legend: what the dashes and the dots mean.
    let most = of.structures.iter().map(|structure| &structure.curves[..]).max_by_key(|curves| curves.len());
    for (curve, dash) in most.filter(|curves| curves.len() > 1).unwrap_or_default().iter().zip(DASHES) {
        layers.push(Layer::curve(&curve.label, Ink::Muted, dash, Vec::new(), Vec::new()));
    }
    for structure in of.structures.iter().filter(|structure| !structure.shares.is_empty()) {
        layers.push(Layer::estimates("observed fraction", Ink::Muted, Vec::new()));
        layers.push(Layer::estimates("", ink(structure), structure.shares.clone()));
    }
    Panel {
        title: of.title.clone(),
        x: Axis::log(&of.measure),
        y: Axis::probability(probability),
        layers,
        notes: of.notes.clone(),
    }
}
