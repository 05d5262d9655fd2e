//! Regressions of the demand in safe rocking.

use super::column::{Column, Kind, columns};
use super::motion::SUITE;
use super::response::{ETA, STRUCTURE};
use super::table::Table;

columns! {
    MODEL = "model", Text, "1", "univariate, plane, biplanar, or smooth (two planes that pass into one another)";
    IM_X = "im_x", Text, "1", "first intensity measure";
    IM_Y = "im_y", Text, "1", "second intensity measure";
    RANGE_LOW = "range_low", Float64, "1", "im_x from which the fit holds";
    RANGE_HIGH = "range_high", Float64, "1", "im_x up to which the fit holds";
    LIMIT_STATE = "limit_state", Float64, "1", "demand |theta|max / alpha that P_ex is about";
    LN_A = "ln_a", Float64, "1", "intercept of ln EDP (Eqs. 15 and 17)";
    B1 = "b1", Float64, "1", "slope on ln im_x";
    B2 = "b2", Float64, "1", "slope on ln im_y";
    R2 = "r2", Float64, "1", "coefficient of determination";
    R2_POOLED = "r2_pooled", Float64, "1", "R2 of both planes together, each about the mean on its own side";
    R2_OVERALL = "r2_overall", Float64, "1", "R2 of both planes together about the mean of all cases";
    TRANSITION_FOUND = "transition_found", Float64, "1", "im4 of the least pooled residual of two planes; of smooth, where both count the same";
    BETA = "beta", Float64, "1", "dispersion: residual standard deviation of ln EDP, or that of the curve P_ro";
    ZETA = "zeta", Float64, "1", "modified dispersion beta / b1";
    N = "n", Int64, "1", "cases used";
    SE_LN_A = "se_ln_a", Float64, "1", "standard error of ln_a";
    SE_B1 = "se_b1", Float64, "1", "standard error of b1";
    SE_B2 = "se_b2", Float64, "1", "standard error of b2";
    LN_A_LOW = "ln_a_low", Float64, "1", "lower limit of ln_a";
    LN_A_HIGH = "ln_a_high", Float64, "1", "upper limit of ln_a";
    B1_LOW = "b1_low", Float64, "1", "lower limit of b1";
    B1_HIGH = "b1_high", Float64, "1", "upper limit of b1";
    B2_LOW = "b2_low", Float64, "1", "lower limit of b2";
    B2_HIGH = "b2_high", Float64, "1", "upper limit of b2";
    COV_LN_A_B1 = "cov_ln_a_b1", Float64, "1", "covariance of ln_a and b1";
    COV_LN_A_B2 = "cov_ln_a_b2", Float64, "1", "covariance of ln_a and b2";
    COV_B1_B2 = "cov_b1_b2", Float64, "1", "covariance of b1 and b2";
    IM_X_LOW = "im_x_low", Float64, "1", "least im_x of the cases";
    IM_X_HIGH = "im_x_high", Float64, "1", "largest im_x of the cases";
    IM_Y_LOW = "im_y_low", Float64, "1", "least im_y of the cases";
    IM_Y_HIGH = "im_y_high", Float64, "1", "largest im_y of the cases";
    SE_LN_A_CLUSTERED = "se_ln_a_clustered", Float64, "1", "standard error of ln_a, robust to dependence within a cell or earthquake";
    SE_B1_CLUSTERED = "se_b1_clustered", Float64, "1", "standard error of b1, robust to dependence within a cell or earthquake";
    SE_B2_CLUSTERED = "se_b2_clustered", Float64, "1", "standard error of b2, robust to dependence within a cell or earthquake";
    CONFIDENCE = "confidence", Float64, "1", "probability with which the limits hold the truth";
    REPLICATES = "replicates", Int64, "1", "bootstrap replicates that have a fit";
    LN_A_PERCENTILE_LOW = "ln_a_percentile_low", Float64, "1", "lower percentile limit of ln_a";
    LN_A_PERCENTILE_HIGH = "ln_a_percentile_high", Float64, "1", "upper percentile limit of ln_a";
    LN_A_BCA_LOW = "ln_a_bca_low", Float64, "1", "lower BCa limit of ln_a";
    LN_A_BCA_HIGH = "ln_a_bca_high", Float64, "1", "upper BCa limit of ln_a";
    B1_PERCENTILE_LOW = "b1_percentile_low", Float64, "1", "lower percentile limit of b1";
    B1_PERCENTILE_HIGH = "b1_percentile_high", Float64, "1", "upper percentile limit of b1";
    B1_BCA_LOW = "b1_bca_low", Float64, "1", "lower BCa limit of b1";
    B1_BCA_HIGH = "b1_bca_high", Float64, "1", "upper BCa limit of b1";
    B2_PERCENTILE_LOW = "b2_percentile_low", Float64, "1", "lower percentile limit of b2";
    B2_PERCENTILE_HIGH = "b2_percentile_high", Float64, "1", "upper percentile limit of b2";
    B2_BCA_LOW = "b2_bca_low", Float64, "1", "lower BCa limit of b2";
    B2_BCA_HIGH = "b2_bca_high", Float64, "1", "upper BCa limit of b2";
    BETA_PERCENTILE_LOW = "beta_percentile_low", Float64, "1", "lower percentile limit of beta";
    BETA_PERCENTILE_HIGH = "beta_percentile_high", Float64, "1", "upper percentile limit of beta";
    BETA_BCA_LOW = "beta_bca_low", Float64, "1", "lower BCa limit of beta";
    BETA_BCA_HIGH = "beta_bca_high", Float64, "1", "upper BCa limit of beta";
    TRANSITION_LOW = "transition_low", Float64, "1", "lower limit of transition_found: Hansen's of a break, linearised of a smooth one";
    TRANSITION_HIGH = "transition_high", Float64, "1", "upper limit of transition_found, likewise";
    TRANSITION_WIDTH = "transition_width", Float64, "1", "width d of a smooth transition: the share of the upper plane is 1 - im4^(-1/d)";
    SE_TRANSITION_WIDTH = "se_transition_width", Float64, "1", "standard error of transition_width";
    RESET = "reset", Float64, "1", "Ramsey's F: whether squares and cubes of the fitted values are missing";
    RESET_P = "reset_p", Float64, "1", "probability of as large a reset if the regression holds";
    TRANSITION_PERCENTILE_LOW = "transition_percentile_low", Float64, "1", "lower percentile limit of transition_found";
    TRANSITION_PERCENTILE_HIGH = "transition_percentile_high", Float64, "1", "upper percentile limit of transition_found";
    REPLICATE = "replicate", Int64, "1", "resample: the same in all fits of the same responses and seed";
    STATUS = "status", Text, "1", "ok, falling (with the measure), or why there is no fit";

    TRANSITION = "transition", Float64, "1", "im4 at which the two planes meet";
    POOLED_RSS = "pooled_rss", Float64, "1", "residual sum of squares of both planes";
    N_LOW = "n_low", Int64, "1", "cases below the transition";
    N_HIGH = "n_high", Int64, "1", "cases above the transition";
}

/// Regressions of the demand in safe rocking.
pub const PEX: Table = Table {
    name: "pex",
    stage: "fit-pex",
    columns: &[
        SUITE.or_null(),
        STRUCTURE,
        MODEL,
        IM_X,
        IM_Y.or_null(),
        RANGE_LOW.or_null(),
        RANGE_HIGH.or_null(),
        LIMIT_STATE,
        LN_A.or_null(),
        B1.or_null(),
        B2.or_null(),
        R2.or_null(),
        R2_POOLED.or_null(),
        R2_OVERALL.or_null(),
        TRANSITION_FOUND.or_null(),
        BETA.or_null(),
        ZETA.or_null(),
        N,
        SE_LN_A.or_null(),
        SE_B1.or_null(),
        SE_B2.or_null(),
        LN_A_LOW.or_null(),
        LN_A_HIGH.or_null(),
        B1_LOW.or_null(),
        B1_HIGH.or_null(),
        B2_LOW.or_null(),
        B2_HIGH.or_null(),
        COV_LN_A_B1.or_null(),
        COV_LN_A_B2.or_null(),
        COV_B1_B2.or_null(),
        SE_LN_A_CLUSTERED.or_null(),
        SE_B1_CLUSTERED.or_null(),
        SE_B2_CLUSTERED.or_null(),
        CONFIDENCE,
        REPLICATES,
        LN_A_PERCENTILE_LOW.or_null(),
        LN_A_PERCENTILE_HIGH.or_null(),
        LN_A_BCA_LOW.or_null(),
        LN_A_BCA_HIGH.or_null(),
        B1_PERCENTILE_LOW.or_null(),
        B1_PERCENTILE_HIGH.or_null(),
        B1_BCA_LOW.or_null(),
        B1_BCA_HIGH.or_null(),
        B2_PERCENTILE_LOW.or_null(),
        B2_PERCENTILE_HIGH.or_null(),
        B2_BCA_LOW.or_null(),
        B2_BCA_HIGH.or_null(),
        BETA_PERCENTILE_LOW.or_null(),
        BETA_PERCENTILE_HIGH.or_null(),
        BETA_BCA_LOW.or_null(),
        BETA_BCA_HIGH.or_null(),
        TRANSITION_LOW.or_null(),
        TRANSITION_HIGH.or_null(),
        TRANSITION_PERCENTILE_LOW.or_null(),
        TRANSITION_PERCENTILE_HIGH.or_null(),
        TRANSITION_WIDTH.or_null(),
        SE_TRANSITION_WIDTH.or_null(),
        RESET.or_null(),
        RESET_P.or_null(),
        IM_X_LOW.or_null(),
        IM_X_HIGH.or_null(),
        IM_Y_LOW.or_null(),
        IM_Y_HIGH.or_null(),
        ETA.or_null(),
        STATUS,
    ],
};

/// The regressions of resampled cases.
pub const PEX_BOOTSTRAP: Table = Table {
    name: "bootstrap replicates of pex",
    stage: "fit-pex",
    columns: &[
        SUITE.or_null(),
        STRUCTURE,
        MODEL,
        IM_X,
        IM_Y.or_null(),
        REPLICATE,
        RANGE_LOW.or_null(),
        RANGE_HIGH.or_null(),
        LN_A.or_null(),
        B1.or_null(),
        B2.or_null(),
        BETA.or_null(),
    ],
};

/// The search for the transition between the two planes.
pub const PEX_SCAN: Table = Table {
    name: "transition scan",
    stage: "fit-pex",
    columns: &[SUITE.or_null(), STRUCTURE, TRANSITION, POOLED_RSS, N_LOW, N_HIGH],
};
