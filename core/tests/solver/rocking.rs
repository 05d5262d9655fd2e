//! Rocking against closed forms and invariances.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::noise::synthetic_motion;
use proptest::prelude::*;
use rockfrag_core::motion::Pulse;
use rockfrag_core::rocking::{
    Outcome, Record, RecordError, SolverEvent, Structure, StructureError, simulate, trace,
};
use rockfrag_core::units::G_M_S2;

fn structure(p: f64, alpha: f64, eta: f64) -> Structure {
    Structure::new("s", p, alpha, eta).unwrap()
}

/// A rectangular pulse of `duration` with an end ramp of one step, then zeros for `rest`.
fn rectangular_pulse(acceleration: f64, duration: f64, rest: f64, dt: f64) -> Vec<f64> {
    let on = (duration / dt).round() as usize;
    let mut samples = vec![acceleration; on + 1];
    samples.resize(on + (rest / dt).round() as usize, 0.0);
    samples
}

#[test]
fn free_rocking_has_housners_period_and_decay() {
    // Housner (1963), small angles: T = 4/p acosh(1/(1 - theta0/alpha)), and an impact multiplies the kinetic
    // energy by eta^2.
    let (p, alpha, eta) = (2.0, 0.02, 0.9);
    let s = structure(p, alpha, eta);
    let dt = 0.001;
    // A pulse that ends while the block moves, then free rocking.
    let samples = rectangular_pulse(1.5 * G_M_S2 * alpha.tan(), 0.30, 12.0, dt);
    let (response, points) = trace(&s, &Record::new(&samples, dt).unwrap(), 0.0);
    assert!(matches!(response.outcome, Outcome::SafeRocking(_)));
    let impacts: Vec<f64> =
        points.iter().filter(|q| q.solver_event == Some(SolverEvent::Impact)).map(|q| q.time_s).collect();
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
        // Half a period between two impacts.
        let half_period = 2.0 / p * (1.0 / (1.0 - peak / alpha)).acosh();
        let measured = pair[1] - pair[0];
        assert!((measured / half_period - 1.0).abs() < 2e-3, "{measured} for {half_period} at {peak}");
        let after =
            points.iter().find(|q| q.solver_event == Some(SolverEvent::Impact) && q.time_s == pair[0]);
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
fn similar_structures_have_the_same_response() {
    // Orientationless dimensionless groups (Eq. 10, Figure 5): with equal wp/p and PGA/(g tan alpha) the
    // response theta/alpha is equal, up to alpha.
    let pulse = |p: f64, alpha: f64| {
        let tp_s = 2.0 * PI / (5.0 * p);
        let pulse = Pulse { amplitude_m_s: 1.0, tp_s, gamma: 1.9, nu_rad: 0.8 };
        let dt = tp_s / 400.0;
        let shape: Vec<f64> = (0..1000).map(|k| pulse.acceleration_m_s2((k as f64 - 500.0) * dt)).collect();
        let largest = shape.iter().fold(0.0_f64, |l, a| l.max(a.abs()));
        let scale = 1.6 * G_M_S2 * alpha.tan() / largest;
        let samples: Vec<f64> = shape.iter().map(|a| a * scale).collect();
        simulate(&structure(p, alpha, 0.92), &Record::new(&samples, dt).unwrap()).outcome.demand().unwrap()
    };
    let master = pulse(1.0, 1e-4);
    let deviation = |alpha: f64| (pulse(2.5, alpha) / master - 1.0).abs();
    let deviations = [0.01, 0.05, 0.1, 0.2, 0.3].map(deviation);
    assert!(deviations[0] < 1e-3, "{deviations:?}");
    assert!(deviations.windows(2).all(|pair| pair[1] > pair[0]), "grows with alpha: {deviations:?}");
    // At equal slenderness the similarity is exact: only time and size change.
    assert!((pulse(0.7, 0.2) / pulse(2.5, 0.2) - 1.0).abs() < 1e-9);
}

#[test]
fn a_block_below_the_uplift_acceleration_does_not_rock() {
    let s = structure(2.0, 0.2, 0.9);
    let uplift = s.uplift_acceleration_m_s2();
    let at = |peak: f64| simulate(&s, &Record::new(&[0.0, peak, 0.0, 0.0], 0.01).unwrap());
    assert_eq!(at(0.999 * uplift).outcome, Outcome::NoRocking);
    let Outcome::SafeRocking(demand) = at(1.01 * uplift).outcome else { panic!() };
    assert!(demand > 0.0 && demand < 1e-3);
}

#[test]
fn what_the_record_leaves_in_motion_is_decided_by_energy() {
    // The same motion with zeros appended must give the result of the closed form.
    let s = structure(1.5, 0.2, 0.9);
    for seed in 1..200 {
        let mut samples = synthetic_motion(seed, 300);
        samples[299] = 0.0;
        let mut longer = samples.clone();
        longer.resize(300 + 20_000, 0.0);
        let short = simulate(&s, &Record::new(&samples, 0.02).unwrap());
        let long = simulate(&s, &Record::new(&longer, 0.02).unwrap());
        match (short.outcome, long.outcome) {
            (Outcome::SafeRocking(a), Outcome::SafeRocking(b)) => {
                assert!((a / b - 1.0).abs() < 1e-9, "seed {seed}");
            }
            (short, long) => assert_eq!(short, long, "seed {seed}"),
        }
    }
}

#[test]
fn overturning_is_reported_at_a_right_angle() {
    let s = structure(3.0, 0.15, 0.9);
    let (response, points) = trace(&s, &Record::new(&[20.0; 400], 0.01).unwrap(), 0.0);
    assert_eq!(response.outcome, Outcome::Overturned);
    assert!((points.last().unwrap().theta_rad.abs() - FRAC_PI_2).abs() < 1e-9);
}

#[test]
fn structures_are_made_of_their_dimensions() {
    // By hand, with tan(alpha) = 1/4: 2 R = sqrt(17) m, sin2(alpha) = 1/17, cos(2 alpha) = 15/17;
    // p2 = 3 g / (4 R) and eta of Housner (1963), and those of Makris & Vassiliou (2014) for a beam of twice
    // the mass of a column.
    let close =
        |value: f64, expected: f64| assert!((value / expected - 1.0).abs() < 1e-14, "{value} {expected}");
    let block = Structure::rectangular_block("b", 1.0, 4.0, None).unwrap();
    close(block.alpha_rad, 0.25_f64.atan());
    close(block.p_rad_s.powi(2), 3.0 * G_M_S2 / (2.0 * 17.0_f64.sqrt()));
    close(block.eta, 1.0 - 1.5 / 17.0);
    close(block.uplift_acceleration_m_s2(), G_M_S2 / 4.0);
    let frame = Structure::frame("f", 1.0, 4.0, 2.0, None).unwrap();
    close(frame.p_rad_s / block.p_rad_s, (5.0_f64 / 7.0).sqrt());
    close(frame.eta, (1.0 - 1.5 / 17.0 + 6.0 * 15.0 / 17.0) / 7.0);
    assert_eq!(Structure::rectangular_block("b", 1.0, 4.0, Some(0.5)).unwrap().eta, 0.5);
    assert_eq!(Structure::frame("f", 1.0, 4.0, 2.0, Some(0.5)).unwrap().eta, 0.5);
    assert_eq!(Structure::frame("b", 1.0, 4.0, 0.0, None).unwrap(), block);
}

#[test]
fn impossible_structures_are_refused() {
    let wrong = |made: Result<Structure, StructureError>| made.unwrap_err().parameter;
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(wrong(Structure::rectangular_block("b", bad, 4.0, None)), "width");
        assert_eq!(wrong(Structure::rectangular_block("b", 1.0, bad, None)), "height");
        assert_eq!(wrong(Structure::frame("f", bad, 4.0, 1.0, None)), "width");
        assert_eq!(wrong(Structure::frame("f", 1.0, 4.0, bad, None)), "beam-mass-ratio");
    }
    for (p, alpha, eta, named) in [
        (0.0, 0.2, 0.9, "p"),
        (f64::NAN, 0.2, 0.9, "p"),
        (1.0, FRAC_PI_2, 0.9, "alpha"),
        (1.0, -0.1, 0.9, "alpha"),
        (1.0, 0.2, 1.01, "eta"),
        (1.0, 0.2, 0.0, "eta"),
    ] {
        assert_eq!(wrong(Structure::new("s", p, alpha, eta)), named);
    }
}

#[test]
fn impossible_records_are_refused_where_they_are_wrong() {
    for (samples, dt, error) in [
        (&[0.0, 1.0][..], 0.0, RecordError::TimeStep(0.0)),
        (&[1.0], 0.01, RecordError::TooShort(1)),
        (&[0.0, -f64::INFINITY, f64::NAN], 0.01, RecordError::NotFinite { sample: 1, value: -f64::INFINITY }),
        (&[0.0, 1e4, 1.0, -1.5e4, 2e4], 0.01, RecordError::TooLarge { sample: 3, value: -1.5e4 }),
    ] {
        assert_eq!(Record::new(samples, dt).unwrap_err(), error);
    }
    assert_eq!(Record::new(&[0.0, -1e4], 0.01).unwrap().peak_m_s2(), 1e4);
}

#[test]
fn a_trace_tells_what_happens_when() {
    // Uplift (Eq. 5): under a push to the positive side the structure rocks to the negative side, from the
    // root of |a| = g tan(alpha), here half way to the first sample.
    // |a| = g tan(alpha), here half way to the first sample.
    let (alpha, eta, dt) = (0.2, 0.6, 0.01);
    let s = structure(2.5, alpha, eta);
    let mut samples = vec![0.0];
    samples.resize(12, 2.0 * s.uplift_acceleration_m_s2());
    samples.resize(1200, 0.0);
    let (response, points) = trace(&s, &Record::new(&samples, dt).unwrap(), 0.0);
    let Outcome::SafeRocking(demand) = response.outcome else { panic!("{response:?}") };
    let of = |event| points.iter().filter(move |point| point.solver_event == Some(event));
    let first = of(SolverEvent::Uplift).next().unwrap();
    assert!((first.time_s - 0.5 * dt).abs() < 1e-12);
    assert_eq!((first.theta_rad, first.theta_dot_rad_s), (0.0, 0.0));
    let sampled: Vec<_> = points.iter().filter(|point| point.solver_event.is_none()).collect();
    assert_eq!(sampled.len(), samples.len());
    assert!((0..).zip(&sampled).all(|(k, point)| (point.time_s - f64::from(k) * dt).abs() < 1e-9));
    assert!(sampled[5].theta_rad < 0.0 && sampled[5].theta_dot_rad_s < 0.0);
    let largest = points.iter().map(|point| point.theta_rad.abs()).fold(0.0, f64::max);
    assert!(largest <= demand * alpha && largest > 0.999 * demand * alpha);

    // An impact multiplies the velocity by eta, on the other side; after the last one the structure rests.
    assert_eq!(of(SolverEvent::Impact).count(), response.impacts as usize);
    for around in points.windows(3).filter(|around| around[1].solver_event == Some(SolverEvent::Impact)) {
        let [before, impact, after] = [around[0], around[1], around[2]];
        if before.solver_event.is_none() && after.solver_event.is_none() && before.theta_rad.abs() > 1e-3 {
            assert!(before.theta_rad * after.theta_rad < 0.0, "{around:?}");
            assert!(impact.theta_dot_rad_s * after.theta_rad > 0.0, "{around:?}");
        }
    }
    let (rest, impact) =
        (of(SolverEvent::Rest).next_back().unwrap(), of(SolverEvent::Impact).next_back().unwrap());
    assert_eq!((rest.time_s, rest.theta_rad, rest.theta_dot_rad_s), (impact.time_s, 0.0, 0.0));
    let mut after = sampled.iter().skip_while(|point| point.time_s <= rest.time_s).peekable();
    assert!(
        after.peek().is_some() && after.all(|point| point.theta_rad == 0.0 && point.theta_dot_rad_s == 0.0)
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(150))]

    #[test]
    fn mirrored_motions_have_mirrored_responses(
        seed in 1u64..10_000,
        p in 0.5..4.0f64,
        alpha in 0.05..0.35f64,
    ) {
        let s = structure(p, alpha, 0.92);
        let samples = synthetic_motion(seed, 200);
        let mirrored: Vec<f64> = samples.iter().map(|a| -a).collect();
        let record = |samples| Record::new(samples, 0.02).unwrap();
        prop_assert_eq!(simulate(&s, &record(&samples)), simulate(&s, &record(&mirrored)));
        let (_, here) = trace(&s, &record(&samples), 0.0);
        let (_, there) = trace(&s, &record(&mirrored), 0.0);
        prop_assert!(here.iter().zip(&there).all(|(a, b)| a.theta_rad == -b.theta_rad));
    }
}
