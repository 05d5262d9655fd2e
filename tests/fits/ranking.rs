//! The ranking of measures against statsmodels and scipy (scripts/reference/fits.py), and what it must not
//! depend on.

use rockfrag::fragility::Cases;
use rockfrag::statistics::FitStatus;
use rockfrag::studies::{Form, RankedSet, Ranking, RankingRules, Target, rank_measures};

use crate::common::{Data, answers, data};

const RULES: RankingRules = RankingRules { terms: 3, folds: 10, transition: 1.3 };

fn cases(data: &Data, target: Target) -> Cases {
    match target {
        Target::Demand => data.safe(),
        Target::Overturning => data.overturning(),
    }
}

fn find<'a>(ranking: &'a Ranking, measures: &str, form: Form) -> &'a RankedSet {
    ranking.sets.iter().find(|set| set.measures == measures && set.form == form).unwrap()
}

fn near(value: Option<f64>, expected: f64, tolerance: f64) {
    assert!((value.unwrap() - expected).abs() <= tolerance, "{value:?}, expected {expected}");
}

#[test]
fn every_figure_equals_that_of_statsmodels_and_scipy() {
    let (data, expected) = (data(), answers("ranking_answers.csv"));
    for target in [Target::Demand, Target::Overturning] {
        let ranking = rank_measures(&cases(&data, target), target, &RULES);
        for (form, word) in [(Form::Single, "single"), (Form::Biplanar, "broken")] {
            for (measures, name) in [("im4", "im4"), ("im3:im4", "im4:im3")] {
                let Some(of) = expected.get(&format!("{target}_{name}_{word}_llf")) else {
                    continue;
                };
                let set = find(&ranking, measures, form);
                near(set.log_likelihood, *of, 1e-7);
                near(set.aic, expected[&format!("{target}_{name}_{word}_aic")], 1e-7);
                near(set.log_score, expected[&format!("{target}_{name}_{word}_log_score")], 1e-7);
                assert_eq!((set.status, set.n), (FitStatus::Ok, 400));
            }
        }
    }
}

#[test]
fn losses_are_to_the_best_and_have_the_clustered_errors_of_statsmodels() {
    let (data, expected) = (data(), answers("ranking_answers.csv"));
    let ranking = rank_measures(&cases(&data, Target::Overturning), Target::Overturning, &RULES);
    let loss = find(&ranking, "im4", Form::Single);
    near(loss.loss, -expected["p_ro_im4:im3_single_over"], 1e-7);
    near(loss.loss_error, expected["p_ro_im4:im3_single_se"], 1e-7);
    let scores: Vec<f64> = ranking.sets.iter().map_while(|set| set.log_score).collect();
    assert!(scores.is_sorted_by(|a, b| a + 1e-9 >= *b) && scores.len() > 5);
    let ranks: Vec<i64> = ranking.sets.iter().map(|set| set.rank).collect();
    assert!(ranks[0] == 1 && ranks.windows(2).all(|pair| [0, 1].contains(&(pair[1] - pair[0]))), "{ranks:?}");
    // IM4 = IM3 IM5: any two of them are one model.
    let rank = |measures: &str| find(&ranking, measures, Form::Single).rank;
    assert!(rank("im3:im4") == rank("im3:im5") && rank("im3:im4") == rank("im4:im5"), "{ranks:?}");
    assert_ne!(rank("im4"), rank("im5"));
    for set in &ranking.sets[..scores.len()] {
        near(set.loss, set.log_score.unwrap() - scores[0], 1e-12);
    }
    // IM4 = IM3 IM5: any two of them are one model, all three are degenerate.
    near(find(&ranking, "im3:im5", Form::Single).log_score, scores[0], 1e-10);
    assert_eq!(find(&ranking, "im3:im4:im5", Form::Single).status, FitStatus::Degenerate);
}

#[test]
fn what_drives_the_cases_wins_and_noise_adds_nothing() {
    let data = data();
    let noise = |k: usize| (((k as f64 * 19.19).sin() * 43_758.545_3).fract().abs() + 0.1).exp();
    for target in [Target::Demand, Target::Overturning] {
        let mut cases = cases(&data, target);
        cases.candidates = vec![
            ("noise".to_string(), (0..cases.all.len()).map(|k| Some(noise(k))).collect()),
            ("holey".to_string(), (0..cases.all.len()).map(|k| (k != 5).then(|| noise(k))).collect()),
        ];
        let ranking = rank_measures(&cases, target, &RULES);
        assert_eq!(
            ranking.incomplete[3..],
            [("holey".to_string(), 1)],
            "im1, im2, im6 and holey do not compete"
        );
        let score = |measures: &str| find(&ranking, measures, Form::Single).log_score.unwrap();
        assert!(score("im3:im4") > score("im4") + 0.01 && score("im4") > score("noise") + 0.1);
        assert!(score("im3:im4:noise") < score("im3:im4"));
    }
}

#[test]
fn one_cluster_leaves_the_criteria_alone() {
    let mut cases = data().overturning();
    cases.all.iter_mut().for_each(|case| case.cluster = 0);
    let sets = rank_measures(&cases, Target::Overturning, &RULES).sets;
    assert!(sets.iter().all(|set| set.log_score.is_none() && set.loss.is_none()));
    let aics: Vec<f64> = sets.iter().filter_map(|set| set.aic).collect();
    assert!(aics.len() > 5 && aics.is_sorted_by(|a, b| a <= &(b + 1e-8)));
}
