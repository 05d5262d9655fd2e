//! Curves fitted anew in resamples of their cases.

use std::sync::OnceLock;

use nalgebra::DVector;

use super::bent::{BentFit, BentSample};
use super::expansion::{NearMaximum, STRAIGHT, Series};
use super::inference::CurveInference;
use crate::fragility::sample::Sample;
use crate::resampling::bootstrap::{Resamples, TOGETHER};
use crate::resampling::case_terms::CaseTerms;
use crate::statistics::binary::{BinaryFit, Estimator};

/// A curve, to be fitted in resamples of its cases.
pub struct CurveRefits<'a> {
    curve: Refitted<'a>,
    series: Option<Series>,
    /// Those of all cases.
    terms: OnceLock<Option<CaseTerms>>,
}

/// What is fitted anew.
enum Refitted<'a> {
    Straight(CurveInference<'a>),
    /// With the coefficients of the fit to all cases.
    Bent(BentSample, DVector<f64>),
}

impl Refitted<'_> {
    /// The cases of the curve, with all terms of its index.
    fn sample(&self) -> &Sample {
        match self {
            Refitted::Straight(inference) => inference.sample(),
            Refitted::Bent(bent, _) => bent.sample(),
        }
    }

    /// The coefficients where each case counts so often; none without a maximum of the likelihood.
    fn coefficients(&self, weights: &[f64], nearby: Option<DVector<f64>>) -> Option<DVector<f64>> {
        match self {
            Refitted::Straight(inference) => inference.maximum(weights, nearby),
            Refitted::Bent(bent, fitted) => {
                let from = |start: &DVector<f64>| bent.refit(weights, start);
                nearby.as_ref().and_then(from).or_else(|| from(fitted))
            }
        }
    }
}

impl<'a> CurveRefits<'a> {
    /// Of a curve and the sample it was fitted to.
    pub fn new(sample: &'a Sample, fit: &'a BinaryFit) -> CurveRefits<'a> {
        let series = (fit.estimator == Estimator::Ml).then(|| Series::about(fit, STRAIGHT)).flatten();
        let curve = Refitted::Straight(CurveInference::new(sample, fit));
        CurveRefits { curve, series, terms: OnceLock::new() }
    }

    /// Of a bent curve.
    pub(super) fn of_bent(sample: BentSample, fit: &BentFit) -> CurveRefits<'a> {
        let (series, fitted) = (sample.series(fit), sample.coefficients_of(fit));
        CurveRefits { curve: Refitted::Bent(sample, fitted), series, terms: OnceLock::new() }
    }

    /// The terms of the likelihood of some of the cases, if it is expanded.
    pub(super) fn terms(&self, some: &Sample) -> Option<CaseTerms> {
        let series = self.series.as_ref()?;
        Some(match &self.curve {
            Refitted::Straight(..) => series.case_terms(some),
            Refitted::Bent(bent, _) => series.case_terms(&bent.with_terms(some)),
        })
    }

    /// How many terms of a case are summed.
    pub(super) fn count(&self) -> usize {
        self.series.as_ref().map_or(0, Series::count)
    }

    /// The coefficients in each resample; none without a maximum of the likelihood. They are those of the expansion where it
    /// is precise; otherwise it is where Newton's steps start.
    pub fn coefficients(&self, resamples: &Resamples) -> [Option<DVector<f64>>; TOGETHER] {
        let of_all = || Some(self.series.as_ref()?.case_terms(self.curve.sample()));
        let terms = self.terms.get_or_init(of_all);
        let sums = terms.as_ref().map_or(Vec::new(), |terms| terms.sums(resamples));
        self.of_sums(sums, &|| resamples)
    }

    /// The same from the sums of the terms; `whole` tells how often each of all cases is drawn.
    pub(super) fn of_sums<'w>(
        &self,
        sums: Vec<[f64; TOGETHER]>,
        whole: &(dyn Fn() -> &'w Resamples + 'w),
    ) -> [Option<DVector<f64>>; TOGETHER] {
        let mut nearby = match &self.series {
            Some(series) => series.maxima(sums),
            None => [const { None }; TOGETHER],
        };
        let rows = OnceLock::new();
        std::array::from_fn(|resample| match nearby[resample].take() {
            Some(NearMaximum { at, precise: true }) => Some(at),
            start => {
                let weights = whole().of(resample, rows.get_or_init(|| self.curve.sample().rows()));
                self.curve.coefficients(&weights, start.map(|start| start.at))
            }
        })
    }
}
