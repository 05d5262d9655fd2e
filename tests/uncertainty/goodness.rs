//! Tests of fit, bent curves and the smooth transition against statsmodels and scipy; and what is diagnosed.

use rockfrag::fragility::{
    Case, CurveModel, Measure, Sample, TransitionSearch, fit_overturning, fit_smooth, fit_with_interaction,
    fit_with_spline, transition_limits,
};
use rockfrag::keyword::Keyword;
use rockfrag::statistics::{
    Estimator, FitStatus, Link, chi_squared_upper_tail, f_upper_tail, hosmer_lemeshow, least_squares,
    likelihood_ratio, reset,
};

use crate::data::{answers, data, smooth_cases};

#[test]
fn tails_equal_scipys() {
    let answers = answers();
    answers.check("chi_squared", chi_squared_upper_tail(7.3, 5), 1e-13);
    answers.check("chi_squared_even", chi_squared_upper_tail(21.4, 8), 1e-13);
    answers.check("f", f_upper_tail(4.2, 2.0, 37.0), 1e-12);
    assert_eq!(chi_squared_upper_tail(0.0, 8), 1.0);
}

#[test]
fn hosmer_and_lemeshows_test_equals_statsmodels() {
    let (data, answers) = (data(), answers());
    for &link in Link::ALL {
        for name in ["x", "xy"] {
            let model = CurveModel { link, ..CurveModel::default() };
            let fit = fit_overturning(&data.event_sample(name), &model).unwrap();
            let test = fit.goodness.hosmer_lemeshow.unwrap();
            let key = format!("{}_{name}_hosmer_lemeshow", link.as_str());
            answers.check(&key, test.statistic, 1e-8);
            answers.check(&format!("{key}_p"), test.p, 1e-8);
        }
    }
    assert_eq!(hosmer_lemeshow(&[0.5; 19], &[true; 19]), None, "too few for ten groups");
}

#[test]
fn ramseys_test_equals_statsmodels() {
    let (data, answers) = (data(), answers());
    for name in ["x", "xy"] {
        let predictors = data.predictors(name);
        let fit = least_squares(&predictors, &data.demand).unwrap();
        let test = reset(&predictors, &data.demand, &fit).unwrap();
        answers.check(&format!("ols_{name}_reset"), test.statistic, 1e-7);
        answers.check(&format!("ols_{name}_reset_p"), test.p, 1e-7);
    }
    let parabola: Vec<f64> = data.x.iter().map(|x| x * x).collect();
    let fit = least_squares(&[&data.x], &parabola).unwrap();
    assert!(reset(&[&data.x], &parabola, &fit).is_none_or(|test| test.p < 1e-10), "a parabola is no line");
}

#[test]
fn splines_and_interactions_equal_statsmodels() {
    let (data, answers) = (data(), answers());
    let model = CurveModel::default();
    let (one, two) = (data.event_sample("x"), data.event_sample("xy"));
    let spline = fit_with_spline(&one, &model).unwrap();
    answers.check("spline_llf", spline.log_likelihood, 1e-10);
    answers.check("spline_xy_llf", fit_with_spline(&two, &model).unwrap().log_likelihood, 1e-10);
    let interaction = fit_with_interaction(&two, &model).unwrap();
    answers.check("interaction_llf", interaction.log_likelihood, 1e-10);
    let straight = fit_overturning(&one, &model).unwrap().regression;
    let test = likelihood_ratio(&straight, &spline);
    let expected = 2.0 * (answers.get("spline_llf") - answers.get("probit_x_llf"));
    assert!((test.statistic - expected).abs() < 1e-7, "{test:?}");
    assert!((test.p - (-0.5 * expected).exp()).abs() < 1e-9, "chi squared with two degrees of freedom");
}

#[test]
fn the_smooth_transition_equals_scipys() {
    let (cases, answers) = (smooth_cases(), answers());
    let sample = Sample::of_demands(&cases, &[Measure::Im4, Measure::Im3], 0.0..f64::INFINITY);
    let fit = fit_smooth(&sample, 0.95).unwrap();
    answers.check("smooth_rss", fit.low.rss, 1e-9);
    answers.check("smooth_width", fit.width.value, 1e-6);
    answers.check("smooth_se_width", fit.width.standard_error, 1e-5);
    assert!((fit.transition.value - fit.width.value.exp2()).abs() < 1e-12);
    for k in 0..3 {
        for (side, plane) in [("low", &fit.low), ("high", &fit.high)] {
            answers.check(&format!("smooth_{side}{k}"), plane.coefficients[k].value, 1e-6);
            answers.check(&format!("smooth_se_{side}{k}"), plane.coefficients[k].standard_error, 1e-5);
        }
    }
    assert!(fit.reset.unwrap().p > 0.01, "{:?}", fit.reset);
    let far = |im4: f64, plane: &rockfrag::statistics::LinearFit| {
        let b = plane.values();
        (fit.ln_demand(im4, 1.0) - (b[0] + b[1] * im4.ln())).abs()
    };
    assert!(far(1.0, &fit.low) < 1e-12 && far(1e6, &fit.high) < 1e-6, "at uplift, and far above it");
}

#[test]
fn a_demand_that_bends_all_the_way_has_no_transition() {
    // In x = ln IM4 a parabola is what the planes are nearer to the wider they pass into one another.
    let bent = |case: Case| Case { edp: (-3.0 + 2.0 * case.measures.im4.ln().powi(2)).exp(), ..case };
    let cases: Vec<Case> = smooth_cases().into_iter().map(bent).collect();
    let sample = Sample::of_demands(&cases, &[Measure::Im4, Measure::Im3], 0.0..f64::INFINITY);
    assert_eq!(fit_smooth(&sample, 0.95).unwrap_err(), FitStatus::NotConverged);
}

#[test]
fn hansens_limits_hold_the_break() {
    let cases = smooth_cases();
    let sample = Sample::of_demands(&cases, &[Measure::Im4, Measure::Im3], 0.0..f64::INFINITY);
    let scan = TransitionSearch::new(&sample).find(&vec![1.0; cases.len()]).unwrap();
    let limits = transition_limits(&scan.scan, 0.95).unwrap();
    assert!(limits.low <= scan.im4 && scan.im4 <= limits.high);
    // -2 ln(1 - sqrt(0.95)) = 7.352 (Hansen 2000, Table 1).
    let least = scan.scan.iter().map(|point| point.pooled_rss).fold(f64::INFINITY, f64::min);
    for point in &scan.scan {
        let ratio = (point.n_low + point.n_high) as f64 * (point.pooled_rss - least) / least;
        assert!(ratio > 7.35 || (limits.low..=limits.high).contains(&point.im4));
    }
    assert_eq!(transition_limits(&[], 0.95), None);
}

#[test]
fn what_cannot_be_fitted_says_why() {
    let status = |change: fn(&mut crate::data::Data), estimator: Estimator| {
        let mut data = data();
        change(&mut data);
        let model = CurveModel { estimator, ..CurveModel::default() };
        fit_overturning(&data.event_sample("xy"), &model).map(|fit| fit.status())
    };
    for estimator in [Estimator::Ml, Estimator::Firth] {
        assert_eq!(status(|_| (), estimator), Ok(FitStatus::Ok));
        assert_eq!(status(|data| data.y.fill(1.0), estimator), Err(FitStatus::Constant));
        let inverse = |data: &mut crate::data::Data| data.y = data.x.iter().map(|x| 2.0 - x).collect();
        assert_eq!(status(inverse, estimator), Err(FitStatus::Collinear));
        let turned = |data: &mut crate::data::Data| data.event.iter_mut().for_each(|event| *event = !*event);
        assert_eq!(status(turned, estimator), Ok(FitStatus::Falling));
        let none = |data: &mut crate::data::Data| data.event.fill(false);
        assert_eq!(status(none, estimator), Err(FitStatus::TooFewEvents));
    }
    let mut data = data();
    data.demand.fill(-1.0);
    assert_eq!(data.demand_sample("x").fit().unwrap_err(), FitStatus::Constant);
    data.demand = data.x.iter().map(|x| 1.0 - x + 0.1 * (9.0 * x).sin()).collect();
    assert_eq!(data.demand_sample("x").fit().unwrap().status(), FitStatus::Falling);
}
