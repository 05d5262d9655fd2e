//! The ranking of measures against statsmodels and scipy (scripts/reference/ranking.py), and what it must not depend on.

use rockfrag::fragility::{Case, Measure, fit_biplanar};
use rockfrag::keyword::Keyword;
use rockfrag::rocking::Outcome;
use rockfrag::statistics::{FitStatus, is_separated};
use rockfrag::studies::{
    Candidate, Folds, Form, FurtherMeasure, MeasureRanking, OfPaper, Ranked, RankingRules, RankingSample,
    Rating, Target,
};

use crate::data::{Data, data, ranking_answers};

const RULES: RankingRules = RankingRules { folds: 10, terms: 3, transition: Some(1.3) };

fn cases(data: &Data, target: Target) -> Vec<Case> {
    data.cases(|k| match target {
        Target::Overturning if data.event[k] => Outcome::Overturning,
        _ => Outcome::SafeRocking,
    })
}

fn ranking(data: &Data, target: Target, further: &[FurtherMeasure]) -> Vec<Ranked> {
    rank(RankingSample::new(target, &cases(data, target), &data.cells, further, 0.1))
}

fn rank(sample: RankingSample) -> Vec<Ranked> {
    let contest = MeasureRanking::new(sample, &RULES);
    contest.rank(contest.candidates.iter().map(|candidate| contest.rate(candidate)).collect())
}

fn further(name: &str, ln: impl Fn(usize) -> f64, data: &Data) -> FurtherMeasure {
    FurtherMeasure { name: name.to_string(), ln: (0..data.x.len()).map(|k| Some(ln(k))).collect() }
}

fn find<'a>(ranking: &'a [Ranked], measures: &[&str], form: Form) -> &'a Ranked {
    ranking.iter().find(|ranked| ranked.measures == measures && ranked.form == form).unwrap()
}

/// Numbers that look random in [0, 1).
fn noise(k: usize, stream: usize) -> f64 {
    let x = (k as f64 * 12.9898 + stream as f64 * 78.233).sin() * 43_758.545_3;
    x - x.floor()
}

#[test]
fn every_figure_equals_that_of_statsmodels_and_scipy() {
    let (data, answers) = (data(), ranking_answers());
    for (target, second) in [(Target::Demand, "im3"), (Target::Overturning, "im3_inv")] {
        let ranking = ranking(&data, target, &[]);
        for &form in Form::ALL.iter().filter(|&&form| target == Target::Demand || form == Form::Single) {
            for (name, measures) in [("im4", &["im4"][..]), ("im4:im3", &["im4", second][..])] {
                let rating = find(&ranking, measures, form).rating.as_ref().unwrap();
                let unseen = rating.held_out.as_ref().unwrap();
                let [intercept, slope] = unseen.calibration.unwrap();
                let groups = &unseen.reliability;
                assert_eq!(groups.iter().map(|group| group.n).sum::<usize>(), unseen.log_scores.len());
                assert!(groups.windows(2).all(|pair| pair[0].forecast < pair[1].forecast), "{groups:?}");
                assert!(
                    groups.iter().all(|group| 0.0 < group.forecast && group.forecast < 1.0),
                    "{groups:?}"
                );
                for (figure, value) in [
                    ("llf", rating.log_likelihood),
                    ("aic", rating.aic),
                    ("bic", rating.bic),
                    ("fitted_auc", rating.fitted.auc),
                    ("fitted_brier", rating.fitted.brier),
                    ("log_score", unseen.log_score()),
                    ("unseen_auc", unseen.skill.auc),
                    ("unseen_brier", unseen.skill.brier),
                    ("intercept", intercept),
                    ("slope", slope),
                ] {
                    let key = format!("{}_{name}_{}_{figure}", target.as_str(), form.as_str());
                    answers.check_absolute(&key, value, 1e-7);
                }
            }
        }
    }
}

#[test]
fn gains_have_the_clustered_errors_of_statsmodels() {
    let (data, answers) = (data(), ranking_answers());
    let demand = ranking(&data, Target::Demand, &[]);
    let gain = find(&demand, &["im4"], Form::Broken).over_paper.unwrap();
    answers.check_absolute("p_ex_im4_broken_over", gain.value, 1e-9);
    answers.check_absolute("p_ex_im4_broken_se", gain.standard_error, 1e-9);
    let overturning = ranking(&data, Target::Overturning, &[]);
    let loss = find(&overturning, &["im4"], Form::Single).over_paper.unwrap();
    answers.check_absolute("p_ro_im4:im3_single_over", -loss.value, 1e-7);
    answers.check_absolute("p_ro_im4:im3_single_se", loss.standard_error, 1e-7);
}

#[test]
fn the_best_of_as_many_measures_is_what_others_are_held_against() {
    let mut ranking = ranking(&data(), Target::Demand, &[]);
    ranking.retain(|ranked| ranked.rank.is_some());
    assert!(ranking.len() > 5);
    let of_im4 = find(&ranking, &["im4"], Form::Single).rating.as_ref().unwrap();
    let residual_sd = data().demand_sample("x").fit().unwrap().residual_sd;
    assert!((of_im4.beta / residual_sd - 1.0).abs() < 1e-9, "{} for {residual_sd}", of_im4.beta);
    let score = |of: &Ranked| of.rating.as_ref().unwrap().held_out.as_ref().unwrap().log_score();
    for ranked in &ranking {
        let rivals = ranking.iter().filter(|other| other.measures.len() == ranked.measures.len());
        let best = rivals.map(score).fold(f64::NEG_INFINITY, f64::max);
        let gain = ranked.over_best.unwrap().value;
        assert!((gain - (score(ranked) - best)).abs() < 1e-9, "{ranked:?}");
        assert_eq!(gain == 0.0, ranked.rank == Some(1), "{ranked:?}");
    }
}

#[test]
fn whole_clusters_are_left_out_once() {
    for (clusters, most) in [(35, 10), (35, 100), (3, 10)] {
        let of: Vec<usize> = (0..clusters * 4).map(|case| 7 * (case % clusters)).collect();
        let folds = Folds::new(&of, most).unwrap();
        assert_eq!(folds.count, clusters.min(most));
        for case in 0..of.len() {
            assert_eq!(folds.of[case], folds.of[case % clusters], "one cluster, one fold");
        }
        let kept: f64 = (0..folds.count).flat_map(|fold| folds.without(fold)).sum();
        assert_eq!(kept, (of.len() * (folds.count - 1)) as f64, "each case is left out of one fit");
        let sizes: Vec<usize> =
            (0..folds.count).map(|fold| folds.of.iter().filter(|&&of| of == fold).count()).collect();
        assert!(sizes.iter().max().unwrap() - sizes.iter().min().unwrap() <= 4, "{sizes:?}");
    }
    assert_eq!(Folds::new(&[5, 5, 5], 10), None);
    assert_eq!(Folds::new(&[], 10), None);
}

#[test]
fn no_case_is_foretold_with_the_help_of_its_own_cluster() {
    let mut data = data();
    let before = ranking(&data, Target::Overturning, &[]);
    // Other outcomes in the cells of the first fold change all forecasts but their own.
    let first_fold = |k: usize| data.cells[k].is_multiple_of(10);
    let changed: Vec<bool> =
        (0..data.x.len()).map(|k| data.event[k] != (first_fold(k) && k.is_multiple_of(2))).collect();
    data.event = changed;
    let after = ranking(&data, Target::Overturning, &[]);
    let probability = |ranking: &[Ranked], k: usize, happened: bool| {
        let rating = find(ranking, &["im4"], Form::Single).rating.as_ref().unwrap();
        let p = rating.held_out.as_ref().unwrap().log_scores[k].exp();
        if happened { p } else { 1.0 - p }
    };
    let original = crate::data::data();
    for k in 0..data.x.len() {
        let (p, q) = (probability(&before, k, original.event[k]), probability(&after, k, data.event[k]));
        assert_eq!((p - q).abs() < 1e-9, data.cells[k].is_multiple_of(10), "{k}: {p}, {q}");
    }
}

#[test]
fn a_break_is_found_without_the_cases_that_it_foretells() {
    let data = data();
    let two_planes = |transition: Option<f64>| -> Rating {
        let cases = cases(&data, Target::Demand);
        let sample = RankingSample::new(Target::Demand, &cases, &data.cells, &[], 0.1);
        let mut pair = [Measure::Im4, Measure::Im3].map(|measure| sample.place(measure).unwrap());
        pair.sort_unstable();
        let contest = MeasureRanking::new(sample, &RankingRules { transition, ..RULES });
        let planes = |candidate: &&Candidate| candidate.form == Form::Broken && candidate.measures == pair;
        contest.rate(contest.candidates.iter().find(planes).unwrap()).unwrap()
    };
    let folds = Folds::new(&data.cells, RULES.folds).unwrap();
    let break_without = |fold: Option<usize>| {
        let kept = (0..data.x.len()).filter(|&case| Some(folds.of[case]) != fold);
        fit_biplanar(&cases(&data.rows(kept), Target::Demand), None).unwrap().transition
    };
    let log_scores = |rating: &Rating| rating.held_out.as_ref().unwrap().log_scores.clone();
    let (found, of_all) = (two_planes(None), break_without(None));
    let likelihood = two_planes(Some(of_all)).log_likelihood;
    assert!((found.log_likelihood - likelihood).abs() < 1e-9, "{} for {likelihood}", found.log_likelihood);
    let breaks: Vec<f64> = (0..folds.count).map(|fold| break_without(Some(fold))).collect();
    assert!(breaks.iter().any(|&at| at != of_all), "the cases left out have no say: {breaks:?}");
    for (fold, &at) in breaks.iter().enumerate() {
        let (scores, given) = (log_scores(&found), log_scores(&two_planes(Some(at))));
        for case in (0..data.x.len()).filter(|&case| folds.of[case] == fold) {
            assert!(
                (scores[case] - given[case]).abs() < 1e-9,
                "{case}: {} for {}",
                scores[case],
                given[case]
            );
        }
    }
}

#[test]
fn measures_that_are_products_of_one_another_make_one_model() {
    let data = data();
    let product = further("product", |k| 2.0 * data.x[k] - 0.7 * data.y[k] + 0.3, &data);
    for (target, second) in [(Target::Demand, "im3"), (Target::Overturning, "im3_inv")] {
        let ranking = ranking(&data, target, std::slice::from_ref(&product));
        let pair = find(&ranking, &["im4", second], Form::Single);
        for measures in [["im4", "product"], [second, "product"]] {
            let twin = find(&ranking, &measures, Form::Single);
            assert_eq!(twin.same_as.as_deref(), Some(&pair.measures[..]));
            assert_eq!((twin.rank, twin.over_paper), (pair.rank, pair.over_paper));
        }
        let triple = find(&ranking, &["im4", second, "product"], Form::Single);
        assert_eq!(triple.rating, Err(FitStatus::Collinear));
        // im5 is 1 in all cases.
        assert_eq!(find(&ranking, &["im5"], Form::Single).rating, Err(FitStatus::Constant));
    }
}

#[test]
fn what_drives_the_cases_is_chosen_and_noise_is_not() {
    let data = data();
    let noises = [1, 2].map(|stream| further(&format!("noise{stream}"), |k| noise(k, stream), &data));
    for (target, second) in [(Target::Demand, "im3"), (Target::Overturning, "im3_inv")] {
        let ranking = ranking(&data, target, &noises);
        let step = |number| ranking.iter().find(|ranked| ranked.step == Some(number)).unwrap();
        assert!(step(0).measures.is_empty());
        assert_eq!(step(2).measures, ["im4", second]);
        for number in [1, 2] {
            let gain = step(number).over_step.unwrap();
            assert!(gain.value > 2.0 * gain.standard_error, "{target:?} {number}: {gain:?}");
        }
        let noise = step(3).over_step.unwrap();
        assert!(noise.value < 2.0 * noise.standard_error, "{target:?}: {noise:?}");
        let scalar = ranking.iter().find(|ranked| ranked.of_paper == Some(OfPaper::Scalar)).unwrap();
        assert_eq!(scalar.measures, ["im4"]);
    }
}

#[test]
fn the_order_of_the_cases_does_not_matter() {
    let data = data();
    let order: Vec<usize> = (0..data.x.len()).map(|k| k * 7 % data.x.len()).collect();
    let cells: Vec<usize> = order.iter().map(|&k| data.cells[k]).collect();
    for &target in Target::ALL {
        let cases = cases(&data, target);
        let mixed: Vec<Case> = order.iter().map(|&k| cases[k]).collect();
        let mixed = rank(RankingSample::new(target, &mixed, &cells, &[], 0.1));
        for (a, b) in ranking(&data, target, &[]).iter().zip(&mixed) {
            assert_eq!((&a.measures, a.form, a.rank), (&b.measures, b.form, b.rank));
            if let (Some(a), Some(b)) = (a.over_paper, b.over_paper) {
                assert!((a.value - b.value).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn a_measure_that_some_cases_lack_does_not_compete() {
    let data = data();
    let mut holey = further("holey", |k| noise(k, 3), &data);
    holey.ln[5] = None;
    let sample =
        RankingSample::new(Target::Demand, &cases(&data, Target::Demand), &data.cells, &[holey], 0.1);
    assert_eq!(sample.names, ["im4", "im3", "im5"]);
    assert_eq!(sample.incomplete, [("holey".to_string(), 1)]);
}

#[test]
fn one_cluster_leaves_the_criteria_alone() {
    let mut data = data();
    data.cells = vec![0; data.x.len()];
    let ranking = ranking(&data, Target::Overturning, &[]);
    let pair = find(&ranking, &["im4", "im3_inv"], Form::Single);
    let rating = pair.rating.as_ref().unwrap();
    assert!(rating.held_out.is_none() && rating.aic.is_finite());
    assert_eq!((pair.rank, pair.over_paper, pair.step), (None, None, None));
}

#[test]
fn separation_by_three_measures_is_seen() {
    let n = 300;
    let axis = |stream: usize| (0..n).map(|k| noise(k, stream) - 0.5).collect::<Vec<f64>>();
    let (x, y, z) = (axis(1), axis(2), axis(3));
    let score: Vec<f64> = (0..n).map(|k| 0.8 * x[k] - 0.5 * y[k] + 1.3 * z[k]).collect();
    let mut events: Vec<bool> = score.iter().map(|&score| score > 0.1).collect();
    let predictors = [&x[..], &y[..], &z[..]];
    assert!(is_separated(&predictors, &events), "by a plane");
    assert!(!is_separated(&predictors[..2], &events), "not without the third");
    let nearest = (0..n).min_by(|&a, &b| (score[a] - 0.1).abs().total_cmp(&(score[b] - 0.1).abs())).unwrap();
    let inside = (0..n).max_by(|&a, &b| score[a].total_cmp(&score[b])).unwrap();
    events[inside] = false;
    assert!(!is_separated(&predictors, &events), "but for the last case of the events");
    events[inside] = true;
    // Both outcomes at one point of the plane, all others beside it: quasi-complete separation.
    let both = |values: &[f64]| [values, &values[nearest..=nearest]].concat();
    let (x, y, z) = (both(&x), both(&y), both(&z));
    events.push(!events[nearest]);
    assert!(is_separated(&[&x, &y, &z], &events), "up to a point on the plane");
}
