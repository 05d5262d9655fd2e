//! Fits thousands of resamples without a pass over the cases for each Newton step.
//!
//! The log-likelihood of a resample (Eq. 19) is a sum over cases of n_i l_i(b), in which only the counts n_i differ between resamples.
//! Each l_i is expanded once, at the fit to all cases, into a Taylor polynomial of the coefficients b: with u = b - fit, the index of a
//! case moves by x_i'u, and (x_i'u)^k is a sum of monomials of u. A resample is then the sum over cases of n_i times their factors
//! ([`CaseTerms`]): 28 numbers, or 84 of two measures, that hold all that is needed of it, and cost no exponential. Newton's method maximises that
//! polynomial, for [`TOGETHER`] resamples at once in the lanes of a register.
//!
//! u is measured along the Cholesky factor of the covariance, in standard errors, so that the monomials are of one size and the last
//! two degrees tell how large those are that are left out. Where these might matter, or the steps do not settle, the result is only
//! where Newton's steps on the likelihood itself start.

use nalgebra::{DMatrix, DVector};
use pulp::NullaryFnOnce;

use super::sample::EventSample;
use crate::resampling::bootstrap::{Resamples, TOGETHER};
use crate::resampling::case_terms::CaseTerms;
use crate::resampling::monomials::Monomials;
use crate::resampling::normal_equations::{LeastSquares, NormalEquations};
use crate::statistics::binary::BinaryFit;
use crate::statistics::derivatives::Scores;
use crate::statistics::link::ln_probability_series;
use crate::wide::widest;

/// The degree of the polynomial.
const ORDER: usize = 6;
/// By how many standard errors the terms that are left out may move the maximum. That is taken to be less than what the last two
/// degrees do by as much as those do less than the two degrees before (`tests/uncertainty/bootstrap.rs`).
const LEFT_OUT: f64 = 2e-6;
/// Where the polynomial is precise it takes fewer steps.
const MOST_STEPS: usize = 10;

/// The log-likelihood of resamples about a fit.
pub struct Expansion {
    fitted: DVector<f64>,
    /// From standard errors, in which the coefficients do not depend on each other, to coefficients.
    scale: DMatrix<f64>,
    monomials: Monomials,
    terms: CaseTerms,
}

/// Where the polynomial says that the likelihood is greatest.
pub struct NearMaximum {
    pub at: DVector<f64>,
    /// Whether it is precise there.
    pub precise: bool,
}

impl Expansion {
    /// About a fit by maximum likelihood to a sample. None if its covariance is not definite.
    pub fn new(sample: &EventSample, fit: &BinaryFit) -> Option<Expansion> {
        let scale = fit.covariance.clone().cholesky()?.l();
        let monomials = Monomials::new(fit.coefficients.len(), ORDER);
        let design = sample.design();
        let (indices, events) = (fit.indices(&design), &sample.happened);
        let (mut values, mut slopes, mut curvatures) =
            (indices.clone(), indices.clone(), vec![0.0; indices.len()]);
        widest(
            #[inline(always)]
            || {
                fit.link.ln_probabilities(events, &mut values);
                fit.link.scores(events, Scores { slope: &mut slopes, curvature: &mut curvatures });
            },
        );
        let terms = design.rows().enumerate().map(|(case, row)| {
            let series: [f64; ORDER + 1] =
                ln_probability_series(fit.link, events[case], indices[case], values[case], slopes[case]);
            monomials.powers_of_sum(scale.tr_mul(&row).as_slice(), &series)
        });
        let terms = CaseTerms::new(&sample.rows, monomials.count(), terms);
        Some(Expansion { fitted: fit.coefficients.clone(), scale, monomials, terms })
    }

    /// The maximum in each resample to within `tolerance` of the log-likelihood, or where one Newton step leads; none
    /// where that leads nowhere.
    pub fn maxima(&self, resamples: &Resamples, tolerance: f64) -> [Option<NearMaximum>; TOGETHER] {
        let factors = self.terms.sums(resamples);
        let Maxima { at, first, settled, left_out } =
            widest(NewtonSteps { monomials: &self.monomials, factors: &factors, tolerance });
        std::array::from_fn(|resample| {
            let of_resample = |of: &[[f64; TOGETHER]]| {
                let moved = DVector::from_iterator(of.len(), of.iter().map(|moved| moved[resample]));
                &self.fitted + &self.scale * moved
            };
            let precise = settled[resample] && left_out[resample] < LEFT_OUT;
            let at = of_resample(if settled[resample] { &at } else { &first });
            at.iter().all(|b| b.is_finite()).then_some(NearMaximum { at, precise })
        })
    }
}

/// Newton's steps for the polynomials of all resamples at once.
struct NewtonSteps<'a> {
    monomials: &'a Monomials,
    factors: &'a [[f64; TOGETHER]],
    tolerance: f64,
}

/// Where they lead.
struct Maxima {
    at: Vec<[f64; TOGETHER]>,
    /// Where the first one leads.
    first: Vec<[f64; TOGETHER]>,
    /// Whether they come to an end.
    settled: [bool; TOGETHER],
    /// By how many standard errors the terms that are left out may move it.
    left_out: [f64; TOGETHER],
}

impl NullaryFnOnce for NewtonSteps<'_> {
    type Output = Maxima;

    #[inline(always)]
    fn call(self) -> Maxima {
        let NewtonSteps { monomials, factors, tolerance } = self;
        let mut at = vec![[0.0; TOGETHER]; monomials.variables()];
        let mut first = Vec::new();
        let mut settled = [false; TOGETHER];
        for _ in 0..MOST_STEPS {
            let values = monomials.values(&at);
            let gradients = monomials.gradients(factors, &values, 0..monomials.count());
            let curvatures = monomials.second_derivatives(factors, &values);
            // Newton's step s solves H s = g, H the information and g the gradient. That is what least squares solves: products
            // of which the predictors' are H, those with the response g, and of the response with itself 0. Its residual sum of
            // squares is then 0 - g's, and -rss / 2 what the quadratic model promises to gain: the test of convergence.
            let information = curvatures.into_iter().map(|curvature| curvature.map(|c| -c));
            let products = information.chain(gradients).chain([[0.0; TOGETHER]]).collect();
            let LeastSquares { coefficients: steps, rss } = NormalEquations { products }.solve(at.len());
            for (at, step) in at.iter_mut().zip(&steps) {
                for resample in 0..TOGETHER {
                    at[resample] += if settled[resample] { 0.0 } else { step[resample] };
                }
            }
            if first.is_empty() {
                first.clone_from(&at);
            }
            for (settled, rss) in settled.iter_mut().zip(rss) {
                *settled |= -0.5 * rss <= tolerance;
            }
            if settled == [true; TOGETHER] {
                break;
            }
        }
        let values = monomials.values(&at);
        // By how much each of two degrees moves the maximum.
        let moved_by = |degrees: [usize; 2]| {
            let mut moved = [0.0; TOGETHER];
            for degree in degrees {
                let gradients = monomials.gradients(factors, &values, monomials.of_degree(degree));
                for (resample, moved) in moved.iter_mut().enumerate() {
                    *moved += gradients.iter().map(|g| g[resample] * g[resample]).sum::<f64>().sqrt();
                }
            }
            moved
        };
        let (before, last) = (moved_by([ORDER - 3, ORDER - 2]), moved_by([ORDER - 1, ORDER]));
        let left_out = std::array::from_fn(|resample| last[resample] * last[resample] / before[resample]);
        Maxima { at, first, settled, left_out }
    }
}
