//! The values of its parameters at which a model is evaluated.

use super::tree::LimitStates;
use crate::statistics::Interval;

/// Whether the limits of a probability include the standard deviation between earthquakes, tau.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scenarios {
    /// One earthquake: the limits include it.
    One,
    /// An average over many, as over a hazard: the limits do not.
    Many,
}

/// The estimate of a probability, one of its 95 % limits, or its value with one of the independent errors of
/// the model's parameters, by its number, at its 2.5 or 97.5 % quantile.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum QuantileLevel {
    Estimate,
    Low(Scenarios),
    High(Scenarios),
    Error { number: usize, is_high: bool },
}

impl QuantileLevel {
    pub fn with_limits(scenarios: Scenarios) -> [QuantileLevel; 3] {
        [QuantileLevel::Estimate, QuantileLevel::Low(scenarios), QuantileLevel::High(scenarios)]
    }
}

impl LimitStates<Option<Interval>> {
    /// From the probabilities at [`QuantileLevel::with_limits`].
    pub(super) fn from_levels(states: &[LimitStates<Option<f64>>]) -> LimitStates<Option<Interval>> {
        let limits = states[1].zip(states[2], Option::zip);
        states[0].zip(limits, |value, limits| {
            value.zip(limits).map(|(value, (low, high))| Interval { value, low, high })
        })
    }
}
