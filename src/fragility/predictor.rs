//! What both fits are at heart: b0 + b1 ln IMx + b2 ln IMy.

use nalgebra::{DMatrix, DVector};

use super::case::Measure;
use crate::motion::IntensityMeasures;

/// A linear function of the logarithms of one measure or two, with the uncertainty of its coefficients.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Predictor {
    /// First measure.
    pub im_x: Measure,
    /// Second measure, if any.
    pub im_y: Option<Measure>,
    /// b0, b1 and b2; b2 is 0 without a second measure.
    pub coefficients: [f64; 3],
    /// Covariance of the coefficients.
    pub covariance: [[f64; 3]; 3],
    /// Least and largest value of each measure in the data.
    pub ranges: [[f64; 2]; 2],
}

/// The value of a predictor at an intensity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Predicted {
    /// The best estimate.
    pub value: f64,
    /// Its variance, from that of the coefficients.
    pub variance: f64,
}

/// A measure outside of the range of the data that a fit comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutOfRange {
    pub measure: Measure,
    pub value: f64,
    /// Least and largest value in the data.
    pub range: [f64; 2],
}

impl Predictor {
    /// Of one measure or two, the coefficients of a regression on their logarithms (intercept first), the covariance of these, and
    /// the least and largest value of each measure.
    pub fn new(
        measures: &[Measure],
        coefficients: &DVector<f64>,
        covariance: &DMatrix<f64>,
        ranges: &[[f64; 2]],
    ) -> Predictor {
        let at = |k: usize| coefficients.get(k).copied().unwrap_or(0.0);
        let of_both = |i: usize, j: usize| covariance.get((i, j)).copied().unwrap_or(0.0);
        Predictor {
            im_x: measures[0],
            im_y: measures.get(1).copied(),
            coefficients: [0, 1, 2].map(at),
            covariance: [0, 1, 2].map(|i| [0, 1, 2].map(|j| of_both(i, j))),
            ranges: [0, 1].map(|k| ranges.get(k).copied().unwrap_or([0.0; 2])),
        }
    }

    /// Its value and variance; none where a measure is missing.
    pub fn at(&self, measures: &IntensityMeasures) -> Option<Predicted> {
        let ln_y = match self.im_y {
            Some(im_y) => im_y.among(measures)?.ln(),
            None => 0.0,
        };
        let row = [1.0, self.im_x.among(measures)?.ln(), ln_y];
        let dot = |a: &[f64; 3]| a[0] * row[0] + a[1] * row[1] + a[2] * row[2];
        let variance = dot(&[0, 1, 2].map(|i| dot(&self.covariance[i])));
        Some(Predicted { value: dot(&self.coefficients), variance })
    }

    /// The one measure that it is a function of: the hybrid IMx^(b1/(b1 + b2)) IMy^(b2/(b1 + b2)) of two (Eq. 23, with
    /// lambda = b1/b2). None where a measure is missing.
    pub fn hybrid_measure(&self, measures: &IntensityMeasures) -> Option<f64> {
        let [b0, b1, b2] = self.coefficients;
        Some(((self.at(measures)?.value - b0) / (b1 + b2)).exp())
    }

    /// The measures it needs.
    pub fn measures(&self) -> impl Iterator<Item = Measure> {
        std::iter::once(self.im_x).chain(self.im_y)
    }

    /// The measures that lie outside of the range of the data.
    pub fn out_of_range(&self, measures: &IntensityMeasures) -> impl Iterator<Item = OutOfRange> {
        let out = |(measure, range): (Measure, [f64; 2])| {
            let value = measure.among(measures)?;
            (value < range[0] || value > range[1]).then_some(OutOfRange { measure, value, range })
        };
        self.measures().zip(self.ranges).filter_map(out)
    }
}
