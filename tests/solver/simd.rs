//! One problem at a time and several at once, in registers of any width: the same bits, in any company and order.

use crate::noise::synthetic_motion;
use proptest::prelude::*;
use rockfrag::keyword::Keyword;
use rockfrag::rocking::{Outcome, Problem, Record, Response, Simd, Structure, fused, simulate, simulate_all};

/// The registers that this processor has, of one number first.
fn all_registers() -> impl Iterator<Item = Simd> {
    Simd::ALL.iter().copied().filter(|simd| simd.is_available())
}

/// Structures from hardly rocking to overturning.
fn structures() -> Vec<Structure> {
    let grid = [0.5, 1.0, 2.5, 4.0].into_iter().flat_map(|p| {
        [0.02, 0.1, 0.2, 0.35].into_iter().flat_map(move |alpha| [0.6, 0.92, 1.0].map(|eta| (p, alpha, eta)))
    });
    grid.map(|(p, alpha, eta)| Structure::new("s", p, alpha, eta).unwrap()).collect()
}

fn motions(count: u64) -> Vec<Vec<f64>> {
    // Of different lengths, so that lanes come free at different times.
    (1..=count).map(|seed| synthetic_motion(seed, 100 + (seed as usize * 37) % 300)).collect()
}

fn problems<'a>(motions: &'a [Vec<f64>], structures: &'a [Structure], dt_s: f64) -> Vec<Problem<'a>> {
    let records = motions.iter().map(|samples| Record::new(samples, dt_s).unwrap());
    records.flat_map(|record| structures.iter().map(move |structure| Problem { structure, record })).collect()
}

/// The bits of the demands, and the counts.
fn bits(responses: &[Response]) -> Vec<(Outcome, u64, u32)> {
    responses.iter().map(|response| (response.outcome, response.edp.to_bits(), response.impacts)).collect()
}

#[test]
fn registers_of_any_width_give_the_same_bits() {
    let (motions, structures) = (motions(60), structures());
    for dt_s in [0.005, 0.02, 0.1] {
        let problems = problems(&motions, &structures, dt_s);
        let answers: Vec<Response> =
            problems.iter().map(|problem| simulate(problem.structure, &problem.record)).collect();
        let of = |outcome| answers.iter().filter(|response| response.outcome == outcome).count();
        println!("dt {dt_s}: {} safe, {} overturned", of(Outcome::SafeRocking), of(Outcome::Overturning));
        for simd in all_registers() {
            assert_eq!(bits(&simulate_all(&problems, simd)), bits(&answers), "{simd:?}");
        }
    }
}

#[test]
fn an_answer_does_not_depend_on_the_company() {
    let (motions, structures) = (motions(12), structures());
    let problems = problems(&motions, &structures, 0.02);
    for simd in all_registers() {
        let together = simulate_all(&problems, simd);
        for size in [1, 3, 17] {
            let apart: Vec<Response> =
                problems.chunks(size).flat_map(|some| simulate_all(some, simd)).collect();
            assert_eq!(apart, together, "{simd:?}, {size} at a time");
        }
        let backwards: Vec<Problem> = problems.iter().rev().copied().collect();
        let mut backwards = simulate_all(&backwards, simd);
        backwards.reverse();
        assert_eq!(backwards, together, "{simd:?}");
    }
}

/// The same acceleration, linear between samples, in `parts` times as many steps.
fn finer(samples: &[f64], parts: usize) -> Vec<f64> {
    let between = |pair: &[f64]| {
        let (start, end) = (pair[0], pair[1]);
        (0..parts).map(move |k| start + (end - start) * k as f64 / parts as f64).collect::<Vec<f64>>()
    };
    samples.windows(2).flat_map(between).chain(samples.last().copied()).collect()
}

#[test]
fn a_record_of_few_samples_says_what_many_say() {
    // A fast structure, which takes many Taylor steps between two samples; and a slow one, which turns and strikes its base
    // within a step.
    let levels = [0.0, 1.5, 0.2, -0.5, 0.0, 0.0];
    let zigzag: Vec<f64> = (0..60).map(|k| f64::from((k * 37 + k * k * 5) % 23) / 2.3 - 5.0).collect();
    for (p, alpha, levels, parts) in
        [(8.0, 0.2, &levels[..], 64), (8.0, 1e-3, &levels, 64), (0.02, 0.1, &zigzag, 16)]
    {
        let structure = Structure::new("s", p, alpha, 0.9).unwrap();
        let uplift = structure.uplift_acceleration_m_s2();
        let samples: Vec<f64> = levels.iter().map(|level| level * uplift).collect();
        let fine = finer(&samples, parts);
        let problem =
            |samples, dt_s| Problem { structure: &structure, record: Record::new(samples, dt_s).unwrap() };
        let problems = [problem(&samples, 0.1), problem(&fine, 0.1 / parts as f64)];
        for simd in all_registers() {
            let [few, many] = simulate_all(&problems, simd)[..] else { panic!("two answers") };
            assert_eq!(few.outcome, Outcome::SafeRocking, "{simd:?} {p}");
            assert_eq!((few.outcome, few.impacts), (many.outcome, many.impacts), "{simd:?} {p}");
            assert!((few.edp / many.edp - 1.0).abs() < 1e-10, "{simd:?} {p}: {few:?} {many:?}");
        }
    }
}

#[test]
fn no_problems_give_no_answers() {
    for simd in all_registers() {
        assert_eq!(simulate_all(&[], simd), []);
    }
}

#[test]
fn an_uplift_between_the_last_two_samples_is_answered() {
    let s = Structure::new("s", 2.0, 0.2, 0.9).unwrap();
    let uplift = s.uplift_acceleration_m_s2();
    for samples in [vec![0.0, 1.5 * uplift], vec![2.0 * uplift, 0.0], vec![uplift * (1.0 + 1e-12); 3]] {
        let problem = Problem { structure: &s, record: Record::new(&samples, 0.01).unwrap() };
        for simd in all_registers() {
            let [answer] = simulate_all(&[problem], simd)[..] else { panic!("one answer") };
            assert_eq!(answer.outcome, Outcome::SafeRocking, "{simd:?} {samples:?}");
            assert!(
                answer.impacts == 0 && answer.edp > 0.0 && answer.edp < 0.1,
                "{simd:?} {samples:?} {answer:?}"
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    #[test]
    fn every_record_has_the_same_answer_with_each_simd(
        samples in prop::collection::vec(
            prop_oneof![Just(0.0), -100.0..100.0f64, -3.0..3.0f64, Just(1e-310), Just(1.5)], 2..60,
        ),
        dt in prop_oneof![Just(1e-5), Just(0.1), 0.001..0.05f64],
        p in 0.1..10.0f64, alpha in 0.01..1.5f64, eta in 0.05..=1.0f64,
    ) {
        let structure = Structure::new("s", p, alpha, eta).unwrap();
        let problem = Problem { structure: &structure, record: Record::new(&samples, dt).unwrap() };
        let scalar = [simulate(&structure, &problem.record)];
        for simd in all_registers() {
            prop_assert_eq!(bits(&simulate_all(&[problem], simd)), bits(&scalar), "{:?}", simd);
        }
    }

    #[test]
    fn mirrored_motions_have_the_same_peak(seed in 1u64..10_000, p in 0.5..4.0f64, alpha in 0.05..0.35f64) {
        let structure = Structure::new("s", p, alpha, 0.92).unwrap();
        let samples = synthetic_motion(seed, 200);
        let mirrored: Vec<f64> = samples.iter().map(|a| -a).collect();
        let problem = |samples| Problem { structure: &structure, record: Record::new(samples, 0.02).unwrap() };
        for simd in all_registers() {
            let answers = simulate_all(&[problem(&samples), problem(&mirrored)], simd);
            prop_assert_eq!(answers[0], answers[1]);
        }
    }
}

#[test]
fn fused_bits_are_those_of_the_processor_or_the_library() {
    let mut state = 1_u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        state
    };
    for case in 0..2_000_000 {
        // Exponents near each other, where digits cancel, and any.
        let mut number = |spread: u64| {
            let (mantissa, exponent) = (next() >> 12, 1023 - spread / 2 + (next() >> 32) % spread);
            let thin = if next() >> 62 == 0 { mantissa & !0xfff_ffff_ffff } else { mantissa };
            f64::from_bits((next() >> 63) << 63 | exponent << 52 | thin)
        };
        let spread = [4, 120, 2000][case % 3];
        let (a, b) = (number(spread), number(spread));
        let c = match case % 5 {
            0 => -a * b,
            1 => -a * b * (1.0 + f64::EPSILON),
            2 => 0.0,
            _ => number(spread),
        };
        let (ours, theirs) = (fused::mul_add(a, b, c), a.mul_add(b, c));
        assert_eq!(ours.to_bits(), theirs.to_bits(), "{a:e} {b:e} {c:e}: {ours:e} for {theirs:e}");
    }
}
