//! Estimates, their limits of confidence, and quantiles of a sample.

/// Limits of confidence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// The lower one.
    pub low: f64,
    /// The upper one.
    pub high: f64,
}

/// A number with its uncertainty.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The best estimate.
    pub value: f64,
    /// Its standard error.
    pub standard_error: f64,
    /// Its lower limit of confidence.
    pub low: f64,
    /// Its upper limit of confidence.
    pub high: f64,
}

impl Estimate {
    /// With limits `quantile` standard errors away.
    pub fn symmetric(value: f64, standard_error: f64, quantile: f64) -> Estimate {
        let half_width = quantile * standard_error;
        Estimate { value, standard_error, low: value - half_width, high: value + half_width }
    }

    /// Of the exponential: the error by the delta method, the limits those of this one.
    pub fn exp(&self) -> Estimate {
        let value = libm::exp(self.value);
        Estimate {
            value,
            standard_error: value * self.standard_error,
            low: libm::exp(self.low),
            high: libm::exp(self.high),
        }
    }

    /// Its limits alone.
    pub fn limits(&self) -> Limits {
        Limits { low: self.low, high: self.high }
    }
}

/// Finds the value below which a fraction of a sorted sample lies, linear between its values; NaN of an empty one.
pub fn quantile(sorted: &[f64], share: f64) -> f64 {
    if sorted.is_empty() {
        return f64::NAN;
    }
    let place = share.clamp(0.0, 1.0) * (sorted.len() - 1) as f64;
    let (below, above) = (place.floor() as usize, place.ceil() as usize);
    sorted[below] + (place - place.floor()) * (sorted[above] - sorted[below])
}
