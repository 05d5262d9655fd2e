//! What is done to records, against closed forms.

use std::f64::consts::PI;

use rockfrag::records::rotation::HorizontalPair;
use rockfrag::records::signal::{Baseline, HighPass, HighPassScratch, Scaling, resample, resampled_length};

use crate::writers::{DT, motion, peak};

fn sine(f: f64, n: usize, dt: f64) -> Vec<f64> {
    (0..n).map(|k| (2.0 * PI * f * k as f64 * dt).sin()).collect()
}

#[track_caller]
fn near(a: &[f64], b: &[f64], tolerance: f64) {
    assert_eq!(a.len(), b.len());
    let worst = a.iter().zip(b).fold(0.0_f64, |worst, (a, b)| (a - b).abs().max(worst));
    assert!(worst <= tolerance, "{worst}");
}

#[test]
fn a_mean_or_a_line_is_removed() {
    let clean: Vec<f64> = {
        let mut samples = motion(501);
        Baseline::Linear.remove_from(&mut samples);
        samples
    };
    let with = |offset: f64, slope: f64| -> Vec<f64> {
        clean.iter().enumerate().map(|(k, a)| a + offset + slope * k as f64).collect()
    };
    let mut shifted = with(0.3, 0.0);
    Baseline::Mean.remove_from(&mut shifted);
    near(&shifted, &clean, 1e-12);
    let mut tilted = with(0.3, -0.002);
    Baseline::Linear.remove_from(&mut tilted);
    near(&tilted, &clean, 1e-11);
    let mut kept = with(0.3, 0.1);
    Baseline::None.remove_from(&mut kept);
    near(&kept, &with(0.3, 0.1), 0.0);
    Baseline::Linear.remove_from(&mut []);
}

#[test]
fn the_high_pass_has_its_gain_and_no_phase() {
    let (n, dt, corner) = (20_000, 0.01, 0.5);
    let filter = |samples: &[f64]| {
        let mut filtered = samples.to_vec();
        HighPass { corner_hz: corner }.apply(&mut filtered, dt, &mut HighPassScratch::default());
        filtered
    };
    for (f, gain) in [(0.5, 0.5), (1.0, 256.0 / 257.0), (0.25, 1.0 / 257.0), (5.0, 1.0)] {
        let samples = sine(f, n, dt);
        let middle = |samples: &[f64]| samples[n / 4..3 * n / 4].to_vec();
        let expected: Vec<f64> = middle(&samples).iter().map(|a| gain * a).collect();
        near(&middle(&filter(&samples)), &expected, 2e-4);
    }
    // What comes symmetrical in time goes symmetrical.
    let symmetric: Vec<f64> = (0..2001).map(|k| (-((k as f64 - 1000.0) * 0.02).powi(2)).exp()).collect();
    let filtered = filter(&symmetric);
    let reversed: Vec<f64> = filtered.iter().rev().copied().collect();
    near(&filtered, &reversed, 1e-9);
    // A corner below anything that the record resolves asks for no more memory than that.
    let mut short = motion(100);
    HighPass { corner_hz: 1e-12 }.apply(&mut short, DT, &mut HighPassScratch::default());
    near(&short, &motion(100), 0.1);
}

#[test]
fn resampling_keeps_what_both_steps_can_hold() {
    let (n, dt) = (4001, 0.01);
    let samples = sine(3.0, n, dt);
    for new_dt in [0.005, 0.0025, 0.02, 1.0 / 128.0, 0.03] {
        let resampled = resample(&samples, dt, new_dt);
        assert_eq!(resampled.len(), resampled_length(n, dt, new_dt) as usize);
        let expected = sine(3.0, resampled.len(), new_dt);
        let middle = resampled.len() / 4..3 * resampled.len() / 4;
        near(&resampled[middle.clone()], &expected[middle], 2e-4);
    }
    assert_eq!(resample(&samples, dt, dt).len(), n);
    near(&resample(&samples, dt, dt), &samples, 1e-12);
    // 40 Hz does not fit into steps of 0.02 s, and is not folded into them.
    let gone = resample(&sine(40.0, n, dt), dt, 0.02);
    assert!(peak(&gone[500..1500]) < 1e-3, "{}", peak(&gone[500..1500]));
}

#[test]
fn a_pair_turns_as_a_vector() {
    let n = 1000;
    // Acceleration along N60E seen from azimuths 20 and 290.
    let along = motion(n);
    let seen = |azimuth: f64| -> Vec<f64> {
        along.iter().map(|a| a * (60.0_f64 - azimuth).to_radians().cos()).collect()
    };
    let pair = HorizontalPair::new(DT, [20.0, 290.0], [seen(20.0), seen(290.0)]);
    near(&pair.towards(60.0), &along, 1e-12);
    near(&pair.towards(150.0), &vec![0.0; n], 1e-12);
    let reversed: Vec<f64> = along.iter().map(|a| -a).collect();
    near(&pair.towards(240.0), &reversed, 1e-12);
    let azimuth = pair.azimuth_of([40.0, 60.0 - 290.0].map(|turn: f64| turn.to_radians().cos()));
    assert!((azimuth - 60.0).abs() < 1e-9, "{azimuth}");
    // Of a motion along one line, the peak in each direction goes with the cosine.
    let rotd = pair.rotd();
    assert!((rotd.pga100_m_s2 / peak(&along) - 1.0).abs() < 1e-12);
    assert!((rotd.pga50_m_s2 / (peak(&along) * 45.0_f64.to_radians().cos()) - 1.0).abs() < 0.01);
    // Of a circle, it is the same in all.
    let circle = |phase: f64| (0..n).map(|k| (0.05 * k as f64 + phase).sin()).collect::<Vec<f64>>();
    let rotd = HorizontalPair::new(DT, [0.0, 90.0], [circle(0.0), circle(PI / 2.0)]).rotd();
    assert!((rotd.pga50_m_s2 - 1.0).abs() < 1e-3 && (rotd.pga100_m_s2 - 1.0).abs() < 1e-3, "{rotd:?}");
    assert!(HorizontalPair::is_right_angle(360.0, 90.0) && HorizontalPair::is_right_angle(230.0, 140.0));
    assert!(HorizontalPair::is_right_angle(5.0, 275.5) && !HorizontalPair::is_right_angle(10.0, 190.0));
}

#[test]
fn motions_are_scaled_by_factors_or_to_peaks() {
    let samples = motion(400);
    assert_eq!(Scaling::Factors(vec![0.5, 2.0]).factors(&samples, DT), [0.5, 2.0]);
    let factor = Scaling::Pga(1.5).factors(&samples, DT)[0];
    assert!((factor * peak(&samples) - 1.5).abs() < 1e-12);
    let factor = Scaling::Pgv(0.4).factors(&samples, DT)[0];
    assert!((factor * peak(&rockfrag::motion::intensity::velocity(&samples, DT)) - 0.4).abs() < 1e-12);
    assert!(Scaling::Pga(1.0).factors(&[0.0; 9], DT).is_empty());
}
