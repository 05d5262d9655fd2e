//! Whether a line through the measures separates the outcomes: then the likelihood grows without end.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use crate::statistics::binary::{Estimator, as_numbers, regress};
use crate::statistics::columns::Columns;
use crate::statistics::design::{Design, Moments, Rows, columns_of, range, widen};
use crate::statistics::link::Link;

/// In a plane, classes that overlap by less than this share of the scores count as touching: a smaller overlap is the
/// rounding of the scores themselves.
const ROUNDING: f64 = 1e-12;

/// Whether some direction in the space of the `predictors` puts every event at or beyond every non-event (complete or
/// quasi-complete separation). Exact for one; for two, up to the rounding of the scores; for more, whether their overlap
/// cannot be proven.
pub fn is_separated(predictors: &[&[f64]], events: &[bool]) -> bool {
    is_separable(&Design::new(&columns_of(predictors, as_numbers(events)), predictors.len()))
}

/// The same of a design, in which an event was observed where there is no 0.
pub fn is_separable(design: &Design) -> bool {
    match design.coefficients() {
        2 => linear(design),
        3 => planar(design),
        _ => !overlap(design),
    }
}

/// Whether all events lie on one side of all others.
fn linear(design: &Design) -> bool {
    let of_block = |rows: &Rows| {
        let of = |event: bool| {
            let of = rows.x[1].iter().zip(rows.y).filter(|(_, y)| (**y != 0.0) == event);
            range(&of.map(|(x, _)| *x).collect::<Vec<_>>())
        };
        [of(true), of(false)]
    };
    let [events, others] = design.fold(0, of_block, |both, part| {
        both.iter_mut().zip(part).for_each(|(range, other)| widen(range, other));
    });
    events[0] >= others[1] || events[1] <= others[0]
}

type Point = (f64, f64);

/// Two point sets are separated just when a line along an edge of either convex hull, or through a vertex of each,
/// separates them. The hulls have few vertices, so all are tried.
fn planar(design: &Design) -> bool {
    let of_block = |rows: &Rows| {
        [true, false].map(|event| {
            let points = rows.x[1].iter().zip(rows.x[2]).zip(rows.y);
            let of = points.filter(|(_, y)| (**y != 0.0) == event);
            convex_hull(of.map(|((x, y), _)| (*x, *y)).collect())
        })
    };
    // The hull of several hulls is that of all their points.
    let [hull, other] = design.fold(0, of_block, |both, part| {
        for (hull, more) in both.iter_mut().zip(part) {
            *hull = convex_hull(hull.iter().copied().chain(more).collect());
        }
    });
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
fn overlap(design: &Design) -> bool {
    let (moments, n) = (Moments::of(design), design.cases() as f64);
    // About the means, in standard deviations, which changes no separation.
    let mut standardised = Columns::new(design.coefficients(), &Arc::default());
    let sds: Vec<f64> = (0..design.coefficients() - 1).map(|k| (moments.product(k, k) / n).sqrt()).collect();
    let of_block = |rows: &Rows| -> Vec<Vec<f64>> {
        let predictors = rows.x[1..].iter().zip(&moments.means).zip(&sds);
        let columns = predictors.map(|((x, mean), sd)| x.iter().map(|x| (x - mean) / sd).collect());
        columns.chain([rows.y.to_vec()]).collect()
    };
    design.each(0, of_block, |columns| standardised.append(&columns));
    let design = Design::new(&standardised, design.coefficients() - 1);
    let Ok(fit) = regress(design, Link::Logit, Estimator::Ml) else { return false };
    let k = design.coefficients();
    let of_block = |rows: &Rows| {
        let (mut rest, mut rounding, mut largest) = (DVector::zeros(k), 0.0, 0.0_f64);
        let mut moments = DMatrix::<f64>::zeros(k, k);
        for ((row, index), y) in rows.each().zip(fit.indices(rows)).zip(rows.y) {
            let slope = Link::Logit.score(index, *y != 0.0).slope;
            let (weight, size) = (slope.abs(), row.norm());
            rest += &row * slope;
            rounding += SUM_ROUNDING * weight * size;
            largest = largest.max(size);
            moments += &row * row.transpose() * weight;
        }
        (rest, rounding, largest, moments)
    };
    let (rest, rounding, largest, moments) = design.fold(0, of_block, |sums, part| {
        *sums = (&sums.0 + part.0, sums.1 + part.1, sums.2.max(part.2), &sums.3 + part.3);
    });
    let rest = rest.norm() + rounding;
    let least = moments.symmetric_eigenvalues().min();
    least > largest * rest
}
