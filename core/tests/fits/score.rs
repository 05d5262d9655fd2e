//! The log score of held-out cases against statsmodels and scipy (scripts/reference/fits.py), and what it must
//! not depend on.

use rockfrag_core::fragility::{Cases, Event, Measure, Predictors, fit_curves, fit_demand};

use crate::common::{answers, close, data};

/// The scores of the regressions of the demand and of the curves of overturning on these measures.
fn scores(safe: &Cases, overturning: &Cases, measures: &[&str]) -> [Vec<Option<f64>>; 2] {
    let asked: Vec<Predictors> = measures.iter().map(|one| one.parse().unwrap()).collect();
    let demand = fit_demand(safe, Some(1.3), 0.95, &asked, false);
    let curves = fit_curves(overturning, Event::Overturning, &asked, false);
    let of_demand = |one: &Predictors| demand.iter().skip(2).find(|fit| fit.predictors() == *one);
    let of_curves = |one: &Predictors| curves.iter().find(|fit| fit.predictors() == *one);
    [
        asked.iter().map(|one| of_demand(one).unwrap().held_out_log_score).collect(),
        asked.iter().map(|one| of_curves(one).unwrap().held_out_log_score).collect(),
    ]
}

#[test]
fn each_score_equals_that_of_statsmodels_and_scipy() {
    let (data, expected) = (data(), answers("score_answers.csv"));
    let expected = |name: &str| expected[&format!("{name}_log_score")];
    let (safe, overturning) = (data.safe(), data.overturning());
    let [demand, curves] = scores(&safe, &overturning, &["im4", "im4:im3"]);
    for (place, name) in ["im4", "im4:im3"].into_iter().enumerate() {
        close(demand[place].unwrap(), expected(&format!("p_ex_{name}_single")), 1e-7);
        close(curves[place].unwrap(), expected(&format!("p_ro_{name}_single")), 1e-7);
    }
    for plane in &fit_demand(&safe, Some(1.3), 0.95, &[], false) {
        close(plane.held_out_log_score.unwrap(), expected("p_ex_im4:im3_broken"), 1e-7);
    }
}

#[test]
fn what_drives_the_cases_scores_best_and_noise_adds_nothing() {
    let noise = |k: usize| (((k as f64 * 19.19).sin() * 43_758.545_3).fract().abs() + 0.1).exp();
    let data = data();
    let [safe, overturning] = [data.safe(), data.overturning()].map(|mut cases| {
        cases.columns.insert("noise".to_string(), (0..cases.all.len()).map(noise).collect());
        // IM3 in another unit.
        let im3 = cases.all.iter().map(|case| 40.0 * case.measures.im3.unwrap()).collect();
        cases.columns.insert("scaled".to_string(), im3);
        cases
    });
    let measures = ["im4:im3", "im4", "noise", "im4:noise", "im3:im5", "im4:im3_inv", "im4:scaled"];
    for scores in scores(&safe, &overturning, &measures) {
        let [both, alone, noise, with_noise, same @ ..] =
            &scores.into_iter().map(Option::unwrap).collect::<Vec<f64>>()[..]
        else {
            panic!()
        };
        assert!(both > &(alone + 0.01) && alone > &(noise + 0.1) && with_noise < &(alone + 0.01));
        // IM4 = IM3 IM5: one model.
        same.iter().for_each(|same| close(*same, *both, 1e-9));
    }
}

#[test]
fn one_cluster_and_no_fit_have_no_score() {
    let data = data();
    let one = |mut cases: Cases| {
        cases.all.iter_mut().for_each(|case| case.cluster = 0);
        cases
    };
    assert_eq!(scores(&one(data.safe()), &one(data.overturning()), &["im4"]), [[None], [None]]);
    assert_eq!(scores(&data.safe(), &data.overturning(), &["im1", "missing"]), [[None; 2], [None; 2]]);
    assert_eq!("missing".parse(), Ok(Predictors::one(Measure::Column("missing".to_string()))));
}
