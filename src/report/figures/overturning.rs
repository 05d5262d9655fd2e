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

/// Draws the figures over one measure, and those over two if there is a curve of two.
pub fn figures(data: &ReportData) -> Vec<Figure> {
    let groups: Vec<&Group> = data.groups.iter().filter(|group| group.rocked().next().is_some()).collect();
    if groups.is_empty() {
        return Vec::new();
    }
    let over_one =
        [(Measure::Im5, "overturning"), (Measure::Im4, "overturning-im4")].map(|(measure, name)| {
            let curves: Vec<_> =
                groups.iter().map(|group| (*group, group.curve(measure, None).map(|c| c.index))).collect();
            let words = match measure {
                Measure::Im4 => "PGA / (g tan α)",
                _ => "p PGV / (g tan α)",
            };
            figure(&curves, measure, [name, "Overturning over one measure", words, "11"])
        });
    let hybrids: Vec<(&Group, Predictor)> = groups
        .iter()
        .filter_map(|group| Some((*group, group.curves.iter().find(|c| c.index.im_y.is_some())?.index)))
        .collect();
    let over_two = over_hybrids("overturning-hybrid", &hybrids);
    let with_im5: Option<Vec<(&Group, Predictor)>> =
        hybrids.iter().map(|(group, index)| Some((*group, over_im5(index)?))).collect();
    let of_im5 = with_im5.and_then(|hybrids| over_hybrids("overturning-hybrid-im5", &hybrids));
    over_one.into_iter().chain(over_two).chain(of_im5).collect()
}

/// A figure over hybrid measures.
fn over_hybrids(name: &str, hybrids: &[(&Group, Predictor)]) -> Option<Figure> {
    let exponents = hybrids.iter().map(|(group, index)| {
        let [_, b1, b2] = index.coefficients;
        let measures = index.measures().map(Keyword::as_str).collect::<Vec<_>>().join(", ");
        format!("{}: {measures}, λ = {}", group.name(), number::short(b1 / b2))
    });
    let words = format!(
        "the hybrid measure x^(λ/(1+λ)) y^(1/(1+λ)) of Eq. 23 ({}), with limits at the median y of the data",
        exponents.collect::<Vec<_>>().join("; ")
    );
    let curves: Vec<_> = hybrids.iter().map(|(group, index)| (*group, Some(*index))).collect();
    let im_x = hybrids.first()?.1.im_x;
    Some(figure(&curves, im_x, [name, "Overturning over the hybrid measure", &words, "12"]))
}

/// The same curve over IM5 and IM3, or its inverse where IM3 would have a negative power: IM4 is IM5 IM3.
fn over_im5(index: &Predictor) -> Option<Predictor> {
    let (Measure::Im4, Some(Measure::Im3Inverse)) = (index.im_x, index.im_y) else { return None };
    let [b0, b1, b2] = index.coefficients;
    let sign = if b1 > b2 { 1.0 } else { -1.0 };
    let im_y = if b1 > b2 { Measure::Im3 } else { Measure::Im3Inverse };
    // The new coefficients are b0, b1 and the sign times b1 - b2.
    let rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, sign, -sign]];
    let sum = |i: usize, j: usize| -> f64 {
        let pairs = (0..3).flat_map(|k| (0..3).map(move |l| (k, l)));
        pairs.map(|(k, l)| rows[i][k] * index.covariance[k][l] * rows[j][l]).sum()
    };
    let covariance = [0, 1, 2].map(|i| [0, 1, 2].map(|j| sum(i, j)));
    let coefficients = [b0, b1, sign * (b1 - b2)];
    Some(Predictor { im_x: Measure::Im5, im_y: Some(im_y), coefficients, covariance, ..*index })
}

/// Name, title, words of the measure and number in the paper of a figure, of groups and their curves; where there is none, the data lie
/// over `im_x`.
fn figure(
    groups: &[(&Group, Option<Predictor>)],
    im_x: Measure,
    [name, title, measure, of_paper]: [&str; 4],
) -> Figure {
    let grid = Grid::of(groups.len(), 118.0).with_legend();
    let mut drawing = grid.drawing();
    let entries = [
        (Mark::Circle(Ink::Data(0)), Label::plain("share in a bin")),
        (Mark::Line(Ink::Data(1).line(1.3)), Label::plain("curve")),
        (Mark::Area(Ink::Data(1).thin(0.2)), Label::plain("95 % limits")),
    ];
    legend(&mut drawing, grid.legend_at(), &entries);
    for (place, (group, index)) in groups.iter().enumerate() {
        let (corner, width) = grid.place(place);
        draw(&mut drawing, group, (*index, im_x), corner, width, grid.panel_height);
    }
    Figure {
        name: name.to_string(),
        title: title.to_string(),
        caption: format!(
            "Probability of overturning given rocking over {measure}. Circles are the shares of overturning in bins, their area is the number of motions. As Figure {of_paper} of the paper."
        ),
        drawing,
    }
}

fn draw(
    drawing: &mut Drawing,
    group: &Group,
    (index, im_x): (Option<Predictor>, Measure),
    corner: [f64; 2],
    width: f64,
    height: f64,
) {
    let im_y = index.and_then(|index| index.im_y);
    let over = |response: &ReportResponse| match index {
        Some(index) if im_y.is_some() => index.hybrid_measure(&response.case.measures),
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
