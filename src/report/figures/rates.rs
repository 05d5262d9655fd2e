//! Annual rates: at a site, and of a list of objects.

use crate::report::figure::{Axis, Estimate, Figure, Ink, Layer, Marks, Panel};

/// The hazard of a site, and what each strength of motion adds to the rates of a structure.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SiteRates {
    pub structure: String,
    /// Marked label of the measure of the hazard, with its unit.
    pub measure: String,
    /// Values of the measure and annual rates of exceedance.
    pub hazard: Vec<[f64; 2]>,
    /// Name of a limit state; first and last value of the measure, and the share of the annual rate that comes from between them.
    pub contributions: Vec<(String, Vec<[f64; 3]>)>,
}

/// The annual rate of an object, with limits.
#[derive(Debug, Clone, PartialEq)]
pub struct ObjectRate {
    pub name: String,
    pub rate: f64,
    /// NaN where there are none.
    pub low: f64,
    pub high: f64,
}

/// Annual rates at a site: the hazard, and from which motions the rates of the limit states come.
pub fn rates(site: &SiteRates) -> Figure {
    let hazard = Panel {
        title: "Hazard".to_string(),
        x: Axis::log(&site.measure),
        y: Axis::log("annual rate of exceedance"),
        layers: vec![
            Layer::line("", Ink::Data(0), site.hazard.clone()),
            Layer::points("", Ink::Data(0), site.hazard.clone()),
        ],
        notes: Vec::new(),
    };
    let contributions = site.contributions.iter().map(|(state, bars)| Panel {
        title: format!("{}: {state}", site.structure),
        x: Axis::log(&site.measure),
        y: Axis::linear("share of the rate")
            .over(0.0, 1.05 * bars.iter().map(|bar| bar[2]).fold(1e-9, f64::max)),
        layers: vec![Layer { label: String::new(), ink: Ink::Data(1), marks: Marks::Bars(bars.clone()) }],
        notes: Vec::new(),
    });
    let panels: Vec<Panel> = [hazard].into_iter().chain(contributions).collect();
    Figure {
        name: "rates".to_string(),
        title: "Where the annual rate comes from".to_string(),
        caption:
            "The hazard of the site, and the share of the annual rate that motions of each strength add."
                .to_string(),
        columns: panels.len().min(3),
        height: 105.0,
        panels,
    }
}

/// Annual rates of a list of objects, one row an object in their order.
pub fn list(objects: &[ObjectRate]) -> Figure {
    let rate = |(row, object): (usize, &ObjectRate)| {
        let ObjectRate { rate, low, high, .. } = *object;
        Estimate { x: rate, y: row as f64, low, high, n: f64::NAN }
    };
    Figure {
        name: "list".to_string(),
        title: "How often each object overturns".to_string(),
        caption: "Annual rate of overturning with 95 % limits.".to_string(),
        columns: 1,
        panels: vec![Panel {
            x: Axis::log("annual rate of overturning"),
            y: Axis::names(objects.iter().map(|object| object.name.clone())),
            layers: vec![Layer::estimates("", Ink::Data(1), objects.iter().enumerate().map(rate).collect())],
            ..Panel::default()
        }],
        ..Figure::default()
    }
}
