//! A figure of our own: what was seen of other motions, and what the curves predicted.

use super::dots::{self, Dots};
use crate::report::axis::Axis;
use crate::report::data::ReportData;
use crate::report::drawing::Ink;
use crate::report::figure::Figure;
use crate::report::text::{Label, number};

/// The most rows, the others are in the table.
const MOST: usize = 60;
/// How far the two points of a row stand apart, of its height.
const APART: f64 = 0.18;

/// Draws one figure, one row an event.
pub fn figures(data: &ReportData) -> Vec<Figure> {
    if data.validations.is_empty() {
        return Vec::new();
    }
    let rows = &data.validations[..data.validations.len().min(MOST)];
    let of = |by: f64, seen: bool| {
        let rows = (0..).zip(rows);
        rows.map(|(row, of)| {
            let share = if seen { of.seen } else { of.expected };
            dots::estimate(f64::from(row) + by, share, of.n as f64)
        })
        .collect()
    };
    let panel = Dots {
        title: Label::plain("share of the cases"),
        x: Axis::linear([0.0, 1.0], Label::plain("share")),
        names: rows.iter().map(|of| of.name.clone()).collect(),
        series: vec![("seen", Ink::Data(0), of(-APART, true)), ("predicted", Ink::Data(1), of(APART, false))],
        mark: None,
    };
    let off = rows.iter().filter(|of| of.chance_p < 0.05).count();
    vec![Figure {
        name: "validation".to_string(),
        title: "Shares of events, seen and predicted".to_string(),
        caption: format!(
            "Share of the cases in which the event happened, with 95 % limits (Wilson), and the mean of the predicted probabilities, with its limits. In {} of {} rows the count is further out than chance allows at 5 %. Agreement proves nothing where the curves were fitted to the same motions.",
            number::count(off),
            number::count(rows.len())
        ),
        made: String::new(),
        drawing: dots::draw(&[panel], 1),
    }]
}
