//! The values between two bounds.

use serde::{Deserialize, Serialize};

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    pub low: f64,
    pub high: f64,
}

/// A value beyond a bound by this share of it counts as within, since bounds are rounded in print.
const UNSEEN: f64 = 1e-5;

impl Range {
    /// Finds the least and the largest of values; of none, `low` is infinite and `high` is less.
    pub fn over(values: impl IntoIterator<Item = f64>) -> Range {
        let none = Range { low: f64::INFINITY, high: f64::NEG_INFINITY };
        values.into_iter().fold(none, |range, value| range.with(value))
    }

    /// Whether a positive value is within the range, up to the rounding of print.
    pub fn has(&self, value: f64) -> bool {
        (self.low * (1.0 - UNSEEN)..=self.high * (1.0 + UNSEEN)).contains(&value)
    }

    pub fn clamp(&self, value: f64) -> f64 {
        value.clamp(self.low, self.high)
    }

    pub fn with(&self, value: f64) -> Range {
        Range { low: self.low.min(value), high: self.high.max(value) }
    }

    pub fn ln(&self) -> Range {
        Range { low: self.low.ln(), high: self.high.ln() }
    }
}

/// The bounds of values, if there are any.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Bounds {
    pub low: Option<f64>,
    pub high: Option<f64>,
}

impl FromIterator<f64> for Bounds {
    fn from_iter<I: IntoIterator<Item = f64>>(values: I) -> Bounds {
        values.into_iter().fold(Bounds::default(), |Bounds { low, high }, value| Bounds {
            low: Some(low.map_or(value, |low| low.min(value))),
            high: Some(high.map_or(value, |high| high.max(value))),
        })
    }
}

impl Bounds {
    /// Whether a value is within the bounds, widened by `factor`. A bound that is missing does not limit it.
    pub fn has(&self, value: f64, factor: f64) -> bool {
        self.low.is_none_or(|low| value >= low / factor)
            && self.high.is_none_or(|high| value <= high * factor)
    }
}
