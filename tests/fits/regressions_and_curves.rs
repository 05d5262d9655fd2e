//! The fits against statsmodels (scripts/reference/fits.py), scipy, closed forms and invariances.

use std::collections::HashMap;

use proptest::prelude::*;
use rockfrag::fragility::demand::{Form, Regression, RegressionOptions, Regressions};
use rockfrag::fragility::overturning::{Curve, CurveOptions, Pair};
use rockfrag::fragility::{
    Case, CaseTable, CurveModel, Event, Measure, OverturningFit, PLANE, Plane, Sample, TransitionSearch,
    Uncertainty, fit_biplanar, fit_overturning, fit_univariate, p_exceeding, p_failure_given_rocking,
    p_no_rocking, p_overturning, unwatched,
};
use rockfrag::motion::IntensityMeasures;
use rockfrag::rocking::Outcome;
use rockfrag::statistics::{
    Estimator, FitStatus, Link, auc, binary_regression, brier_score, is_separated, least_squares, t_quantile,
};

struct Data {
    x: Vec<f64>,
    y: Vec<f64>,
    demand: Vec<f64>,
    event: Vec<bool>,
}

fn data() -> Data {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/reference/fits/cases.csv");
    let rows: Vec<(f64, f64, f64, u8)> =
        csv::Reader::from_path(path).unwrap().into_deserialize().map(Result::unwrap).collect();
    Data {
        x: rows.iter().map(|row| row.0).collect(),
        y: rows.iter().map(|row| row.1).collect(),
        demand: rows.iter().map(|row| row.2).collect(),
        event: rows.iter().map(|row| row.3 == 1).collect(),
    }
}

fn statsmodels() -> HashMap<String, f64> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/reference/fits/answers.csv");
    csv::Reader::from_path(path).unwrap().into_deserialize().map(Result::unwrap).collect()
}

fn close(value: f64, expected: f64, tolerance: f64, what: &str) {
    assert!(
        (value - expected).abs() <= tolerance * expected.abs(),
        "{what}: {value:e}, expected {expected:e}"
    );
}

fn case(outcome: Outcome, edp: f64, im3: f64, im4: f64) -> Case {
    let measures = IntensityMeasures { im1: None, im2: None, im3: Some(im3), im4, im5: im4, im6: None };
    Case { outcome, edp, measures }
}

/// A curve on IM4 (the logarithm of which is x), or on it and IM3 (y).
fn curve(x: &[f64], y: &[f64], events: &[bool], measures: &[Measure]) -> Result<OverturningFit, FitStatus> {
    let outcome = |event| if event { Outcome::Overturning } else { Outcome::SafeRocking };
    let cases: Vec<Case> =
        (0..x.len()).map(|k| case(outcome(events[k]), 1.0, y[k].exp(), x[k].exp())).collect();
    fit_overturning(
        &Sample::of_events(&cases, measures, |case| Some(case.outcome == Outcome::Overturning)),
        &CurveModel::default(),
    )
}

#[test]
fn least_squares_equals_statsmodels() {
    let (data, expected) = (data(), statsmodels());
    for (name, predictors) in [("x", vec![&data.x[..]]), ("xy", vec![&data.x[..], &data.y[..]])] {
        let fit = least_squares(&predictors, &data.demand).unwrap();
        for (k, estimate) in fit.coefficients.iter().enumerate() {
            let of = |part: &str| expected[&format!("ols_{name}_{part}{k}")];
            close(estimate.value, of("b"), 1e-10, "coefficient");
            close(estimate.standard_error, of("se"), 1e-10, "standard error");
            close(estimate.low, of("low"), 1e-9, "lower limit");
            close(estimate.high, of("high"), 1e-9, "upper limit");
        }
        close(fit.r2, expected[&format!("ols_{name}_r2")], 1e-10, "R2");
        close(fit.residual_sd, expected[&format!("ols_{name}_sd")], 1e-10, "residual sd");
    }
}

#[test]
fn probit_equals_statsmodels() {
    let (data, expected) = (data(), statsmodels());
    for (name, predictors) in [("x", vec![&data.x[..]]), ("xy", vec![&data.x[..], &data.y[..]])] {
        let fit = binary_regression(&predictors, &data.event, Link::Probit, Estimator::Ml).unwrap();
        for k in 0..fit.coefficients.len() {
            close(fit.coefficients[k], expected[&format!("probit_{name}_b{k}")], 1e-8, "coefficient");
            close(fit.covariance[(k, k)].sqrt(), expected[&format!("probit_{name}_se{k}")], 1e-8, "error");
        }
        close(fit.log_likelihood, expected[&format!("probit_{name}_llf")], 1e-10, "log-likelihood");
    }
    let fit = curve(&data.x, &data.y, &data.event, &[Measure::Im4, Measure::Im3]).unwrap();
    close(fit.aic, expected["probit_xy_aic"], 1e-9, "AIC");
    close(fit.bic, expected["probit_xy_bic"], 1e-9, "BIC");
}

#[test]
fn hybrid_parameters_follow_from_the_coefficients() {
    let data = data();
    let negative: Vec<f64> = data.y.iter().map(|y| -y).collect();
    let b = binary_regression(&[&data.x, &negative], &data.event, Link::Probit, Estimator::Ml)
        .unwrap()
        .coefficients;
    let fit = curve(&data.x, &negative, &data.event, &[Measure::Im4, Measure::Im3]).unwrap();
    close(fit.lambda.unwrap().value, b[1] / b[2], 1e-12, "lambda");
    close(fit.beta.value, 1.0 / (b[1] + b[2]), 1e-12, "beta");
    close(fit.mu.value, -b[0] / (b[1] + b[2]), 1e-12, "mu");
    // The curve of the hybrid measure IMx^(lambda/(1+lambda)) IMy^(1/(1+lambda)) is the probit itself (Eq. 23).
    let lambda = fit.lambda.unwrap().value;
    for k in [0, 17, 230] {
        let hybrid = ((lambda * data.x[k] + negative[k]) / (1.0 + lambda)).exp();
        let index = b[0] + b[1] * data.x[k] + b[2] * negative[k];
        close(
            p_overturning(hybrid, fit.mu.value, fit.beta.value, Link::Probit),
            rockfrag::normal::cdf(index),
            1e-10,
            "P_ro",
        );
    }
}

#[test]
fn delta_method_errors_equal_those_of_a_direct_parametrisation() {
    // For one measure, the inverse information in (mu, beta) itself: by the chain rule at the maximum it is the delta
    // method's; here by finite differences of the log-likelihood.
    let data = data();
    let fit = curve(&data.x, &data.y, &data.event, &[Measure::Im4]).unwrap();
    let likelihood = |mu: f64, beta: f64| -> f64 {
        let one = |(x, &event): (&f64, &bool)| {
            let z = (x - mu) / beta;
            rockfrag::normal::ln_cdf(if event { z } else { -z })
        };
        data.x.iter().zip(&data.event).map(one).sum()
    };
    let (m, b, h) = (fit.mu.value, fit.beta.value, 1e-4);
    let f = |i: f64, j: f64| likelihood(m + i * h, b + j * h);
    let mm = -(f(1.0, 0.0) - 2.0 * f(0.0, 0.0) + f(-1.0, 0.0)) / (h * h);
    let bb = -(f(0.0, 1.0) - 2.0 * f(0.0, 0.0) + f(0.0, -1.0)) / (h * h);
    let mb = -(f(1.0, 1.0) - f(1.0, -1.0) - f(-1.0, 1.0) + f(-1.0, -1.0)) / (4.0 * h * h);
    let determinant = mm * bb - mb * mb;
    close(fit.mu.standard_error, (bb / determinant).sqrt(), 1e-4, "error of mu");
    close(fit.beta.standard_error, (mm / determinant).sqrt(), 1e-4, "error of beta");
}

#[test]
fn grouped_collapses_give_the_known_curve() {
    let ims = [0.2, 0.3, 0.4, 0.6, 0.7, 0.8, 0.9, 1.0_f64];
    let collapses = [0, 0, 0, 4, 6, 13, 12, 16];
    let (mut x, mut events) = (Vec::new(), Vec::new());
    for (im, collapsed) in ims.iter().zip(collapses) {
        x.extend([im.ln(); 40]);
        events.extend((0..40).map(|k| k < collapsed));
    }
    let fit = curve(&x, &x, &events, &[Measure::Im4]).unwrap();
    assert!((fit.theta.value - 1.07612).abs() < 5e-6, "{}", fit.theta.value);
    assert!((fit.beta.value - 0.42924).abs() < 5e-6, "{}", fit.beta.value);
    assert_eq!((fit.n, fit.events), (320, 51));
}

#[test]
fn student_quantiles_equal_scipys() {
    for (degrees, expected) in [
        (1.0, 12.706_204_736_174_698),
        (5.0, 2.570_581_835_636_314),
        (30.0, 2.042_272_456_301_237_8),
        (1000.0, 1.962_339_080_826_408_3),
    ] {
        close(t_quantile(0.975, degrees), expected, 1e-10, "t");
        close(t_quantile(0.025, degrees), -expected, 1e-10, "t");
    }
}

/// Cases on two planes that meet at `at`.
fn two_planes(at: f64) -> Vec<Case> {
    on_planes(at, [-8.0, 25.0, -2.0], [-1.5, 1.5, -1.0])
}

/// Cases on these planes, given by ln a, b1 and b2.
fn on_planes(at: f64, low: [f64; 3], high: [f64; 3]) -> Vec<Case> {
    let mut state = 7_u64;
    let mut uniform = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut one = || {
        let (im4, im3) = (1.0 + 2.0 * uniform(), 0.5 + uniform());
        let noise = 0.2 * (uniform() - 0.5);
        let [ln_a, b1, b2] = if im4 < at { low } else { high };
        let ln_edp = ln_a + b1 * im4.ln() + b2 * im3.ln();
        case(Outcome::SafeRocking, (ln_edp + noise).exp(), im3, im4)
    };
    (0..1500).map(|_| one()).collect()
}

#[test]
fn two_planes_and_their_transition_are_found() {
    let cases = two_planes(1.3);
    let fit = fit_biplanar(&cases, None).unwrap();
    assert!((fit.transition - 1.3).abs() < 0.011, "{}", fit.transition);
    let (low, high) = (fit.low.unwrap(), fit.high.unwrap());
    for (fit, expected) in [(&low, [-8.0, 25.0, -2.0]), (&high, [-1.5, 1.5, -1.0])] {
        for (estimate, expected) in fit.coefficients.iter().zip(expected) {
            let errors = (estimate.value - expected).abs() / estimate.standard_error;
            assert!(errors < 4.0, "{estimate:?}, expected {expected}");
        }
    }
    let rss = low.rss + high.rss;
    assert_eq!(fit.r2_pooled.unwrap(), 1.0 - rss / (low.tss + high.tss));
    assert!(
        fit.r2_overall.unwrap() > fit.r2_pooled.unwrap(),
        "the jump between the sides counts only overall"
    );
    assert_eq!(fit_biplanar(&cases, Some(1.5)).unwrap().transition, 1.5);
    // The same as that of one regression whose coefficients all depend on the side.
    let sample = Sample::of_demands(&cases, &PLANE, 0.0..f64::INFINITY);
    let [x, y] = &sample.predictors()[..] else { panic!("two measures") };
    let above: Vec<f64> = x.iter().map(|x| f64::from(u8::from(x.exp() >= fit.transition))).collect();
    let times = |column: &[f64]| above.iter().zip(column).map(|(a, b)| a * b).collect::<Vec<f64>>();
    let joint = least_squares(&[&above, x, y, &times(x), &times(y)], &sample.observed()).unwrap();
    close(fit.r2_overall.unwrap(), joint.r2, 1e-9, "R2 of both sides");
    let nothing = Case { edp: 0.0, ..cases[0] };
    assert_eq!(Sample::of_demands(&[nothing, cases[1]], &PLANE, 0.0..f64::INFINITY).rows(), [1]);
}

#[test]
fn all_fits_of_a_group_follow_from_slices_of_its_cases() {
    // The combined motions of Table II: frame, and electrical equipment.
    let table = [
        ([-12.02, 28.31, -0.236], [-2.263, 2.640, -1.436]),
        ([-11.39, 30.39, -0.072], [-2.765, 2.954, -0.942]),
    ];
    let cases = table.map(|(low, high)| on_planes(1.3, low, high));
    let cells: Vec<usize> = (0..cases[0].len()).map(|case| case % 20).collect();
    let groups = cases.each_ref().map(|cases| CaseTable::of(cases, &cells, &cells));
    let groups = groups.each_ref();
    let uncertainty = Uncertainty { replicates: 100, confidence: 0.95, seed: 42 };
    let options = RegressionOptions { transition: None, limit: 0.1, uncertainty };
    let Ok(fitted) = options.fit(&groups, &unwatched);
    for (Regressions { fits, .. }, (low, high)) in fitted.iter().zip(table) {
        let planes: Vec<&Regression> = fits.iter().filter(|fit| fit.form == Form::Biplanar).collect();
        assert_eq!((planes.len(), fits.len()), (2, 6 + 1 + 2 + 2));
        for (plane, expected) in planes.iter().zip([low, high]) {
            for (k, expected) in expected.into_iter().enumerate() {
                let estimate = plane.coefficient(k).unwrap();
                let limits = plane.coefficient_limits(k).unwrap().percentile;
                let errors = (estimate.value - expected).abs() / estimate.standard_error;
                assert!(errors < 4.0, "{estimate:?}, expected {expected}");
                assert!(limits.low < estimate.value && estimate.value < limits.high, "{limits:?}");
            }
        }
        let [below, above] = [0, 1].map(|side| planes[side].range.clone());
        assert!((below.start, above.end) == (1.0, f64::INFINITY) && below.end == above.start);
    }
    let event = Event::Overturning;
    let pairs = vec![Pair(Measure::Im4, Measure::Im3Inverse)];
    let options = CurveOptions { event, pairs, model: CurveModel::default(), uncertainty };
    let Ok(curves) = options.fit(&groups, &unwatched);
    let none = |curve: &Curve| curve.status() == FitStatus::TooFewEvents && curve.events == 0;
    assert!(curves.iter().flatten().all(none) && curves[0].len() == 7, "nothing overturns");
    let stopped = options.fit(&groups, &|_| Err("enough"));
    assert_eq!(stopped.unwrap_err(), "enough");
}

#[test]
fn the_scan_by_sums_equals_fitting_anew_at_each_place() {
    let cases = two_planes(1.4);
    let sample = Sample::of_demands(&cases, &PLANE, 0.0..f64::INFINITY);
    let scan = TransitionSearch::new(&sample).find(&vec![1.0; cases.len()]).unwrap().scan;
    assert!(scan.len() > 50);
    for point in scan.iter().step_by(13) {
        let fit = fit_biplanar(&cases, Some(point.im4)).unwrap();
        let rss = fit.low.unwrap().rss + fit.high.unwrap().rss;
        close(point.pooled_rss, rss, 1e-8, "pooled residual");
    }
}

#[test]
fn want_of_cases_and_of_events_are_statuses() {
    let few: Vec<Case> = (0..2).map(|k| case(Outcome::SafeRocking, 0.1, 1.0, 1.5 + f64::from(k))).collect();
    assert_eq!(fit_univariate(&few, Measure::Im4).unwrap_err(), FitStatus::TooFewCases);
    assert_eq!(fit_univariate(&few, Measure::Im1).unwrap_err(), FitStatus::TooFewCases);
    assert_eq!(fit_biplanar(&few, None).unwrap_err(), FitStatus::TooFewCases);
    let same: Vec<Case> = (0..9).map(|_| case(Outcome::SafeRocking, 0.1, 1.0, 1.5)).collect();
    assert_eq!(fit_univariate(&same, Measure::Im4).unwrap_err(), FitStatus::Constant);
    assert_eq!(fit_biplanar(&same, None).unwrap_err(), FitStatus::Constant);
    let line = |k: i32| case(Outcome::SafeRocking, 0.1, 1.0 + 0.01 * f64::from(k), 1.0 + 0.01 * f64::from(k));
    assert_eq!(fit_biplanar(&(1..90).map(line).collect::<Vec<_>>(), None).unwrap_err(), FitStatus::Collinear);
    let x: Vec<f64> = (0..50).map(f64::from).collect();
    let four: Vec<bool> = (0..50).map(|k| k % 13 == 0).collect();
    assert_eq!(curve(&x, &x, &four, &[Measure::Im4]).unwrap_err(), FitStatus::TooFewEvents);
    let parted: Vec<bool> = (0..50).map(|k| k > 25).collect();
    assert_eq!(curve(&x, &x, &parted, &[Measure::Im4]).unwrap_err(), FitStatus::Separated);
}

#[test]
fn skill_scores_have_their_textbook_values() {
    let events = [false, false, true, true];
    assert_eq!(auc(&[0.1, 0.4, 0.35, 0.8], &events), 0.75);
    assert_eq!(auc(&[1.0; 4], &events), 0.5);
    assert_eq!(brier_score(&[0.0, 0.5, 1.0, 0.5], &events), 0.125);
}

#[test]
fn the_tree_joins_the_probabilities() {
    let plane = Plane { ln_a: 1.0, b1: 2.0, b2: 3.0 };
    assert_eq!(plane.ln_demand(1.0, std::f64::consts::E), 4.0);
    assert_eq!(plane.ln_demand(std::f64::consts::E, 1.0), 3.0);
    assert_eq!((p_no_rocking(0.999), p_no_rocking(1.0)), (1.0, 0.0));
    assert_eq!(p_exceeding(0.1_f64.ln(), 0.1, 0.8), 0.5);
    assert!(p_exceeding(0.2_f64.ln(), 0.1, 0.8) > 0.5, "grows with demand");
    assert_eq!(p_overturning(1.3, 1.3_f64.ln(), 0.4, Link::Probit), 0.5);
    assert_eq!(p_failure_given_rocking(0.25, 0.5), 0.625);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    #[test]
    fn units_of_a_measure_move_only_the_median(scale in -3.0..3.0f64) {
        let data = data();
        let scaled: Vec<f64> = data.x.iter().map(|x| x + scale).collect();
        let here = curve(&data.x, &data.y, &data.event, &[Measure::Im4]).unwrap();
        let there = curve(&scaled, &data.y, &data.event, &[Measure::Im4]).unwrap();
        prop_assert!((there.mu.value - here.mu.value - scale).abs() < 1e-9);
        prop_assert!((there.beta.value / here.beta.value - 1.0).abs() < 1e-9);
        prop_assert!((there.goodness.auc - here.goodness.auc).abs() < 1e-12);
    }

    #[test]
    fn a_line_between_two_clouds_is_always_found(angle in 0.0..6.3f64, gap in 0.0..2.0f64, seed in 1u64..1000) {
        let (mut x, mut y, mut events, mut state) = (vec![], vec![], vec![], seed);
        for k in 0..60 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let (u, v) = ((state >> 40) as f64 / 2f64.powi(24), (state >> 16 & 0xFF_FFFF) as f64 / 2f64.powi(24));
            let event = k % 2 == 0;
            let across = if event { gap + u + 1e-9 } else { -u };
            x.push(across * angle.cos() - 4.0 * v * angle.sin());
            y.push(across * angle.sin() + 4.0 * v * angle.cos());
            events.push(event);
        }
        prop_assert!(is_separated(&[&x, &y], &events));
        // One event deep among the others, on each side, ends it.
        let middle = |of: bool, values: &[f64]| {
            let chosen: Vec<f64> = (0..60).filter(|&k| events[k] == of).map(|k| values[k]).collect();
            chosen.iter().sum::<f64>() / chosen.len() as f64
        };
        let (mx, my) = (middle(false, &x), middle(false, &y));
        let mut mixed = events.clone();
        mixed.push(true);
        let (mut xs, mut ys) = (x.clone(), y.clone());
        xs.push(mx);
        ys.push(my);
        prop_assert!(!is_separated(&[&xs, &ys], &mixed));
    }

    #[test]
    fn failure_is_at_least_as_likely_as_either_way_to_it(ro in 0.0..=1.0f64, ex in 0.0..=1.0f64) {
        let failure = p_failure_given_rocking(ro, ex);
        prop_assert!(failure >= ro.max(ex) - 1e-15 && failure <= 1.0);
    }
}
