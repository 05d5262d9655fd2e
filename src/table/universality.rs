//! The files of universality: one row an event of one structure, and one a coefficient of a pooled curve.

use super::row::table;
use crate::fragility::Event;
use crate::rocking::Structure;
use crate::statistics::FitStatus;
use crate::studies::{PooledTerms, Transfer, Verdict};

table! {
    /// The curve of one structure tested on the responses of others.
    pub struct UniversalityRow as UNIVERSALITY = "universality" by "universality" {
        suite: Option<String>,
        structure: String,
        p_rad_s: f64,
        alpha_rad: f64,
        eta: f64,
        reference: String,
        event: Event = predicted,
        limit_state: f64,
        n: usize = n_predicted,
        seen: usize,
        expected: f64,
        chance_low: usize,
        chance_high: usize,
        chance_p: f64,
        calibration: Option<f64>,
        calibration_slope: Option<f64> = transferred_slope,
        log_score_own: Option<f64>,
        log_score_transferred: Option<f64>,
        loss: Option<f64>,
        se_loss: Option<f64>,
        log_score_share: f64,
        share_lost: Option<f64>,
        mean_error: Option<f64>,
        worst_over: Option<f64>,
        worst_under: Option<f64>,
        log_score_line: Option<f64>,
        log_score_curved: Option<f64>,
        log_score_restitution: Option<f64>,
        log_score_structure: Option<f64>,
        extrapolated: usize,
        status: FitStatus,
        verdict: Verdict,
    }
}

table! {
    /// One curve for all structures.
    pub struct PooledRow as POOLED = "pooled curves" by "universality" {
        suite: Option<String>,
        event: Event = predicted,
        terms: PooledTerms = pooled_terms,
        range_low: Option<f64>,
        range_high: Option<f64>,
        term: String,
        coefficient: f64,
        standard_error: f64,
        beta: Option<f64>,
        n: usize,
    }
}

impl UniversalityRow {
    /// The curve of `reference` on a structure; `pooled` are the log scores by the curve of all other structures, of each of
    /// [`PooledTerms`].
    pub fn new(
        suite: Option<&str>,
        structure: &Structure,
        reference: &str,
        event: Event,
        limit_state: f64,
        transfer: &Transfer,
        pooled: [Option<f64>; 4],
    ) -> UniversalityRow {
        let (validation, own) = (&transfer.validation, transfer.own.as_ref().ok());
        let [chance_low, chance_high] = validation.chance_limits;
        let [log_score_line, log_score_curved, log_score_restitution, log_score_structure] = pooled;
        UniversalityRow {
            suite: suite.map(str::to_string),
            structure: structure.name.clone(),
            p_rad_s: structure.p_rad_s,
            alpha_rad: structure.alpha_rad,
            eta: structure.eta,
            reference: reference.to_string(),
            event,
            limit_state,
            n: validation.n,
            seen: validation.seen,
            expected: validation.expected,
            chance_low,
            chance_high,
            chance_p: validation.chance_p,
            calibration: validation.calibration,
            calibration_slope: transfer.slope,
            log_score_own: own.map(|own| own.log_score),
            log_score_transferred: own.map(|own| own.transferred),
            loss: own.map(|own| own.loss.value),
            se_loss: own.map(|own| own.loss.standard_error),
            log_score_share: transfer.share_log_score,
            share_lost: transfer.share_lost(),
            mean_error: own.map(|own| own.mean_error),
            worst_over: own.map(|own| own.worst_over),
            worst_under: own.map(|own| own.worst_under),
            log_score_line,
            log_score_curved,
            log_score_restitution,
            log_score_structure,
            extrapolated: validation.extrapolated,
            status: transfer.own.as_ref().err().copied().unwrap_or(FitStatus::Ok),
            verdict: transfer.verdict(),
        }
    }
}
