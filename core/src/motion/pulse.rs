//! The pulse of Mavroeidis & Papageorgiou (2003), Eq. 1.

use std::f64::consts::PI;

use super::fourier::Complex64;
use super::scenario::Scenario;

/// Newton steps to the largest velocity; three reach 1e-12 for any pulse of at least one half cycle.
const NEWTON_STEPS: usize = 4;

/// A velocity pulse: a cosine under a raised-cosine envelope.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pulse {
    /// Amplitude A of Eq. 1, m/s; the largest velocity is A times [`largest_velocity`].
    pub amplitude_m_s: f64,
    pub tp_s: f64,
    /// Number of half cycles.
    pub gamma: f64,
    pub nu_rad: f64,
}

impl Pulse {
    /// Makes the pulse of a scenario, whose largest velocity is Vp: A = Vp / F(gamma, nu).
    pub fn of(scenario: &Scenario) -> Pulse {
        let Scenario { vp_m_s, tp_s, gamma, nu_rad, .. } = *scenario;
        Pulse { amplitude_m_s: vp_m_s / largest_velocity(gamma, nu_rad), tp_s, gamma, nu_rad }
    }

    pub fn duration_s(&self) -> f64 {
        self.gamma * self.tp_s
    }

    /// Computes the ground velocity (m/s) at a time (s) from the middle of the pulse (Eq. 1):
    /// v = A/2 [1 + cos(x / gamma)] cos(x + nu) with x = wp (t - t0), and 0 where |x| > pi gamma.
    pub fn velocity_m_s(&self, time_s: f64) -> f64 {
        self.phase(time_s).map_or(0.0, |x| self.amplitude_m_s * unit_velocity(x, self.gamma, self.nu_rad))
    }

    /// Computes the ground acceleration (m/s2) at a time (s) from the middle of the pulse, the derivative of
    /// Eq. 1: a = -A wp / (2 gamma) [sin(x / gamma) cos(x + nu) + gamma (1 + cos(x / gamma)) sin(x + nu)].
    pub fn acceleration_m_s2(&self, time_s: f64) -> f64 {
        let Some(x) = self.phase(time_s) else { return 0.0 };
        self.acceleration(Complex64::cis(x / self.gamma), Complex64::cis(x + self.nu_rad))
    }

    /// Computes the acceleration from exp(i x / gamma) and exp(i (x + nu)).
    fn acceleration(&self, envelope: Complex64, carrier: Complex64) -> f64 {
        let wp = 2.0 * PI / self.tp_s;
        let (sin, cos) = (envelope.im, envelope.re);
        -self.amplitude_m_s * wp / (2.0 * self.gamma)
            * (sin * carrier.re + self.gamma * (1.0 + cos) * carrier.im)
    }

    /// Samples the ground acceleration (m/s2) `samples` times at steps of `dt_s`, with the middle of the
    /// pulse at `epoch_s`. Rotating envelope and carrier by constant angles is four times faster than sines.
    pub fn sample(&self, dt_s: f64, epoch_s: f64, samples: usize) -> Vec<f64> {
        let wp = 2.0 * PI / self.tp_s;
        let half_s = 0.5 * self.duration_s();
        let first = ((epoch_s - half_s) / dt_s).ceil().max(0.0) as usize;
        let last = (((epoch_s + half_s) / dt_s).floor() as usize).min(samples - 1);
        let x = wp * (first as f64 * dt_s - epoch_s);
        let (mut envelope, mut carrier) = (Complex64::cis(x / self.gamma), Complex64::cis(x + self.nu_rad));
        let (turn, carrier_turn) = (Complex64::cis(wp * dt_s / self.gamma), Complex64::cis(wp * dt_s));
        let mut acceleration = vec![0.0; samples];
        for sample in &mut acceleration[first..=last] {
            *sample = self.acceleration(envelope, carrier);
            (envelope, carrier) = (envelope * turn, carrier * carrier_turn);
        }
        acceleration
    }

    /// Computes x = wp (t - t0) of Eq. 1; none outside the pulse, |x| > pi gamma.
    fn phase(&self, time_s: f64) -> Option<f64> {
        let x = 2.0 * PI / self.tp_s * time_s;
        (x.abs() <= PI * self.gamma).then_some(x)
    }
}

fn unit_velocity(x: f64, gamma: f64, nu: f64) -> f64 {
    0.5 * (1.0 + (x / gamma).cos()) * (x + nu).cos()
}

/// Computes F(gamma, nu), the largest |v| / A of a pulse.
///
/// Peaks are the roots of gamma tan(x + nu) = -tan(x / (2 gamma)), one in each half cycle of the carrier. The
/// nearest to the middle is the largest, since envelope and carrier both decrease with distance from it.
/// Newton's method starts from the root of the linearised equation.
pub fn largest_velocity(gamma: f64, nu: f64) -> f64 {
    let from_peak = nu - PI * (nu / PI).round();
    let mut x = -from_peak / (1.0 + 0.5 / (gamma * gamma));
    for _ in 0..NEWTON_STEPS {
        let (sin, cos) = (0.5 * x / gamma).sin_cos();
        let (carrier_sin, carrier_cos) = (x + from_peak).sin_cos();
        let slope = sin * carrier_cos + gamma * cos * carrier_sin;
        x -= slope / ((gamma + 0.5 / gamma) * cos * carrier_cos - 1.5 * sin * carrier_sin);
    }
    unit_velocity(x, gamma, nu).abs()
}
