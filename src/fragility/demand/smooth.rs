//! A smooth transition between two planes in place of the break.

use std::f64::consts::LN_2;
use std::ops::Range;

use nalgebra::{DMatrix, DVector, SMatrix};

use super::sample::DemandSample;
use crate::normal;
use crate::statistics::FitStatus;
use crate::statistics::derivatives::{Scores, derivatives};
use crate::statistics::design::{DesignMatrix, dot};
use crate::statistics::estimate::Estimate;
use crate::statistics::goodness::{Test, added_powers};
use crate::statistics::newton::{Along, newton_step};
use crate::statistics::regression::LinearFit;
use crate::statistics::search::minimum;

/// Between which logarithms of the width it is searched (0.005 and 2).
const LN_WIDTHS: (f64, f64) = (-5.298, 0.693);
/// Places of the first search.
const PLACES: usize = 48;
/// To which the logarithm of the width is found in the next.
const CLOSE: f64 = 1e-9;
/// Coefficients of two planes, and the width.
const PARAMETERS: usize = 7;

/// Two planes that pass into one another: ln EDP = (1 - w) low + w high, where the share w = 1 - IM4^(-1/d) of the upper one
/// grows from 0 at uplift towards 1. (A logistic share would have a centre as well; on the paper's motions it runs off to
/// below uplift, where the logistic is this one.)
#[derive(Debug, Clone, PartialEq)]
pub struct SmoothFit {
    /// The width d, in ln IM4.
    pub width: Estimate,
    /// The IM4 at which both planes count the same, 2^d.
    pub transition: Estimate,
    /// The plane at uplift; residuals and cases are those of both.
    pub low: LinearFit,
    /// The plane far above.
    pub high: LinearFit,
    /// Ramsey's test on the linearised model.
    pub reset: Option<Test>,
}

impl SmoothFit {
    /// ln of the median demand at these measures.
    pub fn ln_demand(&self, im4: f64, im3: f64) -> f64 {
        let at = |fit: &LinearFit| dot(&[1.0, im4.ln(), im3.ln()], fit.values().as_slice());
        let share = share(im4.ln(), self.width.value);
        (1.0 - share) * at(&self.low) + share * at(&self.high)
    }
}

/// The share of the upper plane.
fn share(ln_im4: f64, width: f64) -> f64 {
    -(-ln_im4 / width).exp_m1()
}

/// A fit of both planes for one width.
struct Planes {
    ln_width: f64,
    /// Lower plane, then upper less lower.
    coefficients: DVector<f64>,
    rss: f64,
}

/// Least squares of a sample of IM4 and IM3. For each width the planes follow linearly; the width is found by a search
/// that narrows. Errors of all seven parameters by linearisation, limits by the normal distribution.
///
/// # Errors
/// With the status that says why there is no fit: too few cases, or no width better than the least or the largest.
pub fn fit_smooth(sample: &DemandSample, confidence: f64) -> Result<SmoothFit, FitStatus> {
    if sample.ln_edp.len() <= 2 * PARAMETERS {
        return Err(FitStatus::TooFewCases);
    }
    let (low, high) = LN_WIDTHS;
    let step = (high - low) / (PLACES - 1) as f64;
    let rss = |ln_width: f64| planes(sample, ln_width).map(|planes| planes.rss);
    // A grid first: the sum of squares may have several minima.
    let grid = (0..PLACES).map(|k| low + step * k as f64).filter_map(|at| Some((at, rss(at)?)));
    let (near, _) = grid.min_by(|a, b| a.1.total_cmp(&b.1)).ok_or(FitStatus::Collinear)?;
    if near < low + 0.5 * step || near > high - 0.5 * step {
        return Err(FitStatus::NotConverged);
    }
    let best = minimum(rss, (near - step, near + step), CLOSE).and_then(|at| planes(sample, at));
    let best = best.ok_or(FitStatus::Collinear)?;
    with_errors(sample, &best, confidence)
}

/// The best planes for one width; none if the cases do not determine both.
fn planes(sample: &DemandSample, ln_width: f64) -> Option<Planes> {
    let (n, width) = (sample.ln_edp.len(), ln_width.exp());
    let mut columns: [Vec<f64>; 5] = std::array::from_fn(|_| Vec::with_capacity(n));
    for (&x, &y) in sample.ln_im[0].iter().zip(&sample.ln_im[1]) {
        let [_, predictors @ ..] = row(x, y, share(x, width));
        columns.iter_mut().zip(predictors).for_each(|(column, predictor)| column.push(predictor));
    }
    let design = DesignMatrix::new(&columns.each_ref().map(Vec::as_slice), n);
    let ln_edp = |cases: Range<usize>, scores: Scores| {
        scores.slope.copy_from_slice(&sample.ln_edp[cases]);
        scores.curvature.fill(1.0);
    };
    let coefficients = newton_step(&derivatives(&design, &[], ln_edp), Along::All)?;
    let fitted = design.indices(coefficients.as_slice());
    let rss = sample.ln_edp.iter().zip(fitted).map(|(y, fitted)| (y - fitted).powi(2)).sum();
    Some(Planes { ln_width, coefficients, rss })
}

/// What multiplies the lower plane, and the upper less the lower.
fn row(x: f64, y: f64, share: f64) -> [f64; 6] {
    [1.0, x, y, share, share * x, share * y]
}

fn with_errors(sample: &DemandSample, planes: &Planes, confidence: f64) -> Result<SmoothFit, FitStatus> {
    let (n, width) = (sample.ln_edp.len(), planes.ln_width.exp());
    let b = &planes.coefficients;
    // The derivatives of ln EDP with respect to all parameters.
    let of_case = |case: usize| -> [f64; PARAMETERS] {
        let (x, y) = (sample.ln_im[0][case], sample.ln_im[1][case]);
        let share = share(x, width);
        let by_share = b[3] + b[4] * x + b[5] * y;
        let [c0, c1, c2, c3, c4, c5] = row(x, y, share);
        [c0, c1, c2, c3, c4, c5, -by_share * (1.0 - share) * x / (width * width)]
    };
    let jacobian = DMatrix::from_fn(n, PARAMETERS, |case, k| of_case(case)[k]);
    let variance = planes.rss / (n - PARAMETERS) as f64;
    let information = jacobian.transpose() * &jacobian;
    let covariance = information.cholesky().ok_or(FitStatus::Collinear)?.inverse() * variance;
    let quantile = normal::quantile(0.5 * (1.0 + confidence));
    let estimate = |value: f64, variance: f64| Estimate::symmetric(value, variance.sqrt(), quantile);
    let ln_transition = estimate(LN_2 * width, LN_2 * LN_2 * covariance[(6, 6)]);
    let mean = sample.ln_edp.iter().sum::<f64>() / n as f64;
    let tss: f64 = sample.ln_edp.iter().map(|y| (y - mean).powi(2)).sum();
    // Each plane as a combination of the parameters.
    let plane = |of: SMatrix<f64, 3, PARAMETERS>| {
        let covariance =
            DMatrix::from_fn(3, 3, |i, j| (of.row(i) * &covariance * of.row(j).transpose())[(0, 0)]);
        let value = |k: usize| (0..6).map(|j| of[(k, j)] * b[j]).sum();
        LinearFit {
            coefficients: (0..3).map(|k| estimate(value(k), covariance[(k, k)])).collect(),
            covariance,
            r2: 1.0 - planes.rss / tss,
            residual_sd: variance.sqrt(),
            rss: planes.rss,
            tss,
            n,
        }
    };
    let low = SMatrix::from_fn(|i, j| f64::from(u8::from(i == j)));
    let high = SMatrix::from_fn(|i, j| f64::from(u8::from(i == j || i + 3 == j)));
    let fitted: Vec<f64> = (0..n).map(|case| dot(&of_case(case)[..6], b.as_slice())).collect();
    let columns: Vec<&[f64]> = jacobian.as_slice().chunks(n).skip(1).collect();
    let residuals: Vec<f64> = sample.ln_edp.iter().zip(&fitted).map(|(y, fitted)| y - fitted).collect();
    Ok(SmoothFit {
        width: estimate(width, covariance[(6, 6)]),
        transition: ln_transition.exp(),
        low: plane(low),
        high: plane(high),
        reset: added_powers(&columns, &residuals, &fitted, planes.rss),
    })
}
