//! Whether a line through the measures separates the outcomes: then the likelihood grows without end.

use nalgebra::{DMatrix, DVector};

use crate::statistics::binary::{Estimator, binary_regression};
use crate::statistics::design::DesignMatrix;
use crate::statistics::link::Link;

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

/// The rounding of a sum, as a share of the sizes of its terms.
const SUM_ROUNDING: f64 = 1e-13;

/// Whether no direction puts every event at or beyond every non-event.
///
/// With z = (1, x) of an event and -(1, x) of a non-event, a direction d separates them if z'd >= 0 for all. The equations of a
/// logistic maximum hand over weights w > 0 whose sum of w z vanishes up to a rest r; Stiemke's lemma says that exact ones
/// exist just where nothing separates (Albert & Anderson 1984, On the existence of maximum likelihood estimates in logistic
/// regression models, Biometrika 71, 1-10). With the rest, a separating d of length 1 would have
/// sum w (z'd)^2 <= max|z| sum w z'd <= max|z| |r|: it is ruled out where the least eigenvalue of sum w z z' is larger.
pub fn overlaps(predictors: &[&[f64]], events: &[bool]) -> bool {
    let columns: Vec<Vec<f64>> = predictors.iter().map(|values| standardised(values)).collect();
    let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    let Ok(fit) = binary_regression(&columns, events, Link::Logit, Estimator::Ml) else { return false };
    let design = DesignMatrix::new(&columns, events.len());
    let k = design.columns().len();
    let (mut rest, mut rounding, mut largest) = (DVector::zeros(k), 0.0, 0.0_f64);
    let mut moments = DMatrix::<f64>::zeros(k, k);
    for ((row, index), &event) in design.rows().zip(fit.indices(&design)).zip(events) {
        let slope = Link::Logit.score(index, event).slope;
        let (weight, size) = (slope.abs(), row.norm());
        rest += &row * slope;
        rounding += SUM_ROUNDING * weight * size;
        largest = largest.max(size);
        moments += &row * row.transpose() * weight;
    }
    let rest = rest.norm() + rounding;
    let least = moments.symmetric_eigenvalues().min();
    least > largest * rest
}

/// About the mean, in standard deviations, which changes no separation.
fn standardised(values: &[f64]) -> Vec<f64> {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let sd = (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / n).sqrt();
    values.iter().map(|value| (value - mean) / sd).collect()
}
