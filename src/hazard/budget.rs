//! One budget of errors: what is not known exactly, how much of a result each part moves, and the limits that
//! follow.

use crate::fragility::Z_95;
use crate::keyword::{Keyword, keywords};
use crate::statistics::Limits;

/// What an error comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// c and ln s of the calibration.
    Fit,
    /// Magnitude of the earthquakes.
    Magnitude,
    /// Level of PGV / PGA.
    Velocity,
    /// Coefficient of restitution.
    Eta,
    /// Centre of mass and inertia.
    Object,
    /// Building under the object.
    Floor,
    /// The hazard itself, where its fractiles are given.
    Hazard,
}

keywords!(Part {
    Fit = "fit",
    Magnitude = "magnitude",
    Velocity = "velocity",
    Eta = "eta",
    Object = "object",
    Floor = "floor",
    Hazard = "hazard",
});

/// Something that is not known exactly, by its 16, 50 and 84 % quantiles inside what is possible.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unknown {
    pub part: Part,
    pub low: f64,
    pub centre: f64,
    pub high: f64,
}

impl Unknown {
    /// A normal one.
    pub fn normal(part: Part, mean: f64, sd: f64) -> Unknown {
        Unknown { part, low: mean - sd, centre: mean, high: mean + sd }
    }

    /// A coefficient of restitution, of which 1 - eta is lognormal about that of `median`.
    pub fn restitution(median: f64, sd_of_ln: f64) -> Unknown {
        let [low, high] = [sd_of_ln, -sd_of_ln].map(|ln| 1.0 - (1.0 - median) * ln.exp());
        Unknown { part: Part::Eta, low: low.max(0.0), centre: median, high }
    }

    /// The standard deviations of results that it causes: half of their differences between its quantiles.
    pub fn sds<const N: usize>(&self, results: impl Fn(f64) -> [f64; N]) -> [f64; N] {
        let [low, high] = [results(self.low), results(self.high)];
        std::array::from_fn(|k| 0.5 * (high[k] - low[k]).abs())
    }
}

/// Standard deviations of ln of an annual rate, or of the logit of a probability, by part.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Budget {
    variances: [f64; Part::ALL.len()],
}

impl Budget {
    /// Adds an error that is independent of the others.
    pub fn add(&mut self, part: Part, sd: f64) {
        self.variances[part as usize] += if sd.is_finite() { sd * sd } else { 0.0 };
    }

    /// The standard deviation that a part causes; none where nothing of it is unknown.
    pub fn sd_of(&self, part: Part) -> Option<f64> {
        Some(self.variances[part as usize].sqrt()).filter(|sd| *sd > 0.0)
    }

    /// The standard deviation of all parts together.
    pub fn sd(&self) -> f64 {
        self.variances.iter().sum::<f64>().sqrt()
    }

    /// The part that causes most.
    pub fn largest(&self) -> Option<Part> {
        let largest = Part::ALL.iter().copied().max_by(|a, b| {
            self.variances[*a as usize].total_cmp(&self.variances[*b as usize])
        });
        largest.filter(|part| self.variances[*part as usize] > 0.0)
    }

    /// 95 % limits of an annual rate that is at most that of rocking.
    pub fn limits_of_rate(&self, rate: f64, of_rocking: f64) -> Limits {
        let factor = (Z_95 * self.sd()).exp();
        Limits { low: rate / factor, high: (rate * factor).min(of_rocking.max(rate)) }
    }

    /// 95 % limits of a probability under one motion; `tau` is the standard deviation of the logit between
    /// earthquakes.
    pub fn limits_of_probability(&self, p: f64, tau: f64) -> Limits {
        let half = Z_95 * self.sd().hypot(tau);
        let logit = (p / (1.0 - p)).ln();
        let [low, high] = [logit - half, logit + half].map(|z| 1.0 / (1.0 + (-z).exp()));
        Limits { low, high }
    }
}
