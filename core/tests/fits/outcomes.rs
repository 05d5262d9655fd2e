//! Calibrations to what stood and what fell, against scipy on the same posterior density
//! (scripts/reference/outcomes.py).

use rockfrag_core::fragility::{Calibration, MotionKind, ObservedOutcome};
use rockfrag_core::motion::Peaks;
use rockfrag_core::rocking::Structure;
use rockfrag_core::warning::Warning;

use crate::common::{close, read};

#[derive(serde::Deserialize)]
struct ListedOutcome {
    width: f64,
    height: f64,
    pga_m_s2: f64,
    pgv_m_s: f64,
    mw: f64,
    earthquake: u32,
    list: String,
    fell: u8,
}

#[derive(serde::Deserialize)]
struct Answer {
    list: String,
    c: f64,
    ln_s: f64,
    m: f64,
    n: i64,
    n_events: i64,
    v_00: f64,
    v_01: f64,
    v_02: f64,
    v_11: f64,
    v_12: f64,
    v_22: f64,
}

fn outcomes(list: &str) -> Vec<ObservedOutcome> {
    let rows: Vec<ListedOutcome> = read("outcomes.csv");
    let outcome = |row: ListedOutcome| ObservedOutcome {
        structure: Structure::rectangular_block("stone", row.width, row.height, None).unwrap(),
        peaks: Peaks { pga_m_s2: row.pga_m_s2, pgv_m_s: row.pgv_m_s },
        mw: Some(row.mw),
        earthquake: row.earthquake,
        fell: row.fell == 1,
    };
    rows.into_iter().filter(|row| row.list == list).map(outcome).collect()
}

#[test]
fn calibrations_to_outcomes_are_those_of_scipy() {
    let answers: Vec<Answer> = read("outcomes_answers.csv");
    assert_eq!(answers.len(), 4);
    for answer in answers {
        let found = Calibration::fit_outcomes(&outcomes(&answer.list)).unwrap();
        assert_eq!((found.n, found.n_events), (answer.n, answer.n_events));
        for (value, expected) in [(found.c, answer.c), (found.ln_s, answer.ln_s), (found.m, answer.m)] {
            close(value, expected, 1e-6);
        }
        let Answer { v_00, v_01, v_02, v_11, v_12, v_22, .. } = answer;
        let covariance = [v_00, v_01, v_02, v_01, v_11, v_12, v_02, v_12, v_22];
        for (value, expected) in found.covariance.iter().zip(covariance) {
            assert!((value - expected).abs() < 1e-6, "{}: {value}; expected {expected}", answer.list);
        }
        // Limits of one earthquake keep the spread between earthquakes.
        let structure = &outcomes(&answer.list)[0].structure;
        assert_eq!(found.tau, Calibration::uncalibrated(MotionKind::Recorded, structure, None).tau);
    }
}

#[test]
fn lists_without_an_event_or_without_outcomes_say_so() {
    assert_eq!(Calibration::fit_outcomes(&[]), None);
    let uncalibrated = |list: &str| {
        let structure = &outcomes(list)[0].structure;
        Calibration::uncalibrated(MotionKind::Recorded, structure, None).c
    };
    for (list, sign) in [("stood", -1.0), ("fell", 1.0)] {
        let found = Calibration::fit_outcomes(&outcomes(list)).unwrap();
        assert!(sign * (found.c - uncalibrated(list)) > 0.1, "{list}");
        assert!(found.warnings().contains(&Warning::NoEvents), "{list}");
    }
    // What a motion does not uplift tells nothing.
    let mut unmoved = outcomes("stood");
    unmoved.iter_mut().for_each(|outcome| outcome.peaks.pga_m_s2 = 0.5);
    let found = Calibration::fit_outcomes(&unmoved).unwrap();
    close(found.c, uncalibrated("stood"), 1e-9);
    assert_eq!(found.n, 0);
}
