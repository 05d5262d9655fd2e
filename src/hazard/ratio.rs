//! How many times as often an object overturns after a change, with limits in which what is not known of both
//! cancels.

use crate::fragility::Z_95;
use crate::keyword::Keyword;
use crate::object::Part;
use crate::statistics::Estimate;

/// An annual rate, and the standard deviations of its logarithm by part.
#[derive(Debug, Clone, PartialEq)]
pub struct RateByParts {
    /// The rate, a year.
    pub rate: f64,
    /// What is not known of it.
    pub sds: Vec<(Part, f64)>,
}

/// The rate after a change over the rate before, with 95 % limits. A part that is shared moves both rates
/// alike: only the difference of what it does to either counts, sd^2 = (sd_after - sd_before)^2; another
/// counts twice, sd_after^2 + sd_before^2.
pub fn ratio_of_rates(
    before: &RateByParts,
    after: &RateByParts,
    is_shared: impl Fn(Part) -> bool,
) -> Estimate {
    let sd_of = |of: &RateByParts, part: Part| {
        of.sds.iter().find(|(other, _)| *other == part).map_or(0.0, |(_, sd)| *sd)
    };
    let variance = |&part: &Part| {
        let [before, after] = [before, after].map(|of| sd_of(of, part));
        if is_shared(part) { (after - before).powi(2) } else { before * before + after * after }
    };
    let factor = (Z_95 * Part::ALL.iter().map(variance).sum::<f64>().sqrt()).exp();
    let ratio = after.rate / before.rate;
    Estimate { value: ratio, low: ratio / factor, high: ratio * factor }
}
