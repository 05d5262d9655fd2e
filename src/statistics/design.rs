//! The columns of a regression: the design matrix, whether its predictors can be told apart, and splines that bend a line.

use nalgebra::DVector;

use crate::statistics::estimate::quantile;

/// The design of a regression: an intercept and the predictors of each case.
#[derive(Debug, Clone, PartialEq)]
pub struct DesignMatrix {
    cases: usize,
    columns: Vec<Vec<f64>>,
}

impl DesignMatrix {
    /// Of `cases` cases and `predictors` that are each as long.
    pub fn new(predictors: &[&[f64]], cases: usize) -> DesignMatrix {
        let predictors = predictors.iter().map(|predictor| predictor[..cases].to_vec());
        DesignMatrix { cases, columns: std::iter::once(vec![1.0; cases]).chain(predictors).collect() }
    }

    /// How many cases there are.
    pub fn cases(&self) -> usize {
        self.cases
    }

    /// The columns: of the intercept, all ones, and of each predictor.
    pub fn columns(&self) -> &[Vec<f64>] {
        &self.columns
    }

    /// The rows in order.
    pub fn rows(&self) -> impl Iterator<Item = DVector<f64>> {
        let row = |case: usize| DVector::from_fn(self.columns.len(), |k, _| self.columns[k][case]);
        (0..self.cases).map(row)
    }

    /// b0 + b1 x1 + ... of each case.
    pub fn indices(&self, coefficients: &[f64]) -> Vec<f64> {
        let mut indices = vec![0.0; self.cases];
        for (column, b) in self.columns.iter().zip(coefficients) {
            indices.iter_mut().zip(column).for_each(|(index, x)| *index += b * x);
        }
        indices
    }
}

/// The sum of products of two vectors.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// A predictor of which less than this share is left, once the intercept and the others have explained what they can, is
/// taken for a combination of them: its square is about the rounding of the normal equations.
const LEAST_SHARE: f64 = 1e-7;
/// Values that differ by less than this share of their size do not differ.
const ROUNDING: f64 = 1e-12;

/// How predictors fail.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dependence {
    /// One does not vary.
    Constant,
    /// One is a combination of others.
    Collinear,
}

/// Whether `values` are all the same, but for rounding.
pub fn is_constant(values: &[f64]) -> bool {
    let (low, high) =
        values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(*v), high.max(*v)));
    high - low <= ROUNDING * low.abs().max(high.abs())
}

/// How the predictors depend on the intercept or on each other; none if they do not (by Gram and Schmidt).
pub fn dependence(predictors: &[&[f64]]) -> Option<Dependence> {
    let mut directions: Vec<Vec<f64>> = Vec::new();
    for values in predictors {
        if is_constant(values) {
            return Some(Dependence::Constant);
        }
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let mut left: Vec<f64> = values.iter().map(|value| value - mean).collect();
        let before = norm(&left);
        for direction in &directions {
            let share: f64 = left.iter().zip(direction).map(|(a, b)| a * b).sum();
            left.iter_mut().zip(direction).for_each(|(value, d)| *value -= share * d);
        }
        let after = norm(&left);
        if after <= LEAST_SHARE * before {
            return Some(Dependence::Collinear);
        }
        left.iter_mut().for_each(|value| *value /= after);
        directions.push(left);
    }
    None
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>().sqrt()
}

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

/// The cubic functions that let a line in one value bend: cubic between the knots, linear outside of them, one less than there are
/// gaps between knots; none of fewer than three (Harrell 2015, Regression modeling strategies, section 2.4.5).
pub fn restricted_splines(u: f64, knots: &[f64]) -> impl Iterator<Item = f64> + '_ {
    let ends = match *knots {
        [first, .., before, last] => Some((first, before, last)),
        _ => None,
    };
    ends.into_iter().flat_map(move |(first, before, last)| {
        let cube = move |knot: f64| (u - knot).max(0.0).powi(3);
        let width = (last - first) * (last - first);
        knots[..knots.len() - 2].iter().map(move |&knot| {
            let (a, b) = ((last - knot) / (last - before), (before - knot) / (last - before));
            (cube(knot) - a * cube(before) + b * cube(last)) / width
        })
    })
}

/// Knots with these shares of the values below them; none where two of them coincide.
pub fn quantile_knots<const N: usize>(values: &[f64], shares: [f64; N]) -> Option<[f64; N]> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let knots = shares.map(|share| quantile(&sorted, share));
    knots.windows(2).all(|pair| pair[1] - pair[0] > 1e-6).then_some(knots)
}
