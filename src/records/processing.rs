//! From records to imported motions: baseline, filter, time step, rotation, scale, measures, pulses.

use super::RecordedMotion;
use super::implausibility::{Implausibility, implausibility, incompleteness};
use super::pulses::{FittedPulse, PulseIndicator, Verdict, strongest_direction};
use super::rotation::{Direction, HorizontalPair, Parts, RotD};
use super::signal::{Baseline, Scaling, high_pass, resample, resampled_length};
use crate::keyword::keywords;
use crate::motion::measures::peak;
use crate::motion::{LONGEST_MOTION, MeasurePlan, MotionMeasures, Transforms, measures};
use crate::number::significant;
use crate::plausibility::{STRONGEST_PGA_G, STRONGEST_PGV_M_S};
use crate::units::G_M_S2;
use crate::warning::Warning;

/// Share of the PGA whose loss by resampling is told.
const NOTICEABLE_LOSS: f64 = 0.01;

/// A file and the hash of its content.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SourceFile {
    /// Path as given.
    pub path: String,
    /// BLAKE3, in hexadecimal digits.
    pub blake3: String,
}

/// A record with its name and its file.
#[derive(Debug, Clone, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct NamedRecord {
    /// Unique among the imported records.
    pub motion_id: String,
    pub source: SourceFile,
    pub motion: RecordedMotion,
    /// What speaks against it, though it is imported.
    pub doubts: Vec<(Warning, String)>,
}

/// Why a record cannot be processed.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the message says it")]
pub enum ProcessingError {
    #[error("{0}")]
    Implausible(Implausibility),
    #[error("{samples} samples at a time step of {dt_s} s; expected 2 to {LONGEST_MOTION}")]
    Resampled { samples: f64, dt_s: f64 },
    #[error("the motion is zero throughout; it cannot be scaled to a peak")]
    Zero,
    #[error(
        "corner of the high-pass {corner_hz} Hz; expected less than half the sampling rate, {nyquist_hz} Hz"
    )]
    Corner { corner_hz: f64, nyquist_hz: f64 },
    #[error(
        "PGA {pga_g:.1} g and PGV {pgv_m_s:.1} m/s when scaled by {scale}; none as strong was ever recorded"
    )]
    Scaled { scale: f64, pga_g: f64, pgv_m_s: f64 },
}

/// An imported motion.
#[derive(Debug, Clone, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct ImportedMotion {
    /// The record under the name of the motion, without its samples.
    pub record: NamedRecord,
    pub scale: f64,
    /// Samples as written, m/s2.
    pub acceleration_m_s2: Vec<f32>,
    /// Intensity measures of these samples.
    pub measured: MotionMeasures,
    /// Peaks over all directions of the pair, before it is scaled.
    pub rotd: Option<RotD>,
    /// Pulse indicator; none if pulses were not searched.
    pub indicator: Option<PulseIndicator>,
    /// Pulse fitted to the record before it is scaled; none without a pulse.
    pub pulse: Option<FittedPulse>,
}

keywords! {
    /// Whether to search for pulses.
    #[expect(missing_docs, reason = "the words say it")]
    pub enum PulseSearch {
        Find = "find",
        Skip = "skip",
    }
}

/// Options of the processing.
#[derive(Debug, Clone, PartialEq)]
#[expect(missing_docs, reason = "the names say it")]
pub struct Processing {
    pub baseline: Baseline,
    /// Corner of a high-pass filter, Hz.
    pub high_pass_hz: Option<f64>,
    /// Another time step, s.
    pub resample_s: Option<f64>,
    /// Direction of pairs; none imports components one by one.
    pub direction: Option<Direction>,
    pub scaling: Scaling,
    pub pulses: PulseSearch,
    /// Whether implausible motions are imported, with a warning, or are errors.
    pub accept_implausible: bool,
    pub plan: MeasurePlan,
}

impl Processing {
    /// Processes a record.
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
            let nyquist_hz = 0.5 / motion.dt_s;
            if corner_hz >= nyquist_hz {
                return Err(ProcessingError::Corner { corner_hz, nyquist_hz });
            }
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

    /// Rotates two components to the chosen direction.
    fn rotated(&self, first: NamedRecord, second: NamedRecord) -> (NamedRecord, RotD) {
        let pair = HorizontalPair::new(first.motion, second.motion);
        let azimuth_deg = match self.direction {
            Some(Direction::Azimuth(azimuth_deg)) => azimuth_deg,
            Some(Direction::StrongestPulse) | None => {
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
            source: SourceFile {
                path: both(first.source.path, second.source.path),
                blake3: both(first.source.blake3, second.source.blake3),
            },
            doubts: [first.doubts, second.doubts].concat(),
            motion: RecordedMotion {
                acceleration_m_s2,
                component: Some(format!("{azimuth_deg:.1} deg of a pair")),
                azimuth_deg: Some(azimuth_deg),
                header_pga: None,
                ..pair.first
            },
        };
        (record, rotd)
    }

    /// Scales and measures a record: one motion for each factor.
    fn scaled(
        &self,
        mut record: NamedRecord,
        rotd: Option<RotD>,
    ) -> Result<Vec<ImportedMotion>, ProcessingError> {
        let NamedRecord { motion_id, motion, .. } = &record;
        let dt_s = motion.dt_s;
        let factors = self.scaling.factors(&motion.acceleration_m_s2, dt_s);
        if factors.is_empty() {
            return Err(ProcessingError::Zero);
        }
        let (indicator, pulse) = self.pulse_of(motion);
        let (motion_id, several) = (motion_id.clone(), factors.len() > 1);
        let samples = std::mem::take(&mut record.motion.acceleration_m_s2);
        let mut motions = Vec::new();
        for scale in factors {
            let acceleration_m_s2: Vec<f32> = samples.iter().map(|&a| (scale * a) as f32).collect();
            let written: Vec<f64> = acceleration_m_s2.iter().map(|&a| f64::from(a)).collect();
            if several {
                record.motion_id = format!("{motion_id} x{scale}");
            }
            let scaled = ImportedMotion {
                record: record.clone(),
                scale,
                measured: self.plan.measure(&written, dt_s, &mut Transforms::default()),
                acceleration_m_s2,
                rotd,
                indicator,
                pulse,
            };
            let MotionMeasures { pga_m_s2, pgv_m_s, .. } = scaled.measured;
            let pga_g = pga_m_s2 / G_M_S2;
            let is_too_strong = pga_g > STRONGEST_PGA_G || pgv_m_s > STRONGEST_PGV_M_S;
            if scale != 1.0 && is_too_strong && !self.accept_implausible {
                return Err(ProcessingError::Scaled { scale, pga_g, pgv_m_s });
            }
            motions.push(scaled);
        }
        Ok(motions)
    }

    /// Searches a record for a pulse, and fits it.
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
