//! Pulses in records: detection and fit.

use std::f64::consts::PI;

use rockfrag_core::motion::Pulse;
use rockfrag_core::records::pulses::indicator::indicator;
use rockfrag_core::records::pulses::wavelet::{Wavelet, WaveletTransform};
use rockfrag_core::records::pulses::{FittedPulse, PulseIndicator, Verdict, strongest_direction};

use crate::DT;
use crate::shared::close;

const PULSE: Pulse = Pulse { amplitude_m_s: 0.8, tp_s: 3.0, gamma: 1.9, nu_rad: 0.7 };

/// A pulse at 8 s of 40, with a steady shaking of this velocity.
fn velocity(pulse: &Pulse, shaking_m_s: f64) -> Vec<f64> {
    let shaking = |t: f64| [1.3, 2.1, 3.7, 5.9].iter().map(|f| (2.0 * PI * f * t + f).sin() / f).sum::<f64>();
    let times = (0..4000).map(|k| k as f64 * DT);
    times.map(|t| pulse.velocity_m_s(t - 8.0) + shaking_m_s * shaking(t)).collect()
}

fn indicator_of(velocity: &[f64]) -> PulseIndicator {
    PulseIndicator::of(velocity, DT).unwrap()
}

#[test]
fn the_wavelet_has_unit_energy_and_four_vanishing_moments() {
    let dt = 0.0005;
    let mut values = vec![0.0; 40_000];
    Wavelet::new(2.0, dt).add_to(&mut values, 20_000, 1.0);
    let energy: f64 = values.iter().map(|v| v * v * dt).sum();
    assert!((energy - 1.0).abs() < 1e-4, "{energy}");
    for power in 0..4 {
        let time = |k: usize| k as f64 * dt - 10.0;
        let moment: f64 = values.iter().enumerate().map(|(k, v)| v * time(k).powi(power) * dt).sum();
        assert!(moment.abs() < 1e-4 * 3.0_f64.powi(power), "{power}: {moment}");
    }
}

#[test]
fn the_transform_is_the_square_of_the_coefficient_at_every_sample() {
    let both = [velocity(&PULSE, 0.1), vec![0.0; 4000]];
    let transform = WaveletTransform::new(&both, DT, 5.0);
    for period_s in [0.3, 1.7, 5.0] {
        let (wavelet, squares) = (Wavelet::new(period_s, DT), transform.squares(period_s));
        for sample in [0, 17, 800, 3999] {
            let direct = wavelet.coefficient(&both[0], sample as i64).powi(2);
            assert!((squares[sample] - direct).abs() < 1e-9, "{period_s} {sample}: {direct}");
        }
        assert_eq!(wavelet.coefficient(&both[0], -9000), 0.0);
    }
}

#[test]
fn a_pulse_is_found_and_shaking_is_none() {
    assert!((indicator(0.5, 0.5) - 1.0 / (1.0 + (-23.3_f64 + 7.3 + 10.25).exp())).abs() < 1e-15);
    let pulse = velocity(&PULSE, 0.04);
    let found = indicator_of(&pulse);
    assert_eq!(found.verdict, Verdict::Pulse, "{found:?}");
    close(found.period_s, PULSE.tp_s, 0.2);
    assert!((found.centre_s - 8.0).abs() < 1.0, "{found:?}");
    let shaking = velocity(&Pulse { amplitude_m_s: 0.0, ..PULSE }, 1.0);
    assert_eq!(indicator_of(&shaking).verdict, Verdict::NoPulse);
    // The indicator does not depend on the scale; the limit of peak velocity does.
    let weak = indicator_of(&pulse.iter().map(|v| 0.2 * v).collect::<Vec<f64>>());
    assert_eq!(weak.verdict, Verdict::Weak);
    assert!((weak.indicator - found.indicator).abs() < 1e-9);
    let late = |t: f64| PULSE.velocity_m_s(t - 50.0) + if t < 10.0 { 0.45 * (9.0 * t).sin() } else { 0.0 };
    let late: Vec<f64> = (0..6000).map(|k| late(k as f64 * DT)).collect();
    assert_eq!(indicator_of(&late).verdict, Verdict::Late);
    assert_eq!(PulseIndicator::of(&[0.0; 500], DT), None);
    assert!((0..9).all(|short| PulseIndicator::of(&vec![1.0; short], DT).is_some() == (short > 0)));
}

/// Two wavelets far apart in period and time. The second is stronger by so little that only refined periods
/// show it: the first is at a period of the scan, the second between two.
#[test]
fn the_period_is_that_of_the_stronger_of_two_equal_peaks() {
    let period = |place: f64| 0.25 * 60.0_f64.powf(place / 59.0);
    for (factor, expected) in [(1.003, period(41.5)), (0.997, period(20.0))] {
        let mut both = vec![0.0; 5000];
        Wavelet::new(period(20.0), DT).add_to(&mut both, 600, 1.0);
        Wavelet::new(period(41.5), DT).add_to(&mut both, 2600, factor);
        close(indicator_of(&both).period_s, expected, 0.01);
    }
}

#[test]
fn a_fitted_pulse_is_the_one_that_was_made() {
    let short = Pulse { tp_s: 0.9, gamma: 1.2, nu_rad: -2.0, ..PULSE };
    let long = Pulse { tp_s: 6.5, gamma: 2.8, nu_rad: 1.6, ..PULSE };
    // With shaking it stays near.
    for (pulse, shaking, near) in
        [(PULSE, 0.0, 0.01), (short, 0.0, 0.01), (long, 0.0, 0.01), (PULSE, 0.06, 0.05)]
    {
        let velocity = velocity(&pulse, shaking);
        let found = indicator_of(&velocity);
        let FittedPulse { pulse: fitted, r2, .. } =
            FittedPulse::fit(&velocity, DT, found.period_s, found.centre_s).unwrap();
        assert!(r2 > if shaking > 0.0 { 0.9 } else { 1.0 - 1e-6 }, "{pulse:?} {fitted:?} {r2}");
        close(fitted.tp_s, pulse.tp_s, near);
        close(fitted.amplitude_m_s, pulse.amplitude_m_s, 2.0 * near);
        assert!(shaking > 0.0 || (fitted.gamma / pulse.gamma - 1.0).abs() < 0.02, "{pulse:?} {fitted:?}");
    }
    assert_eq!(FittedPulse::fit(&[0.0; 500], DT, 1.0, 2.0), None);
}

#[test]
fn the_strongest_direction_is_that_of_the_pulse() {
    let along = velocity(&PULSE, 0.0);
    let [x, y] = [0.6, -0.8].map(|part| along.iter().map(|v| part * v).collect::<Vec<f64>>());
    let found = strongest_direction([&x, &y], DT).unwrap();
    assert!((found.second / found.first + 0.8 / 0.6).abs() < 1e-9, "{found:?}");
}
