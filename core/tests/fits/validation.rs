//! Forecasts against what happened: closed forms, and numbers of statsmodels and scipy.

use rockfrag_core::fragility::Event;
use rockfrag_core::statistics::{Folds, normal, predict, probit};
use rockfrag_core::studies::{Forecasts, observed_share};

use crate::common::{answers, close, data};

fn forecasts<'a>(probabilities: &'a [f64], happened: &'a [bool], clusters: &'a [u32]) -> Forecasts<'a> {
    let event = Event::Overturning;
    Forecasts { suite: None, structure: "any", event, model: "test", probabilities, happened, clusters }
}

#[test]
fn forecasts_of_cells_left_out_score_as_statsmodels_has_it() {
    let (data, expected) = (data(), answers("score_answers.csv"));
    for (name, key) in [("x", "p_ro_im4_single"), ("xy", "p_ro_im4:im3_single")] {
        let x = data.predictors(name);
        let folds = Folds::new(&data.cells, 10).unwrap();
        let mut p = vec![0.0; data.x.len()];
        for fold in 0..folds.count {
            let (kept, left_out) = folds.split(fold);
            let columns: Vec<Vec<f64>> = x.iter().map(|x| kept.iter().map(|&k| x[k]).collect()).collect();
            let events: Vec<bool> = kept.iter().map(|&k| data.event[k]).collect();
            let fit = probit(&columns.iter().map(Vec::as_slice).collect::<Vec<_>>(), &events).unwrap().fit;
            let z = predict(fit.coefficients.as_slice(), &x);
            left_out.into_iter().for_each(|k| p[k] = normal::cdf(z[k]));
        }
        let forecasts = forecasts(&p, &data.event, &data.cells);
        let validation = forecasts.validate().unwrap();
        let of = |figure: &str| expected[&format!("{key}_{figure}")];
        close(validation.log_score.unwrap(), of("log_score"), 1e-7);
        close(validation.auc.unwrap(), of("unseen_auc"), 1e-12);
        close(validation.brier, of("unseen_brier"), 1e-7);
        close(validation.calibration_slope.unwrap(), of("slope"), 1e-7);
        assert!((validation.calibration_intercept.unwrap() - of("intercept")).abs() < 1e-7);
        let bins = forecasts.reliability();
        assert!(bins.len() == 10 && bins.is_sorted_by(|a, b| a.predicted < b.predicted));
        assert_eq!(bins.iter().map(|bin| bin.observed).sum::<i64>(), validation.observed);
        assert!(bins.iter().all(|bin| bin.n == 40 && (bin.share_low..=bin.share_high).contains(&bin.share)));
    }
}

#[test]
fn counts_have_the_errors_of_their_clusters() {
    // Four cells of 25 cases, of which all or none happen: what is expected is right, the count depends on
    // four draws.
    let clusters: Vec<u32> = (0..100).map(|k| k / 25).collect();
    let happened: Vec<bool> = (0..100).map(|k| k / 25 == 1).collect();
    let validation = forecasts(&[0.25; 100], &happened, &clusters).validate().unwrap();
    assert_eq!((validation.n, validation.observed), (100, 25));
    close(validation.expected, 25.0, 1e-12);
    // Sums of cells: -6.25, 18.75, -6.25, -6.25; times the square root of 4/3.
    close(validation.expected_error, (4.0 / 3.0 * (3.0 * 6.25f64.powi(2) + 18.75f64.powi(2))).sqrt(), 1e-12);
    let alone: Vec<u32> = (0..100).collect();
    let independent = forecasts(&[0.25; 100], &happened, &alone).validate().unwrap();
    close(independent.expected_error, (100.0 / 99.0 * 100.0 * 0.25 * 0.75f64).sqrt(), 1e-12);
    assert_eq!(validation.calibration_slope, None, "equal probabilities have no slope");
}

#[test]
fn what_cannot_be_scored_is_left_out() {
    assert_eq!(forecasts(&[], &[], &[]).validate(), None);
    let clusters = [0, 1, 2];
    let impossible = forecasts(&[0.0, 0.5, 1.0], &[true, false, true], &clusters).validate().unwrap();
    assert!(impossible.log_score.is_none() && impossible.auc.is_some());
    let all = forecasts(&[0.9, 0.8, 0.7], &[true; 3], &clusters).validate().unwrap();
    assert!(all.auc.is_none() && all.calibration_intercept.is_none() && all.log_score.is_some());
    assert_eq!(forecasts(&[0.9, 0.8, 0.7], &[true; 3], &clusters).reliability().len(), 3);
}

#[test]
fn limits_of_a_share_equal_those_of_scipy() {
    // scipy.stats.binomtest(k, 28).proportion_ci(method="wilson")
    for (observed, low, high) in [
        (0, 0.0, 0.120_643_304_765_845_64),
        (3, 0.037_118_366_829_300_004, 0.271_958_515_486_721_56),
        (17, 0.424_090_442_965_971_87, 0.764_343_134_584_204_1),
    ] {
        let limits = observed_share(observed, 28);
        assert!((limits.low - low).abs() < 1e-14 && (limits.high - high).abs() < 1e-14, "{limits:?}");
    }
}
