//! Annual rates: of a list of objects, and of the limit states of one.

use crate::report::figure::{Axis, Estimate, Figure, Ink, Layer, Panel};

/// The annual rate of an object, or of a limit state, with limits.
#[derive(Debug, Clone, PartialEq)]
pub struct AnnualRate {
    pub name: String,
    pub rate: f64,
    /// NaN where there are none.
    pub low: f64,
    pub high: f64,
}

/// Annual rates of overturning of a list of objects, one row an object in their order.
pub fn list(objects: &[AnnualRate]) -> Figure {
    rows("list", "How often each object overturns", "annual rate of overturning", objects)
}

/// Annual rates of the limit states of one object.
pub fn rates(states: &[AnnualRate]) -> Figure {
    rows("rates", "How often it reaches each limit state", "annual rate", states)
}

fn rows(name: &str, title: &str, label: &str, rates: &[AnnualRate]) -> Figure {
    let estimate = |(row, rate): (usize, &AnnualRate)| {
        let AnnualRate { rate, low, high, .. } = *rate;
        Estimate { x: rate, y: row as f64, low, high, n: f64::NAN }
    };
    Figure {
        name: name.to_string(),
        title: title.to_string(),
        caption: "Annual rates with the 95 % limits of the model.".to_string(),
        columns: 1,
        panels: vec![Panel {
            x: Axis::log(label),
            y: Axis::names(rates.iter().map(|rate| rate.name.clone())),
            layers: vec![Layer::estimates(
                "",
                Ink::Data(1),
                rates.iter().enumerate().map(estimate).collect(),
            )],
            ..Panel::default()
        }],
        ..Figure::default()
    }
}
