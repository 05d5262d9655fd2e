//! Forecasts beside what happened.

use super::column::{Column, Kind, columns};
use super::motion::SUITE;
use super::pex::LIMIT_STATE;
use super::pro::{AUC, BRIER};
use super::response::STRUCTURE;
use super::table::Table;

columns! {
    FITS_SUITE = "fits_suite", Text, "1", "suite of motions that the curves were fitted to";
    FORETOLD = "event", Text, "1", "overturning given rocking (P_ro), exceeding the limit state given safe rocking (P_ex), or failure given rocking, the one or the other (Eq. 12)";
    N_FORETOLD = "n", Int64, "1", "cases with a forecast: those that rock, or rock safely";
    SEEN = "seen", Int64, "1", "cases in which the event happened";
    EXPECTED = "expected", Float64, "1", "the same as foretold: the sum of the probabilities";
    EXPECTED_LOW = "expected_low", Float64, "1", "sum of the lower 95 % limits of the probabilities: the error of the fits";
    EXPECTED_HIGH = "expected_high", Float64, "1", "sum of the upper 95 % limits of the probabilities";
    CHANCE_LOW = "chance_low", Int64, "1", "lower 95 % limit of the count if the probabilities are right and the cases independent (Poisson-binomial)";
    CHANCE_HIGH = "chance_high", Int64, "1", "upper 95 % limit of the count, likewise";
    CHANCE_P = "chance_p", Float64, "1", "probability of a count as far out as the seen one, in either tail, likewise";
    SHARE = "share", Float64, "1", "seen over n";
    SHARE_LOW = "share_low", Float64, "1", "lower 95 % limit of share (Wilson)";
    SHARE_HIGH = "share_high", Float64, "1", "upper 95 % limit of share (Wilson)";
    LOG_SCORE = "log_score", Float64, "1", "mean logarithm of the probability of what happened; null (minus infinity) if there are impossible cases";
    N_IMPOSSIBLE = "impossible", Int64, "1", "cases in which happened what has a probability of exactly 0 in double precision";
    LOG_SCORE_EXPECTED = "log_score_expected", Float64, "1", "what log_score would be in the mean if the probabilities are right";
    CALIBRATION = "calibration", Float64, "1", "calibration in the large: by how much all log odds must rise for the expected count to be the seen one; null where no event, or nothing else, was seen";
    N_EXTRAPOLATED = "extrapolated", Int64, "1", "cases with a measure outside of the range of the data of the fit (of failure, of either)";
    N_WITHOUT_MEASURE = "without_measure", Int64, "1", "cases without a forecast, for want of a measure";
}

/// Curves held against responses that they were not fitted to.
pub const VALIDATION: Table = Table {
    name: "validation",
    stage: "validate",
    columns: &[
        SUITE.or_null(),
        STRUCTURE,
        FITS_SUITE.or_null(),
        FORETOLD,
        LIMIT_STATE,
        N_FORETOLD,
        SEEN,
        EXPECTED,
        EXPECTED_LOW,
        EXPECTED_HIGH,
        CHANCE_LOW,
        CHANCE_HIGH,
        CHANCE_P,
        SHARE,
        SHARE_LOW,
        SHARE_HIGH,
        LOG_SCORE.or_null(),
        LOG_SCORE_EXPECTED,
        BRIER,
        AUC.or_null(),
        CALIBRATION.or_null(),
        N_EXTRAPOLATED,
        N_IMPOSSIBLE,
        N_WITHOUT_MEASURE,
    ],
};
