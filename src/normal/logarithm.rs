use std::f64::consts::LN_2;

use super::polynomial::polynomial;

/// The bits of the root of 1/2: what a number is above it, in the place of the exponent, is a whole power of two.
const ROOT_OF_HALF: u64 = 0x3fe6_a09e_667f_3bcd;

/// ln x for normal x > 0, to 6e-16 and without branches: ln(2^n m) = n ln 2 + 2 atanh(s), s = (m - 1) / (m + 1), |s| < 0.172.
#[inline(always)]
pub fn ln(x: f64) -> f64 {
    let powers = x.to_bits().wrapping_sub(ROOT_OF_HALF) as i64 >> 52;
    let m = f64::from_bits(x.to_bits().wrapping_sub((powers as u64) << 52));
    let s = (m - 1.0) / (m + 1.0);
    powers as f64 * LN_2 + 2.0 * s * polynomial(&SERIES, s * s)
}

/// 1 / (2 k + 1): what is left out is below 1e-19 at |s| = 0.172.
const SERIES: [f64; 12] = {
    let mut series = [1.0; 12];
    let mut k = 1;
    while k < series.len() {
        series[k] = 1.0 / (2 * k + 1) as f64;
        k += 1;
    }
    series
};
