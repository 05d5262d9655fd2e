//! Ground motions: synthetic, and recorded.

use super::column::{Column, Kind, columns};
use super::scenario::{CELL, GAMMA, MW, NU_RAD, PULSE_TP_S, RE_KM, SAMPLE, SCENARIO_ID, VP_M_S};
use super::table::Table;

columns! {
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

    SPECTRAL_ACCELERATION = "sa_*_m_s2", Float64, "m/s2", "pseudo-spectral acceleration at 5 % damping";

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
}

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
