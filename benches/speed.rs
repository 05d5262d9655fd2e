//! Times the solver and the motions of the paper's grid on one core: cargo bench --bench speed. Prints
//! medians as JSON.

use std::hint::black_box;
use std::time::Instant;

use rockfrag_core::motion::{Design, MeasurePlan, MotionModel, Scenario, ScenarioGrid, Suite, Synthesizer};
use rockfrag_core::rocking::{Problem, Record, Structure, simulate_all, trace};

/// Combined motions of some samples of each of the 35 cells.
fn scenarios(samples: usize) -> Vec<Scenario> {
    let grid = ScenarioGrid {
        mw: vec![5.5, 6.0, 6.5, 7.0, 7.5],
        re_km: vec![5.0, 7.5, 10.0, 12.5, 15.0, 17.5, 20.0],
        samples,
        design: Design::Lhs,
        seed: 42,
    };
    (0..grid.cells()).flat_map(|cell| grid.scenarios_of_cell(cell)).collect()
}

/// The median of nine runs, in microseconds for each of `count` pieces of work.
fn median_us(count: usize, mut work: impl FnMut()) -> f64 {
    let run = |_| {
        let start = Instant::now();
        work();
        1e6 * start.elapsed().as_secs_f64() / count as f64
    };
    let mut times: Vec<f64> = (0..9).map(run).collect();
    times.sort_by(f64::total_cmp);
    times[4]
}

fn main() {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("the first pool");
    let scenarios = scenarios(20);
    let mut synthesizer = Synthesizer::new(MotionModel::default(), &[Suite::Csgm]);
    let synthesis = median_us(scenarios.len(), || {
        for scenario in &scenarios {
            let motion = synthesizer.synthesize(scenario);
            black_box(MeasurePlan::default().measure(&motion.combined, motion.dt_s));
        }
    });
    let structure = Structure::new("electrical-equipment", 2.5, 0.20, 0.92).expect("the paper's");
    let motions: Vec<Vec<f64>> =
        scenarios.iter().map(|scenario| synthesizer.synthesize(scenario).combined).collect();
    let record = |motion| Record::new(motion, 0.005).expect("samples in m/s2");
    let problems: Vec<Problem> =
        motions.iter().map(|motion| Problem { structure: &structure, record: record(motion) }).collect();
    let solver = median_us(problems.len(), || drop(black_box(simulate_all(&problems))));
    let scalar = median_us(10, || {
        for problem in &problems[..10] {
            black_box(trace(problem.structure, &problem.record, 0.0));
        }
    });
    println!(
        "{{\"synthesis_us\": {synthesis:.2}, \"solver_us\": {solver:.3}, \"reference_us\": {scalar:.1}}}"
    );
}
