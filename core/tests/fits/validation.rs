//! Scores of held-out cases and forecasts against what happened: closed forms, and numbers of statsmodels and
//! scipy (scripts/reference/fits.py).

use rockfrag_core::fragility::{Cases, Event, Measure, Predictors, fit_curves, fit_demand};
use rockfrag_core::statistics::{held_out, normal, probit};
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
        let fit = |x: &[Vec<f64>], events: &[bool]| Some((probit(x, events).ok()?.fit, ()));
        let z = held_out(&x, &data.event, &data.cells, fit).unwrap();
        let p: Vec<f64> = z.into_iter().map(|(z, ())| normal::cdf(z)).collect();
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

/// The log scores and calibration slopes of the regressions of the demand and of the curves of overturning on
/// these measures.
fn scores(safe: &Cases, overturning: &Cases, measures: &[&str]) -> [Vec<[Option<f64>; 2]>; 2] {
    let asked: Vec<Predictors> = measures.iter().map(|one| one.parse().unwrap()).collect();
    let demand = fit_demand(safe, Some(1.3), &[0.1], &asked, false);
    let curves = fit_curves(overturning, Event::Overturning, &asked, false);
    let of_demand = |one: &Predictors| {
        let fit = demand.iter().skip(2).find(|fit| fit.predictors() == *one).unwrap();
        [fit.held_out_log_score, fit.calibration_slope]
    };
    let of_curves = |one: &Predictors| {
        let fit = curves.iter().find(|fit| fit.predictors() == *one).unwrap();
        [fit.held_out_log_score, fit.calibration_slope]
    };
    [asked.iter().map(of_demand).collect(), asked.iter().map(of_curves).collect()]
}

#[test]
fn each_score_equals_that_of_statsmodels_and_scipy() {
    let (data, expected) = (data(), answers("score_answers.csv"));
    let of = |name: &str, what: &str| expected[&format!("{name}_{what}")];
    let (safe, overturning) = (data.safe(), data.overturning());
    let [demand, curves] = scores(&safe, &overturning, &["im4", "im4:im3"]);
    for (place, name) in ["im4", "im4:im3"].into_iter().enumerate() {
        for (event, found) in [("p_ex", &demand), ("p_ro", &curves)] {
            for (number, what) in found[place].into_iter().zip(["log_score", "slope"]) {
                close(number.unwrap(), of(&format!("{event}_{name}_single"), what), 1e-7);
            }
        }
    }
    for plane in &fit_demand(&safe, Some(1.3), &[0.1], &[], false) {
        close(plane.held_out_log_score.unwrap(), of("p_ex_im4:im3_broken", "log_score"), 1e-7);
    }
}

#[test]
fn the_same_model_in_other_measures_or_units_has_the_same_score() {
    let data = data();
    let [safe, overturning] = [data.safe(), data.overturning()].map(|mut cases| {
        // IM3 in another unit.
        let im3 = cases.all.iter().map(|case| 40.0 * case.measures.im3.unwrap()).collect();
        cases.columns.insert("scaled".to_string(), im3);
        cases
    });
    // IM4 = IM3 IM5: one model.
    for scores in scores(&safe, &overturning, &["im4:im3", "im3:im5", "im4:im3_inv", "im4:scaled"]) {
        scores.iter().for_each(|score| close(score[0].unwrap(), scores[0][0].unwrap(), 1e-9));
    }
}

#[test]
fn one_cluster_and_no_fit_have_no_score() {
    let data = data();
    let one = |mut cases: Cases| {
        cases.all.iter_mut().for_each(|case| case.cluster = 0);
        cases
    };
    assert_eq!(scores(&one(data.safe()), &one(data.overturning()), &["im4"]), [[[None; 2]], [[None; 2]]]);
    assert_eq!(scores(&data.safe(), &data.overturning(), &["im1", "missing"]), [[[None; 2]; 2]; 2]);
    assert_eq!("missing".parse(), Ok(Predictors::one(Measure::Column("missing".to_string()))));
}
