//! Intensity measures by how well they predict.

use super::column::{Column, Kind, columns};
use super::motion::SUITE;
use super::pex::{BETA, N, STATUS, ZETA};
use super::pro::{AIC, AUC, BIC, BRIER, LOG_LIKELIHOOD, N_EVENTS};
use super::response::STRUCTURE;
use super::table::Table;
use super::validation::{SEEN, SHARE, SHARE_HIGH, SHARE_LOW};

columns! {
    TARGET = "target", Text, "1", "what is predicted: p_ex (ln EDP in safe rocking), or p_ro (overturning given rocking)";
    MEASURES = "measures", Text, "1", "intensity measures, joined by ':'; each enters to a power of its own; none: a constant";
    TERMS = "terms", Int64, "1", "how many measures";
    FORM = "form", Text, "1", "single: one power law; broken: one on each side of a break in im4";
    CHOICE = "choice", Text, "1", "why to look at it: paper (the model of the paper), scalar of paper (the best of its six alone), best (of as many measures), step N (of forward selection)";
    RANK = "rank", Int64, "1", "place among the models of as many measures by log_score, from 1";
    SAME_AS = "same_as", Text, "1", "measures before it that make the same model: products of powers of one another";
    RANK_LOG_SCORE = "log_score", Float64, "1", "mean ln probability (of p_ex: density of ln EDP) of what happened in clusters left out of the fit; null where a fit without some of them does not exist";
    OVER_PAPER = "over_paper", Float64, "1", "log_score over that of the model of the paper";
    SE_OVER_PAPER = "se_over_paper", Float64, "1", "standard error of over_paper, paired over clusters";
    OVER_BEST = "over_best", Float64, "1", "log_score over that of the best of as many measures, not above 0";
    SE_OVER_BEST = "se_over_best", Float64, "1", "standard error of over_best, paired over clusters";
    STEP = "step", Int64, "1", "step of forward selection that arrives here; 0: no measure";
    OVER_STEP = "over_step", Float64, "1", "log_score over that of the step before";
    SE_OVER_STEP = "se_over_step", Float64, "1", "standard error of over_step, paired over clusters";
    EVENT_LOG_SCORE = "event_log_score", Float64, "1", "mean ln probability of whether the event (overturning, or a demand above the limit state) happened, in clusters left out of the fit";
    AUC_UNSEEN = "auc_unseen", Float64, "1", "area under the receiver operating characteristic of the event, in clusters left out of the fit; null without a measure";
    BRIER_UNSEEN = "brier_unseen", Float64, "1", "Brier score of the event, in clusters left out of the fit";
    CALIBRATION_INTERCEPT = "calibration_intercept", Float64, "1", "intercept of the events regressed by a probit on the index foretold for clusters left out; 0 is best";
    CALIBRATION_SLOPE = "calibration_slope", Float64, "1", "slope of it; 1 is best, less: the forecasts are too sure";
    RANK_B0 = "b0", Float64, "1", "intercept (of the probit index, or of ln EDP); null for a broken form";
    RANK_B1 = "b1", Float64, "1", "power of the first measure; null for a broken form";
    RANK_B2 = "b2", Float64, "1", "power of the second measure";
    RANK_B3 = "b3", Float64, "1", "power of the third measure";
    CLUSTERED_BY = "clustered_by", Text, "1", "what the cases of a cluster share: cell (magnitude and distance), earthquake or nothing";

    GROUP = "group", Int64, "1", "tenth of the cases, from the least probability";
    GROUP_FORECAST = "forecast", Float64, "1", "mean probability of the event foretold for clusters left out of the fit";
}

/// Sets of intensity measures, the best first.
pub const RANKING: Table = Table {
    name: "ranking",
    stage: "rank-ims",
    columns: &[
        SUITE.or_null(),
        STRUCTURE,
        TARGET,
        MEASURES,
        TERMS,
        FORM,
        CHOICE.or_null(),
        RANK.or_null(),
        SAME_AS.or_null(),
        RANK_LOG_SCORE.or_null(),
        OVER_PAPER.or_null(),
        SE_OVER_PAPER.or_null(),
        OVER_BEST.or_null(),
        SE_OVER_BEST.or_null(),
        STEP.or_null(),
        OVER_STEP.or_null(),
        SE_OVER_STEP.or_null(),
        EVENT_LOG_SCORE.or_null(),
        AUC_UNSEEN.or_null(),
        BRIER_UNSEEN.or_null(),
        CALIBRATION_INTERCEPT.or_null(),
        CALIBRATION_SLOPE.or_null(),
        LOG_LIKELIHOOD.or_null(),
        AIC.or_null(),
        BIC.or_null(),
        AUC.or_null(),
        BRIER.or_null(),
        BETA.or_null(),
        ZETA.or_null(),
        RANK_B0.or_null(),
        RANK_B1.or_null(),
        RANK_B2.or_null(),
        RANK_B3.or_null(),
        N,
        N_EVENTS,
        CLUSTERED_BY,
        STATUS,
    ],
};

/// Whether events are as frequent as foretold.
pub const RANKING_RELIABILITY: Table = Table {
    name: "reliability",
    stage: "rank-ims",
    columns: &[
        SUITE.or_null(),
        STRUCTURE,
        TARGET,
        MEASURES,
        FORM,
        GROUP,
        GROUP_FORECAST,
        N,
        SEEN,
        SHARE,
        SHARE_LOW,
        SHARE_HIGH,
    ],
};
