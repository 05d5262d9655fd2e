//! A smooth transition between two planes in place of the break.

use std::f64::consts::LN_2;

use nalgebra::{DMatrix, DVector, SMatrix};

use super::FitStatus;
use super::binary::Derivatives;
use super::demand_sample::DemandSample;
use super::design_matrix::dot;
use super::goodness::{Test, added_powers};
use super::newton::{Along, newton_step};
use super::regression::{Estimate, LinearFit};
use crate::normal;

/// Between which ln IM4 the centre of the transition is searched (1.05 and 2, as for the break), and between which
/// logarithms its width (0.002 and 0.3).
const CENTRES: (f64, f64) = (0.049, LN_2);
const LN_WIDTHS: (f64, f64) = (-6.215, -1.204);
/// Places of each in the first search.
const PLACES: usize = 16;
/// To which the logarithm of the width is found in the next.
const CLOSE: f64 = 1e-6;
/// Coefficients: of two planes, and centre and width.
const PARAMETERS: usize = 8;

/// Two planes that pass into one another: ln EDP = (1 - w) low + w high, w = 1/(1 + exp(-(ln IM4 - ln s)/d)) (a logistic
/// smooth transition regression: Terasvirta 1994, J. American Statistical Association 89, 208-218).
#[derive(Debug, Clone, PartialEq)]
pub struct SmoothFit {
    /// The IM4 s at which both planes count the same.
    pub transition: Estimate,
    /// The width d, in ln IM4; at its least, 0.002, a break.
    pub width: Estimate,
    /// The plane far below; residuals and cases are those of both.
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
        let share = weight(im4.ln(), self.transition.value.ln(), self.width.value);
        (1.0 - share) * at(&self.low) + share * at(&self.high)
    }
}

/// The share of the upper plane.
fn weight(ln_im4: f64, centre: f64, width: f64) -> f64 {
    1.0 / (1.0 + (-(ln_im4 - centre) / width).exp())
}

/// A fit of both planes for one centre and width.
struct Planes {
    centre: f64,
    ln_width: f64,
    /// Lower plane, then upper less lower.
    coefficients: DVector<f64>,
    rss: f64,
}

/// Least squares of a sample of IM4 and IM3. For each centre and width the planes follow linearly; these two are found by
/// a grid that is narrowed step by step. Errors of all eight parameters by linearisation, limits by the normal
/// distribution.
///
/// # Errors
/// With the status that says why there is no fit.
pub fn fit_smooth(sample: &DemandSample, confidence: f64) -> Result<SmoothFit, FitStatus> {
    let n = sample.ln_edp.len();
    if n <= 2 * PARAMETERS {
        return Err(FitStatus::TooFewCases);
    }
    let between = |(low, high): (f64, f64), k: usize| low + (high - low) * k as f64 / (PLACES - 1) as f64;
    let grid = (0..PLACES * PLACES)
        .filter_map(|k| planes(sample, between(CENTRES, k / PLACES), between(LN_WIDTHS, k % PLACES)));
    let mut best = grid.min_by(|a, b| a.rss.total_cmp(&b.rss)).ok_or(FitStatus::Collinear)?;
    let step = |(low, high): (f64, f64)| (high - low) / (PLACES - 1) as f64;
    let (mut along_centre, mut along_width) = (step(CENTRES), step(LN_WIDTHS));
    while along_width > CLOSE {
        let around = [(-1.0, 0.0), (1.0, 0.0), (0.0, -1.0), (0.0, 1.0)].into_iter().filter_map(|(i, j)| {
            let centre = (best.centre + i * along_centre).clamp(CENTRES.0, CENTRES.1);
            planes(sample, centre, (best.ln_width + j * along_width).clamp(LN_WIDTHS.0, LN_WIDTHS.1))
        });
        match around.min_by(|a, b| a.rss.total_cmp(&b.rss)).filter(|near| near.rss < best.rss) {
            Some(near) => best = near,
            None => (along_centre, along_width) = (0.5 * along_centre, 0.5 * along_width),
        }
    }
    Ok(with_errors(sample, &best, confidence))
}

/// The best planes for one centre and width; none where too few cases lie on a side.
fn planes(sample: &DemandSample, centre: f64, ln_width: f64) -> Option<Planes> {
    let mut sums = Derivatives::new(6);
    for ((&x, &y), &ln_edp) in sample.ln_im[0].iter().zip(&sample.ln_im[1]).zip(&sample.ln_edp) {
        sums.add(&row(x, y, weight(x, centre, ln_width.exp())), ln_edp, 1.0);
    }
    let coefficients = newton_step(&sums.objective(), Along::All)?;
    let square = |((&x, &y), ln_edp): ((&f64, &f64), &f64)| {
        let row = row(x, y, weight(x, centre, ln_width.exp()));
        (ln_edp - dot(&row, coefficients.as_slice())).powi(2)
    };
    let rss = sample.ln_im[0].iter().zip(&sample.ln_im[1]).zip(&sample.ln_edp).map(square).sum();
    Some(Planes { centre, ln_width, coefficients, rss })
}

/// What multiplies the lower plane, and the upper less the lower.
fn row(x: f64, y: f64, share: f64) -> [f64; 6] {
    [1.0, x, y, share, share * x, share * y]
}

fn with_errors(sample: &DemandSample, planes: &Planes, confidence: f64) -> SmoothFit {
    let (n, width) = (sample.ln_edp.len(), planes.ln_width.exp());
    let b = &planes.coefficients;
    // The derivatives of ln EDP with respect to all parameters.
    let of_case = |case: usize| -> [f64; PARAMETERS] {
        let (x, y) = (sample.ln_im[0][case], sample.ln_im[1][case]);
        let share = weight(x, planes.centre, width);
        let by_share = (b[3] + b[4] * x + b[5] * y) * share * (1.0 - share);
        let [c0, c1, c2, c3, c4, c5] = row(x, y, share);
        [c0, c1, c2, c3, c4, c5, -by_share / width, -by_share * (x - planes.centre) / (width * width)]
    };
    let jacobian = DMatrix::from_fn(n, PARAMETERS, |case, k| of_case(case)[k]);
    let variance = planes.rss / (n - PARAMETERS) as f64;
    let information = jacobian.transpose() * &jacobian;
    let covariance = information.cholesky().map(|factor| factor.inverse() * variance);
    let quantile = normal::quantile(0.5 * (1.0 + confidence));
    // A break leaves no case to tell the width from: errors are then not known.
    let covariance = covariance.unwrap_or(DMatrix::from_element(PARAMETERS, PARAMETERS, f64::NAN));
    let estimate = |value: f64, variance: f64| Estimate::symmetric(value, variance.sqrt(), quantile);
    let centre = estimate(planes.centre, covariance[(6, 6)]);
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
    SmoothFit {
        transition: Estimate {
            value: centre.value.exp(),
            standard_error: centre.value.exp() * centre.standard_error,
            low: centre.low.exp(),
            high: centre.high.exp(),
        },
        width: estimate(width, covariance[(7, 7)]),
        low: plane(low),
        high: plane(high),
        reset: added_powers(&columns, &residuals, &fitted, planes.rss),
    }
}
