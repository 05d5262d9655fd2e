//! One budget of errors: what is not known exactly, how much each part moves a result, and the limits that
//! follow.

use crate::fragility::Z_95;
use crate::keyword::{Keyword, keywords};
use crate::statistics::Limits;

keywords! {
    /// What an error comes from.
    pub enum Part {
        /// Parameters of the fragility model.
        Fit = "fit",
        /// Magnitude of the earthquakes.
        Magnitude = "magnitude",
        /// Level of PGV / PGA.
        Velocity = "velocity",
        /// Coefficient of restitution.
        Eta = "eta",
        /// Centre of mass and inertia.
        Object = "object",
        /// Building under the object.
        Floor = "floor",
        /// The hazard itself, where its fractiles are given.
        Hazard = "hazard",
    }
}

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

/// Something that is not known exactly, by its 2.5 and 97.5 % quantiles inside what is possible; the hazard
/// by its 16 and 84 % fractiles, as agencies give them. Its median is in the result itself.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unknown<T> {
    /// Source of the error.
    pub part: Part,
    /// Lower and upper quantile.
    pub quantiles: [T; 2],
}

/// Standard deviations of a result, of ln of an annual rate or of the logit of a probability, by part:
/// downwards and upwards, since a rate saturates.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Budget {
    variances: [[f64; 2]; Part::ALL.len()],
}

impl Budget {
    /// Adds an error that is independent of the others.
    fn add(&mut self, part: Part, sds: [f64; 2]) {
        for (sum, sd) in self.variances[part as usize].iter_mut().zip(sds) {
            *sum += if sd.is_finite() { sd * sd } else { 0.0 };
        }
    }

    /// The standard deviation that a part causes, the mean of both; none where nothing of it is unknown.
    pub fn sd_of(&self, part: Part) -> Option<f64> {
        let [down, up] = self.variances[part as usize].map(f64::sqrt);
        Some(0.5 * (down + up)).filter(|sd| *sd > 0.0)
    }

    /// Standard deviations of all parts combined.
    pub fn sds(&self) -> [f64; 2] {
        [0, 1].map(|side| self.variances.iter().map(|part| part[side]).sum::<f64>().sqrt())
    }

    /// The part that causes most.
    pub fn largest(&self) -> Option<Part> {
        let known = Part::ALL.iter().filter_map(|&part| Some((part, self.sd_of(part)?)));
        known.max_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(part, _)| part)
    }

    /// 95 % limits of an annual rate, which is never above that of rocking.
    pub fn limits_of_rate(&self, rate: f64, of_rocking: f64) -> Limits {
        let [down, up] = self.sds().map(|sd| (Z_95 * sd).exp());
        Limits { low: rate / down, high: (rate * up).min(of_rocking.max(rate)) }
    }

    /// 95 % limits of a probability under one motion; `tau` is the standard deviation of the logit between
    /// earthquakes.
    pub fn limits_of_probability(&self, p: f64, tau: f64) -> Limits {
        let [down, up] = self.sds().map(|sd| Z_95 * sd.hypot(tau));
        let [low, high] = [-down, up].map(|off| 1.0 / (1.0 + (1.0 - p) / p * (-off).exp()));
        Limits { low, high }
    }
}

/// The budgets of two results, of failure and of overturning, about their values at all medians.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Budgets {
    /// Of a demand above the limit state, or overturning.
    pub failure: Budget,
    /// Of overturning.
    pub overturning: Budget,
    values: [f64; 2],
}

impl Budgets {
    /// Without errors.
    pub fn about(values: [f64; 2]) -> Budgets {
        Budgets { values, ..Budgets::default() }
    }

    /// Adds the standard deviations of both results, downwards and upwards.
    pub fn add(&mut self, part: Part, [failure, overturning]: [[f64; 2]; 2]) {
        self.failure.add(part, failure);
        self.overturning.add(part, overturning);
    }

    /// Adds what an unknown causes: how far the results fall and rise between its quantiles, as standard
    /// deviations.
    pub fn vary<T>(&mut self, unknown: &Unknown<T>, results: impl Fn(&T) -> [f64; 2]) {
        let [low, high] = unknown.quantiles.each_ref().map(results);
        // How many standard deviations the quantiles are from the median.
        let deviations = if unknown.part == Part::Hazard { 1.0 } else { Z_95 };
        let sds = |k: usize| {
            let off = [low[k], high[k]].map(|end| (end - self.values[k]) / deviations);
            [-off[0].min(off[1]).min(0.0), off[0].max(off[1]).max(0.0)]
        };
        self.add(unknown.part, [sds(0), sds(1)]);
    }
}
