//! Probabilities on the probit scale, where their uncertainty is nearly normal.

use crate::normal;

/// The 97.5 % quantile of the normal distribution.
pub(crate) const Z_95: f64 = 1.959_963_984_540_054;

/// A probability with its 95 % limits of confidence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Probability {
    /// The best estimate.
    pub value: f64,
    /// Its lower limit.
    pub low: f64,
    /// Its upper limit.
    pub high: f64,
}

impl Probability {
    /// One that is known without doubt.
    pub fn exact(value: f64) -> Probability {
        Probability { value, low: value, high: value }
    }
}

/// The x of a probability Phi(x), with its standard error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProbitIndex {
    /// The x.
    pub value: f64,
    /// Its standard error.
    pub standard_error: f64,
}

impl ProbitIndex {
    /// Phi of the index; its limits are Phi of those of the index, and so lie between 0 and 1.
    pub fn probability(self) -> Probability {
        let half_width = Z_95 * self.standard_error;
        Probability {
            value: normal::cdf(self.value),
            low: normal::cdf(self.value - half_width),
            high: normal::cdf(self.value + half_width),
        }
    }

    /// Of failure given rocking, P_ro + (1 - P_ro) P_ex (Eq. 12). Standard error by the delta method; the two are
    /// independent, since the likelihood of all cases is that of overturning times that of the demand of the others.
    pub fn of_failure(overturning: ProbitIndex, exceeding: ProbitIndex) -> ProbitIndex {
        let survival = normal::cdf(-overturning.value) * normal::cdf(-exceeding.value);
        let value = if survival < 0.5 {
            -normal::quantile(survival)
        } else {
            let p_exceeding = normal::cdf(exceeding.value);
            normal::quantile(crate::fragility::p_failure_given_rocking(
                normal::cdf(overturning.value),
                p_exceeding,
            ))
        };
        if !value.is_finite() {
            return ProbitIndex { value, standard_error: 0.0 };
        }
        // d value / d index: the ratio of densities, times the probability that the other branch does not fail.
        let share = |of: ProbitIndex, other: ProbitIndex| {
            let densities = (0.5 * (value * value - of.value * of.value)).exp();
            densities * normal::cdf(-other.value) * of.standard_error
        };
        let standard_error = share(overturning, exceeding).hypot(share(exceeding, overturning));
        ProbitIndex { value, standard_error }
    }
}
