//! Firth's estimator against firthmodels (logistic) and the penalised likelihood in 30 digits (the other links).

use rockfrag::fragility::{CurveInference, CurveModel, CurveParameter, Sample, fit_overturning};
use rockfrag::keyword::Keyword;
use rockfrag::statistics::{BinaryFit, Estimator, FitStatus, Link, binary_regression, is_separated};

use crate::data::{Data, answers, data, read};

/// Two measures and few cases; or one measure that parts the outcomes.
fn sets() -> [(&'static str, &'static str, Data); 2] {
    let (mut few, mut parted) = (data(), data());
    few.first(60);
    parted.first(30);
    parted.event = parted.x.iter().map(|x| *x > 0.4).collect();
    [("few", "xy", few), ("parted", "x", parted)]
}

fn firth(data: &Data, name: &str, link: Link) -> BinaryFit {
    binary_regression(&data.predictors(name), &data.event, link, Estimator::Firth).unwrap()
}

#[test]
fn every_link_has_the_maximum_of_the_penalised_likelihood() {
    let answers = answers();
    for (set, name, data) in sets() {
        for &link in Link::ALL {
            let fit = firth(&data, name, link);
            for (k, b) in fit.coefficients.iter().enumerate() {
                answers.check(&format!("firth_{}_{set}_b{k}", link.as_str()), *b, 1e-7);
            }
        }
        let fit = firth(&data, name, Link::Logit);
        answers.check(&format!("firth_logit_{set}_penalised"), fit.objective, 1e-9);
        for k in 0..fit.coefficients.len() {
            answers.check(&format!("firth_logit_{set}_se{k}"), fit.covariance[(k, k)].sqrt(), 1e-7);
        }
    }
}

#[test]
fn penalised_profile_limits_equal_firthmodels() {
    let answers = answers();
    let [.., (set, name, data)] = sets();
    let sample = data.event_sample(name);
    let model = CurveModel { link: Link::Logit, estimator: Estimator::Firth, ..CurveModel::default() };
    let fit = fit_overturning(&sample, &model).unwrap();
    let beta = CurveInference::new(&sample, &fit.regression).profile_limits(CurveParameter::Beta, 0.95);
    answers.check(&format!("firth_logit_{set}_high1"), 1.0 / beta.low, 1e-6);
    answers.check(&format!("firth_logit_{set}_low1"), 1.0 / beta.high, 1e-6);
}

#[test]
fn what_separates_has_profile_limits() {
    // Measures in any unit, few cases and many, a wide gap between the outcomes and none; steep curves have intercepts far from 0.
    for (cases, gap) in [(6, 0.0), (12, 0.5), (40, 0.0), (200, 1.0)] {
        for unit in [1e-3, 1.0, 300.0] {
            let ln_im = |case: usize| {
                let x = 2.0 * case as f64 / cases as f64 - 1.0;
                f64::ln(unit) + x + gap * x.signum()
            };
            let x: Vec<f64> = (0..cases).map(ln_im).collect();
            let happened = (0..cases).map(|case| f64::from(u8::from(2 * case >= cases))).collect();
            let sample = Sample::of_columns(vec![x], happened);
            for &link in Link::ALL {
                let what = format!("{cases} cases, gap {gap}, unit {unit}, {link:?}");
                let model = CurveModel { link, estimator: Estimator::Firth, ..CurveModel::default() };
                let fit = fit_overturning(&sample, &model).unwrap();
                let inference = CurveInference::new(&sample, &fit.regression);
                for &parameter in inference.curve_parameters() {
                    let limits = inference.profile_limits(parameter, 0.95);
                    let value = inference.fitted(parameter);
                    assert!(limits.low < value && value < limits.high, "{what}: {parameter:?} {limits:?}");
                }
                assert!(inference.profile_limits(CurveParameter::Beta, 0.95).low >= 0.0, "{what}");
            }
        }
    }
}

#[test]
fn what_separates_has_a_curve_by_firth_alone() {
    let [.., (_, name, data)] = sets();
    assert!(is_separated(&data.predictors(name), &data.event));
    let sample = data.event_sample(name);
    assert_eq!(fit_overturning(&sample, &CurveModel::default()).unwrap_err(), FitStatus::Separated);
    let model = CurveModel { estimator: Estimator::Firth, ..CurveModel::default() };
    let fit = fit_overturning(&sample, &model).unwrap();
    assert!(fit.beta.value > 0.0 && fit.beta.value < 1.0);
    assert!(fit.regression.log_likelihood > fit.regression.objective - 10.0);
}

/// 150 sets of few cases that one measure or two separate, completely or but for a point with both outcomes, and the largest
/// penalised likelihood that scipy finds from 45 starts (scripts/reference/separated.py).
#[test]
fn what_separates_has_the_highest_maximum_under_every_link() {
    let mut sets: Vec<(Vec<Vec<f64>>, Vec<bool>)> = vec![(vec![Vec::new(); 2], Vec::new()); 150];
    let rows: Vec<(usize, f64, Option<f64>, u8)> = read("separated.csv");
    for (set, x, y, event) in rows {
        let (columns, events) = &mut sets[set];
        columns[0].push(x);
        columns[1].extend(y);
        events.push(event == 1);
    }
    let answers: Vec<(usize, String, f64, usize)> = read("separated_answers.csv");
    assert_eq!(answers.len(), 450);
    for &link in Link::ALL {
        let (mut none, mut lower, mut largest) = (0, 0, 0.0_f64);
        for (set, _, penalised, _) in answers.iter().filter(|answer| answer.1 == link.as_str()) {
            let (columns, events) = &sets[*set];
            let columns: Vec<&[f64]> = columns.iter().filter(|x| !x.is_empty()).map(Vec::as_slice).collect();
            assert!(is_separated(&columns, events), "{set}");
            match binary_regression(&columns, events, link, Estimator::Firth) {
                Ok(fit) => {
                    lower += usize::from(fit.objective < penalised - 1e-6);
                    largest = largest.max(fit.objective - penalised);
                }
                Err(_) => none += 1,
            }
        }
        println!(
            "{link:?}: no maximum {none}, a lower one {lower}, higher than scipy's by up to {largest:e}"
        );
        assert_eq!((none, lower), (0, 0), "{link:?}");
        assert!(largest < 1e-6);
    }
}

#[test]
fn the_penalty_fades_with_many_cases() {
    let data = data();
    let ml = binary_regression(&data.predictors("xy"), &data.event, Link::Probit, Estimator::Ml).unwrap();
    let firth = firth(&data, "xy", Link::Probit);
    for k in 0..3 {
        let moved = (firth.coefficients[k] - ml.coefficients[k]).abs() / ml.covariance[(k, k)].sqrt();
        assert!(moved < 0.2, "{moved} standard errors");
        assert!(firth.coefficients[k].abs() < ml.coefficients[k].abs(), "it shrinks");
    }
}
