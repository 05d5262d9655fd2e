//! Prints fingerprints of motions, their measures and responses: the same on every processor (`scripts/processors.sh`).
//!
//! ```console
//! $ cargo run --release --no-default-features --example fingerprints
//! $ cargo run --release --no-default-features --example fingerprints scalar 2
//! ```
//!
//! The second one solves 64 motions twice with single numbers, so that instructions can be counted.

use rockfrag::keyword::Keyword;
use rockfrag::motion::{Design, Grid, IntensityScratch, MotionModel, Scenario, Suite, Synthesizer, measures};
use rockfrag::normal::{inverse_mills, ln_cdf, quantile};
use rockfrag::random::{Purpose, normals, stream};
use rockfrag::rocking::{Problem, Record, Response, Simd, Structure, simulate_all, trace};

#[derive(Default)]
struct Fingerprint(blake3::Hasher);

impl Fingerprint {
    fn add(&mut self, numbers: impl IntoIterator<Item = f64>) {
        for number in numbers {
            self.0.update(&number.to_bits().to_le_bytes());
        }
    }

    fn print(&self, name: &str) {
        println!("{name:10} {}", &self.0.finalize().to_hex()[..16]);
    }
}

/// A motion and its time step, s.
type Motion = (Vec<f64>, f64);

/// Combined motions of some magnitudes and distances.
fn synthetic(samples: usize) -> Vec<Motion> {
    let grid = Grid {
        mw: vec![5.5, 6.5, 7.5],
        re_km: vec![5.0, 10.0, 20.0],
        samples: samples.div_ceil(9),
        design: Design::Sobol,
        seed: 42,
    };
    let scenarios: Vec<Scenario> = (0..grid.cells()).flat_map(|cell| grid.scenarios_of_cell(cell)).collect();
    let model = MotionModel::default();
    let dt_s = model.dt_s;
    let mut synthesizer = Synthesizer::new(model, &[Suite::Csgm]);
    let motion = |scenario| (synthesizer.synthesize(scenario).combined.clone(), dt_s);
    scenarios.iter().take(samples).map(motion).collect()
}

/// A thousand motions of steps, spikes, noise and nothing, with structures from hardly rocking to overturning.
fn fuzzed() -> Vec<(Motion, Structure)> {
    let one = |row| {
        let mut random = normals(stream(3, Purpose::Noise, row));
        let mut next = |scale: f64| scale * random.next().unwrap_or_default();
        let spread = |x: f64, low: f64, high: f64| low + (high - low) * (x.abs() / 3.0).min(1.0);
        let (p, alpha) = (spread(next(1.0), 0.05, 20.0), spread(next(1.0), 1e-3, 1.5));
        let structure = Structure::new("fuzzed", p, alpha, spread(next(1.0), 1.0, 0.05));
        let structure = structure.expect("parameters within bounds");
        let (mut samples, mut level) = (Vec::new(), 0.0);
        while samples.len() < 300 {
            level = match row % 4 {
                0 => next(3.0),
                1 => level + next(1.0),
                2 if next(1.0) > 1.0 => next(90.0),
                3 if next(1.0) > 0.5 => structure.uplift_acceleration_m_s2() * next(1.0).signum(),
                _ => 0.0,
            };
            samples.push(level);
        }
        ((samples, spread(next(1.0), 1e-4, 0.1)), structure)
    };
    (0..1000).map(one).collect()
}

fn problem<'a>((samples, dt_s): &'a Motion, structure: &'a Structure) -> Problem<'a> {
    Problem { structure, record: Record::new(samples, *dt_s).expect("samples in m/s2 at equal steps") }
}

fn numbers(response: &Response) -> [f64; 3] {
    [response.edp, f64::from(response.impacts), response.outcome as u8 as f64]
}

fn main() {
    let structure = Structure::new("equipment", 2.5, 0.2, 0.92).expect("a structure of the paper");
    let mut arguments = std::env::args().skip(1);
    if let (Some(simd), Some(times)) = (arguments.next(), arguments.next()) {
        let simd = Simd::ALL.iter().copied().find(|known| known.as_str() == simd);
        let simd = simd.expect("scalar, neon, avx2 or avx512");
        let motions = synthetic(64);
        let problems: Vec<Problem> = motions.iter().map(|motion| problem(motion, &structure)).collect();
        for _ in 0..times.parse().expect("a number of times") {
            std::hint::black_box(simulate_all(&problems, simd));
        }
        return;
    }

    let (motions, fuzzed) = (synthetic(700), fuzzed());
    let (mut of_motions, mut of_measures) = (Fingerprint::default(), Fingerprint::default());
    let mut scratch = IntensityScratch::default();
    for (samples, dt_s) in &motions {
        of_motions.add(samples.iter().copied());
        let text = format!("{:?}", measures(samples, *dt_s, &mut scratch));
        of_measures.0.update(text.as_bytes());
    }
    of_motions.print("motions");
    of_measures.print("measures");

    let mut problems: Vec<Problem> = motions.iter().map(|motion| problem(motion, &structure)).collect();
    problems.extend(fuzzed.iter().map(|(motion, structure)| problem(motion, structure)));
    for &simd in Simd::ALL.iter().filter(|simd| simd.is_available()) {
        let mut of_responses = Fingerprint::default();
        of_responses.add(simulate_all(&problems, simd).iter().flat_map(numbers));
        of_responses.print(simd.as_str());
    }
    let mut of_traces = Fingerprint::default();
    for problem in &problems[..100] {
        let (_, points) = trace(problem.structure, &problem.record);
        of_traces.add(points.iter().flat_map(|at| [at.time_s, at.theta_rad, at.theta_dot_rad_s]));
    }
    of_traces.print("traces");

    let mut of_normal = Fingerprint::default();
    let steps = (-4000..4000).map(|k| f64::from(k) * 0.01);
    of_normal.add(steps.clone().flat_map(|x| [ln_cdf(x), inverse_mills(x)]));
    of_normal.add((1..10_000).map(|k| quantile(f64::from(k) * 1e-4)));
    of_normal.print("normal");
}
