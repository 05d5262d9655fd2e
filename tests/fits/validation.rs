//! Forecasts against what happened: closed forms, and numbers of scipy 1.16 where there are none.

use rockfrag::fragility::Probability;
use rockfrag::statistics::{Limits, PoissonBinomial, auc, expected_log_score, log_score};
use rockfrag::studies::{Forecast, Validation, calibration_in_the_large, wilson_limits};

#[track_caller]
fn close(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance, "{value} is not {expected}");
}

/// Binomial probabilities of 0 to n.
fn binomial(n: usize, p: f64) -> Vec<f64> {
    let first = (1.0 - p).powi(n as i32);
    let next = |mass: &mut f64, k: usize| {
        let here = *mass;
        *mass *= (n - k) as f64 / (k + 1) as f64 * p / (1.0 - p);
        Some(here)
    };
    (0..=n).scan(first, next).collect()
}

#[test]
fn counts_of_equal_probability_are_binomial() {
    let count = PoissonBinomial::new([0.3; 28]);
    let masses = binomial(28, 0.3);
    for k in 0..=28 {
        close(count.at_most(k), masses[..=k].iter().sum(), 1e-14);
        close(count.at_least(k), masses[k..].iter().sum(), 1e-14);
    }
    // scipy.stats.binom.interval(0.95, 28, 0.3), .cdf(5, 28, 0.3)
    assert_eq!([0.025, 0.975].map(|level| count.quantile(level)), [4, 13]);
    close(count.at_most(5), 0.112_789_043_606_986_56, 1e-15);
    close(count.two_sided_p(5), 2.0 * 0.112_789_043_606_986_56, 1e-15);
}

#[test]
fn counts_of_unequal_probability_equal_those_of_scipy() {
    // scipy.stats.poisson_binom.cdf([0, 1, 2, 3, 4], p) and .ppf([0.025, 0.975], p)
    let count = PoissonBinomial::new([0.1, 0.35, 0.5, 0.8, 0.95]);
    for (k, expected) in [0.002925, 0.075025, 0.410375, 0.824975, 0.9867].into_iter().enumerate() {
        close(count.at_most(k), expected, 1e-15);
    }
    assert_eq!([0.025, 0.975].map(|level| count.quantile(level)), [1, 4]);
}

#[test]
fn certainties_shift_the_count() {
    let count = PoissonBinomial::new([1.0, 0.0, 1.0, 0.5]);
    assert_eq!([0.4, 0.6].map(|level| count.quantile(level)), [2, 3]);
    assert_eq!((count.at_most(1), count.at_least(2), count.at_most(3)), (0.0, 1.0, 1.0));
    assert_eq!(count.two_sided_p(0), 0.0);
    assert_eq!(PoissonBinomial::new([]).quantile(0.975), 0);
}

#[test]
fn many_events_are_nearly_normal() {
    let n = 20_000;
    let probabilities: Vec<f64> = (0..n).map(|k| (k as f64 + 0.5) / n as f64).collect();
    let count = PoissonBinomial::new(probabilities.iter().copied());
    let sd = probabilities.iter().map(|p| p * (1.0 - p)).sum::<f64>().sqrt();
    let [low, high] = [0.025, 0.975].map(|level| count.quantile(level) as f64);
    close(0.5 * (low + high), 0.5 * n as f64, 0.6);
    close(high - low, 2.0 * 1.959_964 * sd, 1.1);
    close(count.at_most(n), 1.0, 1e-12);
}

#[test]
fn limits_of_a_share_equal_those_of_scipy() {
    // scipy.stats.binomtest(k, 28).proportion_ci(method="wilson")
    for (seen, low, high) in [
        (0, 0.0, 0.120_643_304_765_845_64),
        (3, 0.037_118_366_829_300_004, 0.271_958_515_486_721_56),
        (17, 0.424_090_442_965_971_87, 0.764_343_134_584_204_1),
    ] {
        let Limits { low: ours, high: ours_high } = wilson_limits(seen, 28);
        close(ours, low, 1e-12);
        close(ours_high, high, 1e-12);
    }
}

#[test]
fn calibration_in_the_large_is_the_shift_of_the_log_odds() {
    // Of equal probabilities it is ln(odds seen / odds foretold).
    let shift = calibration_in_the_large(&[0.2; 10], 5).unwrap();
    close(shift, 4f64.ln(), 1e-11);
    close(calibration_in_the_large(&[0.1, 0.5, 0.4], 1).unwrap(), 0.0, 1e-11);
    assert_eq!(calibration_in_the_large(&[0.2; 10], 0), None);
    assert_eq!(calibration_in_the_large(&[0.2; 10], 10), None);
    assert_eq!(calibration_in_the_large(&[1.0, 0.3], 1), None);
}

#[test]
fn scores_of_right_and_of_certain_forecasts() {
    close(
        log_score(&[0.25, 0.25, 0.25, 0.25], &[true, false, false, false]),
        expected_log_score(&[0.25]),
        1e-15,
    );
    assert_eq!(expected_log_score(&[0.0, 1.0]), 0.0);
    assert_eq!(log_score(&[1.0, 0.0], &[true, false]), 0.0);
    assert_eq!(log_score(&[1.0], &[false]), f64::NEG_INFINITY);
}

#[test]
fn a_validation_holds_all_of_these() {
    let forecast = |value: f64, happened| Forecast {
        probability: Probability { value, low: value - 0.05, high: value + 0.1 },
        happened,
        is_extrapolated: value > 0.85,
    };
    let forecasts = [forecast(0.1, false), forecast(0.35, true), forecast(0.5, false), forecast(0.9, true)];
    let validation = Validation::of(&forecasts).unwrap();
    assert_eq!((validation.n, validation.seen, validation.extrapolated), (4, 2, 1));
    close(validation.expected, 1.85, 1e-15);
    close(validation.expected_limits.low, 1.65, 1e-15);
    close(validation.expected_limits.high, 2.25, 1e-15);
    assert_eq!(validation.chance_limits, [0, 3]);
    close(validation.brier, (0.01 + 0.4225 + 0.25 + 0.01) / 4.0, 1e-15);
    assert_eq!(validation.auc, Some(auc(&[0.1, 0.35, 0.5, 0.9], &[false, true, false, true])));
    assert!(validation.calibration.is_some_and(|shift| shift > 0.0));
    assert_eq!(Validation::of(&[]), None);
    assert_eq!((validation.impossible, validation.log_score.is_some()), (0, true));
    // What cannot happen and does, in either way.
    for (certain, happened) in [(0.0, true), (1.0, false)] {
        let with_impossible = [forecasts[0], forecast(certain, happened), forecast(certain, !happened)];
        let validation = Validation::of(&with_impossible).unwrap();
        assert_eq!((validation.impossible, validation.log_score), (1, None));
        assert!(validation.log_score_expected.is_finite());
    }
}
