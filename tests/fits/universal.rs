//! The surface that is shipped, against what Python reads from the same file (scripts/universal/write.py).

use rockfrag::fragility::universal::{self, Scenarios};
use rockfrag::fragility::{Measure, Probability, UniversalModel, p_failure_given_rocking};
use rockfrag::motion::{IntensityMeasures, Suite};
use rockfrag::rocking::Structure;

fn structure(p: f64, alpha: f64, eta: f64) -> Structure {
    Structure::new("any", p, alpha, eta).unwrap()
}

fn measures(structure: &Structure, pga_m_s2: f64, pgv_m_s: f64) -> IntensityMeasures {
    IntensityMeasures::new(structure, pga_m_s2, pgv_m_s, None, None)
}

const MODEL: UniversalModel = UniversalModel { limit: 0.1, motions: Suite::Csgm, scenarios: Scenarios::One };

#[test]
fn indices_are_those_of_python() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/reference/fits/universal_answers.csv");
    let text = std::fs::read_to_string(path).unwrap();
    let rows: Vec<Vec<f64>> =
        text.lines().skip(1).map(|row| row.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), 200);
    for row in rows {
        let [p, alpha, eta, limit, kind, pga, pgv, ro, se_ro, ex, se_ex] = row[..] else { panic!("{row:?}") };
        let model = UniversalModel { limit, motions: Suite::SYNTHETIC[kind as usize], ..MODEL };
        let structure = structure(p, alpha, eta);
        let [overturning, exceeding] = model.indices(&structure, &measures(&structure, pga, pgv)).unwrap();
        for (ours, theirs) in [
            (overturning.value, ro),
            (overturning.standard_error(), se_ro),
            (exceeding.value, ex),
            (exceeding.standard_error(), se_ex),
        ] {
            assert!((ours - theirs).abs() < 1e-8 * theirs.abs().max(1.0), "{ours} {theirs}: {row:?}");
        }
    }
}

#[test]
fn the_branches_are_joined_by_the_tree() {
    let block = Structure::rectangular_block("block", 0.5, 2.0, None).unwrap();
    for (pga, pgv) in [(3.0, 0.2), (5.0, 0.6), (9.0, 1.5), (20.0, 5.0)] {
        let given = MODEL.probabilities(&block, &measures(&block, pga, pgv)).given_rocking.unwrap();
        let joined = p_failure_given_rocking(given.p_ro.value, given.p_ex.value);
        assert!((given.p_failure.value - joined).abs() < 1e-12);
        for Probability { value, low, high } in [given.p_ro, given.p_ex, given.p_failure] {
            assert!(0.0 <= low && low <= value && value <= high && high <= 1.0, "{value} {low} {high}");
        }
    }
}

#[test]
fn over_many_scenarios_less_is_unknown() {
    let block = Structure::rectangular_block("block", 0.5, 2.0, None).unwrap();
    let of = |scenarios| {
        let model = UniversalModel { scenarios, ..MODEL };
        model.probabilities(&block, &measures(&block, 5.0, 0.6)).given_rocking.unwrap()
    };
    let (one, many) = (of(Scenarios::One), of(Scenarios::Many));
    for (one, many) in [(one.p_ro, many.p_ro), (one.p_ex, many.p_ex), (one.p_failure, many.p_failure)] {
        assert_eq!(one.value, many.value);
        assert!(one.low < many.low && many.low < many.value && many.high < one.high);
    }
}

#[test]
fn without_rocking_nothing_fails_and_without_velocity_nothing_is_known() {
    let equipment = structure(2.5, 0.2, 0.92);
    let still = MODEL.probabilities(&equipment, &measures(&equipment, 1.9, 0.5));
    assert_eq!(still.limit_states(), Some([Probability::exact(0.0); 3]));
    assert_eq!(MODEL.probabilities(&equipment, &measures(&equipment, 5.0, 0.0)).limit_states(), None);
}

#[test]
fn more_restitution_overturns_more_and_a_larger_limit_is_exceeded_less() {
    for p in [0.6, 1.5, 4.0] {
        for alpha in [0.06, 0.15, 0.4] {
            let index = |eta: f64, limit: f64| {
                let structure = structure(p, alpha, eta);
                let strong = 2.5 * structure.uplift_acceleration_m_s2();
                let pgv = 0.8 * structure.uplift_acceleration_m_s2() / p;
                let model = UniversalModel { limit, ..MODEL };
                let indices = model.indices(&structure, &measures(&structure, strong, pgv)).unwrap();
                indices.map(|index| index.value)
            };
            assert!(index(0.95, 0.1)[0] > index(0.75, 0.1)[0], "p {p}, alpha {alpha}");
            assert!(index(0.9, 0.3)[1] < index(0.9, 0.1)[1], "p {p}, alpha {alpha}");
        }
    }
}

#[test]
fn what_lies_outside_of_the_surface_is_found() {
    let inside = structure(2.5, 0.2, 0.92);
    assert_eq!(universal::other_structure(&inside).count(), 0);
    assert_eq!(MODEL.out_of_range(&measures(&inside, 5.0, 0.6)).count(), 0);
    let unknown = structure(20.0, 0.2, 0.5);
    let other = universal::other_structure(&unknown).map(|other| other.parameter);
    assert_eq!(other.collect::<Vec<_>>(), ["p", "eta"]);
    let out: Vec<Measure> =
        MODEL.out_of_range(&measures(&inside, 500.0, 0.6)).map(|out| out.measure).collect();
    assert_eq!(out, [Measure::Im4, Measure::Im3]);
}
