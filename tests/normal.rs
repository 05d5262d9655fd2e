//! The normal distribution against scipy.special.

use rockfrag::normal::{cdf, ln_cdf, pdf, quantile};

fn close(value: f64, expected: f64, tolerance: f64) {
    assert!((value / expected - 1.0).abs() < tolerance, "{value:e}, expected {expected:e}");
}

#[test]
fn cumulative_probabilities_equal_scipys() {
    close(cdf(0.5), 0.691_462_461_274_013_1, 1e-15);
    close(cdf(-10.0), 7.619_853_024_160_525e-24, 1e-13);
    close(pdf(1.0), 0.241_970_724_519_143_37, 1e-15);
}

#[test]
fn logarithms_hold_in_the_far_tail() {
    close(ln_cdf(-5.0), -15.064_998_393_988_727, 1e-14);
    close(ln_cdf(-29.999), -454.291_211_196_123_87, 1e-13);
    close(ln_cdf(-40.0), -804.608_442_013_754, 1e-13);
    close(ln_cdf(8.0), -6.220_960_574_271_786e-16, 1e-9);
    assert!((ln_cdf(-30.0 - 1e-9) - ln_cdf(-30.0 + 1e-9)).abs() < 1e-6);
}

#[test]
fn quantiles_invert_the_distribution() {
    close(quantile(0.975), 1.959_963_984_540_054, 1e-15);
    close(quantile(1e-300), -37.047_096_299_361_2, 1e-13);
    for p in [1e-12, 0.001, 0.3, 0.5, 0.8, 0.999] {
        close(cdf(quantile(p)), p, 1e-13);
    }
    assert_eq!(quantile(0.0), f64::NEG_INFINITY);
    assert_eq!(quantile(1.0), f64::INFINITY);
}
