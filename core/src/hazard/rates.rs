//! Annual rates of the limit states of a structure at a site: the hazard, of one peak or of pairs of peaks,
//! times the probabilities of a model.

use super::curve::{HazardCurve, Node};
use crate::fragility::{Direction, GivenPeak, Level, LimitStates, ReadyObject};
use crate::motion::Peaks;

/// Motions of one bin of PGA and PGV; the bins of a hazard do not overlap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairOfPeaks {
    /// Peaks that stand for the bin.
    pub peaks: Peaks,
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

/// A mean annual rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rate {
    pub value: f64,
    /// The part of it above the last intensity of the curve, with the probability at that intensity.
    pub at_last: f64,
    /// What would come on top if each stronger motion caused the event.
    pub beyond: f64,
}

/// Fraction of a rate that stronger motions than the last may add before it is no value.
const NEGLIGIBLE: f64 = 0.1;

impl Rate {
    /// Returns whether stronger motions than the last may add too much.
    pub(super) fn is_open(&self) -> bool {
        self.beyond > NEGLIGIBLE * self.value
    }

    /// Returns it if no motion above the last intensity causes the event.
    pub fn least(&self) -> f64 {
        self.value - self.at_last
    }

    /// Returns it if each motion above the last intensity causes the event.
    pub fn most(&self) -> f64 {
        self.value + self.beyond
    }
}

/// Integrates the probabilities given one peak over its hazard curve; none where the model has none.
pub fn rates_over_curve(given_peak: &GivenPeak, curve: &HazardCurve) -> LimitStates<Option<Rate>> {
    OverCurve::new(given_peak, curve, &[Level::Interval]).rates(0)
}

/// The probabilities of an object, at each level, at intensities that stand for all of a curve, and at its last
/// one, which stands for those beyond.
pub(super) struct OverCurve {
    within: Vec<(Node, Vec<LimitStates<Option<f64>>>)>,
    beyond: (Node, Vec<LimitStates<Option<f64>>>),
}

impl OverCurve {
    pub fn new(given_peak: &GivenPeak, curve: &HazardCurve, levels: &[Level]) -> OverCurve {
        let at = |node: Node| (node, given_peak.at_levels(node.intensity, levels));
        let [_, (intensity, annual_rate)] = curve.ends();
        let nodes = curve.nodes(&given_peak.breaks(), given_peak.widest_panel()).into_iter();
        OverCurve { within: nodes.map(at).collect(), beyond: at(Node { intensity, annual_rate }) }
    }

    /// Returns the annual rates at a level, by its number.
    pub fn rates(&self, level: usize) -> LimitStates<Option<Rate>> {
        let mut sums = LimitStates::all(Some(0.0));
        for (node, states) in self.within.iter().chain([&self.beyond]) {
            sums = sums.zip(states[level], |sum, p| Some(sum? + p? * node.annual_rate));
        }
        let annual_rate = self.beyond.0.annual_rate;
        sums.zip(self.beyond.1[level], |value, at_last| {
            let (value, at_last) = value.zip(at_last)?;
            let beyond = (1.0 - at_last).max(0.0) * annual_rate;
            Some(Rate { value, at_last: at_last * annual_rate, beyond })
        })
    }

    /// Finds the intensity above which half of the annual rate of overturning comes from; the last where there
    /// is no rate.
    pub fn median_intensity(&self) -> f64 {
        let half = self.rates(0).overturning.map_or(f64::INFINITY, |rate| 0.5 * rate.value);
        // A part lies half below its node, half above.
        let (mut before, mut below, mut last) = (0.0, 0.0, None);
        for (node, states) in &self.within {
            let part = states[0].overturning.unwrap_or(0.0) * node.annual_rate;
            let at_node = below + 0.5 * part;
            let from = last.replace(node.intensity).unwrap_or(node.intensity);
            if at_node >= half {
                return from * (node.intensity / from).powf((half - before) / (at_node - before));
            }
            (before, below) = (at_node, below + part);
        }
        self.beyond.0.intensity
    }
}

/// Sums the probabilities of an object in its directions at each level, times the rates, over bins of PGA and
/// PGV.
pub(super) fn rates_over_pairs(
    directions: &[Direction],
    mw: Option<f64>,
    bins: &[PairOfPeaks],
    levels: &[Level],
) -> Vec<LimitStates<Option<Rate>>> {
    let mut ready = ReadyObject::new(directions, mw);
    let mut rates = vec![LimitStates::all(Some(0.0)); levels.len()];
    for bin in bins {
        let mw = bin.mw.or(mw);
        if mw != ready.mw {
            ready = ReadyObject::new(directions, mw);
        }
        for (rate, states) in rates.iter_mut().zip(ready.limit_states(bin.peaks, levels)) {
            *rate = rate.zip(states, |sum, p| Some(sum? + p? * bin.annual_rate));
        }
    }
    let rates = rates.into_iter();
    rates.map(|rate| rate.map(|value| Some(Rate { value: value?, at_last: 0.0, beyond: 0.0 }))).collect()
}
