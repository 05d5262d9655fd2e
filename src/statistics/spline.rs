//! Natural cubic splines: as smooth as cubics between knots, straight lines beyond the outer ones.

use super::limits::quantile;

/// Shares of the values below each knot (Harrell 2015, Regression modeling strategies, Table 2.3).
const KNOTS: [f64; 4] = [0.05, 0.35, 0.65, 0.95];

/// The columns that make a straight line in `values` a natural cubic spline with four knots: two (Hastie, Tibshirani &
/// Friedman 2009, The elements of statistical learning, Eqs. 5.4 and 5.5).
pub fn natural_spline(values: &[f64]) -> [Vec<f64>; 2] {
    let knots = knots(values);
    let scale = knots[3] - knots[0];
    let cube = |x: f64| (x / scale).max(0.0).powi(3);
    let d = |k: usize, x: f64| (cube(x - knots[k]) - cube(x - knots[3])) * scale / (knots[3] - knots[k]);
    [0, 1].map(|k| values.iter().map(|&x| d(k, x) - d(2, x)).collect())
}

/// Quantiles of the values, linear between them.
fn knots(values: &[f64]) -> [f64; 4] {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    KNOTS.map(|share| quantile(&sorted, share))
}
