//! Calibrations to what stood and what fell, against those of scripts/universal/calibration.py
//! (scripts/reference/outcomes.py).

use rockfrag_core::fragility::{Calibration, MotionKind, ObservedOutcome};
use rockfrag_core::motion::Peaks;
use rockfrag_core::rocking::Structure;
use rockfrag_core::warning::Warning;

use crate::common::{Row, close, expect_covariance, read};

fn outcomes(list: &str) -> Vec<ObservedOutcome> {
    let outcome = |row: &Row| ObservedOutcome {
        structure: Structure::rectangular_block("stone", row.get("width"), row.get("height"), None).unwrap(),
        peaks: Peaks { pga_m_s2: row.get("pga_m_s2"), pgv_m_s: row.get("pgv_m_s") },
        mw: Some(row.get("mw")),
        earthquake: row.get("earthquake"),
        fell: row.text("fell") == "1",
    };
    read::<Row>("outcomes.csv").iter().filter(|row| row.text("list") == list).map(outcome).collect()
}

fn uncalibrated(list: &str) -> Calibration {
    Calibration::uncalibrated(MotionKind::Recorded, &outcomes(list)[0].structure, None)
}

#[test]
fn calibrations_to_outcomes_are_those_of_the_scripts() {
    let answers: Vec<Row> = read("outcomes_answers.csv");
    assert_eq!(answers.len(), 4);
    for answer in answers {
        let found = Calibration::fit_outcomes(&outcomes(answer.text("list"))).unwrap();
        assert_eq!([found.n, found.n_events], ["n", "n_events"].map(|name| answer.get::<i64>(name)));
        for (value, column) in [(found.c, "c"), (found.ln_s, "ln_s"), (found.m, "m")] {
            close(value, answer.get(column), 1e-6);
        }
        expect_covariance(&found, &answer, "v", 1e-6);
        // Limits of one earthquake keep the spread between earthquakes.
        assert_eq!(found.tau, uncalibrated(answer.text("list")).tau);
    }
}

#[test]
fn lists_without_an_event_or_without_outcomes_say_so() {
    assert_eq!(Calibration::fit_outcomes(&[]), None);
    for (list, sign) in [("stood", -1.0), ("fell", 1.0)] {
        let found = Calibration::fit_outcomes(&outcomes(list)).unwrap();
        assert!(sign * (found.c - uncalibrated(list).c) > 0.1, "{list}");
        assert!(found.warnings().contains(&Warning::NoEvents), "{list}");
    }
    // What a motion does not uplift tells nothing.
    let mut unmoved = outcomes("stood");
    unmoved.iter_mut().for_each(|outcome| outcome.peaks.pga_m_s2 = 0.5);
    let found = Calibration::fit_outcomes(&unmoved).unwrap();
    close(found.c, uncalibrated("stood").c, 1e-9);
    assert_eq!(found.n, 0);
}
