//! Figure 10: P_ex of two measures against P_ex of one.

use super::sorted;
use crate::fragility::{DemandLaw, DemandModel, Measure, Probability};
use crate::motion::IntensityMeasures;
use crate::report::axis::Axis;
use crate::report::data::{Group, Planes, ReportData, measure_label};
use crate::report::drawing::{Dash, Ink, Stroke};
use crate::report::figure::{Figure, Grid};
use crate::report::panel::{Mark, Panel};
use crate::report::text::{Label, number};
use crate::statistics::estimate::quantile;

/// Number of points of a curve.
const STEPS: usize = 160;
/// Quantiles of IM3 at which curves are drawn.
const SHARES: [f64; 3] = [0.1, 0.5, 0.9];
const DASHES: [Dash; 3] = [Dash::Solid, Dash::Long, Dash::Short];

/// Draws one figure, one panel a group that has both models.
pub fn figures(data: &ReportData) -> Vec<Figure> {
    let Some(limit) = data.limit else { return Vec::new() };
    let both = |group| -> Option<(&Group, Planes, DemandLaw)> {
        let group: &Group = group;
        Some((group, group.planes?, group.on(Measure::Im4)?.law))
    };
    let groups: Vec<(&Group, Planes, DemandLaw)> = data.groups.iter().filter_map(both).collect();
    if groups.is_empty() {
        return Vec::new();
    }
    let grid = Grid::of(groups.len(), 118.0);
    let mut entries: Vec<(Mark, Label)> = SHARES
        .iter()
        .enumerate()
        .map(|(index, share)| {
            let label = Label::plain(format!("IM3 at its {} % quantile", number::plain(100.0 * share)));
            (Mark::Line(stroke(index)), label)
        })
        .collect();
    entries.push((Mark::Line(Ink::Muted.line(1.2)), Label::plain("IM4 alone")));
    if grid.columns == 1 {
        // Shorter words, so that they fit into a column.
        for (entry, share) in entries.iter_mut().zip(SHARES) {
            entry.1 = Label::plain(format!("{} %", number::plain(100.0 * share)));
        }
    }
    let (grid, mut drawing) = grid.with_legend(&entries);
    for (index, (group, planes, alone)) in groups.iter().enumerate() {
        let (corner, width) = grid.place(index);
        let largest = group.safe().map(|response| response.case.measures.im4).fold(1.5, f64::max);
        let x = Axis::log([1.0, largest], measure_label(Measure::Im4));
        let y = Axis::linear([0.0, 1.0], Label::marked("*P*_{ex}"));
        let panel = Panel { corner, width, height: grid.panel_height, x, y };
        let im3 = sorted(group.safe().filter_map(|response| response.case.measures.im3));
        let model = DemandModel::Biplanar {
            transition: planes.transition,
            low: planes.sides[0].law,
            high: planes.sides[1].law,
        };
        let curve = |ratio: f64, model: &DemandModel, from: f64, to: f64| -> Vec<(f64, Probability)> {
            let at = |im4: f64| {
                let measures = IntensityMeasures { im3: Some(ratio), im4, ..super::NOTHING };
                Some((im4, model.law(&measures).exceeding(&measures, limit)?.probability()))
            };
            let inside = panel.x.steps(STEPS).filter(|im4| (from..=to).contains(im4));
            std::iter::once(from).chain(inside).chain([to]).filter_map(at).collect()
        };
        let only = curve(1.0, &DemandModel::Everywhere(*alone), 1.0, largest);
        super::draw_curve(&mut drawing, &panel, "by IM4 alone", &only, Ink::Muted.line(1.2));
        let below = planes.transition * (1.0 - f64::EPSILON);
        for (index, share) in SHARES.iter().enumerate() {
            for (from, to) in [(1.0, below), (planes.transition, largest)] {
                let values = curve(quantile(&im3, *share), &model, from, to);
                let name = format!("IM3 at its {} % quantile", number::plain(100.0 * share));
                super::draw_curve(&mut drawing, &panel, &name, &values, stroke(index));
            }
        }
        panel.frame(&mut drawing, Label::plain(group.name()).bold());
    }
    let quantiles = groups.iter().map(|(group, ..)| {
        let im3 = sorted(group.safe().filter_map(|response| response.case.measures.im3));
        let values = SHARES.map(|share| number::short(quantile(&im3, share))).join(", ");
        format!("{}: {values}", group.name())
    });
    let caption = format!(
        "Probability of a demand above {} in safe rocking: by the two planes over IM4 and IM3 = PGA/(p PGV), at the three values of IM3 below which 10, 50 and 90 % of the cases lie, and by the regression on IM4 alone. Bands are 95 % limits. The curves jump where the planes part. IM3 of {}. {}",
        number::plain(limit),
        quantiles.collect::<Vec<_>>().join("; "),
        super::of_paper("Figure 10")
    );
    vec![Figure {
        name: "exceedance".to_string(),
        title: "Exceeding the limit state: two measures and one".to_string(),
        caption,
        made: String::new(),
        drawing,
    }]
}

fn stroke(index: usize) -> Stroke {
    Ink::Data([0, 2, 1][index]).dashed(1.3, DASHES[index])
}
