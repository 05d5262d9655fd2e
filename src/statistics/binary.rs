//! Maximum likelihood of binary outcomes, and Firth's penalised likelihood, which has a maximum even where a measure separates the
//! outcomes, and less bias where events are few.

use std::ops::Range;

use nalgebra::{DMatrix, DVector};

use crate::keyword::keywords;
use crate::statistics::derivatives::{Scores, derivatives, sum};
use crate::statistics::design::{Design, Rows, columns_of};
use crate::statistics::link::{Information, Link};
use crate::statistics::newton::{Along, Maximum, Objective, maximise};

/// A binary regression with an intercept: P(event) = F(b0 + b1 x1 + ...).
#[derive(Debug, Clone, PartialEq)]
pub struct BinaryFit {
    /// F.
    pub link: Link,
    /// What was maximised.
    pub estimator: Estimator,
    /// Intercept first.
    pub coefficients: DVector<f64>,
    /// Inverse of the information: observed of the likelihood, expected of Firth's.
    pub covariance: DMatrix<f64>,
    /// Of the coefficients, without a penalty.
    pub log_likelihood: f64,
    /// What was maximised: the log-likelihood, with the penalty if there is one.
    pub objective: f64,
}

impl BinaryFit {
    /// b0 + b1 x1 + ... of each of some cases.
    pub fn indices(&self, rows: &Rows) -> Vec<f64> {
        rows.indices(self.coefficients.as_slice())
    }
}

/// Why Newton's iterations found no maximum.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the likelihood has no maximum that Newton's iterations reach")]
pub struct BinaryError;

/// Maximises the Bernoulli likelihood of `events` (true: it happened), or as `estimator` says Firth's of them, by Newton's
/// method, Firth's from several starts: it may have more maxima than one. `predictors` are each as long as `events`. Under separation the likelihood has no maximum, and the iterations
/// may still stop, far out where it is flat: [`is_separated`](crate::statistics::is_separated) must be asked first.
///
/// # Errors
/// If the iterations do not converge, or the predictors are collinear.
pub fn binary_regression(
    predictors: &[&[f64]],
    events: &[bool],
    link: Link,
    estimator: Estimator,
) -> Result<BinaryFit, BinaryError> {
    let columns = columns_of(predictors, as_numbers(events));
    regress(Design::new(&columns, predictors.len()), link, estimator)
}

/// 1 where something happened, 0 where it did not.
pub fn as_numbers(events: &[bool]) -> Vec<f64> {
    events.iter().map(|&event| f64::from(u8::from(event))).collect()
}

/// The same of a design, in which an event was observed where there is no 0.
///
/// # Errors
/// As there.
pub fn regress(design: Design, link: Link, estimator: Estimator) -> Result<BinaryFit, BinaryError> {
    let likelihood = BinaryLikelihood { design, weights: None, link, estimator };
    let Maximum { at, objective, .. } = match estimator {
        Estimator::Ml => {
            let flat = likelihood.flat(0.0);
            // Where cases are many, from the maximum of some of them.
            let few = design.spread();
            let of_few = few.as_ref().and_then(|few| {
                let likelihood = BinaryLikelihood { design: design.of(few), ..likelihood };
                Some(likelihood.maximise(&flat, Along::All, 0.0)?.at)
            });
            let near = of_few.and_then(|near| likelihood.maximise(&near, Along::All, 0.0));
            near.or_else(|| likelihood.maximise(&flat, Along::All, 0.0))
        }
        Estimator::Firth => likelihood.highest(FIRTH_TOLERANCE),
    }
    .ok_or(BinaryError)?;
    let information = match estimator {
        Estimator::Ml => objective.information,
        Estimator::Firth => penalty(&likelihood, &at).ok_or(BinaryError)?.information,
    };
    let covariance = information.cholesky().ok_or(BinaryError)?.inverse();
    let log_likelihood = BinaryLikelihood { estimator: Estimator::Ml, ..likelihood }.at(&at).value;
    Ok(BinaryFit {
        link,
        estimator,
        coefficients: at,
        covariance,
        log_likelihood,
        objective: objective.value,
    })
}

/// What the last step to the maximum of Firth's likelihood may promise; it is taken, and squares the error.
const FIRTH_TOLERANCE: f64 = 1e-14;
/// Maxima that differ by less are the same.
const SAME: f64 = 1e-9;
/// Where the search for the maximum of Firth's likelihood starts: indices that are the same in all cases,
const FLAT_STARTS: [f64; 5] = [0.0, -3.0, -1.0, 1.0, 2.0];
/// the curve of the logit, steeper or flatter by these factors, with these added to its index,
const STEEPER: [f64; 3] = [0.5, 1.0, 2.0];
const SHIFTED: [f64; 3] = [-1.0, 0.0, 1.0];
/// and an index that rises as that of the logit with these standard deviations, 0 halfway between the lowest event and the highest other.
const STEEP: [f64; 4] = [1.0, 3.0, 9.0, 27.0];

/// The likelihood of outcomes as a function of the coefficients.
#[derive(Clone, Copy)]
pub struct BinaryLikelihood<'a> {
    /// With what happened.
    pub design: Design<'a>,
    /// How often each case counts, if not once.
    pub weights: Option<&'a [f64]>,
    /// F.
    pub link: Link,
    /// Whether it is penalised.
    pub estimator: Estimator,
}

impl BinaryLikelihood<'_> {
    /// The maximum from `start`, to within `tolerance` of the log-likelihood.
    pub fn maximise(&self, start: &DVector<f64>, along: Along, tolerance: f64) -> Option<Maximum> {
        maximise(|coefficients| self.at(coefficients), start, along, tolerance)
    }

    /// The highest of the maxima that Newton's method finds from several starts.
    pub fn highest(&self, tolerance: f64) -> Option<Maximum> {
        let logit = BinaryLikelihood { link: Link::Logit, ..*self };
        let logit = logit.maximise(&self.flat(0.0), Along::All, tolerance);
        let curves = logit.iter().flat_map(|Maximum { at, .. }| {
            let shifted = move |steeper: f64| SHIFTED.map(|shift| at * steeper + self.flat(shift));
            STEEPER.into_iter().flat_map(shifted).chain(self.steep(at))
        });
        let starts = FLAT_STARTS.into_iter().map(|index| self.flat(index)).chain(curves);
        let found = starts.filter_map(|start| self.maximise(&start, Along::All, tolerance));
        let maxima = found.filter(|found| self.is_maximum(&found.at));
        // Of those that are the same but for rounding, the first.
        let is_higher = |a: &Maximum, b: &Maximum| a.objective.value > b.objective.value + SAME;
        maxima.reduce(|best, next| if is_higher(&next, &best) { next } else { best })
    }

    /// Coefficients of steep indices in the direction of these.
    fn steep(&self, direction: &DVector<f64>) -> [DVector<f64>; STEEP.len()] {
        let of_block = |rows: &Rows| {
            let mut seen = ([f64::INFINITY, f64::NEG_INFINITY], [0.0; 3]);
            let (within, sums) = (&mut seen.0, &mut seen.1);
            for (row, index) in rows.indices(direction.as_slice()).into_iter().enumerate() {
                if weight(self.weights, rows.first + row) > 0.0 {
                    match rows.y[row] != 0.0 {
                        true => within[0] = index.min(within[0]),
                        false => within[1] = index.max(within[1]),
                    }
                    sums.iter_mut().zip([index, index * index, 1.0]).for_each(|(sum, of)| *sum += of);
                }
            }
            seen
        };
        let add = |seen: &mut ([f64; 2], [f64; 3]), (within, sums): ([f64; 2], [f64; 3])| {
            seen.0 = [within[0].min(seen.0[0]), within[1].max(seen.0[1])];
            seen.1.iter_mut().zip(sums).for_each(|(sum, of)| *sum += of);
        };
        let ([lowest_event, highest_other], [sum, squares, cases]) = self.design.fold(0, of_block, add);
        let sd = (squares / cases - (sum / cases) * (sum / cases)).max(0.0).sqrt();
        let centred = direction + self.flat(-0.5 * (lowest_event + highest_other));
        STEEP.map(|steep| &centred * (steep / sd))
    }

    /// Coefficients of an index that is the same in all cases.
    fn flat(&self, index: f64) -> DVector<f64> {
        DVector::from_fn(self.design.coefficients(), |k, _| if k == 0 { index } else { 0.0 })
    }

    /// Whether the likelihood falls in all directions from here, where its first derivatives vanish.
    fn is_maximum(&self, at: &DVector<f64>) -> bool {
        let curvature = self.derivatives_at(at).information;
        let penalty = || penalty(self, at).map(|penalty| penalty.curvature);
        match self.estimator {
            Estimator::Ml => curvature.cholesky().is_some(),
            Estimator::Firth => penalty().is_some_and(|penalty| (curvature + penalty).cholesky().is_some()),
        }
    }

    /// Value and derivatives at these coefficients. With a penalty the function need not be concave: where it is not, the expected
    /// information of the likelihood stands in for the second derivatives.
    pub fn at(&self, coefficients: &DVector<f64>) -> Objective {
        let mut objective = self.derivatives_at(coefficients);
        objective.value = self.log_likelihood(coefficients);
        if self.estimator == Estimator::Firth {
            match penalty(self, coefficients) {
                Some(penalty) => {
                    objective.value += penalty.value;
                    objective.gradient += penalty.gradient;
                    let curvature = &objective.information + penalty.curvature;
                    let is_concave = curvature.clone().cholesky().is_some();
                    objective.information = if is_concave { curvature } else { penalty.information };
                }
                None => objective.value = f64::NEG_INFINITY,
            }
        }
        objective
    }

    fn log_likelihood(&self, coefficients: &DVector<f64>) -> f64 {
        sum(
            &self.design,
            coefficients.as_slice(),
            #[inline(always)]
            |rows, cases, values| {
                self.link.ln_probabilities(&rows.y[cases.clone()], values);
                if let Some(weights) = self.weights {
                    let weights = &weights[rows.first..][cases];
                    values.iter_mut().zip(weights).for_each(|(value, &weight)| count(value, weight));
                }
            },
        )
    }

    /// Derivatives of the likelihood alone, its value left at zero: all that plain Newton steps need, in a fraction of the
    /// time.
    pub fn derivatives_at(&self, coefficients: &DVector<f64>) -> Objective {
        derivatives(
            &self.design,
            coefficients.as_slice(),
            #[inline(always)]
            |rows, cases, mut scores| {
                self.link.scores(&rows.y[cases.clone()], scores.reborrow());
                if let Some(weights) = self.weights {
                    for ((slope, curvature), &weight) in scores.iter_mut().zip(&weights[rows.first..][cases])
                    {
                        count(slope, weight);
                        count(curvature, weight);
                    }
                }
            },
        )
    }
}

/// Lets a value count so often. Where it does not it need not be finite.
#[inline(always)]
fn count(value: &mut f64, weight: f64) {
    *value = if weight > 0.0 { weight * *value } else { 0.0 };
}

fn weight(weights: Option<&[f64]>, case: usize) -> f64 {
    weights.map_or(1.0, |weights| weights[case])
}

/// What is maximised.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Estimator {
    /// The likelihood.
    #[default]
    Ml,
    /// The likelihood times the root of the determinant of the expected information (Firth 1993, Biometrika 80, 27-38;
    /// Heinze & Schemper 2002, Statistics in Medicine 21, 2409-2419).
    Firth,
}

keywords!(Estimator { Ml = "ml", Firth = "firth" });

/// The logarithm of Firth's factor.
pub struct Penalty {
    /// Half the logarithm of the determinant of the expected information.
    pub value: f64,
    /// Its first derivatives.
    pub gradient: DVector<f64>,
    /// The negative of its second derivatives.
    pub curvature: DMatrix<f64>,
    /// The expected information.
    pub information: DMatrix<f64>,
}

/// Firth's penalty at these coefficients; none where the information is singular.
pub fn penalty(likelihood: &BinaryLikelihood, coefficients: &DVector<f64>) -> Option<Penalty> {
    let BinaryLikelihood { design, weights, link, .. } = likelihood;
    let expected = |rows: &Rows, cases: Range<usize>, mut scores: Scores| {
        for (case, (slope, curvature)) in cases.zip(scores.iter_mut()) {
            let weight = weight(*weights, rows.first + case);
            *curvature = if weight > 0.0 { weight * link.information(*slope).weight } else { 0.0 };
            *slope = 0.0;
        }
    };
    let information = derivatives(design, coefficients.as_slice(), expected).information;
    let factor = information.clone().cholesky()?;
    let inverse = factor.inverse();
    let k = coefficients.len();
    // The gradient, the curvature, and the derivative of the information with respect to each coefficient.
    let of_block = |rows: &Rows| {
        let (mut gradient, mut curvature) = (DVector::zeros(k), DMatrix::zeros(k, k));
        let mut slopes = vec![DMatrix::zeros(k, k); k];
        let indices = rows.indices(coefficients.as_slice());
        for (case, (row, index)) in rows.each().zip(indices).enumerate() {
            let weight = weight(*weights, rows.first + case);
            if weight > 0.0 {
                let of_case = link.information(index);
                let Information { weight: of_case, ln_weight_slope: slope, ln_weight_curvature } = of_case;
                let leverage = weight * of_case * (&inverse * &row).dot(&row);
                gradient.axpy(0.5 * leverage * slope, &row, 1.0);
                curvature.syger(-0.5 * leverage * (slope * slope + ln_weight_curvature), &row, &row, 1.0);
                for (slopes, x) in slopes.iter_mut().zip(&row) {
                    slopes.syger(weight * of_case * slope * x, &row, &row, 1.0);
                }
            }
        }
        (gradient, curvature, slopes)
    };
    let (gradient, mut curvature, mut slopes) = design.fold(0, of_block, |sums, part| {
        sums.0 += part.0;
        sums.1 += part.1;
        sums.2.iter_mut().zip(part.2).for_each(|(sum, slope)| *sum += slope);
    });
    let relative: Vec<DMatrix<f64>> = slopes
        .iter_mut()
        .map(|slope| {
            slope.fill_upper_triangle_with_lower_triangle();
            inverse.tr_mul(slope)
        })
        .collect();
    curvature.fill_upper_triangle_with_lower_triangle();
    curvature += DMatrix::from_fn(k, k, |i, j| 0.5 * relative[i].tr_dot(&relative[j]));
    let value = factor.l_dirty().diagonal().map(libm::log).sum();
    Some(Penalty { value, gradient, curvature, information })
}
