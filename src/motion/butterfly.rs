//! The passes of a fast Fourier transform over rows of complex numbers, in vector registers. Nothing is fused: without the
//! instruction for it that is slow, and with it the transform gains little.

use std::f64::consts::TAU;
use std::ops::{Add, Sub};

use pulp::Simd;

/// Real and imaginary parts.
pub struct Parts<'a> {
    pub re: &'a mut [f64],
    pub im: &'a mut [f64],
}

/// Unit complex numbers.
#[derive(Default)]
pub struct Turns {
    pub cos: Vec<f64>,
    pub sin: Vec<f64>,
}

impl Turns {
    /// Computes exp(-2 pi i k / n) of each k.
    pub fn new(of: impl Iterator<Item = usize>, n: usize) -> Turns {
        let mut turns = Turns::default();
        for k in of {
            let (sin, cos) = libm::sincos(-TAU * (k % n) as f64 / n as f64);
            turns.cos.push(cos);
            turns.sin.push(sin);
        }
        turns
    }
}

/// One factor of the length of transforms along the columns: Stockham's, which needs no sorting (Swarztrauber 1984, FFT algorithms
/// for vector computers, Parallel Computing 1, 45-63).
pub struct Pass {
    radix: usize,
    /// Numbers from one input of a butterfly to the next one of the same column.
    rows: usize,
    /// Columns, times the factors of earlier passes.
    stride: usize,
    turns: Turns,
}

impl Pass {
    /// Plans the passes of transforms of this length along each of some columns.
    pub fn all(factors: &[usize], length: usize, columns: usize) -> Vec<Pass> {
        let (mut length, mut stride) = (length, columns);
        let pass = |&radix: &usize| {
            let rows = length / radix;
            let places = (0..rows).flat_map(|row| (0..radix).map(move |k| row * k));
            let pass = Pass { radix, rows, stride, turns: Turns::new(places, length) };
            (length, stride) = (rows, stride * radix);
            pass
        };
        factors.iter().map(pass).collect()
    }

    #[inline(always)]
    pub fn run<S: Simd>(&self, simd: S, from: &Parts, to: &mut Parts) {
        match self.radix {
            2 => self.butterflies::<S, Two, 2>(simd, from, to),
            3 => self.butterflies::<S, Three, 3>(simd, from, to),
            4 => self.butterflies::<S, Four, 4>(simd, from, to),
            _ => self.butterflies::<S, Five, 5>(simd, from, to),
        }
    }

    #[inline(always)]
    fn butterflies<S: Simd, B: Butterfly<R>, const R: usize>(&self, simd: S, from: &Parts, to: &mut Parts) {
        let (rows, stride) = (self.rows, self.stride);
        let whole = stride / S::F64_LANES;
        let outputs = to.re.chunks_exact_mut(R * stride).zip(to.im.chunks_exact_mut(R * stride));
        for (row, (to_re, to_im)) in outputs.enumerate() {
            let (mut re, mut im) = ([<&[f64]>::default(); R], [<&[f64]>::default(); R]);
            let (mut cos, mut sin) = ([simd.splat_f64s(0.0); R], [simd.splat_f64s(0.0); R]);
            for k in 0..R {
                let start = stride * (row + rows * k);
                (re[k], im[k]) = (&from.re[start..start + stride], &from.im[start..start + stride]);
                cos[k] = simd.splat_f64s(self.turns.cos[R * row + k]);
                sin[k] = simd.splat_f64s(self.turns.sin[R * row + k]);
            }
            let mut inputs = [Numbers { simd, re: cos[0], im: sin[0] }; R];
            for q in 0..whole {
                for k in 0..R {
                    inputs[k].re = S::as_simd_f64s(re[k]).0[q];
                    inputs[k].im = S::as_simd_f64s(im[k]).0[q];
                }
                let outputs = turned(B::transform(inputs), cos, sin);
                for k in 0..R {
                    S::as_mut_simd_f64s(&mut to_re[k * stride..][..stride]).0[q] = outputs[k].re;
                    S::as_mut_simd_f64s(&mut to_im[k * stride..][..stride]).0[q] = outputs[k].im;
                }
            }
            if whole * S::F64_LANES < stride {
                for k in 0..R {
                    inputs[k].re = simd.partial_load_f64s(S::as_simd_f64s(re[k]).1);
                    inputs[k].im = simd.partial_load_f64s(S::as_simd_f64s(im[k]).1);
                }
                let outputs = turned(B::transform(inputs), cos, sin);
                for k in 0..R {
                    let (re, im) = (&mut to_re[k * stride..][..stride], &mut to_im[k * stride..][..stride]);
                    simd.partial_store_f64s(S::as_mut_simd_f64s(re).1, outputs[k].re);
                    simd.partial_store_f64s(S::as_mut_simd_f64s(im).1, outputs[k].im);
                }
            }
        }
    }
}

#[inline(always)]
fn turned<S: Simd, const R: usize>(
    mut numbers: [Numbers<S>; R],
    cos: [S::f64s; R],
    sin: [S::f64s; R],
) -> [Numbers<S>; R] {
    for k in 1..R {
        numbers[k] = numbers[k].turned(cos[k], sin[k]);
    }
    numbers
}

/// A register of complex numbers.
#[derive(Clone, Copy)]
struct Numbers<S: Simd> {
    simd: S,
    re: S::f64s,
    im: S::f64s,
}

impl<S: Simd> Add for Numbers<S> {
    type Output = Numbers<S>;

    #[inline(always)]
    fn add(self, other: Numbers<S>) -> Numbers<S> {
        let Numbers { simd, re, im } = self;
        Numbers { simd, re: simd.add_f64s(re, other.re), im: simd.add_f64s(im, other.im) }
    }
}

impl<S: Simd> Sub for Numbers<S> {
    type Output = Numbers<S>;

    #[inline(always)]
    fn sub(self, other: Numbers<S>) -> Numbers<S> {
        let Numbers { simd, re, im } = self;
        Numbers { simd, re: simd.sub_f64s(re, other.re), im: simd.sub_f64s(im, other.im) }
    }
}

impl<S: Simd> Numbers<S> {
    #[inline(always)]
    fn times(self, factor: f64) -> Numbers<S> {
        let Numbers { simd, re, im } = self;
        let factor = simd.splat_f64s(factor);
        Numbers { simd, re: simd.mul_f64s(re, factor), im: simd.mul_f64s(im, factor) }
    }

    #[inline(always)]
    fn turned(self, cos: S::f64s, sin: S::f64s) -> Numbers<S> {
        let Numbers { simd, re, im } = self;
        Numbers {
            simd,
            re: simd.sub_f64s(simd.mul_f64s(re, cos), simd.mul_f64s(im, sin)),
            im: simd.add_f64s(simd.mul_f64s(re, sin), simd.mul_f64s(im, cos)),
        }
    }

    /// Divides by i.
    #[inline(always)]
    fn by_i(self) -> Numbers<S> {
        Numbers { re: self.im, im: self.simd.neg_f64s(self.re), ..self }
    }
}

/// The transform of so few numbers: a trait, because functions that are handed over are not inlined.
trait Butterfly<const R: usize> {
    fn transform<S: Simd>(numbers: [Numbers<S>; R]) -> [Numbers<S>; R];
}

struct Two;

impl Butterfly<2> for Two {
    #[inline(always)]
    fn transform<S: Simd>([a, b]: [Numbers<S>; 2]) -> [Numbers<S>; 2] {
        [a + b, a - b]
    }
}

struct Three;

impl Butterfly<3> for Three {
    #[inline(always)]
    fn transform<S: Simd>([a, b, c]: [Numbers<S>; 3]) -> [Numbers<S>; 3] {
        const SIN_60: f64 = 0.866_025_403_784_438_6;
        let sum = b + c;
        let (middle, across) = (a - sum.times(0.5), (b - c).times(SIN_60).by_i());
        [a + sum, middle + across, middle - across]
    }
}

struct Four;

impl Butterfly<4> for Four {
    #[inline(always)]
    fn transform<S: Simd>([a, b, c, d]: [Numbers<S>; 4]) -> [Numbers<S>; 4] {
        let (even, odd) = (a + c, b + d);
        let (middle, across) = (a - c, (b - d).by_i());
        [even + odd, middle + across, even - odd, middle - across]
    }
}

struct Five;

impl Butterfly<5> for Five {
    #[inline(always)]
    fn transform<S: Simd>([a, b, c, d, e]: [Numbers<S>; 5]) -> [Numbers<S>; 5] {
        const COS_72: f64 = 0.309_016_994_374_947_45;
        const COS_144: f64 = -0.809_016_994_374_947_5;
        const SIN_72: f64 = 0.951_056_516_295_153_5;
        const SIN_144: f64 = 0.587_785_252_292_473_1;
        let (near, far, near_across, far_across) = (b + e, c + d, b - e, c - d);
        let first = a + near.times(COS_72) + far.times(COS_144);
        let second = a + near.times(COS_144) + far.times(COS_72);
        let first_across = (near_across.times(SIN_72) + far_across.times(SIN_144)).by_i();
        let second_across = (near_across.times(SIN_144) - far_across.times(SIN_72)).by_i();
        [
            a + near + far,
            first + first_across,
            second + second_across,
            second - second_across,
            first - first_across,
        ]
    }
}
