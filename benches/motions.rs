//! The 3500 combined motions of the paper's grid, and the Fourier transforms in them alone.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use realfft::RealFftPlanner;
use realfft::num_complex::Complex64;
use rockfrag::motion::{Design, Grid, IntensityScratch, MotionModel, Scenario, Suite, Synthesizer, measures};

/// Of each of the 35 cells of the paper's grid, which share what depends on magnitude and distance alone.
const SAMPLES: usize = 100;

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
    group.bench_function("synthesis and measures", |b| {
        b.iter(|| {
            for scenario in &scenarios {
                let motion = synthesizer.synthesize(scenario);
                std::hint::black_box(measures(&motion.combined, motion.dt_s, &mut scratch));
            }
        })
    });
    // Noise and pulse forwards, the motion backwards, and forwards again for its mean period, in memory at hand.
    let mut planner = RealFftPlanner::<f64>::new();
    let lengths = scenarios.iter().map(|scenario| synthesizer.synthesize(scenario).combined.len());
    let plans: Vec<_> =
        lengths.map(|length| (planner.plan_fft_forward(length), planner.plan_fft_inverse(length))).collect();
    let longest = plans.iter().map(|(forward, _)| forward.len()).max().expect("scenarios");
    let noise: Vec<f64> = (0..longest).map(|k| ((k * k) as f64).sin()).collect();
    let mut samples = noise.clone();
    let mut spectrum = vec![Complex64::ZERO; longest];
    let mut scratch = vec![Complex64::ZERO; longest];
    group.bench_function("transforms", |b| {
        b.iter(|| {
            for (forward, inverse) in &plans {
                let samples = &mut samples[..forward.len()];
                let spectrum = &mut spectrum[..forward.complex_len()];
                samples.copy_from_slice(&noise[..forward.len()]);
                for _ in 0..3 {
                    let scratch = &mut scratch[..forward.get_scratch_len()];
                    forward.process_with_scratch(samples, spectrum, scratch).expect("planned lengths");
                }
                if let [first, .., last] = spectrum {
                    (first.im, last.im) = (0.0, 0.0);
                }
                let scratch = &mut scratch[..inverse.get_scratch_len()];
                inverse.process_with_scratch(spectrum, samples, scratch).expect("planned lengths");
            }
        })
    });
    group.finish();
}

criterion_group!(benches, synthesis);
criterion_main!(benches);
