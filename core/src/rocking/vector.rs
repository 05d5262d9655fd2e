//! SIMD numbers: [`Vector`]s of f64, one structure to a lane.

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use pulp::{Simd, bytemuck};

/// Repeats a block for each value of a constant; loops over arrays of vectors would work in memory.
macro_rules! unrolled {
    ($k:ident in [$($value:literal)*] $block:block) => {
        $({
            let $k: usize = $value;
            $block
        })*
    };
}
pub(super) use unrolled;

const REGISTERS: usize = 2;

/// Upper bound of [`Vector::LANES`]: registers of 512 bits.
pub const MOST_LANES: usize = REGISTERS * 8;

/// Two vector registers of f64: the processor computes in one while the other waits for a result.
#[derive(Debug, Clone, Copy)]
pub struct Vector<S: Simd> {
    simd: S,
    registers: [S::f64s; REGISTERS],
}

#[derive(Debug, Clone, Copy)]
pub struct Mask<S: Simd> {
    simd: S,
    registers: [S::m64s; REGISTERS],
}

/// Evaluates an expression for each register `k`; a loop or closure may not be inlined, and works in memory.
macro_rules! in_each {
    ($k:ident: $result:expr) => {
        [
            {
                let $k = 0;
                $result
            },
            {
                let $k = 1;
                $result
            },
        ]
    };
}

impl<S: Simd> Vector<S> {
    pub const LANES: usize = REGISTERS * S::F64_LANES;

    #[inline(always)]
    pub fn splat(simd: S, value: f64) -> Vector<S> {
        Vector { simd, registers: [simd.splat_f64s(value); REGISTERS] }
    }

    #[inline(always)]
    pub fn like(self, value: f64) -> Vector<S> {
        Vector::splat(self.simd, value)
    }

    #[inline(always)]
    pub fn lane(&self, lane: usize) -> f64 {
        bytemuck::cast_slice(&self.registers)[lane]
    }

    #[inline(always)]
    pub fn set(&mut self, lane: usize, value: f64) {
        bytemuck::cast_slice_mut(&mut self.registers)[lane] = value;
    }

    #[inline(always)]
    pub fn sqrt(self) -> Vector<S> {
        Vector { registers: in_each!(k: self.simd.sqrt_f64s(self.registers[k])), ..self }
    }

    #[inline(always)]
    pub fn abs(self) -> Vector<S> {
        Vector { registers: in_each!(k: self.simd.abs_f64s(self.registers[k])), ..self }
    }

    #[inline(always)]
    pub fn max(self, other: Vector<S>) -> Vector<S> {
        Vector { registers: in_each!(k: self.simd.max_f64s(self.registers[k], other.registers[k])), ..self }
    }

    /// Computes `self * factor + addend`, rounded once where the processor can.
    #[inline(always)]
    pub fn mul_add(self, factor: Vector<S>, addend: Vector<S>) -> Vector<S> {
        let (a, b, c) = (self.registers, factor.registers, addend.registers);
        Vector { registers: in_each!(k: self.simd.mul_add_e_f64s(a[k], b[k], c[k])), ..self }
    }

    #[inline(always)]
    pub fn lt(self, other: Vector<S>) -> Mask<S> {
        let (simd, a, b) = (self.simd, self.registers, other.registers);
        Mask { simd, registers: in_each!(k: simd.less_than_f64s(a[k], b[k])) }
    }

    #[inline(always)]
    pub fn le(self, other: Vector<S>) -> Mask<S> {
        let (simd, a, b) = (self.simd, self.registers, other.registers);
        Mask { simd, registers: in_each!(k: simd.less_than_or_equal_f64s(a[k], b[k])) }
    }

    /// Computes sine and cosine of angles from 0 to pi/2.
    #[inline(always)]
    pub fn sin_cos(self) -> (Vector<S>, Vector<S>) {
        // Above pi/4, the polynomials of the complement, exchanged.
        let beyond = self.like(std::f64::consts::FRAC_PI_4).lt(self);
        let complement = (self.like(HALF_PI.0) - self) + self.like(HALF_PI.1);
        let y = beyond.select(complement, self);
        let z = y * y;
        let sine = (y * z).mul_add(horner(&SINE, z), y);
        let half = z * 0.5;
        let one = z.like(1.0);
        let leading = one - half;
        let cosine = leading + (z * z).mul_add(horner(&COSINE, z), (one - leading) - half);
        (beyond.select(cosine, sine), beyond.select(sine, cosine))
    }
}

impl<S: Simd> Mask<S> {
    /// Returns `yes` in the lanes of the mask, `no` in the others.
    #[inline(always)]
    pub fn select(self, yes: Vector<S>, no: Vector<S>) -> Vector<S> {
        let (mask, a, b) = (self.registers, yes.registers, no.registers);
        Vector { simd: self.simd, registers: in_each!(k: self.simd.select_f64s(mask[k], a[k], b[k])) }
    }

    /// Packs the mask into bits: bit k is lane k.
    #[inline(always)]
    pub fn bits(self) -> u32 {
        let [first, second] = in_each!(k: bits_of::<S>(&self.registers[k]));
        first | second << S::F64_LANES
    }

    #[inline(always)]
    pub fn any(self) -> bool {
        self.bits() != 0
    }
}

#[inline(always)]
fn bits_of<S: Simd>(mask: &S::m64s) -> u32 {
    let bytes = bytemuck::bytes_of(mask);
    if let [bits] = bytes {
        return u32::from(*bits);
    }
    // Before AVX-512 a mask is a vector of whole words, all ones or all zeros.
    bytes.chunks_exact(8).enumerate().fold(0, |bits, (lane, word)| bits | (u32::from(word[7] >> 7) << lane))
}

macro_rules! lanewise {
    ($($trait:ident $method:ident $on:ident $simd:ident),* $(,)?) => {$(
        impl<S: Simd> $trait for $on<S> {
            type Output = $on<S>;

            #[inline(always)]
            fn $method(self, other: $on<S>) -> $on<S> {
                $on { registers: in_each!(k: self.simd.$simd(self.registers[k], other.registers[k])), ..self }
            }
        }
    )*};
}

lanewise! {
    Add add Vector add_f64s,
    Sub sub Vector sub_f64s,
    Mul mul Vector mul_f64s,
    Div div Vector div_f64s,
    BitAnd bitand Mask and_m64s,
    BitOr bitor Mask or_m64s,
}

impl<S: Simd> Mul<f64> for Vector<S> {
    type Output = Vector<S>;

    #[inline(always)]
    fn mul(self, factor: f64) -> Vector<S> {
        self * self.like(factor)
    }
}

impl<S: Simd> Neg for Vector<S> {
    type Output = Vector<S>;

    #[inline(always)]
    fn neg(self) -> Vector<S> {
        Vector { registers: in_each!(k: self.simd.neg_f64s(self.registers[k])), ..self }
    }
}

impl<S: Simd> Not for Mask<S> {
    type Output = Mask<S>;

    #[inline(always)]
    fn not(self) -> Mask<S> {
        Mask { registers: in_each!(k: self.simd.not_m64s(self.registers[k])), ..self }
    }
}

/// pi/2 as a sum of two numbers: the second is the rounding error of the first.
const HALF_PI: (f64, f64) = (std::f64::consts::FRAC_PI_2, 6.123233995736766e-17);

/// Coefficients of y^3, y^5 ... of sin y and y^4, y^6 ... of cos y, |y| <= pi/4 (FreeBSD k_sin.c, k_cos.c).
const SINE: [f64; 6] = [
    -0.16666666666666632,
    0.00833333333332249,
    -0.0001984126982985795,
    2.7557313707070068e-06,
    -2.5050760253406863e-08,
    1.58969099521155e-10,
];
const COSINE: [f64; 6] = [
    0.0416666666666666,
    -0.001388888888887411,
    2.480158728947673e-05,
    -2.7557314351390663e-07,
    2.087572321298175e-09,
    -1.1359647557788195e-11,
];

#[inline(always)]
fn horner<S: Simd>(c: &[f64; 6], z: Vector<S>) -> Vector<S> {
    let [lower @ .., leading] = c;
    let mut sum = z.like(*leading);
    for &coefficient in lower.iter().rev() {
        sum = sum.mul_add(z, z.like(coefficient));
    }
    sum
}
