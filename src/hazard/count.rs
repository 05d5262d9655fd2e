//! Annual rates counted among motions, without any curve of fragility.

use std::collections::BTreeMap;

use super::curve::HazardCurve;
use crate::normal;
use crate::resampling::{Strata, TOGETHER, bootstrap};
use crate::statistics::estimate::{Limits, quantile};

/// Bins of equal numbers of motions, as many as leave each so many motions.
const MOST_BINS: usize = 320;
const LEAST_IN_BIN: usize = 20;
/// How often the clusters are drawn anew.
const RESAMPLES: usize = 500;
/// The probability with which limits hold the rate.
const CONFIDENCE: f64 = 0.95;

/// A motion that is counted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CountedMotion<const N: usize> {
    /// In the measure of the hazard.
    pub intensity: f64,
    /// Whether each event happened, as 1 or 0; or its probability.
    pub events: [f64; N],
    /// Its cluster: motions of one cluster may depend on each other.
    pub cluster: usize,
}

/// A counted annual rate, with 95 % limits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CountedRate {
    pub value: f64,
    pub limits: Limits,
}

/// What is counted among motions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Count<const N: usize> {
    /// Of each event.
    pub rates: [CountedRate; N],
    /// The strongest motion.
    pub strongest: f64,
    /// The annual rate of stronger ones, which count as the strongest bin.
    pub rate_beyond: f64,
    /// How many were counted.
    pub motions: usize,
}

/// Motions of like intensity, which stand for all that come at the site.
struct Bin<const N: usize> {
    annual_rate: f64,
    motions: f64,
    events: [f64; N],
}

/// Counts the annual rates of events at motions that are weighted so that their intensities have the rates of the hazard: in bins
/// of equal numbers of motions, the rate of a bin times the share in which the event happened. Motions weaker than `least` cause
/// none; those stronger than the strongest bin count as this. None without motions.
///
/// The limits are the wider ones of two: percentiles of resamples of clusters, and those of a weighted sum of Poisson counts, which
/// also hold where no resample has an event more (Fay & Feuer 1997, Confidence intervals for directly standardized rates, Statistics
/// in Medicine 16, 791-801; with the quantiles of chi squared by Wilson & Hilferty 1931).
pub fn counted_rates<const N: usize>(
    curve: &HazardCurve,
    least: f64,
    mut motions: Vec<CountedMotion<N>>,
    seed: u64,
) -> Option<Count<N>> {
    motions.retain(|motion| motion.intensity >= least);
    motions.sort_by(|a, b| a.intensity.total_cmp(&b.intensity));
    let strongest = motions.last()?.intensity;
    let mut numbers: BTreeMap<usize, usize> = motions.iter().map(|motion| (motion.cluster, 0)).collect();
    numbers.values_mut().enumerate().for_each(|(number, place)| *place = number);
    motions.iter_mut().for_each(|motion| motion.cluster = numbers[&motion.cluster]);
    let in_all = bins(curve, least, &motions, |_| 1.0);
    // All clusters are of one stratum.
    let strata = Strata::new(&vec![0; numbers.len()]);
    let resampled = bootstrap(&strata, RESAMPLES, seed, |resamples| -> [[f64; N]; TOGETHER] {
        std::array::from_fn(|resample| {
            rates(&bins(curve, least, &motions, |cluster| resamples.counts[cluster][resample]))
        })
    });
    let values = rates(&in_all);
    let rate = |event: usize| {
        let mut drawn: Vec<f64> = resampled.iter().map(|rates| rates[event]).collect();
        drawn.sort_by(f64::total_cmp);
        let tail = 0.5 * (1.0 - CONFIDENCE);
        let poisson = poisson_limits(&in_all, event);
        let limits = Limits {
            low: poisson.low.min(quantile(&drawn, tail)),
            high: poisson.high.max(quantile(&drawn, 1.0 - tail)),
        };
        CountedRate { value: values[event], limits }
    };
    Some(Count {
        rates: std::array::from_fn(rate),
        strongest,
        rate_beyond: curve.exceedance(strongest),
        motions: motions.len(),
    })
}

/// The bins of motions in order, where each counts so many times. A motion is in the bin of the middle of its share.
fn bins<const N: usize>(
    curve: &HazardCurve,
    least: f64,
    motions: &[CountedMotion<N>],
    times: impl Fn(usize) -> f64,
) -> Vec<Bin<N>> {
    let number = (motions.len() / LEAST_IN_BIN).clamp(1, MOST_BINS);
    let all: f64 = motions.iter().map(|motion| times(motion.cluster)).sum();
    let (mut bins, mut before, mut current): (Vec<Bin<N>>, f64, usize) = (Vec::new(), 0.0, 0);
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
            bins.push(Bin { annual_rate: exceeded, motions: 0.0, events: [0.0; N] });
            current = place;
        }
        if let Some(bin) = bins.last_mut() {
            bin.motions += weight;
            bin.events.iter_mut().zip(motion.events).for_each(|(sum, event)| *sum += weight * event);
        }
    }
    bins
}

fn rates<const N: usize>(bins: &[Bin<N>]) -> [f64; N] {
    std::array::from_fn(|event| {
        bins.iter().map(|bin| bin.annual_rate * bin.events[event] / bin.motions).sum()
    })
}

fn poisson_limits<const N: usize>(bins: &[Bin<N>], event: usize) -> Limits {
    let weight = |bin: &Bin<N>| bin.annual_rate / bin.motions;
    let sum = |power: i32| bins.iter().map(|bin| weight(bin).powi(power) * bin.events[event]).sum::<f64>();
    let (rate, variance) = (sum(1), sum(2));
    let largest = bins.iter().map(weight).fold(0.0, f64::max);
    let scaled = |rate: f64, variance: f64, p: f64| {
        if variance == 0.0 {
            0.0
        } else {
            0.5 * variance / rate * chi_squared(p, 2.0 * rate * rate / variance)
        }
    };
    let tail = 0.5 * (1.0 - CONFIDENCE);
    Limits {
        low: scaled(rate, variance, tail),
        high: scaled(rate + largest, variance + largest * largest, 1.0 - tail),
    }
}

/// The quantile of chi squared with so many degrees of freedom.
fn chi_squared(p: f64, degrees: f64) -> f64 {
    let part = 2.0 / (9.0 * degrees);
    degrees * (1.0 - part + normal::quantile(p) * part.sqrt()).max(0.0).powi(3)
}
