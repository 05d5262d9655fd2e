//! The error budget: how much each source of uncertainty moves a result, and the limits that follow.

use crate::object::{LowHigh, UncertaintySource};
use crate::statistics::Interval;
use crate::statistics::normal::Z_95;
use strum::VariantArray;

/// Standard deviations, by source, of ln of an annual rate or of the logit of a probability: downwards and
/// upwards, since a rate saturates.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Budget {
    variances: [[f64; 2]; UncertaintySource::VARIANTS.len()],
}

impl Budget {
    /// How far a result falls and rises between the quantiles of each source; 0 without a result.
    pub fn new<T>(middle: &T, at_quantiles: &[LowHigh<T>], result: impl Fn(&T) -> Option<f64>) -> Budget {
        let mut budget = Budget::default();
        let Some(middle) = result(middle) else { return budget };
        for results in at_quantiles {
            // Standard deviations from the median to the quantiles: fractiles of hazards are 16 and 84 %.
            let deviations = if results.source == UncertaintySource::Hazard { 1.0 } else { Z_95 };
            let Some((low, high)) = result(&results.low).zip(result(&results.high)) else { continue };
            let off = [low, high].map(|end| (end - middle) / deviations);
            budget.add(results.source, [-off[0].min(off[1]).min(0.0), off[0].max(off[1]).max(0.0)]);
        }
        budget
    }

    /// The error is independent of those added before.
    pub fn add(&mut self, source: UncertaintySource, sds: [f64; 2]) {
        for (sum, sd) in self.variances[source as usize].iter_mut().zip(sds) {
            *sum += if sd.is_finite() { sd * sd } else { 0.0 };
        }
    }

    /// The mean of the standard deviations downwards and upwards; none where it is 0.
    pub fn source_sd(&self, source: UncertaintySource) -> Option<f64> {
        let [down, up] = self.variances[source as usize].map(f64::sqrt);
        Some(0.5 * (down + up)).filter(|sd| *sd > 0.0)
    }

    pub fn sds(&self) -> [f64; 2] {
        [0, 1].map(|side| self.variances.iter().map(|source| source[side]).sum::<f64>().sqrt())
    }

    pub fn largest(&self) -> Option<UncertaintySource> {
        let known =
            UncertaintySource::VARIANTS.iter().filter_map(|&source| Some((source, self.source_sd(source)?)));
        known.max_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(source, _)| source)
    }

    /// 95 % limits of an annual rate, which are never above the rate of rocking.
    pub fn limit_rate(&self, rate: f64, rocking: f64) -> Interval {
        let [down, up] = self.sds().map(|sd| (Z_95 * sd).exp());
        Interval { value: rate, low: rate / down, high: (rate * up).min(rocking.max(rate)) }
    }

    /// 95 % limits of a probability, which are never above that of rocking; `tau` is the standard deviation
    /// of the logit between earthquakes.
    pub fn limit_probability(&self, p: f64, rocking: f64, tau: f64) -> Interval {
        if !(p > 0.0 && p < 1.0) {
            return Interval::exact(p);
        }
        let [down, up] = self.sds().map(|sd| Z_95 * sd.hypot(tau));
        let [low, high] = [-down, up].map(|off| 1.0 / (1.0 + (1.0 - p) / p * (-off).exp()));
        Interval { value: p, low, high: high.min(rocking.max(p)) }
    }
}
