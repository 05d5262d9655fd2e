//! Each link against statsmodels and pyFragility.

use rockfrag::fragility::{CurveModel, CurveParameter, fit_overturning};
use rockfrag::keyword::Keyword;
use rockfrag::statistics::{Estimator, Link, binary_regression};

use crate::data::{answers, data};

#[test]
fn every_link_equals_statsmodels() {
    let (data, answers) = (data(), answers());
    for link in Link::ALL {
        for name in ["x", "xy"] {
            let fit = binary_regression(&data.predictors(name), &data.event, *link, Estimator::Ml).unwrap();
            let key = format!("{}_{name}", link.as_str());
            for k in 0..fit.coefficients.len() {
                answers.check(&format!("{key}_b{k}"), fit.coefficients[k], 1e-8);
                answers.check(&format!("{key}_se{k}"), fit.covariance[(k, k)].sqrt(), 1e-8);
            }
            answers.check(&format!("{key}_llf"), fit.log_likelihood, 1e-10);
        }
    }
}

#[test]
fn derivatives_of_the_links_are_those_of_their_values() {
    let h = 1e-5;
    for &link in Link::ALL {
        for index in [-3.0, -1.2, -0.1, 0.0, 0.4, 1.3, 2.1] {
            for event in [false, true] {
                let (value, at) = (|x| link.ln_probability(x, event), |x| link.score(x, event));
                let p = link.probability(index);
                assert!((value(index) - if event { p } else { 1.0 - p }.ln()).abs() < 1e-12);
                let slope = (value(index + h) - value(index - h)) / (2.0 * h);
                assert!((at(index).slope - slope).abs() < 1e-8 * (1.0 + slope.abs()), "{link:?} {index}");
                let curvature = -(at(index + h).slope - at(index - h).slope) / (2.0 * h);
                assert!(
                    (at(index).curvature - curvature).abs() < 1e-8 * (1.0 + curvature),
                    "{link:?} {index}"
                );
            }
            let of = |index: f64| link.information(index);
            let expected = {
                let p = link.probability(index);
                p * link.score(index, true).curvature + (1.0 - p) * link.score(index, false).curvature
            };
            assert!((of(index).weight / expected - 1.0).abs() < 1e-12, "{link:?} {index}");
            let slope = (of(index + h).weight.ln() - of(index - h).weight.ln()) / (2.0 * h);
            assert!((of(index).ln_weight_slope - slope).abs() < 1e-8, "{link:?} {index}");
            let curvature = (of(index + h).ln_weight_slope - of(index - h).ln_weight_slope) / (2.0 * h);
            assert!((of(index).ln_weight_curvature - curvature).abs() < 1e-8, "{link:?} {index}");
        }
        assert!((link.probability(link.median_index()) - 0.5).abs() < 1e-15);
    }
}

#[test]
fn mu_is_the_logarithm_of_the_median_under_every_link() {
    let data = data();
    let sample = data.event_sample("x");
    for &link in Link::ALL {
        let model = CurveModel { link, ..CurveModel::default() };
        let fit = fit_overturning(&sample, &model).unwrap();
        let b = &fit.regression.coefficients;
        assert!((link.probability(b[0] + b[1] * fit.mu.value) - 0.5).abs() < 1e-14);
        assert_eq!(CurveParameter::Beta.value(link, b), 1.0 / b[1]);
    }
}
