//! The vector solver against the readable one (Eqs. 4 to 6: motion, uplift, impact).

use std::mem::discriminant;

use rockfrag_core::motion::{Design, MotionModel, ScenarioGrid, Suite, Synthesizer};
use rockfrag_core::rocking::{Outcome, Problem, Record, Response, Structure, reference, simulate_all};

#[test]
fn vectors_solve_the_equations_of_the_paper() {
    let (mw, re_km) = (vec![5.5, 6.5, 7.5], vec![5.0, 10.0, 20.0]);
    let grid = ScenarioGrid { mw, re_km, samples: 8, design: Design::Lhs, seed: 42 };
    let mut synthesizer = Synthesizer::new(MotionModel::default(), &[Suite::Csgm]);
    let scenarios = (0..grid.cells()).flat_map(|cell| grid.scenarios_of_cell(cell));
    let motions: Vec<Vec<f64>> =
        scenarios.map(|scenario| synthesizer.synthesize(&scenario).combined).collect();
    let structures = [(1.0, 0.15, 0.92), (2.5, 0.20, 0.92), (4.0, 0.10, 0.97)]
        .map(|(p, alpha, eta)| Structure::new("s", p, alpha, eta).unwrap());
    let records = motions.iter().map(|samples| Record::new(samples, 0.005).unwrap());
    let problems: Vec<Problem> = records
        .flat_map(|record| structures.iter().map(move |structure| Problem { structure, record }))
        .collect();
    let plain =
        problems.iter().map(|problem| reference::solve(problem.structure, &problem.record, 0.0, |_| {}));
    let compared: Vec<(Response, Response)> = simulate_all(&problems).into_iter().zip(plain).collect();
    let overturning = compared.iter().filter(|(vector, _)| vector.outcome == Outcome::Overturned).count();
    let demands = |(vector, plain): &(Response, Response)| {
        Some((vector.outcome.demand().filter(|demand| *demand > 0.0)?, plain.outcome.demand()?))
    };
    let rocking: Vec<(f64, f64)> = compared.iter().filter_map(demands).collect();
    let safe = rocking.len();
    assert!(safe > 80 && overturning > 40, "{safe} {overturning} of {}", compared.len());
    // Rocking near separatrices is chaotic: a few cases in a hundred amplify any difference of methods.
    let is_other = |(vector, plain): &&(Response, Response)| {
        discriminant(&vector.outcome) != discriminant(&plain.outcome)
    };
    let outcomes = compared.iter().filter(is_other).count();
    let impacts =
        compared.iter().filter(|(vector, plain)| vector.impacts.abs_diff(plain.impacts) > 1).count();
    let mut errors: Vec<f64> = rocking.iter().map(|(vector, plain)| (vector / plain - 1.0).abs()).collect();
    errors.sort_by(f64::total_cmp);
    let at = |share: f64| errors[((errors.len() - 1) as f64 * share) as usize];
    assert!(outcomes <= 1 && impacts <= compared.len() / 20, "{outcomes} {impacts}");
    assert!(at(0.5) < 1e-11 && at(0.9) < 1e-8, "{:e} {:e}", at(0.5), at(0.9));
}
