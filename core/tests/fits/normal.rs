//! The normal distribution against scipy.special.

use rockfrag_core::statistics::normal::{cdf, ln_cdf, ln_cdf_and_slope, quantile};

use crate::common::close;

#[test]
fn cumulative_probabilities_equal_scipys() {
    close(cdf(0.5), 0.691_462_461_274_013_1, 1e-15);
    close(cdf(-10.0), 7.619_853_024_160_525e-24, 1e-13);
    close(cdf(2.0), 0.977_249_868_051_820_8, 1e-15);
    // In the far tail.
    close(ln_cdf(-5.0), -15.064_998_393_988_727, 1e-14);
    close(ln_cdf(-29.999), -454.291_211_196_123_87, 1e-13);
    close(ln_cdf(-40.0), -804.608_442_013_754, 1e-13);
}

#[test]
fn logarithm_and_mills_ratio_hold_everywhere() {
    // mpmath with 40 digits; on both sides of the places where the approximations meet.
    let expected = [
        (-1e5, -5_000_000_012.431_864, 100_000.000_01),
        (-30.0, -454.321_243_956_343_2, 30.033_259_667_433_676),
        (-5.66, -18.699_251_153_702_78, 5.827_060_206_839_707),
        (-5.65, -18.641_029_223_787_85, 5.817_325_910_362_102),
        (-1.5, -2.705_944_400_823_889_8, 1.938_677_166_622_543_3),
        (-0.664, -1.373_002_468_841_511_7, 1.263_159_264_575_901),
        (-0.662, -1.370_477_663_784_373_6, 1.261_645_890_163_25),
        (0.0, -std::f64::consts::LN_2, 0.797_884_560_802_865_4),
        (0.6629, -0.292_623_998_166_673_5, 0.429_113_966_122_087_4),
        (0.664, -0.292_152_256_243_063_24, 0.428_598_679_477_312_7),
        (2.5, -0.006_229_025_485_860_002, 0.017_637_825_486_916_735),
        (5.7, -5.990_371_419_005_803e-09, 3.513_955_115_870_33e-08),
        (8.0, -6.220_960_574_271_786e-16, 5.052_271_083_536_9e-15),
    ];
    for (x, logarithm, mills) in expected {
        close(ln_cdf(x), logarithm, 5e-15);
        close(ln_cdf_and_slope(x).1, mills, 5e-15);
    }
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
