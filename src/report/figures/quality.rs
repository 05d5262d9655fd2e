//! Figure 8 as dots: how well each measure predicts the demand, by R2, beta and zeta.

use super::dots::{self, Dots};
use crate::fragility::Measure;
use crate::report::axis::Axis;
use crate::report::data::{Group, Regression, ReportData};
use crate::report::drawing::Ink;
use crate::report::figure::Figure;
use crate::report::panel::Estimate;
use crate::report::text::Label;

/// Largest zeta that is drawn, over the least: what lies beyond predicts nothing.
const MOST_ZETA: f64 = 5.0;

/// A measure of quality.
struct Quality {
    title: &'static str,
    symbol: &'static str,
    of: fn(&Regression) -> Option<f64>,
}

const QUALITIES: [Quality; 3] = [
    Quality { title: "more is better", symbol: "*R*^{2}", of: |regression| Some(regression.r2) },
    Quality { title: "less is better", symbol: "*β*", of: |regression| Some(regression.law.beta) },
    Quality { title: "less is better", symbol: "*ζ* = *β* / *b*", of: zeta },
];

fn zeta(regression: &Regression) -> Option<f64> {
    let zeta = regression.law.beta / regression.law.ln_median.coefficients[1];
    (regression.rises && zeta > 0.0).then_some(zeta)
}

/// Draws one figure a group that has regressions.
pub fn figures(data: &ReportData) -> Vec<Figure> {
    data.groups.iter().filter(|group| !group.univariate.is_empty()).map(figure).collect()
}

fn figure(group: &Group) -> Figure {
    let names: Vec<String> = (1..=Measure::SCALAR.len()).map(|k| format!("IM{k}")).collect();
    let panels: Vec<Dots> = QUALITIES
        .iter()
        .map(|Quality { title, symbol, of }| {
            let values: Vec<(usize, f64)> = Measure::SCALAR
                .iter()
                .enumerate()
                .filter_map(|(row, measure)| Some((row, group.on(*measure).and_then(of)?)))
                .collect();
            let [least, largest] = values.iter().fold([f64::INFINITY, 0.0_f64], |[low, high], (_, value)| {
                [low.min(*value), high.max(*value)]
            });
            let end = 1.08 * largest.min(MOST_ZETA.max(1.0) * least.max(0.2));
            let point = |(row, value): (usize, f64)| Estimate {
                at: [value, row as f64],
                low: value,
                high: value,
                n: f64::NAN,
                radius: 2.2,
            };
            Dots {
                title: Label::plain(*title),
                x: Axis::linear([0.0, end], Label::marked(symbol)),
                names: names.clone(),
                series: vec![("regression", Ink::Data(0), values.into_iter().map(point).collect())],
                mark: None,
            }
        })
        .collect();
    Figure {
        name: format!("quality-{}", super::group_file_words(group)),
        title: format!("Quality of the six measures: {}", group.name()),
        caption: format!(
            "Coefficient of determination R², dispersion β and modified dispersion ζ of the regression of the demand on each measure. A row without a dot has no such number, as ζ where the demand falls with the measure, or one far to the right of the others. {}",
            super::of_paper("Figure 8")
        ),
        made: String::new(),
        drawing: dots::draw(&panels, panels.len()),
    }
}
