use crate::plausibility::{LARGEST_M_S2, TIME_STEPS_S};

/// Rounding error of a time over the step between samples.
const ROUNDING: f64 = 1e-9;

/// A ground acceleration sampled at a constant step: linear between samples, zero after the last one.
#[derive(Debug, Clone, Copy)]
pub struct Record<'a> {
    acceleration_m_s2: &'a [f64],
    dt_s: f64,
    peak_m_s2: f64,
}

/// An invalid record. `sample` counts from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RecordError {
    #[error("dt_s is {0}; expected a time step above 0 s, from 1e-6 to 10")]
    TimeStep(f64),
    #[error("{0} sample(s) of acceleration; expected 2 or more")]
    TooShort(usize),
    #[error("sample {sample} of the acceleration is {value}; expected a finite number in m/s2")]
    NotFinite { sample: usize, value: f64 },
    #[error(
        "sample {sample} of the acceleration is {value} m/s2; expected 10000 at most: is the unit right?"
    )]
    TooLarge { sample: usize, value: f64 },
}

impl<'a> Record<'a> {
    /// # Errors
    /// If the time step is not in [1e-6, 10] s, or samples are fewer than 2, not finite or above 1e4 m/s2.
    pub fn new(acceleration_m_s2: &'a [f64], dt_s: f64) -> Result<Record<'a>, RecordError> {
        if !TIME_STEPS_S.contains(&dt_s) {
            return Err(RecordError::TimeStep(dt_s));
        }
        if acceleration_m_s2.len() < 2 {
            return Err(RecordError::TooShort(acceleration_m_s2.len()));
        }
        // Infinite or NaN if any sample is: their bits exceed those of all finite numbers.
        let peak_m_s2 =
            acceleration_m_s2.iter().map(|value| value.abs().to_bits()).max().map_or(0.0, f64::from_bits);
        let accepted = -LARGEST_M_S2..=LARGEST_M_S2;
        if !accepted.contains(&peak_m_s2) {
            let refused = |value: &f64| !accepted.contains(value);
            let sample = acceleration_m_s2.iter().position(refused).unwrap_or_default();
            let value = acceleration_m_s2[sample];
            return Err(match value.is_finite() {
                true => RecordError::TooLarge { sample, value },
                false => RecordError::NotFinite { sample, value },
            });
        }
        Ok(Record { acceleration_m_s2, dt_s, peak_m_s2 })
    }

    pub fn peak_m_s2(&self) -> f64 {
        self.peak_m_s2
    }

    pub fn acceleration_m_s2(&self) -> &'a [f64] {
        self.acceleration_m_s2
    }

    pub fn dt_s(&self) -> f64 {
        self.dt_s
    }

    /// Interpolates the acceleration (m/s2) at a time (s) from the first sample; zero outside the record.
    pub fn acceleration_at(&self, time_s: f64) -> f64 {
        let position = time_s / self.dt_s;
        let before = position.floor().max(0.0) as usize;
        match self.acceleration_m_s2.get(before..) {
            Some([a, b, ..]) => a + (b - a) * (position - before as f64),
            Some([last]) if position - (before as f64) < ROUNDING => *last,
            _ => 0.0,
        }
    }

    /// Follows the motion of the ground through rising times (s), which include all samples between the first
    /// and the last of them: by trapezoids, exact for what is linear between samples. The ground is at rest
    /// at the first time, and keeps its velocity after the record.
    pub fn ground_at(&self, times_s: impl IntoIterator<Item = f64>) -> Vec<Ground> {
        let (mut ground, mut before_s): (Vec<Ground>, f64) = (Vec::new(), 0.0);
        let end_s = (self.acceleration_m_s2.len() - 1) as f64 * self.dt_s;
        for time_s in times_s {
            let acceleration_m_s2 = self.acceleration_at(time_s);
            let velocity_m_s = ground.last().map_or(0.0, |before| {
                let is_after = before_s >= end_s;
                let mean = if is_after { 0.0 } else { 0.5 * (before.acceleration_m_s2 + acceleration_m_s2) };
                before.velocity_m_s + mean * (time_s - before_s)
            });
            ground.push(Ground { acceleration_m_s2, velocity_m_s });
            before_s = time_s;
        }
        ground
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ground {
    pub acceleration_m_s2: f64,
    pub velocity_m_s: f64,
}
