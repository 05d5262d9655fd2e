//! Resampling within cells, refits and limits against statsmodels and scipy.stats.bootstrap.

use std::convert::Infallible;

use rockfrag::fragility::{
    Case, CurveInference, CurveModel, CurveParameter, CurveRefits, DemandInference, DemandRefits, Measure,
    Sample, TransitionSearch, fit_overturning,
};
use rockfrag::random::{Purpose, binomial, stream};
use rockfrag::resampling::{Resamples, Strata, acceleration, bootstrap, bootstrap_each, bootstrap_limits};
use rockfrag::statistics::{FitStatus, Link};

use crate::data::{answers, data, distribution, smooth_cases};

/// The weights of the reference: row k counts (k^2 + 1) mod 3 times.
fn counts(rows: usize) -> Vec<f64> {
    (0..rows).map(|k| ((k * k + 1) % 3) as f64).collect()
}

#[test]
fn a_refit_equals_the_fit_of_repeated_cases() {
    let (data, answers) = (data(), answers());
    let counts = counts(data.x.len());
    for name in ["x", "xy"] {
        let sample = data.event_sample(name);
        let fit = fit_overturning(&sample, &CurveModel::default()).unwrap();
        let parameters = CurveInference::new(&sample, &fit.regression).curve_parameters();
        assert_eq!(parameters.contains(&CurveParameter::Lambda), name == "xy");
        let resamples = Resamples::alike(&counts);
        let [b, ..] = CurveRefits::new(&sample, &fit.regression).coefficients(&resamples);
        let b = b.unwrap();
        for (k, b) in b.iter().enumerate() {
            answers.check(&format!("weighted_probit_{name}_b{k}"), *b, 1e-7);
        }
        let sample = data.demand_sample(name);
        let [refit, ..] = DemandRefits::new(&sample).replicates(&Resamples::alike(&counts));
        let refit = refit.unwrap();
        for (k, b) in refit.coefficients.iter().enumerate() {
            answers.check(&format!("weighted_ols_{name}_b{k}"), *b, 1e-10);
        }
        answers.check(&format!("weighted_ols_{name}_sd"), refit.residual_sd, 1e-10);
    }
}

#[test]
fn refits_by_expansion_are_those_by_newtons_method() {
    let data = data();
    for (name, link) in [("x", Link::Probit), ("x", Link::Logit), ("x", Link::Cloglog), ("xy", Link::Probit)]
    {
        let sample = data.event_sample(name);
        let fit = fit_overturning(&sample, &CurveModel { link, ..CurveModel::default() }).unwrap().regression;
        let (refits, inference) = (CurveRefits::new(&sample, &fit), CurveInference::new(&sample, &fit));
        let apart = bootstrap(&Strata::new(&data.cells), 200, 42, |resamples| {
            let refits = refits.coefficients(resamples);
            std::array::from_fn(|resample| {
                let refit = refits[resample].as_ref().unwrap();
                let exact = inference.coefficients(&resamples.of(resample, &sample.rows())).unwrap();
                let standard_errors = fit.covariance.diagonal().map(f64::sqrt);
                (refit - exact).component_div(&standard_errors).amax()
            })
        });
        let worst = apart.iter().copied().fold(0.0, f64::max);
        assert!(worst < 3e-5, "{link:?} on {name}: {worst:e} standard errors apart");
    }
}

#[test]
fn refits_of_few_cases_are_those_of_repeated_cases_or_none() {
    // Of 20 cases, half of them events, a fifth of the resamples are separated.
    let mut data = data();
    data.first(20);
    let sample = data.event_sample("x");
    let fit = fit_overturning(&sample, &CurveModel::default()).unwrap().regression;
    let refits = CurveRefits::new(&sample, &fit);
    let pairs = bootstrap(&Strata::new(&data.cells), 200, 3, |resamples| {
        let mut refits = refits.coefficients(resamples);
        std::array::from_fn(|resample| {
            let counts = resamples.of(resample, &sample.rows());
            let rows = (0..20).flat_map(|row| std::iter::repeat_n(row, counts[row] as usize));
            let repeated = data.rows(rows).event_sample("x");
            (refits[resample].take(), fit_overturning(&repeated, &CurveModel::default()))
        })
    });
    let (mut fitted, mut separated) = (0, 0);
    for pair in pairs {
        match pair {
            (refit, Ok(exact)) => {
                let exact = exact.regression;
                let apart = (refit.unwrap() - exact.coefficients)
                    .component_div(&exact.covariance.diagonal().map(f64::sqrt));
                assert!(apart.amax() < 1e-3, "{apart}");
                fitted += 1;
            }
            (refit, Err(FitStatus::Separated)) => {
                assert_eq!(refit, None);
                separated += 1;
            }
            _ => {}
        }
    }
    assert!(fitted > 100 && separated > 20, "{fitted} {separated}");
}

#[test]
fn a_case_that_does_not_count_may_lie_anywhere() {
    let (near, mut far) = (data(), data());
    // By the curve of the others its probability is zero, which has no finite logarithm.
    let columns = [&mut far.x, &mut far.y, &mut far.demand];
    columns.into_iter().zip([600.0, 0.0, 0.0]).for_each(|(column, value)| column.push(value));
    far.event.push(false);
    far.cells.push(20);
    let rows = near.x.len();
    let counts: Vec<f64> = (0..=rows).map(|row| if row < rows { 1.0 } else { 0.0 }).collect();
    let model = CurveModel { link: Link::Cloglog, ..CurveModel::default() };
    let expected = fit_overturning(&near.event_sample("x"), &model).unwrap().regression;
    let sample = far.event_sample("x");
    let fit = fit_overturning(&sample, &model).unwrap().regression;
    let [by_refits, ..] = CurveRefits::new(&sample, &fit).coefficients(&Resamples::alike(&counts));
    let by_inference = CurveInference::new(&sample, &fit).coefficients(&counts);
    for refit in [by_refits.unwrap(), by_inference.unwrap()] {
        let standard_errors = expected.covariance.diagonal().map(f64::sqrt);
        let apart = (refit - &expected.coefficients).component_div(&standard_errors);
        assert!(apart.amax() < 1e-3, "{apart}");
    }
}

#[test]
fn a_break_in_a_resample_is_that_of_repeated_cases() {
    let cases = smooth_cases();
    let counts = counts(cases.len());
    let repeated: Vec<Case> =
        cases.iter().zip(&counts).flat_map(|(case, count)| vec![*case; *count as usize]).collect();
    let sample = |cases: &[Case], range| Sample::of_demands(cases, &[Measure::Im4, Measure::Im3], range);
    let search = TransitionSearch::new(&sample(&cases, 0.0..f64::INFINITY));
    let [found, ..] = search.breaks(&Resamples::alike(&counts));
    let found = found.unwrap();
    let of_repeated = TransitionSearch::new(&sample(&repeated, 0.0..f64::INFINITY));
    assert_eq!(found.im4, of_repeated.find(&vec![1.0; repeated.len()]).unwrap().im4);
    for (plane, range) in [(found.low, 0.0..found.im4), (found.high, found.im4..f64::INFINITY)] {
        let (plane, fit) = (plane.unwrap(), sample(&repeated, range).fit().unwrap());
        for (b, estimate) in plane.coefficients.iter().zip(&fit.coefficients) {
            assert!((b - estimate.value).abs() < 1e-9 * estimate.standard_error, "{b} for {estimate:?}");
        }
        assert!((plane.residual_sd / fit.residual_sd - 1.0).abs() < 1e-9, "{plane:?}");
    }
}

#[test]
fn limits_equal_scipys_on_the_same_replicates() {
    let (data, answers) = (data(), answers());
    let strata = Strata::new(&data.cells);
    let check = |statistic: &str, estimate: f64, acceleration: f64, tolerance: f64| {
        let replicates: Vec<Option<f64>> = distribution(statistic).into_iter().map(Some).collect();
        let limits = bootstrap_limits(estimate, &replicates, acceleration, 0.95).unwrap();
        answers.check(&format!("percentile_{statistic}_low"), limits.percentile.low, 1e-12);
        answers.check(&format!("percentile_{statistic}_high"), limits.percentile.high, 1e-12);
        answers.check(&format!("bca_{statistic}_low"), limits.bca.unwrap().low, tolerance);
        answers.check(&format!("bca_{statistic}_high"), limits.bca.unwrap().high, tolerance);
    };
    let sample = data.demand_sample("x");
    let fit = sample.fit().unwrap();
    let accelerations = DemandInference::new(&sample, &fit).accelerations(&strata);
    check("slope", fit.coefficients[1].value, accelerations[1], 1e-9);

    let sample = data.event_sample("x");
    let fit = fit_overturning(&sample, &CurveModel::default()).unwrap();
    let refit = CurveInference::new(&sample, &fit.regression);
    // The jackknife with every refit carried to its end is scipy's; ours stops after one Newton step.
    let without = |row: usize| {
        let mut counts = vec![1.0; data.x.len()];
        counts[row] = 0.0;
        CurveParameter::Mu.value(Link::Probit, &refit.coefficients(&counts).unwrap())
    };
    let exact = acceleration(&(0..data.x.len()).map(without).collect::<Vec<_>>(), &strata);
    let one_step = refit.acceleration(CurveParameter::Mu, &strata);
    assert!((one_step / exact - 1.0).abs() < 0.05, "{one_step} for {exact}");
    check("mu", fit.mu.value, exact, 1e-7);
    check("mu", fit.mu.value, one_step, 1e-3);
}

#[test]
fn our_own_resamples_spread_as_scipys() {
    let (data, answers) = (data(), answers());
    let refits = DemandRefits::new(&data.demand_sample("x"));
    let slopes: Vec<f64> = bootstrap(&Strata::new(&data.cells), 4000, 42, |resamples| {
        refits.replicates(resamples).map(|fit| fit.unwrap().coefficients[1])
    });
    let mean = slopes.iter().sum::<f64>() / slopes.len() as f64;
    let sd = (slopes.iter().map(|b| (b - mean).powi(2)).sum::<f64>() / slopes.len() as f64).sqrt();
    // scipy's 999 replicates give its standard error to 2 %.
    answers.check("bootstrap_slope_error", sd, 0.08);
}

#[test]
fn every_cell_keeps_its_size_in_every_resample() {
    let cells: Vec<usize> = (0..300).map(|row| row % 7 + row % 2).collect();
    let strata = Strata::new(&cells);
    let sizes = |counts: &[f64]| -> Vec<f64> {
        strata.members().iter().map(|rows| rows.iter().map(|&row| counts[row]).sum()).collect()
    };
    let original = sizes(&[1.0; 300]);
    let all = |resamples: &Resamples| {
        let rows: Vec<usize> = (0..300).collect();
        std::array::from_fn(|resample| resamples.of(resample, &rows))
    };
    let resamples =
        bootstrap(&strata, 50, 1, |resamples| all(resamples).map(|counts| (sizes(&counts), counts)));
    assert!(resamples.iter().all(|(sizes, _)| *sizes == original));
    assert!(resamples.windows(2).all(|pair| pair[0].1 != pair[1].1), "each resample is another");
}

#[test]
fn a_replicate_depends_on_its_number_and_the_seed_alone() {
    let strata = Strata::new(&[0, 0, 0, 1, 1, 2]);
    let of_all =
        |resamples: &Resamples| std::array::from_fn(|resample| resamples.of(resample, &[0, 1, 2, 3, 4, 5]));
    let draw = |replicates, seed| bootstrap(&strata, replicates, seed, of_all);
    let many = draw(40, 5);
    assert_eq!(draw(7, 5), many[..7]);
    assert_ne!(draw(7, 6), many[..7]);
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    assert_eq!(one_thread.install(|| draw(40, 5)), many);
}

#[test]
fn samples_of_the_same_rows_are_resampled_alike() {
    // More draws than are made at once.
    let (rows, replicates, at_once) = (9000, 2400, 1872);
    let strata = Strata::new(&vec![0; rows]);
    let count = |row: &usize, resamples: &Resamples| Ok::<_, Infallible>(resamples.counts[*row]);
    let Ok(each) = bootstrap_each(&strata, replicates, 3, &[0, 17], count);
    let alone = bootstrap(&strata, replicates, 3, |resamples| resamples.counts[17]);
    assert_eq!(each[1], alone);
    assert_eq!(alone.len(), replicates);
    assert_ne!(each[0], alone);
    assert_ne!(alone[..replicates - at_once], alone[at_once..], "later replicates are others");
}

#[test]
fn replicates_without_a_fit_must_not_fill_the_tails() {
    let values = |missing: usize| -> Vec<Option<f64>> {
        (0..100).map(|k| (k >= missing).then_some(k as f64)).collect()
    };
    assert!(bootstrap_limits(50.0, &values(4), 0.0, 0.95).is_some());
    assert!(bootstrap_limits(50.0, &values(6), 0.0, 0.95).is_none());
    assert!(bootstrap_limits(50.0, &[], 0.0, 0.95).is_none());
    let aside = bootstrap_limits(200.0, &values(0), 0.0, 0.95).unwrap();
    assert!(aside.bca.is_none(), "no bias can be told where all replicates lie below the estimate");
}

#[test]
fn binomial_numbers_have_their_mean_and_variance() {
    let mut random = stream(1, Purpose::Bootstrap, 0);
    for (trials, p) in [(10, 0.3), (50, 0.9), (1000, 0.02), (8192, 0.5), (1_000_000, 1e-5)] {
        let n = 20_000.0;
        let drawn: Vec<f64> = (0..20_000).map(|_| binomial(trials, p, &mut random) as f64).collect();
        let mean = drawn.iter().sum::<f64>() / n;
        let variance = drawn.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0);
        let expected = trials as f64 * p;
        let variance_expected = expected * (1.0 - p);
        assert!(drawn.iter().all(|x| *x <= trials as f64));
        assert!((mean - expected).abs() < 4.5 * (variance_expected / n).sqrt(), "{mean} for {expected}");
        // The variance of the sample variance: sigma^4 (2 / (n - 1) + excess kurtosis / n).
        let error = (variance_expected.powi(2)
            * (2.0 / n + (1.0 - 6.0 * p * (1.0 - p)) / variance_expected / n))
            .sqrt();
        assert!((variance - variance_expected).abs() < 4.5 * error, "{variance} for {variance_expected}");
    }
}
