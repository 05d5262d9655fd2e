use crate::fragility::case::{Case, Event};
use crate::fragility::index::Probability;
use crate::fragility::model::{FragilityModel, Probabilities};
use crate::motion::IntensityMeasures;

/// A probability, and whether the event happened.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forecast {
    /// The probability, with limits.
    pub probability: Probability,
    /// Whether it happened.
    pub happened: bool,
    /// Whether a measure lies outside of the range of the data of the fit (of [`Event::Failure`], of either).
    pub is_extrapolated: bool,
}

impl Forecast {
    /// Whether what happened has a probability of exactly 0.
    pub fn is_impossible(&self) -> bool {
        self.probability.value == if self.happened { 0.0 } else { 1.0 }
    }
}

/// What the curves foretell of an event in cases that were not fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct Forecasts {
    /// Of each case in which the event can happen.
    pub forecasts: Vec<Forecast>,
    /// Such cases without a forecast, for want of a measure.
    pub without_measure: usize,
}

impl Forecasts {
    /// Forecasts of an event in those of the cases that count for it.
    pub fn new(model: &FragilityModel, cases: &[Case], event: Event) -> Forecasts {
        let (mut forecasts, mut without_measure) = (Vec::new(), 0);
        for case in cases {
            let Some(happened) = event.happened(case, model.limit) else { continue };
            match probability(event, &model.probabilities(&case.measures)) {
                Some(probability) => forecasts.push(Forecast {
                    probability,
                    happened,
                    is_extrapolated: is_out_of_range(event, model, &case.measures),
                }),
                None => without_measure += 1,
            }
        }
        Forecasts { forecasts, without_measure }
    }
}

fn probability(event: Event, probabilities: &Probabilities) -> Option<Probability> {
    let given = || probabilities.given_rocking;
    match event {
        Event::Rocking => Some(Probability::exact(1.0 - probabilities.p_nr)),
        Event::Overturning => given().map(|given| given.p_ro),
        Event::Exceeding => given().map(|given| given.p_ex),
        Event::Failure => given().map(|given| given.p_failure),
    }
}

fn is_out_of_range(event: Event, model: &FragilityModel, measures: &IntensityMeasures) -> bool {
    let of_demand = || model.demand_out_of_range(measures).next().is_some();
    let of_overturning = || model.overturning_out_of_range(measures).next().is_some();
    match event {
        Event::Rocking => false,
        Event::Overturning => of_overturning(),
        Event::Exceeding => of_demand(),
        Event::Failure => of_overturning() || of_demand(),
    }
}
