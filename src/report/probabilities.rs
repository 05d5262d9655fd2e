//! Probabilities in rows: names, values with their limits, words beside them, and a target.

use super::figure::{Axis, Ink, Layer, Mark, Panel, Shape, Side, Span, Words};
use crate::number::{Limited, OF_HUNDRED, PERCENT};

/// A row of a panel.
pub struct Row {
    /// Marked text.
    pub name: String,
    /// Probabilities in their colours, one below the other.
    pub values: Vec<(Ink, Limited)>,
    /// At the right edge.
    pub words: String,
}

impl Row {
    /// A row of probabilities in one colour, with their values at its end.
    pub fn new(name: &str, ink: Ink, all: &[Limited]) -> Row {
        let words: Vec<String> = all
            .iter()
            .map(|p| match (p.value, p.high) {
                (None, Some(high)) => format!("< {}", OF_HUNDRED.one(high)),
                _ => OF_HUNDRED.value(*p),
            })
            .collect();
        let values = all.iter().map(|p| (ink, *p)).collect();
        Row { name: name.to_string(), values, words: words.join(", ") + " %" }
    }
}

/// How far apart the values of a row stand, rows.
const APART: f64 = 0.34;

/// An axis in percent over all of these.
pub fn axis(label: &str, all: impl IntoIterator<Item = Limited>) -> Axis {
    let ends = all.into_iter().flat_map(|p| [p.value, p.low, p.high]).flatten();
    let Span { low, high } = Span::from_values(ends.filter(|p| *p > 0.0).map(|p| 100.0 * p));
    let axis = Axis::log(&format!("{label}, %"));
    if low <= high { axis.over(low / 1.3, (1.3 * high).min(104.0)) } else { axis }
}

/// A panel of rows; `labels` name the colours in the legend, the last one drawn last.
pub fn panel(title: &str, x: Axis, rows: &[Row], labels: &[(Ink, &str)], target: Option<f64>) -> Panel {
    let names = Axis::names(rows.iter().map(|row| row.name.clone()));
    let mut panel = Panel::new(title, x, names, Vec::new());
    if let Some(target) = target {
        let text = format!("target {}", PERCENT.one(target));
        let words = Words { x: 100.0 * target, y: -0.5, text, side: Side::Above, ink: Ink::Muted };
        panel.add_upright(words, rows.len() as f64 - 0.5);
    }
    for (ink, label) in labels {
        let mut marks = Vec::new();
        for (at, row) in rows.iter().enumerate() {
            let middle = 0.5 * (row.values.len() as f64 - 1.0);
            for (place, (_, p)) in row.values.iter().enumerate().filter(|(_, (own, _))| own == ink) {
                let [x, low, high] = [p.value, p.low, p.high].map(|p| p.map_or(f64::NAN, |p| 100.0 * p));
                let y = at as f64 + APART * (place as f64 - middle);
                marks.push(Mark { low, high, ..Mark::new(x, y) });
            }
        }
        if !marks.is_empty() {
            panel.layers.push(Layer::new(label, *ink, Shape::Estimates, marks));
        }
    }
    for (at, row) in rows.iter().enumerate() {
        let (y, text) = (at as f64, row.words.clone());
        panel.words.push(Words { x: 0.0, y, text, side: Side::Margin, ink: Ink::Text });
    }
    panel
}
