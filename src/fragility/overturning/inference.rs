//! How sure the parameters of a curve are: clustered errors, profile-likelihood limits and acceleration.

use std::sync::OnceLock;

use nalgebra::{DMatrix, DVector};

use crate::fragility::held_out::HeldOut;
use crate::fragility::overturning::expansion::{Polynomial, STRAIGHT};
use crate::fragility::overturning::parameter::CurveParameter;
use crate::fragility::overturning::profile::profile_limits;
use crate::fragility::sample::Sample;
use crate::resampling::bootstrap::{Sizes, Strata};
use crate::resampling::limits::{Moves, acceleration_of, add_move, join_moves};
use crate::statistics::binary::{BinaryFit, BinaryLikelihood, Estimator};
use crate::statistics::design::Rows;
use crate::statistics::estimate::Limits;
use crate::statistics::influence::Influence;
use crate::statistics::newton::{Along, Maximum, maximise};
use crate::statistics::separation::is_separable;

/// Plain Newton steps from nearby are fewer than this; more raise the suspicion that there is no maximum.
const SUSPICIOUS_STEPS: usize = 6;

/// A curve with the cases it was fitted to.
pub struct CurveInference<'a> {
    sample: &'a Sample,
    fit: &'a BinaryFit,
    influence: Influence,
    /// The likelihood about the fit, where there are many cases.
    polynomial: OnceLock<Option<Polynomial>>,
}

impl<'a> CurveInference<'a> {
    /// Of a curve and the sample it was fitted to.
    pub fn new(sample: &'a Sample, fit: &'a BinaryFit) -> CurveInference<'a> {
        CurveInference { sample, fit, influence: Influence::of_regression(fit), polynomial: OnceLock::new() }
    }

    pub(super) fn sample(&self) -> &Sample {
        self.sample
    }

    /// The covariance of the coefficients where cases of one cluster may depend on each other; `clusters` are those of all
    /// cases.
    pub fn clustered_covariance(&self, clusters: &[usize]) -> DMatrix<f64> {
        self.sandwich(|rows, case| clusters[rows.labels[0][case] as usize])
    }

    /// The same, of the clusters of the sample.
    pub fn covariance_by_cluster(&self) -> DMatrix<f64> {
        self.sandwich(|rows, case| rows.labels[1][case] as usize)
    }

    fn sandwich(&self, cluster: impl Fn(&Rows, usize) -> usize + Sync) -> DMatrix<f64> {
        self.influence.clustered_covariance(&self.sample.design(), &self.fit.covariance, cluster)
    }

    /// What cases say that were left out, whole clusters of the sample at once.
    pub fn held_out(&self) -> Option<HeldOut> {
        let thinned = self.sample.thinned();
        let some = CurveInference::new(thinned.as_ref().unwrap_or(self.sample), self.fit);
        HeldOut::new(
            &some.sample.design(),
            self.fit.link,
            |weights| some.coefficients(weights),
            |b, rows| rows.indices(b.as_slice()),
            |y| y != 0.0,
        )
    }

    /// The standard error of a parameter that follows from a covariance of the coefficients.
    pub fn standard_error(&self, parameter: CurveParameter, covariance: &DMatrix<f64>) -> f64 {
        parameter.standard_error(self.fit.link, &self.fit.coefficients, covariance)
    }

    /// Limits of a parameter by the profile likelihood.
    pub fn profile_limits(&self, parameter: CurveParameter, confidence: f64) -> Limits {
        let polynomial = self.polynomial.get_or_init(|| {
            let is_worth_it = self.fit.estimator == Estimator::Ml && self.sample.design().is_many();
            is_worth_it.then(|| Polynomial::about(self.fit, &self.sample.design())).flatten()
        });
        let likelihood = self.likelihood(None);
        match polynomial.as_ref().filter(|polynomial| polynomial.holds(confidence)) {
            Some(polynomial) => profile_limits(&|b| polynomial.at(b), self.fit, parameter, confidence),
            None => profile_limits(&|b| likelihood.at(b), self.fit, parameter, confidence),
        }
    }

    /// The coefficients where each case of the sample counts so often; none without a maximum of the likelihood.
    pub fn coefficients(&self, weights: &[f64]) -> Option<DVector<f64>> {
        let step = || self.influence.step(&self.sample.design(), weights);
        let likelihood = self.fit.estimator == Estimator::Ml;
        self.maximum(weights, likelihood.then(step).flatten().map(|step| &self.fit.coefficients + step))
    }

    /// The same, by plain Newton steps of the likelihood alone if they may start nearby.
    pub(crate) fn maximum(&self, weights: &[f64], nearby: Option<DVector<f64>>) -> Option<DVector<f64>> {
        let likelihood = self.likelihood(Some(weights));
        if let Some(start) = nearby {
            let plain = maximise(|b| likelihood.derivatives_at(b), &start, Along::All, STRAIGHT.gain);
            if let Some(Maximum { at, .. }) = plain.filter(|maximum| maximum.steps < SUSPICIOUS_STEPS) {
                return Some(at);
            }
        }
        if self.fit.estimator == Estimator::Ml && self.separated(weights) {
            return None;
        }
        let nearby = likelihood.maximise(&self.fit.coefficients, Along::All, STRAIGHT.gain);
        nearby.or_else(|| likelihood.highest(STRAIGHT.gain)).map(|maximum| maximum.at)
    }

    /// The parameters of the curve.
    pub fn curve_parameters(&self) -> &'static [CurveParameter] {
        CurveParameter::of_curve(self.fit.coefficients.len())
    }

    /// A parameter of the fit itself.
    pub fn fitted(&self, parameter: CurveParameter) -> f64 {
        parameter.value(self.fit.link, &self.fit.coefficients)
    }

    /// A parameter in each of these refits; none where there is no fit or its slope has the other sign.
    pub fn parameters(&self, parameter: CurveParameter, refits: &[Option<DVector<f64>>]) -> Vec<Option<f64>> {
        let value = |b: &DVector<f64>| parameter.refitted(self.fit.link, b, &self.fit.coefficients);
        refits.iter().map(|b| b.as_ref().and_then(value)).collect()
    }

    /// The acceleration of a parameter for BCa limits.
    pub fn acceleration(&self, parameter: CurveParameter, strata: &Strata) -> f64 {
        let cell = |rows: &Rows, case: usize| strata.label_of(rows.labels[0][case] as usize);
        self.acceleration_within(parameter, &strata.sizes(), cell)
    }

    /// The same within the cells of the sample, which have such sizes among all cases.
    pub fn acceleration_by_cell(&self, parameter: CurveParameter, sizes: &Sizes) -> f64 {
        self.acceleration_within(parameter, sizes, |rows, case| rows.labels[2][case] as usize)
    }

    fn acceleration_within(
        &self,
        parameter: CurveParameter,
        sizes: &Sizes,
        cell: impl Fn(&Rows, usize) -> usize + Sync,
    ) -> f64 {
        let (link, fitted, value) = (self.fit.link, &self.fit.coefficients, self.fitted(parameter));
        let of_block = |rows: &Rows| {
            let mut moves = Moves::new();
            let changes = self.influence.without_each(rows, &self.fit.covariance);
            for (case, change) in changes.into_iter().enumerate() {
                let by = parameter.value(link, &(fitted + change)) - value;
                add_move(&mut moves, cell(rows, case), by);
            }
            moves
        };
        acceleration_of(&self.sample.design().fold(3, of_block, join_moves), sizes)
    }

    fn likelihood<'b>(&'b self, weights: Option<&'b [f64]>) -> BinaryLikelihood<'b> {
        let BinaryFit { link, estimator, .. } = *self.fit;
        BinaryLikelihood { design: self.sample.design(), weights, link, estimator }
    }

    fn separated(&self, weights: &[f64]) -> bool {
        let drawn = |values: &[f64]| -> Vec<f64> {
            values.iter().zip(weights).filter(|(_, weight)| **weight > 0.0).map(|(x, _)| *x).collect()
        };
        let columns = self.sample.predictors().iter().map(|values| drawn(values)).collect();
        is_separable(&Sample::of_columns(columns, drawn(&self.sample.observed())).design())
    }
}
