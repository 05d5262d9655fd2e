//! Every column of every file, once.

use std::collections::HashMap;
use std::sync::Arc;

use arrow_schema::{DataType, Field, Schema, SchemaRef};

/// The type of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// 64-bit integers.
    Int64,
    /// 32-bit integers.
    Int32,
    /// 64-bit floating-point numbers.
    Float64,
    /// UTF-8 text.
    Text,
    /// A list of 32-bit floating-point samples in each row.
    Samples,
}

impl Kind {
    /// The Arrow type that is written.
    pub fn data_type(self) -> DataType {
        match self {
            Kind::Int64 => DataType::Int64,
            Kind::Int32 => DataType::Int32,
            Kind::Float64 => DataType::Float64,
            Kind::Text => DataType::Utf8,
            Kind::Samples => DataType::List(Arc::new(Field::new("item", DataType::Float32, false))),
        }
    }

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Kind::Int64 => "64-bit integers",
            Kind::Int32 => "32-bit integers",
            Kind::Float64 => "64-bit floating-point numbers",
            Kind::Text => "text",
            Kind::Samples => "lists of floating-point numbers",
        }
    }
}

/// A column: what it is called, what it holds, in which unit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Column {
    /// Lower snake case with the unit as suffix.
    pub name: &'static str,
    /// Its type.
    pub kind: Kind,
    /// Whether values may be null.
    pub nullable: bool,
    /// Its unit; "1" where it has none.
    pub unit: &'static str,
    /// What it means.
    pub description: &'static str,
}

impl Column {
    const fn new(name: &'static str, kind: Kind, unit: &'static str, description: &'static str) -> Column {
        Column { name, kind, nullable: false, unit, description }
    }

    /// The same column where values may be missing.
    pub const fn or_null(self) -> Column {
        Column { nullable: true, ..self }
    }

    /// Type and meaning, for a message to the user.
    pub fn words(&self) -> String {
        let unit = if self.unit == "1" { String::new() } else { format!(" in {}", self.unit) };
        format!("{}{unit} ({})", self.kind.words(), self.description)
    }

    fn field(&self) -> Field {
        let metadata = [("unit", self.unit), ("description", self.description)]
            .map(|(key, value)| (key.to_string(), value.to_string()));
        Field::new(self.name, self.kind.data_type(), self.nullable).with_metadata(HashMap::from(metadata))
    }
}

/// A kind of file: the columns it has and the stage that makes it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Table {
    /// What its rows are called.
    pub name: &'static str,
    /// The subcommand that writes it.
    pub stage: &'static str,
    /// Its columns in order.
    pub columns: &'static [Column],
}

impl Table {
    /// The Arrow schema, units and descriptions in the field metadata.
    pub fn schema(&self) -> SchemaRef {
        self.schema_with_spectrum(&[])
    }

    /// The same with a column of spectral accelerations at each of these periods (s) at its end.
    pub fn schema_with_spectrum(&self, periods_s: &[f64]) -> SchemaRef {
        let spectrum = periods_s.iter().map(|&period_s| spectral_acceleration_field(period_s));
        Arc::new(Schema::new(self.columns.iter().map(Column::field).chain(spectrum).collect::<Vec<_>>()))
    }
}

/// The name of the column of spectral accelerations at a period: `sa_0p20_m_s2` at 0.2 s.
pub fn spectral_acceleration_name(period_s: f64) -> String {
    let text = format!("{period_s:.4}");
    let short = text.strip_suffix("00").or(text.strip_suffix('0')).unwrap_or(&text);
    format!("sa_{}_m_s2", short.replace('.', "p"))
}

fn spectral_acceleration_field(period_s: f64) -> Field {
    let description = format!("pseudo-spectral acceleration at {period_s} s and 5 % damping");
    let metadata = [("unit", "m/s2".to_string()), ("description", description)];
    let metadata = metadata.map(|(key, value)| (key.to_string(), value));
    Field::new(spectral_acceleration_name(period_s), DataType::Float64, false)
        .with_metadata(HashMap::from(metadata))
}

macro_rules! columns {
    ($($constant:ident = $name:literal, $kind:ident, $unit:literal, $description:literal;)*) => {
        $(
            #[doc = $description]
            pub const $constant: Column = Column::new($name, Kind::$kind, $unit, $description);
        )*
    };
}

columns! {
    SCENARIO_ID = "scenario_id", Int64, "1", "scenario: cell x samples + sample";
    CELL = "cell", Int32, "1", "cell of the magnitude-distance grid";
    SAMPLE = "sample", Int32, "1", "sample within the cell";
    MW = "mw", Float64, "1", "moment magnitude";
    RE_KM = "re_km", Float64, "km", "distance from the rupture";
    VP_M_S = "vp_m_s", Float64, "m/s", "amplitude of the velocity pulse";
    PULSE_TP_S = "tp_s", Float64, "s", "period of the velocity pulse";
    GAMMA = "gamma", Float64, "1", "number of half cycles of the pulse";
    NU_RAD = "nu_rad", Float64, "rad", "phase of the pulse";

    MOTION_ID = "motion_id", Int64, "1", "ground motion, unique in the file";
    SUITE = "suite", Text, "1", "kind of motion: pulse, csgm, hfc, record or residual";
    DT_S = "dt_s", Float64, "s", "time between samples";
    ACCELERATION_M_S2 = "acceleration_m_s2", Samples, "m/s2", "ground acceleration, linear between samples";
    PGA_M_S2 = "pga_m_s2", Float64, "m/s2", "peak ground acceleration";
    PGV_M_S = "pgv_m_s", Float64, "m/s", "peak ground velocity";
    PGD_M = "pgd_m", Float64, "m", "peak ground displacement";
    TM_S = "tm_s", Float64, "s", "mean period (Rathje et al.)";
    TP_S = "tp_s", Float64, "s", "predominant period: that of the pulse";
    ARIAS_M_S = "arias_m_s", Float64, "m/s", "Arias intensity";
    CAV_M_S = "cav_m_s", Float64, "m/s", "cumulative absolute velocity";
    D5_75_S = "d5_75_s", Float64, "s", "significant duration, 5 to 75 % of the Arias intensity";
    D5_95_S = "d5_95_s", Float64, "s", "significant duration, 5 to 95 % of the Arias intensity";
    HOUSNER_M = "housner_m", Float64, "m", "Housner intensity, 0.1 to 2.5 s at 5 % damping";

    MOTION_NAME = "motion_id", Text, "1", "ground motion, unique in the file: the name of its file";
    NAME = "name", Text, "1", "earthquake, station and component in the words of the file";
    EARTHQUAKE = "event", Text, "1", "earthquake in the words of the file";
    STATION = "station", Text, "1", "station in the words of the file";
    COMPONENT = "component", Text, "1", "component in the words of the file";
    AZIMUTH_DEG = "azimuth_deg", Float64, "deg", "direction of positive acceleration, clockwise from north; null if vertical or unknown";
    SOURCE_FILE = "source_file", Text, "1", "file that the motion comes from";
    SOURCE_BLAKE3 = "source_blake3", Text, "1", "BLAKE3 hash of that file";
    SCALE = "scale", Float64, "1", "factor by which the record is scaled";
    ROTD50_PGA_M_S2 = "rotd50_pga_m_s2", Float64, "m/s2", "median over all directions of the peak acceleration of a pair";
    ROTD100_PGA_M_S2 = "rotd100_pga_m_s2", Float64, "m/s2", "largest over all directions of the peak acceleration of a pair";
    ROTD50_PGV_M_S = "rotd50_pgv_m_s", Float64, "m/s", "median over all directions of the peak velocity of a pair";
    ROTD100_PGV_M_S = "rotd100_pgv_m_s", Float64, "m/s", "largest over all directions of the peak velocity of a pair";
    PULSE_INDICATOR = "pulse_indicator", Float64, "1", "pulse indicator of Baker (2007), from 0 to 1: above 0.85 a pulse";
    PULSE_VERDICT = "pulse_verdict", Text, "1", "pulse, no_pulse, late (indicated, but not early) or weak (indicated, but PGV below 0.3 m/s)";
    PULSE_WAVELET_S = "pulse_wavelet_s", Float64, "s", "period of the strongest wavelet (Baker 2007)";
    PULSE_AMPLITUDE_M_S = "pulse_amplitude_m_s", Float64, "m/s", "A of the fitted pulse (Eq. 1)";
    T0_S = "t0_s", Float64, "s", "middle of the fitted pulse, from the first sample";
    PULSE_R2 = "pulse_r2", Float64, "1", "share of the squared velocity that the fitted pulse explains";

    STRUCTURE = "structure", Text, "1", "name of the structure";
    P_RAD_S = "p_rad_s", Float64, "rad/s", "frequency parameter p of the structure";
    ALPHA_RAD = "alpha_rad", Float64, "rad", "slenderness of the structure";
    ETA = "eta", Float64, "1", "coefficient of restitution";
    OUTCOME = "outcome", Text, "1", "no_rocking, safe_rocking or overturning";
    EDP = "edp", Float64, "1", "largest rotation over slenderness, |theta|max / alpha (Eq. 7)";
    IMPACTS = "impacts", Int32, "1", "impacts within the duration of the record";
    IM1 = "im1", Float64, "1", "wp / p (Eq. 13)";
    IM2 = "im2", Float64, "1", "wm / p (Eq. 13)";
    IM3 = "im3", Float64, "1", "PGA / (p PGV) (Eq. 13)";
    IM4 = "im4", Float64, "1", "PGA / (g tan alpha) (Eq. 13)";
    IM5 = "im5", Float64, "1", "p PGV / (g tan alpha) (Eq. 13)";
    IM6 = "im6", Float64, "1", "wm PGV / (g tan alpha) (Eq. 13)";

    TIME_S = "time_s", Float64, "s", "time from the first sample";
    THETA_RAD = "theta_rad", Float64, "rad", "rotation";
    THETA_DOT_RAD_S = "theta_dot_rad_s", Float64, "rad/s", "angular velocity; at an impact, that after it";
    THETA_OVER_ALPHA = "theta_over_alpha", Float64, "1", "rotation over slenderness";
    GROUND_M_S2 = "ground_m_s2", Float64, "m/s2", "ground acceleration at this moment";
    EVENT = "event", Text, "1", "uplift, impact, rest or overturn; null at a mere sample";

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
    SE_LN_A_CLUSTERED = "se_ln_a_clustered", Float64, "1", "standard error of ln_a, robust to dependence within a cell";
    SE_B1_CLUSTERED = "se_b1_clustered", Float64, "1", "standard error of b1, robust to dependence within a cell";
    SE_B2_CLUSTERED = "se_b2_clustered", Float64, "1", "standard error of b2, robust to dependence within a cell";
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

    FITTED_EVENT = "event", Text, "1", "overturning, or rocking";
    LAMBDA = "lambda", Float64, "1", "exponent of im_x in the hybrid measure (Eq. 22)";
    MU = "mu", Float64, "1", "logarithm of the median of the measure at overturning (its mean, for the probit)";
    THETA = "theta", Float64, "1", "median exp(mu)";
    LOG_LIKELIHOOD = "log_likelihood", Float64, "1", "log-likelihood at its maximum";
    AIC = "aic", Float64, "1", "Akaike's information criterion";
    BIC = "bic", Float64, "1", "Bayesian information criterion";
    AUC = "auc", Float64, "1", "area under the receiver operating characteristic";
    BRIER = "brier", Float64, "1", "Brier score";
    N_OVERTURNED = "n_overturned", Int64, "1", "cases in which the event happened";
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
    SE_LAMBDA_CLUSTERED = "se_lambda_clustered", Float64, "1", "standard error of lambda, robust to dependence within a cell";
    SE_MU_CLUSTERED = "se_mu_clustered", Float64, "1", "standard error of mu, robust to dependence within a cell";
    SE_BETA_CLUSTERED = "se_beta_clustered", Float64, "1", "standard error of beta, robust to dependence within a cell";
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

    P_NR = "p_nr", Float64, "1", "probability of no rocking";
    P_EX = "p_ex", Float64, "1", "probability of a demand above the limit state, in safe rocking (Eq. 14)";
    P_EX_LOW = "p_ex_low", Float64, "1", "lower 95 % limit of p_ex";
    P_EX_HIGH = "p_ex_high", Float64, "1", "upper 95 % limit of p_ex";
    P_RO = "p_ro", Float64, "1", "probability of overturning given rocking (Eq. 19)";
    P_RO_LOW = "p_ro_low", Float64, "1", "lower 95 % limit of p_ro";
    P_RO_HIGH = "p_ro_high", Float64, "1", "upper 95 % limit of p_ro";
    P_F_R = "p_f_r", Float64, "1", "probability of failure given rocking (Eq. 12)";
    P_F_R_LOW = "p_f_r_low", Float64, "1", "lower 95 % limit of p_f_r";
    P_F_R_HIGH = "p_f_r_high", Float64, "1", "upper 95 % limit of p_f_r";
    P_F = "p_f", Float64, "1", "probability of failure over the whole tree; exactly 0 without rocking";
    OUT_OF_RANGE = "out_of_range", Text, "1", "a measure outside of the range of the data of the fits";

    HYBRID = "im_hybrid", Float64, "1", "hybrid measure of P_ro: im_x^(lambda/(1 + lambda)) im_y^(1/(1 + lambda)) (Eq. 22)";
    ASKED = "quantity", Text, "1", "a probability, or a measure of the intensity";
    VALUE = "value", Float64, "1", "best estimate";
    LOW = "low", Float64, "1", "lower 95 % limit";
    HIGH = "high", Float64, "1", "upper 95 % limit";
    MEANING = "meaning", Text, "1", "in words";

    STATE = "state", Text, "1", "limit state";
    ANNUAL_RATE = "annual_rate", Float64, "1/a", "mean annual rate of reaching the limit state";
    ANNUAL_RATE_LOW = "annual_rate_low", Float64, "1/a", "that of the lower 95 % limits of the probabilities";
    ANNUAL_RATE_HIGH = "annual_rate_high", Float64, "1/a", "that of the upper 95 % limits of the probabilities";
    YEARS = "years", Float64, "a", "time of exposure";
    P_IN_YEARS = "p", Float64, "1", "probability of reaching the limit state in this time";
    P_IN_YEARS_LOW = "p_low", Float64, "1", "that of annual_rate_low";
    P_IN_YEARS_HIGH = "p_high", Float64, "1", "that of annual_rate_high";

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
    LOG_SCORE = "log_score", Float64, "1", "mean logarithm of the probability of what happened";
    LOG_SCORE_EXPECTED = "log_score_expected", Float64, "1", "what log_score would be in the mean if the probabilities are right";
    CALIBRATION = "calibration", Float64, "1", "calibration in the large: by how much all log odds must rise for the expected count to be the seen one; null where no event, or nothing else, was seen";
    N_EXTRAPOLATED = "extrapolated", Int64, "1", "cases with a measure outside of the range of the data of the fits";
    N_WITHOUT_MEASURE = "without_measure", Int64, "1", "cases without a forecast, for want of a measure";

    QUANTITY = "quantity", Text, "1", "what was published";
    PLACE = "place", Text, "1", "where the paper prints it";
    PUBLISHED = "published", Float64, "1", "the published number";
    OURS = "ours", Float64, "1", "the same number from these files";
    SPREAD_MEAN = "spread_mean", Float64, "1", "mean of ours over seeds";
    SPREAD_SD = "spread_sd", Float64, "1", "standard deviation of ours over seeds";
    SEEDS = "seeds", Int32, "1", "number of seeds of the spread";
    Z = "z", Float64, "1", "(published - mean) / standard deviation";
}

/// Earthquake scenarios.
pub const SCENARIOS: Table = Table {
    name: "scenarios",
    stage: "sample-scenarios",
    columns: &[SCENARIO_ID, CELL, SAMPLE, MW, RE_KM, VP_M_S, PULSE_TP_S, GAMMA, NU_RAD],
};

/// Synthetic ground motions with their measures and the scenario they belong to.
pub const MOTIONS: Table = Table {
    name: "motions",
    stage: "synthesize-motions",
    columns: &[
        MOTION_ID,
        SUITE,
        SCENARIO_ID,
        CELL,
        SAMPLE,
        MW,
        RE_KM,
        VP_M_S,
        PULSE_TP_S,
        GAMMA,
        NU_RAD,
        DT_S,
        PGA_M_S2,
        PGV_M_S,
        PGD_M,
        TM_S.or_null(),
        ARIAS_M_S,
        CAV_M_S,
        D5_75_S,
        D5_95_S,
        HOUSNER_M.or_null(),
        ACCELERATION_M_S2,
    ],
};

/// Recorded ground motions with their measures and where they come from.
pub const RECORDS: Table = Table {
    name: "records",
    stage: "import-motions",
    columns: &[
        MOTION_NAME,
        SUITE,
        NAME.or_null(),
        EARTHQUAKE.or_null(),
        STATION.or_null(),
        COMPONENT.or_null(),
        AZIMUTH_DEG.or_null(),
        SOURCE_FILE,
        SOURCE_BLAKE3,
        SCALE,
        DT_S,
        PGA_M_S2,
        PGV_M_S,
        PGD_M,
        TM_S.or_null(),
        ARIAS_M_S,
        CAV_M_S,
        D5_75_S,
        D5_95_S,
        HOUSNER_M.or_null(),
        ROTD50_PGA_M_S2.or_null(),
        ROTD100_PGA_M_S2.or_null(),
        ROTD50_PGV_M_S.or_null(),
        ROTD100_PGV_M_S.or_null(),
        PULSE_INDICATOR.or_null(),
        PULSE_VERDICT.or_null(),
        PULSE_WAVELET_S.or_null(),
        PULSE_AMPLITUDE_M_S.or_null(),
        VP_M_S.or_null(),
        TP_S.or_null(),
        GAMMA.or_null(),
        NU_RAD.or_null(),
        T0_S.or_null(),
        PULSE_R2.or_null(),
        ACCELERATION_M_S2,
    ],
};

/// Responses of structures to motions.
pub const RESPONSES: Table = Table {
    name: "responses",
    stage: "simulate",
    columns: &[
        MOTION_ID,
        SUITE.or_null(),
        STRUCTURE,
        P_RAD_S,
        ALPHA_RAD,
        ETA,
        OUTCOME,
        EDP,
        IMPACTS,
        MW.or_null(),
        RE_KM.or_null(),
        PGA_M_S2,
        PGV_M_S,
        TP_S.or_null(),
        TM_S.or_null(),
        IM1.or_null(),
        IM2.or_null(),
        IM3.or_null(),
        IM4,
        IM5,
        IM6.or_null(),
    ],
};

/// Responses over time.
pub const TRACE: Table = Table {
    name: "trace",
    stage: "simulate",
    columns: &[
        MOTION_ID,
        STRUCTURE,
        TIME_S,
        THETA_RAD,
        THETA_DOT_RAD_S,
        THETA_OVER_ALPHA,
        GROUND_M_S2,
        EVENT.or_null(),
    ],
};

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
        N_OVERTURNED,
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

/// Probabilities at many intensities.
pub const EVALUATED: Table = Table {
    name: "probabilities",
    stage: "evaluate",
    columns: &[
        P_RAD_S,
        ALPHA_RAD,
        PGA_M_S2,
        PGV_M_S,
        P_NR,
        P_EX.or_null(),
        P_EX_LOW.or_null(),
        P_EX_HIGH.or_null(),
        P_RO.or_null(),
        P_RO_LOW.or_null(),
        P_RO_HIGH.or_null(),
        P_F_R.or_null(),
        P_F_R_LOW.or_null(),
        P_F_R_HIGH.or_null(),
        P_F.or_null(),
        OUT_OF_RANGE.or_null(),
    ],
};

/// All probabilities at one intensity.
pub const ANSWER: Table = Table {
    name: "probabilities at one intensity",
    stage: "evaluate",
    columns: &[ASKED, VALUE.or_null(), LOW.or_null(), HIGH.or_null(), MEANING],
};

/// Annual rates of the limit states.
pub const RATES: Table = Table {
    name: "annual rates",
    stage: "evaluate",
    columns: &[
        STATE,
        ANNUAL_RATE,
        ANNUAL_RATE_LOW,
        ANNUAL_RATE_HIGH,
        YEARS,
        P_IN_YEARS,
        P_IN_YEARS_LOW,
        P_IN_YEARS_HIGH,
        MEANING,
    ],
};

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
        LOG_SCORE,
        LOG_SCORE_EXPECTED,
        BRIER,
        AUC.or_null(),
        CALIBRATION.or_null(),
        N_EXTRAPOLATED,
        N_WITHOUT_MEASURE,
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

/// Each published number beside ours.
pub const PAPER: Table = Table {
    name: "paper comparison",
    stage: "compare-paper",
    columns: &[
        QUANTITY,
        PLACE,
        SUITE.or_null(),
        STRUCTURE.or_null(),
        PUBLISHED.or_null(),
        OURS.or_null(),
        SPREAD_MEAN.or_null(),
        SPREAD_SD.or_null(),
        SEEDS,
        Z.or_null(),
    ],
};
