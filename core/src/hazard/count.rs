//! The annual rate of an event counted among motions, without any curve of fragility.

use std::collections::BTreeMap;

use rand::RngExt;
use rayon::prelude::*;

use super::curve::HazardCurve;
use crate::random::{Purpose, stream};
use crate::statistics::Interval;
use crate::statistics::distributions::chi_squared_quantile;

/// Most bins of equal numbers of motions, and least motions in each.
const MOST_BINS: usize = 320;
const LEAST_IN_BIN: usize = 20;
const RESAMPLES: u64 = 500;
/// Probability below the lower limit, and above the upper one.
const TAIL: f64 = 0.025;

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CountedMotion {
    /// In the measure of the hazard.
    pub intensity: f64,
    pub event: bool,
    /// Motions of one cluster may depend on each other.
    pub cluster: u32,
}

/// An annual rate counted among motions, with 95 % limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CountedRate {
    pub annual_rate: Interval,
    /// Number of motions that were counted.
    pub motions: usize,
}

/// Motions of similar intensity, which stand for all that occur at the site.
struct Bin {
    annual_rate: f64,
    motions: f64,
    events: f64,
}

/// Counts the annual rate of an event among motions, weighted so that their intensities have the rates of the
/// hazard: in bins of equal numbers of motions, the rate of a bin times the share with the event. Motions
/// weaker than `least` cause no event; those beyond the strongest bin count as in it. None without motions.
///
/// The limits are the wider ones of two: percentiles of resamples of clusters, and those of a weighted sum of
/// Poisson counts, which also hold where no resample has an event more (Fay & Feuer 1997, Confidence
/// intervals for directly standardized rates, Statistics in Medicine 16, 791-801).
pub fn counted_rate(
    curve: &HazardCurve,
    least: f64,
    mut motions: Vec<CountedMotion>,
    seed: u64,
) -> Option<CountedRate> {
    motions.retain(|motion| motion.intensity >= least);
    motions.sort_by(|a, b| a.intensity.total_cmp(&b.intensity));
    motions.last()?;
    let mut numbers: BTreeMap<u32, u32> = motions.iter().map(|motion| (motion.cluster, 0)).collect();
    numbers.values_mut().zip(0..).for_each(|(number, place)| *number = place);
    motions.iter_mut().for_each(|motion| motion.cluster = numbers[&motion.cluster]);
    let in_all = bins(curve, least, &motions, |_| 1.0);
    let drawn = (0..RESAMPLES).into_par_iter().map(|resample| {
        // Draws with replacement as many clusters as there are, and counts how often each is drawn.
        let (mut times, mut random) = (vec![0.0; numbers.len()], stream(seed, Purpose::Bootstrap, resample));
        (0..times.len()).for_each(|_| times[random.random_range(0..numbers.len())] += 1.0);
        rate(&bins(curve, least, &motions, |cluster| times[cluster as usize]))
    });
    let mut drawn: Vec<f64> = drawn.collect();
    drawn.sort_by(f64::total_cmp);
    let [drawn_low, drawn_high] =
        [TAIL, 1.0 - TAIL].map(|share| drawn[(share * (drawn.len() - 1) as f64).round() as usize]);
    let poisson = poisson_limits(&in_all);
    let (low, high) = (poisson.low.min(drawn_low), poisson.high.max(drawn_high));
    Some(CountedRate { annual_rate: Interval { low, high, ..poisson }, motions: motions.len() })
}

/// In order of intensity; `times` is how often a cluster was drawn. The middle of its weight decides the bin
/// of a motion.
fn bins(curve: &HazardCurve, least: f64, motions: &[CountedMotion], times: impl Fn(u32) -> f64) -> Vec<Bin> {
    let number = (motions.len() / LEAST_IN_BIN).clamp(1, MOST_BINS);
    let all: f64 = motions.iter().map(|motion| times(motion.cluster)).sum();
    let (mut bins, mut before, mut current): (Vec<Bin>, f64, usize) = (Vec::new(), 0.0, 0);
    for motion in motions {
        let weight = times(motion.cluster);
        if weight == 0.0 {
            continue;
        }
        let place = ((before + 0.5 * weight) / all * number as f64) as usize;
        before += weight;
        if bins.is_empty() || place != current {
            let exceeded = curve.exceedance(if bins.is_empty() { least } else { motion.intensity });
            if let Some(below) = bins.last_mut() {
                below.annual_rate -= exceeded;
            }
            bins.push(Bin { annual_rate: exceeded, motions: 0.0, events: 0.0 });
            current = place;
        }
        if let Some(bin) = bins.last_mut() {
            bin.motions += weight;
            bin.events += weight * f64::from(motion.event);
        }
    }
    bins
}

fn rate(bins: &[Bin]) -> f64 {
    bins.iter().map(|bin| bin.annual_rate * bin.events / bin.motions).sum()
}

/// With the limits of a weighted sum of Poisson counts.
fn poisson_limits(bins: &[Bin]) -> Interval {
    let (mut variance, mut largest) = (0.0, 0.0_f64);
    for Bin { annual_rate, motions, events } in bins {
        let weight = annual_rate / motions;
        variance += weight * weight * events;
        largest = largest.max(weight);
    }
    let value = rate(bins);
    let low = poisson_quantile(value, variance, TAIL);
    let high = poisson_quantile(value + largest, variance + largest * largest, 1.0 - TAIL);
    Interval { value, low, high }
}

/// A quantile of the gamma distribution of this mean and variance, by chi squared.
fn poisson_quantile(mean: f64, variance: f64, p: f64) -> f64 {
    if variance == 0.0 {
        return 0.0;
    }
    0.5 * variance / mean * chi_squared_quantile(p, 2.0 * mean * mean / variance)
}
