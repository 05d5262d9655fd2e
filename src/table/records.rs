//! The motions file that import-motions writes: one row a recorded motion.

use arrow_array::RecordBatch;
use arrow_schema::{ArrowError, SchemaRef};

use super::row::{WriteRow, table};
use super::synthetic_motions::spectrum;
use crate::motion::Suite;
use crate::motion::pulse::largest_velocity;
use crate::records::processing::ImportedMotion;
use crate::records::pulses::Verdict;

table! {
    /// Recorded ground motions with their measures and where they come from.
    pub struct RecordRow<'a> as RECORDS = "records" by "import-motions" {
        motion_id: &'a str = motion_name,
        suite: Suite,
        name: Option<String>,
        earthquake: Option<&'a str>,
        station: Option<&'a str>,
        component: Option<&'a str>,
        azimuth_deg: Option<f64>,
        source_file: &'a str,
        source_blake3: &'a str,
        scale: f64,
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
        rotd50_pga_m_s2: Option<f64>,
        rotd100_pga_m_s2: Option<f64>,
        rotd50_pgv_m_s: Option<f64>,
        rotd100_pgv_m_s: Option<f64>,
        pulse_indicator: Option<f64>,
        pulse_verdict: Option<Verdict>,
        pulse_wavelet_s: Option<f64>,
        pulse_amplitude_m_s: Option<f64>,
        vp_m_s: Option<f64>,
        tp_s: Option<f64>,
        gamma: Option<f64>,
        nu_rad: Option<f64>,
        t0_s: Option<f64>,
        pulse_r2: Option<f64>,
        acceleration_m_s2: &'a [f32],
    }
}

impl<'a> From<&'a ImportedMotion> for RecordRow<'a> {
    fn from(motion: &'a ImportedMotion) -> RecordRow<'a> {
        let ImportedMotion { measured, rotd, indicator, pulse: fitted, .. } = motion;
        let pulse = fitted.map(|fitted| fitted.pulse);
        RecordRow {
            motion_id: &motion.motion_id,
            suite: motion.suite,
            name: motion.name(),
            earthquake: motion.event.as_deref(),
            station: motion.station.as_deref(),
            component: motion.component.as_deref(),
            azimuth_deg: motion.azimuth_deg,
            source_file: &motion.source.path,
            source_blake3: &motion.source.blake3,
            scale: motion.scale,
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
            rotd50_pga_m_s2: rotd.map(|rotd| rotd.pga50_m_s2),
            rotd100_pga_m_s2: rotd.map(|rotd| rotd.pga100_m_s2),
            rotd50_pgv_m_s: rotd.map(|rotd| rotd.pgv50_m_s),
            rotd100_pgv_m_s: rotd.map(|rotd| rotd.pgv100_m_s),
            pulse_indicator: indicator.map(|found| found.indicator),
            pulse_verdict: indicator.map(|found| found.verdict),
            pulse_wavelet_s: indicator.map(|found| found.period_s),
            pulse_amplitude_m_s: pulse.map(|pulse| pulse.amplitude_m_s),
            vp_m_s: pulse.map(|pulse| pulse.amplitude_m_s * largest_velocity(pulse.gamma, pulse.nu_rad)),
            tp_s: pulse.map(|pulse| pulse.tp_s),
            gamma: pulse.map(|pulse| pulse.gamma),
            nu_rad: pulse.map(|pulse| pulse.nu_rad),
            t0_s: fitted.map(|fitted| fitted.t0_s),
            pulse_r2: fitted.map(|fitted| fitted.r2),
            acceleration_m_s2: &motion.acceleration_m_s2,
        }
    }
}

/// The rows of the file in its schema, which has the spectral accelerations at its end.
///
/// # Errors
/// If memory runs out.
pub fn batch(motions: &[ImportedMotion], schema: &SchemaRef) -> Result<RecordBatch, ArrowError> {
    let rows: Vec<RecordRow> = motions.iter().map(RecordRow::from).collect();
    let mut columns = RecordRow::arrays(rows.iter(), false);
    columns.extend(spectrum(motions.iter().map(|motion| &motion.measured)));
    RecordBatch::try_new(schema.clone(), columns)
}
