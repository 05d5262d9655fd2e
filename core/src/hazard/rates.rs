//! Rates of limit states: the hazard, of one peak or pairs of peaks, times the probabilities by a model.

use rayon::prelude::*;

use super::curve::{HazardCurve, Node};
use super::site::strongest;
use crate::fragility::{GivenPeak, LimitStates, ModelPoint, ReadyObject, RockingDirection};
use crate::motion::Peaks;
use crate::statistics::Interval;

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

/// None where the model has no probability. The limits are those if no motion beyond the last intensity causes
/// the event, and if each does.
pub fn rates_over_curve(given_peak: &GivenPeak, curve: &HazardCurve) -> LimitStates<Option<Interval>> {
    OverCurve::new(given_peak, curve, &[ModelPoint::Estimate]).rates(0)
}

/// The probabilities of an object, at each model point, at the nodes of a hazard curve.
pub(super) struct OverCurve {
    nodes: Vec<(Node, Vec<LimitStates<Option<f64>>>)>,
    /// How many lie on the curve: the others are where it is continued, to the strongest motions.
    given: usize,
}

impl OverCurve {
    pub fn new(given_peak: &GivenPeak, curve: &HazardCurve, points: &[ModelPoint]) -> OverCurve {
        let ([_, (last, _)], end) = (curve.ends(), strongest(given_peak.peak));
        let breaks = [given_peak.breaks(), vec![last]].concat();
        let nodes = curve.continued(end).nodes(&breaks, given_peak.widest_panel());
        let given = nodes.partition_point(|node| node.intensity < last || last >= end);
        let at = |node: Node| (node, given_peak.at_points(node.intensity, points));
        OverCurve { nodes: nodes.into_par_iter().map(at).collect(), given }
    }

    pub fn rates(&self, point: usize) -> LimitStates<Option<Interval>> {
        let mut sums = LimitStates::all(Some(Interval::default()));
        for (k, (node, states)) in self.nodes.iter().enumerate() {
            sums = sums.zip(states[point], |sum, p| {
                let (p, is_given) = (p?, k < self.given);
                let [low, high] = if is_given { [p, p] } else { [0.0, 1.0] };
                Some(sum?.zip(Interval { value: p, low, high }, |sum, p| sum + p * node.annual_rate))
            });
        }
        sums
    }

    /// The intensity above which half of the annual rate of overturning comes from; the last of the curve
    /// without a rate.
    pub fn median_intensity(&self) -> f64 {
        let half = self.rates(0).overturning.map_or(f64::INFINITY, |rate| 0.5 * rate.value);
        // Half of the rate at a node lies below it, half above.
        let (mut before, mut below, mut last) = (0.0, 0.0, None);
        for (node, states) in &self.nodes {
            let rate = states[0].overturning.unwrap_or(0.0) * node.annual_rate;
            let at_node = below + 0.5 * rate;
            let from = last.replace(node.intensity).unwrap_or(node.intensity);
            if at_node >= half {
                return from * (node.intensity / from).powf((half - before) / (at_node - before));
            }
            (before, below) = (at_node, below + rate);
        }
        self.nodes[self.given - 1].0.intensity
    }
}

/// At each model point, over bins of PGA and PGV.
pub(super) fn rates_over_pairs(
    directions: &[RockingDirection],
    mw: Option<f64>,
    bins: &[PairOfPeaks],
    points: &[ModelPoint],
) -> Vec<LimitStates<Option<Interval>>> {
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
    rates.into_iter().map(|rate| rate.map(|rate| rate.map(Interval::exact))).collect()
}
