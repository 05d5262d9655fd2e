//! Figures 3 and 4: the demand over peak velocity and period.

use crate::report::axis::Axis;
use crate::report::data::{Group, ReportData, ReportResponse, demand_label};
use crate::report::drawing::{Ink, Paint};
use crate::report::figure::{Figure, Grid};
use crate::report::panel::{Mark, Panel, dot_scale, legend};
use crate::report::text::Label;
use crate::rocking::Outcome;

/// Each outcome that has a demand, its words, colour and size of dots.
const CLASSES: [(Outcome, &str, Paint, f64); 2] = [
    (Outcome::SafeRocking, "safe rocking", Paint { ink: Ink::Data(0), opacity: 0.55 }, 0.8),
    (Outcome::Overturning, "overturning", Paint { ink: Ink::Data(1), opacity: 0.9 }, 1.2),
];
/// The least demand that is drawn: what is below hardly rocks.
const LEAST: f64 = 1e-3;

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
    let grid = Grid::of(OVER.len(), 118.0).with_legend();
    let mut drawing = grid.drawing();
    let entries = CLASSES.map(|(_, words, paint, _)| (Mark::Dot(paint), Label::plain(words)));
    legend(&mut drawing, grid.legend_at(), &entries);
    let demands = || group.rocked().map(|(response, _)| response.case.edp);
    let largest = demands().fold(10.0 * LEAST, f64::max);
    for (index, Over { label, of }) in OVER.iter().enumerate() {
        let (corner, width) = grid.place(index);
        let x = Axis::log_over(group.rocked().filter_map(|(response, _)| of(response)), Label::marked(label));
        let y = Axis::log([LEAST, 1.2 * largest], demand_label());
        let panel = Panel { corner, width, height: grid.panel_height, x, y };
        for (outcome, _, paint, radius) in CLASSES {
            let of_class = group.responses.iter().filter(|response| response.case.outcome == outcome);
            let points: Vec<[f64; 2]> =
                of_class.filter_map(|response| Some([of(response)?, response.case.edp])).collect();
            panel.scatter(&mut drawing, &points, radius * dot_scale(group.responses.len()), paint);
        }
        let title = if index == 0 { group.name() } else { String::new() };
        panel.frame(&mut drawing, Label::plain(title).bold());
    }
    let below = demands().filter(|demand| *demand < LEAST).count();
    Figure {
        name: format!("demand-{}", super::group_file_words(group)),
        title: format!("Demand over velocity and period: {}", group.name()),
        caption: format!(
            "Demand |θ|max/α of each motion in which the structure rocks, over peak ground velocity and period of the pulse. Overturned structures lie on the floor, at π/(2α); {below} demands below {LEAST} are not drawn. {}. As Figures 3 and 4 of the paper, whose three axes these are.",
            super::structure_words(&group.structure),
        ),
        drawing,
    }
}
