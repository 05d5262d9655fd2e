//! From records to imported motions: baseline, filter, time step, rotation, scale, measures, pulses.

use serde::{Deserialize, Serialize};

use super::implausibility::{Implausibility, implausibility, incompleteness};
use super::pulses::{FittedPulse, PulseIndicator, Verdict, strongest_direction};
use super::rotation::{HorizontalPair, Orientation, Parts, RotD};
use super::signal::{Baseline, high_pass, resample, resampled_length};
use super::{Origin, RecordedMotion};
use crate::motion::measures::peak;
use crate::motion::pulse::largest_velocity;
use crate::motion::{LONGEST_MOTION, MeasurePlan, MotionMeasures, Suite, measures};
use crate::number::significant;
use crate::plausibility::{STRONGEST_PGA_G, STRONGEST_PGV_M_S};
use crate::spelling::unknown_word;
use crate::units::G_M_S2;
use crate::warning::Warning;

/// A loss of more than this share of the PGA by resampling is reported.
const NOTICEABLE_LOSS: f64 = 0.01;

#[derive(Debug, Clone, PartialEq)]
pub struct NamedRecord {
    /// Unique among the imported records.
    pub motion_id: String,
    /// Path as given.
    pub source_file: String,
    /// BLAKE3 of its content, in hexadecimal digits.
    pub source_blake3: String,
    pub motion: RecordedMotion,
    /// Warnings about a record that is imported nevertheless.
    pub doubts: Vec<(Warning, String)>,
}

#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ProcessingError {
    #[error("{0} (--accept-implausible imports it anyway)")]
    Implausible(Implausibility),
    #[error(
        "{samples} samples at a time step of {dt_s} s; expected 2 to {LONGEST_MOTION}: another --resample?"
    )]
    Resampled { samples: f64, dt_s: f64 },
    #[error(
        "PGA {pga_g:.1} g and PGV {pgv_m_s:.1} m/s when scaled by {scale}; none as strong was ever recorded \
         (--accept-implausible imports it anyway)"
    )]
    Scaled { scale: f64, pga_g: f64, pgv_m_s: f64 },
}

/// An imported motion: a row of a table of motions.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ImportedMotion {
    pub motion_id: String,
    pub suite: Suite,
    /// Earthquake, station and component.
    pub name: Option<String>,
    pub origin: Origin,
    pub source_file: String,
    pub source_blake3: String,
    pub scale: f64,
    pub dt_s: f64,
    /// Measures of the samples as written.
    pub measures: MotionMeasures,
    pub pulse: PulseColumns,
    /// Samples as written, m/s2.
    #[serde(skip)]
    pub acceleration_m_s2: Vec<f32>,
    /// Format and unit of the file.
    #[serde(skip)]
    pub kind: String,
    #[serde(skip)]
    pub doubts: Vec<(Warning, String)>,
}

/// What is known of the pair and the pulse of a motion: peaks over all directions, the indicator if pulses
/// were searched, and the fitted pulse.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PulseColumns {
    pub rotd50_pga_m_s2: Option<f64>,
    pub rotd100_pga_m_s2: Option<f64>,
    pub rotd50_pgv_m_s: Option<f64>,
    pub rotd100_pgv_m_s: Option<f64>,
    pub pulse_indicator: Option<f64>,
    pub pulse_verdict: Option<Verdict>,
    pub pulse_wavelet_s: Option<f64>,
    pub pulse_amplitude_m_s: Option<f64>,
    pub vp_m_s: Option<f64>,
    pub tp_s: Option<f64>,
    pub gamma: Option<f64>,
    pub nu_rad: Option<f64>,
    pub t0_s: Option<f64>,
    pub pulse_r2: Option<f64>,
}

impl PulseColumns {
    fn new(
        scale: f64,
        rotd: Option<RotD>,
        found: Option<PulseIndicator>,
        fitted: Option<FittedPulse>,
    ) -> PulseColumns {
        let pulse = fitted.map(|fitted| fitted.pulse);
        PulseColumns {
            rotd50_pga_m_s2: rotd.map(|rotd| scale * rotd.pga50_m_s2),
            rotd100_pga_m_s2: rotd.map(|rotd| scale * rotd.pga100_m_s2),
            rotd50_pgv_m_s: rotd.map(|rotd| scale * rotd.pgv50_m_s),
            rotd100_pgv_m_s: rotd.map(|rotd| scale * rotd.pgv100_m_s),
            pulse_indicator: found.map(|found| found.indicator),
            pulse_verdict: found.map(|found| found.verdict),
            pulse_wavelet_s: found.map(|found| found.period_s),
            pulse_amplitude_m_s: pulse.map(|pulse| scale * pulse.amplitude_m_s),
            vp_m_s: pulse
                .map(|pulse| scale * pulse.amplitude_m_s * largest_velocity(pulse.gamma, pulse.nu_rad)),
            tp_s: pulse.map(|pulse| pulse.tp_s),
            gamma: pulse.map(|pulse| pulse.gamma),
            nu_rad: pulse.map(|pulse| pulse.nu_rad),
            t0_s: fitted.map(|fitted| fitted.t0_s),
            pulse_r2: fitted.map(|fitted| fitted.r2),
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<PulseSearch>)]
pub enum PulseSearch {
    Find,
    Skip,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Processing {
    pub baseline: Baseline,
    /// Corner of a high-pass filter, Hz.
    pub high_pass_hz: Option<f64>,
    pub resample_s: Option<f64>,
    /// Direction of pairs; none imports components one by one.
    pub direction: Option<Orientation>,
    /// Each gives a motion.
    pub factors: Vec<f64>,
    pub pulses: PulseSearch,
    /// Whether implausible motions are imported, with a warning, or are errors.
    pub accept_implausible: bool,
    pub plan: MeasurePlan,
}

impl Processing {
    /// Processes one component into a motion for each scale factor; `rotd` columns are none.
    ///
    /// # Errors
    /// If it is implausible, or too short or too long for what is asked.
    pub fn import(&self, record: NamedRecord) -> Result<Vec<ImportedMotion>, ProcessingError> {
        self.scaled(self.corrected(record)?, None)
    }

    /// Processes two components at right angles into one motion.
    pub fn import_pair(
        &self,
        [first, second]: [NamedRecord; 2],
    ) -> Result<Vec<ImportedMotion>, ProcessingError> {
        let (record, rotd) = self.rotated(self.corrected(first)?, self.corrected(second)?);
        self.scaled(record, Some(rotd))
    }

    /// Corrects the baseline, filters, checks and resamples.
    fn corrected(&self, mut record: NamedRecord) -> Result<NamedRecord, ProcessingError> {
        let motion = &mut record.motion;
        self.baseline.remove_from(&mut motion.acceleration_m_s2);
        if let Some(corner_hz) = self.high_pass_hz {
            high_pass(&mut motion.acceleration_m_s2, motion.dt_s, corner_hz);
        }
        let checks = [implausibility, incompleteness];
        for why in checks.into_iter().filter_map(|check| check(&motion.acceleration_m_s2, motion.dt_s)) {
            if why.is_impossible() && !self.accept_implausible {
                return Err(ProcessingError::Implausible(why));
            }
            record.doubts.push((Warning::ImplausibleRecord, why.to_string()));
        }
        if let Some(dt_s) = self.resample_s {
            let samples = resampled_length(motion.acceleration_m_s2.len(), motion.dt_s, dt_s);
            if !(2.0..=LONGEST_MOTION as f64).contains(&samples) {
                return Err(ProcessingError::Resampled { samples, dt_s });
            }
            let before = peak(&motion.acceleration_m_s2);
            motion.acceleration_m_s2 = resample(&motion.acceleration_m_s2, motion.dt_s, dt_s);
            motion.dt_s = dt_s;
            let lost = 1.0 - peak(&motion.acceleration_m_s2) / before;
            if lost > NOTICEABLE_LOSS {
                let lower = format!("{} % lower", significant(100.0 * lost, 2));
                record.doubts.push((Warning::LoweredPeak, lower));
            }
        }
        Ok(record)
    }

    fn rotated(&self, first: NamedRecord, second: NamedRecord) -> (NamedRecord, RotD) {
        let pair = HorizontalPair::new(first.motion, second.motion);
        let azimuth_deg = match self.direction {
            Some(Orientation::Azimuth(azimuth_deg)) => azimuth_deg,
            Some(Orientation::StrongestPulse) | None => {
                let dt_s = pair.first.dt_s;
                let [x, y] = [&pair.first, &pair.second]
                    .map(|component| measures::velocity(&component.acceleration_m_s2, dt_s));
                let along_first = Parts { first: 1.0, second: 0.0 };
                pair.azimuth_of(strongest_direction([&x, &y], dt_s).unwrap_or(along_first))
            }
        };
        let (acceleration_m_s2, rotd) = (pair.towards(azimuth_deg), pair.rotd());
        let both = |a: String, b: String| if a == b { a } else { format!("{a}; {b}") };
        let record = NamedRecord {
            motion_id: format!("{}+{}", first.motion_id, second.motion_id),
            source_file: both(first.source_file, second.source_file),
            source_blake3: both(first.source_blake3, second.source_blake3),
            doubts: [first.doubts, second.doubts].concat(),
            motion: RecordedMotion {
                acceleration_m_s2,
                origin: Origin {
                    component: Some(format!("{azimuth_deg:.1} deg of a pair")),
                    azimuth_deg: Some(azimuth_deg),
                    ..pair.first.origin
                },
                header_pga: None,
                ..pair.first
            },
        };
        (record, rotd)
    }

    /// Scales and measures a record: one motion for each factor.
    fn scaled(
        &self,
        record: NamedRecord,
        rotd: Option<RotD>,
    ) -> Result<Vec<ImportedMotion>, ProcessingError> {
        let NamedRecord { motion_id, source_file, source_blake3, motion, doubts } = record;
        let dt_s = motion.dt_s;
        let (found, fitted) = self.pulse_of(&motion);
        let Origin { earthquake, station, component, .. } = &motion.origin;
        let names: Vec<&str> =
            [earthquake, station, component].into_iter().flatten().map(String::as_str).collect();
        let mut motions = Vec::new();
        for &scale in &self.factors {
            let scaled = motion.acceleration_m_s2.iter().map(|a| scale * a);
            let (acceleration_m_s2, measures) = self.plan.measure_written(scaled, dt_s);
            let (pga_g, pgv_m_s) = (measures.pga_m_s2 / G_M_S2, measures.pgv_m_s);
            let is_too_strong = pga_g > STRONGEST_PGA_G || pgv_m_s > STRONGEST_PGV_M_S;
            if scale != 1.0 && is_too_strong && !self.accept_implausible {
                return Err(ProcessingError::Scaled { scale, pga_g, pgv_m_s });
            }
            motions.push(ImportedMotion {
                motion_id: match self.factors.len() {
                    1 => motion_id.clone(),
                    _ => format!("{motion_id} x{scale}"),
                },
                suite: Suite::Record,
                name: (!names.is_empty()).then(|| names.join(", ")),
                origin: motion.origin.clone(),
                source_file: source_file.clone(),
                source_blake3: source_blake3.clone(),
                scale,
                dt_s,
                measures,
                pulse: PulseColumns::new(scale, rotd, found, fitted),
                acceleration_m_s2,
                kind: format!("{} in {}", motion.format, motion.unit.name),
                doubts: doubts.clone(),
            });
        }
        Ok(motions)
    }

    fn pulse_of(&self, motion: &RecordedMotion) -> (Option<PulseIndicator>, Option<FittedPulse>) {
        if self.pulses == PulseSearch::Skip {
            return (None, None);
        }
        let velocity = measures::velocity(&motion.acceleration_m_s2, motion.dt_s);
        let indicator = PulseIndicator::of(&velocity, motion.dt_s);
        let found = indicator.filter(|found| found.verdict == Verdict::Pulse);
        let fitted =
            found.and_then(|found| FittedPulse::fit(&velocity, motion.dt_s, found.period_s, found.centre_s));
        (indicator, fitted)
    }
}
