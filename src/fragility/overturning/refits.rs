//! Curves of resampled cases.

use nalgebra::DVector;

use super::expansion::{Expansion, Nearby};
use super::inference::{CurveInference, TOLERANCE};
use super::sample::EventSample;
use crate::resampling::bootstrap::{Resamples, TOGETHER};
use crate::statistics::binary::BinaryFit;
use crate::statistics::firth::Estimator;

/// A curve, to be fitted in resamples of its cases.
pub struct CurveRefits<'a> {
    rows: &'a [usize],
    inference: CurveInference<'a>,
    expansion: Option<Expansion>,
}

impl<'a> CurveRefits<'a> {
    /// Of a curve and the sample it was fitted to.
    pub fn new(sample: &'a EventSample, fit: &'a BinaryFit) -> CurveRefits<'a> {
        let expansion = (fit.estimator == Estimator::Ml).then(|| Expansion::new(sample, fit)).flatten();
        CurveRefits { rows: &sample.rows, inference: CurveInference::new(sample, fit), expansion }
    }

    /// The coefficients in each resample; none without a maximum of the likelihood. They are those of the expansion where it
    /// is precise; otherwise it is where Newton's steps start.
    pub fn coefficients(&self, resamples: &Resamples) -> [Option<DVector<f64>>; TOGETHER] {
        let mut nearby = match &self.expansion {
            Some(expansion) => expansion.maxima(resamples, TOLERANCE),
            None => [const { None }; TOGETHER],
        };
        std::array::from_fn(|resample| match nearby[resample].take() {
            Some(Nearby { at, precise: true }) => Some(at),
            start => {
                let weights = resamples.of(resample, self.rows);
                self.inference.maximum(&weights, start.map(|start| start.at))
            }
        })
    }
}
