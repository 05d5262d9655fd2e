//! The pulse of Mavroeidis & Papageorgiou (2003), Eq. 1.

use std::f64::consts::PI;

use pulp::NullaryFnOnce;

use super::scenario::Scenario;
use crate::wide::widest;

/// Newton steps to the largest velocity: after three it is found to 1e-12 for any pulse of one half cycle or more.
const NEWTON_STEPS: usize = 4;
/// Angles between two of which sine and cosine are computed afresh.
const STRIDE: usize = 32;

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
    /// Makes the pulse whose largest velocity is the Vp of the scenario: A = Vp / F(gamma, nu).
    pub fn of(scenario: &Scenario) -> Pulse {
        let Scenario { vp_m_s, tp_s, gamma, nu_rad, .. } = *scenario;
        Pulse { amplitude_m_s: vp_m_s / largest_velocity(gamma, nu_rad), tp_s, gamma, nu_rad }
    }

    /// Returns the duration gamma Tp, s.
    pub fn duration_s(&self) -> f64 {
        self.gamma * self.tp_s
    }

    /// Computes the ground velocity (m/s) at a time (s) from the middle of the pulse (Eq. 1).
    pub fn velocity_m_s(&self, time_s: f64) -> f64 {
        self.phase(time_s).map_or(0.0, |x| self.amplitude_m_s * unit_velocity(x, self.gamma, self.nu_rad))
    }

    /// Computes the ground acceleration (m/s2) at a time (s) from the middle of the pulse: the derivative of Eq. 1.
    pub fn acceleration_m_s2(&self, time_s: f64) -> f64 {
        let wp = 2.0 * PI / self.tp_s;
        self.phase(time_s)
            .map_or(0.0, |x| self.amplitude_m_s * wp * unit_acceleration(x, self.gamma, self.nu_rad))
    }

    /// Writes the ground acceleration (m/s2) of `samples` samples, `dt_s` apart, with the middle of the pulse at `epoch_s`.
    pub fn sample(&self, dt_s: f64, epoch_s: f64, samples: usize, acceleration_m_s2: &mut Vec<f64>) {
        let (wp, gamma, half_s) = (2.0 * PI / self.tp_s, self.gamma, 0.5 * self.duration_s());
        let first = (((epoch_s - half_s) / dt_s).ceil().max(0.0) as usize).min(samples);
        let last = (((epoch_s + half_s) / dt_s).floor() as usize + 1).clamp(first, samples);
        let x = wp * (first as f64 * dt_s - epoch_s);
        let envelope = EqualSteps::new(x / gamma, wp * dt_s / gamma);
        let carrier = EqualSteps::new(x + self.nu_rad, wp * dt_s);
        acceleration_m_s2.clear();
        acceleration_m_s2.resize(samples, 0.0);
        let samples = &mut acceleration_m_s2[first..last];
        widest(Slopes { envelope, carrier, gamma, scale: self.amplitude_m_s * wp, samples });
    }

    /// Computes x = wp (t - t0); none outside the pulse, |x| <= pi gamma.
    fn phase(&self, time_s: f64) -> Option<f64> {
        let x = 2.0 * PI / self.tp_s * time_s;
        (x.abs() <= PI * self.gamma).then_some(x)
    }
}

/// dv/dx of a pulse at equal time steps, times a scale.
struct Slopes<'a> {
    envelope: EqualSteps,
    carrier: EqualSteps,
    gamma: f64,
    scale: f64,
    samples: &'a mut [f64],
}

impl NullaryFnOnce for Slopes<'_> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let Slopes { envelope, carrier, gamma, scale, samples } = self;
        for (stride, samples) in samples.chunks_mut(STRIDE).enumerate() {
            let (envelope, carrier) = (envelope.stride(stride), carrier.stride(stride));
            for (k, sample) in samples.iter_mut().enumerate() {
                let (envelope, carrier) =
                    ((envelope.sin[k], envelope.cos[k]), (carrier.sin[k], carrier.cos[k]));
                *sample = scale * slope(envelope, carrier, gamma);
            }
        }
    }
}

/// Computes v / A of Eq. 1 from x = wp (t - t0).
fn unit_velocity(x: f64, gamma: f64, nu: f64) -> f64 {
    0.5 * (1.0 + libm::cos(x / gamma)) * libm::cos(x + nu)
}

/// Computes dv/dx / A, the derivative of Eq. 1.
fn unit_acceleration(x: f64, gamma: f64, nu: f64) -> f64 {
    slope(libm::sincos(x / gamma), libm::sincos(x + nu), gamma)
}

/// Computes dv/dx / A from the sines and cosines of x / gamma (the envelope) and x + nu (the carrier).
#[inline(always)]
fn slope((sin, cos): (f64, f64), (carrier_sin, carrier_cos): (f64, f64), gamma: f64) -> f64 {
    -0.5 / gamma * (sin * carrier_cos + gamma * (1.0 + cos) * carrier_sin)
}

/// Computes F(gamma, nu), the largest |v| / A of a pulse.
///
/// Peaks lie where gamma tan(x + nu) = -tan(x / (2 gamma)), one for each half cycle of the carrier. The farther one is from
/// the middle, the lower is the envelope there and the carrier too: the nearest is the largest, and Newton's method
/// finds it from where it would be if both tangents were straight.
pub fn largest_velocity(gamma: f64, nu: f64) -> f64 {
    let from_peak = nu - PI * (nu / PI).round();
    let mut x = -from_peak / (1.0 + 0.5 / (gamma * gamma));
    for _ in 0..NEWTON_STEPS {
        let (sin, cos) = libm::sincos(0.5 * x / gamma);
        let (carrier_sin, carrier_cos) = libm::sincos(x + from_peak);
        let slope = sin * carrier_cos + gamma * cos * carrier_sin;
        x -= slope / ((gamma + 0.5 / gamma) * cos * carrier_cos - 1.5 * sin * carrier_sin);
    }
    unit_velocity(x, gamma, nu).abs()
}

/// Sines and cosines of [`STRIDE`] angles.
struct SinCos {
    sin: [f64; STRIDE],
    cos: [f64; STRIDE],
}

/// Equal steps of an angle, whose sines and cosines come by the addition theorem: one libm call serves a stride.
struct EqualSteps {
    start: f64,
    step: f64,
    /// Of the angles from the first one of a stride to each of it.
    between: SinCos,
}

impl EqualSteps {
    /// Prepares the angles `start`, `start + step`, `start + 2 step` ..., rad.
    fn new(start: f64, step: f64) -> EqualSteps {
        let mut between = SinCos { sin: [0.0; STRIDE], cos: [0.0; STRIDE] };
        for k in 0..STRIDE {
            (between.sin[k], between.cos[k]) = libm::sincos(k as f64 * step);
        }
        EqualSteps { start, step, between }
    }

    /// Computes sines and cosines of a stride, whose first angle is number [`STRIDE`] times `stride`.
    #[inline(always)]
    fn stride(&self, stride: usize) -> SinCos {
        let (sin, cos) = libm::sincos(self.start + stride as f64 * STRIDE as f64 * self.step);
        let between = &self.between;
        let mut angles = SinCos { sin: [0.0; STRIDE], cos: [0.0; STRIDE] };
        for k in 0..STRIDE {
            angles.sin[k] = sin * between.cos[k] + cos * between.sin[k];
            angles.cos[k] = cos * between.cos[k] - sin * between.sin[k];
        }
        angles
    }
}
