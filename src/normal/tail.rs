//! The logarithm of the cumulative probability and its derivative, precise in both tails, without branches or calls: loops over
//! them are compiled into vector registers.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_2_SQRT_PI, LN_2, LOG2_E};

/// 1 / sqrt(2 pi).
const DENSITY_AT_0: f64 = 0.5 * FRAC_2_SQRT_PI * FRAC_1_SQRT_2;

/// Computes the logarithm of the cumulative probability at `x`.
#[inline(always)]
pub fn ln_cdf(x: f64) -> f64 {
    let y = x.abs() * FRAC_1_SQRT_2;
    let (scaled, square) = (scaled_erfc_by_1_plus(y) / (1.0 + y), 0.5 * x * x);
    let above = 0.5 * falling_exp(-square) * scaled;
    let rest = 1.0 - above;
    // ln(1 - q) = ln(u) + ((1 - u) - q) / u, where u is 1 - q rounded.
    let (of, further) =
        if x < 0.0 { (scaled, -LN_2 - square) } else { (rest, ((1.0 - rest) - above) / rest) };
    ln(of) + further
}

/// Computes the inverse Mills ratio at `x`: density over cumulative probability, the derivative of [`ln_cdf`].
#[inline(always)]
pub fn inverse_mills(x: f64) -> f64 {
    let y = x.abs() * FRAC_1_SQRT_2;
    let (scaled, fall) = (scaled_erfc_by_1_plus(y), falling_exp(-0.5 * x * x));
    // Numerator and denominator times 1 + y.
    let (density, below) = (DENSITY_AT_0 * (1.0 + y), x < 0.0);
    let numerator = if below { density } else { density * fall };
    numerator / if below { 0.5 * scaled } else { (1.0 + y) - 0.5 * fall * scaled }
}

/// Computes exp(y^2) erfc(y) (1 + y) for y >= 0, to 4e-16: a polynomial in t = (y - 3) / (y + 3), which takes all y to -1..1
/// (Schonfelder 1978, Chebyshev expansions for the error and related functions, Mathematics of Computation 32, 1232-1240,
/// has the substitution; `scripts/reference/scaled_erfc.py` the coefficients).
#[inline(always)]
fn scaled_erfc_by_1_plus(y: f64) -> f64 {
    polynomial(&SCALED_ERFC, 1.0 - 6.0 / (y + 3.0))
}

/// Lowest power first.
const SCALED_ERFC: [f64; 24] = [
    0.7160046047255597,
    -0.2309273330838092,
    0.0990207536794536,
    -0.010235388899008907,
    -0.02380391310930656,
    0.021957764012701442,
    -0.009750689280996884,
    0.0016185691264430336,
    0.000645814091136283,
    -0.0003672884759160544,
    -2.0550975715793773e-05,
    5.6119363943526435e-05,
    -1.516645651673827e-06,
    -8.99005347960098e-06,
    2.659896163428821e-07,
    1.5887433593337928e-06,
    5.240582486820638e-08,
    -2.934232954461391e-07,
    -3.8279015049245e-08,
    5.0963981864922954e-08,
    1.0449074282988014e-08,
    -7.05532680282689e-09,
    -1.2761010586607124e-09,
    5.542849603288212e-10,
];

/// Lower bound of the exponent: below it the exponential is no normal number.
const LOWEST_EXPONENT: f64 = -708.0;
/// Adding a number so large rounds to integers, which then are the last bits of the sum.
const ROUNDER: f64 = 1.5 * (1_u64 << 52) as f64;
/// ln 2 as a sum: multiples of the first part by small integers are exact.
const LN_2_PARTS: (f64, f64) = (6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10);

/// Computes exp(x) for x <= 0, never below exp(-708), to 2e-16 and without branches: exp(n ln 2 + r) = 2^n exp(r), |r| <= ln(2)/2.
#[inline(always)]
fn falling_exp(x: f64) -> f64 {
    let x = if x < LOWEST_EXPONENT { LOWEST_EXPONENT } else { x };
    let rounded = x * LOG2_E + ROUNDER;
    let n = rounded - ROUNDER;
    let r = (x - n * LN_2_PARTS.0) - n * LN_2_PARTS.1;
    let power_of_two = f64::from_bits((rounded.to_bits() << 52).wrapping_add(1.0_f64.to_bits()));
    polynomial(&EXP_SERIES, r) * power_of_two
}

/// 1 / k!: what is left out is below 1e-17 at |r| = ln(2)/2.
const EXP_SERIES: [f64; 14] = {
    let mut series = [1.0; 14];
    let mut k = 1;
    while k < series.len() {
        series[k] = series[k - 1] / k as f64;
        k += 1;
    }
    series
};

/// Bits of the root of 1/2: the difference of a number's bits to them, in the place of the exponent, is a whole power of two.
const ROOT_OF_HALF: u64 = 0x3fe6_a09e_667f_3bcd;

/// Computes ln x for normal x > 0, to 6e-16 and without branches: ln(2^n m) = n ln 2 + 2 atanh(s), s = (m - 1) / (m + 1), |s| < 0.172.
#[inline(always)]
fn ln(x: f64) -> f64 {
    let powers = x.to_bits().wrapping_sub(ROOT_OF_HALF) as i64 >> 52;
    let m = f64::from_bits(x.to_bits().wrapping_sub((powers as u64) << 52));
    let s = (m - 1.0) / (m + 1.0);
    powers as f64 * LN_2 + 2.0 * s * polynomial(&LN_SERIES, s * s)
}

/// 1 / (2 k + 1): what is left out is below 1e-19 at |s| = 0.172.
const LN_SERIES: [f64; 12] = {
    let mut series = [1.0; 12];
    let mut k = 1;
    while k < series.len() {
        series[k] = 1.0 / (2 * k + 1) as f64;
        k += 1;
    }
    series
};

/// Evaluates c[0] + c[1] x + c[2] x^2 + ..., the even and the odd powers apart: two short chains of operations instead of a long one.
#[inline(always)]
fn polynomial<const N: usize>(c: &[f64; N], x: f64) -> f64 {
    const { assert!(N.is_multiple_of(2)) };
    let square = x * x;
    let (mut even, mut odd) = (c[N - 2], c[N - 1]);
    let mut power = N - 2;
    while power > 0 {
        power -= 2;
        even = even.mul_add(square, c[power]);
        odd = odd.mul_add(square, c[power + 1]);
    }
    x.mul_add(odd, even)
}
