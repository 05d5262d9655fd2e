//! The curve of one structure on others, and curves of all.

use super::column::{Column, Kind, columns};
use super::motion::SUITE;
use super::pex::{BETA, LIMIT_STATE, N, RANGE_HIGH, RANGE_LOW, STATUS};
use super::response::{ALPHA_RAD, ETA, P_RAD_S, STRUCTURE};
use super::table::Table;
use super::validation::{
    CALIBRATION, CHANCE_HIGH, CHANCE_LOW, CHANCE_P, EXPECTED, FORETOLD, N_EXTRAPOLATED, N_FORETOLD, SEEN,
};

columns! {
    REFERENCE = "reference", Text, "1", "structure whose curve is transferred";
    TRANSFERRED_SLOPE = "calibration_slope", Float64, "1", "slope of the recalibration in log odds: below 1 where the transferred curve is too sure";
    LOG_SCORE_OWN = "log_score_own", Float64, "1", "mean logarithm of the probability of what happened by the structure's own curve, in cells that it was not fitted to";
    LOG_SCORE_TRANSFERRED = "log_score_transferred", Float64, "1", "the same by the transferred curve, fitted without those cells";
    LOSS = "loss", Float64, "1", "log_score_own less log_score_transferred";
    SE_LOSS = "se_loss", Float64, "1", "standard error of loss; cases of a cell may depend on each other";
    LOG_SCORE_SHARE = "log_score_share", Float64, "1", "log score of the share of events, the same in all cases";
    SHARE_LOST = "share_lost", Float64, "1", "loss over log_score_own less log_score_share: how much of what the own curve tells is lost";
    MEAN_ERROR = "mean_error", Float64, "1", "mean absolute difference of the transferred and the own probability over the cases";
    WORST_OVER = "worst_over", Float64, "1", "the most by which the transferred probability exceeds the own one, over the cases";
    WORST_UNDER = "worst_under", Float64, "1", "the most by which it falls short";
    LOG_SCORE_LINE = "log_score_line", Float64, "1", "log score by one curve of other structures: lognormal";
    LOG_SCORE_CURVED = "log_score_curved", Float64, "1", "the same with squares and products of the logarithms of the measures";
    LOG_SCORE_RESTITUTION = "log_score_restitution", Float64, "1", "the same with eta besides";
    LOG_SCORE_STRUCTURE = "log_score_structure", Float64, "1", "the same with ln p and ln alpha besides";
    VERDICT = "verdict", Text, "1", "the transferred curve holds (share_lost below 0.1), bends (below 0.5) or fails; too_few_events for an own curve";

    POOLED_TERMS = "terms", Text, "1", "line, curved, restitution or structure: what the pooled curve consists of";
    TERM = "term", Text, "1", "what the coefficient multiplies; eta, ln p and ln alpha as differences from the reference";
    COEFFICIENT = "coefficient", Float64, "1", "of the probit index of overturning, or of ln EDP in safe rocking";
    STANDARD_ERROR = "standard_error", Float64, "1", "standard error of coefficient; cases of a structure may depend on each other";
}

/// The curve of one structure held against the responses of others.
pub const UNIVERSALITY: Table = Table {
    name: "universality",
    stage: "universality",
    columns: &[
        SUITE.or_null(),
        STRUCTURE,
        P_RAD_S,
        ALPHA_RAD,
        ETA,
        REFERENCE,
        FORETOLD,
        LIMIT_STATE,
        N_FORETOLD,
        SEEN,
        EXPECTED,
        CHANCE_LOW,
        CHANCE_HIGH,
        CHANCE_P,
        CALIBRATION.or_null(),
        TRANSFERRED_SLOPE.or_null(),
        LOG_SCORE_OWN.or_null(),
        LOG_SCORE_TRANSFERRED.or_null(),
        LOSS.or_null(),
        SE_LOSS.or_null(),
        LOG_SCORE_SHARE,
        SHARE_LOST.or_null(),
        MEAN_ERROR.or_null(),
        WORST_OVER.or_null(),
        WORST_UNDER.or_null(),
        LOG_SCORE_LINE.or_null(),
        LOG_SCORE_CURVED.or_null(),
        LOG_SCORE_RESTITUTION.or_null(),
        LOG_SCORE_STRUCTURE.or_null(),
        N_EXTRAPOLATED,
        STATUS,
        VERDICT,
    ],
};

/// One curve for all structures.
pub const POOLED: Table = Table {
    name: "pooled curves",
    stage: "universality",
    columns: &[
        SUITE.or_null(),
        FORETOLD,
        POOLED_TERMS,
        RANGE_LOW.or_null(),
        RANGE_HIGH.or_null(),
        TERM,
        COEFFICIENT,
        STANDARD_ERROR,
        BETA.or_null(),
        N,
    ],
};
