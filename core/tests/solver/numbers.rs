//! Extreme records and structures.

use std::f64::consts::FRAC_PI_2;
use std::mem::discriminant;

use proptest::prelude::*;
use rockfrag_core::rocking::{Outcome, Record, Structure, simulate};

use crate::shared::respond;

/// Records of steps, spikes and plateaus: below, exactly at and just above the uplift threshold (`1.0`),
/// zeros, tiny numbers, 10 g, and the largest accepted.
fn shapes() -> impl Strategy<Value = Vec<(f64, usize)>> {
    let near_uplift = vec![1.0, -1.0, 1.0 + f64::EPSILON, -1.0 - 1e-12, 1.000001];
    let extreme = vec![0.0, f64::MIN_POSITIVE * f64::EPSILON, 1e-310, f64::INFINITY, f64::NEG_INFINITY];
    let some = prop::sample::select([near_uplift, extreme].concat());
    let level = prop_oneof![10 => some, 1 => -4.0..4.0f64];
    let length = prop_oneof![Just(1usize), Just(2), 1..12usize];
    prop::collection::vec((level, length), 1..16)
}

/// Samples of a shape for a structure; infinity becomes `largest`.
fn samples(shape: &[(f64, usize)], structure: &Structure, largest: f64) -> Vec<f64> {
    let uplift = structure.uplift_acceleration_m_s2();
    let level = |level: f64| (level * uplift).clamp(-largest, largest);
    let mut samples: Vec<f64> =
        shape.iter().flat_map(|&(at, length)| std::iter::repeat_n(level(at), length)).collect();
    samples.push(0.0);
    samples
}

fn structures() -> impl Strategy<Value = Structure> {
    let p = prop_oneof![Just(1e-3), Just(100.0), Just(50.0), 0.05..10.0f64];
    let alpha = prop_oneof![Just(1e-6), Just(1e-3), Just(1.5), Just(FRAC_PI_2 * (1.0 - 1e-8)), 0.01..1.2f64];
    let eta = prop_oneof![Just(1e-300), Just(0.999), Just(0.999999), Just(1.0), 0.05..1.0f64];
    (p, alpha, eta).prop_map(|(p, alpha, eta)| Structure::new("s", p, alpha, eta).unwrap())
}

fn time_steps() -> impl Strategy<Value = f64> {
    prop_oneof![Just(1e-6), Just(1e-5), Just(0.1), 0.001..0.05f64]
}

proptest! {
    #[test]
    fn everything_that_is_simulated_ends_in_finite_numbers(
        shape in shapes(), structure in structures(), dt_s in time_steps(),
        largest in prop_oneof![Just(98.1), Just(1e4), 1.0..30.0f64],
    ) {
        let samples = samples(&shape, &structure, largest);
        let record = Record::new(&samples, dt_s).unwrap();
        let uplift = structure.uplift_acceleration_m_s2();
        let response = simulate(&structure, &record);
        let demand = response.outcome.demand();
        prop_assert!(demand.is_none_or(|demand| (0.0..1e9).contains(&demand)), "{response:?}");
        let rests = response.outcome == Outcome::NoRocking;
        // Exactly at the threshold, rounding decides.
        prop_assert!(!rests || record.peak_m_s2() <= uplift * (1.0 + 1e-12), "{response:?}");
        prop_assert!(rests || record.peak_m_s2() >= uplift * (1.0 - 1e-12), "{response:?}");
    }

    #[test]
    fn a_stronger_or_longer_push_to_one_side_moves_it_further(
        push in prop::collection::vec((1.0..3.0f64, 0.0..1.0f64), 1..40), longer in 0..20usize,
        p in 0.2..8.0f64, alpha in 0.02..0.6f64, eta in 0.05..0.99f64, dt_s in 0.001..0.05f64,
    ) {
        // Under a push that always lifts, and then rest, the equation preserves order until the first peak,
        // which is the largest: theta'' increases with theta and with the push as long as theta < alpha;
        // beyond it overturns.
        let structure = Structure::new("s", p, alpha, eta).unwrap();
        let uplift = structure.uplift_acceleration_m_s2();
        let under = |(share, longer): (f64, usize)| {
            let pushed = push.iter().map(|(level, more)| uplift * (level + share * more));
            let held = pushed.chain(std::iter::repeat_n(uplift, longer));
            respond(&structure, &held.chain([0.0]).collect::<Vec<f64>>(), dt_s)
        };
        for pair in [(0.0, 0), (0.5, 0), (1.0, 0), (1.0, longer)].map(under).windows(2) {
            // What overturns lies beyond all demands.
            let [less, more] = [0, 1].map(|k| pair[k].outcome.demand().unwrap_or(f64::INFINITY));
            prop_assert!(more >= less * (1.0 - 1e-9), "{pair:?}");
        }
    }

    #[test]
    fn samples_put_between_samples_change_nothing(
        levels in prop::collection::vec(-4.0..4.0f64, 2..60),
        p in 0.2..8.0f64, alpha in 0.02..0.6f64, eta in 0.05..0.99f64, dt_s in 0.001..0.1f64,
    ) {
        // The ground acceleration is linear between samples, so that samples in the middle have no effect.
        let structure = Structure::new("s", p, alpha, eta).unwrap();
        let uplift_m_s2 = structure.uplift_acceleration_m_s2();
        let coarse: Vec<f64> = levels.iter().map(|level| level * uplift_m_s2).collect();
        let middles = coarse.windows(2).flat_map(|pair| [pair[0], 0.5 * (pair[0] + pair[1])]);
        let fine: Vec<f64> = middles.chain(coarse.last().copied()).collect();
        let coarse = respond(&structure, &coarse, dt_s).outcome;
        let fine = respond(&structure, &fine, 0.5 * dt_s).outcome;
        prop_assert_eq!(discriminant(&coarse), discriminant(&fine));
        let [coarse, fine] = [coarse, fine].map(|outcome| outcome.demand().unwrap_or(0.0));
        prop_assert!((coarse - fine).abs() <= 1e-6 * coarse, "{coarse} {fine}");
    }
}

#[test]
fn an_uplift_a_rounding_before_a_sample_is_an_uplift() {
    // In floating point, uplift is at the sample itself, with no time left before it.
    let structure = Structure::new("s", 0.05, 1.1906210325143882, 0.05).unwrap();
    let uplift = structure.uplift_acceleration_m_s2();
    for after in [vec![], vec![0.0], vec![0.0; 9]] {
        let samples = [vec![-uplift, uplift * (1.0 + f64::EPSILON)], after].concat();
        let response = respond(&structure, &samples, 1e-6);
        assert!(matches!(response.outcome, Outcome::SafeRocking(..1e-12)), "{response:?}");
    }
}

#[test]
fn a_perfect_bounce_on_a_plateau_comes_to_its_end() {
    // Without loss, and pressed down by 10 g after a jolt, the structure would bounce forever, ever faster.
    for (p, eta) in [(2.0, 1.0), (100.0, 1.0), (2.0, 1.0 - f64::EPSILON)] {
        let structure = Structure::new("s", p, 0.2, eta).unwrap();
        let mut samples = vec![0.0, 2.1, -98.1];
        samples.resize(40, -98.1);
        samples.extend([0.0; 10]);
        let response = respond(&structure, &samples, 0.1 / p);
        assert!(response.outcome.demand().is_none_or(f64::is_finite), "{response:?}");
        assert!(response.impacts <= 10_000 * samples.len() as u32, "{response:?}");
    }
}
