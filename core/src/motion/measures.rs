//! Intensity measures of a ground acceleration (m/s2).

use std::f64::consts::PI;

use super::fourier::{even_smooth_at_least, transform};
use crate::statistics::numerics::bisect_first_true;
use crate::units::G_M_S2;

/// Largest frequency step and frequency band of the mean period, Hz (Rathje et al. 1998).
const FREQUENCY_STEP_HZ: f64 = 0.05;
const BAND_HZ: (f64, f64) = (0.25, 20.0);
/// Damping ratio of spectral accelerations and of the Housner intensity.
const DAMPING: f64 = 0.05;
/// First and last period (s) of the Housner intensity (Housner 1952), and number of periods: every 0.05 s.
const HOUSNER_PERIODS: (f64, f64, usize) = (0.1, 2.5, 49);

#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct MotionMeasures {
    pub pga_m_s2: f64,
    pub pgv_m_s: f64,
    pub pgd_m: f64,
    /// Mean period, s; none without energy between 0.25 and 20 Hz.
    pub tm_s: Option<f64>,
    /// Arias intensity, m/s: pi/(2 g) times the integral of a^2.
    pub arias_m_s: f64,
    /// Cumulative absolute velocity, m/s: the integral of |a|.
    pub cav_m_s: f64,
    /// Significant duration, s: from 5 to 75 % of the Arias intensity.
    pub d5_75_s: f64,
    /// Significant duration, s: from 5 to 95 % of the Arias intensity.
    pub d5_95_s: f64,
    pub housner_m: Option<f64>,
    /// Pseudo-spectral accelerations at the periods of the plan, 5 % damping, m/s2.
    #[serde(skip)]
    pub sa_m_s2: Vec<f64>,
}

/// The measures to compute besides those of every motion.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MeasurePlan {
    /// Whether to compute the Housner intensity, which takes as long as all others together.
    pub housner: bool,
    pub sa_periods_s: Vec<f64>,
}

impl MeasurePlan {
    /// Rounds an acceleration (m/s2) to single precision, as tables have it, and measures what is left.
    pub fn measure_written(
        &self,
        acceleration: impl Iterator<Item = f64>,
        dt_s: f64,
    ) -> (Vec<f32>, MotionMeasures) {
        let written: Vec<f32> = acceleration.map(|a| a as f32).collect();
        let read: Vec<f64> = written.iter().map(|&a| f64::from(a)).collect();
        let measures = self.measure(&read, dt_s);
        (written, measures)
    }

    /// Computes the measures of an acceleration (m/s2) at steps of `dt_s`. The squared acceleration is
    /// integrated exactly for lines between samples, everything else by trapezoids.
    pub fn measure(&self, acceleration: &[f64], dt_s: f64) -> MotionMeasures {
        let (mut velocity, mut displacement, mut squares, mut cav_m_s) = (0.0_f64, 0.0_f64, 0.0, 0.0);
        let (mut pgv_m_s, mut pgd_m) = (0.0, 0.0);
        // Running integral of the squared acceleration, m2/s3.
        let mut energy = vec![0.0; acceleration.len()];
        for k in 1..acceleration.len() {
            let (left, right) = (acceleration[k - 1], acceleration[k]);
            squares += squared(dt_s, left, right);
            energy[k] = squares;
            let next = velocity + trapezoid(dt_s, left, right);
            displacement += trapezoid(dt_s, velocity, next);
            velocity = next;
            cav_m_s += trapezoid(dt_s, left.abs(), right.abs());
            pgv_m_s = larger(pgv_m_s, velocity.abs());
            pgd_m = larger(pgd_m, displacement.abs());
        }
        let [d5, d75, d95] =
            [0.05, 0.75, 0.95].map(|share| time_of_share(acceleration, &energy, dt_s, share));
        let spectral = |period_s: &f64| spectral_acceleration(acceleration, dt_s, *period_s, DAMPING);
        MotionMeasures {
            pga_m_s2: peak(acceleration),
            pgv_m_s,
            pgd_m,
            tm_s: mean_period(acceleration, dt_s),
            arias_m_s: 0.5 * PI / G_M_S2 * squares,
            cav_m_s,
            d5_75_s: d75 - d5,
            d5_95_s: d95 - d5,
            housner_m: self.housner.then(|| housner_intensity(acceleration, dt_s)),
            sa_m_s2: self.sa_periods_s.iter().map(spectral).collect(),
        }
    }
}

/// Computes the time (s) at which a fraction of the total `energy`, the running integral of the squared
/// acceleration, is reached. 0 without energy.
fn time_of_share(acceleration: &[f64], energy: &[f64], dt_s: f64, share: f64) -> f64 {
    let Some(&total) = energy.last().filter(|total| **total > 0.0) else { return 0.0 };
    let reached = share * total;
    let after = energy.partition_point(|sum| *sum < reached).max(1);
    let (left, right) = (acceleration[after - 1], acceleration[after]);
    let sum = |part: f64| energy[after - 1] + part * squared(dt_s, left, left + part * (right - left));
    dt_s * ((after - 1) as f64 + bisect_first_true(0.0, 1.0, |part| sum(part) >= reached))
}

fn trapezoid(dt_s: f64, left: f64, right: f64) -> f64 {
    0.5 * dt_s * (left + right)
}

/// Integrates the square of a line between two samples.
fn squared(dt_s: f64, left: f64, right: f64) -> f64 {
    dt_s / 3.0 * (left * left + left * right + right * right)
}

/// Returns the larger of two numbers in one instruction; `f64::max` also checks for NaN.
fn larger(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
}

pub fn peak(series: &[f64]) -> f64 {
    series.iter().fold(0.0, |largest, value| larger(largest, value.abs()))
}

/// Integrates an acceleration to the ground velocity (m/s) by trapezoids, 0 at the first sample.
pub fn velocity(acceleration: &[f64], dt_s: f64) -> Vec<f64> {
    let mut velocity = vec![0.0; acceleration.len()];
    for k in 1..acceleration.len() {
        velocity[k] = velocity[k - 1] + trapezoid(dt_s, acceleration[k - 1], acceleration[k]);
    }
    velocity
}

/// Computes the mean period of Rathje et al. (1998), s: sum(C^2/f) / sum(C^2) of the Fourier amplitudes C of
/// the acceleration from 0.25 to 20 Hz, without smoothing, padded with zeros to a frequency step of at most
/// 0.05 Hz. None without amplitude in this band.
pub fn mean_period(acceleration: &[f64], dt_s: f64) -> Option<f64> {
    let least = (1.0 / (FREQUENCY_STEP_HZ * dt_s)).ceil() as usize;
    let length = even_smooth_at_least(acceleration.len().max(least));
    let mut samples = acceleration.to_vec();
    samples.resize(length, 0.0);
    let spectrum = transform(&mut samples);

    let step_hz = 1.0 / (length as f64 * dt_s);
    let first = (BAND_HZ.0 / step_hz).ceil() as usize;
    let last = (BAND_HZ.1 / step_hz).floor() as usize;
    let (mut weighted, mut total) = (0.0, 0.0);
    for (k, coefficient) in spectrum.iter().enumerate().take(last + 1).skip(first) {
        let power = coefficient.norm_sqr();
        weighted += power / (k as f64 * step_hz);
        total += power;
    }
    (total > 0.0).then(|| weighted / total)
}

/// A linear oscillator under an acceleration of its base, exact for lines between samples (Nigam & Jennings
/// 1969), from rest.
pub struct Oscillator {
    /// Circular frequencies without and with damping, rad/s, and the damping ratio.
    w: f64,
    wd: f64,
    damping: f64,
    dt_s: f64,
    /// Free vibration over a step: decay, and sine and cosine of the angle.
    decay: f64,
    sin: f64,
    cos: f64,
    /// Relative to the base, m and m/s.
    displacement: f64,
    velocity: f64,
}

impl Oscillator {
    /// The damping ratio is in [0, 1).
    pub fn new(period_s: f64, damping: f64, dt_s: f64) -> Oscillator {
        let w = 2.0 * PI / period_s;
        let wd = w * (1.0 - damping * damping).sqrt();
        let (sin, cos) = (wd * dt_s).sin_cos();
        let decay = (-damping * w * dt_s).exp();
        Oscillator { w, wd, damping, dt_s, decay, sin, cos, displacement: 0.0, velocity: 0.0 }
    }

    /// Moves on by a step over which the base goes from one acceleration to the next, m/s2.
    pub fn step(&mut self, before: f64, after: f64) {
        let Oscillator { w, wd, damping, dt_s, decay, sin, cos, displacement, velocity } = *self;
        let slope = (after - before) / dt_s;
        // The particular solution of u'' + 2 z w u' + w^2 u = -(a0 + slope t) is linear; the rest is free.
        let linear = -slope / (w * w);
        let constant = -before / (w * w) - 2.0 * damping / w * linear;
        let free = displacement - constant;
        let free_rate = (velocity - linear + damping * w * free) / wd;
        self.displacement = decay * (free * cos + free_rate * sin) + constant + linear * dt_s;
        self.velocity = decay
            * ((free_rate * wd - damping * w * free) * cos - (free * wd + damping * w * free_rate) * sin)
            + linear;
    }

    pub fn absolute_acceleration(&self) -> f64 {
        -self.w * (self.w * self.displacement + 2.0 * self.damping * self.velocity)
    }
}

/// Computes the pseudo-spectral acceleration, m/s2: (2 pi / T)^2 times the largest relative displacement of a
/// linear oscillator of period `period_s` and damping ratio `damping` in [0, 1).
pub fn spectral_acceleration(acceleration: &[f64], dt_s: f64, period_s: f64, damping: f64) -> f64 {
    let mut oscillator = Oscillator::new(period_s, damping, dt_s);
    let mut largest = 0.0_f64;
    for pair in acceleration.windows(2) {
        oscillator.step(pair[0], pair[1]);
        largest = largest.max(oscillator.displacement.abs());
    }
    oscillator.w * oscillator.w * largest
}

/// Computes the Housner intensity, m: the integral of the pseudo-velocity spectrum at 5 % damping from 0.1 to
/// 2.5 s, by trapezoids.
fn housner_intensity(acceleration: &[f64], dt_s: f64) -> f64 {
    let (first, last, points) = HOUSNER_PERIODS;
    let step = (last - first) / (points - 1) as f64;
    let parts = (0..points).map(|k| {
        let period = first + k as f64 * step;
        let pseudo_velocity =
            spectral_acceleration(acceleration, dt_s, period, DAMPING) * period / (2.0 * PI);
        let weight = if k == 0 || k == points - 1 { 0.5 } else { 1.0 };
        weight * step * pseudo_velocity
    });
    parts.sum()
}
