use crate::normal;
use crate::statistics::link::Link;

/// Probability that the demand exceeds `limit` in safe rocking, of the logarithm of its median and its dispersion beta:
/// Phi((ln Dm - ln c) / beta). Eq. 14 prints the argument with the other sign, by which it would fall with demand.
pub fn p_exceeding(ln_median_demand: f64, limit: f64, beta: f64) -> f64 {
    normal::cdf(exceeding_index(ln_median_demand, limit, beta))
}

/// The argument of Phi in [`p_exceeding`].
pub fn exceeding_index(ln_median_demand: f64, limit: f64, beta: f64) -> f64 {
    (ln_median_demand - limit.ln()) / beta
}

/// Probability of overturning given rocking at the intensity `im`: Phi((ln IM - mu) / beta) by the probit (Eq. 19), for every
/// link one half at IM = exp(mu).
pub fn p_overturning(im: f64, mu: f64, beta: f64, link: Link) -> f64 {
    link.probability((im.ln() - mu) / beta + link.median_index())
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
