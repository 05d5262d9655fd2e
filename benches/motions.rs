//! Combined motions of the paper's grid, and the Fourier transforms in them alone.

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use realfft::RealFftPlanner;
use rockfrag::motion::{Design, Grid, IntensityScratch, MotionModel, Scenario, Suite, Synthesizer, measures};

/// Of each of the 35 cells of the paper's grid.
const SAMPLES: usize = 6;

fn scenarios() -> Vec<Scenario> {
    let grid = Grid {
        mw: vec![5.5, 6.0, 6.5, 7.0, 7.5],
        re_km: vec![5.0, 7.5, 10.0, 12.5, 15.0, 17.5, 20.0],
        samples: SAMPLES,
        design: Design::Lhs,
        seed: 42,
    };
    (0..grid.cells()).flat_map(|cell| grid.scenarios_of_cell(cell)).collect()
}

fn synthesis(c: &mut Criterion) {
    let scenarios = scenarios();
    let mut group = c.benchmark_group("motions");
    group.throughput(Throughput::Elements(scenarios.len() as u64)).sample_size(20);
    let mut synthesizer = Synthesizer::new(MotionModel::default(), &[Suite::Csgm]);
    let mut scratch = IntensityScratch::default();
    group.bench_function("synthesis", |b| {
        b.iter(|| {
            for scenario in &scenarios {
                std::hint::black_box(synthesizer.synthesize(scenario));
            }
        })
    });
    let motions: Vec<Vec<f64>> =
        scenarios.iter().map(|scenario| synthesizer.synthesize(scenario).combined.clone()).collect();
    group.bench_function("measures", |b| {
        b.iter(|| {
            for motion in &motions {
                std::hint::black_box(measures(motion, 0.005, &mut scratch));
            }
        })
    });
    // Noise and pulse forwards, the motion backwards, and forwards again for its mean period.
    let mut planner = RealFftPlanner::<f64>::new();
    let mut plans: Vec<_> = motions
        .iter()
        .map(|motion| (planner.plan_fft_forward(motion.len()), planner.plan_fft_inverse(motion.len())))
        .map(|(forward, inverse)| (forward.make_output_vec(), forward.make_scratch_vec(), forward, inverse))
        .collect();
    group.bench_function("transforms", |b| {
        b.iter_batched_ref(
            || motions.clone(),
            |motions| {
                for (motion, (spectrum, scratch, forward, inverse)) in motions.iter_mut().zip(&mut plans) {
                    for _ in 0..3 {
                        forward.process_with_scratch(motion, spectrum, scratch).expect("planned lengths");
                    }
                    let (last, first) = (spectrum.len() - 1, 0);
                    (spectrum[first].im, spectrum[last].im) = (0.0, 0.0);
                    scratch.resize(inverse.get_scratch_len().max(scratch.len()), Default::default());
                    let needed = inverse.get_scratch_len();
                    inverse
                        .process_with_scratch(spectrum, motion, &mut scratch[..needed])
                        .expect("planned lengths");
                }
            },
            BatchSize::LargeInput,
        )
    });
    group.finish();
}

criterion_group!(benches, synthesis);
criterion_main!(benches);
