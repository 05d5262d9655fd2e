//! Processing of recorded accelerations: baseline, high-pass, time step.

use std::f64::consts::PI;

use crate::motion::fourier::{even_smooth_at_least, invert, transform};
use crate::spelling::unknown_word;

/// Order n of the high-pass, in each direction.
const HIGH_PASS_ORDER: i32 = 4;
/// Largest padding of the high-pass, in lengths of the record, for corners far below 1 / duration.
const MOST_PADDING: f64 = 8.0;
/// Zero crossings of the interpolating sinc on each side.
const LOBES: f64 = 24.0;
/// Shape of the Kaiser window: side lobes of about -80 dB.
const KAISER_BETA: f64 = 8.0;
/// Corner of the resampling filter as a fraction of the lower Nyquist frequency.
const CORNER: f64 = 0.9;

/// Baseline to remove from an acceleration: nothing, its mean, or its least-squares line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[derive(strum::Display, strum::EnumString, strum::IntoStaticStr, strum::VariantArray)]
#[serde(rename_all = "snake_case")]
#[strum(serialize_all = "snake_case", parse_err_ty = String, parse_err_fn = unknown_word::<Baseline>)]
pub enum Baseline {
    None,
    Mean,
    Linear,
}

impl Baseline {
    pub fn remove_from(self, samples: &mut [f64]) {
        let n = samples.len() as f64;
        let mean = samples.iter().sum::<f64>() / n;
        let middle = 0.5 * (n - 1.0);
        // Sum of (k - middle)^2.
        let squares = n * (n * n - 1.0) / 12.0;
        let slope = match self {
            Baseline::None => return,
            Baseline::Linear if squares > 0.0 => {
                let products = samples.iter().enumerate().map(|(k, a)| (k as f64 - middle) * (a - mean));
                products.sum::<f64>() / squares
            }
            Baseline::Mean | Baseline::Linear => 0.0,
        };
        for (k, sample) in samples.iter_mut().enumerate() {
            *sample -= mean + slope * (k as f64 - middle);
        }
    }
}

/// Filters an acceleration at steps of `dt_s` in place by a zero-phase Butterworth high-pass of order 4,
/// forward and backward, applied to the Fourier coefficients: the gain is 1 / (1 + (fc/f)^8), one half at the
/// corner fc (Hz). The record is padded with zeros on both sides by 1.5 n / fc (Boore 2005, "On pads and
/// filters"), and keeps its length.
pub fn high_pass(samples: &mut [f64], dt_s: f64, corner_hz: f64) {
    let record = samples.len();
    // Ringing time of the filter (Boore 2005).
    let wanted = 1.5 * f64::from(HIGH_PASS_ORDER) / (corner_hz * dt_s);
    let pad = wanted.min(MOST_PADDING * record as f64).ceil() as usize;
    let length = even_smooth_at_least(record + 2 * pad);
    let mut padded = vec![0.0; length];
    padded[pad..pad + record].copy_from_slice(samples);
    let mut spectrum = transform(&mut padded);
    for (k, coefficient) in spectrum.iter_mut().enumerate() {
        // No gain at 0 Hz, where fc/f is infinite.
        let f = k as f64 / (length as f64 * dt_s);
        *coefficient *= 1.0 / (1.0 + (corner_hz / f).powi(2 * HIGH_PASS_ORDER));
    }
    invert(&mut spectrum, &mut padded);
    samples.copy_from_slice(&padded[pad..pad + record]);
}

pub fn resampled_length(samples: usize, dt_s: f64, new_dt_s: f64) -> f64 {
    // Tolerance for rounding, which would lose the last sample.
    ((samples.max(1) - 1) as f64 * dt_s / new_dt_s + 1e-9).floor() + 1.0
}

/// Resamples a record from steps of `dt_s` to `new_dt_s` (s) by a sinc with a Kaiser window, low-pass at the
/// lower Nyquist frequency. The record is zero outside.
pub fn resample(samples: &[f64], dt_s: f64, new_dt_s: f64) -> Vec<f64> {
    let corner = if new_dt_s > dt_s { CORNER * dt_s / new_dt_s } else { 1.0 };
    let reach = LOBES / corner;
    let length = resampled_length(samples.len(), dt_s, new_dt_s) as usize;
    let value = |k: usize| {
        let centre = k as f64 * new_dt_s / dt_s;
        let first = (centre - reach).ceil().max(0.0) as usize;
        let last = ((centre + reach).floor() as usize + 1).min(samples.len());
        let near =
            samples.iter().enumerate().take(last).skip(first).map(|(n, sample)| (centre - n as f64, sample));
        near.map(|(x, sample)| sample * corner * sinc(corner * x) * kaiser(x / reach)).sum()
    };
    (0..length).map(value).collect()
}

fn sinc(x: f64) -> f64 {
    if x == 0.0 { 1.0 } else { (PI * x).sin() / (PI * x) }
}

fn kaiser(x: f64) -> f64 {
    bessel_i0(KAISER_BETA * (1.0 - x * x).max(0.0).sqrt()) / bessel_i0(KAISER_BETA)
}

/// Computes the modified Bessel function I0 by its power series, last term first.
fn bessel_i0(x: f64) -> f64 {
    (1..40).rev().fold(1.0, |sum, k| 1.0 + 0.25 * x * x / f64::from(k * k) * sum)
}
