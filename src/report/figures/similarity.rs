//! A figure of our own: structures that differ in their own units, and hardly in dimensionless ones.

use super::{by_ratio, sorted};
use crate::fragility::Measure;
use crate::report::axis::Axis;
use crate::report::data::{Group, ReportData, ReportResponse, demand_label, measure_label};
use crate::report::drawing::{Dash, Ink};
use crate::report::figure::{Figure, Grid};
use crate::report::panel::{Mark, Panel};
use crate::report::text::Label;
use crate::statistics::estimate::quantile;

/// Number of bins of the medians.
const BINS: usize = 14;
/// Number of cases that a median needs.
const LEAST: usize = 12;
/// Fraction of the cases below the axis of demand.
const TAIL: f64 = 0.03;
const DASHES: [Dash; 4] = [Dash::Solid, Dash::Long, Dash::Short, Dash::Mixed];

/// Draws the structures of the first suite under which two or more rock.
pub fn figures(data: &ReportData) -> Vec<Figure> {
    let of_suite = |suite: &Option<String>| {
        let groups =
            data.groups.iter().filter(|group| group.suite == *suite && strong(group).count() >= LEAST);
        groups.collect::<Vec<&Group>>()
    };
    let suites = data.groups.iter().map(|group| of_suite(&group.suite));
    suites.filter(|groups| groups.len() >= 2).take(1).map(|groups| figure(&groups)).collect()
}

/// Iterates over the cases in safe rocking above the transition: those just above uplift hardly rotate.
fn strong(group: &Group) -> impl Iterator<Item = &ReportResponse> {
    let transition = group.planes.map_or(1.0, |planes| planes.transition);
    group.safe().filter(move |response| response.case.measures.im4 >= transition)
}

/// One of the panels: a choice of axes for the same responses.
struct View {
    title: &'static str,
    x: Label,
    y: Label,
    of: fn(&Group, &ReportResponse) -> [f64; 2],
}

fn figure(groups: &[&Group]) -> Figure {
    let views = [
        View {
            title: "in their own units",
            x: Label::plain("PGV (m/s)"),
            y: Label::marked("|*θ*|_{max} (rad)"),
            of: |group, response| [response.pgv_m_s, response.case.edp * group.structure.alpha_rad],
        },
        View {
            title: "dimensionless",
            x: measure_label(Measure::Im5),
            y: demand_label(),
            of: |_, response| [response.case.measures.im5, response.case.edp],
        },
    ];
    let stroke = |index: usize| Ink::Data(index).dashed(1.6, DASHES[index % DASHES.len()]);
    let entries: Vec<(Mark, Label)> = groups
        .iter()
        .enumerate()
        .map(|(index, group)| (Mark::Line(stroke(index)), Label::plain(&group.structure.name)))
        .collect();
    let (grid, mut drawing) = Grid::of(views.len(), 130.0).with_legend(&entries);
    for (index, View { title, x, y, of }) in views.into_iter().enumerate() {
        let (corner, width) = grid.place(index);
        let clouds: Vec<Vec<[f64; 2]>> =
            groups.iter().map(|group| strong(group).map(|response| of(group, response)).collect()).collect();
        let ends = |axis: usize| {
            let values = sorted(clouds.iter().flatten().map(|value| value[axis]));
            [quantile(&values, TAIL), values.last().copied().unwrap_or(1.0) * 1.1]
        };
        let panel = Panel {
            corner,
            width,
            height: grid.panel_height,
            x: Axis::log(ends(0), x),
            y: Axis::log(ends(1), y),
        };
        for (index, cloud) in clouds.iter().enumerate() {
            panel.scatter(
                &mut drawing,
                &groups[index].structure.name,
                cloud,
                0.6,
                Ink::Data(index).thin(0.3),
            );
        }
        for (index, cloud) in clouds.iter().enumerate() {
            let bins = by_ratio(cloud, [panel.x.low, panel.x.high], BINS);
            let medians = bins.into_iter().filter(|(_, inside)| inside.len() >= LEAST);
            let medians: Vec<[f64; 2]> =
                medians.map(|(x, inside)| [x, quantile(&sorted(inside.into_iter()), 0.5)]).collect();
            let name = format!("{}, medians", groups[index].structure.name);
            panel.curve(&mut drawing, &name, &medians, stroke(index));
        }
        panel.frame(&mut drawing, Label::plain(title).bold());
    }
    let suite = groups[0].suite.as_deref().map_or(String::new(), |suite| format!(" to the suite {suite}"));
    let structures = groups
        .iter()
        .map(|group| format!("{}: {}", group.structure.name, super::structure_words(&group.structure)));
    Figure {
        name: "similarity".to_string(),
        title: "Similarity: one curve for all structures".to_string(),
        caption: format!(
            "Demand in safe rocking{suite} above the transition of the planes, with medians of bins of PGV. Left in units that each structure has its own curve in, right in dimensionless ones, in which the curves come together. {}. A figure of our own. {}",
            structures.collect::<Vec<_>>().join("; "),
            super::of_paper("Figure 5, which shows it of two responses,")
        ),
        made: String::new(),
        drawing,
    }
}
