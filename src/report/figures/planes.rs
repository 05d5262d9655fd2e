//! Figure 9: the two planes of the demand, both edge-on.

use crate::fragility::Measure;
use crate::report::axis::{Axis, range};
use crate::report::data::{Group, Planes, ReportData, ReportResponse};
use crate::report::drawing::Ink;
use crate::report::figure::{Figure, Grid};
use crate::report::panel::{Mark, Panel, legend};
use crate::report::text::{Label, number};

type Vector = [f64; 3];

/// Draws one figure, one panel a group that has both planes.
pub fn figures(data: &ReportData) -> Vec<Figure> {
    let groups: Vec<(&Group, Planes)> =
        data.groups.iter().filter_map(|group| Some((group, group.planes?))).collect();
    if groups.is_empty() {
        return Vec::new();
    }
    let grid = Grid::of(groups.len(), 125.0).with_legend();
    let mut drawing = grid.drawing();
    let entries = [
        (Mark::Dot(Ink::Data(2).full()), Label::plain("below the transition")),
        (Mark::Dot(Ink::Data(0).full()), Label::plain("above it")),
        (Mark::Line(Ink::Text.line(1.2)), Label::plain("planes")),
    ];
    legend(&mut drawing, grid.legend_at(), &entries);
    for (index, (group, planes)) in groups.iter().enumerate() {
        let (corner, width) = grid.place(index);
        let view = View::edge_on(planes);
        let points = [true, false].map(|below| points(group, planes, below));
        let places: [Vec<[f64; 2]>; 2] =
            points.clone().map(|points| points.iter().map(|point| view.of(point)).collect());
        let ends = |axis: usize| {
            let [low, high] = range(places.iter().flatten().map(|place| place[axis]));
            let margin = 0.04 * (high - low);
            [low - margin, high + margin]
        };
        let panel = Panel {
            corner,
            width,
            height: grid.panel_height,
            x: Axis::linear(ends(0), words_of(&view.right)),
            y: Axis::linear(ends(1), words_of(&view.up)),
        };
        for (places, ink) in places.iter().zip([Ink::Data(2), Ink::Data(0)]) {
            panel.scatter(&mut drawing, places, 0.7, ink.thin(0.5));
        }
        for (side, points) in planes.sides.iter().zip(&points) {
            let [ln_a, b1, b2] = side.law.ln_median.coefficients;
            let on_plane = points.iter().map(|[x, y, _]| view.of(&[*x, *y, ln_a + b1 * x + b2 * y]));
            let mut on_plane: Vec<[f64; 2]> = on_plane.collect();
            on_plane.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
            if let (Some(first), Some(last)) = (on_plane.first(), on_plane.last()) {
                panel.line(&mut drawing, &[*first, *last], Ink::Text.line(1.2));
            }
        }
        panel.frame(&mut drawing, Label::plain(group.name()).bold());
    }
    vec![Figure {
        name: "planes".to_string(),
        title: "Two planes, seen edge-on".to_string(),
        caption: format!(
            "Demand in safe rocking in the space of ln IM4, ln IM3 and ln EDP, seen along the line in which the two planes (Eqs. 17 and 18) meet: both are edge-on, and what lies off them is their residual. They part at IM4 = {}. The page turns them in space. As Figure 9 of the paper.",
            number::plain(groups[0].1.transition)
        ),
        drawing,
    }]
}

/// Collects ln IM4, ln IM3 and ln EDP of the cases on one side of the transition.
fn points(group: &Group, planes: &Planes, below: bool) -> Vec<Vector> {
    let on_side = group.safe().filter(|response| (response.case.measures.im4 < planes.transition) == below);
    let point = |response: &ReportResponse| {
        Some([
            Measure::Im4.of(&response.case)?.ln(),
            Measure::Im3.of(&response.case)?.ln(),
            response.case.edp.ln(),
        ])
    };
    on_side.filter_map(point).collect()
}

/// The two directions that span the picture.
struct View {
    right: Vector,
    up: Vector,
}

impl View {
    /// Looks along the line in which the planes meet.
    fn edge_on(planes: &Planes) -> View {
        let normal = |side: usize| {
            let [_, b1, b2] = planes.sides[side].law.ln_median.coefficients;
            [b1, b2, -1.0]
        };
        let along = unit(cross(normal(0), normal(1)));
        let right = unit(cross(along, [0.0, 0.0, 1.0]));
        let right = if right[0] < 0.0 { right.map(|part| -part) } else { right };
        let up = cross(right, along);
        let up = if up[2] < 0.0 { up.map(|part| -part) } else { up };
        View { right, up }
    }

    fn of(&self, point: &Vector) -> [f64; 2] {
        [dot(&self.right, point), dot(&self.up, point)]
    }
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Scales to length 1. Parallel planes meet nowhere: then the view is along ln IM3.
fn unit(vector: Vector) -> Vector {
    let length = dot(&vector, &vector).sqrt();
    if length > 1e-12 { vector.map(|part| part / length) } else { [0.0, 1.0, 0.0] }
}

/// Writes a direction as a sum without small terms: `0.85 ln IM4 - 0.52 ln IM3`.
fn words_of(direction: &Vector) -> Label {
    let names = ["ln IM4", "ln IM3", "ln EDP"];
    let parts = direction.iter().zip(names).filter(|(part, _)| part.abs() >= 0.03);
    let mut text = String::new();
    for (part, name) in parts {
        let sign = match (text.is_empty(), *part < 0.0) {
            (true, true) => "\u{2212}",
            (true, false) => "",
            (false, true) => " \u{2212} ",
            (false, false) => " + ",
        };
        let size = number::fixed(part.abs(), 2);
        let size = if size == "1.00" { String::new() } else { format!("{size} ") };
        text = format!("{text}{sign}{size}{name}");
    }
    Label::plain(text)
}
