//! A value with limits, wherever one is known with an error.

use serde::{Deserialize, Serialize};

/// A value with its limits of confidence.
///
/// ```
/// use rockfrag_core::statistics::Estimate;
/// let rate = Estimate::around(-2.0, 0.5).map(f64::exp);
/// assert!(rate.low < rate.value && rate.value < rate.high && Estimate::exact(0.5).low == 0.5);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Estimate {
    pub value: f64,
    pub low: f64,
    pub high: f64,
}

impl Estimate {
    /// Makes an estimate that is known for certain.
    pub const fn exact(value: f64) -> Estimate {
        Estimate { value, low: value, high: value }
    }

    /// Makes an estimate whose limits are this far away on either side.
    pub fn around(value: f64, half_width: f64) -> Estimate {
        Estimate { value, low: value - half_width, high: value + half_width }
    }

    /// Computes a function that rises with a shift of its argument, at 0 and at the limits of the shift.
    pub fn shifted(half_width: f64, at: impl Fn(f64) -> f64) -> Estimate {
        let [low, value, high] = [-half_width, 0.0, half_width].map(at);
        Estimate { value, low, high }
    }

    /// Applies a rising function to the value and both limits.
    pub fn map(self, f: impl Fn(f64) -> f64) -> Estimate {
        Estimate { value: f(self.value), low: f(self.low), high: f(self.high) }
    }

    /// Joins two estimates whose errors have the same causes: the values, the low and the high limits.
    pub fn zip(self, other: Estimate, join: impl Fn(f64, f64) -> f64) -> Estimate {
        Estimate {
            value: join(self.value, other.value),
            low: join(self.low, other.low),
            high: join(self.high, other.high),
        }
    }
}

/// A value with its limits of which something may be missing: all of what is not known, the value of what only
/// has bounds.
///
/// ```
/// use rockfrag_core::statistics::{Estimate, Limited};
/// let known: Limited = Estimate::around(2.0, 0.5).into();
/// let bounds = Limited { value: None, ..known }.map(|x| 2.0 * x);
/// assert_eq!((known.estimate().is_some(), bounds.estimate(), bounds.high), (true, None, Some(5.0)));
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Limited {
    pub value: Option<f64>,
    pub low: Option<f64>,
    pub high: Option<f64>,
}

impl Limited {
    /// Makes a value without limits.
    pub fn value(value: Option<f64>) -> Limited {
        Limited { value, low: None, high: None }
    }

    /// Returns the value with both limits; none where one of them is missing.
    pub fn estimate(self) -> Option<Estimate> {
        Some(Estimate { value: self.value?, low: self.low?, high: self.high? })
    }

    /// Applies a rising function to what is there.
    pub fn map(self, f: impl Fn(f64) -> f64) -> Limited {
        Limited { value: self.value.map(&f), low: self.low.map(&f), high: self.high.map(&f) }
    }
}

impl From<Estimate> for Limited {
    fn from(Estimate { value, low, high }: Estimate) -> Limited {
        Limited { value: Some(value), low: Some(low), high: Some(high) }
    }
}

impl From<Option<Estimate>> for Limited {
    fn from(estimate: Option<Estimate>) -> Limited {
        estimate.map_or(Limited::default(), Limited::from)
    }
}
