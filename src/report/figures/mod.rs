//! One function a figure, numbered as in the paper where it is one of the paper's; what they draw comes in
//! plain numbers.

mod demand;
mod map;
mod motion;
mod planes;
mod probability;
mod rates;
mod similarity;
mod studies;

use super::figure::{Axis, Estimate};
use crate::fragility::Measure;
use crate::keyword::Keyword;
use crate::motion::IntensityMeasures;

pub use demand::{MeasureFit, demand, quality, regressions};
pub use map::{LEVELS, Map, maps};
pub use motion::{Motion, motion};
pub use planes::{GroupPlanes, planes};
pub use probability::{Curve, ProbabilityPanel, StructureCurves, exceedance, hybrids, overturning};
pub use rates::{AnnualRate, list, rates};
pub use similarity::{History, similarity};
pub use studies::{Ida, NamedEstimates, ida, ranking, validation};

/// A rocking response with the measures of its motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RockingCase {
    pub pgv_m_s: f64,
    /// Period of the pulse, s, if known.
    pub tp_s: Option<f64>,
    /// Those of Eq. 13.
    pub measures: IntensityMeasures,
    /// |theta|max / alpha (Eq. 7); none if it overturned.
    pub edp: Option<f64>,
}

/// The rocking responses of one structure to one suite.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// Names of both.
    pub name: String,
    pub cases: Vec<RockingCase>,
}

impl RockingCase {
    /// Returns the demand in safe rocking, if it has a logarithm.
    fn demand(&self) -> Option<f64> {
        self.edp.filter(|edp| *edp > 0.0)
    }
}

/// Label of a measure (Eq. 13).
pub fn label(measure: Measure) -> &'static str {
    match measure {
        Measure::Im1 => "*ω*_{p} / *p*",
        Measure::Im2 => "*ω*_{m} / *p*",
        Measure::Im3 => "PGA / (*p* PGV)",
        Measure::Im4 => "PGA / (*g* tan *α*)",
        Measure::Im5 => "*p* PGV / (*g* tan *α*)",
        Measure::Im6 => "*ω*_{m} PGV / (*g* tan *α*)",
        Measure::Im3Inverse => "*p* PGV / PGA",
    }
}

/// Name of a measure: IM4.
fn name(measure: Measure) -> String {
    measure.as_str().to_uppercase()
}

/// Axis of the demand (Eq. 7).
fn demand_axis() -> Axis {
    Axis::log("|*θ*|_{max} / *α*")
}

/// Names the figure of the paper that shows the same.
fn compare(figure: &str) -> String {
    format!("Compare {figure} of Dimitrakopoulos & Paraskeva (2015).")
}

/// Makes a name fit for a file.
fn file_words(name: &str) -> String {
    let words = name.split(|letter: char| !letter.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    words.collect::<Vec<_>>().join("-").to_lowercase()
}

/// Gathers cases (value, whether the event happened) into bins: mean value, observed share with limits by
/// `limits` of events and cases (Wilson's), number of cases. Empty bins are left out.
pub fn observed_shares(
    cases: &[(f64, bool)],
    bin: impl Fn(f64) -> usize,
    limits: impl Fn(usize, usize) -> [f64; 2],
) -> Vec<Estimate> {
    let mut bins: Vec<(f64, usize, usize)> = Vec::new();
    for &(value, event) in cases {
        let place = bin(value);
        bins.resize(bins.len().max(place + 1), (0.0, 0, 0));
        let (sum, n, events) = &mut bins[place];
        (*sum, *n, *events) = (*sum + value, *n + 1, *events + usize::from(event));
    }
    let share = |&(sum, n, events): &(f64, usize, usize)| {
        let [low, high] = limits(events, n);
        Estimate { x: sum / n as f64, y: events as f64 / n as f64, low, high, n: n as f64 }
    };
    bins.iter().filter(|(_, n, _)| *n > 0).map(share).collect()
}

/// Bins of equal ratio between two values, for [`observed_shares`].
pub fn equal_ratios([low, high]: [f64; 2], count: usize) -> impl Fn(f64) -> usize {
    let ratio = (high / low).ln().max(f64::MIN_POSITIVE);
    move |value| (((value / low).ln() / ratio * count as f64) as usize).min(count - 1)
}

/// Cuts a series down to `most` values or fewer: to the least and the largest value of each of `most` / 2
/// steps, in their order.
fn envelope(values: &[f64], step: f64, most: usize) -> Vec<[f64; 2]> {
    let each = values.len().div_ceil(most).max(1);
    let ends = values.chunks(2 * each).enumerate().flat_map(|(k, bucket)| {
        let index = |is_better: fn(&f64, &f64) -> bool| {
            (1..bucket.len())
                .fold(0, |best, at| if is_better(&bucket[at], &bucket[best]) { at } else { best })
        };
        let (least, largest) = (index(f64::lt), index(f64::gt));
        let value = move |at: usize| [(2 * k * each + at) as f64 * step, bucket[at]];
        [value(least.min(largest)), value(least.max(largest))]
    });
    match each {
        1 => values.iter().enumerate().map(|(k, value)| [k as f64 * step, *value]).collect(),
        _ => ends.collect(),
    }
}
