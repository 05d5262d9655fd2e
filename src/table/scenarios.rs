//! The scenarios file: one row a scenario.

use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, Int32Array, Int64Array, RecordBatch};
use arrow_schema::ArrowError;

use super::TableError;
use super::columns::Columns;
use super::reader::Batches;
use super::schema::{self, SCENARIOS};
use super::source::Source;
use crate::motion::Scenario;

/// Half-way round the globe, km.
const FARTHEST_KM: f64 = 20_000.0;
const FASTEST_M_S: f64 = 100.0;
/// What a synthetic motion is long, s, at most: it is held in memory.
const LONGEST_PULSE_S: f64 = 3600.0;

/// The rows of the scenarios file.
///
/// # Errors
/// If a row cannot be represented, which the schema rules out.
pub fn batch(scenarios: &[Scenario]) -> Result<RecordBatch, ArrowError> {
    RecordBatch::try_new(SCENARIOS.schema(), columns(scenarios))
}

/// In the order of the schema.
pub(super) fn columns(scenarios: &[Scenario]) -> Vec<ArrayRef> {
    let int32 = |value: fn(&Scenario) -> i32| -> ArrayRef {
        Arc::new(Int32Array::from_iter_values(scenarios.iter().map(value)))
    };
    let number = |value: fn(&Scenario) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter_values(scenarios.iter().map(value)))
    };
    vec![
        Arc::new(Int64Array::from_iter_values(scenarios.iter().map(|scenario| scenario.scenario_id))),
        int32(|scenario| scenario.cell),
        int32(|scenario| scenario.sample),
        number(|scenario| scenario.mw),
        number(|scenario| scenario.re_km),
        number(|scenario| scenario.vp_m_s),
        number(|scenario| scenario.tp_s),
        number(|scenario| scenario.gamma),
        number(|scenario| scenario.nu_rad),
    ]
}

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
    let scenario_id = columns.integers(&schema::SCENARIO_ID)?;
    let cell = columns.integers(&schema::CELL)?;
    let sample = columns.integers(&schema::SAMPLE)?;
    let mw = columns.numbers(&schema::MW)?;
    let re_km = columns.numbers(&schema::RE_KM)?;
    let vp_m_s = columns.numbers(&schema::VP_M_S)?;
    let tp_s = columns.numbers(&schema::PULSE_TP_S)?;
    let gamma = columns.numbers(&schema::GAMMA)?;
    let nu_rad = columns.numbers(&schema::NU_RAD)?;
    let each = |row: usize| {
        let least = [(&schema::RE_KM, re_km[row], 0.0), (&schema::GAMMA, gamma[row], 1.0)];
        if let Some((column, value, least)) = least.into_iter().find(|(_, value, least)| value < least) {
            return Err(columns.value_error(row, column, &format!("{value}; expected {least} or more")));
        }
        let positive = [(&schema::VP_M_S, vp_m_s[row]), (&schema::PULSE_TP_S, tp_s[row])];
        if let Some((column, value)) = positive.into_iter().find(|(_, value)| *value <= 0.0) {
            return Err(columns.value_error(row, column, &format!("{value}; expected a number above 0")));
        }
        let duration_s = gamma[row] * tp_s[row];
        let most = [
            (&schema::RE_KM, re_km[row], re_km[row], FARTHEST_KM, "a distance on the globe, km"),
            (
                &schema::VP_M_S,
                vp_m_s[row],
                vp_m_s[row],
                FASTEST_M_S,
                "a velocity of the ground up to 100 m/s",
            ),
            (
                &schema::GAMMA,
                gamma[row],
                duration_s,
                LONGEST_PULSE_S,
                "a pulse (gamma tp_s) of an hour at most",
            ),
        ];
        if let Some((column, value, _, _, expected)) = most.into_iter().find(|(_, _, is, most, _)| is > most)
        {
            return Err(columns.value_error(row, column, &format!("{value}; expected {expected}")));
        }
        if !(3.0..=10.0).contains(&mw[row]) {
            let problem = format!("{}; expected a moment magnitude from 3 to 10", mw[row]);
            return Err(columns.value_error(row, &schema::MW, &problem));
        }
        Ok(Scenario {
            scenario_id: scenario_id[row],
            cell: narrow(columns, row, &schema::CELL, cell[row])?,
            sample: narrow(columns, row, &schema::SAMPLE, sample[row])?,
            mw: mw[row],
            re_km: re_km[row],
            vp_m_s: vp_m_s[row],
            tp_s: tp_s[row],
            gamma: gamma[row],
            nu_rad: nu_rad[row],
        })
    };
    (0..columns.rows()).map(each).collect()
}

fn narrow(columns: &Columns, row: usize, column: &schema::Column, value: i64) -> Result<i32, TableError> {
    i32::try_from(value)
        .map_err(|_| columns.value_error(row, column, &format!("{value}; expected a 32-bit integer")))
}
