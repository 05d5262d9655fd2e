//! Curves of overturning (Eqs. 19 to 24): the hybrid measure, parameters with their errors, and what does not
//! depend on units; the distribution of the capacities of an incremental dynamic analysis.

use proptest::prelude::*;
use rand::RngExt;
use rockfrag_core::fragility::{
    CapacityFit, CurveFit, Event, KnownCapacity, Measure, Parameter, Predictors, fit_curve, fit_curves,
};
use rockfrag_core::rocking::Outcome;
use rockfrag_core::statistics::{FitStatus, normal};

use crate::common::{answers, cases, close, data, random, read};

const HYBRID: (Measure, Option<Measure>) = (Measure::Im4, Some(Measure::Im3Inverse));

/// Value and standard error of a parameter.
fn parameter(fit: &CurveFit, parameter: Parameter) -> (f64, f64) {
    let rows = fit.parameters(0.95);
    let row = rows.iter().find(|row| row.parameter == parameter).unwrap();
    (row.value, row.standard_error)
}

#[test]
fn curves_equal_statsmodels_and_pyfragility() {
    let (data, expected) = (data(), answers("answers.csv"));
    let errors = answers("uncertainty_answers.csv");
    let mut cases = data.overturning();
    // One cluster leaves errors to the model, nine widen them.
    for (clusters, is_clustered) in [(20, true), (9, false), (1, false)] {
        cases.all.iter_mut().for_each(|case| case.cluster %= clusters);
        for (name, im_y) in [("x", None), ("xy", Some(Measure::Im3))] {
            let fit = fit_curve(&cases, Event::Overturning, Measure::Im4, im_y);
            let (k, of) = (fit.coefficients.len(), |part: String| expected[&format!("probit_{name}_{part}")]);
            assert_eq!((fit.n, fit.is_clustered), (400, is_clustered));
            assert_eq!(fit.degrees, is_clustered.then_some(19.0));
            for j in 0..k {
                close(fit.coefficients[j], of(format!("b{j}")), 1e-8);
                let error = fit.covariance[j * (k + 1)].sqrt();
                match clusters {
                    20 => close(error, errors[&format!("probit_{name}_clustered{j}")], 1e-7),
                    9 => assert!(error > of(format!("se{j}"))),
                    _ => close(error, of(format!("se{j}")), 1e-8),
                }
            }
            close(fit.log_likelihood.unwrap(), of("llf".to_string()), 1e-10);
        }
    }
}

#[test]
fn delta_method_errors_equal_those_of_a_direct_parametrisation() {
    // The inverse information in (mu, beta) itself, by finite differences; one cluster leaves the error to the
    // model.
    let data = data();
    let mut cases = data.overturning();
    cases.all.iter_mut().for_each(|case| case.cluster = 0);
    let fit = fit_curve(&cases, Event::Overturning, Measure::Im4, None);
    assert!(!fit.is_clustered && fit.degrees.is_none());
    let likelihood = |mu: f64, beta: f64| -> f64 {
        let term = |(x, &event): (&f64, &bool)| {
            let z = (x - mu) / beta;
            normal::ln_cdf(if event { z } else { -z })
        };
        data.x.iter().zip(&data.event).map(term).sum()
    };
    let ((mu, mu_error), (beta, beta_error)) =
        (parameter(&fit, Parameter::Mu), parameter(&fit, Parameter::Beta));
    let h = 1e-4;
    let f = |i: f64, j: f64| likelihood(mu + i * h, beta + j * h);
    let mm = -(f(1.0, 0.0) - 2.0 * f(0.0, 0.0) + f(-1.0, 0.0)) / (h * h);
    let bb = -(f(0.0, 1.0) - 2.0 * f(0.0, 0.0) + f(0.0, -1.0)) / (h * h);
    let mb = -(f(1.0, 1.0) - f(1.0, -1.0) - f(-1.0, 1.0) + f(-1.0, -1.0)) / (4.0 * h * h);
    let determinant = mm * bb - mb * mb;
    close(mu_error, (bb / determinant).sqrt(), 1e-4);
    close(beta_error, (mm / determinant).sqrt(), 1e-4);
    let rows = fit.parameters(0.95);
    let [mu, _, theta] = &rows[..] else { panic!() };
    close(theta.low, mu.low.exp(), 1e-14);
    close(theta.standard_error, theta.value * mu_error, 1e-14);
}

#[test]
fn grouped_collapses_give_the_known_curve() {
    let ims = [0.2, 0.3, 0.4, 0.6, 0.7, 0.8, 0.9, 1.0];
    let collapses = [0, 0, 0, 4, 6, 13, 12, 16];
    let outcome = |collapsed: bool| if collapsed { Outcome::Overturned } else { Outcome::SafeRocking(0.5) };
    let rows = |(im, collapsed)| (0..40).map(move |k| (outcome(k < collapsed), im, 1.0, k));
    let cases = cases(ims.into_iter().zip(collapses).flat_map(rows));
    let fit = fit_curve(&cases, Event::Overturning, Measure::Im4, None);
    assert!((parameter(&fit, Parameter::Theta).0 - 1.07612).abs() < 5e-6);
    assert!((parameter(&fit, Parameter::Beta).0 - 0.42924).abs() < 5e-6);
    assert_eq!((fit.n, fit.n_events), (320, 51));
}

#[test]
fn curves_are_those_of_the_paper_or_all() {
    let cases = data().overturning();
    let pairs = ["im4:im3_inv", "im5"].map(|pair| pair.parse::<Predictors>().unwrap());
    let curves = |all| fit_curves(&cases, Event::Overturning, &pairs, all);
    let measures = |all| curves(all).into_iter().map(|fit| (fit.im_x, fit.im_y)).collect::<Vec<_>>();
    assert_eq!(measures(false), [(Measure::Im4, None), (Measure::Im5, None), HYBRID]);
    assert_eq!(measures(true).len(), 8);
    assert!(["im4:im4", "", "im4:", "im4:im3:im5"].iter().all(|pair| pair.parse::<Predictors>().is_err()));
}

#[test]
fn curves_that_cannot_be_made_have_a_status_and_no_numbers() {
    let cases = data().overturning();
    for (event, im_x, im_y, status) in [
        // All rock, and no case has IM1.
        (Event::Rocking, Measure::Im4, None, FitStatus::TooFewEvents),
        (Event::Overturning, Measure::Im1, None, FitStatus::TooFewEvents),
        (Event::Overturning, Measure::Im3, Some(Measure::Im3Inverse), FitStatus::Degenerate),
        (Event::Overturning, Measure::Im3, None, FitStatus::Inverse),
    ] {
        let fit = fit_curve(&cases, event, im_x, im_y);
        assert_eq!(fit.status, status);
        assert!(status == FitStatus::Inverse || fit.coefficients.is_empty());
    }
}

/// Each capacity is a cluster of its own.
fn fit_capacities(capacities: &[KnownCapacity]) -> Result<CapacityFit, FitStatus> {
    let clusters: Vec<u32> = (0..capacities.len() as u32).collect();
    rockfrag_core::fragility::fit_capacities(capacities, &clusters)
}

#[test]
fn a_capacity_that_comes_twice_in_a_cluster_counts_once() {
    let once: Vec<KnownCapacity> = (1..=20).map(|k| KnownCapacity::At(1.1_f64.powi(k * k % 17))).collect();
    let twice: Vec<KnownCapacity> = once.iter().flat_map(|&capacity| [capacity; 2]).collect();
    let clusters: Vec<u32> = (0..40).map(|k| k / 2).collect();
    let width = |fit: CapacityFit| (fit.theta.high / fit.theta.low).ln();
    let alone = fit_capacities(&twice).unwrap();
    let of_pairs = rockfrag_core::fragility::fit_capacities(&twice, &clusters).unwrap();
    // Student's t of 19 over that of 39 degrees of freedom.
    let wider = 2.093_024_054_408 / 2.022_690_920_036 * (2.0_f64 * (20.0 / 19.0) * (39.0 / 40.0)).sqrt();
    close(width(of_pairs) / width(alone), wider, 1e-9);
    close(of_pairs.theta.value, fit_capacities(&once).unwrap().theta.value, 1e-12);
}

#[test]
fn limits_of_known_capacities_are_scipys() {
    for row in read::<(String, [f64; 6], String)>("capacities.csv") {
        let (_, [theta, theta_low, theta_high, beta, beta_low, beta_high], capacities) = row;
        let known = capacities.split(' ').map(|text| KnownCapacity::At(text.parse().unwrap()));
        let fit = fit_capacities(&known.collect::<Vec<_>>()).unwrap();
        for (found, [value, low, high]) in
            [(fit.theta, [theta, theta_low, theta_high]), (fit.beta, [beta, beta_low, beta_high])]
        {
            close(found.value, value, 1e-12);
            close(found.low, low, 1e-10);
            close(found.high, high, 1e-10);
        }
    }
}

#[test]
fn capacities_beyond_the_scan_count_as_scipy_has_it() {
    // scipy.stats.norm.fit(CensoredData(uncensored, left=..., right=...)) of the logarithms, refined by
    // scipy.optimize.
    let known = [0.4, 0.55, 0.62, 0.8, 0.81, 1.2, 1.7, 2.4].map(KnownCapacity::At);
    let censored = [KnownCapacity::Above(3.0); 3].into_iter().chain([KnownCapacity::Below(0.3); 2]);
    let fit = fit_capacities(&known.into_iter().chain(censored).collect::<Vec<_>>()).unwrap();
    close(fit.theta.value, 1.069_841_029_011_907_4, 1e-8);
    close(fit.beta.value, 1.281_314_815_684_608_6, 1e-8);
    assert_eq!(fit_capacities(&[KnownCapacity::At(1.0)]), Err(FitStatus::TooFewEvents));
    assert_eq!(fit_capacities(&[KnownCapacity::Above(1.0); 9]), Err(FitStatus::TooFewEvents));
    assert_eq!(fit_capacities(&[KnownCapacity::At(1.0); 3]), Err(FitStatus::Degenerate));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn units_leave_lambda_and_beta_of_a_hybrid(a in -3.0..3.0f64, b in -3.0..3.0f64, seed in 1u64..100_000) {
        let (mut random, safe) = (random(seed), Outcome::SafeRocking(0.5));
        let rows: Vec<(Outcome, f64, f64)> = (0..200)
            .map(|k| match k % 2 {
                0 => (Outcome::Overturned, random.random_range(0.3..1.3), random.random_range(0.2..1.2)),
                _ => (safe, random.random_range(0.0..1.0), random.random_range(0.0..1.0)),
            })
            .collect();
        let fit = |a: f64, b: f64| {
            let moved = rows.iter().map(|(outcome, x, y)| (*outcome, (x + a).exp(), (-y - b).exp()));
            let rows = moved.zip(0..).map(|((outcome, im4, im3), k)| (outcome, im4, im3, k));
            fit_curve(&cases(rows), Event::Overturning, HYBRID.0, HYBRID.1)
        };
        let (here, there) = (fit(0.0, 0.0), fit(a, b));
        let of = |fit: &CurveFit, name| parameter(fit, name).0;
        let lambda = of(&here, Parameter::Lambda);
        // mu is a mean of ln IM with weights lambda/(1 + lambda) and 1/(1 + lambda) (Eq. 23).
        let moved = (lambda * a + b) / (1.0 + lambda);
        prop_assert!((of(&there, Parameter::Lambda) / lambda - 1.0).abs() < 1e-8);
        prop_assert!((of(&there, Parameter::Beta) / of(&here, Parameter::Beta) - 1.0).abs() < 1e-8);
        let mu = of(&there, Parameter::Mu) - of(&here, Parameter::Mu);
        prop_assert!((mu - moved).abs() < 1e-8 * (1.0 + moved.abs()));
    }
}
