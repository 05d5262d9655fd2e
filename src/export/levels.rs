//! Intensities at which a curve is tabulated.

use super::GAP;
use crate::statistics::numerics::first;

/// Number of steps, equal in logarithm, with which every interval between two edges begins, so that no bend
/// hides in one.
const FIRST_STEPS: i32 = 16;
/// Upper bound of the halvings of a step.
const MOST_HALVINGS: u32 = 20;

/// Chooses intensities between the first edge and the last at which to tabulate `f`, so that straight lines
/// between them err by no more than about `tolerance`. `f` may jump at the inner edges: each is a level, and
/// has one just below.
pub fn levels<const N: usize>(edges: &[f64], tolerance: f64, f: impl Fn(f64) -> [f64; N]) -> Vec<f64> {
    let mut levels = Vec::new();
    for (index, interval) in edges.windows(2).enumerate() {
        let is_last = index + 2 == edges.len();
        let (from, to) = (interval[0], if is_last { interval[1] } else { interval[1] * (1.0 - GAP) });
        let step = |k: i32| from * (to / from).powf(f64::from(k) / f64::from(FIRST_STEPS));
        let point = |k: i32| (step(k), f(step(k)));
        for k in 0..FIRST_STEPS {
            levels.push(step(k));
            refine(point(k), point(k + 1), tolerance, MOST_HALVINGS, &f, &mut levels);
        }
        levels.push(to);
    }
    levels
}

/// Adds the levels that are needed strictly between two.
fn refine<const N: usize>(
    low: (f64, [f64; N]),
    high: (f64, [f64; N]),
    tolerance: f64,
    halvings: u32,
    f: &impl Fn(f64) -> [f64; N],
    levels: &mut Vec<f64>,
) {
    let at = 0.5 * (low.0 + high.0);
    let middle = (at, f(at));
    let error = |k: usize| (middle.1[k] - 0.5 * (low.1[k] + high.1[k])).abs();
    if halvings == 0 || (0..N).all(|k| error(k) <= tolerance) {
        return;
    }
    refine(low, middle, tolerance, halvings - 1, f, levels);
    levels.push(at);
    refine(middle, high, tolerance, halvings - 1, f, levels);
}

/// Finds the least intensity above `from` at which all of `f`, which rise to 1, are within `tolerance` of it.
/// By bisection: the condition is on several curves at once, and its answer is a yes or no.
pub fn whole_curve_end<const N: usize>(from: f64, tolerance: f64, f: impl Fn(f64) -> [f64; N]) -> f64 {
    let is_whole = |intensity: f64| f(intensity).iter().all(|&p| p >= 1.0 - tolerance);
    let mut high = from;
    while !is_whole(high) && high.is_finite() {
        high *= 2.0;
    }
    if high.is_finite() { first(from, high, is_whole) } else { high }
}
