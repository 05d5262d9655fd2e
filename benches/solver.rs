//! The solver with each of its vector instructions, the processor's own limit, and many structures on each motion.

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use pulp::{Arch, WithSimd};
use rockfrag::keyword::Keyword;
use rockfrag::motion::{Design, Grid, MotionModel, Scenario, Suite, Synthesizer};
use rockfrag::rocking::{Problem, Record, Response, Simd, Structure, simulate_all};
use rockfrag::table::motions::MotionBatches;

/// The motions to run: a file that ROCKFRAG_MOTIONS names, or some made here.
const MOTIONS: &str = "ROCKFRAG_MOTIONS";

struct Motion {
    samples: Vec<f64>,
    dt_s: f64,
}

impl Motion {
    fn record(&self) -> Record<'_> {
        Record::new(&self.samples, self.dt_s).expect("samples in m/s2 at equal steps")
    }
}

fn motions() -> Vec<Motion> {
    match std::env::var(MOTIONS) {
        Ok(path) => read(path.as_ref()),
        Err(_) => synthesized(),
    }
}

fn read(path: &std::path::Path) -> Vec<Motion> {
    let batches = MotionBatches::open(path, 256).expect("a motions file");
    let motions = batches.flat_map(|batch| batch.expect("a whole motions file"));
    let motion = |motion: rockfrag::table::motions::Motion| Motion {
        samples: motion.acceleration_m_s2.to_vec(),
        dt_s: motion.dt_s,
    };
    motions.map(motion).collect()
}

/// Six combined motions of each cell of a small grid.
fn synthesized() -> Vec<Motion> {
    let grid = Grid {
        mw: vec![5.5, 6.5, 7.5],
        re_km: vec![5.0, 10.0, 20.0],
        samples: 6,
        design: Design::Lhs,
        seed: 42,
    };
    let scenarios: Vec<Scenario> = (0..grid.cells()).flat_map(|cell| grid.scenarios_of_cell(cell)).collect();
    let model = MotionModel::default();
    let dt_s = model.dt_s;
    let mut synthesizer = Synthesizer::new(model, &[Suite::Csgm]);
    let motion = |scenario| Motion { samples: synthesizer.synthesize(scenario).combined.clone(), dt_s };
    scenarios.iter().map(motion).collect()
}

fn paper_structure() -> Structure {
    Structure { name: "electrical-equipment".into(), p_rad_s: 2.5, alpha_rad: 0.20, eta: 0.92 }
}

fn paths(c: &mut Criterion) {
    let (motions, structure) = (motions(), paper_structure());
    let problem = |motion| Problem { structure: &structure, record: Motion::record(motion) };
    let problems: Vec<Problem> = motions.iter().map(problem).collect();
    let mut group = c.benchmark_group("solver");
    group.throughput(Throughput::Elements(problems.len() as u64)).sample_size(20);
    for simd in Simd::ALL.iter().copied().filter(|simd| simd.is_available()) {
        group.bench_function(simd.as_str(), |b| b.iter(|| simulate_all(&problems, simd)));
    }
    group.finish();
}

/// As many motions as the grid of structures runs on: one analysis takes some 20 us.
const MOST_IN_GRID: usize = 350;

/// Four hundred structures: all on a motion while it is in cache, or one after the other over all motions.
fn structures(c: &mut Criterion) {
    let mut structures = Vec::new();
    for p_rad_s in (0..10).map(|k| 0.5 + 0.35 * f64::from(k)) {
        for alpha_rad in (0..10).map(|k| 0.05 + 0.03 * f64::from(k)) {
            for eta in [0.80, 0.86, 0.92, 0.98] {
                structures.push(Structure { name: String::new(), p_rad_s, alpha_rad, eta });
            }
        }
    }
    let mut motions = motions();
    motions.truncate(MOST_IN_GRID);
    let each = |motion: &Motion| -> Vec<Response> {
        let record = motion.record();
        let problems: Vec<Problem> =
            structures.iter().map(|structure| Problem { structure, record }).collect();
        simulate_all(&problems, Simd::fastest())
    };
    let mut group = c.benchmark_group("structures");
    let analyses = (motions.len() * structures.len()) as u64;
    group.throughput(Throughput::Elements(analyses)).sample_size(10);
    group.bench_function("grid", |b| b.iter(|| motions.iter().map(each).collect::<Vec<_>>()));
    group.bench_function("one-by-one", |b| {
        b.iter(|| {
            for structure in &structures {
                let problem = |motion| Problem { structure, record: Motion::record(motion) };
                let problems: Vec<Problem> = motions.iter().map(problem).collect();
                std::hint::black_box(simulate_all(&problems, Simd::fastest()));
            }
        })
    });
    group.finish();
}

/// Fused multiply-adds that wait for nothing.
struct MultiplyAdds;

const CHAINS: usize = 12;
const LENGTH: usize = 100_000;

impl WithSimd for MultiplyAdds {
    /// How many of one lane.
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, simd: S) -> f64 {
        let (factor, addend) = (simd.splat_f64s(std::hint::black_box(0.999)), simd.splat_f64s(0.001));
        let mut chains = [simd.splat_f64s(1.0); CHAINS];
        for _ in 0..LENGTH {
            for chain in &mut chains {
                *chain = simd.mul_add_f64s(*chain, factor, addend);
            }
        }
        chains.iter().map(|&chain| simd.reduce_sum_f64s(chain)).sum()
    }
}

fn peak(c: &mut Criterion) {
    let mut group = c.benchmark_group("processor");
    let lanes = match Simd::fastest() {
        Simd::Avx512 => 8,
        Simd::Avx2 => 4,
        Simd::Neon => 2,
        Simd::Scalar => 1,
    };
    group.throughput(Throughput::Elements((LENGTH * CHAINS * lanes) as u64)).sample_size(20);
    group.bench_function("multiply-adds", |b| b.iter(|| Arch::new().dispatch(MultiplyAdds)));
    group.finish();
}

criterion_group!(benches, paths, structures, peak);
criterion_main!(benches);
