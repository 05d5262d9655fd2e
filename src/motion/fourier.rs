//! Fourier transforms of real series, planned once for each length. Ours, because the kernels of RustFFT round differently on
//! each kind of processor, and take sines and cosines from the platform.

use std::collections::HashMap;
use std::sync::Arc;

use pulp::{Simd, WithSimd, bytemuck};

use super::butterfly::{Parts, Pass, Turns};
use crate::wide::widest_registers;

pub type Complex64 = nalgebra::Complex<f64>;

/// The Fourier transforms of real series of one length, even and without prime factors above 5.
///
/// A series is taken for one of half as many complex numbers (Press et al. 2007, Numerical Recipes, 12.3). These are laid out in
/// rows and columns, so that passes go over whole rows: transforms along the columns, then, transposed, along what were the rows
/// (Bailey 1990, FFTs in external or hierarchical memory, The Journal of Supercomputing 4, 23-35).
pub struct Transform {
    stages: Vec<Stage>,
    /// exp(-2 pi i k / samples).
    turns: Turns,
}

enum Stage {
    Pass(Pass),
    Transpose {
        columns: usize,
        /// exp(-2 pi i row column / length), row by row.
        turns: Turns,
    },
}

impl Transform {
    /// Plans the transforms of `samples` samples.
    pub fn new(samples: usize) -> Transform {
        let length = samples / 2;
        let (mut of_rows, mut of_columns) = (Vec::new(), Vec::new());
        let (mut rows, mut columns) = (1, 1);
        for factor in factors(length) {
            // As nearly square as the factors let.
            if rows <= columns {
                rows *= factor;
                of_rows.push(factor);
            } else {
                columns *= factor;
                of_columns.push(factor);
            }
        }
        let places = (0..rows).flat_map(|row| (0..columns).map(move |column| row * column));
        let transpose = Stage::Transpose { columns, turns: Turns::new(places, length.max(1)) };
        let along_columns = Pass::all(&of_rows, rows, columns).into_iter().map(Stage::Pass);
        let along_rows = Pass::all(&of_columns, columns, rows).into_iter().map(Stage::Pass);
        Transform {
            stages: along_columns.chain([transpose]).chain(along_rows).collect(),
            turns: Turns::new(0..length, samples.max(1)),
        }
    }

    /// Computes the Fourier coefficients of `samples`, which are used up.
    pub fn forward(&self, samples: &mut [f64], spectrum: &mut Vec<Complex64>, scratch: &mut Vec<Complex64>) {
        spectrum.resize(samples.len() / 2 + 1, Complex64::ZERO);
        scratch.resize(samples.len(), Complex64::ZERO);
        widest_registers(Forward { transform: self, samples, spectrum, scratch });
    }

    /// Computes the samples of these Fourier coefficients, which are used up.
    pub fn inverse(&self, spectrum: &mut [Complex64], samples: &mut [f64], scratch: &mut Vec<Complex64>) {
        scratch.resize(samples.len(), Complex64::ZERO);
        widest_registers(Inverse { transform: self, samples, spectrum, scratch });
    }

    /// Transforms `a`, with `b` for room; returns where the result is.
    #[inline(always)]
    fn run<'a, S: Simd>(&self, simd: S, mut a: Parts<'a>, mut b: Parts<'a>) -> Parts<'a> {
        for stage in &self.stages {
            match stage {
                Stage::Pass(pass) => pass.run(simd, &a, &mut b),
                Stage::Transpose { columns, turns } => transpose(*columns, turns, &mut a, &mut b),
            }
            std::mem::swap(&mut a, &mut b);
        }
        a
    }
}

/// Divides room into that of two series of complex numbers.
fn halves(room: &mut [Complex64]) -> (Parts<'_>, Parts<'_>) {
    let room: &mut [f64] = bytemuck::cast_slice_mut(room);
    let length = room.len() / 4;
    let (a, b) = room.split_at_mut(2 * length);
    let [(a_re, a_im), (b_re, b_im)] = [a.split_at_mut(length), b.split_at_mut(length)];
    (Parts { re: a_re, im: a_im }, Parts { re: b_re, im: b_im })
}

/// Turns each number and exchanges rows and columns.
#[inline(always)]
fn transpose(columns: usize, turns: &Turns, from: &mut Parts, to: &mut Parts) {
    const TILE: usize = 8;
    for ((re, im), (cos, sin)) in
        from.re.iter_mut().zip(from.im.iter_mut()).zip(turns.cos.iter().zip(&turns.sin))
    {
        (*re, *im) = (*re * cos - *im * sin, *re * sin + *im * cos);
    }
    for (from, to) in [(&*from.re, &mut *to.re), (&*from.im, &mut *to.im)] {
        let rows = from.len() / columns;
        let tiles = from.chunks_exact(TILE * columns);
        for (row, from) in (rows / TILE * TILE..rows).zip(tiles.remainder().chunks_exact(columns)) {
            for (to, from) in to[row..].iter_mut().step_by(rows).zip(from) {
                *to = *from;
            }
        }
        for (tile, from) in tiles.enumerate() {
            let mut of_row = [from; TILE];
            for k in 0..TILE {
                of_row[k] = &from[k * columns..][..columns];
            }
            for column in 0..columns {
                let to = &mut to[column * rows + tile * TILE..][..TILE];
                for k in 0..TILE {
                    to[k] = of_row[k][column];
                }
            }
        }
    }
}

struct Forward<'a> {
    transform: &'a Transform,
    samples: &'a [f64],
    spectrum: &'a mut [Complex64],
    scratch: &'a mut [Complex64],
}

impl WithSimd for Forward<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let (a, b) = halves(self.scratch);
        for (pair, (re, im)) in self.samples.as_chunks().0.iter().zip(a.re.iter_mut().zip(a.im.iter_mut())) {
            [*re, *im] = *pair;
        }
        let Parts { re, im } = self.transform.run(simd, a, b);
        let ([first, inner @ .., last], [mean_re, re @ ..], [mean_im, im @ ..]) = (self.spectrum, re, im)
        else {
            return;
        };
        // Of a real series the mean and the Nyquist coefficient are real.
        *first = Complex64::new(*mean_re + *mean_im, 0.0);
        *last = Complex64::new(*mean_re - *mean_im, 0.0);
        // What even and odd samples have, from their sum as real and imaginary parts.
        let Turns { cos, sin } = &self.transform.turns;
        let n = inner.len();
        let (re, im, cos, sin) = (&re[..n], &im[..n], &cos[1..][..n], &sin[1..][..n]);
        for k in 0..n {
            let opposite = n - 1 - k;
            let even = (0.5 * (re[k] + re[opposite]), 0.5 * (im[k] - im[opposite]));
            let odd = (0.5 * (im[k] + im[opposite]), 0.5 * (re[opposite] - re[k]));
            inner[k].re = even.0 + (odd.0 * cos[k] - odd.1 * sin[k]);
            inner[k].im = even.1 + (odd.0 * sin[k] + odd.1 * cos[k]);
        }
    }
}

struct Inverse<'a> {
    transform: &'a Transform,
    spectrum: &'a [Complex64],
    samples: &'a mut [f64],
    scratch: &'a mut [Complex64],
}

impl WithSimd for Inverse<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let (a, b) = halves(self.scratch);
        let scale = 1.0 / self.samples.len() as f64;
        let [first, inner @ .., last] = self.spectrum else { return };
        // With real and imaginary parts exchanged a transform is its inverse.
        let ([mean_im, im @ ..], [mean_re, re @ ..]) = (&mut *a.re, &mut *a.im) else { return };
        // Of a real series the mean and the Nyquist coefficient are real.
        (*mean_re, *mean_im) = (scale * (first.re + last.re), scale * (first.re - last.re));
        let Turns { cos, sin } = &self.transform.turns;
        let n = inner.len();
        let (re, im, cos, sin) = (&mut re[..n], &mut im[..n], &cos[1..][..n], &sin[1..][..n]);
        for k in 0..n {
            let (c, opposite) = (inner[k], inner[n - 1 - k]);
            let sum = (scale * (c.re + opposite.re), scale * (c.im - opposite.im));
            let difference = (scale * (c.re - opposite.re), scale * (c.im + opposite.im));
            re[k] = sum.0 - (difference.1 * cos[k] - difference.0 * sin[k]);
            im[k] = sum.1 + (difference.0 * cos[k] + difference.1 * sin[k]);
        }
        let Parts { re, im } = self.transform.run(simd, a, b);
        for (pair, (im, re)) in self.samples.as_chunks_mut().0.iter_mut().zip(re.iter().zip(im.iter())) {
            *pair = [*re, *im];
        }
    }
}

/// Finds factors from 2 to 5, the large ones first; what is left of other prime factors is no factor.
fn factors(length: usize) -> Vec<usize> {
    let (mut left, mut factors) = (length.max(1), Vec::new());
    for factor in [5, 4, 3, 2] {
        while left.is_multiple_of(factor) {
            left /= factor;
            factors.push(factor);
        }
    }
    debug_assert_eq!(left, 1, "a length without prime factors above 5");
    factors
}

/// A cache of something that depends on the length of a series.
pub struct ByLength<T>(HashMap<usize, Arc<T>>);

impl<T> Default for ByLength<T> {
    fn default() -> ByLength<T> {
        ByLength(HashMap::new())
    }
}

impl<T> ByLength<T> {
    /// Returns what is kept for a length, made first where it is new.
    pub fn get(&mut self, length: usize, make: impl FnOnce() -> T) -> Arc<T> {
        self.0.entry(length).or_insert_with(|| Arc::new(make())).clone()
    }
}

/// Finds the least even number of at least `n` without prime factors above 5: a length that a fast Fourier transform likes.
pub fn even_smooth_at_least(n: usize) -> usize {
    let smooth = |mut n: usize| {
        for prime in [2, 3, 5] {
            while n.is_multiple_of(prime) {
                n /= prime;
            }
        }
        n == 1
    };
    let mut candidate = n.next_multiple_of(2).max(2);
    while !smooth(candidate) {
        candidate += 2;
    }
    candidate
}
