//! A figure of our own: what other measures gain over those of the paper.

use super::dots::{self, Dots};
use crate::fragility::probability::Z_95;
use crate::report::axis::{Axis, range};
use crate::report::data::{Ranking, ReportData};
use crate::report::drawing::Ink;
use crate::report::figure::Figure;
use crate::report::text::Label;

/// Draws one figure, one panel a structure, suite and target.
pub fn figures(data: &ReportData) -> Vec<Figure> {
    if data.rankings.is_empty() {
        return Vec::new();
    }
    let panels: Vec<Dots> = data.rankings.iter().map(panel).collect();
    vec![Figure {
        name: "ranking".to_string(),
        title: "Other measures beside those of the paper".to_string(),
        caption: "Gain in log score on held-out cases over the model of Dimitrakopoulos & Paraskeva (2015), with 95 % limits: to the right of the line a set of measures predicts better. Drawn are the best of one, two and three measures and the steps of forward selection; all others are in the table.".to_string(),
        made: String::new(),
        drawing: dots::draw(&panels, panels.len().min(2)),
    }]
}

fn panel(Ranking { name, candidates }: &Ranking) -> Dots {
    let limits = |gain: f64, error: f64| [gain, gain - Z_95 * error, gain + Z_95 * error];
    let [low, high] =
        range(candidates.iter().flat_map(|(_, gain, error)| limits(*gain, *error)).chain([0.0]));
    let margin = 0.05 * (high - low).max(1e-3);
    let row = |(row, (_, gain, error)): (i32, &(String, f64, f64))| {
        dots::estimate(f64::from(row), limits(*gain, *error), f64::NAN)
    };
    Dots {
        title: Label::plain(name.as_str()),
        x: Axis::linear([low - margin, high + margin], Label::plain("gain in log score")),
        names: candidates.iter().map(|(measures, ..)| measures.clone()).collect(),
        series: vec![("gain", Ink::Data(0), (0..).zip(candidates).map(row).collect())],
        mark: Some(0.0),
    }
}
