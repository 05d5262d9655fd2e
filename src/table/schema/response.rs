//! Responses of structures.

use super::column::{Column, Kind, columns};
use super::motion::{EARTHQUAKE, MOTION_ID, PGA_M_S2, PGV_M_S, SUITE, TM_S, TP_S};
use super::scenario::{MW, RE_KM};
use super::table::Table;

columns! {
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
}

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
        EARTHQUAKE.or_null(),
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
