//! A value with limits.

use serde::{Deserialize, Serialize};

/// A value with its confidence limits. In `Interval<Option<f64>>` all three are none where nothing is known,
/// and only the value where bounds alone are known.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Interval<T = f64> {
    pub value: T,
    pub low: T,
    pub high: T,
}

impl Interval {
    pub const fn exact(value: f64) -> Interval {
        Interval { value, low: value, high: value }
    }

    pub fn around(value: f64, half_width: f64) -> Interval {
        Interval { value, low: value - half_width, high: value + half_width }
    }

    /// Evaluates a function that rises with a shift, at no shift and at the limits of the shift.
    pub fn shifted(half_width: f64, at: impl Fn(f64) -> f64) -> Interval {
        let [low, value, high] = [-half_width, 0.0, half_width].map(at);
        Interval { value, low, high }
    }

    /// Applies a rising function to the value and both limits.
    pub fn map(self, f: impl Fn(f64) -> f64) -> Interval {
        Interval { value: f(self.value), low: f(self.low), high: f(self.high) }
    }

    /// Joins two estimates whose errors have the same causes: the values, the low and the high limits.
    pub fn zip(self, other: Interval, join: impl Fn(f64, f64) -> f64) -> Interval {
        Interval {
            value: join(self.value, other.value),
            low: join(self.low, other.low),
            high: join(self.high, other.high),
        }
    }
}

impl Interval<Option<f64>> {
    pub fn without_limits(value: Option<f64>) -> Interval<Option<f64>> {
        Interval { value, low: None, high: None }
    }

    /// Returns the value with both limits; none where one of them is missing.
    pub fn estimate(self) -> Option<Interval> {
        Some(Interval { value: self.value?, low: self.low?, high: self.high? })
    }

    /// Applies a rising function to what is there.
    pub fn map(self, f: impl Fn(f64) -> f64) -> Interval<Option<f64>> {
        Interval { value: self.value.map(&f), low: self.low.map(&f), high: self.high.map(&f) }
    }
}

impl From<Interval> for Interval<Option<f64>> {
    fn from(Interval { value, low, high }: Interval) -> Interval<Option<f64>> {
        Interval { value: Some(value), low: Some(low), high: Some(high) }
    }
}

impl From<Option<Interval>> for Interval<Option<f64>> {
    fn from(estimate: Option<Interval>) -> Interval<Option<f64>> {
        estimate.map_or(Interval::default(), Interval::from)
    }
}
