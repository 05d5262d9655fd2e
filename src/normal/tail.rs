#![expect(clippy::excessive_precision, reason = "the coefficients as Cody published them")]

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_2_SQRT_PI, LN_2};

/// Logarithm of the cumulative probability at `x`, precise in both tails.
pub fn ln_cdf(x: f64) -> f64 {
    let y = x.abs() * FRAC_1_SQRT_2;
    if y <= CENTRE_UP_TO {
        libm::log(central_cdf(x))
    } else if x < 0.0 {
        libm::log(scaled_erfc(y)) - LN_2 - 0.5 * x * x
    } else {
        libm::log1p(-0.5 * libm::exp(-0.5 * x * x) * scaled_erfc(y))
    }
}

/// Density over cumulative probability at `x`, the inverse Mills ratio and derivative of [`ln_cdf`], precise in both tails
/// and without any logarithm.
pub fn inverse_mills(x: f64) -> f64 {
    let y = x.abs() * FRAC_1_SQRT_2;
    if y <= CENTRE_UP_TO {
        DENSITY_AT_0 * libm::exp(-0.5 * x * x) / central_cdf(x)
    } else if x < 0.0 {
        2.0 * DENSITY_AT_0 / scaled_erfc(y)
    } else {
        let fall = libm::exp(-0.5 * x * x);
        DENSITY_AT_0 * fall / (1.0 - 0.5 * fall * scaled_erfc(y))
    }
}

/// The cumulative probability where |x| is small.
fn central_cdf(x: f64) -> f64 {
    let y = x * FRAC_1_SQRT_2;
    0.5 + 0.5 * y * ratio(y * y, &CENTRE)
}

/// exp(y^2) erfc(y) for y above 0.47, by rational approximations (Cody 1969, Rational Chebyshev approximations for the error
/// function, Mathematics of Computation 23, 631-637).
fn scaled_erfc(y: f64) -> f64 {
    if y <= FLANK_UP_TO {
        ratio(y, &FLANK)
    } else {
        let u = 1.0 / (y * y);
        (0.5 * FRAC_2_SQRT_PI - u * ratio(u, &TAIL)) / y
    }
}

/// 1 / sqrt(2 pi).
const DENSITY_AT_0: f64 = 0.5 * FRAC_2_SQRT_PI * FRAC_1_SQRT_2;
/// Where the approximations meet.
const CENTRE_UP_TO: f64 = 0.46875;
const FLANK_UP_TO: f64 = 4.0;

/// Numerator and denominator, highest power first.
type Rational<const N: usize> = ([f64; N], [f64; N]);

fn ratio<const N: usize>(x: f64, (numerator, denominator): &Rational<N>) -> f64 {
    let horner = |c: &[f64; N]| c.iter().fold(0.0, |sum, coefficient| sum * x + coefficient);
    horner(numerator) / horner(denominator)
}

/// erf(y) / y, in y^2.
const CENTRE: Rational<5> = (
    [
        1.857_777_061_846_031_53e-1,
        3.161_123_743_870_565_60,
        1.138_641_541_510_501_56e2,
        3.774_852_376_853_020_21e2,
        3.209_377_589_138_469_47e3,
    ],
    [
        1.0,
        2.360_129_095_234_412_09e1,
        2.440_246_379_344_441_73e2,
        1.282_616_526_077_372_28e3,
        2.844_236_833_439_170_62e3,
    ],
);

/// exp(y^2) erfc(y), in y.
const FLANK: Rational<9> = (
    [
        2.153_115_354_744_038_46e-8,
        5.641_884_969_886_700_89e-1,
        8.883_149_794_388_375_94,
        6.611_919_063_714_162_95e1,
        2.986_351_381_974_001_31e2,
        8.819_522_212_417_690_90e2,
        1.712_047_612_634_070_58e3,
        2.051_078_377_826_071_47e3,
        1.230_339_354_797_997_25e3,
    ],
    [
        1.0,
        1.574_492_611_070_983_47e1,
        1.176_939_508_913_124_99e2,
        5.371_811_018_620_098_58e2,
        1.621_389_574_566_690_19e3,
        3.290_799_235_733_459_63e3,
        4.362_619_090_143_247_16e3,
        3.439_367_674_143_721_64e3,
        1.230_339_354_803_749_42e3,
    ],
);

/// (1/sqrt(pi) - y exp(y^2) erfc(y)) y^2, in 1/y^2.
const TAIL: Rational<6> = (
    [
        1.631_538_713_730_209_78e-2,
        3.053_266_349_612_323_44e-1,
        3.603_448_999_498_044_39e-1,
        1.257_817_261_112_292_46e-1,
        1.608_378_514_874_227_66e-2,
        6.587_491_615_298_378_03e-4,
    ],
    [
        1.0,
        2.568_520_192_289_822_42,
        1.872_952_849_923_467_25,
        5.279_051_029_514_284_12e-1,
        6.051_834_131_244_131_91e-2,
        2.335_204_976_268_691_85e-3,
    ],
);
