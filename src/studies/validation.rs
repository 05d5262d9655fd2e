//! Forecasts of cases that were not fitted, tested on what happened.

use std::sync::Arc;

use crate::fragility::case::Event;
use crate::fragility::cases::{Cases, Placed};
use crate::fragility::model::{FragilityModel, Probabilities};
use crate::fragility::probability::{Probability, Z_95};
use crate::fragility::universal::{UniversalModel, other_structure};
use crate::motion::IntensityMeasures;
use crate::normal;
use crate::rocking::Structure;
use crate::statistics::binary::{Estimator, binary_regression};
use crate::statistics::columns::Columns;
use crate::statistics::design::{Design, Rows, is_constant, range};
use crate::statistics::distribution::PoissonBinomial;
use crate::statistics::estimate::Limits;
use crate::statistics::goodness::{auc_of, brier_score, expected_log_score, log_score};
use crate::statistics::link::Link;
use crate::statistics::separation::is_separated;

/// Forecasts tested on what happened.
#[derive(Debug, Clone, PartialEq)]
pub struct Validation {
    pub n: usize,
    /// Those in which a measure lies outside of the range of the data of the fit.
    pub extrapolated: usize,
    /// Events seen.
    pub seen: usize,
    /// Events expected: the sum of the probabilities.
    pub expected: f64,
    /// The sums of the lower and of the upper 95 % limits: the error of the fits, as if all were too low or too high together.
    pub expected_limits: Limits,
    /// Limits within which a count lies with a probability of 95 % if the probabilities are right and the cases independent.
    pub chance_limits: [usize; 2],
    /// Probability of a count as far out as the seen one, likewise.
    pub chance_p: f64,
    /// Seen events over cases, with 95 % limits.
    pub share: f64,
    /// Its limits (Wilson).
    pub share_limits: Limits,
    /// Those in which happened what has a probability of exactly 0 in double precision.
    pub impossible: usize,
    /// Mean logarithm of the probability of what happened; none, that is minus infinity, if there are impossible cases.
    pub log_score: Option<f64>,
    /// What this would be in the mean if the probabilities are right.
    pub log_score_expected: f64,
    /// Brier score.
    pub brier: f64,
    /// Area under the receiver operating characteristic; none without events or without non-events.
    pub auc: Option<f64>,
    /// Calibration in the large; none without events or without non-events.
    pub calibration: Option<f64>,
}

impl Validation {
    /// Of these forecasts; none without any.
    pub fn of(forecasts: &[Forecast]) -> Option<Validation> {
        let mut all = Forecasts::none();
        all.columns.append(&columns(forecasts));
        all.validation()
    }
}

/// The 95 % limits of a probability of which `seen` of `n` independent cases tell (Wilson 1927, Probable inference, the law of
/// succession, and statistical inference, Journal of the American Statistical Association 22, 209-212).
pub fn wilson_limits(seen: usize, n: usize) -> Limits {
    let (n, share) = (n as f64, seen as f64 / n as f64);
    let (middle, width) = (share + Z_95 * Z_95 / (2.0 * n), 1.0 + Z_95 * Z_95 / n);
    let half = Z_95 * (share * (1.0 - share) / n + (Z_95 / (2.0 * n)).powi(2)).sqrt();
    Limits { low: ((middle - half) / width).max(0.0), high: ((middle + half) / width).min(1.0) }
}

/// Calibration in the large: by how much all log odds must rise for the expected count to be the seen one, 0 where they are right
/// and positive where they are too low. None where no finite shift does it. It is the maximum-likelihood intercept of a logistic
/// recalibration with slope 1 (Cox 1958, Two further applications of a model for binary regression, Biometrika 45, 562-565).
pub fn calibration_in_the_large(probabilities: &[f64], seen: usize) -> Option<f64> {
    shift_to(seen, |odds| expected_at(odds, probabilities))
}

/// How many events are expected where odds are so many times larger: p o / (1 - p + p o) keeps probabilities of 0 and 1 as they
/// are.
fn expected_at(odds: f64, probabilities: &[f64]) -> f64 {
    probabilities.iter().map(|p| p * odds / (1.0 - p + p * odds)).sum()
}

/// The logarithm of the factor of the odds with which as many events are expected as were seen.
fn shift_to(seen: usize, expected_at: impl Fn(f64) -> f64) -> Option<f64> {
    let expected = |shift: f64| expected_at(libm::exp(shift));
    let (seen, [mut low, mut high]) = (seen as f64, SHIFTS);
    if !(expected(low) < seen && seen < expected(high)) {
        return None;
    }
    while high - low > TOLERANCE {
        let middle = 0.5 * (low + high);
        if expected(middle) < seen { low = middle } else { high = middle }
    }
    Some(0.5 * (low + high))
}

/// Calibration slope: by how much the log odds of probabilities Phi(index) must be stretched, besides a shift, to be those of what
/// happened: below 1 where they are too sure (Cox 1958, likewise). None where the events can be told apart without error, or are all
/// the same.
pub fn calibration_slope(indices: &[f64], happened: &[bool]) -> Option<f64> {
    // Of the index, since probabilities themselves may round to 1.
    let log_odds: Vec<f64> = indices.iter().map(|&x| normal::ln_cdf(x) - normal::ln_cdf(-x)).collect();
    let can_be_told = is_constant(range(&log_odds)) || is_separated(&[&log_odds], happened);
    let fit = (!can_be_told).then(|| binary_regression(&[&log_odds], happened, Link::Logit, Estimator::Ml));
    Some(fit?.ok()?.coefficients[1])
}

/// Odds beyond e^±30 are certainties.
const SHIFTS: [f64; 2] = [-30.0, 30.0];
const TOLERANCE: f64 = 1e-12;

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

/// Forecasts of an event in cases that were not fitted.
#[derive(Debug)]
pub struct Forecasts {
    /// Of each case in which the event can happen: the probability, whether it happened, the limits, whether it is extrapolated.
    columns: Columns,
    /// Such cases without a forecast, for want of a measure.
    pub without_measure: usize,
}

fn columns(forecasts: &[Forecast]) -> Vec<Vec<f64>> {
    let columns: [fn(&Forecast) -> f64; 5] = [
        |of| of.probability.value,
        |of| f64::from(u8::from(of.happened)),
        |of| of.probability.low,
        |of| of.probability.high,
        |of| f64::from(u8::from(of.is_extrapolated)),
    ];
    columns.iter().map(|of| forecasts.iter().map(of).collect()).collect()
}

impl Forecasts {
    fn none() -> Forecasts {
        Forecasts { columns: Columns::new(5, &Arc::default()), without_measure: 0 }
    }

    /// Forecasts of an event in those of the cases that count for it.
    pub fn new<C: Cases + ?Sized>(model: &FragilityModel, cases: &C, event: Event) -> Forecasts {
        let of_case = |_: usize, measures: &IntensityMeasures| {
            (model.probabilities(measures), is_out_of_range(event, model, measures))
        };
        Forecasts::of(cases, event, model.limit, of_case)
    }

    /// The same by the surface, each case of the structure that `structure` knows.
    pub fn by_surface<C: Cases + ?Sized>(
        model: &UniversalModel,
        cases: &C,
        event: Event,
        structure: impl Fn(usize) -> Structure + Sync,
    ) -> Forecasts {
        let of_case = |row: usize, measures: &IntensityMeasures| {
            let structure = structure(row);
            let outside =
                model.out_of_range(measures).next().is_some() || other_structure(&structure).next().is_some();
            (model.probabilities(&structure, measures), outside)
        };
        Forecasts::of(cases, event, model.limit, of_case)
    }

    fn of<C: Cases + ?Sized>(
        cases: &C,
        event: Event,
        limit: f64,
        of_case: impl Fn(usize, &IntensityMeasures) -> (Probabilities, bool) + Sync,
    ) -> Forecasts {
        let of_some = |some: &[Placed]| {
            let (mut forecasts, mut without_measure) = (Vec::new(), 0);
            for Placed { row, case, .. } in some {
                let Some(happened) = event.happened(case, limit) else { continue };
                let (probabilities, is_extrapolated) = of_case(*row, &case.measures);
                match probability(event, &probabilities) {
                    Some(probability) => forecasts.push(Forecast { probability, happened, is_extrapolated }),
                    None => without_measure += 1,
                }
            }
            (columns(&forecasts), without_measure)
        };
        let mut all = Forecasts::none();
        cases.each(of_some, |(some, without_measure)| {
            all.columns.append(&some);
            all.without_measure += without_measure;
        });
        all
    }

    /// Tested on what happened; none without any.
    pub fn validation(&self) -> Option<Validation> {
        let (design, n) = (Design::new(&self.columns, 1), self.columns.rows());
        if n == 0 {
            return None;
        }
        let of_block = |rows: &Rows| {
            let probabilities = rows.x[1];
            let sum = |label: usize| rows.labels[label].iter().sum::<f64>();
            let happened: Vec<bool> = rows.y.iter().map(|y| *y != 0.0).collect();
            let cases = rows.count() as f64;
            let impossible = |(p, &happened): (&f64, &bool)| *p == if happened { 0.0 } else { 1.0 };
            let sums = [
                rows.y.iter().sum(),
                probabilities.iter().sum(),
                sum(0),
                sum(1),
                sum(2),
                probabilities.iter().zip(&happened).filter(|case| impossible(*case)).count() as f64,
                cases * log_score(probabilities, &happened),
                cases * expected_log_score(probabilities),
                cases * brier_score(probabilities, &happened),
            ];
            (sums, PoissonBinomial::new(probabilities.iter().copied()))
        };
        let mut counts = Vec::new();
        let mut sums = [0.0; 9];
        design.each(3, of_block, |(some, count)| {
            sums.iter_mut().zip(some).for_each(|(sum, some)| *sum += some);
            PoissonBinomial::stack(&mut counts, count);
        });
        let [seen, expected, low, high, extrapolated, impossible, log_score, log_score_expected, brier] =
            sums;
        let (cases, seen) = (n as f64, seen as usize);
        let count = PoissonBinomial::of_stack(counts);
        let is_mixed = seen > 0 && seen < n;
        let expected_at =
            |odds: f64| design.fold(0, |rows| expected_at(odds, rows.x[1]), |sum, part| *sum += part);
        Some(Validation {
            n,
            extrapolated: extrapolated as usize,
            seen,
            expected,
            expected_limits: Limits { low, high },
            chance_limits: [0.025, 0.975].map(|level| count.quantile(level)),
            chance_p: count.two_sided_p(seen),
            share: seen as f64 / cases,
            share_limits: wilson_limits(seen, n),
            impossible: impossible as usize,
            log_score: Some(log_score / cases).filter(|score| score.is_finite()),
            log_score_expected: log_score_expected / cases,
            brier: brier / cases,
            auc: is_mixed.then(|| auc_of(&design)),
            calibration: shift_to(seen, expected_at),
        })
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
