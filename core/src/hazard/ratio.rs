//! The rate of overturning after a change over that before, with limits in which shared errors cancel.

use crate::object::UncertaintySource;
use crate::statistics::Interval;
use crate::statistics::normal::Z_95;
use strum::VariantArray;

/// An annual rate, and the standard deviations of its logarithm by source.
#[derive(Debug, Clone, PartialEq)]
pub struct RateBySource {
    pub rate: f64,
    pub sds: Vec<(UncertaintySource, f64)>,
}

impl RateBySource {
    fn sd(&self, source: UncertaintySource) -> f64 {
        self.sds.iter().find(|(other, _)| *other == source).map_or(0.0, |(_, sd)| *sd)
    }
}

/// The rate after a change over the rate before, with 95 % limits. A shared source moves both rates alike, so
/// that only the difference of its effects counts, sd^2 = (sd_after - sd_before)^2; another counts twice,
/// sd_after^2 + sd_before^2.
pub fn ratio_of_rates(
    before: &RateBySource,
    after: &RateBySource,
    is_shared: impl Fn(UncertaintySource) -> bool,
) -> Interval {
    let variances = UncertaintySource::VARIANTS.iter().map(|&source| {
        let [before, after] = [before, after].map(|of| of.sd(source));
        if is_shared(source) { (after - before).powi(2) } else { before * before + after * after }
    });
    let factor = (Z_95 * variances.sum::<f64>().sqrt()).exp();
    let ratio = after.rate / before.rate;
    Interval { value: ratio, low: ratio / factor, high: ratio * factor }
}
