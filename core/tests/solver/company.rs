//! A response is the same to the last bit, whatever the other problems, their order and the number of
//! threads.

use rayon::prelude::*;
use rockfrag_core::rocking::{Problem, Record, Response, Structure, simulate, simulate_all};

use crate::shared::{noise, respond};

/// Structures from little rocking to overturning.
fn structures() -> Vec<Structure> {
    let grid = [0.5, 1.0, 2.5, 4.0].into_iter().flat_map(|p| {
        [0.02, 0.1, 0.2, 0.35].into_iter().flat_map(move |alpha| [0.6, 0.92, 1.0].map(|eta| (p, alpha, eta)))
    });
    grid.map(|(p, alpha, eta)| Structure::new("s", p, alpha, eta).unwrap()).collect()
}

#[test]
fn an_answer_does_not_depend_on_company_order_or_threads() {
    // Different lengths free the lanes at different times.
    let motions: Vec<Vec<f64>> = (1..=12).map(|seed| noise(seed, 100 + (seed as usize * 37) % 300)).collect();
    let structures = structures();
    let records = motions.iter().map(|samples| Record::new(samples, 0.02).unwrap());
    let problems: Vec<Problem> = records
        .flat_map(|record| structures.iter().map(move |structure| Problem { structure, record }))
        .collect();
    let together = simulate_all(&problems);
    let alone: Vec<Response> = problems.iter().map(|p| simulate(p.structure, &p.record)).collect();
    assert_eq!(alone, together);
    let mut backwards = simulate_all(&problems.iter().rev().copied().collect::<Vec<_>>());
    backwards.reverse();
    assert_eq!(backwards, together);
    for (threads, size) in [(1, 17), (2, 3), (2, 64), (3, 5), (3, 17)] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let apart: Vec<Response> =
            pool.install(|| problems.par_chunks(size).flat_map_iter(simulate_all).collect());
        assert_eq!(apart, together, "{threads} threads, {size} at a time");
    }
    assert_eq!(simulate_all(&[]), []);
}

#[test]
fn an_uplift_between_the_last_two_samples_is_answered() {
    let s = Structure::new("s", 2.0, 0.2, 0.9).unwrap();
    let uplift = s.uplift_acceleration_m_s2();
    for samples in [vec![0.0, 1.5 * uplift], vec![2.0 * uplift, 0.0], vec![uplift * (1.0 + 1e-12); 3]] {
        let Response { outcome, impacts } = respond(&s, &samples, 0.01);
        let is_small = outcome.demand().is_some_and(|demand| 0.0 < demand && demand < 0.1);
        assert!(is_small && impacts == 0, "{samples:?} {outcome:?}");
    }
}
