//! Whether a regression can tell its predictors apart.

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
