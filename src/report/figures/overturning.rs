//! Figures 11 and 12: the probability of overturning, with the data in bins.

use super::sorted;
use crate::fragility::overturning::LEAST_EVENTS;
use crate::fragility::{Gap, Measure, Predictor, Probability, ProbitIndex};
use crate::keyword::Keyword;
use crate::motion::IntensityMeasures;
use crate::normal;
use crate::report::axis::{Axis, range};
use crate::report::data::{Curve, Group, ReportData, ReportResponse, measure_label};
use crate::report::drawing::{Anchor, Dash, Drawing, Ink};
use crate::report::figure::{Figure, Grid};
use crate::report::panel::{Estimate, Mark, Panel};
use crate::report::text::{Label, number};
use crate::statistics::FitStatus;
use crate::statistics::estimate::quantile;
use crate::studies::wilson_limits;

/// Number of points of a curve.
const STEPS: usize = 160;
/// The most bins of the data, the fewest, and how many cases there should be for each.
const BINS: usize = 14;
const FEWEST_BINS: usize = 4;
const CASES: usize = 8;
/// Radii of the dots of the emptiest and of the fullest bin, points.
const RADII: [f64; 2] = [0.9, 3.6];
/// How far beyond the data a curve is drawn at most, as a ratio, and where it counts as at its end.
const FURTHEST: f64 = 3.0;
const END: f64 = 0.99;
/// A probability that is reached within the furthest: a curve that is below is not drawn beyond the data.
const NEAR_END: f64 = 0.9;

/// Draws the figure over p PGV / (g tan alpha), and that over the hybrid measure if there is one.
pub fn figures(data: &ReportData) -> Vec<Figure> {
    let over_two = over_hybrids("overturning-hybrid", &hybrids(data));
    over_one(data, Measure::Im5, "overturning").into_iter().chain(over_two).collect()
}

/// Draws what says the same over other measures.
pub fn further(data: &ReportData) -> Vec<Figure> {
    let with_im5: Option<Vec<(&Group, Curve)>> = hybrids(data)
        .into_iter()
        .map(|(group, curve)| Some((group, Curve { index: over_im5(&curve.index)?, ..curve })))
        .collect();
    let of_im5 = with_im5.and_then(|hybrids| over_hybrids("overturning-hybrid-im5", &hybrids));
    over_one(data, Measure::Im4, "overturning-im4").into_iter().chain(of_im5).collect()
}

fn rocking(data: &ReportData) -> impl Iterator<Item = &Group> {
    data.groups.iter().filter(|group| group.rocked().next().is_some())
}

fn hybrids(data: &ReportData) -> Vec<(&Group, Curve)> {
    let hybrid = |group: &Group| group.curves.iter().find(|curve| curve.index.im_y.is_some()).copied();
    let with_curve = rocking(data).filter(|group| group.has_curve());
    with_curve.filter_map(|group| Some((group, hybrid(group)?))).collect()
}

fn over_one(data: &ReportData, measure: Measure, name: &str) -> Option<Figure> {
    // From fewer events the band of a curve goes from 0 to 1, and the curve says nothing.
    let curve = |group: &&Group| group.curve(measure, None).copied().filter(|_| group.has_curve());
    let curves: Vec<_> = rocking(data).map(|group| (group, curve(&group))).collect();
    let words = measure_label(measure).words();
    let title = format!("Overturning over {words}");
    (!curves.is_empty()).then(|| figure(&curves, measure, [name, &title, &words, "Figure 11"]))
}

/// A figure over hybrid measures.
fn over_hybrids(name: &str, hybrids: &[(&Group, Curve)]) -> Option<Figure> {
    let exponents = hybrids.iter().map(|(group, Curve { index, .. })| {
        let [_, b1, b2] = index.coefficients;
        format!("{} {}", group.name(), number::short(b1 / b2))
    });
    let words = format!(
        "the hybrid measure x^(λ/(1+λ)) y^(1/(1+λ)) of Eq. 23, with limits at the median y (λ: {})",
        exponents.collect::<Vec<_>>().join("; ")
    );
    let curves: Vec<_> = hybrids.iter().map(|(group, curve)| (*group, Some(*curve))).collect();
    let Predictor { im_x, im_y, .. } = hybrids.first()?.1.index;
    let measures = [Some(im_x), im_y].into_iter().flatten().map(|measure| measure_label(measure).words());
    let measures = measures.collect::<Vec<_>>().join(" and ");
    let title = format!("Overturning over the hybrid measure of {measures}");
    Some(figure(&curves, im_x, [name, &title, &words, "Figure 12"]))
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
    groups: &[(&Group, Option<Curve>)],
    im_x: Measure,
    [name, title, measure, of_paper]: [&str; 4],
) -> Figure {
    let entries = [
        (Mark::Bar(Ink::Data(0)), Label::plain("share in a bin")),
        (Mark::Line(Ink::Data(1).line(1.3)), Label::plain("curve, 95 % band")),
        (Mark::Line(Ink::Data(1).dashed(1.3, Dash::Short)), Label::plain("beyond the data")),
    ];
    let has_curves = groups.iter().any(|(_, curve)| curve.is_some());
    let entries = if has_curves { &entries[..] } else { &entries[..1] };
    let (grid, mut drawing) = Grid::of(groups.len(), 118.0).with_legend(entries);
    let mut off = Vec::new();
    for (place, (group, curve)) in groups.iter().enumerate() {
        let (corner, width) = grid.place(place);
        let bins = draw(&mut drawing, group, (*curve, im_x), corner, width, grid.panel_height);
        let missed = bins.iter().filter(|bin| bin.misses_curve()).count();
        if missed > 0 {
            off.push(format!("{} {missed} of {}", group.name(), bins.len()));
        }
    }
    let off = match off.is_empty() {
        true => "All bars meet the curve".to_string(),
        false => {
            format!("Bars that miss the curve, which is off there by more than chance: {}", off.join("; "))
        }
    };
    let of_curves = match has_curves {
        false => ". There is no curve".to_string(),
        true => format!(
            "; the band is that of the curve alone, and dots of few motions lie outside of it. {off}. Beyond the data a curve goes on until it ends, or says where it is at {} times the largest measure",
            number::plain(FURTHEST)
        ),
    };
    let rocked = || groups.iter().flat_map(|(group, _)| group.rocked().map(|(response, _)| response));
    let left_out = rocked().filter(|response| im_x.of(&response.case).is_none()).count();
    let left_out = match left_out {
        0 => String::new(),
        count => format!(" {} motions without this measure are left out.", number::count(count)),
    };
    Figure {
        name: name.to_string(),
        title: title.to_string(),
        caption: format!(
            "Probability of overturning given rocking over {measure}. Dots are shares in bins, larger where they hold more motions, with their own 95 % limits (Wilson){of_curves}.{left_out} {}",
            super::of_paper(of_paper)
        ),
        made: String::new(),
        drawing,
    }
}

/// Cases of about the same measure.
struct Bin {
    estimate: Estimate,
    /// The mean of their predicted probabilities.
    predicted: Option<f64>,
}

impl Bin {
    /// Whether the curve lies outside of the limits of the share.
    fn misses_curve(&self) -> bool {
        const ROUNDING: f64 = 1e-6;
        let Estimate { low, high, .. } = self.estimate;
        self.predicted.is_some_and(|p| p < low - ROUNDING || p > high + ROUNDING)
    }
}

fn draw(
    drawing: &mut Drawing,
    group: &Group,
    (curve, im_x): (Option<Curve>, Measure),
    corner: [f64; 2],
    width: f64,
    height: f64,
) -> Vec<Bin> {
    let index = curve.map(|curve| curve.index);
    let im_y = index.and_then(|index| index.im_y);
    let over = |response: &ReportResponse| match index {
        Some(index) if im_y.is_some() => index.hybrid_measure(&response.case.measures),
        _ => im_x.of(&response.case),
    };
    let cases: Vec<(f64, bool, Option<f64>)> = group
        .rocked()
        .filter_map(|(response, overturned)| {
            let predicted = index.and_then(|index| index.at(&response.case.measures));
            Some((over(response)?, overturned, predicted.map(|predicted| normal::cdf(predicted.value))))
        })
        .collect();
    let second = im_y.map(|im_y| {
        let values = sorted(group.rocked().filter_map(|(response, _)| im_y.of(&response.case)));
        (im_y, quantile(&values, 0.5))
    });
    let at = |value: f64| probability(&index?, value, second);
    let of_data = range(cases.iter().map(|(value, ..)| *value).filter(|value| *value > 0.0));
    let (end, beyond) = end_of_curve(of_data[1], at);
    let label = if im_y.is_some() { Label::plain("hybrid measure") } else { measure_label(im_x) };
    let x = Axis::log_over([of_data[0], end].into_iter(), label);
    let y = Axis::linear([-0.04, 1.04], Label::marked("*P*_{ro}"));
    let panel = Panel { corner, width, height, x, y };
    let (inside, outside): (Vec<_>, Vec<_>) = panel
        .x
        .steps(STEPS)
        .filter_map(|value| Some((value, at(value)?)))
        .partition(|(value, _)| *value <= of_data[1]);
    let from_data = inside.last().copied().into_iter().chain(outside).collect::<Vec<_>>();
    super::draw_curve(drawing, &panel, "curve", &inside, Ink::Data(1).line(1.3));
    super::draw_curve(
        drawing,
        &panel,
        "curve beyond the data",
        &from_data,
        Ink::Data(1).dashed(1.3, Dash::Short),
    );
    let bins = bins(&cases, of_data);
    let estimates: Vec<Estimate> = bins.iter().map(|bin| bin.estimate).collect();
    panel.estimates(drawing, "share in a bin", &estimates, Ink::Data(0));
    panel.frame(drawing, Label::plain(group.name()).bold());
    let (all, events) = (cases.len(), cases.iter().filter(|(_, event, _)| *event).count());
    let counts = format!("{} of {} overturn", number::count(events), number::count(all));
    let notes = match (curve, group.has_curve()) {
        (None, false) => [Some(format!("no curve: {counts}, {LEAST_EVENTS} of each are needed")), None, None],
        _ => [Some(counts), doubt(curve), beyond],
    };
    for (line, words) in notes.into_iter().flatten().enumerate() {
        panel.note(drawing, [0.03, 0.1 + 0.09 * line as f64], Anchor::Start, Label::plain(words));
    }
    bins
}

/// What the status says against a curve, in words.
fn doubt(curve: Option<Curve>) -> Option<String> {
    let Some(Curve { status, gap, .. }) = curve else {
        return Some("no curve: see its status in the table".to_string());
    };
    match (status, gap) {
        (FitStatus::Misfit, Some(Gap { straight, bent })) => {
            Some(format!("misfit: {straight:.2} where a bent curve has {bent:.2}"))
        }
        (FitStatus::Ok, _) => None,
        (status, _) => Some(status.as_str().replace('_', " ")),
    }
}

/// How far a curve is drawn, and why it is not drawn to its end.
fn end_of_curve(largest: f64, at: impl Fn(f64) -> Option<Probability>) -> (f64, Option<String>) {
    let p = |value: f64| at(value).map_or(f64::NAN, |p| p.value);
    let furthest = p(FURTHEST * largest);
    if p(largest) >= END || furthest.is_nan() {
        return (largest, None);
    }
    if furthest < NEAR_END {
        let words = format!("at {} times the largest: {furthest:.2}", number::plain(FURTHEST));
        return (largest, Some(words));
    }
    const STEPS: i32 = 100;
    let values = (0..=STEPS).map(|step| largest * libm::pow(FURTHEST, f64::from(step) / f64::from(STEPS)));
    (values.into_iter().find(|value| p(*value) >= END).unwrap_or(FURTHEST * largest), None)
}

/// Puts cases into bins of equal ratio of the measure.
fn bins(cases: &[(f64, bool, Option<f64>)], [low, high]: [f64; 2]) -> Vec<Bin> {
    let ratio = libm::log(high / low).max(f64::MIN_POSITIVE);
    let count = (cases.len() / CASES).clamp(FEWEST_BINS, BINS);
    let place = |value: f64| ((libm::log(value / low) / ratio * count as f64) as usize).min(count - 1);
    let members: Vec<Vec<&(f64, bool, Option<f64>)>> =
        (0..count).map(|bin| cases.iter().filter(|(value, ..)| place(*value) == bin).collect()).collect();
    let most = members.iter().map(Vec::len).max().unwrap_or(1).max(1) as f64;
    let bin = |inside: &Vec<&(f64, bool, Option<f64>)>| {
        let (n, events) = (inside.len(), inside.iter().filter(|(_, event, _)| *event).count());
        let mean = |of: f64| of / n as f64;
        let x = libm::exp(mean(inside.iter().map(|(value, ..)| libm::log(*value)).sum()));
        let limits = wilson_limits(events, n);
        let radius = RADII[0] + (RADII[1] - RADII[0]) * (n as f64 / most).sqrt();
        let at = [x, events as f64 / n as f64];
        let predicted: Option<f64> = inside.iter().map(|(.., predicted)| *predicted).sum();
        Bin {
            estimate: Estimate { at, low: limits.low, high: limits.high, n: n as f64, radius },
            predicted: predicted.map(mean),
        }
    };
    members.iter().filter(|inside| !inside.is_empty()).map(bin).collect()
}

/// Predicts the probability at a value of the measure, or of the hybrid measure where the second measure is this.
fn probability(index: &Predictor, value: f64, second: Option<(Measure, f64)>) -> Option<Probability> {
    let measures: IntensityMeasures = match second {
        None => super::with(super::NOTHING, index.im_x, value),
        Some((im_y, at)) => {
            let [_, b1, b2] = index.coefficients;
            let im_x = libm::exp((b1 + b2) / b1 * libm::log(value) - b2 / b1 * libm::log(at));
            super::with(super::with(super::NOTHING, index.im_x, im_x), im_y, at)
        }
    };
    let predicted = index.at(&measures)?;
    Some(ProbitIndex { value: predicted.value, standard_error: predicted.variance.sqrt() }.probability())
}
