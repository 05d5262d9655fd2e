//! Plausible and implausible records.

use rockfrag_core::records::implausibility::{Implausibility, implausibility, incompleteness};

use crate::shared::reference_motions;
use crate::{DT, G, motion};

#[test]
fn the_motions_of_the_references_are_plausible_but_for_half_pulses() {
    let mut half_pulses = 0;
    for (id, motion) in reference_motions() {
        match implausibility(&motion.acceleration_m_s2, motion.dt_s) {
            // The strongest synthetic motions are as strong as few records.
            None | Some(Implausibility::RarePga { .. } | Implausibility::RarePgv { .. }) => {}
            // Half-sine and rectangular pulses end with a velocity, or never turn.
            Some(Implausibility::Drift { .. } | Implausibility::OneSided) => half_pulses += 1,
            Some(other) => panic!("{id}: {other}"),
        }
    }
    assert_eq!(half_pulses, 11);
}

#[test]
fn every_limit_is_kept() {
    let slow = |k: usize| (2.0 * std::f64::consts::PI * k as f64 / 1000.0).sin();
    let kind = |dt_s: f64, change: &dyn Fn(usize, f64) -> f64| {
        let samples: Vec<f64> = motion(1000).into_iter().enumerate().map(|(k, a)| change(k, a)).collect();
        format!("{:?}", implausibility(&samples, dt_s))
    };
    let clipped: Vec<f64> = motion(1000).iter().map(|a| a.clamp(-2.0, 2.0)).collect();
    for (found, expected) in [
        (kind(DT, &|_, a| a), "None"),
        (kind(DT, &|_, a| 100.0 * a), "Some(Pga { pga_g: 30."),
        (kind(DT, &|_, a| 9.81 * a), "Some(RarePga { pga_g: 2.9"),
        (kind(DT, &|_, a| 1e-3 * a), "Some(WeakPga"),
        (kind(DT, &|k, a| if k == 700 { 30.0 * G } else { a }), "Some(Spike { sample: 701, pga_g: 30.0"),
        (kind(DT, &|_, a| a.abs()), "Some(OneSided"),
        (kind(DT, &|_, a| a + 0.5), "Some(Drift { velocity_m_s: 4.99"),
        (kind(1.0, &|_, a| a), "Some(TimeStep"),
        (kind(DT / 50.0, &|_, a| a), "Some(Fast { frequency_hz: 8"),
        (kind(DT, &|_, _| 0.0), "Some(Still"),
        (kind(DT, &|k, _| slow(k)), "Some(Slow { ratio_s: 3.18"),
        (kind(DT, &|k, _| 4.0 * slow(k)), "Some(Pgv { pgv_m_s: 12.7"),
        (format!("{:?}", implausibility(&motion(1000)[..20], DT)), "Some(FewSamples { samples: 20"),
        (format!("{:?}", incompleteness(&motion(1000)[..540], DT)), "Some(CutOff { share: 0.9"),
        (format!("{:?}", incompleteness(&motion(1000)[460..], DT)), "Some(CutOff { share: "),
        (format!("{:?}", incompleteness(&motion(1000)[100..900], DT)), "None"),
        (format!("{:?}", incompleteness(&clipped, DT)), "Some(Clipped { pga_g: 0.20"),
    ] {
        assert!(found.starts_with(expected), "{expected}: {found}");
    }
    let impossible =
        [Implausibility::Still, Implausibility::Pga { pga_g: 30.0 }, Implausibility::TimeStep { dt_s: 1.0 }];
    assert!(impossible.iter().all(Implausibility::is_impossible));
    assert!(!Implausibility::RarePga { pga_g: 3.0 }.is_impossible());
}
