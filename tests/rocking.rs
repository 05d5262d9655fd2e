//! Rocking against closed forms and invariances.

use std::f64::consts::{FRAC_PI_2, PI};

mod noise;

use noise::synthetic_motion;
use proptest::prelude::*;
use rockfrag::motion::Pulse;
use rockfrag::rocking::{
    Event, Outcome, Record, Structure, frame_eta, frame_p, housner_eta, rectangular_p, simulate, trace,
};
use rockfrag::units::G_M_S2;

fn structure(p: f64, alpha: f64, eta: f64) -> Structure {
    Structure::new("s", p, alpha, eta).unwrap()
}

/// A rectangular pulse of `duration`, then quiet for `rest`; the switch takes one step.
fn rectangular_pulse(acceleration: f64, duration: f64, rest: f64, dt: f64) -> Vec<f64> {
    let on = (duration / dt).round() as usize;
    let mut samples = vec![acceleration; on + 1];
    samples.resize(on + (rest / dt).round() as usize, 0.0);
    samples
}

#[test]
fn free_rocking_has_housners_period_and_decay() {
    // Housner (1963): T = 4/p acosh(1/(1 - theta0/alpha)) of small angles, and impacts reduce the kinetic energy by eta^2.
    let (p, alpha, eta) = (2.0, 0.02, 0.9);
    let s = structure(p, alpha, eta);
    let dt = 0.001;
    // A pulse that ends while the block moves, then free rocking.
    let samples = rectangular_pulse(1.5 * G_M_S2 * alpha.tan(), 0.30, 12.0, dt);
    let (response, points) = trace(&s, &Record::new(&samples, dt).unwrap());
    assert_eq!(response.outcome, Outcome::SafeRocking);
    let impacts: Vec<f64> =
        points.iter().filter(|q| q.event == Some(Event::Impact)).map(|q| q.time_s).collect();
    let peak_between = |from: f64, to: f64| {
        let inside = points.iter().filter(|q| q.time_s > from && q.time_s < to);
        inside.map(|q| q.theta_rad.abs()).fold(0.0, f64::max)
    };
    let mut last_velocity: Option<f64> = None;
    let mut checked = 0;
    for pair in impacts.windows(2).take(8) {
        let peak = peak_between(pair[0], pair[1]);
        if peak < 1e-3 * alpha {
            break;
        }
        // Half a period passes between two impacts.
        let half_period = 2.0 / p * (1.0 / (1.0 - peak / alpha)).acosh();
        let measured = pair[1] - pair[0];
        assert!((measured / half_period - 1.0).abs() < 2e-3, "{measured} for {half_period} at {peak}");
        let after = points.iter().find(|q| q.event == Some(Event::Impact) && q.time_s == pair[0]);
        let velocity = after.unwrap().theta_dot_rad_s.abs();
        if let Some(last) = last_velocity {
            assert!((velocity / last - eta).abs() < 1e-9, "decay {}", velocity / last);
        }
        last_velocity = Some(velocity);
        checked += 1;
    }
    assert!(checked >= 5, "{checked} bounces");
}

#[test]
fn a_rectangular_pulse_overturns_a_slender_block_as_the_linearised_equation_says() {
    // theta'' = p^2 (theta + alpha (A - 1)) from rest under A = a/(g alpha): overturning without impact just when the
    // unstable mode of the state at the end of the pulse, theta - alpha + theta'/p, is positive: exp(p T) > A / (A - 1).
    let alpha: f64 = 0.001;
    let s = structure(1.0, alpha, 0.9);
    for amplitude in [1.5, 2.0, 3.0] {
        let critical = (amplitude / (amplitude - 1.0_f64)).ln();
        let outcome = |duration: f64| {
            let dt = duration / 4000.0;
            let samples = rectangular_pulse(amplitude * G_M_S2 * alpha.tan(), duration, 10.0 * dt, dt);
            simulate(&s, &Record::new(&samples, dt).unwrap()).outcome
        };
        assert_eq!(outcome(critical * 0.995), Outcome::SafeRocking, "A = {amplitude}");
        assert_eq!(outcome(critical * 1.005), Outcome::Overturning, "A = {amplitude}");
    }
}

#[test]
fn energy_is_conserved_between_impacts() {
    let s = structure(2.0, 0.3, 0.85);
    let dt = 0.005;
    let samples = rectangular_pulse(1.3 * G_M_S2 * 0.3_f64.tan(), 0.4, 6.0, dt);
    let (_, points) = trace(&s, &Record::new(&samples, dt).unwrap());
    let free = points.iter().filter(|q| q.time_s > 0.41);
    let energy = |theta: f64, velocity: f64| {
        0.5 * (velocity / 2.0).powi(2) + (0.3 - theta.abs()).cos() - 0.3_f64.cos()
    };
    let mut level: Option<f64> = None;
    let mut compared = 0;
    for point in free {
        match point.event {
            Some(_) => level = None,
            None if point.theta_rad == 0.0 => {}
            None => {
                let here = energy(point.theta_rad, point.theta_dot_rad_s);
                let before = *level.get_or_insert(here);
                assert!((here / before - 1.0).abs() < 1e-10, "{here:e} for {before:e} at {}", point.time_s);
                compared += 1;
            }
        }
    }
    assert!(compared > 200);
}

#[test]
fn similar_structures_have_the_same_response() {
    // Eq. 10 and Figure 5: with equal wp/p and PGA/(g tan alpha) the response theta/alpha is the same, up to alpha.
    let pulse = |p: f64, alpha: f64| {
        let tp_s = 2.0 * PI / (5.0 * p);
        let pulse = Pulse { amplitude_m_s: 1.0, tp_s, gamma: 1.9, nu_rad: 0.8 };
        let dt = tp_s / 400.0;
        let shape: Vec<f64> = (0..1000).map(|k| pulse.acceleration_m_s2((k as f64 - 500.0) * dt)).collect();
        let largest = shape.iter().fold(0.0_f64, |l, a| l.max(a.abs()));
        let scale = 1.6 * G_M_S2 * alpha.tan() / largest;
        let samples: Vec<f64> = shape.iter().map(|a| a * scale).collect();
        simulate(&structure(p, alpha, 0.92), &Record::new(&samples, dt).unwrap()).edp
    };
    let master = pulse(1.0, 1e-4);
    let deviation = |alpha: f64| (pulse(2.5, alpha) / master - 1.0).abs();
    let deviations = [0.01, 0.05, 0.1, 0.2, 0.3].map(deviation);
    println!("deviation of theta/alpha at alpha 0.01, 0.05, 0.1, 0.2, 0.3: {deviations:?}");
    assert!(deviations[0] < 1e-3, "{deviations:?}");
    assert!(deviations.windows(2).all(|pair| pair[1] > pair[0]), "grows with alpha: {deviations:?}");
    // At one slenderness the similarity is exact: only time and size change.
    assert!((pulse(0.7, 0.2) / pulse(2.5, 0.2) - 1.0).abs() < 1e-9);
}

#[test]
fn a_block_below_the_uplift_acceleration_does_not_rock() {
    let s = structure(2.0, 0.2, 0.9);
    let uplift = s.uplift_acceleration_m_s2();
    let at = |peak: f64| simulate(&s, &Record::new(&[0.0, peak, 0.0, 0.0], 0.01).unwrap());
    assert_eq!(at(0.999 * uplift).outcome, Outcome::NoRocking);
    assert_eq!(at(0.999 * uplift).edp, 0.0);
    let above = at(1.01 * uplift);
    assert_eq!(above.outcome, Outcome::SafeRocking);
    assert!(above.edp > 0.0 && above.edp < 1e-3);
}

#[test]
fn what_the_record_leaves_in_motion_is_decided_by_energy() {
    // The same motion with quiet time appended must give the same answer as the closed form at its end.
    let s = structure(1.5, 0.2, 0.9);
    for seed in 1..200 {
        let mut samples = synthetic_motion(seed, 300);
        samples[299] = 0.0;
        let mut longer = samples.clone();
        longer.resize(300 + 20_000, 0.0);
        let short = simulate(&s, &Record::new(&samples, 0.02).unwrap());
        let long = simulate(&s, &Record::new(&longer, 0.02).unwrap());
        assert_eq!(short.outcome, long.outcome, "seed {seed}");
        assert!((short.edp / long.edp - 1.0).abs() < 1e-9 || short.edp == long.edp, "seed {seed}");
    }
}

#[test]
fn overturning_is_reported_at_a_right_angle() {
    let s = structure(3.0, 0.15, 0.9);
    let response = simulate(&s, &Record::new(&[20.0; 400], 0.01).unwrap());
    assert_eq!(response.outcome, Outcome::Overturning);
    assert_eq!(response.edp, FRAC_PI_2 / 0.15);
}

#[test]
fn perfectly_elastic_impacts_come_to_an_end() {
    let s = structure(2.0, 0.2, 1.0);
    let response = simulate(&s, &Record::new(&synthetic_motion(3, 500), 0.02).unwrap());
    assert!(response.edp.is_finite());
}

#[test]
fn structures_are_made_of_their_dimensions() {
    let block = Structure::rectangular_block("b", 1.0, 4.0, None).unwrap();
    assert!((block.alpha_rad - 0.25_f64.atan()).abs() < 1e-15);
    assert!((block.p_rad_s - rectangular_p(17.0_f64.sqrt() / 2.0)).abs() < 1e-12);
    assert_eq!(block.eta, housner_eta(block.alpha_rad));
    let frame = Structure::frame("f", 1.0, 4.0, 2.0, None).unwrap();
    assert!((frame.p_rad_s - frame_p(block.p_rad_s, 2.0)).abs() < 1e-12);
    assert!((frame.p_rad_s / block.p_rad_s - (5.0_f64 / 7.0).sqrt()).abs() < 1e-12);
    assert_eq!(frame.eta, frame_eta(block.alpha_rad, 2.0));
    assert!((frame_eta(0.3, 0.0) - housner_eta(0.3)).abs() < 1e-15);
}

#[test]
fn impossible_structures_are_refused() {
    for (p, alpha, eta, named) in [
        (0.0, 0.2, 0.9, "p is 0"),
        (f64::NAN, 0.2, 0.9, "p is NaN"),
        (1.0, FRAC_PI_2, 0.9, "alpha is"),
        (1.0, -0.1, 0.9, "alpha is"),
        (1.0, 0.2, 1.01, "eta is 1.01"),
        (1.0, 0.2, 0.0, "eta is 0"),
    ] {
        let message = Structure::new("s", p, alpha, eta).unwrap_err().to_string();
        assert!(message.contains(named), "{message}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn mirrored_motions_have_mirrored_responses(seed in 1u64..10_000, p in 0.5..4.0f64, alpha in 0.05..0.35f64) {
        let s = structure(p, alpha, 0.92);
        let samples = synthetic_motion(seed, 200);
        let mirrored: Vec<f64> = samples.iter().map(|a| -a).collect();
        let record = |samples| Record::new(samples, 0.02).unwrap();
        prop_assert_eq!(simulate(&s, &record(&samples)), simulate(&s, &record(&mirrored)));
        let (_, here) = trace(&s, &record(&samples));
        let (_, there) = trace(&s, &record(&mirrored));
        prop_assert!(here.iter().zip(&there).all(|(a, b)| a.theta_rad == -b.theta_rad));
    }

    #[test]
    fn time_scales_with_p(seed in 1u64..10_000, p in 0.5..4.0f64, alpha in 0.05..0.35f64) {
        let samples = synthetic_motion(seed, 200);
        let at = |p: f64| simulate(&structure(p, alpha, 0.9), &Record::new(&samples, 0.04 / p).unwrap());
        let (here, there) = (at(p), at(2.0 * p));
        prop_assert_eq!(here.outcome, there.outcome);
        prop_assert!((here.edp - there.edp).abs() <= 1e-9 * here.edp);
    }

    #[test]
    fn every_record_has_a_finite_answer(
        samples in prop::collection::vec(prop_oneof![Just(0.0), -100.0..100.0f64, Just(1e-310), Just(1.5)], 2..80),
        dt in prop_oneof![Just(1e-5), Just(0.1), 0.001..0.05f64],
        p in 0.1..10.0f64, alpha in 0.01..1.5f64, eta in 0.05..=1.0f64,
    ) {
        let response = simulate(&structure(p, alpha, eta), &Record::new(&samples, dt).unwrap());
        prop_assert!(response.edp >= 0.0 && response.edp <= FRAC_PI_2 / alpha);
        prop_assert_eq!(response.outcome == Outcome::NoRocking, response.edp == 0.0);
    }
}
