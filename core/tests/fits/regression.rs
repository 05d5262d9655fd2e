//! Least squares and probit regression against statsmodels and pyFragility
//! (scripts/reference/fits.py).

use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};
use rockfrag_core::statistics::clusters::clustered_mean;
use rockfrag_core::statistics::distributions::{
    chi_squared_quantile, chi_squared_upper_tail, f_upper_tail, t_quantile,
};
use rockfrag_core::statistics::scores::{auc, brier_score, log_score};
use rockfrag_core::statistics::{FitStatus, Folds, least_squares, log_likelihood, probit};
use rockfrag_core::statistics::{tested_least_squares, tested_probit};

use crate::common::{answers, close, data, random, read};

#[test]
fn probit_equals_statsmodels_where_classes_barely_overlap() {
    let expected = answers("nearly_separated_answers.csv");
    let rows: Vec<(f64, f64, u8)> = read("nearly_separated.csv");
    let x: Vec<f64> = rows.iter().map(|row| row.0).collect();
    let y: Vec<f64> = rows.iter().map(|row| row.1).collect();
    let events: Vec<bool> = rows.iter().map(|row| row.2 == 1).collect();
    let probit = probit(&[&x, &y], &events).unwrap();
    for k in 0..3 {
        close(probit.fit.coefficients[k], expected[&format!("b{k}")], 1e-8);
        close(probit.fit.covariance[(k, k)].sqrt(), expected[&format!("se{k}")], 1e-8);
    }
    close(probit.log_likelihood, expected["llf"], 1e-8);
}

#[test]
fn tests_of_the_form_and_errors_of_lone_cases_equal_statsmodels() {
    let (data, expected) = (data(), answers("uncertainty_answers.csv"));
    let alone: Vec<u32> = (0..data.x.len() as u32).collect();
    for name in ["x", "xy"] {
        let x = data.predictors(name);
        let curve = tested_probit(&x, &data.event, &alone).unwrap().fit;
        let plane = tested_least_squares(&x, &data.demand, &alone).unwrap().fit;
        close(curve.misfit_p.unwrap(), expected[&format!("probit_{name}_misfit_p")], 1e-6);
        close(plane.misfit_p.unwrap(), expected[&format!("ols_{name}_misfit_p")], 1e-7);
        assert_eq!((curve.clusters, curve.status, plane.status), (400, FitStatus::Ok, FitStatus::Ok));
        close(plane.clustered.unwrap()[(1, 1)].sqrt(), expected[&format!("ols_{name}_hc1_1")], 1e-9);
    }
}

#[test]
fn a_line_where_there_is_a_parabola_is_a_poor_fit() {
    let data = data();
    let parabola: Vec<f64> = data.x.iter().zip(&data.demand).map(|(x, noise)| x * x + 0.1 * noise).collect();
    let plane = tested_least_squares(&[&data.x], &parabola, &data.cells).unwrap().fit;
    let events: Vec<bool> =
        data.x.iter().zip(&data.y).map(|(x, y)| (x - 0.4).abs() + 0.3 * y > 0.3).collect();
    let curve = tested_probit(&[&data.x], &events, &data.cells).unwrap().fit;
    assert_eq!((plane.status, curve.status), (FitStatus::PoorFit, FitStatus::PoorFit));
    assert!(curve.misfit_p.unwrap() < 1e-6, "{:?}", curve.misfit_p);
}

#[test]
fn the_likelihood_is_a_product_of_probabilities() {
    let x = DMatrix::from_row_slice(3, 2, &[1.0, -0.3, 1.0, 0.4, 1.0, 1.1]);
    let b = DVector::from_vec(vec![0.2, 0.7]);
    let p = |case: usize| rockfrag_core::statistics::normal::cdf(0.2 + 0.7 * x[(case, 1)]);
    let likelihood = p(0) * (1.0 - p(1)) * p(2);
    close(log_likelihood(&x, &[true, false, true], &b), likelihood.ln(), 1e-13);
}

#[test]
fn distributions_equal_scipys() {
    let expected = answers("uncertainty_answers.csv");
    close(chi_squared_upper_tail(7.3, 5.0), expected["chi_squared"], 1e-13);
    close(chi_squared_upper_tail(21.4, 8.0), expected["chi_squared_even"], 1e-13);
    close(f_upper_tail(4.2, 2.0, 37.0), expected["f"], 1e-12);
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
    for (share, degrees) in [(0.025, 12.0), (0.975, 0.7), (0.5, 40.5)] {
        close(chi_squared_upper_tail(chi_squared_quantile(share, degrees), degrees), 1.0 - share, 1e-10);
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
    let (mean, error) = clustered_mean(&[1.0, 2.0, 3.0, 6.0], &[0, 1, 2, 3]);
    close(mean, 3.0, 1e-15);
    close(error, (14.0 / 3.0 / 4.0f64).sqrt(), 1e-15);
    // Two clusters whose sums about the mean are -3 and 3.
    close(clustered_mean(&[1.0, 2.0, 3.0, 6.0], &[7, 7, 2, 2]).1, (2.0 * 18.0f64).sqrt() / 4.0, 1e-15);
}

#[test]
fn whole_clusters_are_left_out_once() {
    for (clusters, most) in [(35, 10), (35, 100), (3, 10)] {
        let of: Vec<u32> = (0..clusters * 4).map(|case| 7 * (case % clusters)).collect();
        let folds = Folds::new(&of, most).unwrap();
        assert_eq!(folds.count, most.min(clusters as usize));
        let mut left_out_in_all = Vec::new();
        for fold in 0..folds.count {
            let (kept, left_out) = folds.split(fold);
            assert!(
                left_out.iter().all(|out| kept.iter().all(|kept| of[*kept] != of[*out])),
                "one cluster, one fold"
            );
            assert!(left_out.len().abs_diff(of.len() / folds.count) <= 4);
            left_out_in_all.extend(left_out);
        }
        left_out_in_all.sort_unstable();
        assert!(left_out_in_all.into_iter().eq(0..of.len()));
    }
    assert_eq!((Folds::new(&[5, 5, 5], 10), Folds::new(&[], 10)), (None, None));
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
    assert_eq!(probit(&[&x], &mixed).unwrap().fit.status, FitStatus::Ok);
}

#[test]
fn threads_do_not_change_a_bit() {
    let n = 30_000;
    let mut random = random(3);
    let x: Vec<f64> = (0..n).map(|_| StandardNormal.sample(&mut random)).collect();
    let events: Vec<bool> = x.iter().map(|x| *x + random.random_range(-2.0..2.0) > 0.5).collect();
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| tested_probit(&[&x], &events, &[0; 30_000]).unwrap())
    };
    assert_eq!(on(1), on(3));
}

/// Both classes on one line and each on its own side of it, turned by `angle`: quasi-complete separation.
fn touching_on_a_line(angle: f64, seed: u64) -> (Vec<f64>, Vec<f64>, Vec<bool>) {
    let mut random = random(seed);
    let mut case = |k: usize| {
        let side = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        let across = if k < 20 { 0.0 } else { side * random.random_range(0.0..1.0) };
        let along = random.random_range(0.0..4.0);
        (across * angle.cos() - along * angle.sin(), across * angle.sin() + along * angle.cos())
    };
    let (x, y) = (0..60).map(&mut case).unzip();
    (x, y, (0..60usize).map(|k| k.is_multiple_of(2)).collect())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn classes_that_touch_on_a_line_are_separated(angle in 0.0..6.3f64, seed in 1u64..100_000) {
        let (x, y, events) = touching_on_a_line(angle, seed);
        prop_assert_eq!(probit(&[&x, &y], &events).unwrap_err(), FitStatus::Separated);
    }

}
