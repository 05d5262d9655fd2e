//! The event tree of Figure 6 (Eq. 12): no rocking, safe rocking below or above the limit state, overturning.

use std::f64::consts::E;

use crate::spelling::unknown_word;
use crate::statistics::Interval;

/// Limit states, each within the one before (Table I).
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[strum(parse_err_ty = String, parse_err_fn = unknown_word::<LimitState>)]
pub enum LimitState {
    #[serde(rename = "LS1")]
    #[strum(serialize = "LS1")]
    Rocking,
    /// LS2: a demand above the limit, or overturning.
    #[serde(rename = "LS2")]
    #[strum(serialize = "LS2")]
    Failure,
    #[serde(rename = "LS3")]
    #[strum(serialize = "LS3")]
    Overturning,
}

/// P_nr: 1 below uplift at IM4 = PGA/(g tan alpha) = 1 (Eq. 5), 0 from there on; NaN of NaN.
pub fn p_no_rocking(im4: f64) -> f64 {
    if im4.is_nan() { f64::NAN } else { f64::from(im4 < 1.0) }
}

/// P_f|r = P_ro + (1 - P_ro) P_ex (Eq. 12).
pub fn p_failure_given_rocking(p_ro: f64, p_ex: f64) -> f64 {
    p_ro + (1.0 - p_ro) * p_ex
}

/// From given rocking to the whole tree: P_f = (1 - P_nr) P_f|r (Eq. 12), exactly 0 without rocking.
pub fn p_failure(p_nr: f64, given_rocking: f64) -> f64 {
    (1.0 - p_nr) * given_rocking
}

/// What there is of each limit state: a probability, a rate, an estimate of either.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct LimitStates<T> {
    pub rocking: T,
    pub failure: T,
    pub overturning: T,
}

impl<T> LimitStates<T> {
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> LimitStates<U> {
        LimitStates { rocking: f(self.rocking), failure: f(self.failure), overturning: f(self.overturning) }
    }

    pub fn zip<U, V>(self, other: LimitStates<U>, join: impl Fn(T, U) -> V) -> LimitStates<V> {
        LimitStates {
            rocking: join(self.rocking, other.rocking),
            failure: join(self.failure, other.failure),
            overturning: join(self.overturning, other.overturning),
        }
    }

    /// In the order of [`LimitState`].
    pub fn into_array(self) -> [T; 3] {
        [self.rocking, self.failure, self.overturning]
    }
}

impl<T: Copy> LimitStates<T> {
    pub const fn all(value: T) -> LimitStates<T> {
        LimitStates { rocking: value, failure: value, overturning: value }
    }

    pub fn get(&self, state: LimitState) -> T {
        match state {
            LimitState::Rocking => self.rocking,
            LimitState::Failure => self.failure,
            LimitState::Overturning => self.overturning,
        }
    }
}

impl LimitStates<f64> {
    /// Without a PGV, only rocking is known.
    pub(super) fn known(self, ln_pgv_pga: f64) -> LimitStates<Option<f64>> {
        let states = self.map(Some);
        if ln_pgv_pga.is_finite() {
            states
        } else {
            LimitStates { rocking: states.rocking, ..LimitStates::all(None) }
        }
    }
}

impl LimitStates<Option<f64>> {
    /// The probability of either of two independent events.
    pub(super) fn or(self, other: LimitStates<Option<f64>>) -> LimitStates<Option<f64>> {
        self.zip(other, |a, b| a.zip(b).map(|(a, b)| a + b - a * b))
    }
}

/// The probabilities that no object of a list has the effect under a motion, in two halves of the motions of
/// these peaks: what else they do to all objects moves each logit by one, down or up. By 958 motions of 29
/// earthquakes and 96 structures; were they independent, one of eight alike would fall 1.3 times too often.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct NoneOf([f64; 2]);

impl NoneOf {
    pub const EMPTY: NoneOf = NoneOf([1.0; 2]);

    /// With so many more objects, each with a probability of `p`.
    pub fn and(self, p: f64, count: f64) -> NoneOf {
        let moved = [1.0 / E, E].map(|odds| p * odds / (1.0 - p + p * odds));
        let to_mean = p / (0.5 * (moved[0] + moved[1])).max(f64::MIN_POSITIVE);
        let none = moved.map(|moved| (1.0 - moved * to_mean).max(0.0));
        // Most objects are there once, and a power takes longer than all else here.
        let none = if count == 1.0 { none } else { none.map(|none| none.powf(count)) };
        NoneOf([0, 1].map(|half| self.0[half] * none[half]))
    }

    pub fn p_any(self) -> f64 {
        0.5 * (1.0 - self.0[0]) + 0.5 * (1.0 - self.0[1])
    }
}

/// Failure given rocking (Eq. 12) of two independent estimates: the likelihood of all cases is
/// that of overturning times that of the demand of the others. Survival is a product, so that limits of
/// its logarithm follow from those of both by the recovery of variance estimates (Zou & Donner 2008,
/// Stat. Med. 27, 1693-1702). No limit of failure is below that of either.
pub fn independent_failure(p_ro: Interval, p_ex: Interval) -> Interval {
    // ln of survival, finite, so that a certain event has limits.
    let [ro, ex] = [p_ro, p_ex].map(|p| p.map(|p| (-p).ln_1p().max(f64::MIN_POSITIVE.ln())));
    let value = p_failure_given_rocking(p_ro.value, p_ex.value);
    let low = -(ro.value + ex.value + (ro.low - ro.value).hypot(ex.low - ex.value)).exp_m1();
    let high = -(ro.value + ex.value - (ro.high - ro.value).hypot(ex.high - ex.value)).exp_m1();
    Interval {
        value,
        // Rounding can move limits near 0 beyond these bounds.
        low: low.max(p_ro.low).max(p_ex.low).min(value),
        high: high.max(p_ro.high).max(p_ex.high).max(value),
    }
}

/// The probabilities of the tree at one intensity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Probabilities {
    pub p_nr: f64,
    /// None without rocking, or where a measure is missing.
    pub given_rocking: Option<GivenRocking>,
}

/// Probabilities under a motion that uplifts, with limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GivenRocking {
    /// In safe rocking; none where no plane is fitted.
    pub p_ex: Option<Interval>,
    pub p_ro: Interval,
    /// Overturning, or a demand above the limit state (Eq. 12).
    pub p_failure: Option<Interval>,
}

impl Probabilities {
    /// `given_rocking` is evaluated only if the IM4 uplifts.
    pub(super) fn new(im4: f64, given_rocking: impl FnOnce() -> Option<GivenRocking>) -> Probabilities {
        let p_nr = p_no_rocking(im4);
        Probabilities { p_nr, given_rocking: if p_nr == 0.0 { given_rocking() } else { None } }
    }

    /// From the whole tree to given rocking, which a floor may or may not cause.
    pub(super) fn on_floor(states: LimitStates<Option<Interval>>) -> Probabilities {
        let rocking = states.rocking.map_or(0.0, |p| p.value);
        let known = states.failure.zip(states.overturning).filter(|_| rocking > 0.0);
        let given_rocking = known.map(|(failure, overturning)| {
            let [p_failure, p_ro] = [failure, overturning].map(|state| state.map(|p| p / rocking));
            let p_ex = p_failure
                .zip(p_ro, |failure, overturning| ((failure - overturning) / (1.0 - overturning)).max(0.0));
            GivenRocking { p_ex: Some(p_ex), p_ro, p_failure: Some(p_failure) }
        });
        Probabilities { p_nr: 1.0 - rocking, given_rocking }
    }

    /// Over the whole tree, exactly 0 without rocking. None where a measure or a plane is missing.
    pub fn limit_states(&self) -> LimitStates<Option<Interval>> {
        let rocking = Some(Interval::exact(1.0 - self.p_nr));
        if self.p_nr == 1.0 {
            return LimitStates::all(rocking);
        }
        let given = self.given_rocking;
        let [failure, overturning] = [given.and_then(|given| given.p_failure), given.map(|given| given.p_ro)]
            .map(|given| given.map(|given| given.map(|p| p_failure(self.p_nr, p))));
        LimitStates { rocking, failure, overturning }
    }
}
