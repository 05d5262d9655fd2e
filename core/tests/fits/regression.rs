//! Least squares, probit regression and distributions against statsmodels, scipy and mpmath
//! (scripts/reference/fits.py).

use std::collections::BTreeSet;

use proptest::prelude::*;
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};
use rockfrag_core::statistics::clusters::clustered_error_of_mean;
use rockfrag_core::statistics::distributions::{chi_squared_quantile, f_upper_tail, t_quantile};
use rockfrag_core::statistics::normal::{cdf, ln_cdf, ln_cdf_and_slope, quantile};
use rockfrag_core::statistics::scores::{auc, brier_score, largest_difference, log_score};
use rockfrag_core::statistics::{FitStatus, clustered_probit, held_out, least_squares, probit};

use crate::common::{Row, answers, close, data, random, read};

#[test]
fn probit_equals_statsmodels_where_classes_barely_overlap() {
    let expected = answers("nearly_separated_answers.csv");
    let rows: Vec<Row> = read("nearly_separated.csv");
    let [x, y] = ["x", "y"].map(|name| rows.iter().map(|row| row.get(name)).collect::<Vec<f64>>());
    let events: Vec<bool> = rows.iter().map(|row| row.text("event") == "1").collect();
    let probit = probit(&[&x, &y], &events).unwrap();
    for k in 0..3 {
        close(probit.fit.coefficients[k], expected[&format!("b{k}")], 1e-8);
        close(probit.fit.covariance[(k, k)].sqrt(), expected[&format!("se{k}")], 1e-8);
    }
    close(probit.log_likelihood, expected["llf"], 1e-8);
}

#[test]
fn a_line_where_there_is_a_parabola_is_a_poor_fit() {
    let data = data();
    let events: Vec<bool> =
        data.x.iter().zip(&data.y).map(|(x, y)| (x - 0.4).abs() + 0.3 * y > 0.3).collect();
    let curve = clustered_probit(&[&data.x], &events, &data.cells).unwrap();
    assert!(curve.status == FitStatus::PoorFit && curve.largest_difference > Some(0.15), "{curve:?}");
}

#[test]
fn the_largest_difference_is_that_of_a_bin_which_chance_does_not_explain() {
    // 125 cases at 0.2, of which every fifth happens, and 80 at 0.5: two bins each, of equal variance.
    let difference = |happens: fn(usize) -> bool| {
        let probabilities = [[0.2; 125].as_slice(), &[0.5; 80]].concat();
        let events: Vec<bool> = (0..205).map(|k| if k < 125 { k % 5 == 0 } else { happens(k) }).collect();
        largest_difference(&probabilities, &events)
    };
    close(difference(|k| k % 4 > 0).unwrap(), 0.25, 1e-12);
    assert_eq!(difference(|k| k % 5 < 3), Some(0.0), "0.6 of 40 is by chance");
    assert_eq!(largest_difference(&[0.5; 40], &[true; 40]), None, "one bin tells nothing");
}

#[test]
fn distributions_equal_scipys() {
    let expected = answers("uncertainty_answers.csv");
    for (found, expected, tolerance) in [
        (f_upper_tail(4.2, 2.0, 37.0), expected["f"], 1e-12),
        (cdf(0.5), 0.691_462_461_274_013_1, 1e-15),
        (cdf(-10.0), 7.619_853_024_160_525e-24, 1e-13),
        (cdf(2.0), 0.977_249_868_051_820_8, 1e-15),
        (quantile(0.975), 1.959_963_984_540_054, 1e-15),
        (quantile(1e-300), -37.047_096_299_361_2, 1e-13),
    ] {
        close(found, expected, tolerance);
    }
    for p in [1e-12, 0.001, 0.3, 0.5, 0.8, 0.999] {
        close(cdf(quantile(p)), p, 1e-13);
    }
    assert_eq!([0.0, 1.0].map(quantile), [f64::NEG_INFINITY, f64::INFINITY]);
    for (degrees, expected) in [
        (1.0, 12.706_204_736_174_698),
        (5.0, 2.570_581_835_636_314),
        (30.0, 2.042_272_456_301_237_8),
        (1000.0, 1.962_339_080_826_408_3),
        (f64::INFINITY, 1.959_963_984_540_054),
    ] {
        close(t_quantile(0.975, degrees), expected, 1e-10);
        close(t_quantile(0.025, degrees), -expected, 1e-10);
    }
    for (share, degrees, expected) in [
        (0.025, 12.0, 4.403_788_506_981_701),
        (0.975, 0.7, 4.136_665_825_733_002),
        (0.5, 40.5, 39.835_319_570_076_19),
    ] {
        close(chi_squared_quantile(share, degrees), expected, 1e-10);
    }
}

#[test]
fn the_logarithm_of_a_normal_probability_and_its_slope_hold_everywhere() {
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
fn scores_have_their_textbook_values() {
    let events = [false, false, true, true];
    assert_eq!(auc(&[0.1, 0.4, 0.35, 0.8], &events), 0.75);
    assert_eq!(auc(&[1.0; 4], &events), 0.5);
    assert_eq!(brier_score(&[0.0, 0.5, 1.0, 0.5], &events), 0.125);
    assert_eq!(log_score(&[1.0, 0.0], &[true, false]), 0.0);
    assert_eq!(log_score(&[1.0], &[false]), f64::NEG_INFINITY);
    close(log_score(&[0.25; 2], &[true, false]), 0.5 * (0.25f64.ln() + 0.75f64.ln()), 1e-15);
    // Each case a cluster of its own: the standard error of a mean.
    let error = clustered_error_of_mean(&[1.0, 2.0, 3.0, 6.0], &[0, 1, 2, 3]);
    close(error, (14.0 / 3.0 / 4.0f64).sqrt(), 1e-15);
    // Two clusters whose sums about the mean are -3 and 3.
    close(clustered_error_of_mean(&[1.0, 2.0, 3.0, 6.0], &[7, 7, 2, 2]), (2.0 * 18.0f64).sqrt() / 4.0, 1e-15);
}

#[test]
fn whole_clusters_are_left_out_once() {
    // z = x, and the clusters that a fit has seen, a bit each.
    let fit = |x: &[Vec<f64>], _: &[()]| {
        let seen = x[0].iter().fold(0_u64, |seen, &cluster| seen | 1 << cluster as u32);
        Some((least_squares(&[[0.0, 1.0, 2.0]], &[0.0, 1.0, 2.0]).ok()?.fit, seen))
    };
    for clusters in [35_u32, 3] {
        let of: Vec<u32> = (0..clusters * 4).map(|case| case % clusters).collect();
        let x: Vec<f64> = of.iter().copied().map(f64::from).collect();
        let predicted = held_out(&[&x], &vec![(); x.len()], &of, fit).unwrap();
        for ((z, seen), (x, cluster)) in predicted.iter().zip(x.iter().zip(&of)) {
            assert!((z - x).abs() < 1e-9 && seen >> cluster & 1 == 0, "one cluster, one fold");
        }
        let folds: BTreeSet<u64> = predicted.into_iter().map(|(_, seen)| seen).collect();
        assert_eq!(folds.len(), clusters.min(10) as usize);
        let left_out = folds.iter().map(|seen| clusters - seen.count_ones());
        assert!(left_out.clone().all(|left_out| left_out.abs_diff(clusters.div_ceil(10)) <= 1));
        assert_eq!(left_out.sum::<u32>(), clusters);
    }
    assert!(held_out(&[&[1.0; 3]], &[(); 3], &[5; 3], fit).is_none());
    assert!(held_out(&[&[]], &[], &[], fit).is_none());
}

#[test]
fn want_of_cases_of_variation_and_of_events_are_statuses() {
    let x: Vec<f64> = (0..50).map(f64::from).collect();
    let twice: Vec<f64> = x.iter().map(|x| 3.0 - 2.0 * x).collect();
    let noise: Vec<f64> = x.iter().map(|x| (x * 7.7).sin()).collect();
    for (x, y) in
        [(&[&x[..2]][..], &noise[..2]), (&[&[1.0; 50]], &noise), (&[&x], &[0.3; 50]), (&[&x, &twice], &noise)]
    {
        assert_eq!(least_squares(x, y).unwrap_err(), FitStatus::Degenerate);
    }
    let events = |happened: fn(usize) -> bool| (0..50).map(happened).collect::<Vec<bool>>();
    let mixed = events(|k| k * 7 % 10 < 4);
    assert_eq!(probit(&[&x], &events(|k| k % 13 == 0)).unwrap_err(), FitStatus::TooFewEvents);
    assert_eq!(probit(&[&x], &events(|k| k % 13 != 0)).unwrap_err(), FitStatus::TooFewEvents);
    assert_eq!(probit(&[&x, &twice], &mixed).unwrap_err(), FitStatus::Degenerate);
    assert_eq!(probit(&[&[2.0; 50]], &mixed).unwrap_err(), FitStatus::Degenerate);
    assert_eq!(probit(&[&x], &events(|k| k > 25)).unwrap_err(), FitStatus::Separated);
    assert_eq!(probit(&[&x], &mixed).unwrap().status, FitStatus::Ok);
    let of_nine = clustered_probit(&[&x], &events(|k| k % 6 == 0), &[0; 50]).unwrap();
    assert_eq!(of_nine.status, FitStatus::FewEvents);
}

#[test]
fn threads_do_not_change_a_bit() {
    let n = 30_000;
    let mut random = random(3);
    let x: Vec<f64> = (0..n).map(|_| StandardNormal.sample(&mut random)).collect();
    let events: Vec<bool> = x.iter().map(|x| *x + random.random_range(-2.0..2.0) > 0.5).collect();
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| clustered_probit(&[&x], &events, &[0; 30_000]).unwrap())
    };
    assert_eq!(on(1), on(3));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn classes_that_touch_on_a_line_are_separated(angle in 0.0..6.3f64, seed in 1u64..100_000) {
        // Both classes on one line and each on its own side of it, turned by `angle`.
        let mut random = random(seed);
        let events: Vec<bool> = (0..60).map(|k| k % 2 == 0).collect();
        let case = |k: usize| {
            let side = if events[k] { 1.0 } else { -1.0 };
            let across = if k < 20 { 0.0 } else { side * random.random_range(0.0..1.0) };
            let along = random.random_range(0.0..4.0);
            (across * angle.cos() - along * angle.sin(), across * angle.sin() + along * angle.cos())
        };
        let (x, y): (Vec<f64>, Vec<f64>) = (0..60).map(case).unzip();
        prop_assert_eq!(probit(&[&x, &y], &events).unwrap_err(), FitStatus::Separated);
    }
}
