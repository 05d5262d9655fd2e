//! Intensities at which a curve is tabulated.

use super::GAP;
use crate::fragility::LimitStates;
use crate::statistics::numerics::{equal_ratios, first};

/// Number of steps, equal in logarithm, with which every interval between two edges begins, so that no bend
/// hides in one.
const FIRST_STEPS: usize = 16;
/// Upper bound of the halvings of a step.
const MOST_HALVINGS: u32 = 20;

/// An intensity at which probabilities are known, and how often the step before it may still be halved.
#[derive(Clone, Copy)]
struct Level {
    intensity: f64,
    p: LimitStates<f64>,
    halvings: u32,
}

/// Chooses intensities between the first edge and the last at which to tabulate `f`, so that straight lines
/// between them err by no more than about `tolerance`. `f` may jump at the inner edges: each is a level, and
/// has one just below.
pub fn levels(edges: &[f64], tolerance: f64, f: impl Fn(f64) -> LimitStates<f64>) -> Vec<f64> {
    let level = |intensity, halvings| Level { intensity, p: f(intensity), halvings };
    let mut levels = Vec::new();
    for (index, interval) in edges.windows(2).enumerate() {
        let is_last = index + 2 == edges.len();
        let (from, to) = (interval[0], if is_last { interval[1] } else { interval[1] * (1.0 - GAP) });
        let steps = equal_ratios(from, to, FIRST_STEPS).map(|intensity| level(intensity, MOST_HALVINGS));
        let mut ahead: Vec<Level> = steps.collect();
        ahead.reverse();
        let Some(mut low) = ahead.pop() else { continue };
        while let Some(high) = ahead.pop() {
            let halvings = high.halvings.saturating_sub(1);
            let middle = level(0.5 * (low.intensity + high.intensity), halvings);
            let line = low.p.zip(high.p, |a, b| 0.5 * (a + b));
            let errors = line.zip(middle.p, |line, p| (p - line).abs()).into_array();
            if high.halvings > 0 && !errors.iter().all(|error| *error <= tolerance) {
                ahead.extend([Level { halvings, ..high }, middle]);
            } else {
                levels.push(low.intensity);
                low = high;
            }
        }
        levels.push(to);
    }
    levels
}

/// Finds the least intensity above `from` at which all of `f`, which rise to 1, are within `tolerance` of it.
/// By bisection: the condition is on several curves at once, and its answer is a yes or no.
pub fn whole_curve_end(from: f64, tolerance: f64, f: impl Fn(f64) -> LimitStates<f64>) -> f64 {
    let is_whole = |intensity: f64| f(intensity).into_array().iter().all(|&p| p >= 1.0 - tolerance);
    let mut high = from;
    while !is_whole(high) && high.is_finite() {
        high *= 2.0;
    }
    if high.is_finite() { first(from, high, is_whole) } else { high }
}
