//! The fits at their limits: classes that barely overlap or only touch, and the symmetries of the estimates.

use std::collections::HashMap;

use proptest::prelude::*;
use rockfrag::fragility::{
    Case, CurveModel, Measure, OverturningFit, Plane, Sample, fit_overturning, has_few_events, p_failure,
    p_failure_given_rocking, p_no_rocking, plane_sample, rms_difference,
};
use rockfrag::motion::IntensityMeasures;
use rockfrag::rocking::Outcome;
use rockfrag::statistics::{Estimator, FitStatus, Link, auc, binary_regression, is_separated};

/// A hybrid curve of measures whose logarithms are x and y.
fn hybrid(x: &[f64], y: &[f64], events: &[bool]) -> Result<OverturningFit, FitStatus> {
    let case = |k: usize| Case {
        outcome: if events[k] { Outcome::Overturning } else { Outcome::SafeRocking },
        edp: 1.0,
        measures: IntensityMeasures {
            im1: None,
            im2: None,
            im3: Some(y[k].exp()),
            im4: x[k].exp(),
            im5: x[k].exp(),
            im6: None,
        },
    };
    let cases: Vec<Case> = (0..x.len()).map(case).collect();
    let event = |case: &Case| Some(case.outcome == Outcome::Overturning);
    fit_overturning(&Sample::of_events(&cases, &[Measure::Im4, Measure::Im3], event), &CurveModel::default())
}

type Points = (Vec<f64>, Vec<f64>, Vec<bool>);

fn read<T: serde::de::DeserializeOwned>(name: &str) -> Vec<T> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/reference/fits/");
    csv::Reader::from_path(format!("{folder}{name}"))
        .unwrap()
        .into_deserialize()
        .map(Result::unwrap)
        .collect()
}

fn nearly_separated() -> Points {
    let rows: Vec<(f64, f64, u8)> = read("nearly_separated.csv");
    (
        rows.iter().map(|row| row.0).collect(),
        rows.iter().map(|row| row.1).collect(),
        rows.iter().map(|row| row.2 == 1).collect(),
    )
}

/// Uniform numbers in [0, 1).
fn uniform(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed;
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Both classes on one line and each on its own side of it, turned by `angle`: quasi-complete separation.
fn touching_on_a_line(angle: f64, seed: u64) -> Points {
    let mut uniform = uniform(seed);
    let (mut x, mut y, mut events) = (vec![], vec![], vec![]);
    for k in 0..60 {
        let event = k % 2 == 0;
        let side = if event { 1.0 } else { -1.0 };
        let across = if k < 20 { 0.0 } else { side * uniform() };
        let along = 4.0 * uniform();
        x.push(across * angle.cos() - along * angle.sin());
        y.push(across * angle.sin() + along * angle.cos());
        events.push(event);
    }
    (x, y, events)
}

/// Two clouds that share most of their area.
fn overlapping(seed: u64) -> Points {
    let mut uniform = uniform(seed);
    let (mut x, mut y, mut events) = (vec![], vec![], vec![]);
    for k in 0..200 {
        let event = k % 2 == 0;
        x.push(uniform() + if event { 0.3 } else { 0.0 });
        y.push(uniform() + if event { 0.2 } else { 0.0 });
        events.push(event);
    }
    (x, y, events)
}

#[test]
fn events_are_few_below_ten_a_coefficient() {
    // A curve of one measure has two coefficients, the hybrid of two has three.
    for (events, n, measures, few) in [
        (19, 100, 1, true),
        (20, 100, 1, false),
        (81, 100, 1, true),
        (80, 100, 1, false),
        (29, 100, 2, true),
        (30, 100, 2, false),
    ] {
        assert_eq!(has_few_events(events, n, measures), few, "{events} of {n}");
    }
}

#[test]
fn probit_equals_statsmodels_where_classes_barely_overlap() {
    let expected: HashMap<String, f64> =
        read::<(String, f64)>("nearly_separated_answers.csv").into_iter().collect();
    let (x, y, events) = nearly_separated();
    let fit = binary_regression(&[&x, &y], &events, Link::Probit, Estimator::Ml).unwrap();
    let close = |value: f64, name: &str| {
        let expected = expected[name];
        assert!((value / expected - 1.0).abs() < 1e-8, "{name}: {value:e}, expected {expected:e}");
    };
    for k in 0..3 {
        close(fit.coefficients[k], &format!("b{k}"));
        close(fit.covariance[(k, k)].sqrt(), &format!("se{k}"));
    }
    close(fit.log_likelihood, "llf");
}

#[test]
fn planes_differ_by_the_root_of_their_mean_square() {
    let case = |im4: f64, im3: f64, outcome: Outcome| Case {
        outcome,
        edp: 0.1,
        measures: IntensityMeasures { im1: None, im2: None, im3: Some(im3), im4, im5: 1.0, im6: None },
    };
    let e = std::f64::consts::E;
    // Differences 1 + 1 = 2 and 1 + 2 = 3; beyond the range, and in an overturned case, more.
    let cases = [
        case(e, 1.0, Outcome::SafeRocking),
        case(e, e, Outcome::SafeRocking),
        case(e * e, e * e, Outcome::SafeRocking),
        case(e, e * e, Outcome::Overturning),
    ];
    let a = Plane { ln_a: 1.0, b1: 2.0, b2: 3.0 };
    let b = Plane { ln_a: 0.0, b1: 1.0, b2: 2.0 };
    let rms = rms_difference(&a, &b, &plane_sample(&cases, 1.0..3.0)).unwrap();
    assert!((rms - 6.5_f64.sqrt()).abs() < 1e-14, "{rms}");
    assert_eq!(rms_difference(&a, &a, &plane_sample(&cases, 1.0..3.0)), Some(0.0));
    assert_eq!(rms_difference(&a, &b, &plane_sample(&cases, 0.0..1.0)), None);
}

#[test]
fn failure_over_the_tree_is_zero_without_rocking() {
    let given_rocking = p_failure_given_rocking(0.25, 0.5);
    assert_eq!(p_failure(p_no_rocking(0.99), given_rocking), 0.0);
    assert_eq!(p_failure(p_no_rocking(1.01), given_rocking), given_rocking);
    assert!(p_no_rocking(f64::NAN).is_nan(), "an unknown intensity is no statement about rocking");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn classes_that_touch_on_a_line_are_separated(angle in 0.0..6.3f64, seed in 1u64..100_000) {
        let (x, y, events) = touching_on_a_line(angle, seed);
        prop_assert!(is_separated(&[&x, &y], &events));
        prop_assert_eq!(hybrid(&x, &y, &events).unwrap_err(), FitStatus::Separated);
    }

    #[test]
    fn clouds_that_overlap_are_not_separated(seed in 1u64..100_000) {
        let (x, y, events) = overlapping(seed);
        prop_assert!(!is_separated(&[&x, &y], &events));
    }

    #[test]
    fn units_leave_lambda_and_beta_of_a_hybrid(a in -3.0..3.0f64, b in -3.0..3.0f64, seed in 1u64..100_000) {
        let (x, y, events) = overlapping(seed);
        let shifted = |values: &[f64], by: f64| values.iter().map(|v| v + by).collect::<Vec<f64>>();
        let here = hybrid(&x, &y, &events).unwrap();
        let there = hybrid(&shifted(&x, a), &shifted(&y, b), &events).unwrap();
        let lambda = here.lambda.unwrap().value;
        // mu is a mean of ln IM with weights lambda/(1 + lambda) and 1/(1 + lambda) (Eq. 23).
        let moved = (lambda * a + b) / (1.0 + lambda);
        prop_assert!((there.lambda.unwrap().value / lambda - 1.0).abs() < 1e-8);
        prop_assert!((there.beta.value / here.beta.value - 1.0).abs() < 1e-8);
        prop_assert!((there.mu.value - here.mu.value - moved).abs() < 1e-8 * (1.0 + moved.abs()));
    }

    #[test]
    fn swapping_the_classes_turns_the_signs(seed in 1u64..100_000) {
        let (x, y, events) = overlapping(seed);
        let swapped: Vec<bool> = events.iter().map(|event| !event).collect();
        let (here, there) = (binary_regression(&[&x, &y], &events, Link::Probit, Estimator::Ml).unwrap(), binary_regression(&[&x, &y], &swapped, Link::Probit, Estimator::Ml).unwrap());
        for k in 0..3 {
            let sum = here.coefficients[k] + there.coefficients[k];
            prop_assert!(sum.abs() < 1e-9 * (1.0 + here.coefficients[k].abs()));
        }
    }

    #[test]
    fn the_area_is_a_share_and_turns_with_the_scores(
        cases in prop::collection::vec((0u8..6, any::<bool>()), 4..60)
    ) {
        let events: Vec<bool> = cases.iter().map(|case| case.1).collect();
        prop_assume!(events.contains(&true) && events.contains(&false));
        let scores: Vec<f64> = cases.iter().map(|case| f64::from(case.0)).collect();
        let turned: Vec<f64> = scores.iter().map(|score| -score).collect();
        let area = auc(&scores, &events);
        prop_assert!((0.0..=1.0).contains(&area));
        prop_assert!((area + auc(&turned, &events) - 1.0).abs() < 1e-12);
    }
}
