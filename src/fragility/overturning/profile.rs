//! Limits of confidence by the profile likelihood: no symmetry is assumed, and no limit where the likelihood sets none.

use nalgebra::{DMatrix, DVector};

use super::parameter::{CurveParameter, slope};
use crate::normal;
use crate::statistics::binary::BinaryFit;
use crate::statistics::estimate::Limits;
use crate::statistics::newton::{Along, Objective, maximise};
use crate::statistics::search::root;

/// What the last Newton step to a constrained maximum may gain.
const TOLERANCE: f64 = 1e-13;
/// To which limits are exact, in standard errors.
const CLOSE: f64 = 1e-10;
/// How much calmer the coefficients are from which a search starts that failed.
const CALMER: [f64; 2] = [1.0, 0.5];
/// Steps outwards, each twice the last, before a limit counts as infinitely far.
const MOST_STEPS: usize = 20;

/// The values of a parameter at which the likelihood, maximised over all else, lies within half the quantile of chi
/// squared of its maximum (Venzon & Moolgavkar 1988, Applied Statistics 37, 87-94; for a penalised likelihood Heinze &
/// Schemper 2002, Statistics in Medicine 21, 2409-2419). Infinite where it never falls so far.
pub fn profile_limits(
    likelihood: &dyn Fn(&DVector<f64>) -> Objective,
    fit: &BinaryFit,
    parameter: CurveParameter,
    confidence: f64,
) -> Limits {
    let depth = normal::quantile(0.5 * (1.0 + confidence));
    let profile = Profile { likelihood, fit, parameter };
    let (below, above) = (profile.limit(-1.0, depth), profile.limit(1.0, depth));
    match parameter {
        CurveParameter::Lambda | CurveParameter::Mu => Limits { low: below, high: above },
        // The slope is what is varied; it has the sign of the fit throughout.
        CurveParameter::Beta => Limits { low: 1.0 / above, high: 1.0 / below },
    }
}

/// The profile of a likelihood over lambda, mu or, for beta, the slope 1/beta, in which it is regular.
struct Profile<'a> {
    likelihood: &'a dyn Fn(&DVector<f64>) -> Objective,
    fit: &'a BinaryFit,
    parameter: CurveParameter,
}

/// A place on the profile.
struct Place {
    /// Of the parameter.
    value: f64,
    /// Where the likelihood is largest there.
    coefficients: DVector<f64>,
    /// The root of twice how far it lies below the maximum of all.
    depth: f64,
}

impl Profile<'_> {
    /// The value on one side of the fit at which the profile has this depth.
    fn limit(&self, side: f64, depth: f64) -> f64 {
        let b = &self.fit.coefficients;
        let (value, error) = match self.parameter {
            CurveParameter::Beta => {
                (slope(b), self.fit.covariance.view((1, 1), (b.len() - 1, b.len() - 1)).sum().sqrt())
            }
            parameter => {
                let error = parameter.standard_error(self.fit.link, b, &self.fit.covariance);
                (parameter.value(self.fit.link, b), error)
            }
        };
        let mut inside = Place { value, coefficients: b.clone(), depth: 0.0 };
        let mut step = side * depth * error;
        // Whether there are places where no maximum was found.
        let mut is_rough = false;
        for _ in 0..MOST_STEPS {
            let next = inside.value + step;
            let at_edge = self.parameter == CurveParameter::Beta && next * value <= 0.0;
            let Some(outside) = self.at(if at_edge { 0.0 } else { next }, &inside.coefficients) else {
                step *= 0.5;
                is_rough = true;
                continue;
            };
            if outside.depth >= depth {
                // The depth is nearly a line, so that Brent's method needs few trials.
                let gap = |value: f64| Some(self.at(value, &inside.coefficients)?.depth - depth);
                return root(gap, (inside.value, outside.value), CLOSE * error).unwrap_or(f64::NAN);
            }
            if at_edge {
                return 0.0;
            }
            (inside, step) = (outside, 2.0 * step);
        }
        if is_rough { f64::NAN } else { side * f64::INFINITY }
    }

    /// The place where the parameter has this value, searched from coefficients nearby, or from calmer ones: a penalised
    /// likelihood of outcomes that are separated has a summit only near them.
    fn at(&self, value: f64, near: &DVector<f64>) -> Option<Place> {
        let from = |near: &DVector<f64>| {
            let (start, directions) = self.constrained(value, near);
            maximise(self.likelihood, &start, Along::Columns(&directions), TOLERANCE)
        };
        let mut calmer = CALMER.iter().map(|&share| self.calmer(value, near, share));
        let maximum = from(near).or_else(|| calmer.find_map(|near| from(&near)))?;
        let fall = self.fit.objective - maximum.objective.value;
        Some(Place { value, coefficients: maximum.at, depth: (2.0 * fall).max(0.0).sqrt() })
    }

    /// Coefficients of a flatter curve; for the slope itself, of a curve with this slope and a median nearer to the old one than
    /// the intercept alone would leave it.
    fn calmer(&self, value: f64, near: &DVector<f64>, share: f64) -> DVector<f64> {
        let scale = match self.parameter {
            CurveParameter::Beta => 1.0 + (value / slope(near) - 1.0) * share,
            CurveParameter::Lambda | CurveParameter::Mu => 1.0 - 0.9 * share,
        };
        let median = self.fit.link.median_index();
        let mut calm = near * scale;
        calm[0] += median * (1.0 - scale);
        calm
    }

    /// Coefficients that have this value of the parameter, and the directions that keep it.
    fn constrained(&self, value: f64, near: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let (k, mut start) = (near.len(), near.clone());
        let directions = match self.parameter {
            // b1 = lambda b2
            CurveParameter::Lambda => {
                start[1] = value * start[2];
                DMatrix::from_column_slice(3, 2, &[1.0, 0.0, 0.0, 0.0, value, 1.0])
            }
            // b0 + mu (b1 + b2) = m
            CurveParameter::Mu => {
                start[0] = self.fit.link.median_index() - value * slope(near);
                DMatrix::from_fn(k, k - 1, |row, column| match row {
                    0 => -value,
                    row => f64::from(u8::from(row == column + 1)),
                })
            }
            // b1 + b2 = 1/beta
            CurveParameter::Beta => {
                let missing = (value - slope(near)) / (k - 1) as f64;
                start.rows_mut(1, k - 1).add_scalar_mut(missing);
                // The intercept, and each slope after the first at the cost of the first.
                DMatrix::from_fn(k, k - 1, |row, column| match (row, column) {
                    (0, 0) => 1.0,
                    (0, _) | (_, 0) => 0.0,
                    (1, _) => -1.0,
                    (row, column) => f64::from(u8::from(row == column + 1)),
                })
            }
        };
        (start, directions)
    }
}
