//! The Daubechies wavelet of order 4 and the continuous wavelet transform with it, as the pulse indicator uses them.

use std::collections::HashMap;
use std::sync::LazyLock;

use crate::motion::fourier::{ByLength, Complex64, Transform, even_smooth_at_least};

/// Daubechies' scaling filter with four vanishing moments (Daubechies 1992, Table 6.1), of sum sqrt 2.
const FILTER: [f64; 8] = [
    0.230_377_813_308_855_23,
    0.714_846_570_552_541_5,
    0.630_880_767_929_590_4,
    -0.027_983_769_416_983_85,
    -0.187_034_811_718_881_14,
    0.030_841_381_835_986_965,
    0.032_883_011_666_982_945,
    -0.010_597_401_784_997_278,
];
/// Length of the support.
const SUPPORT: usize = FILTER.len() - 1;
/// Halvings of the step between tabulated values.
const LEVELS: u32 = 9;
/// Cycles of the wavelet per unit of its support: the frequency that dominates it.
const CENTRE_FREQUENCY: f64 = 5.0 / 7.0;

/// The wavelet at steps of 2^-[`LEVELS`] over its support.
static TABLE: LazyLock<Vec<f64>> = LazyLock::new(tabulate);

/// A wavelet of a period, centred at a moment, of unit energy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wavelet {
    /// Period of the frequency that dominates it, s.
    pub period_s: f64,
    /// Middle of its support, s.
    pub centre_s: f64,
}

impl Wavelet {
    /// Computes the value at a time, 1/sqrt(s).
    pub fn value(&self, time_s: f64) -> f64 {
        let scale_s = self.period_s * CENTRE_FREQUENCY;
        mother((time_s - self.centre_s) / scale_s + 0.5 * SUPPORT as f64) / scale_s.sqrt()
    }

    /// Returns from where to where it is not zero, s.
    pub fn support_s(&self) -> (f64, f64) {
        let half = 0.5 * SUPPORT as f64 * self.period_s * CENTRE_FREQUENCY;
        (self.centre_s - half, self.centre_s + half)
    }

    /// Computes the coefficient of a series at steps of `dt_s`: the integral of its product with the wavelet.
    pub fn coefficient(&self, series: &[f64], dt_s: f64) -> f64 {
        let (from, to) = self.support_s();
        let first = (from / dt_s).ceil().max(0.0) as usize;
        let last = ((to / dt_s).floor().max(-1.0) + 1.0) as usize;
        let inside = series.iter().enumerate().take(last).skip(first);
        dt_s * inside.map(|(k, value)| value * self.value(k as f64 * dt_s)).sum::<f64>()
    }
}

/// A wavelet at the samples of a series, for coefficients at many of them.
pub struct SampledWavelet {
    dt_s: f64,
    /// From `reach` samples before its centre to as many after it.
    values: Vec<f64>,
    reach: usize,
}

impl SampledWavelet {
    /// Samples the wavelet of a period at steps of `dt_s`.
    pub fn new(period_s: f64, dt_s: f64) -> SampledWavelet {
        let wavelet = Wavelet { period_s, centre_s: 0.0 };
        let reach = (wavelet.support_s().1 / dt_s).floor() as usize;
        let at = |k: usize| wavelet.value((k as f64 - reach as f64) * dt_s);
        SampledWavelet { dt_s, values: (0..=2 * reach).map(at).collect(), reach }
    }

    /// Computes the coefficient of a series where the wavelet is centred at a sample, which may lie outside: as
    /// [`Wavelet::coefficient`].
    pub fn coefficient(&self, series: &[f64], centre: i64) -> f64 {
        let first = centre - self.reach as i64;
        let inside = series.iter().skip(first.max(0) as usize);
        let values = self.values.iter().skip((-first).max(0) as usize);
        self.dt_s * inside.zip(values).map(|(sample, value)| sample * value).sum::<f64>()
    }
}

/// Computes the wavelet on its support of 0 to 7, linear between tabulated values.
fn mother(x: f64) -> f64 {
    let place = x * f64::from(1 << LEVELS);
    if place < 0.0 {
        return 0.0;
    }
    let index = place as usize;
    match TABLE.get(index..index + 2) {
        Some([left, right]) => left + (right - left) * (place - index as f64),
        _ => 0.0,
    }
}

/// Tabulates the scaling function at the integers by its refinement equation, then at each finer level, and the wavelet from it.
fn tabulate() -> Vec<f64> {
    let coefficient = |k: isize| usize::try_from(k).ok().and_then(|k| FILTER.get(k)).copied().unwrap_or(0.0);
    let root2 = std::f64::consts::SQRT_2;
    // Its values at the integers sum to 1, which the refinement keeps.
    let mut scaling = vec![1.0 / (SUPPORT + 1) as f64; SUPPORT + 1];
    // The other eigenvalues of the refinement are at most one half.
    for _ in 0..60 {
        let refined = |i: usize| {
            let term = |(j, value): (usize, &f64)| root2 * coefficient(2 * i as isize - j as isize) * value;
            scaling.iter().enumerate().map(term).sum()
        };
        scaling = (0..=SUPPORT).map(refined).collect();
    }
    for level in 0..LEVELS {
        let per_unit = 1_usize << level;
        scaling = (0..=SUPPORT * per_unit * 2).map(|i| refine(&scaling, i, per_unit, coefficient)).collect();
    }
    // The wavelet's filter is the scaling filter reversed with alternating signs.
    let mirrored = |k: isize| if k % 2 == 0 { 1.0 } else { -1.0 } * coefficient(SUPPORT as isize - k);
    let per_unit = 1_usize << LEVELS;
    (0..=SUPPORT * per_unit).map(|i| refine(&scaling, 2 * i, per_unit, mirrored)).collect()
}

/// Computes sqrt 2 sum_k c_k phi(2 x - k), where `i` counts 2 x in steps of phi's table, which has `per_unit` of them to a unit.
fn refine(scaling: &[f64], i: usize, per_unit: usize, coefficient: impl Fn(isize) -> f64) -> f64 {
    let at = |k: usize| i.checked_sub(k * per_unit).and_then(|place| scaling.get(place)).copied();
    let term = |k: usize| coefficient(k as isize) * at(k).unwrap_or(0.0);
    std::f64::consts::SQRT_2 * (0..FILTER.len()).map(term).sum::<f64>()
}

/// Plans and buffers of wavelet transforms.
#[derive(Default)]
pub struct WaveletScratch {
    transforms: ByLength<Transform>,
    kernel: Vec<f64>,
    kernel_spectra: KernelSpectra,
    product: Vec<Complex64>,
    scratch: Vec<Complex64>,
}

/// The Fourier coefficients of wavelets, which many series of one length and time step share.
#[derive(Default)]
struct KernelSpectra {
    /// By the number of samples, and the bits of time step and period.
    spectra: HashMap<(usize, u64, u64), Vec<Complex64>>,
    /// Coefficients of all of them.
    held: usize,
}

/// Coefficients of wavelets that are held at once: 16 MB.
const MOST_HELD: usize = 1 << 20;

impl KernelSpectra {
    fn get(&mut self, key: (usize, u64, u64), make: impl FnOnce() -> Vec<Complex64>) -> &[Complex64] {
        if !self.spectra.contains_key(&key) && self.held > MOST_HELD {
            self.spectra.clear();
            self.held = 0;
        }
        self.spectra.entry(key).or_insert_with(|| {
            let spectrum = make();
            self.held += spectrum.len();
            spectrum
        })
    }
}

/// The continuous wavelet transform of a series, at any period up to a longest one.
pub struct WaveletTransform {
    samples: usize,
    dt_s: f64,
    length: usize,
    spectrum: Vec<Complex64>,
}

impl WaveletTransform {
    /// Prepares the transform of a series at steps of `dt_s`, for periods up to `longest_s`.
    pub fn new(series: &[f64], dt_s: f64, longest_s: f64, scratch: &mut WaveletScratch) -> WaveletTransform {
        let (from, to) = Wavelet { period_s: longest_s, centre_s: 0.0 }.support_s();
        let length = even_smooth_at_least(series.len() + ((to - from) / dt_s).ceil() as usize + 1);
        let transform = scratch.transforms.get(length, || Transform::new(length));
        let mut padded = series.to_vec();
        padded.resize(length, 0.0);
        let mut spectrum = Vec::new();
        transform.forward(&mut padded, &mut spectrum, &mut scratch.scratch);
        WaveletTransform { samples: series.len(), dt_s, length, spectrum }
    }

    /// Computes the coefficients of wavelets of one period centred at each sample.
    pub fn coefficients(&self, period_s: f64, scratch: &mut WaveletScratch) -> Vec<f64> {
        let WaveletScratch { transforms, kernel, kernel_spectra, product, scratch } = scratch;
        let transform = transforms.get(self.length, || Transform::new(self.length));
        let key = (self.length, self.dt_s.to_bits(), period_s.to_bits());
        let spectrum = kernel_spectra.get(key, || {
            self.sample_wavelet(period_s, kernel);
            let mut spectrum = Vec::new();
            transform.forward(kernel, &mut spectrum, scratch);
            spectrum
        });
        product.clear();
        product.extend(spectrum.iter().zip(&self.spectrum).map(|(kernel, series)| kernel.conj() * series));
        let mut coefficients = vec![0.0; self.length];
        transform.inverse(product, &mut coefficients, scratch);
        coefficients.truncate(self.samples);
        coefficients
    }

    /// Samples the wavelet of a period centred at the first sample, with what lies before it at the end.
    fn sample_wavelet(&self, period_s: f64, kernel: &mut Vec<f64>) {
        let wavelet = Wavelet { period_s, centre_s: 0.0 };
        let reach = (wavelet.support_s().1 / self.dt_s).floor() as usize;
        kernel.clear();
        kernel.resize(self.length, 0.0);
        for k in 0..=reach.min(self.length / 2) {
            let time_s = k as f64 * self.dt_s;
            kernel[k] = self.dt_s * wavelet.value(time_s);
            if k > 0 {
                kernel[self.length - k] = self.dt_s * wavelet.value(-time_s);
            }
        }
    }
}
