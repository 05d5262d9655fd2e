//! Intensity measures of a ground acceleration (m/s2), whatever it comes from.

mod energy;
mod fourier;
mod plan;
mod spectral;

pub use energy::{arias_intensity, cumulative_absolute_velocity, significant_duration};
use energy::{arias_of, moment};
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

/// Trapezoidal integrals of a motion up to a sample, and the peaks so far: all in one pass, since each waits for its own last
/// value.
#[derive(Default)]
struct Passage {
    velocity_m_s: f64,
    displacement_m: f64,
    energy: f64,
    pga_m_s2: f64,
    pgv_m_s: f64,
    pgd_m: f64,
    cav_m_s: f64,
}

impl Passage {
    /// With the integral of a^2 to each sample, of which the first is 0, m2/s3.
    fn through(acceleration: &[f64], dt_s: f64, energy: &mut [f64]) -> Passage {
        let mut p = Passage { pga_m_s2: acceleration.first().map_or(0.0, |a| a.abs()), ..Passage::default() };
        for (pair, energy) in acceleration.windows(2).zip(energy.iter_mut().skip(1)) {
            let velocity_m_s = p.velocity_m_s + trapezoid(dt_s, pair[0], pair[1]);
            p.displacement_m += trapezoid(dt_s, p.velocity_m_s, velocity_m_s);
            p.velocity_m_s = velocity_m_s;
            p.energy += trapezoid(dt_s, pair[0] * pair[0], pair[1] * pair[1]);
            *energy = p.energy;
            p.pga_m_s2 = larger(p.pga_m_s2, pair[1].abs());
            p.pgv_m_s = larger(p.pgv_m_s, velocity_m_s.abs());
            p.pgd_m = larger(p.pgd_m, p.displacement_m.abs());
            p.cav_m_s += trapezoid(dt_s, pair[0].abs(), pair[1].abs());
        }
        p
    }
}

/// The integral between two samples.
fn trapezoid(dt_s: f64, left: f64, right: f64) -> f64 {
    0.5 * dt_s * (left + right)
}

/// The larger of two numbers, in one instruction: the maximum of the standard library asks for NaN too.
fn larger(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}

/// The largest absolute value.
pub fn peak(series: &[f64]) -> f64 {
    series.iter().fold(0.0, |largest, value| larger(largest, value.abs()))
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
