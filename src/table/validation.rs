//! The validation file: one row an event of one structure under one suite, by the curves of one suite.

use std::path::Path;

use super::row::table;
use super::schema::{self, Column};
use super::store::frame::{names, read_frame};
use super::store::text;
use crate::fragility::Event;
use crate::hazard::CountedRate;
use crate::studies::Validation;

table! {
    /// Curves tested on responses that they were not fitted to.
    pub struct ValidationRow as VALIDATION = "validation" by "validate" {
        suite: Option<String>,
        structure: String,
        fits_suite: Option<String>,
        event: Event = predicted,
        limit_state: f64,
        n: usize = n_predicted,
        seen: usize,
        expected: f64,
        expected_low: f64,
        expected_high: f64,
        chance_low: usize,
        chance_high: usize,
        chance_p: f64,
        share: f64,
        share_low: f64,
        share_high: f64,
        log_score: Option<f64>,
        log_score_expected: f64,
        brier: f64,
        auc: Option<f64>,
        calibration: Option<f64>,
        extrapolated: usize,
        impossible: usize,
        without_measure: usize,
        counted_rate: Option<f64>,
        counted_rate_low: Option<f64>,
        counted_rate_high: Option<f64>,
        expected_rate: Option<f64>,
    }
}

impl ValidationRow {
    /// The forecasts of an event of a structure under a suite, by fits to another suite; `without_measure` cases have none.
    pub fn new(
        suite: Option<&str>,
        structure: &str,
        fits_suite: Option<&str>,
        event: Event,
        limit_state: f64,
        validation: &Validation,
        without_measure: usize,
    ) -> ValidationRow {
        let [chance_low, chance_high] = validation.chance_limits;
        ValidationRow {
            suite: suite.map(str::to_string),
            structure: structure.to_string(),
            fits_suite: fits_suite.map(str::to_string),
            event,
            limit_state,
            n: validation.n,
            seen: validation.seen,
            expected: validation.expected,
            expected_low: validation.expected_limits.low,
            expected_high: validation.expected_limits.high,
            chance_low,
            chance_high,
            chance_p: validation.chance_p,
            share: validation.share,
            share_low: validation.share_limits.low,
            share_high: validation.share_limits.high,
            log_score: validation.log_score,
            log_score_expected: validation.log_score_expected,
            brier: validation.brier,
            auc: validation.auc,
            calibration: validation.calibration,
            extrapolated: validation.extrapolated,
            impossible: validation.impossible,
            without_measure,
            counted_rate: None,
            counted_rate_low: None,
            counted_rate_high: None,
            expected_rate: None,
        }
    }

    /// With the annual rate that was counted, and that of the curves at the same motions.
    pub fn with_rates(self, CountedRate { value, limits }: CountedRate, expected: f64) -> ValidationRow {
        ValidationRow {
            counted_rate: Some(value),
            counted_rate_low: Some(limits.low),
            counted_rate_high: Some(limits.high),
            expected_rate: Some(expected),
            ..self
        }
    }

    /// Whether the curves have a rate within the limits of the counted one, if it was counted.
    pub fn rates_agree(&self) -> Option<bool> {
        Some((self.counted_rate_low?..=self.counted_rate_high?).contains(&self.expected_rate?))
    }
}

/// What a reader looks at first; the file holds the rest.
const SHOWN: [Column; 7] = [
    schema::suite,
    schema::structure,
    schema::fits_suite,
    schema::predicted,
    schema::n_predicted,
    schema::seen,
    schema::expected,
];

/// What follows these where events were counted,
const SHOWN_OF_COUNTS: [Column; 9] = [
    schema::chance_low,
    schema::chance_high,
    schema::chance_p,
    schema::share_low,
    schema::share_high,
    schema::log_score,
    schema::brier,
    schema::calibration,
    schema::extrapolated,
];

/// and where annual rates were.
const SHOWN_OF_RATES: [Column; 4] =
    [schema::counted_rate, schema::counted_rate_low, schema::counted_rate_high, schema::expected_rate];

/// A validation file as a table to read.
///
/// # Errors
/// If it is none.
pub fn show(path: &Path) -> anyhow::Result<String> {
    let frame = read_frame(path, &VALIDATION)?;
    let counted = frame.column(schema::counted_rate.name)?.null_count() < frame.height();
    let more = if counted { &SHOWN_OF_RATES[..] } else { &SHOWN_OF_COUNTS[..] };
    Ok(text::aligned(&frame.select(names(&[&SHOWN, more].concat()))?))
}
