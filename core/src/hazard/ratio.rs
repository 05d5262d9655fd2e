//! How many times as often an object overturns after a change, with limits in which what is not known of both
//! cancels.

use crate::fragility::Z_95;
use crate::object::Part;
use crate::statistics::Interval;
use strum::VariantArray;

/// An annual rate, and the standard deviations of its logarithm by part.
#[derive(Debug, Clone, PartialEq)]
pub struct RateByParts {
    /// The rate, a year.
    pub rate: f64,
    /// What is not known of it.
    pub sds: Vec<(Part, f64)>,
}

impl RateByParts {
    fn sd(&self, part: Part) -> f64 {
        self.sds.iter().find(|(other, _)| *other == part).map_or(0.0, |(_, sd)| *sd)
    }
}

/// Returns the rate after a change over the rate before, with 95 % limits. A part that is shared moves both
/// rates alike: only the difference of what it does to either counts, sd^2 = (sd_after - sd_before)^2;
/// another counts twice, sd_after^2 + sd_before^2.
pub fn ratio_of_rates(
    before: &RateByParts,
    after: &RateByParts,
    is_shared: impl Fn(Part) -> bool,
) -> Interval {
    let variances = Part::VARIANTS.iter().map(|&part| {
        let [before, after] = [before, after].map(|of| of.sd(part));
        if is_shared(part) { (after - before).powi(2) } else { before * before + after * after }
    });
    let factor = (Z_95 * variances.sum::<f64>().sqrt()).exp();
    let ratio = after.rate / before.rate;
    Interval { value: ratio, low: ratio / factor, high: ratio * factor }
}
