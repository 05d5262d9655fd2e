//! Figure 9: the two planes of the demand (Eqs. 17 and 18, Table II), seen along the line in which they meet.

use nalgebra::Vector3;
use rockfrag_core::fragility::{Cases, DemandFit, DemandModel, PLANE};

use super::common::{Fits, compare, demands, name};
use crate::chart::{Axis, Figure, Ink, Layer, Mark, Panel};
use crate::number;

/// Figure 9: the demand in safe rocking and both planes edge-on, one panel a group.
pub fn planes(fits: &Fits, groups: &[&Cases]) -> Figure {
    let mut panels = Vec::new();
    for cases in groups {
        let planes: Vec<&DemandFit> = fits.demand(cases, DemandModel::Biplanar).collect();
        let [low, high] = planes[..] else { continue };
        let coefficients = [low, high].map(|fit| Vector3::from_column_slice(&fit.coefficients));
        panels.extend(high.range_low.map(|transition| panel(cases, transition, coefficients)));
    }
    let caption = "Demand in safe rocking in the space of ln IM4, ln IM3 and ln EDP, seen along the line in \
                   which the planes meet.";
    let caption =
        compare(caption, "Figure 9") + " There, velocity and period stand in place of the two measures.";
    Figure::new("planes", "The two planes, seen edge-on", 2, 110.0, panels).explained(caption)
}

/// The planes below the transition and from there on are ln a, b1 and b2 over ln IM4 and ln IM3.
fn panel(cases: &Cases, transition: f64, planes: [Vector3<f64>; 2]) -> Panel {
    let [right, up] = edge_on(planes);
    let view = |point: Vector3<f64>| Mark::new(right.dot(&point), up.dot(&point));
    let by_x = |a: &Mark, b: &Mark| a.x.total_cmp(&b.x);
    let (below, above): (Vec<_>, Vec<_>) = logarithms(cases).partition(|case| case.x < transition.ln());
    let sides = [("below the transition", Ink::Data(2), below), ("above it", Ink::Data(0), above)];
    let (mut layers, mut lines) = (Vec::new(), Vec::new());
    for ((label, ink, its), plane) in sides.into_iter().zip(planes) {
        let [ln_a, b1, b2] = plane.into();
        let on_plane = |case: &Vector3<f64>| Vector3::new(case.x, case.y, ln_a + b1 * case.x + b2 * case.y);
        let line = its.iter().map(|case| view(on_plane(case)));
        let ends = line.clone().min_by(by_x).into_iter().chain(line.max_by(by_x));
        lines.push(Layer::line("planes", Ink::Text, ends));
        layers.push(Layer::points(label, ink, its.into_iter().map(view)));
    }
    layers.extend(lines);
    let [x, y] = [right, up].map(|direction| Axis::linear(&sum(direction)));
    Panel::new(&name(cases), x, y, layers)
}

/// ln IM4, ln IM3 and ln EDP of the cases that have them.
fn logarithms(cases: &Cases) -> impl Iterator<Item = Vector3<f64>> {
    demands(cases).filter_map(|(case, edp)| {
        let [im4, im3] = PLANE.map(|measure| measure.value_of(&case.measures));
        Some(Vector3::new(im4?.ln(), im3?.ln(), edp.ln()))
    })
}

/// Returns the directions to the right and upwards in a view along the line in which the planes meet; of
/// parallel planes, which meet nowhere, along ln IM3.
fn edge_on(planes: [Vector3<f64>; 2]) -> [Vector3<f64>; 2] {
    let [first, second] = planes.map(|plane| Vector3::new(plane.y, plane.z, -1.0));
    let along = unit(first.cross(&second));
    let right = unit(along.cross(&Vector3::z()));
    let right = if right.x < 0.0 { -right } else { right };
    let up = right.cross(&along);
    [right, if up.z < 0.0 { -up } else { up }]
}

fn unit(vector: Vector3<f64>) -> Vector3<f64> {
    vector.try_normalize(1e-12).unwrap_or(Vector3::y())
}

/// Writes a direction as a sum without small terms: `0.85 ln IM4 − 0.52 ln IM3`.
fn sum(direction: Vector3<f64>) -> String {
    let mut terms = Vec::new();
    for (part, name) in direction.iter().zip(["ln IM4", "ln IM3", "ln EDP"]) {
        let sign = if *part < 0.0 { "\u{2212}" } else { "" };
        terms.extend(match part.abs() {
            size if size > 0.995 => Some(format!("{sign}{name}")),
            size if size >= 0.03 => Some(format!("{sign}{} {name}", number::fixed(size, 2))),
            _ => None,
        });
    }
    terms.join(" + ").replace("+ \u{2212}", "\u{2212} ")
}
