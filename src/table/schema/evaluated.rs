//! Probabilities and annual rates.

use super::column::{Column, Kind, columns};
use super::motion::{PGA_M_S2, PGV_M_S};
use super::response::{ALPHA_RAD, P_RAD_S};
use super::table::Table;

columns! {
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
}

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
