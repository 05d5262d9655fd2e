//! Regressions of the demand (Eqs. 14 to 18): planes that are known, the transition, and the probability with
//! its limits.

use rand::RngExt;
use rockfrag_core::fragility::{
    Cases, DemandModel, Measure, PLANE, Predictors, fit_demand, fit_law, fit_planes, ln_median_demand,
    scan_transition, transition,
};
use rockfrag_core::motion::IntensityMeasures;
use rockfrag_core::rocking::Outcome;
use rockfrag_core::statistics::distributions::t_quantile;
use rockfrag_core::statistics::{FitStatus, normal};

use crate::common::{answers, cases, close, data, random};

/// Planes as Table II has them for the electrical equipment under combined motions: ln a, b1, b2.
const LOW: [f64; 3] = [-11.39, 30.39, -0.072];
const HIGH: [f64; 3] = [-2.765, 2.954, -0.942];

/// Cases on these planes, which meet at `at`, in 20 cells.
fn on_planes(at: f64, n: u32) -> Cases {
    let mut random = random(7);
    cases((0..n).map(|k| {
        let (im4, im3) = (random.random_range(1.0..3.0), random.random_range(0.5..1.5));
        let ln_median = ln_median_demand(if im4 < at { &LOW } else { &HIGH }, &[im4, im3]);
        let demand = (ln_median + random.random_range(-0.1..0.1)).exp();
        (Outcome::SafeRocking(demand), im4, im3, k % 20)
    }))
}

#[test]
fn regressions_equal_statsmodels() {
    let (data, expected) = (data(), answers("answers.csv"));
    let errors = answers("uncertainty_answers.csv");
    let mut cases = data.safe();
    // One cluster leaves errors and limits to the model, nine widen them.
    for (clusters, is_clustered) in [(20, true), (9, false), (1, false)] {
        cases.all.iter_mut().for_each(|case| case.cluster %= clusters);
        for (name, fit) in [
            ("x", fit_law(&cases, Predictors::one(Measure::Im4))),
            ("xy", fit_law(&cases, Predictors::two(PLANE))),
        ] {
            let (k, of) = (fit.coefficients.len(), |part: String| expected[&format!("ols_{name}_{part}")]);
            assert_eq!((fit.n, fit.n_clusters, fit.is_clustered), (400, i64::from(clusters), is_clustered));
            let rows = fit.parameters(0.95);
            for (j, row) in rows[..k].iter().enumerate() {
                close(row.value, of(format!("b{j}")), 1e-10);
                if is_clustered {
                    close(row.standard_error, errors[&format!("ols_{name}_clustered{j}")], 1e-9);
                } else if clusters == 9 {
                    assert!(row.standard_error > of(format!("se{j}")));
                } else {
                    close(row.standard_error, of(format!("se{j}")), 1e-10);
                    close(row.low, of(format!("low{j}")), 1e-9);
                    close(row.high, of(format!("high{j}")), 1e-9);
                }
            }
            let beta = fit.beta.unwrap();
            close(beta, of("sd".to_string()), 1e-10);
            close(fit.r2.unwrap(), of("r2".to_string()), 1e-10);
            close(rows[k].standard_error, beta / (2.0 * (400 - k) as f64).sqrt(), 1e-12);
            close(rows[k + 1].value, beta / fit.coefficients[1], 1e-14);
        }
    }
}

#[test]
fn two_planes_and_their_transition_are_found() {
    let cases = on_planes(1.3, 3000);
    let scan = scan_transition(&cases);
    let found = transition(&scan).unwrap();
    assert!((found - 1.3).abs() < 0.011, "{found}");
    let [low, high] = fit_planes(&cases, found);
    for (fit, expected) in [(&low, LOW), (&high, HIGH)] {
        assert_eq!((fit.model, fit.status), (DemandModel::Biplanar, FitStatus::Ok));
        for (row, expected) in fit.parameters(0.95).iter().zip(expected) {
            assert!((row.value - expected).abs() < 4.0 * row.standard_error, "{row:?}, expected {expected}");
        }
    }
    let ranges = [low.range_low, low.range_high, high.range_low, high.range_high];
    assert_eq!(ranges, [None, Some(found), Some(found), None]);
    assert!(low.holds_at(found - 1e-9) && !low.holds_at(found) && high.holds_at(found));
    assert_eq!(high.r2_pooled, low.r2_pooled);
}

#[test]
fn the_scan_by_sums_equals_fitting_anew_at_each_place() {
    let cases = on_planes(1.4, 1500);
    let scan = scan_transition(&cases);
    assert!(scan.len() > 50);
    for point in scan.iter().step_by(13) {
        let fits = fit_planes(&cases, point.im4);
        let rss: f64 = fits.iter().map(|fit| fit.beta.unwrap().powi(2) * (fit.n - 3) as f64).sum();
        close(point.pooled_rss, rss, 1e-8);
    }
}

#[test]
fn the_transition_is_the_papers_unless_it_is_to_be_found() {
    let cases = on_planes(1.5, 1500);
    let fit = |transition, all| fit_demand(&cases, transition, &[0.1], &[], all);
    let [low, _] = &fit(Some(rockfrag_core::paper::TRANSITION), false)[..] else { panic!() };
    assert!(low.range_high == Some(1.3) && (low.transition_found.unwrap() - 1.5).abs() < 0.011, "{low:?}");
    assert_eq!(fit(None, false)[0].range_high, low.transition_found);
    let all = fit(None, true);
    let count = |model| all.iter().filter(|fit| fit.model == model).count();
    assert_eq!([DemandModel::Biplanar, DemandModel::Univariate, DemandModel::Plane].map(count), [2, 6, 1]);
}

#[test]
fn fits_that_cannot_be_made_have_a_status_and_no_numbers() {
    let line = |n: u32, im3: fn(f64) -> f64| {
        cases((0..n).map(move |k| {
            let im4 = 1.0 + 0.02 * f64::from(k);
            (Outcome::SafeRocking(0.1 + 0.01 * f64::from(k % 7)), im4, im3(im4), k)
        }))
    };
    for cases in [line(3, |im4| 1.0 / im4), line(90, |im4| im4)] {
        let fit = fit_law(&cases, Predictors::two(PLANE));
        assert_eq!((fit.status, fit.coefficients.len(), fit.beta), (FitStatus::Degenerate, 0, None));
        assert!(fit.parameters(0.95).is_empty());
        assert_eq!(fit.p_exceeding(&cases.all[0].measures, 0.1, 0.95), None);
    }
    let demand = |k: u32| (0.3 * f64::from(k % 3) - 0.1 * f64::from(k)).exp();
    let falling = cases((0..90).map(|k| (Outcome::SafeRocking(demand(k)), 1.0 + f64::from(k), 1.0, k)));
    assert_eq!(fit_law(&falling, Predictors::one(Measure::Im4)).status, FitStatus::WrongSign);
    // No case has it.
    assert_eq!(fit_law(&falling, Predictors::one(Measure::Im1)).status, FitStatus::Degenerate);
    let few = line(30, |im4| im4);
    assert!(scan_transition(&few).is_empty());
    let fits = fit_demand(&few, None, &[0.1], &[], false);
    assert!(fits.iter().all(|fit| !fit.status.is_usable() || fit.model == DemandModel::Univariate));
}

#[test]
fn the_variance_of_p_ex_is_that_of_the_textbook() {
    // In 12 clusters of one case a model-based error: few clusters must not matter here, so nine of them.
    let mut random = random(5);
    let mut row = |k: u32| {
        let im4: f64 = random.random_range(1.0..3.0);
        let edp = (2.0 * im4.ln() + random.random_range(-0.5..0.5f64)).exp();
        (Outcome::SafeRocking(edp), im4, 1.0, k % 9)
    };
    let rows: Vec<_> = (0..12).map(&mut row).collect();
    let fit = fit_law(&cases(rows.clone()), Predictors::one(Measure::Im4));
    assert!(!fit.is_clustered && fit.degrees == Some(10.0));
    let (at, limit, beta) = (1.5f64, 4.0f64, fit.beta.unwrap());
    let ln: Vec<f64> = rows.iter().map(|row| row.1.ln()).collect();
    let mean = ln.iter().sum::<f64>() / 12.0;
    let squares: f64 = ln.iter().map(|x| (x - mean).powi(2)).sum();
    let variance = 1.0 / 12.0 + (at.ln() - mean).powi(2) / squares;
    let z = (fit.coefficients[0] + fit.coefficients[1] * at.ln() - limit.ln()) / beta;
    let half_width = t_quantile(0.975, 10.0) * (variance + z * z / 20.0).sqrt();
    let measures = IntensityMeasures { im3: None, ..IntensityMeasures::from_peaks(at, 1.0) };
    let p = fit.p_exceeding(&measures, limit, 0.95).unwrap();
    close(p.value, normal::cdf(z), 1e-13);
    close(p.low, normal::cdf(z - half_width), 1e-9);
    close(p.high, normal::cdf(z + half_width), 1e-9);
    // IM3 is missing.
    assert_eq!(fit_law(&cases(rows), Predictors::two(PLANE)).p_exceeding(&measures, limit, 0.95), None);
}
