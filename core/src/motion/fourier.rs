//! Fourier transforms of real series of even length.

use std::cell::RefCell;
use std::collections::HashMap;
use std::sync::Arc;

pub use realfft::num_complex::Complex64;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

#[derive(Clone)]
struct FftPlans {
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
}

/// Lengths whose transforms a thread keeps.
const KEPT: usize = 64;

thread_local! {
    static PLANNED: RefCell<HashMap<usize, FftPlans>> = RefCell::default();
}

/// Returns the transforms of a length. Each has its own planner: a shared planner reuses earlier plans, and
/// the last digits would depend on the history of the thread.
fn planned(samples: usize) -> FftPlans {
    PLANNED.with_borrow_mut(|known| {
        if known.len() == KEPT && !known.contains_key(&samples) {
            known.clear();
        }
        let plan = || {
            let mut planner = RealFftPlanner::new();
            FftPlans {
                forward: planner.plan_fft_forward(samples),
                inverse: planner.plan_fft_inverse(samples),
            }
        };
        known.entry(samples).or_insert_with(plan).clone()
    })
}

/// Computes the `n / 2 + 1` Fourier coefficients of `n` samples; overwrites `samples`.
pub fn transform(samples: &mut [f64]) -> Vec<Complex64> {
    let mut spectrum = vec![Complex64::ZERO; samples.len() / 2 + 1];
    let done = planned(samples.len()).forward.process(samples, &mut spectrum);
    debug_assert!(done.is_ok(), "buffers have the lengths of the plan");
    spectrum
}

/// Computes the samples of Fourier coefficients; overwrites `spectrum`.
pub fn invert(spectrum: &mut [Complex64], samples: &mut [f64]) {
    // The mean and the Nyquist coefficient of a real series are real.
    if let [first, .., last] = spectrum {
        (first.im, last.im) = (0.0, 0.0);
    }
    let done = planned(samples.len()).inverse.process(spectrum, samples);
    debug_assert!(done.is_ok(), "buffers have the lengths of the plan");
    let scale = 1.0 / samples.len() as f64;
    samples.iter_mut().for_each(|sample| *sample *= scale);
}

/// Returns the least even number of at least `n` without prime factors above 5, for fast transforms.
pub fn even_smooth_at_least(n: usize) -> usize {
    (n.max(2)..).find(|&candidate| candidate % 2 == 0 && is_smooth(candidate)).unwrap_or(n)
}

fn is_smooth(mut n: usize) -> bool {
    for prime in [2, 3, 5] {
        while n.is_multiple_of(prime) {
            n /= prime;
        }
    }
    n == 1
}
