//! Processing of records against closed forms.

use std::f64::consts::PI;

use rockfrag_core::motion::measures::peak;
use rockfrag_core::records::rotation::{HorizontalPair, Parts, pairs};
use rockfrag_core::records::signal::{Baseline, high_pass, resample, resampled_length};
use rockfrag_core::records::{Origin, RecordedMotion};
use rockfrag_core::units::Unit;

use crate::{DT, motion};

fn sine(f: f64, n: usize, dt: f64) -> Vec<f64> {
    (0..n).map(|k| (2.0 * PI * f * k as f64 * dt).sin()).collect()
}

#[track_caller]
fn near(a: &[f64], b: impl IntoIterator<Item = f64>, tolerance: f64) {
    let worst = a.iter().zip(b).fold(0.0_f64, |worst, (a, b)| (a - b).abs().max(worst));
    assert!(!a.is_empty() && worst <= tolerance, "{worst}");
}

#[test]
fn a_mean_or_a_line_is_removed() {
    let mut clean = motion(501);
    Baseline::Linear.remove_from(&mut clean);
    for (baseline, slope) in [(Baseline::Mean, 0.0), (Baseline::Linear, -0.002)] {
        let mut samples: Vec<f64> =
            clean.iter().zip(0..).map(|(a, k)| a + 0.3 + slope * f64::from(k)).collect();
        baseline.remove_from(&mut samples);
        near(&samples, clean.clone(), 1e-11);
    }
    Baseline::Linear.remove_from(&mut []);
}

#[test]
fn the_high_pass_has_its_gain_and_no_phase() {
    let (n, dt) = (20_000, 0.01);
    let filter = |mut samples: Vec<f64>, corner_hz: f64| {
        high_pass(&mut samples, dt, corner_hz);
        samples
    };
    for (f, gain) in [(0.5, 0.5), (1.0, 256.0 / 257.0), (0.25, 1.0 / 257.0), (5.0, 1.0)] {
        let expected = sine(f, n, dt).into_iter().map(|a| gain * a);
        near(&filter(sine(f, n, dt), 0.5)[n / 4..3 * n / 4], expected.skip(n / 4), 2e-4);
    }
    // A symmetric motion stays symmetric.
    let symmetric: Vec<f64> = (0..2001).map(|k| (-((k as f64 - 1000.0) * 0.02).powi(2)).exp()).collect();
    near(&filter(symmetric.clone(), 0.5), filter(symmetric, 0.5).into_iter().rev(), 1e-9);
    // A corner below all resolved frequencies needs no more memory.
    near(&filter(motion(100), 1e-12), motion(100), 0.2);
}

#[test]
fn resampling_keeps_what_both_steps_can_hold() {
    let (n, dt) = (4001, 0.01);
    for new_dt in [0.005, 0.0025, 0.01, 0.02, 1.0 / 128.0, 0.03] {
        let resampled = resample(&sine(3.0, n, dt), dt, new_dt);
        assert_eq!(resampled.len(), resampled_length(n, dt, new_dt) as usize);
        let quarter = resampled.len() / 4;
        near(&resampled[quarter..3 * quarter], sine(3.0, n * 4, new_dt).into_iter().skip(quarter), 2e-4);
    }
    // 40 Hz is above the Nyquist frequency of 0.02 s, and is not aliased.
    assert!(peak(&resample(&sine(40.0, n, dt), dt, 0.02)[500..1500]) < 1e-3);
}

fn component(azimuth_deg: f64, samples: Vec<f64>) -> RecordedMotion {
    let origin = Origin { azimuth_deg: Some(azimuth_deg), ..Origin::default() };
    RecordedMotion::new(DT, samples, Unit::parse("m/s2").unwrap(), origin)
}

#[test]
fn a_pair_turns_as_a_vector() {
    // Acceleration along N60E, in components of azimuths 20 and 290.
    let along = motion(1000);
    let seen =
        |azimuth: f64| along.iter().map(|a| a * (60.0 - azimuth).to_radians().cos()).collect::<Vec<_>>();
    let pair = HorizontalPair::new(component(20.0, seen(20.0)), component(290.0, seen(290.0)));
    for (azimuth, factor) in [(60.0, 1.0), (150.0, 0.0), (240.0, -1.0)] {
        near(&pair.towards(azimuth), along.iter().map(|a| factor * a), 1e-12);
    }
    let [first, second] = [40.0, 60.0 - 290.0].map(|turn: f64| turn.to_radians().cos());
    let azimuth = pair.azimuth_of(Parts { first, second });
    assert!((azimuth - 60.0).abs() < 1e-9, "{azimuth}");
    // For a motion along one line, the peak varies with the cosine of the direction; for a circle it is
    // constant.
    let rotd = pair.rotd();
    assert!((rotd.pga100_m_s2 / peak(&along) - 1.0).abs() < 1e-12);
    assert!((rotd.pga50_m_s2 / (peak(&along) * 45.0_f64.to_radians().cos()) - 1.0).abs() < 0.01);
    let circle = |phase: f64| (0..1000).map(|k| (0.05 * k as f64 + phase).sin()).collect::<Vec<f64>>();
    let (first, second) = (component(0.0, circle(0.0)), component(90.0, circle(PI / 2.0)));
    let rotd = HorizontalPair::new(first, second).rotd();
    assert!((rotd.pga50_m_s2 - 1.0).abs() < 1e-3 && (rotd.pga100_m_s2 - 1.0).abs() < 1e-3, "{rotd:?}");
}

#[test]
fn components_of_one_station_at_right_angles_are_a_pair() {
    let components = [
        ("a", Some(230.0)),
        ("b", Some(5.0)),
        ("a", None),
        ("a", Some(140.5)),
        ("b", Some(190.0)),
        ("b", Some(275.5)),
    ];
    let origin = |(station, azimuth_deg): (&str, Option<f64>)| Origin {
        station: Some(station.to_string()),
        azimuth_deg,
        ..Origin::default()
    };
    let origins = components.map(origin);
    let found = pairs(&origins.each_ref().map(|origin| (origin, DT)));
    assert_eq!(found, [[0, 3], [1, 5]]);
}
