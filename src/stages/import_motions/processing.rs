//! From what a file holds to rows of the motions file: processing, rotation, scaling, measures, pulses.

use super::direction::Direction;
use super::inputs::Found;
use super::options::PulseSearch;
use super::refusals::Refusal;
use crate::motion::processing::{
    Baseline, HighPass, HighPassScratch, HorizontalPair, RotD, Scaling, resample, resampled_length,
};
use crate::motion::pulse_fit::FittedPulse;
use crate::motion::pulse_indicator::{PulseIndicator, Verdict, strongest_direction};
use crate::motion::records::RecordedMotion;
use crate::motion::wavelet::WaveletScratch;
use crate::motion::{IntensityScratch, MeasurePlan, Measured, Suite, intensity};
use crate::table::records::{RecordRow, Source};

/// More samples than this are a slip of the finger.
const MOST_SAMPLES: f64 = 50_000_000.0;

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
    intensity: IntensityScratch,
    high_pass: HighPassScratch,
    wavelet: WaveletScratch,
}

/// The pulse of a motion before it is scaled.
#[derive(Debug, Clone, Copy, Default)]
struct Pulses {
    indicator: Option<PulseIndicator>,
    fitted: Option<FittedPulse>,
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

    fn scaled(
        &self,
        found: &Found,
        rotd: Option<RotD>,
        scratch: &mut Scratch,
    ) -> Result<Vec<RecordRow>, Refusal> {
        let RecordedMotion { dt_s, ref acceleration_m_s2, .. } = found.motion;
        let factors = self.scaling.factors(acceleration_m_s2, dt_s);
        if factors.is_empty() {
            let reason = "the motion is zero throughout; it cannot be scaled to a peak".to_string();
            return Err(Refusal { file: found.source.file.clone(), reason });
        }
        let pulses = self.pulses(&found.motion, scratch);
        let several = factors.len() > 1;
        let rows = factors.into_iter().flat_map(|factor| {
            let id = found.motion_id.clone();
            let motion_id = if several { format!("{id} x{factor}") } else { id };
            let row = self.row(found, motion_id, factor, rotd, pulses, scratch);
            let residual = self.residual(&row, scratch);
            [Some(row), residual].into_iter().flatten()
        });
        Ok(rows.collect())
    }

    fn processed(&self, mut found: Found, scratch: &mut Scratch) -> Result<Found, Refusal> {
        let motion = &mut found.motion;
        self.baseline.remove_from(&mut motion.acceleration_m_s2);
        if let Some(high_pass) = self.high_pass {
            high_pass.apply(&mut motion.acceleration_m_s2, motion.dt_s, &mut scratch.high_pass);
        }
        if let Some(dt_s) = self.resample_s {
            let samples = resampled_length(motion.acceleration_m_s2.len(), motion.dt_s, dt_s);
            if !(2.0..=MOST_SAMPLES).contains(&samples) {
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

    fn pulses(&self, motion: &RecordedMotion, scratch: &mut Scratch) -> Pulses {
        if self.pulses == PulseSearch::Skip {
            return Pulses::default();
        }
        let velocity = intensity::velocity(&motion.acceleration_m_s2, motion.dt_s);
        let indicator = PulseIndicator::of(&velocity, motion.dt_s, &mut scratch.wavelet);
        let fitted = indicator
            .filter(|found| found.verdict == Verdict::Pulse)
            .and_then(|found| FittedPulse::to(&velocity, motion.dt_s, found.period_s, found.centre_s));
        Pulses { indicator, fitted }
    }

    fn row(
        &self,
        found: &Found,
        motion_id: String,
        factor: f64,
        rotd: Option<RotD>,
        pulses: Pulses,
        scratch: &mut Scratch,
    ) -> RecordRow {
        let motion = &found.motion;
        let acceleration_m_s2: Vec<f32> =
            motion.acceleration_m_s2.iter().map(|&a| (factor * a) as f32).collect();
        RecordRow {
            motion_id,
            suite: Suite::Record,
            event: motion.event.clone(),
            station: motion.station.clone(),
            component: motion.component.clone(),
            azimuth_deg: motion.azimuth_deg,
            source: found.source.clone(),
            scale: factor,
            dt_s: motion.dt_s,
            measured: self.measured(&acceleration_m_s2, motion.dt_s, scratch),
            acceleration_m_s2,
            rotd: rotd.map(|rotd| rotd.scaled(factor)),
            indicator: pulses.indicator,
            pulse: pulses.fitted.map(|fitted| fitted.scaled(factor)),
        }
    }

    /// The same motion without its pulse, if it has one and that is asked for.
    fn residual(&self, row: &RecordRow, scratch: &mut Scratch) -> Option<RecordRow> {
        let FittedPulse { pulse, t0_s, .. } = row.pulse.filter(|_| self.residual)?;
        let without = |(k, &a): (usize, &f32)| {
            (f64::from(a) - pulse.acceleration_m_s2(k as f64 * row.dt_s - t0_s)) as f32
        };
        let acceleration_m_s2: Vec<f32> = row.acceleration_m_s2.iter().enumerate().map(without).collect();
        Some(RecordRow {
            motion_id: format!("{} residual", row.motion_id),
            suite: Suite::Residual,
            measured: self.measured(&acceleration_m_s2, row.dt_s, scratch),
            acceleration_m_s2,
            rotd: None,
            indicator: None,
            pulse: None,
            ..row.clone()
        })
    }

    /// The measures of samples as they will be read.
    fn measured(&self, samples: &[f32], dt_s: f64, scratch: &mut Scratch) -> Measured {
        let written: Vec<f64> = samples.iter().map(|&a| f64::from(a)).collect();
        self.plan.measure(&written, dt_s, &mut scratch.intensity)
    }
}
