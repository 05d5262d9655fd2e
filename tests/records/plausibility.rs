//! What can be a record, and what was never recorded.

use rockfrag::records::plausibility::doubt;
use rockfrag::table::motions::MotionBatches;

use crate::writers::{DT, G, motion};

#[test]
fn the_motions_of_the_references_are_plausible_but_for_half_pulses() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/reference/rocking/motions.parquet");
    let mut half_pulses = 0;
    for motion in MotionBatches::open(path, 64).unwrap().flat_map(Result::unwrap) {
        // Half-sine and rectangular pulses leave the ground moving.
        let found = doubt(&motion.acceleration_m_s2.to_vec(), motion.dt_s);
        if let Some(rare) = found.as_ref().filter(|found| !found.is_impossible) {
            // The strongest synthetic ones are of a strength that few records have.
            assert!(rare.reason.starts_with("few records"), "{}: {rare:?}", motion.motion_id);
        } else if let Some(found) = found {
            assert!(found.found.starts_with("velocity of"), "{}: {found:?}", motion.motion_id);
            half_pulses += 1;
        }
    }
    assert_eq!(half_pulses, 11);
}

#[test]
fn every_limit_is_kept() {
    let of = |change: &dyn Fn(usize, f64) -> f64, dt_s: f64| {
        let samples: Vec<f64> = motion(1000).into_iter().enumerate().map(|(k, a)| change(k, a)).collect();
        doubt(&samples, dt_s).map_or(String::new(), |doubt| doubt.found)
    };
    assert_eq!(of(&|_, a| a, DT), "");
    assert!(of(&|_, a| 100.0 * a, DT).starts_with("PGA 29"));
    assert!(of(&|_, a| 9.81 * a, DT).starts_with("PGA 2.8"));
    assert!(of(&|_, a| 1e-3 * a, DT).starts_with("PGA 0.000294"));
    assert!(of(&|k, a| if k == 500 { 30.0 * G } else { a }, DT).starts_with("sample 501 of 30 g"));
    assert!(of(&|_, a| a + 0.5, DT).starts_with("velocity of 5"));
    assert!(of(&|_, a| a, 1.0).starts_with("dt 1 s"));
    assert!(of(&|_, a| a, DT / 50.0).starts_with("mean frequency 8"));
    assert_eq!(of(&|_, _| 0.0, DT), "0 throughout");
    let slow = |k: usize, _| (2.0 * std::f64::consts::PI * k as f64 / 1000.0).sin();
    assert!(of(&slow, DT).starts_with("PGV/PGA 3.18 s"));
    assert!(of(&|k, a| 4.0 * slow(k, a), DT).starts_with("PGV 12.7 m/s"));
}
