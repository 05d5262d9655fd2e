//! The values between two bounds.

/// The values from one to another.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Range {
    pub low: f64,
    pub high: f64,
}

/// The relative amount by which a value may pass a bound, as rounding in print does.
const UNSEEN: f64 = 1e-5;

impl Range {
    /// Returns whether a positive value is within it, as printed.
    pub fn has(&self, value: f64) -> bool {
        (self.low * (1.0 - UNSEEN)..=self.high * (1.0 + UNSEEN)).contains(&value)
    }

    /// Returns a value, or the bound that it is beyond.
    pub fn held(&self, value: f64) -> f64 {
        value.clamp(self.low, self.high)
    }

    /// Widens it to a value.
    pub fn with(&self, value: f64) -> Range {
        Range { low: self.low.min(value), high: self.high.max(value) }
    }

    /// Returns the range of the logarithms.
    pub fn ln(&self) -> Range {
        Range { low: self.low.ln(), high: self.high.ln() }
    }
}
