//! The scenarios file: one row a scenario.

use super::TableError;
use super::row::{ReadRow, table};
use super::schema;
use super::store::columns::Columns;
use super::store::reader::Batches;
use super::store::source::Source;
use crate::motion::Scenario;

table! {
    /// Earthquake scenarios.
    pub struct ScenarioRow as SCENARIOS = "scenarios" by "sample-scenarios" {
        scenario_id: i64,
        cell: i32,
        sample: i32,
        mw: f64,
        re_km: f64,
        vp_m_s: f64,
        tp_s: f64 = pulse_tp_s,
        gamma: f64,
        nu_rad: f64,
    }
}

impl From<&Scenario> for ScenarioRow {
    fn from(scenario: &Scenario) -> ScenarioRow {
        let &Scenario { scenario_id, cell, sample, mw, re_km, vp_m_s, tp_s, gamma, nu_rad } = scenario;
        ScenarioRow { scenario_id, cell, sample, mw, re_km, vp_m_s, tp_s, gamma, nu_rad }
    }
}

/// Half-way round the globe, km.
const FARTHEST_KM: f64 = 20_000.0;
const FASTEST_M_S: f64 = 100.0;
/// What a synthetic motion is long, s, at most: it is held in memory.
const LONGEST_PULSE_S: f64 = 3600.0;

/// The scenarios of a table, checked: positive amplitude and period, gamma of 1 or more.
///
/// # Errors
/// If the file is not one of scenarios or a value is out of range.
pub fn read(source: impl Into<Source>) -> Result<Vec<Scenario>, TableError> {
    let mut scenarios = Vec::new();
    for batch in Batches::open_whole(source, &SCENARIOS, &[SCENARIOS.stage])? {
        scenarios.extend(rows_of(&batch?.columns())?);
    }
    Ok(scenarios)
}

fn rows_of(columns: &Columns) -> Result<Vec<Scenario>, TableError> {
    let each = |(row, scenario)| {
        let ScenarioRow { scenario_id, cell, sample, mw, re_km, vp_m_s, tp_s, gamma, nu_rad } = scenario;
        let check = |possible: bool, column: &schema::Column, value: f64, expected: &str| match possible {
            true => Ok(()),
            false => Err(columns.value_error(row, column, &format!("{value}; expected {expected}"))),
        };
        check(re_km >= 0.0, &schema::re_km, re_km, "0 or more")?;
        check(gamma >= 1.0, &schema::gamma, gamma, "1 or more")?;
        check(vp_m_s > 0.0, &schema::vp_m_s, vp_m_s, "a number above 0")?;
        check(tp_s > 0.0, &schema::pulse_tp_s, tp_s, "a number above 0")?;
        check(re_km <= FARTHEST_KM, &schema::re_km, re_km, "a distance on the globe, km")?;
        check(vp_m_s <= FASTEST_M_S, &schema::vp_m_s, vp_m_s, "a velocity of the ground up to 100 m/s")?;
        let is_short = gamma * tp_s <= LONGEST_PULSE_S;
        check(is_short, &schema::gamma, gamma, "a pulse (gamma tp_s) of an hour at most")?;
        check((3.0..=10.0).contains(&mw), &schema::mw, mw, "a moment magnitude from 3 to 10")?;
        Ok(Scenario { scenario_id, cell, sample, mw, re_km, vp_m_s, tp_s, gamma, nu_rad })
    };
    ScenarioRow::of(columns)?.into_iter().enumerate().map(each).collect()
}
