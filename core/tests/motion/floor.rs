//! Motions and peaks of floors against scipy and closed forms.

use rockfrag_core::motion::{Floor, Peaks, measures};

use crate::shared::{close, reference_motions};

const DAMPING: f64 = 0.05;

#[test]
fn a_floor_moves_as_scipy_has_it() {
    // scripts/reference/floors.py: motion, period, level, peak, and every hundredth sample.
    let motions = reference_motions();
    let mut floors = 0;
    for line in include_str!("../reference/records/floors.csv").lines() {
        let (id, numbers) = line.split_once(',').unwrap();
        let numbers: Vec<f64> = numbers.split(',').map(|number| number.parse().unwrap()).collect();
        let [period_s, level, peak, ref samples @ ..] = numbers[..] else { panic!("{line}") };
        let motion = &motions[id];
        let found = Floor { period_s, level }.motion(&motion.acceleration_m_s2, motion.dt_s, DAMPING);
        close(measures::peak(&found), peak, 1e-6);
        for (k, expected) in samples.iter().enumerate().filter(|(k, _)| 100 * k < found.len()) {
            assert!((found[100 * k] - expected).abs() < 1e-6 * peak, "{id} {period_s} {level}, sample {k}");
        }
        floors += 1;
    }
    assert_eq!(floors, 90);
    let ground = &motions["0"].acceleration_m_s2;
    assert_eq!(&Floor { period_s: 0.7, level: 0.0 }.motion(ground, 0.01, DAMPING), ground);
}

#[test]
fn the_roof_resonates_as_its_first_mode() {
    // Steady resonance of the first mode: 4/pi times sqrt(1 + 4 z^2)/(2 z), besides modes that move with the
    // ground at most.
    let sine: Vec<f64> =
        (0..24_000).map(|k| (2.0 * std::f64::consts::PI * f64::from(k) * 0.005).sin()).collect();
    let peak = measures::peak(&Floor { period_s: 1.0, level: 1.0 }.motion(&sine, 0.005, DAMPING));
    close(peak, 4.0 / std::f64::consts::PI * 1.01_f64.sqrt() / 0.1, 0.02);
}

#[test]
fn peaks_are_those_of_the_script() {
    // scripts/floors/peaks.py at T1 = Tg = 0.5 s, and T1 1.8 s over Tg 0.4 s; ground of 1 m/s2.
    for (period_s, ground_s, level, expected) in [
        (0.5, 0.5, 1.0, [2.6483, 2.6458, 0.2824, 0.2936]),
        (0.5, 0.5, 0.5, [1.9214, 1.9933, 0.2753, 0.2755]),
        (1.8, 0.4, 1.0, [1.0924, 1.7850, 0.2840, 0.3139]),
        (0.1, 0.6, 0.7, [2.0329, 1.0539, 0.2475, 0.0993]),
    ] {
        let pgv = ground_s / (2.0 * std::f64::consts::PI);
        let found = Floor { period_s, level }.amplification(Peaks { pga_m_s2: 1.0, pgv_m_s: pgv });
        let found = [found.ln_pfa.exp(), found.ln_pfv.exp(), found.sd_ln_pfa, found.sd_ln_pfv];
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found - expected).abs() < 2e-4, "{period_s} {level}: {found}, {expected}");
        }
    }
}

#[test]
fn peaks_on_the_ground_and_in_a_rigid_building_are_those_of_the_ground() {
    let ground = Peaks { pga_m_s2: 3.0, pgv_m_s: 0.2 };
    let rigid = Floor { period_s: 1e-9, level: 1.0 };
    let (peaks, by) = (rigid.peaks(ground), rigid.amplification(ground));
    assert!((peaks.pga_m_s2 - 3.0).abs() < 1e-5 && (peaks.pgv_m_s - 0.2).abs() < 1e-6, "{peaks:?}");
    assert!(by.sd_ln_pfa < 0.01 && by.sd_ln_pfv < 0.01 && by.resonant_share < 1e-4, "{by:?}");
    let floor = Floor { period_s: 0.9, level: 0.0 };
    assert_eq!((floor.peaks(ground), floor.amplification(ground).sd_ln_pfa), (ground, 0.0));
}
