//! Rates of limit states: the hazard, of one peak or pairs of peaks, times the probabilities by a model.

use super::curve::{HazardCurve, Node};
use crate::fragility::{GivenPeak, LimitStates, ModelPoint, ReadyObject, RockingDirection};
use crate::motion::Peaks;

/// Motions of one bin of PGA and PGV; the bins of a hazard do not overlap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairOfPeaks {
    pub peaks: Peaks,
    /// A rate of occurrence of motions of the bin, not of exceedance.
    pub annual_rate: f64,
    pub mw: Option<f64>,
}

/// Annual rates of exceedance of the values of one peak, from the smallest on.
pub fn exceedance(bins: &[PairOfPeaks], peak: impl Fn(&PairOfPeaks) -> f64) -> Vec<(f64, f64)> {
    let mut values: Vec<(f64, f64)> = bins.iter().map(|bin| (peak(bin), bin.annual_rate)).collect();
    values.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let mut sum = 0.0;
    for (_, rate) in &mut values {
        sum += *rate;
        *rate = sum;
    }
    values.reverse();
    // The first of equal values has the sum of their rates.
    values.dedup_by_key(|(value, _)| *value);
    values
}

/// A mean annual rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rate {
    pub value: f64,
    /// The part above the last intensity of the curve, with the probability at that intensity.
    pub at_last: f64,
    /// What is added if each stronger motion causes the event.
    pub beyond: f64,
}

/// Fraction of a rate that motions beyond the last intensity may add while its value still counts.
const NEGLIGIBLE: f64 = 0.1;

impl Rate {
    /// Whether motions beyond the last intensity may add too much.
    pub(super) fn is_open(&self) -> bool {
        self.beyond > NEGLIGIBLE * self.value
    }

    /// The rate if no motion above the last intensity causes the event.
    pub fn least(&self) -> f64 {
        self.value - self.at_last
    }

    /// The rate if each motion above the last intensity causes the event.
    pub fn most(&self) -> f64 {
        self.value + self.beyond
    }
}

/// None where the model has no probability.
pub fn rates_over_curve(given_peak: &GivenPeak, curve: &HazardCurve) -> LimitStates<Option<Rate>> {
    OverCurve::new(given_peak, curve, &[ModelPoint::Estimate]).rates(0)
}

/// The probabilities of an object, at each model point, at the nodes of a hazard curve and at its last
/// intensity, which stands for all beyond.
pub(super) struct OverCurve {
    within: Vec<(Node, Vec<LimitStates<Option<f64>>>)>,
    beyond: (Node, Vec<LimitStates<Option<f64>>>),
}

impl OverCurve {
    pub fn new(given_peak: &GivenPeak, curve: &HazardCurve, points: &[ModelPoint]) -> OverCurve {
        let at = |node: Node| (node, given_peak.at_points(node.intensity, points));
        let [_, (intensity, annual_rate)] = curve.ends();
        let nodes = curve.nodes(&given_peak.breaks(), given_peak.widest_panel()).into_iter();
        OverCurve { within: nodes.map(at).collect(), beyond: at(Node { intensity, annual_rate }) }
    }

    pub fn rates(&self, point: usize) -> LimitStates<Option<Rate>> {
        let mut sums = LimitStates::all(Some(0.0));
        for (node, states) in self.within.iter().chain([&self.beyond]) {
            sums = sums.zip(states[point], |sum, p| Some(sum? + p? * node.annual_rate));
        }
        let annual_rate = self.beyond.0.annual_rate;
        sums.zip(self.beyond.1[point], |value, at_last| {
            let (value, at_last) = value.zip(at_last)?;
            let beyond = (1.0 - at_last).max(0.0) * annual_rate;
            Some(Rate { value, at_last: at_last * annual_rate, beyond })
        })
    }

    /// The intensity above which half of the annual rate of overturning comes from; the last without a rate.
    pub fn median_intensity(&self) -> f64 {
        let half = self.rates(0).overturning.map_or(f64::INFINITY, |rate| 0.5 * rate.value);
        // Half of the rate at a node lies below it, half above.
        let (mut before, mut below, mut last) = (0.0, 0.0, None);
        for (node, states) in &self.within {
            let rate = states[0].overturning.unwrap_or(0.0) * node.annual_rate;
            let at_node = below + 0.5 * rate;
            let from = last.replace(node.intensity).unwrap_or(node.intensity);
            if at_node >= half {
                return from * (node.intensity / from).powf((half - before) / (at_node - before));
            }
            (before, below) = (at_node, below + rate);
        }
        self.beyond.0.intensity
    }
}

/// At each model point, over bins of PGA and PGV.
pub(super) fn rates_over_pairs(
    directions: &[RockingDirection],
    mw: Option<f64>,
    bins: &[PairOfPeaks],
    points: &[ModelPoint],
) -> Vec<LimitStates<Option<Rate>>> {
    let mut ready = ReadyObject::new(directions, mw);
    let mut rates = vec![LimitStates::all(Some(0.0)); points.len()];
    for bin in bins {
        let mw = bin.mw.or(mw);
        if mw != ready.mw {
            ready = ReadyObject::new(directions, mw);
        }
        for (rate, states) in rates.iter_mut().zip(ready.limit_states(bin.peaks, points)) {
            *rate = rate.zip(states, |sum, p| Some(sum? + p? * bin.annual_rate));
        }
    }
    let rates = rates.into_iter();
    rates.map(|rate| rate.map(|value| Some(Rate { value: value?, at_last: 0.0, beyond: 0.0 }))).collect()
}
