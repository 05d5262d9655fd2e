//! Figure 9: the two planes of the demand, both edge-on, over velocity and period as in the paper, and over IM4 and IM3.

use crate::fragility::Measure;
use crate::report::axis::{Axis, range};
use crate::report::data::{Group, ReportData, ReportResponse};
use crate::report::drawing::Ink;
use crate::report::figure::{Figure, Grid};
use crate::report::panel::{Mark, Panel};
use crate::report::text::{Label, number};
use crate::statistics::least_squares;

type Vector = [f64; 3];

const SIDES: [&str; 2] = ["below the transition", "above it"];
const SEEN: &str = "seen along the line in which the planes meet: both are edge-on, and what lies off them is their residual.";

/// Two planes in some coordinates, below the transition and from there on: the cases, and ln a, b1 and b2.
struct Sides {
    points: [Vec<Vector>; 2],
    planes: [Vector; 2],
}

/// Says at which IM4 the planes part.
fn parted(data: &ReportData) -> String {
    let parted = data.groups.iter().find_map(|group| group.planes).map(|planes| planes.transition);
    parted.map_or(String::new(), |im4| format!("They part at IM4 = {}.", number::plain(im4)))
}

/// Draws the planes over their own measures.
pub fn over_measures(data: &ReportData) -> Vec<Figure> {
    let sides = |group: &Group| {
        let fitted = group.planes?;
        let point = |response: &ReportResponse| {
            let ln = |measure: Measure| measure.of(&response.case).map(libm::log);
            Some([ln(Measure::Im4)?, ln(Measure::Im3)?, libm::log(response.case.edp)])
        };
        let planes = fitted.sides.map(|side| side.law.ln_median.coefficients);
        Some(Sides { points: points(group, fitted.transition, point), planes })
    };
    let caption = format!(
        "Demand in safe rocking in the space of ln IM4, ln IM3 and ln EDP, {SEEN} The planes are those of Eqs. 17 and 18 and Table II. {} The page turns them in space. A figure of our own.",
        parted(data)
    );
    figure(data, "planes", &caption, ["ln IM4", "ln IM3", "ln EDP"], sides).into_iter().collect()
}

/// Draws the figure of the paper for the groups whose motions have a period.
pub fn over_pulse(data: &ReportData) -> Vec<Figure> {
    let sides = |group: &Group| {
        let point = |response: &ReportResponse| {
            Some([libm::log(response.pgv_m_s), libm::log(response.tp_s?), libm::log(response.case.edp)])
        };
        let points = points(group, group.planes?.transition, point);
        let planes = [plane_through(&points[0])?, plane_through(&points[1])?];
        Some(Sides { points, planes })
    };
    let of_planes = data.groups.iter().filter(|group| group.planes.is_some());
    let caption = format!(
        "Demand in safe rocking in the space of ln PGV, ln Tp and ln EDP, {SEEN} The planes are fitted in this space. {}{} {} There the velocity is Vp, which PGV is under pulses alone.",
        parted(data),
        super::without_period(of_planes.flat_map(Group::safe)),
        super::of_paper("Figure 9")
    );
    figure(data, "planes-pulse", &caption, ["ln PGV", "ln Tp", "ln EDP"], sides).into_iter().collect()
}

/// One panel a group that has both planes.
fn figure(
    data: &ReportData,
    name: &str,
    caption: &str,
    axes: [&str; 3],
    of: impl Fn(&Group) -> Option<Sides>,
) -> Option<Figure> {
    let groups: Vec<(&Group, Sides)> =
        data.groups.iter().filter_map(|group| Some((group, of(group)?))).collect();
    if groups.is_empty() {
        return None;
    }
    let entries = [
        (Mark::Dot(Ink::Data(2).full()), Label::plain(SIDES[0])),
        (Mark::Dot(Ink::Data(0).full()), Label::plain(SIDES[1])),
        (Mark::Line(Ink::Text.line(1.2)), Label::plain("planes")),
    ];
    let (grid, mut drawing) = Grid::of(groups.len(), 125.0).with_legend(&entries);
    for (index, (group, Sides { points, planes })) in groups.iter().enumerate() {
        let (corner, width) = grid.place(index);
        let view = View::edge_on(planes);
        let places: [Vec<[f64; 2]>; 2] =
            points.each_ref().map(|points| points.iter().map(|point| view.of(point)).collect());
        let ends = |axis: usize| {
            let [low, high] = range(places.iter().flatten().map(|place| place[axis]));
            let margin = 0.04 * (high - low);
            [low - margin, high + margin]
        };
        let panel = Panel {
            corner,
            width,
            height: grid.panel_height,
            x: Axis::linear(ends(0), words_of(&view.right, axes)),
            y: Axis::linear(ends(1), words_of(&view.up, axes)),
        };
        for ((places, ink), name) in places.iter().zip([Ink::Data(2), Ink::Data(0)]).zip(SIDES) {
            panel.scatter(&mut drawing, name, places, 0.7, ink.thin(0.5));
        }
        for ([ln_a, b1, b2], points) in planes.iter().zip(points) {
            let on_plane = points.iter().map(|[x, y, _]| view.of(&[*x, *y, ln_a + b1 * x + b2 * y]));
            let mut on_plane: Vec<[f64; 2]> = on_plane.collect();
            on_plane.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
            if let (Some(first), Some(last)) = (on_plane.first(), on_plane.last()) {
                panel.curve(&mut drawing, "plane", &[*first, *last], Ink::Text.line(1.2));
            }
        }
        panel.frame(&mut drawing, Label::plain(group.name()).bold());
    }
    let title = format!("Two planes over {} and {}, seen edge-on", axes[0], axes[1]);
    Some(Figure { name: name.to_string(), title, caption: caption.to_string(), made: String::new(), drawing })
}

/// Collects the cases below the transition, and those from there on.
fn points(
    group: &Group,
    transition: f64,
    point: impl Fn(&ReportResponse) -> Option<Vector>,
) -> [Vec<Vector>; 2] {
    [true, false].map(|below| {
        let on_side = group.safe().filter(|response| (response.case.measures.im4 < transition) == below);
        on_side.filter_map(&point).collect()
    })
}

/// ln a, b1 and b2 of the plane nearest to these points.
fn plane_through(points: &[Vector]) -> Option<Vector> {
    let [x, y, z] = [0, 1, 2].map(|axis| points.iter().map(|point| point[axis]).collect::<Vec<f64>>());
    let fit = least_squares(&[&x, &y], &z).ok()?;
    Some([0, 1, 2].map(|k| fit.coefficients[k].value))
}

/// The two directions that span the picture.
struct View {
    right: Vector,
    up: Vector,
}

impl View {
    /// Looks along the line in which the planes meet.
    fn edge_on(planes: &[Vector; 2]) -> View {
        let normal = |side: usize| {
            let [_, b1, b2] = planes[side];
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
fn words_of(direction: &Vector, names: [&str; 3]) -> Label {
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
