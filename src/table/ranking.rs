//! The ranking file of rank-ims, one row a candidate; and the reliability of their forecasts, one row a group of cases.

use super::row::table;
use crate::statistics::FitStatus;
use crate::studies::{Form, HeldOut, OfPaper, Ranked, Rating, Target, wilson_limits};

table! {
    /// Sets of intensity measures, the best first.
    pub struct RankingRow as RANKING = "ranking" by "rank-ims" {
        suite: Option<String>,
        structure: String,
        target: Target,
        measures: String,
        terms: usize,
        form: Form,
        choice: Option<String>,
        rank: Option<usize>,
        same_as: Option<String>,
        log_score: Option<f64> = rank_log_score,
        over_paper: Option<f64>,
        se_over_paper: Option<f64>,
        over_best: Option<f64>,
        se_over_best: Option<f64>,
        step: Option<usize>,
        over_step: Option<f64>,
        se_over_step: Option<f64>,
        event_log_score: Option<f64>,
        auc_unseen: Option<f64>,
        brier_unseen: Option<f64>,
        calibration_intercept: Option<f64>,
        calibration_slope: Option<f64>,
        log_likelihood: Option<f64>,
        aic: Option<f64>,
        bic: Option<f64>,
        auc: Option<f64>,
        brier: Option<f64>,
        beta: Option<f64>,
        zeta: Option<f64>,
        b0: Option<f64> = rank_b0,
        b1: Option<f64> = rank_b1,
        b2: Option<f64> = rank_b2,
        b3: Option<f64> = rank_b3,
        n: usize,
        n_events: usize,
        clustered_by: String,
        status: FitStatus,
    }
}

table! {
    /// Whether events are as frequent as predicted.
    pub struct ReliabilityRow as RANKING_RELIABILITY = "reliability" by "rank-ims" {
        suite: Option<String>,
        structure: String,
        target: Target,
        measures: String,
        form: Form,
        group: usize,
        forecast: f64,
        n: usize,
        seen: usize,
        share: f64,
        share_low: f64,
        share_high: f64,
    }
}

/// A candidate for a target, in the cases of a suite and structure.
#[derive(Debug, Clone, PartialEq)]
pub struct RankedCandidate {
    pub suite: Option<String>,
    pub structure: String,
    pub target: Target,
    /// Cases.
    pub n: usize,
    /// Those in which the event happened.
    pub events: usize,
    /// What the cases of a cluster share.
    pub clustered_by: &'static str,
    pub ranked: Ranked,
}

impl RankedCandidate {
    fn rating(&self) -> Option<&Rating> {
        self.ranked.rating.as_ref().ok()
    }

    fn held_out(&self) -> Option<&HeldOut> {
        self.rating()?.held_out.as_ref()
    }

    fn choice(&self) -> Option<String> {
        let of_paper = self.ranked.of_paper.map(|of_paper| match of_paper {
            OfPaper::Model => "paper".to_string(),
            OfPaper::Scalar => "scalar of paper".to_string(),
        });
        let is_best = self.ranked.rank == Some(1) && self.ranked.same_as.is_none();
        let best = (is_best && !self.ranked.measures.is_empty()).then(|| "best".to_string());
        let step = self.ranked.step.map(|step| format!("step {step}"));
        let choices: Vec<String> = [of_paper, best, step].into_iter().flatten().collect();
        (!choices.is_empty()).then(|| choices.join(", "))
    }

    /// How reliable its forecasts are, in each group of cases.
    pub fn reliability(&self) -> impl Iterator<Item = ReliabilityRow> {
        let groups = self.held_out().map_or(&[][..], |held_out| &held_out.reliability);
        groups.iter().zip(1..).map(|(cases, group)| {
            let limits = wilson_limits(cases.seen, cases.n);
            ReliabilityRow {
                suite: self.suite.clone(),
                structure: self.structure.clone(),
                target: self.target,
                measures: words(&self.ranked.measures),
                form: self.ranked.form,
                group,
                forecast: cases.forecast,
                n: cases.n,
                seen: cases.seen,
                share: cases.seen as f64 / cases.n as f64,
                share_low: limits.low,
                share_high: limits.high,
            }
        })
    }
}

impl From<&RankedCandidate> for RankingRow {
    fn from(candidate: &RankedCandidate) -> RankingRow {
        let (ranked, rating, held_out) = (&candidate.ranked, candidate.rating(), candidate.held_out());
        // Forecasts of a constant differ from fold to fold by what is left out alone, and tell no cases apart.
        let told_apart = held_out.filter(|_| !ranked.measures.is_empty());
        let calibration = told_apart.and_then(|held_out| held_out.calibration);
        let coefficient = |k: usize| rating?.coefficients.get(k).copied();
        RankingRow {
            suite: candidate.suite.clone(),
            structure: candidate.structure.clone(),
            target: candidate.target,
            measures: words(&ranked.measures),
            terms: ranked.measures.len(),
            form: ranked.form,
            choice: candidate.choice(),
            rank: ranked.rank,
            same_as: ranked.same_as.as_deref().map(words),
            log_score: held_out.map(HeldOut::log_score),
            over_paper: ranked.over_paper.map(|gain| gain.value),
            se_over_paper: ranked.over_paper.map(|gain| gain.standard_error),
            over_best: ranked.over_best.map(|gain| gain.value),
            se_over_best: ranked.over_best.map(|gain| gain.standard_error),
            step: ranked.step,
            over_step: ranked.over_step.map(|gain| gain.value),
            se_over_step: ranked.over_step.map(|gain| gain.standard_error),
            event_log_score: held_out.map(|held_out| held_out.event_log_score),
            auc_unseen: told_apart.map(|held_out| held_out.skill.auc),
            brier_unseen: held_out.map(|held_out| held_out.skill.brier),
            calibration_intercept: calibration.map(|[intercept, _]| intercept),
            calibration_slope: calibration.map(|[_, slope]| slope),
            log_likelihood: rating.map(|rating| rating.log_likelihood),
            aic: rating.map(|rating| rating.aic),
            bic: rating.map(|rating| rating.bic),
            auc: rating.map(|rating| rating.fitted.auc),
            brier: rating.map(|rating| rating.fitted.brier),
            beta: rating.map(|rating| rating.beta).filter(|beta| *beta > 0.0),
            zeta: rating.and_then(|rating| rating.zeta),
            b0: coefficient(0),
            b1: coefficient(1),
            b2: coefficient(2),
            b3: coefficient(3),
            n: candidate.n,
            n_events: candidate.events,
            clustered_by: candidate.clustered_by.to_string(),
            status: ranked.rating.as_ref().err().copied().unwrap_or(FitStatus::Ok),
        }
    }
}

/// Measures as options name them: `im4:im3_inv`; of none, `none`.
fn words(measures: &[String]) -> String {
    if measures.is_empty() { "none".to_string() } else { measures.join(":") }
}
