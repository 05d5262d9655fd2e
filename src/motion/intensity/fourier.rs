use realfft::num_complex::Complex64;

use crate::motion::fourier::{ByLength, Transform, even_smooth_at_least};

/// The widest frequency step of the mean period, Hz.
const FREQUENCY_STEP_HZ: f64 = 0.05;
/// The band of the mean period, Hz.
const BAND_HZ: (f64, f64) = (0.25, 20.0);

/// Plans and buffers that one motion after the other uses.
#[derive(Default)]
pub struct IntensityScratch {
    transforms: ByLength<Transform>,
    samples: Vec<f64>,
    spectrum: Vec<Complex64>,
    scratch: Vec<Complex64>,
    /// The running energy of the motion.
    pub(super) energy: Vec<f64>,
}

/// Mean period of Rathje et al. (1998), s: sum(C^2/f) / sum(C^2) of the Fourier amplitudes C of the acceleration from 0.25
/// to 20 Hz, without smoothing, the record padded with zeros to a frequency step of 0.05 Hz or less. None where there
/// is no amplitude in this band.
pub fn mean_period(acceleration: &[f64], dt_s: f64, scratch: &mut IntensityScratch) -> Option<f64> {
    let least = (1.0 / (FREQUENCY_STEP_HZ * dt_s)).ceil() as usize;
    let length = even_smooth_at_least(acceleration.len().max(least));
    let transform = scratch.transforms.get(length, || Transform::new(length));
    scratch.samples.clear();
    scratch.samples.extend_from_slice(acceleration);
    scratch.samples.resize(length, 0.0);
    transform.forward(&mut scratch.samples, &mut scratch.spectrum, &mut scratch.scratch);

    let step_hz = 1.0 / (length as f64 * dt_s);
    let first = (BAND_HZ.0 / step_hz).ceil() as usize;
    let last = (BAND_HZ.1 / step_hz).floor() as usize;
    let (mut weighted, mut total) = (0.0, 0.0);
    for (k, coefficient) in scratch.spectrum.iter().enumerate().take(last + 1).skip(first) {
        let power = coefficient.norm_sqr();
        weighted += power / (k as f64 * step_hz);
        total += power;
    }
    (total > 0.0).then(|| weighted / total)
}
