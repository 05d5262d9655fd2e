//! Probabilities of overturning in rows: names, values with their limits, words beside them, and a target.

use rockfrag_core::statistics::Interval;
use rockfrag_core::statistics::Range;

use crate::chart::{Axis, Ink, LabelPosition, Layer, Mark, MarkStyle, Panel, Words};
use crate::number::{OF_HUNDRED, PERCENT};

/// A row of a panel.
pub struct ProbabilityRow {
    /// Marked text.
    pub name: String,
    /// One below the other.
    pub values: Vec<Value>,
    /// At the right edge.
    pub words: String,
}

/// A probability, in a colour that the legend names.
pub struct Value {
    pub p: Interval<Option<f64>>,
    pub ink: Ink,
    pub label: &'static str,
}

impl ProbabilityRow {
    /// A row of probabilities in one colour, with their values at its end.
    pub fn new(name: &str, ink: Ink, label: &'static str, all: &[Interval<Option<f64>>]) -> ProbabilityRow {
        let words = all.iter().map(|p| match (p.value, p.high) {
            (None, Some(high)) => format!("< {}", OF_HUNDRED.one(high)),
            _ => OF_HUNDRED.value(*p),
        });
        let words = words.collect::<Vec<_>>().join(", ") + " %";
        let values = all.iter().map(|&p| Value { p, ink, label }).collect();
        ProbabilityRow { name: name.to_string(), values, words }
    }
}

/// How far apart the values of a row stand, rows.
const APART: f64 = 0.34;

/// A panel of rows, in percent, over all values and the target.
pub fn panel(title: &str, when: &str, rows: &[ProbabilityRow], target: Option<f64>) -> Panel {
    let (mut layers, mut words): (Vec<Layer>, _) = (Vec::new(), Vec::new());
    let mut ends: Vec<f64> = target.into_iter().collect();
    for (at, row) in rows.iter().enumerate() {
        let y = at as f64;
        words.push(Words {
            x: 0.0,
            y,
            text: row.words.clone(),
            position: LabelPosition::Margin,
            ink: Ink::Text,
        });
        for (place, Value { p, ink, label }) in row.values.iter().enumerate() {
            ends.extend([p.value, p.low, p.high].into_iter().flatten());
            let [x, low, high] = [p.value, p.low, p.high].map(|p| p.map_or(f64::NAN, |p| 100.0 * p));
            let y = y + APART * (place as f64 - 0.5 * (row.values.len() as f64 - 1.0));
            let mark = Mark { low, high, ..Mark::new(x, y) };
            match layers.iter_mut().find(|layer| layer.ink == *ink) {
                Some(layer) => layer.marks.push(mark),
                None => layers.push(Layer::new(label, *ink, MarkStyle::Estimates, [mark])),
            }
        }
    }
    let Range { low, high } = Range::over(ends.into_iter().filter(|p| *p > 0.0).map(|p| 100.0 * p));
    let x = Axis::log(&format!("probability of overturning {when}, %"));
    let x = if low <= high { x.over(low / 1.3, (1.3 * high).min(104.0)) } else { x };
    let names = Axis::names(rows.iter().map(|row| row.name.clone()));
    let mut panel = Panel::new(title, x, names, Vec::new());
    if let Some(target) = target {
        let text = format!("target {}", PERCENT.one(target));
        let words =
            Words { x: 100.0 * target, y: -0.5, text, position: LabelPosition::Above, ink: Ink::Muted };
        panel.add_upright(words, rows.len() as f64 - 0.5);
    }
    panel.layers.extend(layers);
    panel.words.extend(words);
    panel
}
