//! Limits of confidence from bootstrap replicates.

use std::collections::BTreeMap;

use super::bootstrap::{Sizes, Strata};
use crate::normal;
use crate::statistics::estimate::{Limits, quantile};

/// The limits that replicates of an estimate give.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BootstrapLimits {
    /// The quantiles of the replicates.
    pub percentile: Limits,
    /// Bias-corrected and accelerated: second-order accurate, and the same whatever the scale of the parameter. None
    /// where all replicates lie on one side of the estimate.
    pub bca: Option<Limits>,
}

impl BootstrapLimits {
    /// Percentile low and high, BCa low and high.
    pub fn in_order(&self) -> [Option<f64>; 4] {
        let Limits { low, high } = self.percentile;
        [Some(low), Some(high), self.bca.map(|bca| bca.low), self.bca.map(|bca| bca.high)]
    }
}

/// Whether so few of the replicates have a value that the others could fill the tails.
pub fn are_too_few(values: usize, replicates: usize, confidence: f64) -> bool {
    values == 0 || (replicates - values) as f64 > (1.0 - confidence) * replicates as f64
}

/// The limits at `confidence` of `estimate` from its replicates, where `acceleration` is that of [`acceleration`]
/// (DiCiccio & Efron 1996, Bootstrap confidence intervals, Statistical Science 11, 189-228). None where too few
/// have a value.
pub fn bootstrap_limits(
    estimate: f64,
    replicates: &[Option<f64>],
    acceleration: f64,
    confidence: f64,
) -> Option<BootstrapLimits> {
    let mut values: Vec<f64> = replicates.iter().flatten().copied().filter(|v| v.is_finite()).collect();
    if are_too_few(values.len(), replicates.len(), confidence) {
        return None;
    }
    values.sort_by(f64::total_cmp);
    let tail = 0.5 * (1.0 - confidence);
    let at = |tail: f64| quantile(&values, tail);
    let percentile = Limits { low: at(tail), high: at(1.0 - tail) };
    let bias = normal::quantile(rank(&values, estimate));
    let corrected = |tail: f64| {
        let z = bias + normal::quantile(tail);
        normal::cdf(bias + z / (1.0 - acceleration * z))
    };
    let (low, high) = (corrected(tail), corrected(1.0 - tail));
    let bca = (low.is_finite() && high.is_finite() && bias.is_finite())
        .then(|| Limits { low: at(low), high: at(high) });
    Some(BootstrapLimits { percentile, bca })
}

/// The acceleration of BCa limits: a sixth of the skewness of the jackknife, over strata (DiCiccio & Efron 1996, Eq. 6.6;
/// Davison & Hinkley 1997, Eq. 5.33). `without_each` holds the estimate without each row in turn.
pub fn acceleration(without_each: &[f64], strata: &Strata) -> f64 {
    let mut moves = Moves::new();
    for (&label, rows) in strata.labels().iter().zip(strata.members()) {
        rows.iter().for_each(|&row| add_move(&mut moves, label, without_each[row] - without_each[0]));
    }
    acceleration_of(&moves, &strata.sizes())
}

/// Of each stratum the sums of the first three powers of what an estimate is moved by without each of its rows.
pub type Moves = BTreeMap<usize, [f64; 3]>;

/// Adds that of a row.
pub fn add_move(moves: &mut Moves, stratum: usize, by: f64) {
    let sums = moves.entry(stratum).or_default();
    sums.iter_mut().zip([by, by * by, by * by * by]).for_each(|(sum, power)| *sum += power);
}

/// Joins those of other rows.
pub fn join_moves(moves: &mut Moves, others: Moves) {
    for (stratum, more) in others {
        let sums = moves.entry(stratum).or_default();
        sums.iter_mut().zip(more).for_each(|(sum, more)| *sum += more);
    }
}

/// [`acceleration`] from the moves of an estimate; rows of strata of these sizes that are not among them do not move it.
pub fn acceleration_of(moves: &Moves, sizes: &Sizes) -> f64 {
    let (mut cubes, mut squares) = (0.0, 0.0);
    for (stratum, [first, second, third]) in moves {
        let n = sizes.get(stratum).map_or(1.0, |&size| size as f64);
        let (mean, share) = (first / n, (n - 1.0) / n);
        squares += share.powi(2) * (second - mean * first);
        cubes -= share.powi(3) * (third - 3.0 * mean * second + 2.0 * mean * mean * first);
    }
    if squares > 0.0 { cubes / (6.0 * libm::pow(squares, 1.5)) } else { 0.0 }
}

/// The share of values below `x`, ties counted half.
fn rank(sorted: &[f64], x: f64) -> f64 {
    let (below, up_to) = (sorted.partition_point(|&v| v < x), sorted.partition_point(|&v| v <= x));
    0.5 * (below + up_to) as f64 / sorted.len() as f64
}
