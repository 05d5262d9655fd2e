//! Scenarios of earthquakes.

use super::column::{Column, Kind, columns};
use super::table::Table;

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
}

/// Earthquake scenarios.
pub const SCENARIOS: Table = Table {
    name: "scenarios",
    stage: "sample-scenarios",
    columns: &[SCENARIO_ID, CELL, SAMPLE, MW, RE_KM, VP_M_S, PULSE_TP_S, GAMMA, NU_RAD],
};
