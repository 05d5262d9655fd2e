use std::f64::consts::LOG2_E;

use super::polynomial::polynomial;

/// Below it the exponential is as good as nothing, and its result no normal number.
const LOWEST: f64 = -708.0;
/// A number so large that adding it rounds to integers, which then are the last bits of the sum.
const ROUNDER: f64 = 1.5 * (1_u64 << 52) as f64;
/// ln 2 as a sum: multiples of the first part by small integers are exact.
const LN_2_PARTS: (f64, f64) = (6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10);

/// exp(x) for x <= 0, never below exp(-708), to 2e-16 and without branches: exp(n ln 2 + r) = 2^n exp(r), |r| <= ln(2)/2.
#[inline(always)]
pub fn falling_exp(x: f64) -> f64 {
    let x = if x < LOWEST { LOWEST } else { x };
    let rounded = x * LOG2_E + ROUNDER;
    let n = rounded - ROUNDER;
    let r = (x - n * LN_2_PARTS.0) - n * LN_2_PARTS.1;
    let power_of_two = f64::from_bits((rounded.to_bits() << 52).wrapping_add(1.0_f64.to_bits()));
    polynomial(&SERIES, r) * power_of_two
}

/// 1 / k!: what is left out is below 1e-17 at |r| = ln(2)/2.
const SERIES: [f64; 14] = {
    let mut series = [1.0; 14];
    let mut k = 1;
    while k < series.len() {
        series[k] = series[k - 1] / k as f64;
        k += 1;
    }
    series
};
