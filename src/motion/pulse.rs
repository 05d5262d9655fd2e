//! The pulse of Mavroeidis & Papageorgiou (2003), Eq. 1.

use std::f64::consts::PI;

use super::circle::{EqualSteps, STRIDE};
use super::scenario::Scenario;
use crate::wide::widest;

/// A velocity pulse: a cosine under a raised-cosine envelope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulse {
    /// Amplitude A of Eq. 1, m/s; the largest velocity is A times [`largest_velocity`].
    pub amplitude_m_s: f64,
    /// Period Tp, s.
    pub tp_s: f64,
    /// Number of half cycles.
    pub gamma: f64,
    /// Phase, rad.
    pub nu_rad: f64,
}

impl Pulse {
    /// The pulse whose largest velocity is the Vp of the scenario.
    pub fn of(scenario: &Scenario) -> Pulse {
        let Scenario { vp_m_s, tp_s, gamma, nu_rad, .. } = *scenario;
        Pulse { amplitude_m_s: vp_m_s / largest_velocity(gamma, nu_rad), tp_s, gamma, nu_rad }
    }

    /// How long it lasts: gamma Tp, s.
    pub fn duration_s(&self) -> f64 {
        self.gamma * self.tp_s
    }

    /// Ground velocity, m/s, at a time (s) from the middle of the pulse (Eq. 1).
    pub fn velocity_m_s(&self, time_s: f64) -> f64 {
        self.phase(time_s).map_or(0.0, |x| self.amplitude_m_s * unit_velocity(x, self.gamma, self.nu_rad))
    }

    /// Ground acceleration, m/s2, at a time (s) from the middle of the pulse: the derivative of Eq. 1.
    pub fn acceleration_m_s2(&self, time_s: f64) -> f64 {
        let wp = 2.0 * PI / self.tp_s;
        self.phase(time_s)
            .map_or(0.0, |x| self.amplitude_m_s * wp * unit_acceleration(x, self.gamma, self.nu_rad))
    }

    /// Ground acceleration (m/s2) of a motion of `samples` samples, `dt_s` apart, with the middle of the pulse at `epoch_s`.
    pub fn sample(&self, dt_s: f64, epoch_s: f64, samples: usize, acceleration_m_s2: &mut Vec<f64>) {
        let (wp, gamma, half_s) = (2.0 * PI / self.tp_s, self.gamma, 0.5 * self.duration_s());
        let first = (((epoch_s - half_s) / dt_s).ceil().max(0.0) as usize).min(samples);
        let last = (((epoch_s + half_s) / dt_s).floor() as usize + 1).clamp(first, samples);
        let x = wp * (first as f64 * dt_s - epoch_s);
        let envelope = EqualSteps::new(x / gamma, wp * dt_s / gamma);
        let carrier = EqualSteps::new(x + self.nu_rad, wp * dt_s);
        let scale = self.amplitude_m_s * wp;
        acceleration_m_s2.clear();
        acceleration_m_s2.resize(samples, 0.0);
        widest(
            #[inline(always)]
            || {
                for (stride, samples) in acceleration_m_s2[first..last].chunks_mut(STRIDE).enumerate() {
                    let (envelope, carrier) = (envelope.stride(stride), carrier.stride(stride));
                    for (k, sample) in samples.iter_mut().enumerate() {
                        let (envelope, carrier) =
                            ((envelope.sin[k], envelope.cos[k]), (carrier.sin[k], carrier.cos[k]));
                        *sample = scale * slope(envelope, carrier, gamma);
                    }
                }
            },
        );
    }

    /// x = wp (t - t0) inside the pulse.
    fn phase(&self, time_s: f64) -> Option<f64> {
        let x = 2.0 * PI / self.tp_s * time_s;
        (x.abs() <= PI * self.gamma).then_some(x)
    }
}

/// v / A of Eq. 1 as a function of x = wp (t - t0).
fn unit_velocity(x: f64, gamma: f64, nu: f64) -> f64 {
    0.5 * (1.0 + libm::cos(x / gamma)) * libm::cos(x + nu)
}

/// dv/dx / A.
fn unit_acceleration(x: f64, gamma: f64, nu: f64) -> f64 {
    slope(libm::sincos(x / gamma), libm::sincos(x + nu), gamma)
}

/// dv/dx / A of the sines and cosines of x / gamma and x + nu.
#[inline(always)]
fn slope((sin, cos): (f64, f64), (carrier_sin, carrier_cos): (f64, f64), gamma: f64) -> f64 {
    -0.5 / gamma * (sin * carrier_cos + gamma * (1.0 + cos) * carrier_sin)
}

/// F(gamma, nu): the largest |v| / A of a pulse.
///
/// Velocities peak where the acceleration changes sign; a scan brackets each such place and bisection finds it.
pub fn largest_velocity(gamma: f64, nu: f64) -> f64 {
    let end = PI * gamma;
    // Eight points in a half cycle separate the peaks, which are a half cycle apart.
    let points = (8.0 * (gamma + 1.0)).ceil() as usize * 2;
    let at = |k: usize| -end + 2.0 * end * k as f64 / points as f64;
    let velocity = |x: f64| unit_velocity(x, gamma, nu).abs();
    let rises = |x: f64| unit_acceleration(x, gamma, nu) > 0.0;
    let (mut largest, mut rising) = (velocity(at(0)), rises(at(0)));
    for k in 0..points {
        let (mut low, mut high) = (at(k), at(k + 1));
        largest = largest.max(velocity(high));
        let rose = std::mem::replace(&mut rising, rises(high));
        if rose != rising {
            // The velocity is stationary at its peak: 30 halvings make its error far smaller than rounding.
            for _ in 0..30 {
                let middle = 0.5 * (low + high);
                if rises(middle) == rose {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            largest = largest.max(velocity(low)).max(velocity(high));
        }
    }
    largest
}
