//! Curves with terms that the lognormal one has not. Whether they are needed,
//! [`likelihood_ratio`](crate::statistics::likelihood_ratio) tells.

use super::curves::CurveModel;
use super::sample::EventSample;
use crate::statistics::FitStatus;
use crate::statistics::binary::{BinaryFit, binary_regression};
use crate::statistics::dependence::dependence;
use crate::statistics::spline::natural_spline;

/// The index bends with the first measure, as a natural cubic spline of its logarithm.
///
/// # Errors
/// With the status that says why there is none.
pub fn fit_with_spline(sample: &EventSample, model: &CurveModel) -> Result<BinaryFit, FitStatus> {
    fit_with(sample, &natural_spline(sample.predictors()[0]), model)
}

/// The slope on one measure depends on the other: a product of their logarithms; of a single measure its square.
///
/// # Errors
/// With the status that says why there is none.
pub fn fit_with_interaction(sample: &EventSample, model: &CurveModel) -> Result<BinaryFit, FitStatus> {
    let predictors = sample.predictors();
    let pairs = predictors[0].iter().zip(predictors[predictors.len() - 1]);
    fit_with(sample, &[pairs.map(|(x, y)| x * y).collect()], model)
}

fn fit_with(sample: &EventSample, terms: &[Vec<f64>], model: &CurveModel) -> Result<BinaryFit, FitStatus> {
    let predictors: Vec<&[f64]> =
        sample.predictors().into_iter().chain(terms.iter().map(Vec::as_slice)).collect();
    if dependence(&predictors).is_some() {
        return Err(FitStatus::Collinear);
    }
    binary_regression(&predictors, &sample.happened, model.link, model.estimator)
        .map_err(|_| FitStatus::NotConverged)
}
