//! What is done to records before they become rows: baseline, filter, time step, rotation.

use super::direction::Direction;
use super::inputs::Found;
use super::options::PulseSearch;
use super::refusals::Refusal;
use crate::motion::processing::{
    Baseline, HighPass, HighPassScratch, HorizontalPair, RotD, Scaling, resample, resampled_length,
};
use crate::motion::pulse_indicator::strongest_direction;
use crate::motion::records::RecordedMotion;
use crate::motion::wavelet::WaveletScratch;
use crate::motion::{IntensityScratch, MeasurePlan, intensity};
use crate::table::columns::LONGEST_MOTION;
use crate::table::records::{RecordRow, Source};

/// What is done to records.
#[derive(Debug, Clone, PartialEq)]
pub struct Processing {
    /// What is removed.
    pub baseline: Baseline,
    /// The filter.
    pub high_pass: Option<HighPass>,
    /// Another time step, s.
    pub resample_s: Option<f64>,
    /// Where pairs are rotated to.
    pub direction: Option<Direction>,
    /// By how much motions are scaled.
    pub scaling: Scaling,
    /// Whether pulses are looked for.
    pub pulses: PulseSearch,
    /// Whether motions without their pulses are written too.
    pub residual: bool,
    /// Which measures are taken.
    pub plan: MeasurePlan,
}

/// What a thread keeps from one motion to the next.
#[derive(Default)]
pub struct Scratch {
    /// For measures.
    pub intensity: IntensityScratch,
    /// For the filter.
    pub high_pass: HighPassScratch,
    /// For pulses.
    pub wavelet: WaveletScratch,
}

impl Processing {
    /// The rows of a motion.
    ///
    /// # Errors
    /// If it cannot be processed as asked.
    pub fn rows(&self, found: Found, scratch: &mut Scratch) -> Result<Vec<RecordRow>, Refusal> {
        let found = self.processed(found, scratch)?;
        self.scaled(&found, None, scratch)
    }

    /// The rows of two components at right angles with their azimuths, degrees.
    ///
    /// # Errors
    /// If one of them cannot be processed as asked.
    pub fn rows_of_pair(
        &self,
        pair: [(Found, f64); 2],
        scratch: &mut Scratch,
    ) -> Result<Vec<RecordRow>, Refusal> {
        let (found, rotd) = self.rotated(pair, scratch)?;
        self.scaled(&found, Some(rotd), scratch)
    }

    fn processed(&self, mut found: Found, scratch: &mut Scratch) -> Result<Found, Refusal> {
        let motion = &mut found.motion;
        self.baseline.remove_from(&mut motion.acceleration_m_s2);
        if let Some(high_pass) = self.high_pass {
            high_pass.apply(&mut motion.acceleration_m_s2, motion.dt_s, &mut scratch.high_pass);
        }
        if let Some(dt_s) = self.resample_s {
            let samples = resampled_length(motion.acceleration_m_s2.len(), motion.dt_s, dt_s);
            if !(2.0..=LONGEST_MOTION as f64).contains(&samples) {
                let reason =
                    format!("{samples} samples at a time step of {dt_s} s; choose another for --resample");
                return Err(Refusal { file: found.source.file, reason });
            }
            motion.acceleration_m_s2 = resample(&motion.acceleration_m_s2, motion.dt_s, dt_s);
            motion.dt_s = dt_s;
        }
        Ok(found)
    }

    fn rotated(&self, pair: [(Found, f64); 2], scratch: &mut Scratch) -> Result<(Found, RotD), Refusal> {
        let [(first, first_deg), (second, second_deg)] = pair;
        let (first, second) = (self.processed(first, scratch)?, self.processed(second, scratch)?);
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
        let found = Found {
            motion_id: format!("{}+{}", first.motion_id, second.motion_id),
            source: Source {
                file: both(first.source.file, second.source.file),
                blake3: both(first.source.blake3, second.source.blake3),
            },
            motion: RecordedMotion {
                dt_s: pair.dt_s(),
                acceleration_m_s2: pair.towards(azimuth_deg),
                component: Some(format!("{azimuth_deg:.1} deg of a pair")),
                azimuth_deg: Some(azimuth_deg),
                header_pga: None,
                event: first.motion.event,
                station: first.motion.station,
            },
        };
        Ok((found, pair.rotd()))
    }
}
