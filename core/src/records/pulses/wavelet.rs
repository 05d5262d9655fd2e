//! Daubechies wavelet of order 4, and its continuous wavelet transform.

use std::sync::LazyLock;

use crate::motion::fourier::{Complex64, even_smooth_at_least, invert, transform};

/// Daubechies' scaling filter with four vanishing moments (Daubechies 1992, Table 6.1); its sum is sqrt 2.
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
const SUPPORT: usize = FILTER.len() - 1;
/// Halvings of the step between tabulated values.
const LEVELS: u32 = 9;
/// Dominant frequency of the wavelet: cycles per unit of its support.
const CENTRE_FREQUENCY: f64 = 5.0 / 7.0;

/// The wavelet at steps of 2^-[`LEVELS`] over its support.
static TABLE: LazyLock<Vec<f64>> = LazyLock::new(tabulate);

/// The wavelet of a period, of unit energy, sampled like a series.
pub struct Wavelet {
    dt_s: f64,
    /// 1/sqrt(s), from `reach` samples before the centre to `reach` after it.
    values: Vec<f64>,
    reach: usize,
}

impl Wavelet {
    pub fn new(period_s: f64, dt_s: f64) -> Wavelet {
        let scale_s = period_s * CENTRE_FREQUENCY;
        let middle = 0.5 * SUPPORT as f64;
        let reach = (middle * scale_s / dt_s).floor() as usize;
        let places = (0..=2 * reach).map(|k| (k as f64 - reach as f64) * dt_s / scale_s + middle);
        Wavelet { dt_s, values: places.map(|x| mother(x) / scale_s.sqrt()).collect(), reach }
    }

    /// Computes the coefficient of a series, the integral of its product with the wavelet centred at a
    /// sample, which may be outside the series.
    pub fn coefficient(&self, series: &[f64], centre: i64) -> f64 {
        let first = centre - self.reach as i64;
        let inside = series.iter().skip(first.max(0) as usize);
        let values = self.values.iter().skip((-first).max(0) as usize);
        self.dt_s * inside.zip(values).map(|(sample, value)| sample * value).sum::<f64>()
    }

    pub fn add_to(&self, series: &mut [f64], centre: i64, factor: f64) {
        let first = centre - self.reach as i64;
        let inside = series.iter_mut().skip(first.max(0) as usize);
        let values = self.values.iter().skip((-first).max(0) as usize);
        inside.zip(values).for_each(|(sample, value)| *sample += factor * value);
    }
}

/// Computes the wavelet at `x` in [0, 7], linear between tabulated values.
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

/// Tabulates the scaling function, at the integers and then at finer levels, and the wavelet from it.
fn tabulate() -> Vec<f64> {
    // Refinement keeps the sum of the values at the integers, 1; the other eigenvalues are at most 1/2.
    let mut scaling = vec![1.0 / (SUPPORT + 1) as f64; SUPPORT + 1];
    for _ in 0..60 {
        scaling = (0..=SUPPORT).map(|i| refine(&scaling, 2 * i, 1, filter)).collect();
    }
    for level in 0..LEVELS {
        let per_unit = 1_usize << level;
        scaling = (0..=SUPPORT * per_unit * 2).map(|i| refine(&scaling, i, per_unit, filter)).collect();
    }
    // The filter of the wavelet is the scaling filter reversed, with alternating signs.
    let mirrored = |k: isize| if k % 2 == 0 { 1.0 } else { -1.0 } * filter(SUPPORT as isize - k);
    let per_unit = 1_usize << LEVELS;
    (0..=SUPPORT * per_unit).map(|i| refine(&scaling, 2 * i, per_unit, mirrored)).collect()
}

fn filter(k: isize) -> f64 {
    usize::try_from(k).ok().and_then(|k| FILTER.get(k)).copied().unwrap_or(0.0)
}

/// Computes sqrt 2 sum_k c_k phi(2 x - k). `i` is 2 x in steps of the table of phi, `per_unit` to a unit.
fn refine(scaling: &[f64], i: usize, per_unit: usize, coefficient: impl Fn(isize) -> f64) -> f64 {
    let terms = (0..FILTER.len()).map(|k| {
        let value = i.checked_sub(k * per_unit).and_then(|place| scaling.get(place));
        coefficient(k as isize) * value.copied().unwrap_or(0.0)
    });
    std::f64::consts::SQRT_2 * terms.sum::<f64>()
}

/// Continuous wavelet transform of series of equal length, at periods up to a longest one.
pub struct WaveletTransform {
    samples: usize,
    dt_s: f64,
    length: usize,
    spectra: Vec<Vec<Complex64>>,
}

impl WaveletTransform {
    pub fn new(series: &[Vec<f64>], dt_s: f64, longest_s: f64) -> WaveletTransform {
        let samples = series.first().map_or(0, Vec::len);
        let length = even_smooth_at_least(samples + 2 * Wavelet::new(longest_s, dt_s).reach + 1);
        let spectra = series.iter().map(|series| {
            let mut padded = series.clone();
            padded.resize(length, 0.0);
            transform(&mut padded)
        });
        WaveletTransform { samples, dt_s, length, spectra: spectra.collect() }
    }

    /// Computes the sum over the series of squared coefficients of a wavelet at each sample.
    pub fn squares(&self, period_s: f64) -> Vec<f64> {
        // The wavelet about the first sample; its first half wraps to the end.
        let Wavelet { values, reach, .. } = Wavelet::new(period_s, self.dt_s);
        let mut samples = vec![0.0; self.length];
        samples[..=reach].copy_from_slice(&values[reach..]);
        samples[self.length - reach..].copy_from_slice(&values[..reach]);
        let kernel = transform(&mut samples);
        let mut squares = vec![0.0; self.samples];
        for spectrum in &self.spectra {
            let product = kernel.iter().zip(spectrum).map(|(kernel, series)| kernel.conj() * series);
            invert(&mut product.collect::<Vec<_>>(), &mut samples);
            squares.iter_mut().zip(&samples).for_each(|(sum, value)| *sum += (self.dt_s * value).powi(2));
        }
        squares
    }
}
