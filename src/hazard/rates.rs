//! Annual rates of the limit states of a structure at a site: the hazard, of one peak or of pairs of peaks,
//! times the probabilities of a model.

use super::curve::HazardCurve;
use crate::fragility::{GivenPeak, Model, Probability, Scenarios, limit_states_at};
use crate::rocking::Structure;

/// Motions of one bin of PGA and PGV; the bins of a hazard do not overlap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairOfPeaks {
    /// Peak ground acceleration that stands for the bin, m/s2.
    pub pga_m_s2: f64,
    /// Peak ground velocity that stands for the bin, m/s.
    pub pgv_m_s: f64,
    /// Mean number of motions of the bin in a year: a rate of occurrence, not of exceedance.
    pub annual_rate: f64,
    /// Moment magnitude of the earthquakes, if it is known.
    pub mw: Option<f64>,
}

/// Finds the annual rates at which the values of one peak are reached, from the smallest on.
pub fn exceedance(bins: &[PairOfPeaks], peak: impl Fn(&PairOfPeaks) -> f64) -> Vec<(f64, f64)> {
    let mut values: Vec<(f64, f64)> = bins.iter().map(|bin| (peak(bin), bin.annual_rate)).collect();
    values.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let mut sum = 0.0;
    for (_, rate) in &mut values {
        sum += *rate;
        *rate = sum;
    }
    values.reverse();
    // Of equal values the first holds the rates of all.
    values.dedup_by_key(|(value, _)| *value);
    values
}

/// Sums the mean annual rates of events that have these probabilities at a PGA and PGV: the sum over the bins
/// of rate times probability.
pub fn mean_annual_rates<const N: usize>(
    bins: &[PairOfPeaks],
    probabilities: impl Fn(&PairOfPeaks) -> [f64; N],
) -> [f64; N] {
    let mut rates = [0.0; N];
    for bin in bins {
        for (sum, p) in rates.iter_mut().zip(probabilities(bin)) {
            *sum += p * bin.annual_rate;
        }
    }
    rates
}

/// A mean annual rate.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Rate {
    pub value: f64,
    /// The part of it above the last intensity of the curve, with the probability at that intensity.
    pub of_last: f64,
    /// What would come on top if each stronger motion caused the event.
    pub beyond: f64,
}

/// Annual rates of LS1 to LS3 without limits; NaN where the model has no probability.
pub type Rates = [Rate; 3];

/// Integrates the probabilities given one peak over its hazard curve.
pub fn rates_over_curve(given_peak: &GivenPeak, curve: &HazardCurve) -> Rates {
    let values = |states: [Probability; 3]| states.map(|state| state.value);
    let states = |intensity| values(given_peak.limit_states(intensity, Scenarios::Many));
    let sums = curve.mean_annual_rates(&given_peak.jumps(), given_peak.widest_panel(), states);
    let [_, (last, rate_beyond)] = curve.ends();
    let at_last = states(last);
    [0, 1, 2].map(|k| Rate {
        value: sums[k],
        of_last: at_last[k] * rate_beyond,
        beyond: (1.0 - at_last[k]).max(0.0) * rate_beyond,
    })
}

/// Sums the probabilities of an object in its directions over bins of PGA and PGV.
pub(super) fn rates_over_pairs(
    directions: &[(Structure, Model)],
    mw: Option<f64>,
    bins: &[PairOfPeaks],
) -> Rates {
    let states = |bin: &PairOfPeaks| {
        let peaks = [bin.pga_m_s2, bin.pgv_m_s];
        limit_states_at(directions, peaks, bin.mw.or(mw), Scenarios::Many).map(|state| state.value)
    };
    mean_annual_rates(bins, states).map(|value| Rate { value, of_last: 0.0, beyond: 0.0 })
}

/// The intensity above which half of the annual rate of overturning comes from, to a hundredth of the curve's
/// range.
pub(super) fn median_intensity(given_peak: &GivenPeak, curve: &HazardCurve) -> f64 {
    const STEPS: i32 = 100;
    let [(first, _), (last, rate_beyond)] = curve.ends();
    let edge = |k: i32| first * (last / first).powf(f64::from(k) / f64::from(STEPS));
    let overturning = |intensity| given_peak.limit_states(intensity, Scenarios::Many)[2].value;
    let step = |k: i32| {
        let middle = (edge(k) * edge(k + 1)).sqrt();
        (middle, overturning(middle) * (curve.exceedance(edge(k)) - curve.exceedance(edge(k + 1))))
    };
    let parts: Vec<(f64, f64)> =
        (0..STEPS).map(step).chain([(last, overturning(last) * rate_beyond)]).collect();
    let half = 0.5 * parts.iter().map(|part| part.1).sum::<f64>();
    let mut sum = 0.0;
    let is_half = |part: &&(f64, f64)| {
        sum += part.1;
        sum >= half
    };
    parts.iter().find(is_half).map_or(last, |part| part.0)
}
