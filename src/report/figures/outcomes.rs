//! A figure of our own: outcomes over peak velocity and period of the pulse.

use crate::keyword::Keyword;
use crate::report::axis::Axis;
use crate::report::data::{Group, ReportData, ReportResponse};
use crate::report::drawing::{Ink, Paint};
use crate::report::figure::{Figure, Grid};
use crate::report::panel::{MOST_POINTS, Mark, Panel, dot_scale};
use crate::report::text::{Label, number};
use crate::rocking::Outcome;

/// Each outcome, its words, colour and size of dots.
const CLASSES: [(Outcome, &str, Paint, f64); 3] = [
    (Outcome::NoRocking, "no rocking", Paint { ink: Ink::Rule, opacity: 1.0 }, 0.7),
    (Outcome::SafeRocking, "safe rocking", Paint { ink: Ink::Data(0), opacity: 0.55 }, 0.8),
    (Outcome::Overturning, "overturning", Paint { ink: Ink::Data(1), opacity: 0.9 }, 1.2),
];

/// Draws one figure a structure, one panel a suite.
pub fn figures(data: &ReportData) -> Vec<Figure> {
    let mut names: Vec<&str> = Vec::new();
    for group in &data.groups {
        if !names.contains(&group.structure.name.as_str()) {
            names.push(&group.structure.name);
        }
    }
    let of = |name: &&str| {
        let groups = data.groups.iter().filter(|group| group.structure.name == **name).collect::<Vec<_>>();
        figure(&groups)
    };
    names.iter().map(of).collect()
}

fn figure(groups: &[&Group]) -> Figure {
    let structure = &groups[0].structure;
    let with_period =
        groups.iter().all(|group| group.responses.iter().any(|response| response.tp_s.is_some()));
    let entries = CLASSES.map(|(_, words, paint, _)| (Mark::Dot(paint), Label::plain(words)));
    let (grid, mut drawing) = Grid::of(groups.len(), 130.0).with_legend(&entries);
    let place = |response: &ReportResponse| match with_period {
        true => [response.tp_s.unwrap_or(f64::NAN), response.pgv_m_s],
        false => [response.pga_m_s2, response.pgv_m_s],
    };
    let all = || groups.iter().flat_map(|group| group.responses.iter().map(place));
    let x_label = Label::marked(if with_period { "pulse period *T*_{p} (s)" } else { "PGA (m/s^{2})" });
    let x = Axis::log_over(all().map(|[x, _]| x), x_label);
    let y = Axis::log_over(all().map(|[_, y]| y), Label::plain("PGV (m/s)"));
    for (index, group) in groups.iter().enumerate() {
        let (corner, width) = grid.place(index);
        let panel = Panel { corner, width, height: grid.panel_height, x: x.clone(), y: y.clone() };
        let crowded = group.responses.len() > MOST_POINTS;
        for (outcome, words, paint, radius) in CLASSES {
            let of_class =
                group.responses.iter().filter(|response| response.case.outcome == outcome).map(place);
            let mut points: Vec<[f64; 2]> = of_class.collect();
            if crowded && !points.is_empty() {
                // All classes of a panel are drawn in the same way.
                panel.density(&mut drawing, words, &points, paint.ink);
                points.clear();
            }
            panel.scatter(&mut drawing, words, &points, radius * dot_scale(group.responses.len()), paint);
        }
        let suite = group.suite.clone().unwrap_or_else(|| "all motions".to_string());
        panel.frame(&mut drawing, Label::plain(suite).bold());
    }
    let counts = groups.iter().map(|group| {
        let of = |outcome: Outcome| {
            format!("{} {}", number::count(group.count(outcome)), outcome.as_str().replace('_', " "))
        };
        let counts = CLASSES.map(|(outcome, ..)| of(outcome)).join(", ");
        format!("{}: {counts}", group.suite.as_deref().unwrap_or("all motions"))
    });
    let counts = counts.collect::<Vec<_>>().join("; ");
    let left_out = match with_period {
        true => super::without_period(groups.iter().flat_map(|group| &group.responses)),
        false => String::new(),
    };
    Figure {
        name: format!("outcomes-{}", super::file_words(&structure.name)),
        title: format!("How {} comes through each motion", structure.name),
        caption: format!(
            "Each dot is a motion; squares stand for many of them where there are more than {} in a panel. {}. {counts}.{left_out} A figure of our own.",
            number::count(MOST_POINTS),
            super::structure_words(structure),
        ),
        made: String::new(),
        drawing,
    }
}
