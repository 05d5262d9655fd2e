//! Pulses in records: found where they are, and fitted as they were made.

use std::f64::consts::PI;

use rockfrag::motion::Pulse;
use rockfrag::motion::intensity::peak;
use rockfrag::records::pulses::FittedPulse;
use rockfrag::records::pulses::indicator::{PulseIndicator, Verdict, indicator, strongest_direction};
use rockfrag::records::pulses::wavelet::{SampledWavelet, Wavelet, WaveletScratch, WaveletTransform};

const DT: f64 = 0.01;
const PULSE: Pulse = Pulse { amplitude_m_s: 0.8, tp_s: 3.0, gamma: 1.9, nu_rad: 0.7 };

/// A pulse at 8 s of 40, and a steady shaking of this velocity over all of it.
fn velocity(pulse: &Pulse, shaking_m_s: f64) -> Vec<f64> {
    let at = |k: usize| {
        let t = k as f64 * DT;
        let shaking: f64 = [1.3, 2.1, 3.7, 5.9].iter().map(|f| (2.0 * PI * f * t + f).sin() / f).sum();
        pulse.velocity_m_s(t - 8.0) + shaking_m_s * shaking
    };
    (0..4000).map(at).collect()
}

fn of(velocity: &[f64]) -> PulseIndicator {
    PulseIndicator::of(velocity, DT, &mut WaveletScratch::default()).unwrap()
}

#[test]
fn the_wavelet_has_unit_energy_and_four_vanishing_moments() {
    let wavelet = Wavelet { period_s: 2.0, centre_s: 10.0 };
    let dt = 0.0005;
    let values: Vec<f64> = (0..40_000).map(|k| wavelet.value(k as f64 * dt)).collect();
    let energy: f64 = values.iter().map(|v| v * v * dt).sum();
    assert!((energy - 1.0).abs() < 1e-4, "{energy}");
    for power in 0..4 {
        let moment: f64 =
            values.iter().enumerate().map(|(k, v)| v * (k as f64 * dt - 10.0).powi(power) * dt).sum();
        assert!(moment.abs() < 1e-4 * 3.0_f64.powi(power), "{power}: {moment}");
    }
}

#[test]
fn the_transform_is_the_coefficient_at_every_sample() {
    let series = velocity(&PULSE, 0.1);
    let mut scratch = WaveletScratch::default();
    let transformable = WaveletTransform::new(&series, DT, 5.0, &mut scratch);
    for period_s in [0.3, 1.7, 5.0] {
        let all = transformable.coefficients(period_s, &mut scratch);
        let sampled = SampledWavelet::new(period_s, DT);
        for index in [0, 17, 800, 3999] {
            let direct = Wavelet { period_s, centre_s: index as f64 * DT }.coefficient(&series, DT);
            assert!((all[index] - direct).abs() < 1e-9, "{period_s} {index}: {} {direct}", all[index]);
            let sampled = sampled.coefficient(&series, index as i64);
            assert!((sampled - direct).abs() < 1e-12, "{period_s} {index}: {sampled} {direct}");
        }
        assert_eq!(sampled.coefficient(&series, -9000), 0.0);
        assert_eq!(all, transformable.coefficients(period_s, &mut scratch), "the second time as the first");
    }
}

#[test]
fn the_indicator_is_bakers() {
    assert!((indicator(0.5, 0.5) - 1.0 / (1.0 + (-23.3_f64 + 7.3 + 10.25).exp())).abs() < 1e-15);
    assert!(indicator(0.3, 0.2) > 0.99 && indicator(1.0, 1.0) < 0.01);
}

#[test]
fn a_pulse_is_found_and_shaking_is_none() {
    let found = of(&velocity(&PULSE, 0.04));
    assert_eq!(found.verdict, Verdict::Pulse, "{found:?}");
    assert!(
        (found.period_s / PULSE.tp_s - 1.0).abs() < 0.2 && (found.centre_s - 8.0).abs() < 1.0,
        "{found:?}"
    );
    let none = Pulse { amplitude_m_s: 0.0, ..PULSE };
    assert_eq!(of(&velocity(&none, 1.0)).verdict, Verdict::NoPulse);
    // The indicator does not feel the scale; whether the pulse is strong enough does.
    let weak: Vec<f64> = velocity(&PULSE, 0.04).iter().map(|v| 0.2 * v).collect();
    assert_eq!(of(&weak).verdict, Verdict::Weak);
    assert!((of(&weak).indicator - found.indicator).abs() < 1e-9);
    let late: Vec<f64> = (0..6000)
        .map(|k| k as f64 * DT)
        .map(|t| PULSE.velocity_m_s(t - 50.0) + if t < 10.0 { 0.45 * (9.0 * t).sin() } else { 0.0 })
        .collect();
    assert_eq!(of(&late).verdict, Verdict::Late);
    assert_eq!(PulseIndicator::of(&[0.0; 500], DT, &mut WaveletScratch::default()), None);
    for short in 0..9 {
        let found = PulseIndicator::of(&vec![1.0; short], DT, &mut WaveletScratch::default());
        assert_eq!(found.is_some(), short > 0);
    }
}

/// Two wavelets far apart in period and time, of which the second is stronger by so little that only the refined periods show it: the
/// first lies on a period of the scan, the second between two.
#[test]
fn the_period_is_that_of_the_stronger_of_two_equal_peaks() {
    let ratio = 60.0_f64.powf(1.0 / 59.0);
    let scanned = 0.25 * ratio.powi(20);
    let between = 0.25 * ratio.powf(41.5);
    let wavelet = |period_s: f64, centre_s: f64| Wavelet { period_s, centre_s };
    let (short, long) = (wavelet(scanned, 6.0), wavelet(between, 26.0));
    for (factor, expected) in [(1.003, between), (0.997, scanned)] {
        let at = |k: usize| short.value(k as f64 * DT) + factor * long.value(k as f64 * DT);
        let found = of(&(0..5000).map(at).collect::<Vec<_>>());
        assert!((found.period_s / expected - 1.0).abs() < 0.01, "{factor}: {found:?} for {expected}");
    }
}

#[test]
fn a_fitted_pulse_is_the_one_that_was_made() {
    for pulse in [
        PULSE,
        Pulse { tp_s: 0.9, gamma: 1.2, nu_rad: -2.0, ..PULSE },
        Pulse { tp_s: 6.5, gamma: 2.8, nu_rad: 1.6, ..PULSE },
    ] {
        let velocity = velocity(&pulse, 0.0);
        let found = of(&velocity);
        let fitted = FittedPulse::fit(&velocity, DT, found.period_s, found.centre_s).unwrap();
        assert!(fitted.r2 > 1.0 - 1e-6, "{pulse:?} {fitted:?}");
        let worst = (0..velocity.len())
            .map(|k| (fitted.pulse.velocity_m_s(k as f64 * DT - fitted.t0_s) - velocity[k]).abs())
            .fold(0.0, f64::max);
        assert!(worst < 2e-3 * peak(&velocity), "{pulse:?} {fitted:?} {worst}");
        assert!((fitted.pulse.tp_s / pulse.tp_s - 1.0).abs() < 0.01, "{pulse:?} {fitted:?}");
        assert!((fitted.pulse.gamma / pulse.gamma - 1.0).abs() < 0.02, "{pulse:?} {fitted:?}");
    }
    // Under shaking it stays near.
    let noisy = velocity(&PULSE, 0.06);
    let found = of(&noisy);
    let fitted = FittedPulse::fit(&noisy, DT, found.period_s, found.centre_s).unwrap();
    assert!((fitted.pulse.tp_s / PULSE.tp_s - 1.0).abs() < 0.05, "{fitted:?}");
    assert!((fitted.pulse.amplitude_m_s / PULSE.amplitude_m_s - 1.0).abs() < 0.1, "{fitted:?}");
    assert_eq!(FittedPulse::fit(&[0.0; 500], DT, 1.0, 2.0), None);
}

#[test]
fn the_strongest_direction_is_that_of_the_pulse() {
    let along = velocity(&PULSE, 0.0);
    let parts = [0.6, -0.8].map(|part| along.iter().map(|v| part * v).collect::<Vec<f64>>());
    let found = strongest_direction([&parts[0], &parts[1]], DT, &mut WaveletScratch::default()).unwrap();
    assert!((found[1] / found[0] + 0.8 / 0.6).abs() < 1e-9, "{found:?}");
}
