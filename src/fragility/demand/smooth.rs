//! A smooth transition between two planes in place of the break.

use std::f64::consts::LN_2;
use std::ops::Range;

use nalgebra::{DMatrix, DVector, SMatrix};

use crate::fragility::sample::Sample;
use crate::normal;
use crate::statistics::FitStatus;
use crate::statistics::derivatives::{Scores, derivatives};
use crate::statistics::design::{Design, Moments, Rows, dot};
use crate::statistics::estimate::Estimate;
use crate::statistics::goodness::{Test, added_powers};
use crate::statistics::newton::{Along, Objective, newton_step};
use crate::statistics::regression::LinearFit;
use crate::statistics::search::minimum;

/// Between which logarithms of the width it is searched (0.005 and 2).
const LN_WIDTHS: (f64, f64) = (-5.298, 0.693);
/// Places of the first search.
const PLACES: usize = 48;
/// To which the logarithm of the width is found in the next.
const CLOSE: f64 = 1e-9;
/// The most steps from the width of some cases to that of all.
const MOST_STEPS: usize = 30;
/// The first of them in the logarithm of the width, and the largest.
const NEARBY: f64 = 1e-3;
const MOST: f64 = 0.1;
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
        let at = |fit: &LinearFit| dot(&[1.0, libm::log(im4), libm::log(im3)], fit.values().as_slice());
        let share = share(libm::log(im4), self.width.value);
        (1.0 - share) * at(&self.low) + share * at(&self.high)
    }
}

/// The share of the upper plane.
fn share(ln_im4: f64, width: f64) -> f64 {
    -libm::expm1(-ln_im4 / width)
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
pub fn fit_smooth(sample: &Sample, confidence: f64) -> Result<SmoothFit, FitStatus> {
    if sample.cases() <= 2 * PARAMETERS {
        return Err(FitStatus::TooFewCases);
    }
    let all = sample.design();
    let few = all.spread();
    let searched = few.as_ref().map_or(all, |few| all.of(few));
    let (low, high) = LN_WIDTHS;
    let step = (high - low) / (PLACES - 1) as f64;
    let rss = |ln_width: f64| planes(&searched, ln_width).map(|planes| planes.rss);
    // A grid first: the sum of squares may have several minima.
    let grid = (0..PLACES).map(|k| low + step * k as f64).filter_map(|at| Some((at, rss(at)?)));
    let (near, _) = grid.min_by(|a, b| a.1.total_cmp(&b.1)).ok_or(FitStatus::Collinear)?;
    if near < low + 0.5 * step || near > high - 0.5 * step {
        return Err(FitStatus::NotConverged);
    }
    let found = minimum(rss, (near - step, near + step), CLOSE).ok_or(FitStatus::Collinear)?;
    let best = if few.is_some() {
        settled(&all, found)?
    } else {
        planes(&all, found).ok_or(FitStatus::Collinear)?
    };
    with_errors(sample, &best, confidence)
}

/// The best planes of all cases, from a width nearby: where the slope of their residual on its logarithm vanishes, by secants.
fn settled(design: &Design, ln_width: f64) -> Result<Planes, FitStatus> {
    let at = |ln_width: f64| {
        let planes = planes(design, ln_width).ok_or(FitStatus::Collinear)?;
        let slope = linearised(design, &planes.coefficients, libm::exp(ln_width)).gradient[6];
        Ok((planes, slope * libm::exp(ln_width)))
    };
    let (mut before, mut here) = (at(ln_width)?, at(ln_width + NEARBY)?);
    for _ in 0..MOST_STEPS {
        let step = (here.0.ln_width - before.0.ln_width) * here.1 / (before.1 - here.1);
        if step.is_nan() || step.abs() <= CLOSE {
            return Ok(here.0);
        }
        let next = at(here.0.ln_width + step.clamp(-MOST, MOST))?;
        (before, here) = (here, next);
    }
    Err(FitStatus::NotConverged)
}

/// The best planes for one width; none if the cases do not determine both.
fn planes(design: &Design, ln_width: f64) -> Option<Planes> {
    let further = |x: &[&[f64]]| shares(x, libm::exp(ln_width));
    let design = design.with(3, &further);
    let ln_edp = |rows: &Rows, cases: Range<usize>, scores: Scores| {
        scores.slope.copy_from_slice(&rows.y[cases]);
        scores.curvature.fill(1.0);
    };
    let coefficients = newton_step(&derivatives(&design, &[], ln_edp), Along::All)?;
    let squares = |rows: &Rows| {
        let fitted = rows.indices(coefficients.as_slice());
        rows.y.iter().zip(fitted).map(|(y, fitted)| (y - fitted).powi(2)).sum::<f64>()
    };
    let rss = design.fold(0, squares, |sum, part| *sum += part);
    Some(Planes { ln_width, coefficients, rss })
}

/// What multiplies the upper plane less the lower one.
fn shares(x: &[&[f64]], width: f64) -> Vec<Vec<f64>> {
    let shares: Vec<f64> = x[0].iter().map(|x| share(*x, width)).collect();
    let times = |x: &[f64]| shares.iter().zip(x).map(|(share, x)| share * x).collect();
    let of_both = [times(x[0]), times(x[1])];
    std::iter::once(shares.clone()).chain(of_both).collect()
}

/// The same, and the derivative of ln EDP with respect to the width.
fn shares_and_width(x: &[&[f64]], b: &DVector<f64>, width: f64) -> Vec<Vec<f64>> {
    let mut further = shares(x, width);
    let by_width = x[0].iter().zip(x[1]).zip(&further[0]).map(|((x, y), share)| {
        let by_share = b[3] + b[4] * x + b[5] * y;
        -by_share * (1.0 - share) * x / (width * width)
    });
    further.push(by_width.collect());
    further
}

/// The derivatives of half the negative sum of squares with respect to all parameters.
fn linearised(design: &Design, b: &DVector<f64>, width: f64) -> Objective {
    let further = |x: &[&[f64]]| shares_and_width(x, b, width);
    let residuals = |rows: &Rows, cases: Range<usize>, mut scores: Scores| {
        for ((slope, curvature), y) in scores.iter_mut().zip(&rows.y[cases]) {
            (*slope, *curvature) = (y - *slope, 1.0);
        }
    };
    derivatives(&design.with(4, &further), b.as_slice(), residuals)
}

fn with_errors(sample: &Sample, planes: &Planes, confidence: f64) -> Result<SmoothFit, FitStatus> {
    let (n, width) = (sample.cases(), libm::exp(planes.ln_width));
    let b = &planes.coefficients;
    let variance = planes.rss / (n - PARAMETERS) as f64;
    let information = linearised(&sample.design(), b, width).information;
    let covariance = information.cholesky().ok_or(FitStatus::Collinear)?.inverse() * variance;
    let quantile = normal::quantile(0.5 * (1.0 + confidence));
    let estimate = |value: f64, variance: f64| Estimate::symmetric(value, variance.sqrt(), quantile);
    let ln_transition = estimate(LN_2 * width, LN_2 * LN_2 * covariance[(6, 6)]);
    let tss = Moments::of(&sample.design()).product(2, 2);
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
    let further = |x: &[&[f64]]| shares_and_width(x, b, width);
    let fitted = |x: &[&[f64]]| -> Vec<f64> {
        let shares = shares(x, width);
        let row = |k: usize| [1.0, x[0][k], x[1][k], shares[0][k], shares[1][k], shares[2][k]];
        (0..x[0].len()).map(|k| dot(&row(k), b.as_slice())).collect()
    };
    Ok(SmoothFit {
        width: estimate(width, covariance[(6, 6)]),
        transition: ln_transition.exp(),
        low: plane(low),
        high: plane(high),
        reset: added_powers(&sample.columns, 2, Some((4, &further)), &fitted, planes.rss),
    })
}
