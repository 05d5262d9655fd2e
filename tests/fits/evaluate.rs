//! Probabilities and their limits at an intensity, and along a slice.

use crate::paper_model::{BETA, LAMBDA, MU, equipment, model};
use proptest::prelude::*;
use rockfrag::fragility::{
    DemandLaw, Fragility, Measure, Peak, Predictor, Probability, ProbitIndex, ReplicateLimits,
    ResampledModel, Sample, Slice, p_exceeding, p_failure_given_rocking, p_overturning,
};
use rockfrag::keyword::Keyword;
use rockfrag::motion::IntensityMeasures;
use rockfrag::normal;
use rockfrag::statistics::{Link, least_squares};

fn at(pga_m_s2: f64, pgv_m_s: f64) -> IntensityMeasures {
    IntensityMeasures::new(&equipment(), pga_m_s2, pgv_m_s, None, None)
}

#[test]
fn probabilities_are_those_of_the_papers_equations() {
    for (pga, pgv) in [(2.1, 0.2), (2.4, 0.3), (2.7, 0.3), (5.0, 0.6), (9.0, 1.1)] {
        let measures = at(pga, pgv);
        let (im4, ratio) = (measures.im4, 1.0 / measures.im3.unwrap());
        let ln_demand = if im4 < 1.3 {
            -11.39 + 30.39 * im4.ln() - 0.072 * (1.0 / ratio).ln()
        } else {
            -2.765 + 2.954 * im4.ln() - 0.942 * (1.0 / ratio).ln()
        };
        let hybrid = (im4.powf(LAMBDA) * ratio).powf(1.0 / (1.0 + LAMBDA));
        let (p_ex, p_ro) = (p_exceeding(ln_demand, 0.1, 1.0), p_overturning(hybrid, MU, BETA, Link::Probit));
        let given = model().probabilities(&measures).given_rocking.unwrap();
        assert!((given.p_ex.value - p_ex).abs() < 1e-13);
        assert!((given.p_ro.value - p_ro).abs() < 1e-13);
        assert!((given.p_failure.value - p_failure_given_rocking(p_ro, p_ex)).abs() < 1e-13);
        assert!((model().overturning.hybrid_measure(&measures).unwrap() - hybrid).abs() < 1e-13);
    }
}

#[test]
fn below_uplift_all_is_exactly_zero() {
    let uplift = equipment().uplift_acceleration_m_s2();
    let below = model().probabilities(&at(uplift * (1.0 - 1e-12), 1.0));
    assert_eq!(below.limit_states(), Some([Probability::exact(0.0); 3]));
    let above = model().probabilities(&at(uplift * (1.0 + 1e-12), 1.0)).limit_states().unwrap();
    assert_eq!(above[0], Probability::exact(1.0));
    assert!(above[1].value > 0.0 && above[2].value > 0.0);
    assert_eq!(model().probabilities(&at(9.0, 0.0)).limit_states(), None);
}

#[test]
fn the_variance_of_a_prediction_is_that_of_the_textbook() {
    let x: Vec<f64> = (0..12).map(|k| 0.1 * f64::from(k)).collect();
    let y: Vec<f64> = x.iter().map(|x| 1.0 + 2.0 * x + (17.0 * x).sin()).collect();
    let fit = least_squares(&[&x], &y).unwrap();
    let covariance = |i: usize, j: usize| if i < 2 && j < 2 { fit.covariance[(i, j)] } else { 0.0 };
    let predictor = Predictor {
        im_x: Measure::Im4,
        im_y: None,
        coefficients: [fit.coefficients[0].value, fit.coefficients[1].value, 0.0],
        covariance: std::array::from_fn(|i| std::array::from_fn(|j| covariance(i, j))),
        ranges: [[1.0, x[11].exp()], [0.0; 2]],
        bend: None,
        spread: 0.0,
    };
    let measures = at(1.5 * equipment().uplift_acceleration_m_s2(), 1.0);
    let (n, mean) = (12.0, x.iter().sum::<f64>() / 12.0);
    let spread: f64 = x.iter().map(|x| (x - mean).powi(2)).sum();
    let variance = fit.residual_sd.powi(2) * (1.0 / n + (1.5f64.ln() - mean).powi(2) / spread);
    assert!((predictor.at(&measures).unwrap().variance / variance - 1.0).abs() < 1e-10);
    let (ranges, largest) = (Sample::of_columns(vec![x.to_vec()], y.to_vec()).ranges(), x[11].exp());
    let [low, high] = ranges[0];
    assert!(
        (1.0 - 1e-13..=1.0).contains(&low) && (1.0..=1.0 + 1e-13).contains(&(high / largest)),
        "{ranges:?}"
    );

    // The error of the index of P_ex by small changes of the median and of the dispersion, whose error is beta / sqrt(2 degrees).
    let law = DemandLaw { ln_median: predictor, beta: fit.residual_sd, degrees: 10.0 };
    let (limit, step, median) = (9.0f64, 1e-6, predictor.at(&measures).unwrap());
    let index = |median: f64, beta: f64| (median - limit.ln()) / beta;
    let slope = |median_by: f64, beta_by: f64| {
        let at = |sign: f64| index(median.value + sign * median_by, law.beta + sign * beta_by);
        (at(1.0) - at(-1.0)) / (2.0 * step)
    };
    let error = (slope(step, 0.0) * variance.sqrt()).hypot(slope(0.0, step) * law.beta / 20.0f64.sqrt());
    let found = law.exceeding(&measures, limit).unwrap();
    assert!((found.value - index(median.value, law.beta)).abs() < 1e-12);
    assert!((found.standard_error / error - 1.0).abs() < 1e-8, "{} for {error}", found.standard_error);
}

#[test]
fn what_lies_outside_of_the_data_is_named() {
    let names = |measures| model().out_of_range(&measures).map(|out| out.measure).collect::<Vec<_>>();
    assert_eq!(names(at(5.0, 0.6)), []);
    assert_eq!(names(at(2.0, 0.2)), [], "just above uplift there are data");
    assert_eq!(names(at(40.0, 4.0)), [Measure::Im4, Measure::Im4]);
    assert_eq!(names(at(5.0, 5.0)), [Measure::Im3, Measure::Im3Inverse]);
}

#[test]
fn a_slice_is_lognormal_in_either_peak() {
    for peak in [Peak::Pga, Peak::Pgv] {
        let slice = Slice { structure: equipment(), peak, ratio: 0.4 };
        let curve = slice.overturning(&model().overturning).unwrap();
        for k in 1..20 {
            let intensity = slice.intensity_at_im4(1.0 + 0.3 * f64::from(k));
            let p_ro = model().limit_states(&slice, intensity).unwrap()[2].value;
            assert!(
                (p_overturning(intensity, curve.theta.ln(), curve.beta, Link::Probit) - p_ro).abs() < 1e-12
            );
        }
        assert!((slice.largest_in_data(&model()) / slice.intensity_at_im4(7.4) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn mean_and_standard_deviation_are_those_of_the_lognormal() {
    let slice = Slice { structure: equipment(), peak: Peak::Pga, ratio: 0.4 };
    let curve = slice.overturning(&model().overturning).unwrap();
    // Moments by the midpoint rule over quantiles.
    let n = 200_000;
    let quantile =
        |k| curve.theta * (curve.beta * normal::quantile((f64::from(k) + 0.5) / f64::from(n))).exp();
    let mean = (0..n).map(quantile).sum::<f64>() / f64::from(n);
    let variance = (0..n).map(|k| (quantile(k) - mean).powi(2)).sum::<f64>() / f64::from(n);
    assert!((curve.mean() / mean - 1.0).abs() < 1e-5);
    assert!((curve.standard_deviation() / variance.sqrt() - 1.0).abs() < 1e-3);
}

#[test]
fn limits_by_resamples_are_the_quantiles_of_the_probabilities_themselves() {
    let measures = at(5.0, 0.6);
    // Resamples whose overturning has indices from half below the fit to half above it, in equal steps.
    let replicate = |k: usize| {
        let mut model = model();
        model.overturning.coefficients[0] += (k as f64 - 500.0) / 1000.0;
        Some(model)
    };
    let given = model().probabilities(&measures).given_rocking.unwrap();
    let index = normal::quantile(given.p_ro.value);
    for &limits in ReplicateLimits::ALL {
        let resampled = ResampledModel { replicates: (0..=1000).map(replicate).collect(), limits };
        let with_limits = resampled.with_limits(&given, &measures);
        assert_eq!(with_limits.p_ro.value, given.p_ro.value);
        assert!((with_limits.p_ro.low - normal::cdf(index - 0.475)).abs() < 1e-9, "{limits:?}");
        assert!((with_limits.p_ro.high - normal::cdf(index + 0.475)).abs() < 1e-9, "{limits:?}");
        let [low, high] = [-0.475, 0.475]
            .map(|shift| p_failure_given_rocking(normal::cdf(index + shift), given.p_ex.value));
        // The middle resample and the fit may differ by rounding, which moves the bias by half a rank.
        let tolerance = if limits == ReplicateLimits::Percentile { 1e-9 } else { 1e-3 };
        let failure = with_limits.p_failure;
        assert!(
            (failure.low - low).abs() < tolerance && (failure.high - high).abs() < tolerance,
            "{limits:?}"
        );
    }
    let few = ResampledModel { replicates: vec![None, replicate(0)], limits: ReplicateLimits::Percentile };
    assert!(few.with_limits(&given, &measures).p_ro.low.is_nan(), "half of the resamples have no fit");
}

proptest! {
    #[test]
    fn limits_of_failure_enclose_it_and_those_of_both(
        (ro, ro_se) in (-45.0..45.0f64, 0.0..40.0f64), (ex, ex_se) in (-45.0..45.0f64, 0.0..40.0f64),
    ) {
        let of = |value, standard_error| ProbitIndex { value, standard_error }.probability();
        let (ro, ex) = (of(ro, ro_se), of(ex, ex_se));
        let p = Probability::of_failure(ro, ex);
        prop_assert!(0.0 <= p.low && p.low <= p.value && p.value <= p.high && p.high <= 1.0, "{p:?}");
        prop_assert!((p.value - p_failure_given_rocking(ro.value, ex.value)).abs() < 1e-14);
        let least = |a: f64, b: f64| a.max(b) * (1.0 - 1e-12);
        prop_assert!(p.low >= least(ro.low, ex.low) && p.high >= least(ro.high, ex.high), "{p:?} {ro:?} {ex:?}");
    }

    #[test]
    fn narrow_limits_of_failure_are_those_of_the_delta_method(ro in -5.0..2.0f64, ex in -5.0..2.0f64) {
        let (ro_se, ex_se, step) = (3e-4, 2e-4, 1e-6);
        let of = |value, standard_error| ProbitIndex { value, standard_error }.probability();
        let at = |ro: f64, ex: f64| p_failure_given_rocking(normal::cdf(ro), normal::cdf(ex));
        let by_ro = (at(ro + step, ex) - at(ro - step, ex)) / (2.0 * step);
        let by_ex = (at(ro, ex + step) - at(ro, ex - step)) / (2.0 * step);
        let p = Probability::of_failure(of(ro, ro_se), of(ex, ex_se));
        let expected = 2.0 * 1.959964 * (ro_se * by_ro).hypot(ex_se * by_ex);
        prop_assert!(((p.high - p.low) / expected - 1.0).abs() < 1e-2, "{p:?} {expected}");
    }
}
