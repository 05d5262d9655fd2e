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

impl Part {
    /// What is unknown, in words.
    pub fn words(self) -> &'static str {
        match self {
            Part::Fit => "the fragility",
            Part::Magnitude => "magnitude",
            Part::Velocity => "PGV",
            Part::Eta => "eta",
            Part::Object => "the object's body",
            Part::Floor => "the building",
            Part::Hazard => "the hazard",
        }
    }
}

/// Something that is not known exactly, by its 16 and 84 % quantiles inside what is possible. Its median is in
/// the result itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unknown<T> {
    /// Whose it is.
    pub part: Part,
    /// 16 % quantile.
    pub low: T,
    /// 84 % quantile.
    pub high: T,
}

/// Standard deviations of a result: of ln of an annual rate, or of the logit of a probability, by part.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Budget {
    variances: [f64; Part::ALL.len()],
}

impl Budget {
    /// Adds an error that is independent of the others.
    fn add(&mut self, part: Part, sd: f64) {
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
        let variance = |part: &Part| self.variances[*part as usize];
        let largest = Part::ALL.iter().copied().max_by(|a, b| variance(a).total_cmp(&variance(b)));
        largest.filter(|part| variance(part) > 0.0)
    }

    /// 95 % limits of an annual rate, which is never above that of rocking.
    pub fn limits_of_rate(&self, rate: f64, of_rocking: f64) -> Limits {
        let factor = (Z_95 * self.sd()).exp();
        Limits { low: rate / factor, high: (rate * factor).min(of_rocking.max(rate)) }
    }

    /// 95 % limits of a probability under one motion; `tau` is the standard deviation of the logit between
    /// earthquakes.
    pub fn limits_of_probability(&self, p: f64, tau: f64) -> Limits {
        let half = Z_95 * self.sd().hypot(tau);
        let [low, high] = [-half, half].map(|off| 1.0 / (1.0 + (1.0 - p) / p * (-off).exp()));
        Limits { low, high }
    }
}

/// The budgets of two results: of failure and of overturning.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Budgets {
    pub failure: Budget,
    pub overturning: Budget,
}

impl Budgets {
    /// Adds the standard deviations of both results.
    pub fn add(&mut self, part: Part, [failure, overturning]: [f64; 2]) {
        self.failure.add(part, failure);
        self.overturning.add(part, overturning);
    }

    /// Adds what an unknown causes: half of the difference of the results between its quantiles.
    pub fn vary<T>(&mut self, unknown: &Unknown<T>, results: impl Fn(&T) -> [f64; 2]) {
        let [low, high] = [results(&unknown.low), results(&unknown.high)];
        self.add(unknown.part, [0, 1].map(|k| 0.5 * (high[k] - low[k])));
    }
}
