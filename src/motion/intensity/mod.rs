//! Intensity measures of a ground acceleration (m/s2), whatever it comes from.

mod energy;
mod fourier;
mod plan;
mod spectral;

pub use energy::{arias_intensity, cumulative_absolute_velocity, significant_duration};
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
    let velocity = velocity(acceleration, dt_s);
    let displacement = integral(&velocity, dt_s);
    let [d5_75_s, d5_95_s] = [0.75, 0.95].map(|end| significant_duration(acceleration, dt_s, 0.05, end));
    Measures {
        pga_m_s2: peak(acceleration),
        pgv_m_s: peak(&velocity),
        pgd_m: peak(&displacement),
        tm_s: mean_period(acceleration, dt_s, scratch),
        arias_m_s: arias_intensity(acceleration, dt_s),
        cav_m_s: cumulative_absolute_velocity(acceleration, dt_s),
        d5_75_s,
        d5_95_s,
    }
}

/// The largest absolute value.
pub fn peak(series: &[f64]) -> f64 {
    series.iter().fold(0.0, |largest, value| value.abs().max(largest))
}

/// Ground velocity (m/s): the trapezoidal integral, 0 at the first sample.
pub fn velocity(acceleration: &[f64], dt_s: f64) -> Vec<f64> {
    integral(acceleration, dt_s)
}

fn integral(series: &[f64], dt_s: f64) -> Vec<f64> {
    let mut sum = 0.0;
    let mut last = series.first().copied().unwrap_or(0.0);
    let next = |&value: &f64| {
        sum += 0.5 * dt_s * (last + value);
        last = value;
        sum
    };
    let mut integral: Vec<f64> = series.iter().map(next).collect();
    // The first step above has no length: its sum is a sample's own, not an area.
    let first = integral.first().copied().unwrap_or(0.0);
    integral.iter_mut().for_each(|value| *value -= first);
    integral
}
