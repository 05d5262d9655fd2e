use std::f64::consts::{FRAC_1_SQRT_2, FRAC_2_SQRT_PI, LN_2};

use super::exponential::falling_exp;
use super::logarithm::ln;
use super::polynomial::polynomial;

/// 1 / sqrt(2 pi).
const DENSITY_AT_0: f64 = 0.5 * FRAC_2_SQRT_PI * FRAC_1_SQRT_2;

/// Logarithm of the cumulative probability at `x`, precise in both tails. Without branches or calls, as [`inverse_mills`].
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

/// Density over cumulative probability at `x`, the inverse Mills ratio and derivative of [`ln_cdf`], precise in both
/// tails. Without branches or calls, for loops in vector registers.
#[inline(always)]
pub fn inverse_mills(x: f64) -> f64 {
    let y = x.abs() * FRAC_1_SQRT_2;
    let (scaled, fall) = (scaled_erfc_by_1_plus(y), falling_exp(-0.5 * x * x));
    // Numerator and denominator times 1 + y.
    let (density, below) = (DENSITY_AT_0 * (1.0 + y), x < 0.0);
    let numerator = if below { density } else { density * fall };
    numerator / if below { 0.5 * scaled } else { (1.0 + y) - 0.5 * fall * scaled }
}

/// exp(y^2) erfc(y) (1 + y) for y >= 0, to 4e-16: a polynomial in t = (y - 3) / (y + 3), which takes all y to -1..1
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
