//! A figure of our own: annual rates of the limit states at a site.

use super::dots::{self, Dots};
use crate::report::axis::{Axis, range};
use crate::report::data::{Rates, ReportData};
use crate::report::drawing::Ink;
use crate::report::figure::Figure;
use crate::report::text::{Label, number};

/// Draws one figure, one panel a structure.
pub fn figures(data: &ReportData) -> Vec<Figure> {
    if data.rates.is_empty() {
        return Vec::new();
    }
    let rates = data.rates.iter().flat_map(|rates| &rates.states).flat_map(|state| state.annual_rate);
    let [least, largest] = range(rates.filter(|rate| *rate > 0.0));
    let decade = |power: f64| 10_f64.powf(power);
    let ends = [decade(least.log10().floor()), decade(largest.log10().ceil())];
    let x = Axis::log(ends, Label::plain("annual rate"));
    let panel = |rates: &Rates| Dots {
        title: Label::plain(rates.name.as_str()),
        x: x.clone(),
        names: rates.states.iter().map(|state| state.words.clone()).collect(),
        series: vec![(
            "rate",
            Ink::Data(1),
            (0..)
                .zip(&rates.states)
                .map(|(row, state)| dots::estimate(f64::from(row), state.annual_rate, f64::NAN))
                .collect(),
        )],
        mark: None,
    };
    let panels: Vec<Dots> = data.rates.iter().map(panel).collect();
    vec![Figure {
        name: "rates".to_string(),
        title: "Annual rates at the site".to_string(),
        caption: format!(
            "Mean annual rate at which each limit state is reached, with 95 % limits of the fits; they hold neither the error of the hazard nor that of the shape of the curve. The probability in {} years stands in the findings.",
            number::plain(data.rates[0].years)
        ),
        made: String::new(),
        drawing: dots::draw(&panels, 1),
    }]
}
