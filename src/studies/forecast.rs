use crate::fragility::case::Case;
use crate::fragility::index::Probability;
use crate::fragility::model::{FragilityModel, GivenRocking};
use crate::keyword::keywords;
use crate::motion::IntensityMeasures;
use crate::rocking::Outcome;

/// What the curves foretell of a structure that rocks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Foretold {
    /// Overturning given rocking: P_ro.
    Overturning,
    /// A demand above the limit given safe rocking: P_ex.
    Exceeding,
    /// Failure given rocking, the one or the other: P_f|r (Eq. 12).
    Failure,
}

keywords!(Foretold { Overturning = "overturning", Exceeding = "exceeding", Failure = "failure" });

/// A probability, and whether the event happened.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forecast {
    /// The probability, with limits.
    pub probability: Probability,
    /// Whether it happened.
    pub happened: bool,
    /// Whether a measure lies outside of the range of the data of the fit (of [`Foretold::Failure`], of either).
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
    /// Of an event in these cases: those that rock, or of [`Foretold::Exceeding`] those that rock safely.
    pub fn new(model: &FragilityModel, cases: &[Case], event: Foretold) -> Forecasts {
        let (mut forecasts, mut without_measure) = (Vec::new(), 0);
        for case in cases {
            let overturned = case.outcome == Outcome::Overturning;
            let exceeded = case.edp > model.limit;
            let (can_happen, happened) = match event {
                Foretold::Overturning => (true, overturned),
                Foretold::Exceeding => (!overturned, exceeded),
                Foretold::Failure => (true, overturned || exceeded),
            };
            if case.outcome == Outcome::NoRocking || !can_happen {
                continue;
            }
            match model.probabilities(&case.measures).given_rocking {
                Some(given) => forecasts.push(Forecast {
                    probability: event.among(&given),
                    happened,
                    is_extrapolated: event.is_out_of_range(model, &case.measures),
                }),
                None => without_measure += 1,
            }
        }
        Forecasts { forecasts, without_measure }
    }
}

impl Foretold {
    fn is_out_of_range(self, model: &FragilityModel, measures: &IntensityMeasures) -> bool {
        let of_demand = || model.demand_out_of_range(measures).next().is_some();
        let of_overturning = || model.overturning_out_of_range(measures).next().is_some();
        match self {
            Foretold::Overturning => of_overturning(),
            Foretold::Exceeding => of_demand(),
            Foretold::Failure => of_overturning() || of_demand(),
        }
    }

    fn among(self, given: &GivenRocking) -> Probability {
        match self {
            Foretold::Overturning => given.p_ro,
            Foretold::Exceeding => given.p_ex,
            Foretold::Failure => given.p_failure,
        }
    }
}
