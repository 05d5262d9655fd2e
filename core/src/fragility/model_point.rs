//! The values of its parameters at which a model is evaluated.

use super::model::RockingDirection;
use super::tree::LimitStates;
use crate::statistics::Interval;

/// How the limits of a probability treat tau, the standard deviation of its logit between earthquakes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tau {
    /// One earthquake: the limits include tau.
    Included,
    /// An average over many earthquakes, as over a hazard: the limits do not include tau.
    Averaged,
}

/// The estimate of a probability, one of its 95 % limits, or its value with one unknown away from its median.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ModelPoint {
    Estimate,
    Low(Tau),
    High(Tau),
    /// One of the independent errors of the model's parameters at its 2.5 or 97.5 % quantile.
    Error {
        number: usize,
        is_high: bool,
    },
    /// Magnitudes higher by this than those inferred: the level c is higher by m times this.
    Magnitude(f64),
}

impl ModelPoint {
    /// The value or the limit of an estimate by a model that has its errors itself.
    pub fn of(self, p: Interval) -> f64 {
        match self {
            ModelPoint::Low(_) => p.low,
            ModelPoint::High(_) => p.high,
            _ => p.value,
        }
    }

    pub fn at_limits(tau: Tau) -> [ModelPoint; 3] {
        [ModelPoint::Estimate, ModelPoint::Low(tau), ModelPoint::High(tau)]
    }

    /// The estimate, then each error of the models at both quantiles: the same error moves all directions.
    pub fn at_errors(directions: &[RockingDirection]) -> Vec<ModelPoint> {
        let fewest = directions.iter().map(|direction| direction.model.errors()).min().unwrap_or(0);
        let errors =
            (0..fewest).flat_map(|number| [false, true].map(|is_high| ModelPoint::Error { number, is_high }));
        [ModelPoint::Estimate].into_iter().chain(errors).collect()
    }
}

impl LimitStates<Option<Interval>> {
    /// From the probabilities at [`ModelPoint::at_limits`].
    pub(super) fn from_points(states: &[LimitStates<Option<f64>>]) -> LimitStates<Option<Interval>> {
        let limits = states[1].zip(states[2], Option::zip);
        states[0].zip(limits, |value, limits| {
            value.zip(limits).map(|(value, (low, high))| Interval { value, low, high })
        })
    }
}
