//! A figure of our own: shares of scaled motions that overturn a structure, from the incremental dynamic analysis.

use crate::report::axis::Axis;
use crate::report::data::{Analysis, ReportData, scaled_words};
use crate::report::drawing::Ink;
use crate::report::figure::{Figure, Grid};
use crate::report::panel::{Estimate, Mark, Panel};
use crate::report::text::{Label, number};

/// The most panels, the others are in the table.
const MOST: usize = 8;

/// Draws the figure where it says more than curves of few events.
pub fn first(data: &ReportData) -> Vec<Figure> {
    if data.has_few_events() { figure(data) } else { Vec::new() }
}

/// Draws it elsewhere.
pub fn after(data: &ReportData) -> Vec<Figure> {
    if data.has_few_events() { Vec::new() } else { figure(data) }
}

/// Draws one figure, one panel a structure and suite.
fn figure(data: &ReportData) -> Vec<Figure> {
    if data.analyses.is_empty() {
        return Vec::new();
    }
    let shown = &data.analyses[..data.analyses.len().min(MOST)];
    let entries = [
        (Mark::Bar(Ink::Data(0)), Label::plain("share at a level")),
        (Mark::Line(Ink::Data(1).line(1.3)), Label::plain("lognormal, at it or below")),
    ];
    let (grid, mut drawing) = Grid::of(shown.len(), 118.0).with_legend(&entries);
    for (index, analysis) in shown.iter().enumerate() {
        let (corner, width) = grid.place(index);
        draw(&mut drawing, analysis, corner, width, grid.panel_height);
    }
    let middles = shown.iter().map(|Analysis { name, theta, .. }| match theta {
        Some(theta) => format!("{name}: {}", number::with_limits(*theta, 3)),
        None => format!("{name}: none"),
    });
    vec![Figure {
        name: "ida".to_string(),
        title: "Incremental dynamic analysis".to_string(),
        caption: format!(
            "Share of the scaled motions that overturn the structure at each level, with 95 % limits (Wilson), and the lognormal distribution of the lowest intensities that do. The two differ where structures survive stronger motions than some that overturn them. Medians of the lowest {}: {}.",
            scaled_words(&shown[0].measure),
            middles.collect::<Vec<_>>().join("; ")
        ),
        made: String::new(),
        drawing,
    }]
}

fn draw(
    drawing: &mut crate::report::Drawing,
    analysis: &Analysis,
    corner: [f64; 2],
    width: f64,
    height: f64,
) {
    let intensities = || analysis.levels.iter().map(|level| level.intensity);
    let x = Axis::log_over(intensities(), Label::plain(scaled_words(&analysis.measure)));
    let y = Axis::linear([-0.04, 1.04], Label::plain("share that overturns"));
    let panel = Panel { corner, width, height, x, y };
    let estimates: Vec<Estimate> = analysis
        .levels
        .iter()
        .map(|level| {
            let [share, low, high] = level.share;
            Estimate { at: [level.intensity, share], low, high, n: level.n as f64, radius: 1.3 }
        })
        .collect();
    panel.estimates(drawing, "share at a level", &estimates, Ink::Data(0));
    let curve: Vec<[f64; 2]> =
        analysis.levels.iter().filter_map(|level| Some([level.intensity, level.lognormal?])).collect();
    panel.curve(drawing, "lognormal", &curve, Ink::Data(1).line(1.3));
    panel.frame(drawing, Label::plain(analysis.name.as_str()).bold());
}
