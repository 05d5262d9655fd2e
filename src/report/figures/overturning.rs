//! Figures 11 and 12: the probability of overturning, with the data in bins.

use super::{by_ratio, sorted};
use crate::fragility::{Measure, Predictor, Probability, ProbitIndex};
use crate::keyword::Keyword;
use crate::motion::IntensityMeasures;
use crate::report::axis::Axis;
use crate::report::data::{Group, ReportData, ReportResponse, measure_label};
use crate::report::drawing::{Anchor, Drawing, Ink};
use crate::report::figure::{Figure, Grid};
use crate::report::panel::{Mark, Panel, legend};
use crate::report::text::{Label, number};
use crate::statistics::estimate::quantile;

/// Number of points of a curve.
const STEPS: usize = 160;
/// Number of bins of the data.
const BINS: usize = 14;
/// Radius of the circle of the fullest bin, points.
const LARGEST: f64 = 8.0;

/// Draws the figure over one measure, and that over two if there is a curve of two.
pub fn figures(data: &ReportData) -> Vec<Figure> {
    let groups: Vec<&Group> = data.groups.iter().filter(|group| group.rocked().next().is_some()).collect();
    if groups.is_empty() {
        return Vec::new();
    }
    let of_two = groups
        .iter()
        .flat_map(|group| &group.curves)
        .find_map(|curve| Some((curve.index.im_x, curve.index.im_y?)));
    let over_one = figure(&groups, Measure::Im5, None);
    let over_two = of_two.map(|(x, y)| {
        let with_curve = |group: &&Group| group.curve(x, Some(y)).is_some();
        figure(&groups.iter().copied().filter(with_curve).collect::<Vec<_>>(), x, Some(y))
    });
    std::iter::once(over_one).chain(over_two).collect()
}

fn figure(groups: &[&Group], im_x: Measure, im_y: Option<Measure>) -> Figure {
    let grid = Grid::of(groups.len(), 118.0).with_legend();
    let mut drawing = grid.drawing();
    let entries = [
        (Mark::Circle(Ink::Data(0)), Label::plain("share in a bin")),
        (Mark::Line(Ink::Data(1).line(1.3)), Label::plain("curve")),
        (Mark::Area(Ink::Data(1).thin(0.2)), Label::plain("95 % limits")),
    ];
    legend(&mut drawing, grid.legend_at(), &entries);
    for (index, group) in groups.iter().enumerate() {
        let (corner, width) = grid.place(index);
        draw(&mut drawing, group, (im_x, im_y), corner, width, grid.panel_height);
    }
    let (name, title, measure, number) = match im_y {
        None => ("overturning", "Overturning over one measure", "p PGV / (g tan α)".to_string(), 11),
        Some(im_y) => {
            let exponents = groups.iter().filter_map(|group| {
                let index = group.curve(im_x, Some(im_y))?.index;
                let [_, b1, b2] = index.coefficients;
                Some(format!("{}: λ = {}", group.name(), number::short(b1 / b2)))
            });
            let exponents = exponents.collect::<Vec<_>>().join("; ");
            let (x, y) = (im_x.as_str(), im_y.as_str());
            let words = format!(
                "the hybrid measure {x}^(λ/(1+λ)) {y}^(1/(1+λ)) of Eq. 23 ({exponents}), with limits at the median {y} of the data"
            );
            ("overturning-hybrid", "Overturning over the hybrid measure", words, 12)
        }
    };
    Figure {
        name: name.to_string(),
        title: title.to_string(),
        caption: format!(
            "Probability of overturning given rocking over {measure}. Circles are the shares of overturning in bins, their area is the number of motions. As Figure {number} of the paper."
        ),
        drawing,
    }
}

fn draw(
    drawing: &mut Drawing,
    group: &Group,
    (im_x, im_y): (Measure, Option<Measure>),
    corner: [f64; 2],
    width: f64,
    height: f64,
) {
    let index = group.curve(im_x, im_y).map(|curve| curve.index);
    let over = |response: &ReportResponse| match (index, im_y) {
        (Some(index), Some(_)) => index.hybrid_measure(&response.case.measures),
        (None, Some(_)) => None,
        _ => im_x.of(&response.case),
    };
    let values: Vec<[f64; 2]> = group
        .rocked()
        .filter_map(|(response, overturned)| Some([over(response)?, f64::from(u8::from(overturned))]))
        .collect();
    let label = if im_y.is_some() { Label::plain("hybrid measure") } else { measure_label(im_x) };
    let x = Axis::log_over(values.iter().map(|[x, _]| *x), label);
    let y = Axis::linear([-0.04, 1.04], Label::marked("*P*_{ro}"));
    let panel = Panel { corner, width, height, x, y };
    if let Some(index) = index {
        let second = im_y.map(|im_y| {
            let values = sorted(group.rocked().filter_map(|(response, _)| im_y.of(&response.case)));
            (im_y, quantile(&values, 0.5))
        });
        let curve: Vec<(f64, Probability)> = panel
            .x
            .steps(STEPS)
            .filter_map(|value| Some((value, probability(&index, value, second)?)))
            .collect();
        super::draw_curve(drawing, &panel, &curve, Ink::Data(1).line(1.3));
    } else {
        panel.note(
            drawing,
            [0.04, 0.12],
            Anchor::Start,
            Label::plain("no curve: see the status in the table"),
        );
    }
    let bins = by_ratio(&values, [panel.x.low, panel.x.high], BINS);
    let most = bins.iter().map(|(_, inside)| inside.len()).max().unwrap_or(1).max(1) as f64;
    let circles: Vec<([f64; 2], f64)> = bins
        .iter()
        .filter(|(_, inside)| !inside.is_empty())
        .map(|(x, inside)| {
            let count = inside.len() as f64;
            let share = inside.iter().sum::<f64>() / count;
            ([*x, share], (LARGEST * (count / most).sqrt()).max(1.0))
        })
        .collect();
    panel.circles(drawing, &circles, Ink::Data(0));
    panel.frame(drawing, Label::plain(group.name()).bold());
    let (cases, events) = (values.len(), values.iter().filter(|[_, event]| *event > 0.0).count());
    let words = format!("{} of {}", number::count(events), number::count(cases));
    panel.note(drawing, [0.04, 0.24], Anchor::Start, Label::plain(words));
}

/// Predicts the probability at a value of the measure, or of the hybrid measure where the second measure is this.
fn probability(index: &Predictor, value: f64, second: Option<(Measure, f64)>) -> Option<Probability> {
    let measures: IntensityMeasures = match second {
        None => super::with(super::NOTHING, index.im_x, value),
        Some((im_y, at)) => {
            let [_, b1, b2] = index.coefficients;
            let im_x = ((b1 + b2) / b1 * value.ln() - b2 / b1 * at.ln()).exp();
            super::with(super::with(super::NOTHING, index.im_x, im_x), im_y, at)
        }
    };
    let predicted = index.at(&measures)?;
    Some(ProbitIndex { value: predicted.value, standard_error: predicted.variance.sqrt() }.probability())
}
