//! How often 95 % limits hold the truth, over data sets simulated from known curves.
//!
//!     cargo test --release --test coverage -- --ignored --nocapture
//!
//! runs the whole study; the short one runs with all tests. All random numbers have seeds, so that neither can fail by
//! chance.

use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;
use rockfrag::fragility::{
    Case, CurveInference, CurveModel, CurveParameter, CurveRefits, DemandInference, DemandRefits, Measure,
    Sample, fit_overturning,
};
use rockfrag::motion::IntensityMeasures;
use rockfrag::normal::quantile;
use rockfrag::random::{Purpose, stream};
use rockfrag::resampling::{Strata, bootstrap, bootstrap_limits};
use rockfrag::rocking::Outcome;
use rockfrag::statistics::{Estimate, Estimator, FitStatus, Limits, t_quantile};

/// The truth: a lognormal curve, of one measure or of two, and a power law of the demand.
const MU: f64 = 0.3;
const BETA: f64 = 0.4;
const LAMBDA: f64 = 1.5;
const SLOPE: f64 = 2.6;
const SCATTER: f64 = 0.8;

/// A design: cells of different intensity, so many cases in each.
#[derive(Clone, Copy)]
struct Plan {
    name: &'static str,
    cells: usize,
    cases: usize,
    /// Mean of ln IM: the lower, the fewer events.
    level: f64,
    measures: &'static [Measure],
    estimator: Estimator,
}

/// Which parameter, by which kind of limits, and whether they hold the truth; none without limits.
type Verdict = (&'static str, &'static str, Option<bool>);

fn holds(truth: f64, limits: Limits) -> Option<bool> {
    (!limits.low.is_nan() && !limits.high.is_nan()).then_some(limits.low <= truth && truth <= limits.high)
}

fn wald(value: f64, error: f64) -> Limits {
    Estimate::symmetric(value, error, quantile(0.975)).limits()
}

/// As Cameron & Miller (2015) advise: by Student's t with one degree of freedom fewer than clusters.
fn sandwich(value: f64, error: f64, plan: &Plan) -> Limits {
    Estimate::symmetric(value, error, t_quantile(0.975, (plan.cells - 1) as f64)).limits()
}

fn normal(random: &mut ChaCha8Rng) -> f64 {
    StandardNormal.sample(random)
}

/// Cases whose outcome and demand follow the truth.
fn cases(plan: &Plan, seed: u64) -> (Vec<Case>, Vec<usize>) {
    let mut random = stream(seed, Purpose::Sample, 0);
    let cell_of = |k: usize| k % plan.cells;
    let mut case = |k: usize| {
        let cell = cell_of(k) as f64 / plan.cells as f64 - 0.5;
        let x = plan.level + cell + 0.4 * normal(&mut random);
        let y = if plan.measures.len() == 2 { 0.3 * normal(&mut random) } else { 0.0 };
        let ln_im = if plan.measures.len() == 2 { (LAMBDA * x + y) / (1.0 + LAMBDA) } else { x };
        let overturns = ln_im - MU + BETA * normal(&mut random) > 0.0;
        let ln_edp = -2.0 + SLOPE * x + SCATTER * normal(&mut random);
        let measures =
            IntensityMeasures { im1: None, im2: None, im3: Some(y.exp()), im4: x.exp(), im5: 1.0, im6: None };
        let outcome = if overturns { Outcome::Overturning } else { Outcome::SafeRocking };
        Case { outcome, edp: ln_edp.exp(), measures }
    };
    let n = plan.cells * plan.cases;
    ((0..n).map(&mut case).collect(), (0..n).map(cell_of).collect())
}

/// The limits of the parameters of a curve, and of some of its probabilities.
fn curve(plan: &Plan, seed: u64, replicates: usize) -> Result<Vec<Verdict>, FitStatus> {
    let (cases, cells) = cases(plan, seed);
    let event = |case: &Case| Some(case.outcome == Outcome::Overturning);
    let sample = Sample::of_events(&cases, plan.measures, event);
    let fit = fit_overturning(&sample, &CurveModel { estimator: plan.estimator, ..CurveModel::default() })?;
    let inference = CurveInference::new(&sample, &fit.regression);
    let (strata, clustered) = (Strata::new(&cells), inference.clustered_covariance(&cells));
    let refits = CurveRefits::new(&sample, &fit.regression);
    let refits = bootstrap(&strata, replicates, seed, |resamples| refits.coefficients(resamples));
    let mut verdicts = Vec::new();
    for &parameter in inference.curve_parameters() {
        let (name, truth) = match parameter {
            CurveParameter::Lambda => ("lambda", LAMBDA),
            CurveParameter::Mu => ("mu", MU),
            CurveParameter::Beta => ("beta", BETA),
        };
        let value = inference.fitted(parameter);
        let model = inference.standard_error(parameter, &fit.regression.covariance);
        let robust = inference.standard_error(parameter, &clustered);
        let limits = bootstrap_limits(
            value,
            &inference.parameters(parameter, &refits),
            inference.acceleration(parameter, &strata),
            0.95,
        );
        verdicts.extend([
            (name, "wald", holds(truth, wald(value, model))),
            (name, "sandwich", holds(truth, sandwich(value, robust, plan))),
            (name, "profile", holds(truth, inference.profile_limits(parameter, 0.95))),
            (name, "percentile", limits.and_then(|limits| holds(truth, limits.percentile))),
            (name, "bca", limits.and_then(|limits| holds(truth, limits.bca?))),
        ]);
    }
    for (name, index) in [("p 0.02", -2.0), ("p 0.16", -1.0), ("p 0.5", 0.0)] {
        let row = row_at(plan, index);
        let at_row = |b: &[f64]| row.iter().zip(b).map(|(x, b)| x * b).sum::<f64>();
        let value = at_row(fit.regression.coefficients.as_slice());
        let products = fit.regression.covariance.column_iter().map(|column| at_row(column.as_slice()));
        let variance = at_row(&products.collect::<Vec<f64>>());
        let of_refits: Vec<Option<f64>> =
            refits.iter().map(|b| b.as_ref().map(|b| at_row(b.as_slice()))).collect();
        let limits = bootstrap_limits(value, &of_refits, 0.0, 0.95);
        verdicts.extend([
            (name, "delta", holds(index, wald(value, variance.sqrt()))),
            (name, "percentile", limits.and_then(|limits| holds(index, limits.percentile))),
            (name, "bc", limits.and_then(|limits| holds(index, limits.bca?))),
        ]);
    }
    Ok(verdicts)
}

/// The row of the design at which the true curve has this index.
fn row_at(plan: &Plan, index: f64) -> Vec<f64> {
    let ln_im = MU + BETA * index;
    if plan.measures.len() == 2 { vec![1.0, ln_im * (1.0 + LAMBDA) / LAMBDA, 0.0] } else { vec![1.0, ln_im] }
}

/// The limits of the slope and the dispersion of a regression of the demand.
fn demand(plan: &Plan, seed: u64, replicates: usize) -> Result<Vec<Verdict>, FitStatus> {
    let (mut cases, cells) = cases(plan, seed);
    cases.iter_mut().for_each(|case| case.outcome = Outcome::SafeRocking);
    let sample = Sample::of_demands(&cases, plan.measures, 0.0..f64::INFINITY);
    let fit = sample.fit()?;
    let inference = DemandInference::new(&sample, &fit);
    let strata = Strata::new(&cells);
    let refits = DemandRefits::new(&sample);
    let refits = bootstrap(&strata, replicates, seed, |resamples| refits.replicates(resamples));
    let accelerations = inference.accelerations(&strata);
    let limits = |k: usize| {
        let values: Vec<Option<f64>> = refits.iter().map(|fit| fit.as_ref()?.parameters().nth(k)).collect();
        bootstrap_limits(inference.fitted().parameters().nth(k)?, &values, accelerations[k], 0.95)
    };
    let slope = fit.coefficients[1];
    let mut verdicts = vec![
        ("b1", "wald", holds(SLOPE, slope.limits())),
        ("b1", "sandwich", holds(SLOPE, sandwich(slope.value, inference.clustered_errors(&cells)[1], plan))),
    ];
    for (name, truth, k) in [("b1", SLOPE, 1), ("beta", SCATTER, fit.coefficients.len())] {
        verdicts.push((name, "percentile", limits(k).and_then(|limits| holds(truth, limits.percentile))));
        verdicts.push((name, "bca", limits(k).and_then(|limits| holds(truth, limits.bca?))));
    }
    Ok(verdicts)
}

/// The share of data sets whose limits hold the truth.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Coverage {
    parameter: &'static str,
    limits: &'static str,
    share: f64,
    sets: usize,
}

type Study = fn(&Plan, u64, usize) -> Result<Vec<Verdict>, FitStatus>;

fn coverage(plan: &Plan, study: Study, sets: u64, replicates: usize) -> Vec<Coverage> {
    let verdicts: Vec<Vec<Verdict>> =
        (1..=sets).into_par_iter().filter_map(|seed| study(plan, seed, replicates).ok()).collect();
    let kinds: Vec<(&str, &str)> = verdicts[0].iter().map(|(name, kind, _)| (*name, *kind)).collect();
    let of = |(k, (parameter, limits)): (usize, (&'static str, &'static str))| {
        let known: Vec<bool> = verdicts.iter().filter_map(|verdicts| verdicts[k].2).collect();
        let share = known.iter().filter(|holds| **holds).count() as f64 / known.len() as f64;
        Coverage { parameter, limits, share, sets: known.len() }
    };
    kinds.into_iter().enumerate().map(of).collect()
}

const SCALAR: &[Measure] = &[Measure::Im4];
const PAIR: &[Measure] = &[Measure::Im4, Measure::Im3];

#[test]
fn limits_hold_the_truth_as_often_as_they_say() {
    let plan =
        Plan { name: "short", cells: 10, cases: 30, level: 0.0, measures: PAIR, estimator: Estimator::Ml };
    let (sets, replicates) = (120, 150);
    for Coverage { parameter, limits, share, sets } in
        coverage(&plan, curve, sets, replicates).into_iter().chain(coverage(&plan, demand, sets, replicates))
    {
        // 88 % are three and a half standard errors of 120 sets below 95 %.
        assert!(share >= 0.88, "{limits} limits of {parameter} hold the truth in {share} of {sets} sets");
    }
}

#[test]
#[ignore = "the whole study takes minutes"]
fn the_whole_study() {
    let large = Plan {
        name: "700 cases",
        cells: 14,
        cases: 50,
        level: 0.0,
        measures: SCALAR,
        estimator: Estimator::Ml,
    };
    let few = Plan { name: "140 cases, few events", cells: 7, cases: 20, level: -0.65, ..large };
    let firth = Plan { name: "140 cases, few events, Firth", estimator: Estimator::Firth, ..few };
    let pair = Plan { name: "700 cases, hybrid", measures: PAIR, ..large };
    let plane = Plan { name: "700 cases, plane", measures: PAIR, ..large };
    let small = Plan { name: "60 cases, plane", cells: 3, cases: 20, measures: PAIR, ..large };
    println!("{:30} {:10} {:12} {:>8} {:>6}", "design", "parameter", "limits", "coverage", "sets");
    let studies: [(Plan, Study); 6] =
        [(large, curve), (pair, curve), (few, curve), (firth, curve), (plane, demand), (small, demand)];
    for (plan, study) in studies {
        for Coverage { parameter, limits, share, sets } in coverage(&plan, study, 500, 1000) {
            println!("{:30} {parameter:10} {limits:12} {:>7.1}% {sets:>6}", plan.name, 100.0 * share);
        }
    }
}
