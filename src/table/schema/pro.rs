//! Maximum-likelihood fits of overturning.

use super::column::{Column, Kind, columns};
use super::motion::SUITE;
use super::pex::{
    BETA, BETA_BCA_HIGH, BETA_BCA_LOW, BETA_PERCENTILE_HIGH, BETA_PERCENTILE_LOW, CONFIDENCE, COV_B1_B2,
    IM_X, IM_X_HIGH, IM_X_LOW, IM_Y, IM_Y_HIGH, IM_Y_LOW, N, REPLICATE, REPLICATES, SE_B1, SE_B2, STATUS,
};
use super::response::{ETA, STRUCTURE};
use super::table::Table;

columns! {
    FITTED_EVENT = "event", Text, "1", "overturning, or rocking";
    LAMBDA = "lambda", Float64, "1", "exponent of im_x in the hybrid measure (Eq. 22)";
    MU = "mu", Float64, "1", "logarithm of the median of the measure at overturning (its mean, for the probit)";
    THETA = "theta", Float64, "1", "median exp(mu)";
    LOG_LIKELIHOOD = "log_likelihood", Float64, "1", "log-likelihood at its maximum";
    AIC = "aic", Float64, "1", "Akaike's information criterion";
    BIC = "bic", Float64, "1", "Bayesian information criterion";
    AUC = "auc", Float64, "1", "area under the receiver operating characteristic";
    BRIER = "brier", Float64, "1", "Brier score";
    N_EVENTS = "n_events", Int64, "1", "cases in which the event happened";
    SE_LAMBDA = "se_lambda", Float64, "1", "standard error of lambda";
    SE_MU = "se_mu", Float64, "1", "standard error of mu";
    SE_BETA = "se_beta", Float64, "1", "standard error of beta";
    SE_THETA = "se_theta", Float64, "1", "standard error of theta";
    LAMBDA_LOW = "lambda_low", Float64, "1", "lower limit of lambda";
    LAMBDA_HIGH = "lambda_high", Float64, "1", "upper limit of lambda";
    MU_LOW = "mu_low", Float64, "1", "lower limit of mu";
    MU_HIGH = "mu_high", Float64, "1", "upper limit of mu";
    BETA_LOW = "beta_low", Float64, "1", "lower limit of beta";
    BETA_HIGH = "beta_high", Float64, "1", "upper limit of beta";
    THETA_LOW = "theta_low", Float64, "1", "lower limit of theta";
    THETA_HIGH = "theta_high", Float64, "1", "upper limit of theta";
    ESTIMATOR = "estimator", Text, "1", "ml (maximum likelihood), or firth (penalised)";
    SE_LAMBDA_CLUSTERED = "se_lambda_clustered", Float64, "1", "standard error of lambda, robust to dependence within a cell or earthquake";
    SE_MU_CLUSTERED = "se_mu_clustered", Float64, "1", "standard error of mu, robust to dependence within a cell or earthquake";
    SE_BETA_CLUSTERED = "se_beta_clustered", Float64, "1", "standard error of beta, robust to dependence within a cell or earthquake";
    LAMBDA_PROFILE_LOW = "lambda_profile_low", Float64, "1", "lower profile-likelihood limit of lambda; null: none";
    LAMBDA_PROFILE_HIGH = "lambda_profile_high", Float64, "1", "upper profile-likelihood limit of lambda; null: none";
    MU_PROFILE_LOW = "mu_profile_low", Float64, "1", "lower profile-likelihood limit of mu; null: none";
    MU_PROFILE_HIGH = "mu_profile_high", Float64, "1", "upper profile-likelihood limit of mu; null: none";
    BETA_PROFILE_LOW = "beta_profile_low", Float64, "1", "lower profile-likelihood limit of beta; null: none";
    BETA_PROFILE_HIGH = "beta_profile_high", Float64, "1", "upper profile-likelihood limit of beta; null: none";
    HOSMER_LEMESHOW = "hosmer_lemeshow", Float64, "1", "Hosmer-Lemeshow chi squared of ten groups";
    HOSMER_LEMESHOW_P = "hosmer_lemeshow_p", Float64, "1", "probability of as large a hosmer_lemeshow if the curve holds";
    SPLINE_P = "spline_p", Float64, "1", "likelihood-ratio test against a natural spline of ln im_x: probability if none is needed";
    INTERACTION_P = "interaction_p", Float64, "1", "likelihood-ratio test against a term ln im_x ln im_y (or ln im_x squared)";
    LINK = "link", Text, "1", "probit, logit or cloglog: the probability is F(b0 + b1 ln im_x + b2 ln im_y)";
    B0 = "b0", Float64, "1", "intercept of the index";
    INDEX_B1 = "b1", Float64, "1", "slope of the index on ln im_x";
    INDEX_B2 = "b2", Float64, "1", "slope of the index on ln im_y";
    SE_B0 = "se_b0", Float64, "1", "standard error of b0";
    COV_B0_B1 = "cov_b0_b1", Float64, "1", "covariance of b0 and b1";
    COV_B0_B2 = "cov_b0_b2", Float64, "1", "covariance of b0 and b2";
    LAMBDA_PERCENTILE_LOW = "lambda_percentile_low", Float64, "1", "lower percentile limit of lambda";
    LAMBDA_PERCENTILE_HIGH = "lambda_percentile_high", Float64, "1", "upper percentile limit of lambda";
    LAMBDA_BCA_LOW = "lambda_bca_low", Float64, "1", "lower BCa limit of lambda";
    LAMBDA_BCA_HIGH = "lambda_bca_high", Float64, "1", "upper BCa limit of lambda";
    MU_PERCENTILE_LOW = "mu_percentile_low", Float64, "1", "lower percentile limit of mu (and, as its logarithm, of theta)";
    MU_PERCENTILE_HIGH = "mu_percentile_high", Float64, "1", "upper percentile limit of mu (and, as its logarithm, of theta)";
    MU_BCA_LOW = "mu_bca_low", Float64, "1", "lower BCa limit of mu (and, as its logarithm, of theta)";
    MU_BCA_HIGH = "mu_bca_high", Float64, "1", "upper BCa limit of mu (and, as its logarithm, of theta)";
}

/// Maximum-likelihood fits of overturning.
pub const PRO: Table = Table {
    name: "pro",
    stage: "fit-pro",
    columns: &[
        SUITE.or_null(),
        STRUCTURE,
        FITTED_EVENT,
        IM_X,
        IM_Y.or_null(),
        LAMBDA.or_null(),
        MU.or_null(),
        BETA.or_null(),
        THETA.or_null(),
        LOG_LIKELIHOOD.or_null(),
        AIC.or_null(),
        BIC.or_null(),
        AUC.or_null(),
        BRIER.or_null(),
        N,
        N_EVENTS,
        SE_LAMBDA.or_null(),
        SE_MU.or_null(),
        SE_BETA.or_null(),
        SE_THETA.or_null(),
        LAMBDA_LOW.or_null(),
        LAMBDA_HIGH.or_null(),
        MU_LOW.or_null(),
        MU_HIGH.or_null(),
        BETA_LOW.or_null(),
        BETA_HIGH.or_null(),
        THETA_LOW.or_null(),
        THETA_HIGH.or_null(),
        LINK,
        ESTIMATOR,
        B0.or_null(),
        INDEX_B1.or_null(),
        INDEX_B2.or_null(),
        SE_B0.or_null(),
        SE_B1.or_null(),
        SE_B2.or_null(),
        COV_B0_B1.or_null(),
        COV_B0_B2.or_null(),
        COV_B1_B2.or_null(),
        SE_LAMBDA_CLUSTERED.or_null(),
        SE_MU_CLUSTERED.or_null(),
        SE_BETA_CLUSTERED.or_null(),
        LAMBDA_PROFILE_LOW.or_null(),
        LAMBDA_PROFILE_HIGH.or_null(),
        MU_PROFILE_LOW.or_null(),
        MU_PROFILE_HIGH.or_null(),
        BETA_PROFILE_LOW.or_null(),
        BETA_PROFILE_HIGH.or_null(),
        CONFIDENCE,
        REPLICATES,
        LAMBDA_PERCENTILE_LOW.or_null(),
        LAMBDA_PERCENTILE_HIGH.or_null(),
        LAMBDA_BCA_LOW.or_null(),
        LAMBDA_BCA_HIGH.or_null(),
        MU_PERCENTILE_LOW.or_null(),
        MU_PERCENTILE_HIGH.or_null(),
        MU_BCA_LOW.or_null(),
        MU_BCA_HIGH.or_null(),
        BETA_PERCENTILE_LOW.or_null(),
        BETA_PERCENTILE_HIGH.or_null(),
        BETA_BCA_LOW.or_null(),
        BETA_BCA_HIGH.or_null(),
        HOSMER_LEMESHOW.or_null(),
        HOSMER_LEMESHOW_P.or_null(),
        SPLINE_P.or_null(),
        INTERACTION_P.or_null(),
        IM_X_LOW.or_null(),
        IM_X_HIGH.or_null(),
        IM_Y_LOW.or_null(),
        IM_Y_HIGH.or_null(),
        ETA.or_null(),
        STATUS,
    ],
};

/// The curves of resampled cases.
pub const PRO_BOOTSTRAP: Table = Table {
    name: "bootstrap replicates of pro",
    stage: "fit-pro",
    columns: &[
        SUITE.or_null(),
        STRUCTURE,
        FITTED_EVENT,
        IM_X,
        IM_Y.or_null(),
        REPLICATE,
        B0.or_null(),
        INDEX_B1.or_null(),
        INDEX_B2.or_null(),
    ],
};
