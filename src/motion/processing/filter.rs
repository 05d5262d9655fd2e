use realfft::num_complex::Complex64;

use crate::motion::fourier::{ByLength, Transform, even_smooth_at_least};

/// Order n of the filter, each way.
const ORDER: i32 = 4;
/// The most padding, in lengths of the record: a corner far below one over its duration asks for more than it is worth.
const MOST_PADDING: f64 = 8.0;

/// A zero-phase Butterworth high-pass of order 4, forward and backward: the gain is 1 / (1 + (fc/f)^8), applied to the
/// Fourier coefficients. The record is padded with zeros on both sides by 1.5 n / fc (Boore 2005, "On pads and
/// filters"), and keeps its length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HighPass {
    /// Corner frequency fc, Hz, at which the gain is one half.
    pub corner_hz: f64,
}

/// Plans and buffers that one record after the other uses.
#[derive(Default)]
pub struct HighPassScratch {
    transforms: ByLength<Transform>,
    samples: Vec<f64>,
    spectrum: Vec<Complex64>,
    scratch: Vec<Complex64>,
}

impl HighPass {
    /// Filters an acceleration of this time step (s) in place.
    pub fn apply(&self, samples: &mut [f64], dt_s: f64, scratch: &mut HighPassScratch) {
        let record = samples.len();
        let wanted = 1.5 * f64::from(ORDER) / (self.corner_hz * dt_s);
        let pad = wanted.min(MOST_PADDING * record as f64).ceil() as usize;
        let length = even_smooth_at_least(record + 2 * pad);
        let transform = scratch.transforms.get(length, || Transform::new(length));
        scratch.samples.clear();
        scratch.samples.resize(pad, 0.0);
        scratch.samples.extend_from_slice(samples);
        scratch.samples.resize(length, 0.0);
        transform.forward(&mut scratch.samples, &mut scratch.spectrum, &mut scratch.scratch);
        let step_hz = 1.0 / (length as f64 * dt_s);
        for (k, coefficient) in scratch.spectrum.iter_mut().enumerate() {
            *coefficient *= self.gain(k as f64 * step_hz);
        }
        transform.inverse(&mut scratch.spectrum, &mut scratch.samples, &mut scratch.scratch);
        samples.copy_from_slice(&scratch.samples[pad..pad + record]);
    }

    fn gain(&self, f: f64) -> f64 {
        if f > 0.0 { 1.0 / (1.0 + (self.corner_hz / f).powi(2 * ORDER)) } else { 0.0 }
    }
}
