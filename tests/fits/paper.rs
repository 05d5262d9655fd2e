//! How ours stands to what the paper prints.

use rockfrag::fragility::{Case, Plane, plane_sample, rms_difference};
use rockfrag::motion::IntensityMeasures;
use rockfrag::rocking::{Outcome, Structure};
use rockfrag::studies::paper::{EXAMPLE_LAMBDA, example, half_erf, hybrid, joint_test, rms_between};

const OURS: [[f64; 3]; 8] = [
    [0.3, 1.2, -0.5],
    [1.1, 0.7, 0.2],
    [-0.4, 2.1, 0.9],
    [0.8, -0.3, -1.4],
    [2.0, 0.1, 0.6],
    [0.2, 0.9, 1.7],
    [-1.0, 1.5, 0.4],
    [0.6, 0.4, -0.8],
];

/// Widths of the rounding, T2 and its probability.
const T2: [([f64; 3], f64, f64); 2] = [
    ([0.0; 3], 93.64853097833362, 0.0025332550547151693),
    ([0.5, 1.0, 2.0], 56.35677983390611, 0.007932433865428884),
];
const STUDENT: [f64; 2] = [4.447089947089947, 0.07291617747154067];

fn near(ours: f64, theirs: f64) {
    assert!((ours / theirs - 1.0).abs() < 1e-11, "{ours:e} for {theirs:e}");
}

#[test]
fn the_joint_test_equals_numpy_and_scipy() {
    // numpy.cov, numpy.linalg and scipy.stats (f, t) of the same numbers.
    let ours: Vec<Vec<f64>> = OURS.iter().map(|set| set.to_vec()).collect();
    for (rounding, t2, p) in T2 {
        let test = joint_test(&ours, &[2.5, 3.0, -2.0], &rounding).unwrap();
        near(test.statistic, t2);
        near(test.p, p);
    }
    // Of one number it is Student's t, squared.
    let first: Vec<Vec<f64>> = OURS.iter().map(|set| vec![set[0]]).collect();
    let test = joint_test(&first, &[2.5], &[0.0]).unwrap();
    near(test.statistic, STUDENT[0]);
    near(test.p, STUDENT[1]);
    // What does not vary, or too few sets, tell nothing.
    let constant: Vec<Vec<f64>> = OURS.iter().map(|set| vec![set[0], 1.0]).collect();
    assert_eq!(joint_test(&constant, &[1.0, 2.0], &[0.0; 2]), None);
    assert_eq!(joint_test(&ours[..3], &[1.0; 3], &[0.0; 3]), None);
}

#[test]
fn the_joint_test_does_not_depend_on_units() {
    let ours: Vec<Vec<f64>> = OURS.iter().map(|set| set.to_vec()).collect();
    let turn = |set: &[f64]| vec![2.0 * set[0] - set[1], set[1] + 5.0 * set[2], 0.1 * set[2] + 7.0];
    let turned: Vec<Vec<f64>> = ours.iter().map(|set| turn(set)).collect();
    let printed = [2.5, 3.0, -2.0];
    let [a, b] = [(&ours, printed.to_vec()), (&turned, turn(&printed))]
        .map(|(sets, printed)| joint_test(sets, &printed, &[0.0; 3]).unwrap());
    near(a.statistic, b.statistic);
}

#[test]
fn planes_of_seeds_are_apart_by_the_mean_over_pairs() {
    let case = |im4: f64, im3: f64| Case {
        outcome: Outcome::SafeRocking,
        edp: 0.1,
        measures: IntensityMeasures { im1: None, im2: None, im3: Some(im3), im4, im5: 1.0, im6: None },
    };
    let cases = [case(1.5, 2.0), case(2.0, 0.5), case(4.0, 1.0)];
    let [a, b, c] =
        [[1.0, 2.0, 3.0], [0.5, 1.0, 2.0], [-1.0, 0.0, 1.0]].map(|[ln_a, b1, b2]| Plane { ln_a, b1, b2 });
    let sample = plane_sample(&cases, 1.0..3.0);
    let square = |a, b| rms_difference(a, b, &sample).unwrap().powi(2);
    let mean = (square(&a, &b) + square(&a, &c) + square(&b, &c)) / 3.0;
    near(rms_between(&[a, b, c], &sample).unwrap(), mean.sqrt());
    assert_eq!(rms_between(&[a], &sample), None);
    assert_eq!(rms_between(&[a, b], &plane_sample(&cases, 5.0..6.0)), None);
}

#[test]
fn the_worked_example_prints_half_of_one_and_the_error_function() {
    // PGA 0.5 g, PGA/PGV 2 1/s: hybrids 1.55 and 1.88 in the paper, 0.73 and 0.81.
    for (p, alpha, printed, probability) in [(1.0, 0.15, 1.55, 0.73), (2.5, 0.20, 1.88, 0.81)] {
        let structure = Structure::new("", p, alpha, 0.92).unwrap();
        let im = hybrid(&example(&structure), EXAMPLE_LAMBDA).unwrap();
        assert!((im - printed).abs() < 0.005, "{im}");
        assert!((half_erf(im) - probability).abs() < 0.005, "{}", half_erf(im));
    }
}
