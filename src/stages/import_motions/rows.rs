//! From a processed motion to rows of the motions file: scaling, measures, pulses.

use super::inputs::Found;
use super::options::PulseSearch;
use super::processing::{Processing, Scratch};
use super::refusals::Refusal;
use crate::motion::processing::RotD;
use crate::motion::pulse_fit::FittedPulse;
use crate::motion::pulse_indicator::{PulseIndicator, Verdict};
use crate::motion::records::RecordedMotion;
use crate::motion::{Measured, Suite, intensity};
use crate::table::records::RecordRow;

/// The pulse of a motion before it is scaled.
#[derive(Debug, Clone, Copy, Default)]
struct Pulses {
    indicator: Option<PulseIndicator>,
    fitted: Option<FittedPulse>,
}

impl Processing {
    /// The rows of a processed motion, one for each factor, and its residuals.
    ///
    /// # Errors
    /// If it cannot be scaled as asked.
    pub(super) fn scaled(
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
