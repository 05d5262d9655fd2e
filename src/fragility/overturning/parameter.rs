//! The parameters of a fragility curve as functions of the coefficients of its regression.

use nalgebra::{DMatrix, DVector};

use crate::statistics::link::Link;

/// A parameter of the curve F((ln IM - mu) / beta + m), where m is the index of the median: 0, but for the complementary
/// log-log link.
///
/// Of two measures IM is the hybrid IMx^(lambda/(1 + lambda)) IMy^(1/(1 + lambda)) (Eq. 23), so that the index is
/// b0 + b1 ln IMx + b2 ln IMy with the slope b1 + b2 on ln IM; of one, b1 is the slope.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CurveParameter {
    /// Exponent of the first of two measures, b1/b2.
    Lambda,
    /// ln of the median, (m - b0)/slope: for the probit, the mean of ln IM at the event.
    Mu,
    /// Dispersion, 1/slope: for the probit, the standard deviation of ln IM at the event; for the others, the scale of
    /// their distribution.
    Beta,
}

impl CurveParameter {
    /// All of them.
    pub const ALL: [CurveParameter; 3] = [CurveParameter::Lambda, CurveParameter::Mu, CurveParameter::Beta];

    /// Those that a curve with so many coefficients has.
    pub fn of_curve(coefficients: usize) -> &'static [CurveParameter] {
        if coefficients == 3 { &Self::ALL } else { &Self::ALL[1..] }
    }

    /// Its value at the coefficients `b`.
    pub fn value(self, link: Link, b: &DVector<f64>) -> f64 {
        match self {
            CurveParameter::Lambda => b[1] / last(b),
            CurveParameter::Mu => (link.median_index() - b[0]) / slope(b),
            CurveParameter::Beta => 1.0 / slope(b),
        }
    }

    /// Its standard error, by the delta method, where the coefficients `b` have this covariance.
    pub fn standard_error(self, link: Link, b: &DVector<f64>, covariance: &DMatrix<f64>) -> f64 {
        let gradient = self.gradient(link, b);
        (covariance * &gradient).dot(&gradient).sqrt()
    }

    fn gradient(self, link: Link, b: &DVector<f64>) -> DVector<f64> {
        let slope = slope(b);
        let (of_intercept, of_slopes) = match self {
            CurveParameter::Lambda => {
                return DVector::from_vec(vec![0.0, 1.0 / last(b), -b[1] / (last(b) * last(b))]);
            }
            CurveParameter::Mu => (-1.0 / slope, (b[0] - link.median_index()) / (slope * slope)),
            CurveParameter::Beta => (0.0, -1.0 / (slope * slope)),
        };
        DVector::from_fn(b.len(), |k, _| if k == 0 { of_intercept } else { of_slopes })
    }

    /// Its value in a refit with coefficients `b` of a curve with coefficients `fitted`; none where the slope that
    /// divides it has the other sign: between the two it passes through infinity.
    pub fn refitted(self, link: Link, b: &DVector<f64>, fitted: &DVector<f64>) -> Option<f64> {
        let divisor = |b: &DVector<f64>| match self {
            CurveParameter::Lambda => last(b),
            CurveParameter::Mu | CurveParameter::Beta => slope(b),
        };
        (divisor(b) * divisor(fitted) > 0.0).then(|| self.value(link, b))
    }
}

fn last(b: &DVector<f64>) -> f64 {
    b[b.len() - 1]
}

/// The slope of the index on ln IM.
pub fn slope(b: &DVector<f64>) -> f64 {
    b.iter().skip(1).sum()
}
