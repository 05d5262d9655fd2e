//! Fits thousands of resamples without a pass over the cases for each Newton step.
//!
//! The log-likelihood of a resample (Eq. 19) is a sum over cases of n_i l_i(b), in which only the counts n_i differ between resamples.
//! Each l_i is expanded once, at the fit to all cases, into a Taylor polynomial of the coefficients b: with u = b - fit, the index of a
//! case moves by x_i'u, and (x_i'u)^k is a sum of monomials of u. A resample is then the sum over cases of n_i times their factors
//! ([`CaseTerms`]): 28 numbers, or 84 of two measures (35 or 210 of bent curves), that hold all that is needed of it, and cost no
//! exponential. The penalty of a bent curve is quadratic, and is added. Newton's method maximises that polynomial, for [`TOGETHER`]
//! resamples at once in the lanes of a register.
//!
//! u is measured along the Cholesky factor of the covariance, in standard errors, so that the monomials are of one size and the last
//! two degrees tell how large those are that are left out. Where these might matter, or the steps do not settle, the result is only
//! where Newton's steps on the likelihood itself start.

use nalgebra::{DMatrix, DVector};
use pulp::NullaryFnOnce;

use crate::fragility::sample::Sample;
use crate::normal;
use crate::resampling::bootstrap::TOGETHER;
use crate::resampling::case_terms::CaseTerms;
use crate::resampling::monomials::Monomials;
use crate::resampling::normal_equations::{LeastSquares, NormalEquations};
use crate::statistics::binary::BinaryFit;
use crate::statistics::derivatives::Scores;
use crate::statistics::design::{Design, Rows, triangle_place};
use crate::statistics::link::{Link, ln_probability_series};
use crate::statistics::newton::Objective;
use crate::wide::{widest, widest_on};

/// The highest degree of a polynomial.
const ORDER: usize = 6;
/// Of refits of straight curves: the last step moves the coefficients by some 1e-3 of their standard errors, and Newton's convergence
/// squares that.
pub const STRAIGHT: Precision = Precision { order: ORDER, gain: 1e-6, left_out: 2e-6 };
/// Of refits of bent ones: in 19 of 20 cases the index is off by less than 0.03 of its standard error (`tests/fits/bent.rs`). Six
/// coefficients have 210 monomials up to this degree, 924 up to the other.
pub const BENT: Precision = Precision { order: 4, gain: 1e-4, left_out: 0.03 };
/// Where the polynomial is precise it takes fewer steps.
const MOST_STEPS: usize = 10;

/// Where the polynomial says that the likelihood is greatest.
pub struct NearMaximum {
    pub at: DVector<f64>,
    /// Whether it is precise there.
    pub precise: bool,
}

/// How near to the maximum is near enough.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Precision {
    /// The degree of the polynomial, at most [`ORDER`].
    pub order: usize,
    /// What the last step may gain in log-likelihood.
    pub gain: f64,
    /// By how many standard errors the terms that are left out may move the maximum. That is taken to be less than what the last two
    /// degrees do by as much as those do less than the two degrees before (`tests/uncertainty/bootstrap.rs`).
    pub left_out: f64,
}

/// How a log-likelihood is expanded about a fit.
pub struct Series {
    link: Link,
    fitted: DVector<f64>,
    /// From standard errors, in which the coefficients do not depend on each other, to coefficients.
    scale: DMatrix<f64>,
    monomials: Monomials,
    precision: Precision,
    /// What multiplies each monomial up to the second degree in the penalty, if there is one.
    penalty: Vec<f64>,
}

impl Series {
    /// None if the covariance of the fit is not definite.
    pub fn about(fit: &BinaryFit, precision: Precision) -> Option<Series> {
        let (fitted, scale) = (fit.coefficients.clone(), fit.covariance.clone().cholesky()?.l());
        let monomials = Monomials::new(fitted.len(), precision.order);
        Some(Series { link: fit.link, fitted, scale, monomials, precision, penalty: Vec::new() })
    }

    /// Of the log-likelihood less half the square of each coefficient times so much.
    pub fn penalised(self, penalty: &DVector<f64>) -> Series {
        let Series { fitted, scale, monomials, .. } = &self;
        let pull = scale.tr_mul(&penalty.component_mul(fitted));
        let weighted = DMatrix::from_fn(scale.nrows(), scale.ncols(), |i, j| penalty[i] * scale[(i, j)]);
        let curvature = scale.tr_mul(&weighted);
        let constant = -0.5 * penalty.dot(&fitted.component_mul(fitted));
        let penalty = monomials.quadratic(constant, &-pull, &-curvature);
        Series { penalty, ..self }
    }

    /// What multiplies each monomial in the log-likelihood of each case.
    fn terms(&self, rows: &Rows) -> Vec<Vec<f64>> {
        let of_index = self.of_index(rows);
        let terms = rows.each().zip(of_index);
        terms
            .map(|(row, series)| self.monomials.powers_of_sum(self.scale.tr_mul(&row).as_slice(), &series))
            .collect()
    }

    /// The powers of a change of the index of each case.
    fn of_index(&self, rows: &Rows) -> Vec<[f64; ORDER + 1]> {
        let indices = rows.indices(self.fitted.as_slice());
        let (mut values, mut slopes, mut curvatures) =
            (indices.clone(), indices.clone(), vec![0.0; indices.len()]);
        widest_on(
            (&mut values, Scores { slope: &mut slopes, curvature: &mut curvatures }),
            #[inline(always)]
            |(values, scores)| {
                self.link.ln_probabilities(rows.y, values);
                self.link.scores(rows.y, scores);
            },
        );
        let of_case = |case: usize| {
            let event = rows.y[case] != 0.0;
            ln_probability_series(self.link, event, indices[case], values[case], slopes[case])
        };
        (0..indices.len()).map(of_case).collect()
    }

    /// What multiplies each monomial in the log-likelihood of all cases.
    fn sums(&self, design: &Design) -> Vec<f64> {
        let of_block = |rows: &Rows| {
            let of_index = self.of_index(rows);
            let along = |k: usize| -> Vec<f64> {
                let mut along = vec![0.0; rows.count()];
                for (x, scale) in rows.x.iter().zip(self.scale.column(k).iter()) {
                    along.iter_mut().zip(*x).for_each(|(along, x)| *along += scale * x);
                }
                along
            };
            let moved: Vec<Vec<f64>> = (0..rows.x.len()).map(along).collect();
            self.monomials.sums_of_powers(&moved, &of_index)
        };
        design.fold(0, of_block, |sums, part| sums.iter_mut().zip(part).for_each(|(sum, part)| *sum += part))
    }

    /// The terms of each case of a sample, to be summed.
    pub fn case_terms(&self, sample: &Sample) -> CaseTerms {
        let of_all = sample.design().fold(0, |rows| self.terms(rows), |all, part| all.extend(part));
        CaseTerms::new(&sample.rows(), self.count(), of_all.into_iter())
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.monomials.count()
    }

    /// The maximum in each resample, or where one Newton step leads; none where that leads nowhere.
    pub fn maxima(&self, mut factors: Vec<[f64; TOGETHER]>) -> [Option<NearMaximum>; TOGETHER] {
        for (factors, penalty) in factors.iter_mut().zip(&self.penalty) {
            factors.iter_mut().for_each(|factor| *factor += penalty);
        }
        let Precision { gain, left_out: most, .. } = self.precision;
        let Maxima { at, first, settled, left_out } =
            widest(NewtonSteps { monomials: &self.monomials, factors: &factors, tolerance: gain });
        std::array::from_fn(|resample| {
            let of_resample = |of: &[[f64; TOGETHER]]| {
                let moved = DVector::from_iterator(of.len(), of.iter().map(|moved| moved[resample]));
                self.coefficients(&moved)
            };
            let precise = settled[resample] && left_out[resample] < most;
            let at = of_resample(if settled[resample] { &at } else { &first });
            at.iter().all(|b| b.is_finite()).then_some(NearMaximum { at, precise })
        })
    }

    /// Coefficients, from how far they are from the fit in standard errors.
    fn coefficients(&self, moved: &DVector<f64>) -> DVector<f64> {
        &self.fitted + &self.scale * moved
    }
}

/// The log-likelihood of all cases about their fit: where they are many, as good as itself as far as limits of confidence lie.
pub struct Polynomial {
    series: Series,
    /// From coefficients to standard errors.
    inverse: DMatrix<f64>,
    factors: Vec<[f64; 1]>,
}

/// What terms that are left out may add to the log-likelihood.
const LEAST_TERM: f64 = 1e-9;

impl Polynomial {
    /// None if the covariance of the fit is not definite.
    pub fn about(fit: &BinaryFit, design: &Design) -> Option<Polynomial> {
        let series = Series::about(fit, STRAIGHT)?;
        let inverse = series.scale.clone().try_inverse()?;
        let mut factors: Vec<[f64; 1]> = series.sums(design).into_iter().map(|factor| [factor]).collect();
        factors[0] = [fit.log_likelihood];
        Some(Polynomial { series, inverse, factors })
    }

    /// Whether the terms that are left out add nothing to it within limits of this confidence: taken to be less than the last two
    /// degrees by as much as these are less than the two before.
    pub fn holds(&self, confidence: f64) -> bool {
        let monomials = &self.series.monomials;
        let away = 1.2 * normal::quantile(0.5 * (1.0 + confidence));
        let most = |degree: usize| {
            let factors = &self.factors[monomials.of_degree(degree)];
            away.powi(degree as i32) * factors.iter().map(|[factor]| factor.abs()).sum::<f64>()
        };
        let order = monomials.order();
        let (last, before) = (most(order) + most(order - 1), most(order - 2) + most(order - 3));
        last * last <= LEAST_TERM * before
    }

    /// Its value and derivatives at these coefficients.
    pub fn at(&self, coefficients: &DVector<f64>) -> Objective {
        let (monomials, factors) = (&self.series.monomials, &self.factors);
        let moved: Vec<[f64; 1]> =
            (&self.inverse * (coefficients - &self.series.fitted)).iter().map(|u| [*u]).collect();
        let values = monomials.values(&moved);
        let gradients = monomials.gradients(factors, &values, 0..monomials.count());
        let curvatures = monomials.second_derivatives(factors, &values);
        let k = moved.len();
        let gradient = DVector::from_iterator(k, gradients.into_iter().flatten());
        let information = DMatrix::from_fn(k, k, |i, j| -curvatures[triangle_place(i, j)][0]);
        Objective {
            value: factors.iter().zip(&values).map(|([factor], [value])| factor * value).sum(),
            gradient: self.inverse.tr_mul(&gradient),
            information: self.inverse.tr_mul(&information.tr_mul(&self.inverse)),
        }
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
        let order = monomials.order();
        let (before, last) = (moved_by([order - 3, order - 2]), moved_by([order - 1, order]));
        let left_out = std::array::from_fn(|resample| last[resample] * last[resample] / before[resample]);
        Maxima { at, first, settled, left_out }
    }
}
