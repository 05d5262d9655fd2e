//! How the index of a binary regression becomes a probability, with the derivatives and the Taylor series of its logarithm.

use crate::keyword::keywords;
use crate::normal;
use crate::statistics::derivatives::{Score, Scores};

/// The link: P(event) = F(index), with index = b0 + b1 x1 + ...
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Link {
    /// The normal distribution: the lognormal curve of the paper.
    #[default]
    Probit,
    /// The logistic distribution: heavier tails.
    Logit,
    /// The complementary log-log, F = 1 - exp(-exp(index)): the Weibull distribution of the measure, skewed.
    Cloglog,
}

keywords!(Link { Probit = "probit", Logit = "logit", Cloglog = "cloglog" });

/// The expected information of a case about its index.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Information {
    /// f^2 / (F (1 - F)).
    pub weight: f64,
    /// The derivative of its logarithm.
    pub ln_weight_slope: f64,
    /// The second derivative of its logarithm.
    pub ln_weight_curvature: f64,
}

impl Link {
    /// F(index).
    pub fn probability(self, index: f64) -> f64 {
        match self {
            Link::Probit => normal::cdf(index),
            Link::Logit => 1.0 / (1.0 + libm::exp(-index)),
            Link::Cloglog => -libm::expm1(-libm::exp(index)),
        }
    }

    /// The index at which an event is as likely as not.
    pub fn median_index(self) -> f64 {
        match self {
            Link::Probit | Link::Logit => 0.0,
            Link::Cloglog => libm::log(std::f64::consts::LN_2),
        }
    }

    /// ln F(index), or of no event ln(1 - F(index)).
    pub fn ln_probability(self, index: f64, event: bool) -> f64 {
        let z = if event { index } else { -index };
        match self {
            Link::Probit => probit_ln_probability(index, event),
            Link::Logit if z > 0.0 => -libm::log1p(libm::exp(-z)),
            Link::Logit => z - libm::log1p(libm::exp(z)),
            Link::Cloglog if event => libm::log(-libm::expm1(-libm::exp(index))),
            Link::Cloglog => -libm::exp(index),
        }
    }

    /// The derivatives of [`Link::ln_probability`], the negative of the second at least zero: all three links have
    /// log-concave likelihoods.
    pub fn score(self, index: f64, event: bool) -> Score {
        match self {
            Link::Probit => probit_score(index, event),
            Link::Logit => logit_score(index, event),
            Link::Cloglog => cloglog_score(index, event),
        }
    }

    /// Replaces the indices of some cases by [`Link::ln_probability`]; an event is what is not 0.
    #[inline(always)]
    pub fn ln_probabilities(self, events: &[f64], values: &mut [f64]) {
        match self {
            Link::Probit => {
                for (value, &event) in values.iter_mut().zip(events) {
                    *value = probit_ln_probability(*value, event != 0.0);
                }
            }
            link => {
                for (value, &event) in values.iter_mut().zip(events) {
                    *value = link.ln_probability(*value, event != 0.0);
                }
            }
        }
    }

    /// Replaces the indices of some cases by [`Link::score`]; an event is what is not 0.
    #[inline(always)]
    #[expect(
        clippy::redundant_closure,
        reason = "a function passed along is called in a way that need not be inlined"
    )]
    pub fn scores(self, events: &[f64], scores: Scores) {
        match self {
            Link::Probit => replace(
                events,
                scores,
                #[inline(always)]
                |index, event| probit_score(index, event),
            ),
            Link::Logit => replace(
                events,
                scores,
                #[inline(always)]
                |index, event| logit_score(index, event),
            ),
            Link::Cloglog => replace(
                events,
                scores,
                #[inline(always)]
                |index, event| cloglog_score(index, event),
            ),
        }
    }

    /// The expected information at an index.
    pub fn information(self, index: f64) -> Information {
        match self {
            Link::Probit => {
                let (of_event, of_other) = (normal::inverse_mills(index), normal::inverse_mills(-index));
                Information {
                    weight: of_event * of_other,
                    ln_weight_slope: of_other - of_event - 2.0 * index,
                    ln_weight_curvature: of_other * (of_other - index) + of_event * (of_event + index) - 2.0,
                }
            }
            Link::Logit => {
                let p = self.probability(index);
                let weight = p * (1.0 - p);
                Information { weight, ln_weight_slope: 1.0 - 2.0 * p, ln_weight_curvature: -2.0 * weight }
            }
            Link::Cloglog => {
                let hazard = libm::exp(index);
                let ratio = hazard_ratio(hazard);
                Information {
                    weight: hazard * ratio,
                    ln_weight_slope: 2.0 - hazard - ratio,
                    ln_weight_curvature: -hazard - ratio * (1.0 - hazard - ratio),
                }
            }
        }
    }
}

#[inline(always)]
fn replace(events: &[f64], mut scores: Scores, score: impl Fn(f64, bool) -> Score) {
    for ((slope, curvature), &event) in scores.iter_mut().zip(events) {
        let score = score(*slope, event != 0.0);
        (*slope, *curvature) = (score.slope, score.curvature);
    }
}

/// [`Link::ln_probability`] of the probit.
#[inline(always)]
fn probit_ln_probability(index: f64, event: bool) -> f64 {
    normal::ln_cdf(if event { index } else { -index })
}

/// [`Link::score`] of the probit.
#[inline(always)]
fn probit_score(index: f64, event: bool) -> Score {
    let sign = if event { 1.0 } else { -1.0 };
    let z = sign * index;
    let mills = normal::inverse_mills(z);
    Score { slope: sign * mills, curvature: mills * (mills + z) }
}

/// [`Link::score`] of the logit.
#[inline(always)]
fn logit_score(index: f64, event: bool) -> Score {
    let sign = if event { 1.0 } else { -1.0 };
    let z = sign * index;
    let (p, q) = (1.0 / (1.0 + libm::exp(-z)), 1.0 / (1.0 + libm::exp(z)));
    Score { slope: sign * q, curvature: p * q }
}

/// [`Link::score`] of the complementary log-log.
#[inline(always)]
fn cloglog_score(index: f64, event: bool) -> Score {
    let hazard = libm::exp(index);
    if event {
        let ratio = hazard_ratio(hazard);
        Score { slope: ratio, curvature: (ratio * (ratio + hazard - 1.0)).max(0.0) }
    } else {
        Score { slope: -hazard, curvature: hazard }
    }
}

/// f / F of the complementary log-log: m / (exp(m) - 1) with m = exp(index).
fn hazard_ratio(hazard: f64) -> f64 {
    if hazard > 0.0 { hazard / libm::expm1(hazard) } else { 1.0 }
}

/// The factors of t^0, t, t^2 ... in [`Link::ln_probability`] at `index + t`, from that at the index and its first derivative.
pub fn ln_probability_series<const N: usize>(
    link: Link,
    event: bool,
    index: f64,
    ln_probability: f64,
    slope: f64,
) -> [f64; N] {
    let (sign, z) = if event { (1.0, index) } else { (-1.0, -index) };
    let slopes: [f64; N] = match (link, event) {
        // Of the inverse Mills ratio m at z + u, with u = t or -t: m' = -m (z + u + m).
        (Link::Probit, _) => series(sign * slope, |m, n| {
            let linear = z * m[n] + if n > 0 { m[n - 1] } else { 0.0 };
            -linear - product(m, m, n)
        }),
        // Of the other outcome's probability: q' = q^2 - q.
        (Link::Logit, _) => series(sign * slope, |q, n| product(q, q, n) - q[n]),
        // Of r = h / (exp(h) - 1) with the hazard h = exp(index): r' = r (1 - h - r).
        (Link::Cloglog, true) => {
            let hazard: [f64; N] = series(libm::exp(index), |h, n| h[n]);
            series(slope, |r, n| r[n] - product(&hazard, r, n) - product(r, r, n))
        }
        // Of h, in t = -u.
        (Link::Cloglog, false) => series(-slope, |h, n| -h[n]),
    };
    std::array::from_fn(|n| match n {
        0 => ln_probability,
        _ => f64::powi(sign, n as i32) * slopes[n - 1] / n as f64,
    })
}

/// The powers of a function from its value, and those of its derivative from what is known by then.
fn series<const N: usize>(value: f64, derivative: impl Fn(&[f64; N], usize) -> f64) -> [f64; N] {
    let mut powers = [0.0; N];
    powers[0] = value;
    for n in 1..N {
        powers[n] = derivative(&powers, n - 1) / n as f64;
    }
    powers
}

/// Power `n` of a product.
fn product(a: &[f64], b: &[f64], n: usize) -> f64 {
    (0..=n).map(|i| a[i] * b[n - i]).sum()
}
