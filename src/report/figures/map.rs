//! The answer over PGA and PGV: lines of equal probability of overturning, and what came of each motion.

use crate::report::figure::{Axis, Dash, Figure, Ink, Layer, Panel};

/// The probabilities of which lines are drawn.
pub const LEVELS: [f64; 4] = [0.02, 0.1, 0.5, 0.9];

/// A structure under the motions of one suite, over PGA (g) and PGV (m/s).
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Map {
    pub title: String,
    /// Motions in which it rocks, and in which it overturns.
    pub rocks: Vec<[f64; 2]>,
    pub overturns: Vec<[f64; 2]>,
    /// The lines of [`LEVELS`].
    pub lines: [Vec<[f64; 2]>; 4],
    /// Other structures, and their lines of probability 0.5.
    pub others: Vec<(String, Vec<[f64; 2]>)>,
}

/// Maps of overturning, one panel per suite.
pub fn maps(maps: &[Map]) -> Figure {
    Figure {
        name: "map".to_string(),
        title: "Overturning over PGA and PGV".to_string(),
        caption: "Each point is a motion in which the structure rocks. Lines join motions of equal probability of overturning by the model, calibrated with these responses; coloured lines are those of probability 0.5 of other structures."
            .to_string(),
        columns: maps.len().min(2),
        height: 150.0,
        panels: maps.iter().map(panel).collect(),
    }
}

fn panel(of: &Map) -> Panel {
    let mut layers = vec![
        Layer::points("rocks", Ink::Data(0), of.rocks.iter().copied()),
        Layer::points("overturns", Ink::Data(1), of.overturns.iter().copied()),
    ];
    let dashes = [Dash::Short, Dash::Mixed, Dash::Solid, Dash::Long];
    for ((level, dash), line) in LEVELS.iter().zip(dashes).zip(&of.lines) {
        layers.push(Layer::curve(&format!("probability {level}"), Ink::Text, dash, line.clone(), Vec::new()));
    }
    for (number, (name, line)) in (2..).zip(&of.others) {
        layers.push(Layer::line(&format!("{name}, 0.5"), Ink::Data(number), line.clone()));
    }
    Panel {
        title: of.title.clone(),
        x: Axis::log("PGA (g)"),
        y: Axis::log("PGV (m/s)"),
        layers,
        notes: Vec::new(),
    }
}
