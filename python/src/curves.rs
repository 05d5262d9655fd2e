//! The fits of the library for plain arrays: what `rockfrag/_curves.py` is made of.

use numpy::{IntoPyArray, PyArray1, PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rockfrag::fragility::demand::DemandInference;
use rockfrag::fragility::overturning::Curve;
use rockfrag::fragility::{
    CurveInference, CurveModel, CurveParameter, Event, Measure, Probability, ProbitIndex, Sample,
};
use rockfrag::keyword::{self, Keyword};
use rockfrag::normal;
use rockfrag::pipeline::UsageError;
use rockfrag::statistics::{FitStatus, Link, RegressionError, Test, is_separated, least_squares, reset};

use crate::error::to_python;

type Column<'py> = PyReadonlyArray1<'py, f64>;

/// The word that `name` is given as.
fn word<T: Keyword>(py: Python, name: &str, given: &str) -> PyResult<T> {
    let unknown = |wrong| to_python(py, &UsageError::because(format!("{name}: {wrong}")));
    keyword::parse(given).map_err(unknown)
}

/// The logarithms of columns, which are those of the stages and not the platform's.
fn logarithms(columns: &[Column]) -> PyResult<Vec<Vec<f64>>> {
    columns
        .iter()
        .map(|column| Ok(column.as_slice()?.iter().map(|&value| libm::log(value)).collect()))
        .collect()
}

fn matrix(k: usize, at: impl Fn(usize, usize) -> f64) -> Vec<Vec<f64>> {
    (0..k).map(|i| (0..k).map(|j| at(i, j)).collect()).collect()
}

/// A curve and the cases that it was fitted to.
fn curve(
    py: Python,
    im: &[Column],
    happened: &PyReadonlyArray1<bool>,
    link: &str,
    estimator: &str,
) -> PyResult<(Curve, Sample)> {
    let model = CurveModel {
        link: word(py, "link", link)?,
        estimator: word(py, "estimator", estimator)?,
        ..CurveModel::default()
    };
    let sample = Sample::of_happened(logarithms(im)?, happened.as_slice()?);
    // The names are those of a hybrid measure of the paper; nothing but words depends on them.
    let im_y = (im.len() == 2).then_some(Measure::Im3Inverse);
    let curve = py.detach(|| Curve::new(&sample, Event::Overturning, Measure::Im4, im_y, model));
    Ok((curve, sample))
}

fn parameter_name(parameter: CurveParameter) -> &'static str {
    match parameter {
        CurveParameter::Lambda => "lambda",
        CurveParameter::Mu => "mu",
        CurveParameter::Beta => "beta",
    }
}

/// The curve of outcomes over the logarithms of one measure or two; errors are those of clusters where there are any.
#[pyfunction]
pub fn fit_curve<'py>(
    py: Python<'py>,
    im: Vec<Column<'py>>,
    happened: PyReadonlyArray1<'py, bool>,
    link: &str,
    estimator: &str,
    clusters: Option<Vec<usize>>,
) -> PyResult<Bound<'py, PyDict>> {
    let (curve, sample) = curve(py, &im, &happened, link, estimator)?;
    let told = PyDict::new(py);
    told.set_item("status", curve.status().as_str())?;
    told.set_item("events", curve.events)?;
    let Ok(fit) = &curve.fit else { return Ok(told) };
    let inference = CurveInference::new(&sample, &fit.regression);
    let covariance = match clusters {
        Some(clusters) => inference.clustered_covariance(&clusters),
        None => fit.regression.covariance.clone(),
    };
    let coefficients: Vec<f64> = fit.regression.coefficients.iter().copied().collect();
    let rows = matrix(coefficients.len(), |i, j| covariance[(i, j)]);
    let parameters = PyDict::new(py);
    for &parameter in CurveParameter::of_curve(coefficients.len()) {
        let value = parameter.value(fit.regression.link, &fit.regression.coefficients);
        let error = inference.standard_error(parameter, &covariance);
        parameters.set_item(parameter_name(parameter), (value, error))?;
    }
    let p = |test: Option<Test>| test.map(|test| test.p);
    told.set_item("params", coefficients.into_pyarray(py))?;
    told.set_item("cov_params", PyArray2::from_vec2(py, &rows)?)?;
    told.set_item("parameters", parameters)?;
    told.set_item("llf", fit.regression.log_likelihood)?;
    told.set_item("aic", fit.aic)?;
    told.set_item("bic", fit.bic)?;
    told.set_item("auc", fit.goodness.auc)?;
    told.set_item("brier", fit.goodness.brier)?;
    told.set_item("hosmer_lemeshow_p", p(fit.goodness.hosmer_lemeshow))?;
    told.set_item("spline_p", p(curve.spline))?;
    let columns = logarithms(&im)?;
    let columns: Vec<&[f64]> = columns.iter().map(Vec::as_slice).collect();
    told.set_item("separated", is_separated(&columns, happened.as_slice()?))?;
    told.set_item("few_events", curve.has_few_events())?;
    Ok(told)
}

/// Limits of lambda, mu or beta by the profile likelihood.
#[pyfunction]
pub fn profile_limits<'py>(
    py: Python<'py>,
    im: Vec<Column<'py>>,
    happened: PyReadonlyArray1<'py, bool>,
    link: &str,
    estimator: &str,
    parameter: &str,
    level: f64,
) -> PyResult<Option<(f64, f64)>> {
    let (curve, sample) = curve(py, &im, &happened, link, estimator)?;
    let of_name = CurveParameter::ALL.into_iter().find(|known| parameter_name(*known) == parameter);
    let (Some(parameter), Ok(fit)) = (of_name, &curve.fit) else { return Ok(None) };
    let limits = py.detach(|| CurveInference::new(&sample, &fit.regression).profile_limits(parameter, level));
    Ok(Some((limits.low, limits.high)))
}

/// Least squares of a response on columns: coefficients, their covariance by clusters (each case one of its own where there are none),
/// the residual standard deviation.
#[pyfunction]
pub fn fit_line<'py>(
    py: Python<'py>,
    im: Vec<Column<'py>>,
    edp: Column<'py>,
    clusters: Option<Vec<usize>>,
) -> PyResult<Bound<'py, PyDict>> {
    let (owned, response) = (logarithms(&im)?, logarithms(&[edp])?.remove(0));
    let columns: Vec<&[f64]> = owned.iter().map(Vec::as_slice).collect();
    let told = PyDict::new(py);
    let fit = match least_squares(&columns, &response) {
        Ok(fit) => fit,
        Err(error) => {
            let status = match error {
                RegressionError::TooFewCases { .. } => FitStatus::TooFewCases,
                RegressionError::Constant => FitStatus::Constant,
                RegressionError::Collinear => FitStatus::Collinear,
            };
            told.set_item("status", status.as_str())?;
            return Ok(told);
        }
    };
    let k = fit.coefficients.len();
    let sample = Sample::of_columns(owned.clone(), response.to_vec());
    let clusters = clusters.unwrap_or_else(|| (0..response.len()).collect());
    let covariance = DemandInference::new(&sample, &fit).clustered_covariance(&clusters);
    told.set_item("status", fit.status().as_str())?;
    told.set_item("params", fit.values().iter().copied().collect::<Vec<f64>>().into_pyarray(py))?;
    told.set_item("cov_params", PyArray2::from_vec2(py, &matrix(k, |i, j| covariance[(i, j)]))?)?;
    told.set_item("residual_sd", fit.residual_sd)?;
    told.set_item("df_resid", fit.n - k)?;
    told.set_item("r2", fit.r2)?;
    told.set_item("reset_p", reset(&columns, &response, &fit).map(|test| test.p))?;
    Ok(told)
}

/// The probabilities of indices.
#[pyfunction]
pub fn probabilities<'py>(
    py: Python<'py>,
    link: &str,
    indices: Column<'py>,
) -> PyResult<Bound<'py, PyArray1<f64>>> {
    let link: Link = word(py, "link", link)?;
    let indices = indices.as_slice()?.iter();
    Ok(indices.map(|&index| link.probability(index)).collect::<Vec<f64>>().into_pyarray(py))
}

/// The index at which a share of the normal distribution lies below.
#[pyfunction]
pub fn normal_quantile(share: f64) -> f64 {
    normal::quantile(share)
}

/// The quantile of Student's t.
#[pyfunction]
pub fn t_quantile(share: f64, degrees: f64) -> f64 {
    rockfrag::statistics::t_quantile(share, degrees)
}

/// Indices and their standard errors, or lower and upper limits, as arrays.
type Pairs<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<f64>>);

fn unzipped<'py>(py: Python<'py>, indices: impl Iterator<Item = ProbitIndex>) -> Pairs<'py> {
    let (values, errors): (Vec<f64>, Vec<f64>) =
        indices.map(|index| (index.value, index.standard_error)).unzip();
    (values.into_pyarray(py), errors.into_pyarray(py))
}

/// The probability of an F as large or larger.
#[pyfunction]
pub fn f_upper_tail(f: f64, degrees: f64, further: f64) -> f64 {
    rockfrag::statistics::f_upper_tail(f, degrees, further)
}

/// The index of P_ex, from ln of the median demand and the variance of that.
#[pyfunction]
pub fn exceeding<'py>(
    py: Python<'py>,
    ln_median: Column<'py>,
    variance: Column<'py>,
    limit: f64,
    beta: f64,
    degrees: f64,
) -> PyResult<Pairs<'py>> {
    let places = ln_median.as_slice()?.iter().zip(variance.as_slice()?);
    let index =
        |(&value, &variance): (&f64, &f64)| ProbitIndex::of_exceeding(value, variance, limit, beta, degrees);
    Ok(unzipped(py, places.map(index)))
}

/// Limits of failure given rocking, from P_ro and P_ex with theirs: value, low, high.
#[pyfunction]
pub fn failure_limits<'py>(
    py: Python<'py>,
    overturning: [Column<'py>; 3],
    exceeding: [Column<'py>; 3],
) -> PyResult<Pairs<'py>> {
    let [ro, ex] = [&overturning, &exceeding].map(|of| -> PyResult<Vec<Probability>> {
        let [value, low, high] = [of[0].as_slice()?, of[1].as_slice()?, of[2].as_slice()?];
        let probability = |k: usize| Probability { value: value[k], low: low[k], high: high[k] };
        Ok((0..value.len()).map(probability).collect())
    });
    let limits = ro?.into_iter().zip(ex?).map(|(ro, ex)| Probability::of_failure(ro, ex));
    let (low, high): (Vec<f64>, Vec<f64>) = limits.map(|p| (p.low, p.high)).unzip();
    Ok((low.into_pyarray(py), high.into_pyarray(py)))
}
