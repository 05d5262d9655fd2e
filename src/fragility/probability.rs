//! The probabilities of the tree (Eqs. 12, 14 and 20), and their uncertainty on the probit scale, where it is nearly normal.

use crate::normal;
use crate::statistics::link::Link;

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

    /// Of failure given rocking, P_ro + (1 - P_ro) P_ex (Eq. 12), of two independent estimates: the likelihood of all cases is that of
    /// overturning times that of the demand of the others. Survival is a product, so that the limits of its logarithm follow from those
    /// of both by the recovery of variance estimates (Zou & Donner 2008, Construction of confidence limits about effect measures,
    /// Stat. Med. 27, 1693-1702). However wide these are, no limit of failure is below that of either.
    pub fn of_failure(overturning: Probability, exceeding: Probability) -> Probability {
        let [(ro, ro_low, ro_high), (ex, ex_low, ex_high)] =
            [overturning, exceeding].map(|p| (ln_survival(p.value), ln_survival(p.low), ln_survival(p.high)));
        let further = |ro_limit: f64, ex_limit: f64| libm::hypot(ro_limit - ro, ex_limit - ex);
        let value = p_failure_given_rocking(overturning.value, exceeding.value);
        let at_least = |p: f64, other: f64, limit: f64| p.max(other).max(limit);
        let low = -libm::expm1(ro + ex + further(ro_low, ex_low));
        let high = -libm::expm1(ro + ex - further(ro_high, ex_high));
        Probability {
            value,
            // What rounding loses of limits near 0.
            low: at_least(low, overturning.low, exceeding.low).min(value),
            high: at_least(high, overturning.high, exceeding.high).max(value),
        }
    }
}

/// ln(1 - p), finite.
fn ln_survival(p: f64) -> f64 {
    libm::log1p(-p).max(libm::log(f64::MIN_POSITIVE))
}

/// The x of a probability Phi(x), with its standard error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProbitIndex {
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

    /// Of a demand above `limit` (Eq. 14), of the logarithm of its median and the variance of that, and of its dispersion `beta` with so
    /// many degrees of freedom, whose large-sample variance is beta^2/(2 degrees).
    pub fn of_exceeding(ln_median: f64, variance: f64, limit: f64, beta: f64, degrees: f64) -> ProbitIndex {
        let value = exceeding_index(ln_median, limit, beta);
        let variance = variance / (beta * beta) + value * value / (2.0 * degrees);
        ProbitIndex { value, standard_error: variance.sqrt() }
    }
}

/// Probability that the demand exceeds `limit` in safe rocking, of the logarithm of its median and its dispersion beta:
/// Phi((ln Dm - ln c) / beta). Eq. 14 prints the argument with the other sign, by which it would fall with demand.
pub fn p_exceeding(ln_median_demand: f64, limit: f64, beta: f64) -> f64 {
    normal::cdf(exceeding_index(ln_median_demand, limit, beta))
}

/// The argument of Phi in [`p_exceeding`].
pub fn exceeding_index(ln_median_demand: f64, limit: f64, beta: f64) -> f64 {
    (ln_median_demand - libm::log(limit)) / beta
}

/// Probability of overturning given rocking at the intensity `im`: Phi((ln IM - mu) / beta) by the probit (Eq. 20; Eq. 24 of a hybrid), for every
/// link one half at IM = exp(mu).
pub fn p_overturning(im: f64, mu: f64, beta: f64, link: Link) -> f64 {
    link.probability((libm::log(im) - mu) / beta + link.median_index())
}

/// Probability of no rocking, which IM4 = PGA/(g tan alpha) decides: 1 below uplift, 0 from there on; NaN of NaN.
pub fn p_no_rocking(im4: f64) -> f64 {
    if im4.is_nan() {
        f64::NAN
    } else if im4 < 1.0 {
        1.0
    } else {
        0.0
    }
}

/// Probability of failure given rocking (Eq. 12): P_ro + (1 - P_ro) P_ex.
pub fn p_failure_given_rocking(p_overturning: f64, p_exceeding: f64) -> f64 {
    p_overturning + (1.0 - p_overturning) * p_exceeding
}

/// Probability of failure over the whole tree: (1 - P_nr) P_f|r, exactly zero without rocking.
pub fn p_failure(p_no_rocking: f64, p_failure_given_rocking: f64) -> f64 {
    (1.0 - p_no_rocking) * p_failure_given_rocking
}
