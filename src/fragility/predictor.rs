//! What both fits are at heart: b0 + b1 ln IMx + b2 ln IMy, and how that may bend.

use nalgebra::{DMatrix, DVector};

use super::case::Measure;
use crate::motion::IntensityMeasures;
use crate::statistics::design::restricted_splines;

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
    /// What makes it bend; none of a straight line.
    pub bend: Option<Bend>,
    /// Standard deviation of its value between magnitudes and distances, none of which it has seen; 0 where their differences
    /// average out.
    pub spread: f64,
}

/// How many terms a bent index has: those of the line and those of the bend.
pub const BENT_TERMS: usize = 6;

/// What makes a linear function bend: a natural cubic spline of the logarithm of each measure, and the product of both.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bend {
    /// Three for each measure; beyond the outer ones the spline is straight.
    pub knots: [[f64; 3]; 2],
    /// Of the two splines and the product.
    pub coefficients: [f64; 3],
    /// Covariance of all coefficients, those of the line first.
    pub covariance: [[f64; BENT_TERMS]; BENT_TERMS],
}

impl Bend {
    /// The two splines and the product; without a second measure only the first is other than 0.
    pub fn terms(knots: &[[f64; 3]; 2], ln_x: f64, ln_y: Option<f64>) -> [f64; 3] {
        let spline = |u: f64, knots: &[f64; 3]| restricted_splines(u, knots).next().unwrap_or(0.0);
        let of_second = ln_y.map_or([0.0; 2], |ln_y| [spline(ln_y, &knots[1]), ln_x * ln_y]);
        [spline(ln_x, &knots[0]), of_second[0], of_second[1]]
    }
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
            bend: None,
            spread: 0.0,
        }
    }

    /// Its value and variance; none where a measure is missing.
    pub fn at(&self, measures: &IntensityMeasures) -> Option<Predicted> {
        let ln_y = match self.im_y {
            Some(im_y) => libm::log(im_y.among(measures)?),
            None => 0.0,
        };
        let row = [1.0, libm::log(self.im_x.among(measures)?), ln_y];
        let dot = |a: &[f64; 3]| a[0] * row[0] + a[1] * row[1] + a[2] * row[2];
        let line = dot(&self.coefficients);
        let (value, variance) = match &self.bend {
            None => (line, dot(&[0, 1, 2].map(|i| dot(&self.covariance[i])))),
            Some(bend) => {
                let terms = Bend::terms(&bend.knots, row[1], self.im_y.map(|_| row[2]));
                let bent: f64 = terms.iter().zip(&bend.coefficients).map(|(term, b)| term * b).sum();
                let all = [row[0], row[1], row[2], terms[0], terms[1], terms[2]];
                let dot = |a: &[f64; BENT_TERMS]| a.iter().zip(&all).map(|(a, term)| a * term).sum::<f64>();
                (line + bent, dot(&bend.covariance.each_ref().map(dot)))
            }
        };
        Some(Predicted { value, variance: variance + self.spread * self.spread })
    }

    /// The one measure that it is a function of: the hybrid IMx^(b1/(b1 + b2)) IMy^(b2/(b1 + b2)) of two (Eq. 23, with
    /// lambda = b1/b2). None where a measure is missing, or the function bends.
    pub fn hybrid_measure(&self, measures: &IntensityMeasures) -> Option<f64> {
        if self.bend.is_some() {
            return None;
        }
        let [b0, b1, b2] = self.coefficients;
        Some(libm::exp((self.at(measures)?.value - b0) / (b1 + b2)))
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
