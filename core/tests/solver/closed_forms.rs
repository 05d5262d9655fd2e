//! Overturning of slender blocks under pulses against closed forms: the pulses that just overturn, by linear
//! theory, which holds for small alpha.

use std::f64::consts::PI;

use rockfrag_core::rocking::{Outcome, Structure};
use rockfrag_core::units::G_M_S2;

use crate::shared::{Row, close, respond, rows};

pub const P: f64 = 1.0;
const TOLERANCE: f64 = 1e-4;
const SAMPLES: usize = 4000;

fn overturns(alpha: f64, eta: f64, samples: &[f64], dt: f64) -> bool {
    respond(&Structure::new("slender", P, alpha, eta).unwrap(), samples, dt).outcome == Outcome::Overturned
}

/// The value between two at which an outcome changes, by bisection.
fn changes(mut low: f64, mut high: f64, overturns: impl Fn(f64) -> bool) -> f64 {
    let at_low = overturns(low);
    assert_ne!(at_low, overturns(high), "no change between {low} and {high}");
    while high - low > 1e-7 * low {
        let middle = 0.5 * (low + high);
        *(if overturns(middle) == at_low { &mut low } else { &mut high }) = middle;
    }
    0.5 * (low + high)
}

/// A sine of circular frequency `w` (rad/s) and amplitude `r` g tan(alpha), for so many half cycles, and the
/// step.
pub fn sine(alpha: f64, r: f64, w: f64, half_cycles: f64) -> (Vec<f64>, f64) {
    let dt = half_cycles * PI / w / SAMPLES as f64;
    let at = |k: usize| r * G_M_S2 * alpha.tan() * (w * dt * k as f64).sin();
    ((0..SAMPLES).map(at).chain([0.0]).collect(), dt)
}

#[test]
fn rectangular_pulses_overturn_as_housner_says() {
    // Housner (1963): cosh(p t) = 1 + 1/(2 r (r - 1)), r = a/(g alpha), t the duration.
    let alpha = 0.01_f64;
    for r in [1.1, 1.3, 1.7, 2.5, 5.0] {
        let mut samples = vec![r * G_M_S2 * alpha.tan(); SAMPLES];
        samples.push(0.0);
        // The last step falls to zero: as long as half a step of the pulse.
        let duration = |dt: f64| (SAMPLES as f64 - 0.5) * dt;
        let found = duration(changes(1e-5, 2e-3, |dt| overturns(alpha, 0.9, &samples, dt)));
        let expected = (1.0 + 1.0 / (2.0 * r * (r - 1.0))).acosh() / P;
        close(found, expected, TOLERANCE);
    }
}

#[test]
fn half_sines_overturn_without_an_impact_as_linear_theory_says() {
    // r p (w cos psi + p sin psi + w exp(-p t)) = p^2 + w^2, sin psi = 1/r, t from uplift to the end of the
    // pulse. Housner's sqrt(1 + (w/p)^2) takes the block to move from the beginning of the pulse on.
    let alpha = 0.01_f64;
    for w in [0.5, 1.0, 2.0, 4.0, 6.0] {
        let exceeds = |r: f64| {
            let psi = (1.0 / r).asin();
            let last = (-P * (PI - psi) / w).exp();
            r * P * (w * psi.cos() + P * psi.sin() + w * last) > P * P + w * w
        };
        let expected = changes(1.0 + 1e-9, 20.0, exceeds);
        let found = changes(1.0 + 1e-6, 20.0, |r| {
            let (samples, dt) = sine(alpha, r, w, 1.0);
            overturns(alpha, 0.9, &samples, dt)
        });
        close(found, expected, TOLERANCE);
    }
}

#[test]
fn one_sines_overturn_after_an_impact_and_without_one_as_linear_theory_says() {
    // scripts/reference/one_sine.py. Differences are those of sin(alpha) from alpha.
    let alpha = 1e-3_f64;
    for edge in rows::<Row>("rocking/one_sine.csv") {
        let (w_p, r): (f64, f64) = (edge.get("w_p"), edge.get("r"));
        let at = |r: f64| {
            let (samples, dt) = sine(alpha, r, w_p * P, 2.0);
            overturns(alpha, 0.9, &samples, dt)
        };
        close(changes(0.995 * r, 1.005 * r, at), r, TOLERANCE);
        assert_eq!(at(1.005 * r), edge.get::<u8>("overturns_above") == 1, "{edge:?}");
    }
}
