//! Intensity measures of a ground acceleration (m/s2), whatever it comes from.

mod energy;
mod fourier;
mod passage;
mod plan;
mod spectral;

pub use energy::{arias_intensity, cumulative_absolute_velocity, significant_duration};
use energy::{arias_of, moment};
pub use fourier::{IntensityScratch, mean_period};
use passage::Passage;
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
    let energy = &mut scratch.energy;
    energy.clear();
    energy.resize(acceleration.len(), 0.0);
    let passage = Passage::through(acceleration, dt_s, energy);
    let arias_m_s = arias_of(energy.last().copied().unwrap_or_default());
    let [d5, d75, d95] = [0.05, 0.75, 0.95].map(|share| moment(energy, dt_s, share));
    Measures {
        pga_m_s2: passage.pga_m_s2,
        pgv_m_s: passage.pgv_m_s,
        pgd_m: passage.pgd_m,
        tm_s: mean_period(acceleration, dt_s, scratch),
        arias_m_s,
        cav_m_s: passage.cav_m_s,
        d5_75_s: d75 - d5,
        d5_95_s: d95 - d5,
    }
}

/// The integral between two samples.
#[inline(always)]
fn trapezoid(dt_s: f64, left: f64, right: f64) -> f64 {
    0.5 * dt_s * (left + right)
}

/// The larger of two numbers, in one instruction: the maximum of the standard library asks for NaN too.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}

/// The largest absolute value.
#[inline(always)]
pub fn peak(series: &[f64]) -> f64 {
    const LANES: usize = 8;
    let (eights, rest) = series.as_chunks::<LANES>();
    let mut largest = [0.0; LANES];
    for eight in eights {
        for lane in 0..LANES {
            largest[lane] = larger(largest[lane], eight[lane].abs());
        }
    }
    largest.iter().chain(rest).fold(0.0, |largest, value| larger(largest, value.abs()))
}

/// Ground velocity (m/s): the trapezoidal integral, 0 at the first sample.
pub fn velocity(acceleration: &[f64], dt_s: f64) -> Vec<f64> {
    let steps = acceleration.windows(2).map(|pair| trapezoid(dt_s, pair[0], pair[1]));
    let rest = steps.scan(0.0, |sum, step| {
        *sum += step;
        Some(*sum)
    });
    acceleration.first().map(|_| 0.0).into_iter().chain(rest).collect()
}
