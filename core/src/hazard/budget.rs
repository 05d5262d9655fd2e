//! The error budget: how much each source of uncertainty moves a result, and the limits that follow.

use crate::object::{LowHigh, UncertaintySource};
use crate::statistics::Interval;
use crate::statistics::normal::Z_95;
use strum::VariantArray;

/// What is unknown of ln of an annual rate, or of the logit of a probability.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Budget {
    /// The changes of the result with each independent unknown at its quantiles, over the standard deviations
    /// from its median to these.
    pub changes: Vec<LowHigh<f64>>,
}

impl Budget {
    /// How far a result moves to the quantiles of each source; not at all without a result.
    pub fn new<T>(middle: &T, at_quantiles: &[LowHigh<T>], result: impl Fn(&T) -> Option<f64>) -> Budget {
        let mut budget = Budget::default();
        let Some(middle) = result(middle) else { return budget };
        for results in at_quantiles {
            // Standard deviations from the median to the quantiles: fractiles of hazards are 16 and 84 %.
            let deviations = if results.source == UncertaintySource::Hazard { 1.0 } else { Z_95 };
            let Some((low, high)) = result(&results.low).zip(result(&results.high)) else { continue };
            let [low, high] = [low, high].map(|end| (end - middle) / deviations);
            budget.add(LowHigh { source: results.source, low, high });
        }
        budget
    }

    /// A change that is not finite does not count.
    pub fn add(&mut self, change: LowHigh<f64>) {
        self.changes.push(change.map(|change| if change.is_finite() { *change } else { 0.0 }));
    }

    pub(super) fn of(&self, source: UncertaintySource) -> impl Iterator<Item = &LowHigh<f64>> {
        self.changes.iter().filter(move |change| change.source == source)
    }

    /// Downwards and upwards, since a rate saturates.
    fn variances(&self, source: UncertaintySource) -> [f64; 2] {
        self.of(source).fold([0.0; 2], |[down, up], LowHigh { low, high, .. }| {
            [down + low.min(*high).min(0.0).powi(2), up + low.max(*high).max(0.0).powi(2)]
        })
    }

    /// The mean of the standard deviations downwards and upwards; none where it is 0.
    pub fn source_sd(&self, source: UncertaintySource) -> Option<f64> {
        let [down, up] = self.variances(source).map(f64::sqrt);
        Some(0.5 * (down + up)).filter(|sd| *sd > 0.0)
    }

    /// Standard deviations of the result, downwards and upwards.
    pub fn sds(&self) -> [f64; 2] {
        let sources = UncertaintySource::VARIANTS.iter().map(|source| self.variances(*source));
        sources.fold([0.0; 2], |sum, of| [sum[0] + of[0], sum[1] + of[1]]).map(f64::sqrt)
    }

    /// Of ln of the rate after a change over that before. An unknown that is shared moves both rates, so that
    /// the difference of its changes counts; another moves each rate by itself.
    pub fn of_ratio(
        before: &Budget,
        after: &Budget,
        is_shared: impl Fn(UncertaintySource) -> bool,
    ) -> Budget {
        let mut ratio = Budget::default();
        for &source in UncertaintySource::VARIANTS {
            let [before, after] = [before, after].map(|budget| budget.of(source).collect::<Vec<_>>());
            let none = LowHigh { source, low: 0.0, high: 0.0 };
            for number in 0..before.len().max(after.len()) {
                let [old, new] = [&before, &after].map(|all| all.get(number).map_or(none, |of| **of));
                let apart = if is_shared(source) { vec![(old, new)] } else { vec![(old, none), (none, new)] };
                ratio.changes.extend(apart.into_iter().map(|(old, new)| LowHigh {
                    source,
                    low: new.low - old.low,
                    high: new.high - old.high,
                }));
            }
        }
        ratio
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
