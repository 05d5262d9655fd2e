//! Whether a probability is taken at its estimate or at a limit.

use super::tree::LimitStates;
use crate::statistics::Estimate;

/// Whether the limits of a probability include the standard deviation between earthquakes, tau; its value is
/// the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scenarios {
    /// One earthquake: they include it.
    One,
    /// An average over many, as over a hazard: they do not.
    Many,
}

/// A probability is taken at its estimate or at one of its 95 % limits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Level {
    Estimate,
    Low(Scenarios),
    High(Scenarios),
}

impl Level {
    /// Computes an estimate and its limits.
    pub fn all(scenarios: Scenarios, p_at: impl Fn(Level) -> f64) -> Estimate {
        let [low, high] = [Level::Low(scenarios), Level::High(scenarios)].map(&p_at);
        Estimate { value: p_at(Level::Estimate), low, high }
    }

    /// Computes the estimates of all limit states and their limits.
    pub fn limit_states(
        scenarios: Scenarios,
        p_at: impl Fn(Level) -> LimitStates<f64>,
    ) -> LimitStates<Estimate> {
        let [low, high] = [Level::Low(scenarios), Level::High(scenarios)].map(&p_at);
        let limits = low.zip(high, |low, high| (low, high));
        p_at(Level::Estimate).zip(limits, |value, (low, high)| Estimate { value, low, high })
    }

    /// Returns the value of an estimate, or one of its limits.
    pub fn pick(self, estimate: Estimate) -> f64 {
        match self {
            Level::Estimate => estimate.value,
            Level::Low(_) => estimate.low,
            Level::High(_) => estimate.high,
        }
    }
}
