//! Responses as columns: what counts, clusters, and structures that are not one.

use rockfrag_core::fragility::{Case, Cases, Cluster, Event, Measure};
use rockfrag_core::rocking::Outcome;
use rockfrag_core::statistics::Range;

use crate::common::{cases, equipment};

#[test]
fn events_count_the_branches_of_the_tree() {
    for (event, expected) in [
        (Event::Rocking, [Some(false), Some(true), Some(true), Some(true)]),
        (Event::Overturning, [None, Some(false), Some(false), Some(true)]),
        (Event::Exceeding, [None, Some(false), Some(true), None]),
        (Event::Failure, [None, Some(false), Some(true), Some(true)]),
    ] {
        let outcomes =
            [Outcome::NoRocking, Outcome::SafeRocking(0.05), Outcome::SafeRocking(0.2), Outcome::Overturned];
        let happened = outcomes.map(|outcome| event.happened(outcome, 0.1));
        assert_eq!(happened, expected, "{event:?}");
    }
}

#[test]
fn only_cases_with_a_demand_and_all_measures_are_fitted() {
    let mut cases = cases([
        (Outcome::NoRocking, 0.5, 1.0, 0),
        (Outcome::SafeRocking(0.2), 1.5, 2.0, 1),
        (Outcome::SafeRocking(0.0), 1.6, 2.0, 1),
        (Outcome::Overturned, 3.0, 2.0, 2),
        (Outcome::SafeRocking(1e-9), 2.5, 4.0, 2),
    ]);
    cases.raise_rotations(1e-6 * cases.structure.alpha_rad);
    let sample = cases.sample(&[Measure::Im4, Measure::Im3Inverse], Case::ln_demand);
    assert_eq!(sample.y, [0.2f64.ln(), 1e-6f64.ln(), 1e-6f64.ln()]);
    assert_eq!(sample.clusters, [1, 1, 2]);
    assert_eq!(sample.ranges, [Range { low: 1.5, high: 2.5 }, Range { low: 0.25, high: 0.5 }]);
    assert_eq!([0, 3].map(|k| cases.all[k].outcome), [Outcome::NoRocking, Outcome::Overturned]);
    assert!(cases.sample(&[Measure::Im1], |_| Some(())).y.is_empty());
}

#[test]
fn clusters_do_not_depend_on_the_order_of_rows() {
    let motions = [
        (Some("Kobe"), Some(7.0), 2.0),
        (None, Some(6.0), 9.0),
        (None, None, 2.0),
        (Some("Imperial Valley"), Some(7.0), 2.0),
        (None, Some(6.0), 9.0),
        (None, None, 2.0),
    ];
    let clusters = |order: &[usize]| {
        let case = cases([(Outcome::NoRocking, 1.0, 1.0, 0)]).all[0];
        let mut cases = Cases::new(None, equipment());
        for (earthquake, mw, re_km) in order.iter().map(|&k| motions[k]) {
            cases.push(case, Cluster::new(earthquake, mw, Some(re_km)));
        }
        cases.sort_clusters();
        cases.all.iter().map(|case| case.cluster).collect::<Vec<u32>>()
    };
    assert_eq!(clusters(&[0, 1, 2, 3, 4, 5]), [1, 2, 3, 0, 2, 4]);
    assert_eq!(clusters(&[4, 3, 0, 1]), [2, 0, 1, 2]);
    assert_eq!(clusters(&[4, 2, 1]), [0, 1, 0]);
    assert_eq!(clusters(&[5, 2]), [0, 1]);
}
