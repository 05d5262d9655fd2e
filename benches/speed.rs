//! The solver and the motions of the paper's grid.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use rockfrag::motion::{Design, Grid, IntensityScratch, MotionModel, Scenario, Suite, Synthesizer, measures};
use rockfrag::rocking::{Problem, Record, Structure, reference, simulate_all};

/// Combined motions of some samples of each of the 35 cells.
fn scenarios(samples: usize) -> Vec<Scenario> {
    let grid = Grid {
        mw: vec![5.5, 6.0, 6.5, 7.0, 7.5],
        re_km: vec![5.0, 7.5, 10.0, 12.5, 15.0, 17.5, 20.0],
        samples,
        design: Design::Lhs,
        seed: 42,
    };
    (0..grid.cells()).flat_map(|cell| grid.scenarios_of_cell(cell)).collect()
}

fn synthesis(c: &mut Criterion) {
    let scenarios = scenarios(100);
    let mut synthesizer = Synthesizer::new(MotionModel::default(), &[Suite::Csgm]);
    let mut scratch = IntensityScratch::default();
    let mut group = c.benchmark_group("motions");
    group.throughput(Throughput::Elements(scenarios.len() as u64)).sample_size(10);
    group.bench_function("synthesis", |b| {
        b.iter(|| scenarios.iter().for_each(|scenario| drop(synthesizer.synthesize(scenario))))
    });
    group.bench_function("synthesis and measures", |b| {
        b.iter(|| {
            for scenario in &scenarios {
                let motion = synthesizer.synthesize(scenario);
                std::hint::black_box(measures(&motion.combined, motion.dt_s, &mut scratch));
            }
        })
    });
    group.finish();
}

fn solver(c: &mut Criterion) {
    let structure = Structure::new("electrical-equipment", 2.5, 0.20, 0.92).expect("the paper's");
    let mut synthesizer = Synthesizer::new(MotionModel::default(), &[Suite::Csgm]);
    let motions: Vec<Vec<f64>> =
        scenarios(10).iter().map(|scenario| synthesizer.synthesize(scenario).combined).collect();
    let record = |motion| Record::new(motion, 0.005).expect("samples in m/s2");
    let problems: Vec<Problem> =
        motions.iter().map(|motion| Problem { structure: &structure, record: record(motion) }).collect();
    let mut group = c.benchmark_group("solver");
    group.throughput(Throughput::Elements(problems.len() as u64)).sample_size(20);
    group.bench_function("vectors", |b| b.iter(|| simulate_all(&problems)));
    group.finish();
    let mut group = c.benchmark_group("reference");
    group.throughput(Throughput::Elements(10)).sample_size(10);
    group.bench_function("one after the other", |b| {
        b.iter(|| {
            problems[..10]
                .iter()
                .map(|problem| reference::solve(problem.structure, &problem.record, |_| {}))
                .collect::<Vec<_>>()
        })
    });
    group.finish();
}

criterion_group!(benches, synthesis, solver);
criterion_main!(benches);
