//! Figures 3 and 4: the demand over peak velocity and period.

use crate::report::axis::Axis;
use crate::report::data::{Group, ReportData, ReportResponse, demand_label};
use crate::report::drawing::{Ink, Paint};
use crate::report::figure::{Figure, Grid};
use crate::report::panel::{Mark, Panel, dot_scale};
use crate::report::text::Label;
use crate::rocking::Outcome;

/// Each outcome that has a demand, its words, colour and size of dots.
const CLASSES: [(Outcome, &str, Paint, f64); 2] = [
    (Outcome::SafeRocking, "safe rocking", Paint { ink: Ink::Data(0), opacity: 0.55 }, 0.8),
    (Outcome::Overturning, "overturning, at the top", Paint { ink: Ink::Data(1), opacity: 0.9 }, 1.2),
];
/// The least demand that is drawn: what is below hardly rocks.
const LEAST: f64 = 1e-3;
/// Where those that overturn, and so have no demand, are drawn: so many times the largest demand, or 1.
const TOP: f64 = 2.0;

/// A horizontal axis.
struct Over {
    label: &'static str,
    of: fn(&ReportResponse) -> Option<f64>,
}

const OVER: [Over; 2] = [
    Over { label: "PGV (m/s)", of: |response| Some(response.pgv_m_s) },
    Over { label: "pulse period *T*_{p} (s)", of: |response| response.tp_s },
];

/// Draws one figure a group whose motions have a period, one panel an axis.
pub fn figures(data: &ReportData) -> Vec<Figure> {
    let has_periods = |group: &&Group| group.rocked().any(|(response, _)| response.tp_s.is_some());
    data.groups.iter().filter(has_periods).map(figure).collect()
}

fn figure(group: &Group) -> Figure {
    let entries = CLASSES.map(|(_, words, paint, _)| (Mark::Dot(paint), Label::plain(words)));
    let (grid, mut drawing) = Grid::of(OVER.len(), 118.0).with_legend(&entries);
    let demands = || group.safe().map(|response| response.case.edp);
    let top = TOP * demands().fold(1.0, f64::max);
    let demand = |response: &ReportResponse| match response.case.outcome {
        Outcome::Overturning => top,
        _ => response.case.edp,
    };
    for (index, Over { label, of }) in OVER.iter().enumerate() {
        let (corner, width) = grid.place(index);
        let x = Axis::log_over(group.rocked().filter_map(|(response, _)| of(response)), Label::marked(label));
        let y = Axis::log([LEAST, 1.3 * top], demand_label());
        let panel = Panel { corner, width, height: grid.panel_height, x, y };
        for (outcome, words, paint, radius) in CLASSES {
            let of_class = group.responses.iter().filter(|response| response.case.outcome == outcome);
            let points: Vec<[f64; 2]> =
                of_class.filter_map(|response| Some([of(response)?, demand(response)])).collect();
            panel.scatter(&mut drawing, words, &points, radius * dot_scale(group.responses.len()), paint);
        }
        let title = if index == 0 { group.name() } else { String::new() };
        panel.frame(&mut drawing, Label::plain(title).bold());
    }
    let below = demands().filter(|demand| *demand < LEAST).count();
    Figure {
        name: format!("demand-{}", super::group_file_words(group)),
        title: format!("Demand over velocity and period: {}", group.name()),
        caption: format!(
            "Demand |θ|max/α of each motion in which the structure rocks, over peak ground velocity and period of the pulse. Structures that overturn have no demand and stand in a row at the top; {below} demands below {LEAST} are not drawn. {}.{} {}",
            super::structure_words(&group.structure),
            super::without_period(group.rocked().map(|(response, _)| response))
                .replace("left out", "not in the panel on the right"),
            super::of_paper("Figures 3 and 4, whose three axes these are,")
        ),
        made: String::new(),
        drawing,
    }
}
