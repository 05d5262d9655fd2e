//! A proof that events and non-events overlap, for any number of predictors.

use nalgebra::{DMatrix, DVector};

use super::binary::binary_regression;
use super::design_matrix::DesignMatrix;
use super::firth::Estimator;
use super::link::Link;

/// The rounding of a sum, as a share of the sizes of its terms.
const ROUNDING: f64 = 1e-13;

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
        rounding += ROUNDING * weight * size;
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
