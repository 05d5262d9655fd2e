//! A figure of our own: at which velocity half of the rocking structures overturn, for each structure of the file.

use super::dots::{self, Dots};
use crate::report::axis::Axis;
use crate::report::data::{ReportData, Summary, name_of};
use crate::report::drawing::Ink;
use crate::report::figure::Figure;
use crate::report::text::Label;
use crate::statistics::FitStatus;

/// The fewest structures that are compared.
const FEWEST: usize = 3;
/// How far beyond a median its limits are drawn, as a ratio.
const FARTHEST: f64 = 5.0;
/// The most rows, the others are in the table.
const MOST: usize = 80;

/// Draws one figure, the weakest structure first, if there are enough.
pub fn figures(data: &ReportData) -> Vec<Figure> {
    let median = |summary: &Summary| summary.curve.and_then(|curve| curve.pgv_m_s);
    let mut rows: Vec<(&Summary, [f64; 3])> =
        data.summaries.iter().filter_map(|summary| Some((summary, median(summary)?))).collect();
    if rows.len() < FEWEST {
        return Vec::new();
    }
    rows.sort_by(|(_, a), (_, b)| a[0].total_cmp(&b[0]));
    let (all, with_curve) = (data.summaries.len(), rows.len());
    rows.truncate(MOST);
    let of = |wanted: fn(FitStatus) -> bool| {
        let is_wanted = |summary: &Summary| summary.curve.is_some_and(|curve| wanted(curve.status));
        let rows = rows.iter().enumerate().filter(|(_, (summary, _))| is_wanted(summary));
        rows.map(|(row, (summary, median))| dots::estimate(row as f64, *median, summary.n as f64)).collect()
    };
    // Limits that are farther out run off the axis.
    let near = |[value, low, high]: [f64; 3]| [low.max(value / FARTHEST), high.min(FARTHEST * value)];
    let ends = rows.iter().map(|(_, median)| near(*median));
    let panel = Dots {
        title: Label::plain("half of those that rock overturn"),
        x: Axis::log_over(ends.flat_map(|[low, high]| [low / 1.1, 1.1 * high]), Label::plain("PGV (m/s)")),
        names: rows
            .iter()
            .map(|(summary, _)| name_of(&summary.structure.name, summary.suite.as_deref()))
            .collect(),
        series: vec![
            ("no test speaks against the curve", Ink::Data(0), of(|status| status == FitStatus::Ok)),
            ("doubtful: see the table", Ink::Data(1), of(|status| status != FitStatus::Ok)),
        ],
        mark: None,
    };
    vec![Figure {
        name: "medians".to_string(),
        title: "Where half overturn".to_string(),
        caption: format!(
            "Peak ground velocity at which the curve over p PGV/(g tan α) gives a probability of overturning of one half, given rocking, with 95 % limits; {with_curve} of {all} pairs of structure and suite have such a curve{}. A figure of our own.",
            if with_curve > MOST { format!(", the weakest {MOST} are drawn") } else { String::new() }
        ),
        made: String::new(),
        drawing: dots::draw(&[panel], 1),
    }]
}
