//! Figure 9: the two planes of the demand (Eqs. 17 and 18, Table II), seen along the line in which they meet.

use super::{Group, RockingCase, compare};
use crate::fragility::PLANE;
use crate::number;
use crate::report::figure::{Axis, Figure, Ink, Layer, Panel};

type Vector = [f64; 3];

/// The planes of one group, below the transition and from there on: ln a, b1 and b2 over ln IM4 and ln IM3.
#[derive(Debug, Clone, PartialEq)]
pub struct GroupPlanes {
    pub group: Group,
    /// IM4 at which they meet.
    pub transition: f64,
    pub planes: [Vector; 2],
}

/// Figure 9: the demand in safe rocking and both planes edge-on, one panel a group.
pub fn planes(groups: &[GroupPlanes]) -> Figure {
    Figure {
        name: "planes".to_string(),
        title: "The two planes, seen edge-on".to_string(),
        caption: format!(
            "Demand in safe rocking in the space of ln IM4, ln IM3 and ln EDP, seen along the line in which the planes meet. {} There, velocity and period stand in place of the two measures.",
            compare("Figure 9")
        ),
        columns: groups.len().min(2),
        height: 110.0,
        panels: groups.iter().map(panel).collect(),
    }
}

fn panel(GroupPlanes { group, transition, planes }: &GroupPlanes) -> Panel {
    let [right, up] = edge_on(planes);
    let mut layers = Vec::new();
    let mut lines = Vec::new();
    let sides = [("below the transition", Ink::Data(2), true), ("above it", Ink::Data(0), false)];
    for ((label, ink, is_below), [ln_a, b1, b2]) in sides.into_iter().zip(planes) {
        let logarithms = |case: &RockingCase| -> Option<Vector> {
            let [im4, im3] = PLANE.map(|measure| measure.value_of(&case.measures));
            Some([im4?.ln(), im3?.ln(), case.demand()?.ln()])
        };
        let cases = group.cases.iter().filter_map(logarithms);
        let cases: Vec<Vector> = cases.filter(|case| (case[0] < transition.ln()) == is_below).collect();
        let view = |point: Vector| [dot(right, point), dot(up, point)];
        let mut on_plane: Vec<[f64; 2]> =
            cases.iter().map(|&[x, y, _]| view([x, y, ln_a + b1 * x + b2 * y])).collect();
        on_plane.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
        let ends = on_plane.first().into_iter().chain(on_plane.last()).copied();
        lines.push(Layer::line("planes", Ink::Text, ends.collect()));
        layers.push(Layer::points(label, ink, cases.into_iter().map(view)));
    }
    layers.extend(lines);
    let [x, y] = [right, up].map(|direction| Axis::linear(&sum(direction)));
    Panel { title: group.name.clone(), x, y, layers, notes: Vec::new() }
}

/// Returns the directions to the right and upwards in a view along the line in which the planes meet.
fn edge_on(planes: &[Vector; 2]) -> [Vector; 2] {
    let [first, second] = planes.map(|[_, b1, b2]| [b1, b2, -1.0]);
    let along = unit(cross(first, second));
    let right = unit(cross(along, [0.0, 0.0, 1.0]));
    let right = if right[0] < 0.0 { right.map(|part| -part) } else { right };
    let up = cross(right, along);
    [right, if up[2] < 0.0 { up.map(|part| -part) } else { up }]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Scales to length 1. Parallel planes meet nowhere: then the view is along ln IM3.
fn unit(vector: Vector) -> Vector {
    let length = dot(vector, vector).sqrt();
    if length > 1e-12 { vector.map(|part| part / length) } else { [0.0, 1.0, 0.0] }
}

/// Writes a direction as a sum without small terms: `0.85 ln IM4 − 0.52 ln IM3`.
fn sum(direction: Vector) -> String {
    let mut text = String::new();
    for (part, name) in direction.into_iter().zip(["ln IM4", "ln IM3", "ln EDP"]) {
        let sign = match (text.is_empty(), part < 0.0) {
            (true, true) => "\u{2212}",
            (true, false) => "",
            (false, true) => " \u{2212} ",
            (false, false) => " + ",
        };
        if part.abs() > 0.995 {
            text.push_str(&format!("{sign}{name}"));
        } else if part.abs() >= 0.03 {
            text.push_str(&format!("{sign}{} {name}", number::fixed(part.abs(), 2)));
        }
    }
    text
}
