//! Fourier transforms of real series of even length.

use std::sync::Arc;

pub use realfft::num_complex::Complex64;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

/// Fourier transforms of real series of one even length.
#[derive(Clone)]
pub struct Transform {
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
}

impl Transform {
    /// Plans the transforms of series of `samples` samples. Each length has its own planner: a shared planner
    /// reuses earlier plans, and the last digits would depend on the history of the thread.
    pub fn new(samples: usize) -> Transform {
        let mut planner = RealFftPlanner::new();
        Transform { forward: planner.plan_fft_forward(samples), inverse: planner.plan_fft_inverse(samples) }
    }

    /// Computes the `n / 2 + 1` Fourier coefficients of `n` samples; overwrites `samples`.
    pub fn forward(&self, samples: &mut [f64], spectrum: &mut Vec<Complex64>, scratch: &mut Vec<Complex64>) {
        spectrum.resize(samples.len() / 2 + 1, Complex64::ZERO);
        scratch.resize(self.forward.get_scratch_len(), Complex64::ZERO);
        let done = self.forward.process_with_scratch(samples, spectrum, scratch);
        debug_assert!(done.is_ok(), "buffers have the lengths of the plan");
    }

    /// Computes the samples of Fourier coefficients; overwrites `spectrum`.
    pub fn inverse(&self, spectrum: &mut [Complex64], samples: &mut [f64], scratch: &mut Vec<Complex64>) {
        // The mean and the Nyquist coefficient of a real series are real.
        if let [first, .., last] = spectrum {
            (first.im, last.im) = (0.0, 0.0);
        }
        scratch.resize(self.inverse.get_scratch_len(), Complex64::ZERO);
        let done = self.inverse.process_with_scratch(spectrum, samples, scratch);
        debug_assert!(done.is_ok(), "buffers have the lengths of the plan");
        let scale = 1.0 / samples.len() as f64;
        samples.iter_mut().for_each(|sample| *sample *= scale);
    }
}

/// Returns the least even number of at least `n` without prime factors above 5, for fast transforms.
pub fn even_smooth_at_least(n: usize) -> usize {
    (n.max(2)..).find(|&candidate| candidate % 2 == 0 && is_smooth(candidate)).unwrap_or(n)
}

/// Returns whether a number has no prime factors above 5.
fn is_smooth(mut n: usize) -> bool {
    for prime in [2, 3, 5] {
        while n.is_multiple_of(prime) {
            n /= prime;
        }
    }
    n == 1
}
