//! Fits of more cases than are held at once: those of a few cases again and again, of which the answers are known from the few.

use rockfrag::fragility::demand::RegressionOptions;
use rockfrag::fragility::overturning::{CurveOptions, Pair};
use rockfrag::fragility::{Case, CaseTable, CurveModel, Event, Measure, Uncertainty, unwatched};
use rockfrag::motion::IntensityMeasures;
use rockfrag::normal;
use rockfrag::rocking::Outcome;

/// Enough that some columns lie in a file.
const COPIES: usize = 300;
const CASES: usize = 3000;

/// A number from 0 to 1 that looks like chance.
fn chance(seed: usize) -> f64 {
    let bits = (seed as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let bits = (bits ^ (bits >> 31)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}

fn case(k: usize) -> Case {
    let of = |what: usize| chance(3 * k + what + 1000 * what);
    let (im4, im3) = (1.0 + 2.5 * of(0), (1.5 * of(1)).exp());
    let im5 = im4 / im3;
    let normal = |what: usize| normal::quantile(0.0001 + 0.9998 * of(what));
    let share = 1.0 - (-im4.ln() / 0.2).exp();
    let on = |plane: [f64; 2]| plane[0] + plane[1] * im4.ln();
    let demand = (1.0 - share) * on([-6.0, 10.0]) + share * on([-1.5, 2.6]);
    let ln_edp = demand - 0.5 * im3.ln() + 0.2 * normal(2);
    let overturns = 1.7 * im5.ln() + 0.6 * im4.ln() - 0.4 + 0.8 * normal(3) > 0.0;
    let outcome = if overturns { Outcome::Overturning } else { Outcome::SafeRocking };
    let measures = IntensityMeasures {
        im1: Some(im3.sqrt()),
        im2: None,
        im3: Some(im3),
        im4,
        im5,
        im6: Some(im5 * im3.sqrt()),
    };
    Case { outcome, edp: if overturns { f64::INFINITY } else { ln_edp.exp() }, measures }
}

fn table(copies: usize) -> CaseTable {
    let cases: Vec<Case> = (0..copies * CASES).map(|k| case(k % CASES)).collect();
    let clusters: Vec<usize> = (0..cases.len()).map(|k| k % CASES % 40).collect();
    CaseTable::of(&cases, &clusters, &clusters)
}

fn near(many: f64, few: f64, tolerance: f64, what: &str) {
    let same = many == few || (many.is_nan() && few.is_nan());
    assert!(same || (many - few).abs() <= tolerance * (1.0 + few.abs()), "{what}: {many}, expected {few}");
}

#[test]
fn regressions_of_many_cases_are_those_of_few() {
    let uncertainty = Uncertainty { replicates: 0, confidence: 0.95, seed: 1 };
    let options = RegressionOptions { transition: None, limit: 0.5, uncertainty };
    let (many, few) = (table(COPIES), table(1));
    let Ok(fits) = options.fit(&[&many, &few], &unwatched);
    let m = COPIES as f64;
    for (many, few) in fits[0].scan.iter().zip(&fits[1].scan) {
        near(many.pooled_rss, m * few.pooled_rss, 1e-10, "scan");
        assert_eq!((many.n_low, many.n_high), (COPIES * few.n_low, COPIES * few.n_high));
    }
    assert_eq!(fits[0].fits.len(), fits[1].fits.len());
    assert!(fits[1].fits.last().is_some_and(|fit| fit.transition_width.is_some()), "no smooth transition");
    for (many, few) in fits[0].fits.iter().zip(&fits[1].fits) {
        let what = format!("{:?} {:?}", few.form, few.im_x);
        let (Ok(of_many), Ok(of_few)) = (&many.fit, &few.fit) else {
            assert_eq!(many.fit, few.fit, "{what}");
            continue;
        };
        // The width of a smooth transition is where rounding leaves a search, to the root of that of the residuals.
        let tolerance = if few.transition_width.is_some() { 1e-6 } else { 1e-10 };
        assert_eq!(of_many.coefficients.len(), of_few.coefficients.len(), "{what}");
        near(of_many.rss, m * of_few.rss, 1e-10, &what);
        near(of_many.r2, of_few.r2, 1e-10, &what);
        for k in 0..of_few.coefficients.len() {
            near(of_many.coefficients[k].value, of_few.coefficients[k].value, tolerance, &what);
        }
        for (many, few) in many.clustered_errors.iter().zip(&few.clustered_errors) {
            // But for (n - 1) / (n - k).
            near(*many, *few, 2e-3, &what);
        }
        assert_eq!(many.data_ranges, few.data_ranges, "{what}");
        for (many, few) in many.held_out.iter().zip(&few.held_out) {
            // But for the degrees of freedom of the dispersion.
            near(many.log_score, few.log_score, 2e-3, &what);
        }
        assert_eq!(many.held_out.is_some(), few.held_out.is_some(), "{what}");
    }
}

#[test]
fn curves_of_many_cases_are_those_of_few() {
    let options = |confidence: f64| CurveOptions {
        event: Event::Overturning,
        pairs: vec![Pair(Measure::Im4, Measure::Im3Inverse)],
        model: CurveModel { confidence, ..CurveModel::default() },
        uncertainty: Uncertainty { replicates: 0, confidence, seed: 1 },
    };
    // Where the likelihood of one copy falls as far as that of all does at 95 %.
    let depth = normal::quantile(0.975) / (COPIES as f64).sqrt();
    let Ok(many) = options(0.95).fit(&[&table(COPIES)], &unwatched);
    let Ok(few) = options(2.0 * normal::cdf(depth) - 1.0).fit(&[&table(1)], &unwatched);
    let m = COPIES as f64;
    for (many, few) in many[0].iter().zip(&few[0]) {
        let what = format!("{:?} {:?}", few.im_x, few.im_y);
        assert_eq!((many.n, many.events), (COPIES * few.n, COPIES * few.events), "{what}");
        let (Ok(of_many), Ok(of_few)) = (&many.fit, &few.fit) else {
            assert_eq!(many.fit, few.fit, "{what}");
            continue;
        };
        for k in 0..of_few.regression.coefficients.len() {
            near(of_many.regression.coefficients[k], of_few.regression.coefficients[k], 1e-10, &what);
        }
        near(of_many.regression.log_likelihood, m * of_few.regression.log_likelihood, 1e-10, &what);
        // Of many, only some are left out.
        near(many.held_out.unwrap().log_score, few.held_out.unwrap().log_score, 1e-3, &what);
        assert!(many.clustered_covariance.is_some(), "{what}");
        let (of_many, of_few) = (&of_many.goodness, &of_few.goodness);
        near(of_many.auc, of_few.auc, 1e-12, &what);
        near(of_many.brier, of_few.brier, 1e-12, &what);
        assert_eq!(of_many.index_range.map(f32_of), of_few.index_range.map(f32_of), "{what}");
        let [many_test, few_test] = [of_many, of_few].map(|of| of.hosmer_lemeshow.unwrap().statistic);
        near(many_test, m * few_test, 1e-8, &what);
        for (many, few) in many.inference.iter().zip(&few.inference) {
            near(many.profile.low, few.profile.low, 1e-9, &what);
            near(many.profile.high, few.profile.high, 1e-9, &what);
            near(many.clustered_error, few.clustered_error, 2e-3, &what);
        }
        let tests = [(many.spline, few.spline), (many.interaction, few.interaction)];
        for (many, few) in tests.into_iter().filter_map(|(many, few)| many.zip(few)) {
            near(many.statistic, m * few.statistic, 2e-3, &what);
        }
    }
}

fn f32_of(value: f64) -> f32 {
    value as f32
}

#[test]
fn some_of_many_cases_are_spread_over_all_clusters() {
    let some = table(COPIES).spread(40_000);
    assert!((20_000..=40_000).contains(&some.len()), "{} cases", some.len());
    assert!(some.is_sorted_by(|a, b| a.row < b.row));
    let mut of_cluster = [0.0; 40];
    some.iter().for_each(|case| of_cluster[case.cluster] += 40.0 / some.len() as f64);
    assert!(of_cluster.iter().all(|share| (share - 1.0).abs() < 0.02), "{of_cluster:?}");
    assert_eq!(table(1).spread(40_000).len(), CASES);
}
