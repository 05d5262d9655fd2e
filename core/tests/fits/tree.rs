//! The event tree (Eq. 12), limits of failure, and the tree as the paper answers it.

use proptest::prelude::*;
use rockfrag_core::fragility::{
    Event, LimitStates, Measure, fit_curve, fit_demand, independent_failure, p_failure,
    p_failure_given_rocking, p_no_rocking, paper_probabilities,
};
use rockfrag_core::motion::{IntensityMeasures, Peaks};
use rockfrag_core::statistics::{Interval, normal};

use crate::common::{close, equipment, rocking};

#[test]
fn without_rocking_all_is_exactly_zero() {
    assert_eq!((p_no_rocking(0.999), p_no_rocking(1.0)), (1.0, 0.0));
    assert!(p_no_rocking(f64::NAN).is_nan(), "an unknown intensity is no statement about rocking");
    let given = p_failure_given_rocking(0.25, 0.5);
    assert_eq!((given, p_failure(1.0, given), p_failure(0.0, given)), (0.625, 0.0, 0.625));
}

#[test]
fn the_paper_answers_by_the_plane_of_the_side_and_the_hybrid_curve() {
    let cases = rocking(2000);
    let planes = fit_demand(&cases, Some(1.3), 0.95, &[], false);
    let curve = fit_curve(&cases, Event::Overturning, Measure::Im4, Some(Measure::Im3Inverse));
    let b = &curve.coefficients;
    for (im4, im3) in [(1.1, 2.0), (1.29, 0.7), (1.31, 0.7), (3.5, 1.1)] {
        let measures = IntensityMeasures::from_peaks(im4, im4 / im3);
        let given = paper_probabilities(&planes, &curve, &measures, 0.1, 0.95).given_rocking.unwrap();
        let plane = &planes[usize::from(im4 >= 1.3)];
        let a = &plane.coefficients;
        let ln_median: f64 = a[0] + a[1] * im4.ln() + a[2] * im3.ln();
        let p_ex = normal::cdf((ln_median - f64::ln(0.1)) / plane.beta.unwrap());
        let p_ro = normal::cdf(b[0] + b[1] * im4.ln() - b[2] * im3.ln());
        close(given.p_ex.unwrap().value, p_ex, 1e-12);
        close(given.p_ro.value, p_ro, 1e-12);
        close(given.p_failure.unwrap().value, p_ro + (1.0 - p_ro) * p_ex, 1e-12);
    }
    let uplift = equipment().uplift_acceleration_m_s2();
    let at = |pga: f64, pgv: f64| {
        let measures =
            IntensityMeasures::new(&equipment(), Peaks { pga_m_s2: pga, pgv_m_s: pgv }, None, None);
        paper_probabilities(&planes, &curve, &measures, 0.1, 0.95).limit_states()
    };
    assert_eq!(at(uplift * (1.0 - 1e-12), 1.0), LimitStates::all(Some(Interval::exact(0.0))));
    let above = at(uplift * (1.0 + 1e-12), 1.0).map(Option::unwrap);
    assert_eq!(above.rocking, Interval::exact(1.0));
    assert!(above.failure.value > 0.0 && above.overturning.value > 0.0);
    assert_eq!(at(9.0, 0.0).failure, None, "no velocity, no IM3");
}

/// Phi(z), with limits.
fn around(z: f64, half_width: f64) -> Interval {
    Interval::shifted(half_width, |shift| normal::cdf(z + shift))
}

proptest! {
    #[test]
    fn failure_is_at_least_as_likely_as_either_way_to_it(ro in 0.0..=1.0f64, ex in 0.0..=1.0f64) {
        let failure = p_failure_given_rocking(ro, ex);
        prop_assert!(failure >= ro.max(ex) - 1e-15 && failure <= 1.0);
    }

    #[test]
    fn limits_of_failure_enclose_it_and_those_of_both(
        (ro, ro_half) in (-45.0..45.0f64, 0.0..80.0f64), (ex, ex_half) in (-45.0..45.0f64, 0.0..80.0f64),
    ) {
        let (ro, ex) = (around(ro, ro_half), around(ex, ex_half));
        let p = independent_failure(ro, ex);
        prop_assert!(0.0 <= p.low && p.low <= p.value && p.value <= p.high && p.high <= 1.0, "{p:?}");
        prop_assert!((p.value - p_failure_given_rocking(ro.value, ex.value)).abs() < 1e-14);
        let least = |a: f64, b: f64| a.max(b) * (1.0 - 1e-12);
        prop_assert!(p.low >= least(ro.low, ex.low) && p.high >= least(ro.high, ex.high), "{p:?} {ro:?} {ex:?}");
    }

    #[test]
    fn narrow_limits_of_failure_are_those_of_the_delta_method(ro in -5.0..2.0f64, ex in -5.0..2.0f64) {
        let (ro_half, ex_half, step) = (6e-4, 4e-4, 1e-6);
        let at = |ro: f64, ex: f64| p_failure_given_rocking(normal::cdf(ro), normal::cdf(ex));
        let by_ro = (at(ro + step, ex) - at(ro - step, ex)) / (2.0 * step);
        let by_ex = (at(ro, ex + step) - at(ro, ex - step)) / (2.0 * step);
        let p = independent_failure(around(ro, ro_half), around(ex, ex_half));
        let expected = 2.0 * (ro_half * by_ro).hypot(ex_half * by_ex);
        prop_assert!(((p.high - p.low) / expected - 1.0).abs() < 1e-2, "{p:?} {expected}");
    }
}
