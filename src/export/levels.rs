//! Intensities at which a curve is tabulated.

use super::GAP;
use crate::fragility::LimitStates;
use crate::statistics::numerics::{equal_ratios, first};

/// Number of steps, equal in logarithm, with which every interval between two edges begins, so that no bend
/// hides in one.
const FIRST_STEPS: usize = 16;
/// Upper bound of the halvings of a step.
const MOST_HALVINGS: u32 = 20;

/// Chooses intensities between the first edge and the last at which to tabulate `f`, so that straight lines
/// between them err by no more than about `tolerance`. `f` may jump at the inner edges: each is a level, and
/// has one just below.
pub fn levels(edges: &[f64], tolerance: f64, f: impl Fn(f64) -> LimitStates<f64>) -> Vec<f64> {
    let mut table = Table { f, tolerance, levels: Vec::new() };
    for (index, interval) in edges.windows(2).enumerate() {
        let is_last = index + 2 == edges.len();
        let (from, to) = (interval[0], if is_last { interval[1] } else { interval[1] * (1.0 - GAP) });
        let steps: Vec<Level> =
            equal_ratios(from, to, FIRST_STEPS).map(|intensity| table.level(intensity)).collect();
        for (&low, &high) in steps.iter().zip(&steps[1..]) {
            table.levels.push(low.intensity);
            table.refine(low, high, MOST_HALVINGS);
        }
        table.levels.push(to);
    }
    table.levels
}

struct Table<F> {
    f: F,
    tolerance: f64,
    levels: Vec<f64>,
}

#[derive(Clone, Copy)]
struct Level {
    intensity: f64,
    p: LimitStates<f64>,
}

impl<F: Fn(f64) -> LimitStates<f64>> Table<F> {
    fn level(&self, intensity: f64) -> Level {
        Level { intensity, p: (self.f)(intensity) }
    }

    /// Adds the levels that are needed strictly between two.
    fn refine(&mut self, low: Level, high: Level, halvings: u32) {
        let middle = self.level(0.5 * (low.intensity + high.intensity));
        let line = low.p.zip(high.p, |a, b| 0.5 * (a + b));
        let errors = line.zip(middle.p, |line, p| (p - line).abs()).into_array();
        if halvings > 0 && !errors.iter().all(|error| *error <= self.tolerance) {
            self.refine(low, middle, halvings - 1);
            self.levels.push(middle.intensity);
            self.refine(middle, high, halvings - 1);
        }
    }
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
