//! Whether a line through the measures tells the outcomes apart: then the likelihood grows without end.

use super::overlap::overlaps;

/// In a plane, classes that overlap by less than this share of the scores count as touching: a smaller overlap is the
/// rounding of the scores themselves.
const ROUNDING: f64 = 1e-12;

/// Whether some direction in the space of the `predictors` puts every event at or beyond every non-event (complete or
/// quasi-complete separation). Exact for one; for two, up to the rounding of the scores; for more, whether their overlap
/// cannot be proven.
pub fn is_separated(predictors: &[&[f64]], events: &[bool]) -> bool {
    match predictors {
        [x] => separates(events, |row| x[row]) || separates(events, |row| -x[row]),
        [x, y] => planar(x, y, events),
        more => !overlaps(more, events),
    }
}

/// Whether every event scores at least as high as every non-event.
fn separates(events: &[bool], score: impl Fn(usize) -> f64) -> bool {
    let rows = || events.iter().enumerate();
    let least_event =
        rows().filter(|(_, event)| **event).map(|(row, _)| score(row)).fold(f64::INFINITY, f64::min);
    let largest_other =
        rows().filter(|(_, event)| !**event).map(|(row, _)| score(row)).fold(f64::NEG_INFINITY, f64::max);
    least_event >= largest_other
}

type Point = (f64, f64);

/// Two point sets are separated just when a line along an edge of either convex hull, or through a vertex of each,
/// separates them. The hulls have few vertices, so all are tried.
fn planar(x: &[f64], y: &[f64], events: &[bool]) -> bool {
    let points = |of: bool| {
        let rows = (0..events.len()).filter(|&row| events[row] == of);
        convex_hull(rows.map(|row| (x[row], y[row])).collect())
    };
    let (hull, other) = (points(true), points(false));
    let edges = |hull: &[Point]| -> Vec<Point> {
        (0..hull.len()).map(|k| difference(hull[(k + 1) % hull.len()], hull[k])).collect()
    };
    let across = hull.iter().flat_map(|&a| other.iter().map(move |&b| difference(a, b)));
    let lines = edges(&hull).into_iter().chain(edges(&other)).chain(across);
    lines.flat_map(|(dx, dy)| [(-dy, dx), (dy, -dx), (dx, dy)]).any(|normal| {
        let score = |p: &Point| normal.0 * p.0 + normal.1 * p.1;
        let least = hull.iter().map(score).fold(f64::INFINITY, f64::min);
        let largest = other.iter().map(score).fold(f64::NEG_INFINITY, f64::max);
        let size = |p: &Point| (normal.0 * p.0).abs() + (normal.1 * p.1).abs();
        let rounding = ROUNDING * hull.iter().chain(&other).map(size).fold(0.0, f64::max);
        normal != (0.0, 0.0) && least >= largest - rounding
    })
}

fn difference(a: Point, b: Point) -> Point {
    (a.0 - b.0, a.1 - b.1)
}

/// Andrew's monotone chain, counter-clockwise, without collinear points.
fn convex_hull(mut points: Vec<Point>) -> Vec<Point> {
    points.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let mut hull = chain(points.iter());
    hull.extend(chain(points.iter().rev()));
    hull
}

fn chain<'a>(points: impl Iterator<Item = &'a Point>) -> Vec<Point> {
    let mut chain: Vec<Point> = Vec::new();
    for &point in points {
        while let [.., a, b] = chain[..]
            && cross(difference(b, a), difference(point, b)) <= 0.0
        {
            chain.pop();
        }
        chain.push(point);
    }
    // The last point begins the other chain.
    chain.pop();
    chain
}

fn cross(a: Point, b: Point) -> f64 {
    a.0 * b.1 - a.1 * b.0
}
