//! Profile-likelihood limits and clustered errors against pyFragility and statsmodels.

use rockfrag::fragility::{
    CurveInference, CurveModel, CurveParameter, DemandInference, Sample, fit_overturning,
};
use rockfrag::keyword::Keyword;
use rockfrag::normal;
use rockfrag::statistics::{Estimator, Link, binary_regression};

use crate::data::{answers, data};

fn curve(sample: &Sample) -> rockfrag::fragility::OverturningFit {
    fit_overturning(sample, &CurveModel::default()).unwrap()
}

#[test]
fn limits_at_another_confidence_are_students() {
    let fit = data().demand_sample("x").fit().unwrap();
    let wider = fit.clone().at_confidence(0.99);
    for (at_95, at_99) in fit.coefficients.iter().zip(&wider.coefficients) {
        // scipy.stats.t.ppf of 0.975 and 0.995 with 398 degrees of freedom.
        for (estimate, quantile) in [(at_95, 1.965_942_323_976_266_1), (at_99, 2.588_238_404_934_375)] {
            let half_width = quantile * at_95.standard_error;
            assert!((estimate.high - at_95.value - half_width).abs() < 1e-9 * half_width, "{estimate:?}");
            assert!((at_95.value - estimate.low - half_width).abs() < 1e-9 * half_width, "{estimate:?}");
        }
    }
}

#[test]
fn clustered_errors_equal_pyfragilitys_under_every_link() {
    let (data, answers) = (data(), answers());
    for &link in Link::ALL {
        for name in ["x", "xy"] {
            let sample = data.event_sample(name);
            let fit = fit_overturning(&sample, &CurveModel { link, ..CurveModel::default() }).unwrap();
            let inference = CurveInference::new(&sample, &fit.regression);
            let covariance = inference.clustered_covariance(&data.cells);
            for k in 0..fit.regression.coefficients.len() {
                let key = format!("{}_{name}_clustered{k}", link.as_str());
                answers.check(&key, covariance[(k, k)].sqrt(), 1e-7);
            }
        }
    }
}

#[test]
fn clustered_errors_of_least_squares_equal_statsmodels() {
    let (data, answers) = (data(), answers());
    for name in ["x", "xy"] {
        let sample = data.demand_sample(name);
        let fit = sample.fit().unwrap();
        let inference = DemandInference::new(&sample, &fit);
        for (k, error) in inference.clustered_errors(&data.cells).iter().enumerate() {
            answers.check(&format!("ols_{name}_clustered{k}"), *error, 1e-9);
        }
        // Without cells every case stands for itself.
        let alone = inference.clustered_errors(&vec![0; data.x.len()]);
        answers.check(&format!("ols_{name}_hc1_1"), alone[1], 1e-9);
    }
}

#[test]
fn profile_limits_equal_pyfragilitys() {
    let (mut data, answers) = (data(), answers());
    for name in ["all", "few"] {
        if name == "few" {
            data.first(60);
        }
        let sample = data.event_sample("x");
        let fit = curve(&sample);
        let inference = CurveInference::new(&sample, &fit.regression);
        let mu = inference.profile_limits(CurveParameter::Mu, 0.95);
        let beta = inference.profile_limits(CurveParameter::Beta, 0.95);
        answers.check(&format!("profile_{name}_theta_low"), mu.low.exp(), 1e-6);
        answers.check(&format!("profile_{name}_theta_high"), mu.high.exp(), 1e-6);
        answers.check(&format!("profile_{name}_beta_low"), beta.low, 1e-6);
        answers.check(&format!("profile_{name}_beta_high"), beta.high, 1e-6);
    }
}

#[test]
fn the_likelihood_at_a_profile_limit_lies_half_a_quantile_lower() {
    let data = data();
    let sample = data.event_sample("xy");
    let fit = curve(&sample);
    let inference = CurveInference::new(&sample, &fit.regression);
    let drop = 0.5 * normal::quantile(0.975).powi(2);
    // Where lambda is held, the curve is that of the one measure lambda x + y; where the slope is held, of the difference
    // with an offset; where mu is held, of two without an intercept. The first two are fits of their own.
    let lambda = inference.profile_limits(CurveParameter::Lambda, 0.95);
    for limit in [lambda.low, lambda.high] {
        let hybrid: Vec<f64> = data.x.iter().zip(&data.y).map(|(x, y)| limit * x + y).collect();
        let held = binary_regression(&[&hybrid], &data.event, Link::Probit, Estimator::Ml).unwrap();
        assert!((fit.regression.log_likelihood - held.log_likelihood - drop).abs() < 1e-8);
    }
    for parameter in [CurveParameter::Mu, CurveParameter::Beta] {
        let limits = inference.profile_limits(parameter, 0.95);
        let estimate = inference.fitted(parameter);
        assert!(limits.low < estimate && estimate < limits.high);
        let wide = inference.profile_limits(parameter, 0.999);
        assert!(wide.low < limits.low && limits.high < wide.high);
    }
}

#[test]
fn a_measure_that_may_say_nothing_has_no_upper_limit_of_beta() {
    let mut data = data();
    // Every third event is another's: hardly any slope is left, and the limits of the slope hold zero.
    data.event = (0..data.x.len()).map(|k| data.event[(k * 7 + 3) % data.x.len()]).collect();
    let sample = data.event_sample("x");
    let fit = curve(&sample);
    let limits = CurveInference::new(&sample, &fit.regression).profile_limits(CurveParameter::Beta, 0.95);
    let beyond = if fit.beta.value > 0.0 { limits.high } else { limits.low };
    assert!(beyond.is_infinite(), "{limits:?} of {:?}", fit.beta);
}
