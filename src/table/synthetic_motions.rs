//! Synthetic motions as rows of the motions file.

use std::sync::Arc;

use arrow_array::{ArrayRef, Float64Array, RecordBatch};
use arrow_schema::{ArrowError, SchemaRef};

use super::row::{WriteRow, table};
use crate::motion::{Measured, Scenario, Suite};

/// A synthetic motion on its way into a file.
#[derive(Debug, Clone, PartialEq)]
pub struct SyntheticMotion {
    /// Unique in the file.
    pub motion_id: i64,
    pub suite: Suite,
    /// The scenario it belongs to.
    pub scenario: Scenario,
    /// Time between samples, s.
    pub dt_s: f64,
    /// Samples, m/s2, as they are written.
    pub acceleration_m_s2: Vec<f32>,
    /// Intensity measures of these samples.
    pub measured: Measured,
}

table! {
    /// Synthetic ground motions with their measures and the scenario they belong to.
    pub struct SyntheticRow<'a> as MOTIONS = "motions" by "synthesize-motions" {
        motion_id: i64,
        suite: Suite,
        scenario_id: i64,
        cell: i32,
        sample: i32,
        mw: f64,
        re_km: f64,
        vp_m_s: f64,
        tp_s: f64 = pulse_tp_s,
        gamma: f64,
        nu_rad: f64,
        dt_s: f64,
        pga_m_s2: f64,
        pgv_m_s: f64,
        pgd_m: f64,
        tm_s: Option<f64>,
        arias_m_s: f64,
        cav_m_s: f64,
        d5_75_s: f64,
        d5_95_s: f64,
        housner_m: Option<f64>,
        acceleration_m_s2: &'a [f32],
    }
}

impl<'a> From<&'a SyntheticMotion> for SyntheticRow<'a> {
    fn from(motion: &'a SyntheticMotion) -> SyntheticRow<'a> {
        let (scenario, measured) = (&motion.scenario, &motion.measured);
        SyntheticRow {
            motion_id: motion.motion_id,
            suite: motion.suite,
            scenario_id: scenario.scenario_id,
            cell: scenario.cell,
            sample: scenario.sample,
            mw: scenario.mw,
            re_km: scenario.re_km,
            vp_m_s: scenario.vp_m_s,
            tp_s: scenario.tp_s,
            gamma: scenario.gamma,
            nu_rad: scenario.nu_rad,
            dt_s: motion.dt_s,
            pga_m_s2: measured.measures.pga_m_s2,
            pgv_m_s: measured.measures.pgv_m_s,
            pgd_m: measured.measures.pgd_m,
            tm_s: measured.measures.tm_s,
            arias_m_s: measured.measures.arias_m_s,
            cav_m_s: measured.measures.cav_m_s,
            d5_75_s: measured.measures.d5_75_s,
            d5_95_s: measured.measures.d5_95_s,
            housner_m: measured.housner_m,
            acceleration_m_s2: &motion.acceleration_m_s2,
        }
    }
}

/// The rows of the motions file in its schema, which has the spectral accelerations at its end.
///
/// # Errors
/// If memory runs out.
pub fn batch(motions: &[SyntheticMotion], schema: &SchemaRef) -> Result<RecordBatch, ArrowError> {
    let rows: Vec<SyntheticRow> = motions.iter().map(SyntheticRow::from).collect();
    let mut columns = SyntheticRow::arrays(rows.iter(), false);
    columns.extend(spectrum(motions.iter().map(|motion| &motion.measured)));
    RecordBatch::try_new(schema.clone(), columns)
}

/// The columns of spectral accelerations, as many as all motions have.
pub(super) fn spectrum<'a>(motions: impl Iterator<Item = &'a Measured> + Clone) -> Vec<ArrayRef> {
    let periods = motions.clone().map(|motion| motion.sa_m_s2.len()).min().unwrap_or(0);
    let column = |period: usize| -> ArrayRef {
        Arc::new(Float64Array::from_iter(motions.clone().map(|motion| motion.sa_m_s2.get(period).copied())))
    };
    (0..periods).map(column).collect()
}
