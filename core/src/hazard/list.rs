use std::collections::BTreeMap;

use super::budget::Budget;
use super::ground_motion::GroundMotion;
use super::probability_in_years;
use super::site::{Site, SiteRates};
use crate::object::{LowHigh, RockingObject, UncertaintySource};
use crate::statistics::Interval;
use crate::statistics::normal::{self, Z_95};
use strum::VariantArray;

/// An object of a list: how often it is there, how long at a site, and its annual rate or its probability
/// of overturning.
#[derive(Debug, Clone, Copy)]
pub struct ListedObject<'a> {
    pub object: &'a RockingObject,
    pub count: f64,
    pub years: f64,
    pub overturning: Interval<Option<f64>>,
    pub budget: &'a Budget,
}

/// What happens to the objects of a list, with 95 % limits; nothing if none may overturn.
#[derive(Debug, Clone, Copy, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(default)]
pub struct ListProbabilities {
    pub at_least_one: Interval<Option<f64>>,
    pub expected_number: Interval<Option<f64>>,
}

impl Site {
    /// In the last years of each. What is unknown of the site moves all objects, what is unknown of an object
    /// moves it alone.
    pub fn list(&self, list: &[ListedObject]) -> ListProbabilities {
        let list = may_overturn(list);
        let number_at = |listed: &ListedObject, factor: f64| {
            let rate = listed.overturning.value.unwrap_or(0.0) * factor;
            listed.count * probability_in_years(rate, listed.years)
        };
        let sum: f64 = list.iter().map(|listed| number_at(listed, 1.0)).sum();
        // Limits lie about the mean over what is unknown of each object, to which these sum up.
        let means: Vec<f64> = list.iter().map(|listed| mean_factor(listed.budget)).collect();
        let mean = |place: usize, change: f64| number_at(&list[place], means[place] * (Z_95 * change).exp());
        let mean_sum: f64 = (0..list.len()).map(|place| mean(place, 0.0)).sum();
        // How far each unknown moves the number: one of the site is the same for all objects.
        let mut moves: BTreeMap<_, LowHigh<f64>> = BTreeMap::new();
        for (place, listed) in list.iter().enumerate() {
            let now = mean(place, 0.0);
            for &source in UncertaintySource::VARIANTS {
                let of = if source.is_of_site() { 0 } else { place };
                for (unknown, change) in listed.budget.of(source).enumerate() {
                    let none = LowHigh { source, low: 0.0, high: 0.0 };
                    let sum = moves.entry((source, of, unknown)).or_insert(none);
                    sum.low += mean(place, change.low) - now;
                    sum.high += mean(place, change.high) - now;
                }
            }
        }
        let changes = moves.into_values().map(|of| of.map(|moved| (moved / mean_sum).ln_1p() / Z_95));
        let budget = Budget { changes: changes.collect() };
        if list.is_empty() {
            return ListProbabilities::default();
        }
        let own = budget.changes.iter().copied().filter(|of| !of.source.is_of_site());
        let count = list.iter().map(|listed| listed.count).sum();
        ListProbabilities {
            at_least_one: self.falls(&list, &own.collect::<Vec<_>>()).map(|n| probability_in_years(n, 1.0)),
            expected_number: Interval { value: sum, ..budget.limit_rate(mean_sum, count) }.into(),
        }
    }

    /// The mean number of motions of which each overturns one or more of the objects that are there: over
    /// each span of years those with an exposure as long. `own` is unknown of the objects.
    fn falls(&self, list: &[ListedObject], own: &[LowHigh<f64>]) -> Interval<Option<f64>> {
        let mut ends: Vec<f64> = list.iter().map(|listed| listed.years).collect();
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        let (mut falls, mut start) = (Interval::exact(0.0), 0.0);
        for end in ends {
            let there: Vec<_> = list.iter().copied().filter(|listed| listed.years >= end).collect();
            let SiteRates { states, budget: mut of_any, .. } = self.rates(&any_of(&there));
            of_any.changes.extend(own);
            let rates = states.overturning.value.zip(states.rocking.value);
            let Some((rate, most)) = rates else { return Interval::default() };
            falls = falls.zip(of_any.limit_rate(rate, most), |sum, rate| sum + (end - start) * rate);
            start = end;
        }
        falls.into()
    }
}

impl GroundMotion {
    /// Limits hold the spread between earthquakes, which moves all objects; those of at least one leave out
    /// what is unknown of each object.
    pub fn list(&self, list: &[ListedObject]) -> ListProbabilities {
        let list = may_overturn(list);
        let sum = |end: fn(Interval<Option<f64>>) -> Option<f64>| {
            list.iter().map(|listed| Some(listed.count * end(listed.overturning)?)).sum()
        };
        if list.is_empty() {
            return ListProbabilities::default();
        }
        ListProbabilities {
            at_least_one: self.probabilities(&any_of(&list)).states.overturning,
            expected_number: Interval { value: sum(|p| p.value), low: sum(|p| p.low), high: sum(|p| p.high) },
        }
    }
}

/// The mean over what is unknown of an object, of its rate over its estimate: each unknown z is standard
/// normal, and changes ln(rate) by z `high` above its median, by -z `low` below.
fn mean_factor(budget: &Budget) -> f64 {
    let of_object = budget.changes.iter().filter(|change| !change.source.is_of_site());
    let mean = |change: &LowHigh<f64>| {
        [change.low, change.high].map(|end| (0.5 * end.powi(2)).exp() * normal::cdf(end)).iter().sum::<f64>()
    };
    of_object.map(mean).product()
}

fn may_overturn<'a>(list: &[ListedObject<'a>]) -> Vec<ListedObject<'a>> {
    let all = list.iter().copied();
    all.filter(|listed| listed.count > 0.0 && listed.overturning.value > Some(0.0)).collect()
}

fn any_of(list: &[ListedObject]) -> RockingObject {
    RockingObject::any_of(list.iter().map(|listed| (listed.object, listed.count)))
}
