//! From records to the motions that are imported of them: baseline, filter, time step, rotation, scale, measures, pulses.

use std::path::Path;

use super::plausibility::{self, Doubt};
use super::pulses::{FittedPulse, PulseIndicator, Verdict, WaveletScratch, strongest_direction};
use super::rotation::{Direction, HorizontalPair, RotD};
use super::signal::{Baseline, HighPass, HighPassScratch, Scaling, resample, resampled_length};
use super::{RecordedMotion, SaidUnit};
use crate::keyword::keywords;
use crate::motion::{IntensityScratch, LONGEST_MOTION, MeasurePlan, Measured, Suite, intensity};

/// A file, and the hash of what it holds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SourceFile {
    /// Path as given.
    pub path: String,
    /// BLAKE3, in hexadecimal digits.
    pub blake3: String,
}

/// A record with its name and its file.
#[derive(Debug, Clone, PartialEq)]
pub struct NamedRecord {
    /// Unique among all that are imported.
    pub motion_id: String,
    pub source: SourceFile,
    pub motion: RecordedMotion,
}

/// A file that cannot be imported, and why.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Refusal {
    /// Path as given.
    pub file: String,
    /// What was found in it, where the reason is one that others have too.
    pub found: Option<String>,
    /// What is wrong with it, and what to do.
    pub reason: String,
}

impl Refusal {
    /// Refuses a file for a reason.
    pub fn of(file: &Path, reason: &impl ToString) -> Refusal {
        Refusal::because(file.display().to_string(), reason.to_string())
    }

    /// Refuses the file of this name for a reason, which may begin with the name.
    pub fn because(file: String, reason: String) -> Refusal {
        let reason = reason.strip_prefix(&format!("{file}: ")).map_or(reason.clone(), str::to_string);
        Refusal { file, found: None, reason }
    }
}

/// A motion that is imported of a record, ready to be written.
#[derive(Debug, Clone, PartialEq)]
pub struct ImportedMotion {
    /// Unique in the file.
    pub motion_id: String,
    pub suite: Suite,
    /// The earthquake in the words of the file.
    pub event: Option<String>,
    /// The station in the words of the file.
    pub station: Option<String>,
    /// The component in the words of the file.
    pub component: Option<String>,
    /// Direction of positive acceleration, degrees clockwise from north.
    pub azimuth_deg: Option<f64>,
    pub source: SourceFile,
    /// The format of the file, in a word.
    pub format: &'static str,
    /// The unit that the samples had.
    pub unit: Option<SaidUnit>,
    /// Why it can hardly be a record, if it was accepted all the same.
    pub doubt: Option<Doubt>,
    /// The factor by which it is scaled.
    pub scale: f64,
    /// Time between samples, s.
    pub dt_s: f64,
    /// Samples, m/s2, as they are written.
    pub acceleration_m_s2: Vec<f32>,
    /// Intensity measures of these samples.
    pub measured: Measured,
    /// Peaks over all directions of the pair it is rotated from.
    pub rotd: Option<RotD>,
    /// Whether it holds a pulse, if that was looked for.
    pub indicator: Option<PulseIndicator>,
    /// The pulse that it holds.
    pub pulse: Option<FittedPulse>,
}

impl ImportedMotion {
    /// Joins earthquake, station and component; none if the file names none of them.
    pub fn name(&self) -> Option<String> {
        let parts: Vec<&str> =
            [&self.event, &self.station, &self.component].into_iter().flatten().map(String::as_str).collect();
        (!parts.is_empty()).then(|| parts.join(", "))
    }
}

/// Whether pulses are looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PulseSearch {
    Find,
    Skip,
}

keywords!(PulseSearch { Find = "find", Skip = "skip" });

/// The format of motions in a Parquet file.
pub const TABLE: &str = "parquet";

/// What becomes of motions that can hardly be those of an earthquake.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Implausible {
    Refuse,
    Accept,
}

/// What is done to records.
#[derive(Debug, Clone, PartialEq)]
pub struct Processing {
    pub baseline: Baseline,
    pub high_pass: Option<HighPass>,
    /// Another time step, s.
    pub resample_s: Option<f64>,
    /// Where pairs are rotated to; nowhere: motions are imported one by one.
    pub direction: Option<Direction>,
    pub scaling: Scaling,
    pub pulses: PulseSearch,
    /// Whether motions without their pulses are written too.
    pub residual: bool,
    pub implausible: Implausible,
    pub plan: MeasurePlan,
}

/// A record after baseline, filter and time step, and what is doubtful about it.
struct Processed {
    record: NamedRecord,
    doubt: Option<Doubt>,
}

/// What a thread keeps from one motion to the next.
#[derive(Default)]
pub struct Scratch {
    intensity: IntensityScratch,
    high_pass: HighPassScratch,
    wavelet: WaveletScratch,
}

/// What is known of the pulse of a motion before it is scaled.
#[derive(Debug, Clone, Copy, Default)]
struct Pulses {
    indicator: Option<PulseIndicator>,
    fitted: Option<FittedPulse>,
}

impl Processing {
    /// Processes a record.
    ///
    /// # Errors
    /// If it cannot be processed as asked.
    pub fn import(&self, record: NamedRecord, scratch: &mut Scratch) -> Result<Vec<ImportedMotion>, Refusal> {
        let processed = self.processed(record, scratch)?;
        self.scaled(&processed, None, scratch)
    }

    /// Processes two components at right angles, with their azimuths (degrees), into one motion.
    ///
    /// # Errors
    /// If one of them cannot be processed as asked.
    pub fn import_pair(
        &self,
        pair: [(NamedRecord, f64); 2],
        scratch: &mut Scratch,
    ) -> Result<Vec<ImportedMotion>, Refusal> {
        let (processed, rotd) = self.rotated(pair, scratch)?;
        self.scaled(&processed, Some(rotd), scratch)
    }

    /// Corrects the baseline, filters, judges and resamples.
    fn processed(&self, mut record: NamedRecord, scratch: &mut Scratch) -> Result<Processed, Refusal> {
        let motion = &mut record.motion;
        self.baseline.remove_from(&mut motion.acceleration_m_s2);
        if let Some(high_pass) = self.high_pass {
            high_pass.apply(&mut motion.acceleration_m_s2, motion.dt_s, &mut scratch.high_pass);
        }
        let doubt = plausibility::doubt(&motion.acceleration_m_s2, motion.dt_s);
        if let Some(Doubt { found, reason, is_impossible: true }) = &doubt
            && self.implausible == Implausible::Refuse
        {
            // One of many in a table goes by its name there.
            let row = motion.component.as_ref().filter(|_| motion.format == TABLE);
            return Err(Refusal {
                file: record.source.path,
                found: Some(row.map_or(found.clone(), |name| format!("{name}: {found}"))),
                reason: format!("{reason} (--accept-implausible imports it anyway)"),
            });
        }
        if let Some(dt_s) = self.resample_s {
            let samples = resampled_length(motion.acceleration_m_s2.len(), motion.dt_s, dt_s);
            if !(2.0..=LONGEST_MOTION as f64).contains(&samples) {
                let reason =
                    format!("{samples} samples at a time step of {dt_s} s; choose another for --resample");
                return Err(Refusal::because(record.source.path, reason));
            }
            motion.acceleration_m_s2 = resample(&motion.acceleration_m_s2, motion.dt_s, dt_s);
            motion.dt_s = dt_s;
        }
        Ok(Processed { record, doubt })
    }

    /// Processes two components and rotates them to the direction asked for.
    fn rotated(
        &self,
        pair: [(NamedRecord, f64); 2],
        scratch: &mut Scratch,
    ) -> Result<(Processed, RotD), Refusal> {
        let [(first, first_deg), (second, second_deg)] = pair;
        let (first, second) = (self.processed(first, scratch)?, self.processed(second, scratch)?);
        let doubt = first.doubt.or(second.doubt);
        let (first, second) = (first.record, second.record);
        let accelerations = [first.motion.acceleration_m_s2, second.motion.acceleration_m_s2];
        let pair = HorizontalPair::new(first.motion.dt_s, [first_deg, second_deg], accelerations);
        let azimuth_deg = match self.direction {
            Some(Direction::Azimuth(azimuth_deg)) => azimuth_deg,
            Some(Direction::StrongestPulse) | None => {
                let velocities = pair.accelerations().each_ref().map(|a| intensity::velocity(a, pair.dt_s()));
                let parts = strongest_direction(
                    velocities.each_ref().map(Vec::as_slice),
                    pair.dt_s(),
                    &mut scratch.wavelet,
                );
                pair.azimuth_of(parts.unwrap_or([1.0, 0.0]))
            }
        };
        let both = |a: String, b: String| if a == b { a } else { format!("{a}; {b}") };
        let record = NamedRecord {
            motion_id: format!("{}+{}", first.motion_id, second.motion_id),
            source: SourceFile {
                path: both(first.source.path, second.source.path),
                blake3: both(first.source.blake3, second.source.blake3),
            },
            motion: RecordedMotion {
                dt_s: pair.dt_s(),
                acceleration_m_s2: pair.towards(azimuth_deg),
                component: Some(format!("{azimuth_deg:.1} deg of a pair")),
                azimuth_deg: Some(azimuth_deg),
                header_pga: None,
                ..first.motion
            },
        };
        Ok((Processed { record, doubt }, pair.rotd()))
    }

    /// Scales and measures a processed record: one motion for each factor, each followed by its residual if that is asked for.
    ///
    /// # Errors
    /// If it cannot be scaled as asked.
    fn scaled(
        &self,
        processed: &Processed,
        rotd: Option<RotD>,
        scratch: &mut Scratch,
    ) -> Result<Vec<ImportedMotion>, Refusal> {
        let Processed { record, doubt } = processed;
        let RecordedMotion { dt_s, ref acceleration_m_s2, .. } = record.motion;
        let factors = self.scaling.factors(acceleration_m_s2, dt_s);
        if factors.is_empty() {
            let reason = "the motion is zero throughout; it cannot be scaled to a peak".to_string();
            return Err(Refusal::because(record.source.path.clone(), reason));
        }
        let pulses = self.pulses(&record.motion, scratch);
        let several = factors.len() > 1;
        let motions = factors.into_iter().flat_map(|factor| {
            let id = record.motion_id.clone();
            let motion_id = if several { format!("{id} x{factor}") } else { id };
            let scaled = self.scaled_by(factor, record, motion_id, rotd, pulses, scratch);
            let motion = ImportedMotion { doubt: doubt.clone(), ..scaled };
            let residual = self.residual(&motion, scratch);
            [Some(motion), residual].into_iter().flatten()
        });
        Ok(motions.collect())
    }

    fn pulses(&self, motion: &RecordedMotion, scratch: &mut Scratch) -> Pulses {
        if self.pulses == PulseSearch::Skip {
            return Pulses::default();
        }
        let velocity = intensity::velocity(&motion.acceleration_m_s2, motion.dt_s);
        let indicator = PulseIndicator::of(&velocity, motion.dt_s, &mut scratch.wavelet);
        let fitted = indicator
            .filter(|found| found.verdict == Verdict::Pulse)
            .and_then(|found| FittedPulse::fit(&velocity, motion.dt_s, found.period_s, found.centre_s));
        Pulses { indicator, fitted }
    }

    fn scaled_by(
        &self,
        factor: f64,
        record: &NamedRecord,
        motion_id: String,
        rotd: Option<RotD>,
        pulses: Pulses,
        scratch: &mut Scratch,
    ) -> ImportedMotion {
        let motion = &record.motion;
        let acceleration_m_s2: Vec<f32> =
            motion.acceleration_m_s2.iter().map(|&a| (factor * a) as f32).collect();
        ImportedMotion {
            motion_id,
            suite: Suite::Record,
            event: motion.event.clone(),
            station: motion.station.clone(),
            component: motion.component.clone(),
            azimuth_deg: motion.azimuth_deg,
            source: record.source.clone(),
            format: motion.format,
            unit: motion.unit,
            doubt: None,
            scale: factor,
            dt_s: motion.dt_s,
            measured: self.measured(&acceleration_m_s2, motion.dt_s, scratch),
            acceleration_m_s2,
            rotd: rotd.map(|rotd| rotd.scaled(factor)),
            indicator: pulses.indicator,
            pulse: pulses.fitted.map(|fitted| fitted.scaled(factor)),
        }
    }

    /// Makes the same motion without its pulse, if it has one and that is asked for.
    fn residual(&self, motion: &ImportedMotion, scratch: &mut Scratch) -> Option<ImportedMotion> {
        let FittedPulse { pulse, t0_s, .. } = motion.pulse.filter(|_| self.residual)?;
        let without = |(k, &a): (usize, &f32)| {
            (f64::from(a) - pulse.acceleration_m_s2(k as f64 * motion.dt_s - t0_s)) as f32
        };
        let acceleration_m_s2: Vec<f32> = motion.acceleration_m_s2.iter().enumerate().map(without).collect();
        Some(ImportedMotion {
            motion_id: format!("{} residual", motion.motion_id),
            suite: Suite::Residual,
            measured: self.measured(&acceleration_m_s2, motion.dt_s, scratch),
            acceleration_m_s2,
            rotd: None,
            indicator: None,
            pulse: None,
            doubt: None,
            ..motion.clone()
        })
    }

    /// Measures samples as they will be read: in single precision.
    fn measured(&self, samples: &[f32], dt_s: f64, scratch: &mut Scratch) -> Measured {
        let written: Vec<f64> = samples.iter().map(|&a| f64::from(a)).collect();
        self.plan.measure(&written, dt_s, &mut scratch.intensity)
    }
}
