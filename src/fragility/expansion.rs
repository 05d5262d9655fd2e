//! The log-likelihood of resampled cases about the fit to all of them, as a polynomial of the coefficients. Its terms are sums of
//! what is known of each case beforehand, so that a resample costs no exponential.

use nalgebra::{DMatrix, DVector};

use super::binary::BinaryFit;
use super::bootstrap::{Resamples, TOGETHER};
use super::case_terms::CaseTerms;
use super::event_sample::EventSample;
use super::link_series::ln_probability_series;
use super::monomials::Monomials;
use super::newton::{Along, Objective, maximise, newton_step};

/// The degree of the polynomial.
const ORDER: usize = 6;
/// By how many standard errors the terms of the last two degrees may move the maximum. Those that are left out then move it by
/// a tenth of that or less (`tests/uncertainty/bootstrap.rs`).
const LAST_TERMS: f64 = 1e-4;

/// The log-likelihood of resamples about a fit.
pub struct Expansion {
    fitted: DVector<f64>,
    /// From standard errors, in which the coefficients do not depend on each other, to coefficients.
    scale: DMatrix<f64>,
    monomials: Monomials,
    terms: CaseTerms,
}

/// Where the polynomial says that the likelihood is greatest.
pub struct Nearby {
    /// The coefficients.
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
        let cases = fit.indices(&design).into_iter().zip(&sample.happened).zip(design.rows());
        let terms = cases.map(|((index, &event), row)| {
            let series: [f64; ORDER + 1] = ln_probability_series(fit.link, index, event);
            monomials.powers_of_sum(scale.tr_mul(&row).as_slice(), &series)
        });
        let terms = CaseTerms::new(&sample.rows, monomials.count(), terms);
        Some(Expansion { fitted: fit.coefficients.clone(), scale, monomials, terms })
    }

    /// The maximum in each resample to within `tolerance` of the log-likelihood, or where one Newton step leads; none
    /// where that leads nowhere.
    pub fn maxima(&self, resamples: &Resamples, tolerance: f64) -> [Option<Nearby>; TOGETHER] {
        let sums = self.terms.sums(resamples);
        std::array::from_fn(|resample| {
            let factors: Vec<f64> = sums.iter().map(|sum| sum[resample]).collect();
            self.maximum(&factors, tolerance)
        })
    }

    fn maximum(&self, factors: &[f64], tolerance: f64) -> Option<Nearby> {
        let start = DVector::zeros(self.fitted.len());
        let polynomial = |at: &DVector<f64>| self.derivatives(factors, at);
        let (moved, precise) = match maximise(polynomial, &start, Along::All, tolerance) {
            Some(maximum) => {
                let values = self.monomials.values(maximum.at.as_slice());
                let last = self.monomials.gradient(factors, &values, self.monomials.degrees_from(ORDER - 1));
                (maximum.at, last.norm() < LAST_TERMS)
            }
            None => (newton_step(&polynomial(&start), Along::All)?, false),
        };
        Some(Nearby { at: &self.fitted + &self.scale * moved, precise })
    }

    fn derivatives(&self, factors: &[f64], at: &DVector<f64>) -> Objective {
        let values = self.monomials.values(at.as_slice());
        Objective {
            value: 0.0,
            gradient: self.monomials.gradient(factors, &values, 0..self.monomials.count()),
            information: -self.monomials.second_derivatives(factors, &values),
        }
    }
}
