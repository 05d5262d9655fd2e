//! The model on floors: what must hold of it without fits.

use rockfrag_core::fragility::{Model, MotionKind, Tau};
use rockfrag_core::motion::{Floor, IntensityMeasures, Peaks};
use rockfrag_core::rocking::Structure;
use rockfrag_core::statistics::normal;

fn overturning(model: &Model, structure: &Structure, pga_m_s2: f64, pgv_m_s: f64) -> [f64; 2] {
    let measures = IntensityMeasures::new(structure, Peaks { pga_m_s2, pgv_m_s }, None, None);
    let probabilities = model.probabilities(structure, &measures, Some(6.9), Tau::Averaged);
    [probabilities.p_nr, probabilities.limit_states().overturning.unwrap().value]
}

#[test]
fn stronger_motions_overturn_more_and_higher_floors_rock_sooner() {
    for (width, height) in [(0.4, 1.6), (0.8, 2.2), (1.2, 4.0)] {
        let structure = Structure::rectangular_block("block", width, height, None).unwrap();
        let model = Model::uncalibrated(MotionKind::Recorded, &structure, 0.1);
        for (period_s, level) in [(0.2, 1.0), (0.6, 0.3), (0.6, 1.0), (2.0, 0.6)] {
            let floor = model.clone().on(Some(Floor { period_s, level })).unwrap();
            let of = |scale: f64| overturning(&floor, &structure, scale, 0.12 * scale);
            let all: Vec<[f64; 2]> = (0..60).map(|k| of(0.5 * 1.08_f64.powi(k))).collect();
            for pair in all.windows(2) {
                let ([p_nr, p], [later_p_nr, later_p]) = (pair[0], pair[1]);
                assert!(later_p_nr <= p_nr && later_p >= p - 1e-12, "{period_s} {level}: {pair:?}");
                assert!((0.0..=1.0).contains(&later_p) && later_p <= 1.0 - later_p_nr + 1e-12);
            }
            assert!(all[59][1] > 0.5, "{period_s} {level}");
        }
    }
}

#[test]
fn a_floor_rocks_as_often_as_its_peak_exceeds_uplift() {
    let structure = Structure::rectangular_block("block", 0.8, 2.2, None).unwrap();
    let model = Model::uncalibrated(MotionKind::Recorded, &structure, 0.1);
    let floor = Floor { period_s: 0.6, level: 1.0 };
    let ground = Peaks { pga_m_s2: 2.0, pgv_m_s: 0.2 };
    let (peaks, scatter) = (floor.peaks(ground), floor.amplification(ground).sd_ln_pfa);
    let z = (peaks.pga_m_s2 / structure.uplift_acceleration_m_s2()).ln() / scatter;
    let [p_nr, _] = overturning(&model.on(Some(floor)).unwrap(), &structure, 2.0, 0.2);
    assert!((p_nr - normal::cdf(-z)).abs() < 1e-12, "{p_nr}");
}

#[test]
fn level_0_is_the_ground_and_a_rigid_building_moves_with_it() {
    let structure = Structure::rectangular_block("block", 0.5, 2.0, None).unwrap();
    let model = Model::uncalibrated(MotionKind::Recorded, &structure, 0.1);
    for (pga, pgv) in [(3.0, 0.5), (6.0, 0.8), (12.0, 1.5)] {
        let ground = overturning(&model, &structure, pga, pgv);
        for (floor, tolerance) in
            [(Floor { period_s: 0.6, level: 0.0 }, 1e-12), (Floor { period_s: 1e-8, level: 1.0 }, 0.02)]
        {
            let found = overturning(&model.clone().on(Some(floor)).unwrap(), &structure, pga, pgv);
            assert!((found[1] / ground[1] - 1.0).abs() < tolerance, "{floor:?}: {found:?}, {ground:?}");
        }
    }
}
