//! Intensity measures of a ground acceleration (m/s2), whatever it comes from.

mod energy;
mod fourier;
mod plan;
mod spectral;

pub use energy::{arias_intensity, cumulative_absolute_velocity, significant_duration};
use energy::{arias_of, moment, running_energy};
pub use fourier::{IntensityScratch, mean_period};
pub use plan::{MeasurePlan, Measured};
pub use spectral::{housner_intensity, spectral_acceleration};

/// Measures of one motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measures {
    /// Peak ground acceleration, m/s2.
    pub pga_m_s2: f64,
    /// Peak ground velocity, m/s.
    pub pgv_m_s: f64,
    /// Peak ground displacement, m.
    pub pgd_m: f64,
    /// Mean period, s; none where there is no energy between 0.25 and 20 Hz.
    pub tm_s: Option<f64>,
    /// Arias intensity, m/s.
    pub arias_m_s: f64,
    /// Cumulative absolute velocity, m/s.
    pub cav_m_s: f64,
    /// Significant duration, 5 to 75 %, s.
    pub d5_75_s: f64,
    /// Significant duration, 5 to 95 %, s.
    pub d5_95_s: f64,
}

/// All measures of a motion of these samples (m/s2), `dt_s` apart.
pub fn measures(acceleration: &[f64], dt_s: f64, scratch: &mut IntensityScratch) -> Measures {
    let passage = Passage::through(acceleration, dt_s);
    let energy = &mut scratch.energy;
    energy.clear();
    energy.extend(running_energy(acceleration, dt_s));
    let arias_m_s = arias_of(energy.last().copied().unwrap_or_default());
    let [d5, d75, d95] = [0.05, 0.75, 0.95].map(|share| moment(energy, dt_s, share));
    Measures {
        pga_m_s2: peak(acceleration),
        pgv_m_s: passage.pgv_m_s,
        pgd_m: passage.pgd_m,
        tm_s: mean_period(acceleration, dt_s, scratch),
        arias_m_s,
        cav_m_s: passage.cav_m_s,
        d5_75_s: d75 - d5,
        d5_95_s: d95 - d5,
    }
}

/// Trapezoidal integrals of a motion up to a sample, and the peaks so far: all in one pass.
#[derive(Default)]
struct Passage {
    velocity_m_s: f64,
    displacement_m: f64,
    pgv_m_s: f64,
    pgd_m: f64,
    cav_m_s: f64,
}

impl Passage {
    fn through(acceleration: &[f64], dt_s: f64) -> Passage {
        acceleration.windows(2).fold(Passage::default(), |before, pair| {
            let velocity_m_s = before.velocity_m_s + 0.5 * dt_s * (pair[0] + pair[1]);
            let displacement_m = before.displacement_m + 0.5 * dt_s * (before.velocity_m_s + velocity_m_s);
            Passage {
                velocity_m_s,
                displacement_m,
                pgv_m_s: before.pgv_m_s.max(velocity_m_s.abs()),
                pgd_m: before.pgd_m.max(displacement_m.abs()),
                cav_m_s: before.cav_m_s + 0.5 * dt_s * (pair[0].abs() + pair[1].abs()),
            }
        })
    }
}

/// The largest absolute value.
pub fn peak(series: &[f64]) -> f64 {
    series.iter().fold(0.0, |largest, value| value.abs().max(largest))
}

/// Ground velocity (m/s): the trapezoidal integral, 0 at the first sample.
pub fn velocity(acceleration: &[f64], dt_s: f64) -> Vec<f64> {
    let steps = acceleration.windows(2).map(|pair| 0.5 * dt_s * (pair[0] + pair[1]));
    let rest = steps.scan(0.0, |sum, step| {
        *sum += step;
        Some(*sum)
    });
    acceleration.first().map(|_| 0.0).into_iter().chain(rest).collect()
}
