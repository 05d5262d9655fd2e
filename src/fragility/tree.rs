//! The event tree of Figure 6 (Eq. 12): no rocking, safe rocking below or above the limit state, overturning.

use crate::keyword::keywords;

/// The 97.5 % quantile of the normal distribution.
pub const Z_95: f64 = 1.959_963_984_540_054;

keywords! {
    /// Limit states, each within the one before (Table I).
    pub enum LimitState {
        /// LS1: rocking.
        Rocking = "LS1",
        /// LS2: a demand above the limit, or overturning.
        Failure = "LS2",
        /// LS3: overturning.
        Overturning = "LS3",
    }
}

/// Computes the probability of no rocking, P_nr: 1 below uplift at IM4 = PGA/(g tan alpha) = 1 (Eq. 5), 0
/// from there on; NaN of NaN.
pub fn p_no_rocking(im4: f64) -> f64 {
    if im4.is_nan() { f64::NAN } else { f64::from(im4 < 1.0) }
}

/// Computes the probability of failure given rocking: P_ro + (1 - P_ro) P_ex (Eq. 12).
pub fn p_failure_given_rocking(p_ro: f64, p_ex: f64) -> f64 {
    p_ro + (1.0 - p_ro) * p_ex
}

/// Computes the probability of failure, or of another event, over the whole tree from that given rocking:
/// P_f = (1 - P_nr) P_f|r (Eq. 12), exactly 0 without rocking.
pub fn p_failure(p_nr: f64, given_rocking: f64) -> f64 {
    (1.0 - p_nr) * given_rocking
}

/// A probability with limits of confidence.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Probability {
    pub value: f64,
    pub low: f64,
    pub high: f64,
}

impl Probability {
    /// One that no model gives: NaN.
    pub const UNKNOWN: Probability = Probability { value: f64::NAN, low: f64::NAN, high: f64::NAN };

    /// Makes a probability that is known for certain.
    pub fn exact(value: f64) -> Probability {
        Probability { value, low: value, high: value }
    }

    /// Computes a probability that rises with a shift of its argument, at 0 and at the limits of the shift:
    /// limits that lie between 0 and 1.
    pub fn with_limits(half_width: f64, p_at: impl Fn(f64) -> f64) -> Probability {
        let [low, value, high] = [-half_width, 0.0, half_width].map(p_at);
        Probability { value, low, high }
    }

    /// Applies a rising function to the value and both limits.
    pub(super) fn map(self, f: impl Fn(f64) -> f64) -> Probability {
        let [value, low, high] = [self.value, self.low, self.high].map(f);
        Probability { value, low, high }
    }

    /// Joins two probabilities whose errors have the same causes: the values, the low and the high limits.
    pub(super) fn zip(self, other: Probability, join: impl Fn(f64, f64) -> f64) -> Probability {
        Probability {
            value: join(self.value, other.value),
            low: join(self.low, other.low),
            high: join(self.high, other.high),
        }
    }

    /// Computes failure given rocking (Eq. 12) of two independent estimates: the likelihood of all cases is
    /// that of overturning times that of the demand of the others. Survival is a product, so that limits of
    /// its logarithm follow from those of both by the recovery of variance estimates (Zou & Donner 2008,
    /// Stat. Med. 27, 1693-1702). No limit of failure is below that of either.
    pub fn of_failure(p_ro: Probability, p_ex: Probability) -> Probability {
        // Finite, so that a certain event has limits.
        let ln_survival = |p: f64| (-p).ln_1p().max(f64::MIN_POSITIVE.ln());
        let (ro, ex) = (ln_survival(p_ro.value), ln_survival(p_ex.value));
        let away =
            |ro_limit: f64, ex_limit: f64| (ln_survival(ro_limit) - ro).hypot(ln_survival(ex_limit) - ex);
        let value = p_failure_given_rocking(p_ro.value, p_ex.value);
        let low = -(ro + ex + away(p_ro.low, p_ex.low)).exp_m1();
        let high = -(ro + ex - away(p_ro.high, p_ex.high)).exp_m1();
        Probability {
            value,
            // What rounding loses of limits near 0.
            low: low.max(p_ro.low).max(p_ex.low).min(value),
            high: high.max(p_ro.high).max(p_ex.high).max(value),
        }
    }
}

/// The probabilities of the tree at one intensity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Probabilities {
    /// No rocking.
    pub p_nr: f64,
    /// Given rocking; none without rocking, or where a measure is missing.
    pub given_rocking: Option<GivenRocking>,
}

/// Probabilities given that the structure rocks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GivenRocking {
    /// A demand above the limit state, in safe rocking.
    pub p_ex: Probability,
    /// Overturning.
    pub p_ro: Probability,
    /// Failure, the one or the other (Eq. 12).
    pub p_failure: Probability,
}

impl Probabilities {
    /// Makes the probabilities at an IM4; `given_rocking` computes those that matter if it uplifts.
    pub(super) fn new(im4: f64, given_rocking: impl FnOnce() -> Option<GivenRocking>) -> Probabilities {
        let p_nr = p_no_rocking(im4);
        Probabilities { p_nr, given_rocking: if p_nr == 0.0 { given_rocking() } else { None } }
    }

    /// Returns the probabilities of reaching LS1, LS2 and LS3 over the whole tree: exactly 0 without rocking.
    /// None where a measure is missing.
    pub fn limit_states(&self) -> Option<[Probability; 3]> {
        let rocking = Probability::exact(1.0 - self.p_nr);
        if self.p_nr == 1.0 {
            return Some([rocking; 3]);
        }
        let over_tree = |given: Probability| given.map(|p| p_failure(self.p_nr, p));
        self.given_rocking.map(|given| [rocking, over_tree(given.p_failure), over_tree(given.p_ro)])
    }
}
