//! Figures of our own: annual rates of the limit states at a site, and the hazard that they are over.

use super::dots::{self, Dots};
use crate::report::axis::{Axis, range};
use crate::report::data::{By, Hazard, PeakCurve, Rates, ReportData, peak_label};
use crate::report::drawing::{Drawing, Ink};
use crate::report::figure::{Figure, Grid};
use crate::report::findings::without_surface;
use crate::report::panel::Panel;
use crate::report::text::{Label, number};

/// The most panels of hazard curves.
const MOST: usize = 8;

/// Draws the rates, one panel a structure, and the hazard, one panel a curve.
pub fn figures(data: &ReportData) -> Vec<Figure> {
    if data.rates.is_empty() {
        return Vec::new();
    }
    let mut hazards: Vec<&Hazard> = Vec::new();
    for hazard in data.rates.iter().filter_map(|rates| rates.hazard.as_ref()) {
        if !hazards.contains(&hazard) {
            hazards.push(hazard);
        }
    }
    [rates(data)].into_iter().chain(hazard(&hazards)).collect()
}

/// An axis from power of ten to power of ten.
fn decades(values: impl Iterator<Item = f64>, label: Label) -> Axis {
    let [least, largest] = range(values.filter(|value| *value > 0.0));
    let decade = |power: f64| libm::pow(10.0, power);
    Axis::log([decade(libm::log10(least).floor()), decade(libm::log10(largest).ceil())], label)
}

fn rates(data: &ReportData) -> Figure {
    let rates = data.rates.iter().flat_map(|rates| &rates.states).flat_map(|state| state.annual_rate);
    let x = decades(rates, Label::plain("annual rate"));
    let panel = |rates: &Rates| Dots {
        title: Label::plain(rates.name.as_str()),
        x: x.clone(),
        // The title says it.
        names: rates.states.iter().map(|state| without_surface(&state.words).to_string()).collect(),
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
    let of_surface = "of the universal surface, for a structure that it has not seen";
    let limits = match [By::Fits, By::Surface].map(|by| data.has_rates_by(by)) {
        [_, false] => "of the fits".to_string(),
        [false, true] => of_surface.to_string(),
        [true, true] => format!("of the fits or {of_surface}"),
    };
    Figure {
        name: "rates".to_string(),
        title: "Annual rates at the site".to_string(),
        caption: format!(
            "Mean annual rate at which each limit state is reached, with 95 % limits {limits}; they cover neither the error of the hazard nor that of the shape of the curve. The probability in {} years stands in the findings.",
            number::plain(data.rates[0].years)
        ),
        made: String::new(),
        drawing: dots::draw(&panels, 1),
    }
}

fn hazard<'h>(hazards: &[&'h Hazard]) -> Option<Figure> {
    let of = |hazard: &&'h Hazard| hazard.curves.iter().map(|curve| (hazard.file.as_str(), curve));
    let curves: Vec<(&str, &PeakCurve)> = hazards.iter().flat_map(of).take(MOST).collect();
    if curves.is_empty() {
        return None;
    }
    let grid = Grid::of(curves.len(), 118.0);
    let mut drawing = grid.drawing();
    for (index, (file, curve)) in curves.into_iter().enumerate() {
        let (corner, width) = grid.place(index);
        draw(&mut drawing, file, curve, corner, width, grid.panel_height);
    }
    let words: Vec<String> = hazards.iter().map(|hazard| hazard.words()).collect();
    Some(Figure {
        name: "hazard".to_string(),
        title: "The hazard at the site".to_string(),
        caption: format!(
            "The hazard behind the rates: how often motions of each strength come to the site. {}. Between the points of a curve, ln rate is linear in ln PGA or ln PGV.",
            words.join("; ")
        ),
        made: String::new(),
        drawing,
    })
}

fn draw(
    drawing: &mut Drawing,
    file: &str,
    PeakCurve { peak, points }: &PeakCurve,
    corner: [f64; 2],
    width: f64,
    height: f64,
) {
    let size = peak.usual_unit().1;
    let curve: Vec<[f64; 2]> = points.iter().map(|(value, rate)| [value / size, *rate]).collect();
    let x = Axis::log_over(curve.iter().map(|point| point[0]), peak_label(*peak));
    let y = decades(curve.iter().map(|point| point[1]), Label::plain("annual rate of exceedance"));
    let panel = Panel { corner, width, height, x, y };
    panel.line(drawing, &curve, Ink::Data(1).line(1.3));
    panel.scatter(drawing, "hazard", &curve, 1.3, Ink::Data(1).full());
    panel.frame(drawing, Label::plain(file).bold());
}
