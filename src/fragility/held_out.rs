//! How a curve does on clusters of cases that it has not seen, and by how much these differ from it.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::sample::CLUSTER;
use crate::resampling::folds::MOST_FOLDS;
use crate::statistics::binary::as_numbers;
use crate::statistics::columns::Columns;
use crate::statistics::design::{Design, Rows, dot};
use crate::statistics::link::Link;
use crate::wide::widest_on;

/// What cases tell that were left out, each cluster of magnitude and distance (or earthquake) as a whole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeldOut {
    /// Mean logarithm of the probability of what happened.
    pub log_score: f64,
    /// Standard deviation of the index between clusters, of greatest likelihood.
    pub spread: f64,
}

/// Shifts of the index of a whole cluster, over which its likelihood is integrated.
const STEP: f64 = 0.1;
const STEPS_EACH_SIDE: usize = 30;
const SHIFTS: usize = 2 * STEPS_EACH_SIDE + 1;
/// Standard deviations that are tried: steps of a twelfth, up to where the shifts end twice away.
const LEAST_SPREAD: f64 = 0.05;
const SPREADS: i32 = 42;
const RATIO: f64 = 1.085;

/// The place of each cluster of the cases of a design among all in order.
type Places = BTreeMap<usize, usize>;

/// None where nothing can be left out, or where each case is a cluster of its own.
fn places(design: &Design) -> Option<Places> {
    let distinct = design.distinct(CLUSTER);
    let some_share = distinct.len() > 1 && distinct.len() < design.cases();
    some_share.then(|| distinct.into_iter().enumerate().map(|(place, cluster)| (cluster, place)).collect())
}

fn places_of(rows: &Rows, places: &Places) -> Vec<usize> {
    rows.labels[CLUSTER].iter().map(|cluster| places[&(*cluster as usize)]).collect()
}

impl HeldOut {
    /// Of cases with this design, and the labels of a sample; `refit` gets how often each case counts, `index` tells what a refit says of
    /// some cases, and `happened` which of what was observed is the event. None where nothing can be left out, where each case is a
    /// cluster of its own (so that nothing tells clusters from cases), or where a fit does not exist.
    pub fn new<Refit: Sync>(
        design: &Design,
        link: Link,
        refit: impl Fn(&[f64]) -> Option<Refit>,
        index: impl Fn(&Refit, &Rows) -> Vec<f64> + Sync,
        happened: impl Fn(f64) -> bool + Sync,
    ) -> Option<HeldOut> {
        let places = places(design)?;
        // Neighbouring clusters fall into different folds, as in `Folds`.
        let folds = places.len().min(MOST_FOLDS);
        let fits = (0..folds).map(|fold| {
            let is_kept = |place: usize| f64::from(u8::from(place % folds != fold));
            let of_block =
                |rows: &Rows| places_of(rows, &places).into_iter().map(is_kept).collect::<Vec<f64>>();
            // A number for each case, held in memory as long as the refit takes.
            refit(&design.fold(CLUSTER + 1, of_block, |all, part| all.extend(part)))
        });
        let fits = fits.collect::<Option<Vec<Refit>>>()?;
        let of_others = |rows: &Rows, of: &[usize]| -> Vec<f64> {
            let by_fold: Vec<Vec<f64>> = fits.iter().map(|fit| index(fit, rows)).collect();
            of.iter().enumerate().map(|(case, place)| by_fold[place % folds][case]).collect()
        };
        Some(HeldOut::of(design, &places, link, of_others, happened))
    }

    /// Of indices that come from other clusters each.
    pub fn of_indices(indices: &[f64], happened: &[bool], clusters: &[usize], link: Link) -> Option<HeldOut> {
        let mut columns = Columns::new(4, &Arc::default());
        let numbers = |of: &[usize]| of.iter().map(|&number| number as f64).collect::<Vec<f64>>();
        let rows: Vec<usize> = (0..indices.len()).collect();
        columns.append(&[indices.to_vec(), as_numbers(happened), numbers(&rows), numbers(clusters)]);
        let design = Design::new(&columns, 1);
        let own = |rows: &Rows, _: &[usize]| rows.x[1].to_vec();
        Some(HeldOut::of(&design, &places(&design)?, link, own, |y| y != 0.0))
    }

    fn of(
        design: &Design,
        places: &Places,
        link: Link,
        index: impl Fn(&Rows, &[usize]) -> Vec<f64> + Sync,
        happened: impl Fn(f64) -> bool + Sync,
    ) -> HeldOut {
        let shifts: [f64; SHIFTS] = std::array::from_fn(|k| STEP * (k as f64 - STEPS_EACH_SIDE as f64));
        // The log-likelihood of each cluster, its index shifted so far.
        let of_block = |rows: &Rows| {
            let of = places_of(rows, places);
            let indices = index(rows, &of);
            let events = as_numbers(&rows.y.iter().map(|y| happened(*y)).collect::<Vec<bool>>());
            let mut slots = BTreeMap::new();
            let slot = |&place: &usize| {
                let next = slots.len();
                *slots.entry(place).or_insert(next)
            };
            let at: Vec<usize> = of.iter().map(slot).collect();
            let mut sums = vec![[0.0; SHIFTS]; slots.len()];
            let mut values = vec![0.0; indices.len()];
            for (k, shift) in shifts.iter().enumerate() {
                values.iter_mut().zip(&indices).for_each(|(value, index)| *value = index + shift);
                widest_on(
                    &mut values,
                    #[inline(always)]
                    |values| link.ln_probabilities(&events, values),
                );
                values.iter().zip(&at).for_each(|(value, &slot)| sums[slot][k] += value);
            }
            slots.into_iter().map(|(place, slot)| (place, sums[slot])).collect::<BTreeMap<_, _>>()
        };
        let likelihoods = design.fold(CLUSTER + 1, of_block, |all, part| {
            for (place, more) in part {
                let sums = all.entry(place).or_insert([0.0; SHIFTS]);
                sums.iter_mut().zip(more).for_each(|(sum, more)| *sum += more);
            }
        });
        let log_score: f64 = likelihoods.values().map(|of_cluster| of_cluster[STEPS_EACH_SIDE]).sum();
        // Relative to the most likely shift, so that none underflows.
        let relative: Vec<(f64, [f64; SHIFTS])> = likelihoods
            .values()
            .map(|values| {
                let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                (most, values.map(|value| libm::exp(value - most)))
            })
            .collect();
        let integrated = |spread: f64| -> f64 {
            let weights = shifts.map(|u| libm::exp(-0.5 * (u / spread) * (u / spread)));
            let total: f64 = weights.iter().sum();
            let of_cluster =
                |(most, values): &(f64, [f64; SHIFTS])| most + libm::log(dot(values, &weights) / total);
            relative.iter().map(of_cluster).sum()
        };
        let tried =
            (0..SPREADS).map(|k| LEAST_SPREAD * RATIO.powi(k)).map(|spread| (integrated(spread), spread));
        let best = std::iter::once((log_score, 0.0)).chain(tried).max_by(|a, b| a.0.total_cmp(&b.0));
        let spread = best.map_or(0.0, |(_, spread)| spread);
        HeldOut { log_score: log_score / design.cases() as f64, spread }
    }
}
