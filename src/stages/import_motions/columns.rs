//! The columns of imported motions.

use arrow_array::RecordBatch;
use serde::{Deserialize, Serialize};

use crate::motion::pulse::largest_velocity;
use crate::motion::{MotionMeasures, Suite};
use crate::records::RecordedMotion;
use crate::records::processing::{ImportedMotion, NamedRecord};
use crate::records::pulses::Verdict;
use crate::table::{motions, rows};

/// What the file has of a motion, besides its measures.
#[derive(Serialize, Deserialize)]
struct SourceRow {
    motion_id: String,
    suite: Suite,
    name: Option<String>,
    earthquake: Option<String>,
    mw: Option<f64>,
    re_km: Option<f64>,
    station: Option<String>,
    component: Option<String>,
    azimuth_deg: Option<f64>,
    source_file: String,
    source_blake3: String,
    scale: f64,
    dt_s: f64,
}

/// What is known of the pair and the pulse of a motion.
#[derive(Serialize, Deserialize)]
struct PulseRow {
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
}

/// Motions as rows; `periods_s` are those of the spectral accelerations.
pub fn batch(some: &[ImportedMotion], periods_s: &[f64]) -> anyhow::Result<RecordBatch> {
    let sources: Vec<SourceRow> = some.iter().map(source).collect();
    let measures: Vec<&MotionMeasures> = some.iter().map(|motion| &motion.measured).collect();
    let pulses: Vec<PulseRow> = some.iter().map(pulse).collect();
    let sa: Vec<&[f64]> = some.iter().map(|motion| motion.measured.sa_m_s2.as_slice()).collect();
    let known = [rows::batch(&sources)?, rows::batch(measures)?, rows::batch(&pulses)?];
    motions::batch(&known, periods_s, &sa, some.iter().map(|motion| motion.acceleration_m_s2.as_slice()))
}

fn source(motion: &ImportedMotion) -> SourceRow {
    let NamedRecord { motion_id, source, motion: record, .. } = &motion.record;
    let RecordedMotion { event, station, component, .. } = record;
    let names: Vec<&str> = [event, station, component].into_iter().flatten().map(String::as_str).collect();
    SourceRow {
        motion_id: motion_id.clone(),
        suite: Suite::Record,
        name: (!names.is_empty()).then(|| names.join(", ")),
        earthquake: event.clone(),
        mw: record.mw,
        re_km: record.re_km,
        station: station.clone(),
        component: component.clone(),
        azimuth_deg: record.azimuth_deg,
        source_file: source.path.clone(),
        source_blake3: source.blake3.clone(),
        scale: motion.scale,
        dt_s: record.dt_s,
    }
}

fn pulse(motion: &ImportedMotion) -> PulseRow {
    let ImportedMotion { rotd, indicator, pulse: fitted, scale, .. } = *motion;
    let pulse = fitted.map(|fitted| fitted.pulse);
    PulseRow {
        rotd50_pga_m_s2: rotd.map(|rotd| scale * rotd.pga50_m_s2),
        rotd100_pga_m_s2: rotd.map(|rotd| scale * rotd.pga100_m_s2),
        rotd50_pgv_m_s: rotd.map(|rotd| scale * rotd.pgv50_m_s),
        rotd100_pgv_m_s: rotd.map(|rotd| scale * rotd.pgv100_m_s),
        pulse_indicator: indicator.map(|found| found.indicator),
        pulse_verdict: indicator.map(|found| found.verdict),
        pulse_wavelet_s: indicator.map(|found| found.period_s),
        pulse_amplitude_m_s: pulse.map(|pulse| scale * pulse.amplitude_m_s),
        vp_m_s: pulse.map(|pulse| scale * pulse.amplitude_m_s * largest_velocity(pulse.gamma, pulse.nu_rad)),
        tp_s: pulse.map(|pulse| pulse.tp_s),
        gamma: pulse.map(|pulse| pulse.gamma),
        nu_rad: pulse.map(|pulse| pulse.nu_rad),
        t0_s: fitted.map(|fitted| fitted.t0_s),
        pulse_r2: fitted.map(|fitted| fitted.r2),
    }
}
