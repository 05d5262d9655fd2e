//! Intensity measures against closed forms.

use std::f64::consts::PI;

use rockfrag_core::motion::measures::{spectral_acceleration, velocity};
use rockfrag_core::motion::{Dimension, IntensityMeasures, MeasurePlan, Peaks};
use rockfrag_core::rocking::Structure;

use crate::shared::close;

fn sine(amplitude: f64, f: f64, duration: f64, dt: f64) -> Vec<f64> {
    (0..=(duration / dt).round() as usize).map(|k| amplitude * (2.0 * PI * f * k as f64 * dt).sin()).collect()
}

#[test]
fn a_sine_has_its_closed_forms() {
    let (a, f, duration, dt) = (2.0, 1.0, 40.0, 0.001);
    let m = MeasurePlan::default().measure(&sine(a, f, duration, dt), dt);
    let coarse = velocity(&sine(a, f, duration, 0.05), 0.05);
    close(m.pga_m_s2, a, 1e-6);
    close(m.pgv_m_s, 2.0 * a / (2.0 * PI * f), 1e-5);
    close(coarse[5], m.pgv_m_s / 2.0 * 0.05 * PI / (0.05 * PI).tan(), 1e-5);
    close(m.pgd_m, a / (2.0 * PI * f) * duration, 1e-5);
    close(m.arias_m_s, PI / (2.0 * 9.81) * 0.5 * a * a * duration, 1e-5);
    close(m.cav_m_s, 2.0 / PI * a * duration, 1e-5);
    close(m.tm_s.unwrap(), 1.0 / f, 0.02);
    close(m.d5_95_s, 0.9 * duration, 0.02);
    close(m.d5_75_s, 0.7 * duration, 0.02);
}

#[test]
fn significant_durations_are_those_of_lines_between_the_samples() {
    // For a(t) = t - 2 the share at t is ((t - 2)^3 + 8) / 16, independent of the samples between.
    let moment = |share: f64| 2.0 + (16.0 * share - 8.0).cbrt();
    for steps in [1, 2, 5, 64] {
        let dt = 4.0 / f64::from(steps);
        let motion: Vec<f64> = (0..=steps).map(|k| f64::from(k) * dt - 2.0).collect();
        let m = MeasurePlan::default().measure(&motion, dt);
        close(m.d5_95_s, moment(0.95) - moment(0.05), 1e-9);
        close(m.d5_75_s, moment(0.75) - moment(0.05), 1e-9);
        close(m.arias_m_s, PI / (2.0 * 9.81) * 16.0 / 3.0, 1e-12);
    }
    let still = MeasurePlan::default().measure(&[0.0; 9], 0.01);
    assert_eq!((still.d5_95_s, still.tm_s), (0.0, None));
}

#[test]
fn an_oscillator_follows_its_closed_forms() {
    // A step of acceleration displaces an undamped oscillator by twice the static displacement.
    let step = vec![1.0; 4001];
    close(spectral_acceleration(&step, 0.001, 1.0, 0.0), 2.0, 1e-5);
    // A damped one overshoots by exp(-pi z / sqrt(1 - z^2)).
    let z: f64 = 0.05;
    let overshoot = (-PI * z / (1.0 - z * z).sqrt()).exp();
    close(spectral_acceleration(&step, 0.001, 1.0, z), 1.0 + overshoot, 1e-5);
    // A very stiff oscillator moves with the ground, which is linear between samples.
    close(spectral_acceleration(&sine(2.0, 1.0, 5.0, 0.01), 0.01, 0.005, z), 2.0, 5e-3);
}

#[test]
fn dimensionless_measures_do_not_depend_on_the_units() {
    // Times scaled by s and lengths by l, of the motion and of the structure.
    let (s, l) = (1.7, 0.6);
    let structure = Structure::new("one", 2.0, 0.2, 0.9).unwrap();
    let steepness = 0.2_f64.tan() * l / (s * s);
    let other = Structure::new("other", 2.0 / s, steepness.atan(), 0.9).unwrap();
    for (quantity, factor) in [
        (Dimension::Duration, s),
        (Dimension::Length, l),
        (Dimension::Velocity, l / s),
        (Dimension::Acceleration, l / (s * s)),
        (Dimension::AriasIntensity, l * l / s.powi(3)),
    ] {
        let (here, there) =
            (quantity.dimensionless(3.0, &structure), quantity.dimensionless(3.0 * factor, &other));
        close(here, there, 1e-12);
    }
    // PGA is an acceleration and PGV a velocity, as in IM4 and IM5; for two seconds of constant acceleration
    // a, the Arias measure is p 2 a^2.
    let (pga, pgv) = (3.0, 0.5);
    let measures = IntensityMeasures::new(&structure, Peaks { pga_m_s2: pga, pgv_m_s: pgv }, None, None);
    assert_eq!(Dimension::Acceleration.dimensionless(pga, &structure), measures.im4);
    assert!((Dimension::Velocity.dimensionless(pgv, &structure) - measures.im5).abs() < 1e-15);
    let arias = MeasurePlan::default().measure(&[pga; 201], 0.01).arias_m_s;
    let found = Dimension::AriasIntensity.dimensionless(arias, &structure);
    close(found, 2.0 * 2.0 * measures.im4.powi(2), 1e-12);
}
