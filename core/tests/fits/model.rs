//! The universal surface and its calibration, against Python's from the same file and cases
//! (scripts/universal), and what must hold of it without fits.

use rand::RngExt;
use rockfrag_core::fragility::{
    Calibration, Case, Cases, Cluster, LimitStates, Model, MotionKind, Tau, p_failure_given_rocking,
};
use rockfrag_core::motion::{Floor, IntensityMeasures, Peaks};
use rockfrag_core::object::{Object, UncertaintySource};
use rockfrag_core::rocking::{Outcome, Structure, housner_eta};
use rockfrag_core::statistics::{Interval, normal};
use rockfrag_core::warning::Warning;
use strum::VariantArray;

use crate::common::{Row, cases, close, equipment, expect_covariance, random, read, rocking};

fn measures(structure: &Structure, pga_m_s2: f64, pgv_m_s: f64) -> IntensityMeasures {
    IntensityMeasures::new(structure, Peaks { pga_m_s2, pgv_m_s }, None, None)
}

/// P_ro, P_ex and P_f of an object that rocks under a motion of unknown magnitude.
fn given_rocking(model: &Model, structure: &Structure, at: &IntensityMeasures, tau: Tau) -> [Interval; 3] {
    let given = model.probabilities(structure, at, None, tau).given_rocking.unwrap();
    [Some(given.p_ro), given.p_ex, given.p_failure].map(Option::unwrap)
}

fn calibrated(cases: &Cases) -> Model {
    let (overturning, exceeding) = (Calibration::fit(cases, None), Calibration::fit(cases, Some(0.1)));
    Model::Surface { overturning, exceeding, floor: None }
}

/// As IM3, IM4 and IM5 of a row.
fn measures_of(row: &Row) -> IntensityMeasures {
    let of_peaks = IntensityMeasures::from_peaks(row.get("im4"), row.get("im5"));
    IntensityMeasures { im3: Some(row.get("im3")), ..of_peaks }
}

#[test]
fn logits_are_those_of_python() {
    let rows: Vec<Row> = read("universal_answers.csv");
    assert!(rows.len() >= 50);
    for row in rows {
        let (structure, mw) = (row.structure(), Some(row.get::<f64>("mw")).filter(|mw| *mw > 0.0));
        let of = |limit| {
            let calibration = Calibration::uncalibrated(row.get("kind"), &structure, limit);
            calibration.terms(&structure, &measures_of(&row), mw).unwrap()
        };
        let (pro, pex) = (of(None), of(Some(row.get("limit_state"))));
        for (ours, column) in [
            (pro.logit, "logit_pro"),
            (pex.logit, "logit_pex"),
            (pro.magnitude, "magnitude"),
            (pro.uplift_term, "added_pro"),
            (pex.uplift_term, "added_pex"),
        ] {
            let theirs: f64 = row.get(column);
            assert!((ours - theirs).abs() < 1e-9 * theirs.abs().max(1.0), "{ours}, {column} of {row:?}");
        }
        assert_eq!(pro.magnitude_sd == 0.0, mw.is_some());
    }
}

/// The cases of a structure, in their clusters or all in one.
fn of_structure(rows: &[Row], answer: &Row, in_clusters: bool) -> Cases {
    let is_of = |row: &&Row| ["kind", "structure"].iter().all(|of| row.text(of) == answer.text(of));
    let rows: Vec<&Row> = rows.iter().filter(is_of).collect();
    let kind: MotionKind = answer.get("kind");
    let suite = (kind != MotionKind::Recorded).then(|| kind.into());
    let mut cases = Cases::new(suite, rows[0].structure());
    for row in rows {
        let outcome = match row.text("overturned") {
            "0" => Outcome::SafeRocking(row.get("edp")),
            _ => Outcome::Overturned,
        };
        let peaks = Peaks { pga_m_s2: row.get("pga_m_s2"), pgv_m_s: row.get("pgv_m_s") };
        let case = Case { outcome, measures: measures_of(row), peaks, mw: Some(row.get("mw")), cluster: 0 };
        let cluster = if in_clusters { row.text("cluster") } else { "one" };
        cases.push(case, Cluster::new(Some(cluster), None, None));
    }
    cases
}

#[test]
fn calibrations_are_those_of_python() {
    let (rows, answers): (Vec<Row>, Vec<Row>) =
        (read("calibration_cases.csv"), read("calibration_answers.csv"));
    assert!(answers.len() >= 4);
    for answer in &answers {
        let limit_state = (answer.text("event") == "pex").then_some(0.1);
        let own = Calibration::fit(&of_structure(&rows, answer, true), limit_state);
        let counts = ["n", "n_events", "n_clusters"].map(|name| answer.get::<i64>(name));
        assert_eq!([own.n, own.n_events, own.n_clusters], counts);
        for (ours, column) in [(own.c, "c"), (own.ln_s, "ln_s"), (own.m, "m")] {
            let theirs: f64 = answer.get(column);
            assert!((ours - theirs).abs() < 1e-9, "{ours} {theirs}");
        }
        expect_covariance(&own, answer, "clustered", 1e-9);
        // All in one cluster, which has a shift.
        let alone = Calibration::fit(&of_structure(&rows, answer, false), limit_state);
        expect_covariance(&alone, answer, "v", 1e-9);
    }
}

/// One direction in which no probability falls.
fn step(line: usize, [p, alpha, eta, pga, pgv]: [f64; 5], by: f64) -> [f64; 5] {
    match line % 5 {
        0 => [p, alpha, eta, pga * by, pgv * by],
        1 => [p, alpha, eta, pga, pgv * by],
        // Narrower: p does not change, the centre of mass stays as far from the corner.
        2 => [p, (alpha.tan() / by).atan(), eta, pga, pgv],
        3 => [p * by, alpha, eta, pga, pgv],
        _ => [p, alpha, 1.0 - (1.0 - eta) / by, pga, pgv],
    }
}

#[test]
fn probabilities_never_fall_along_20000_lines() {
    let mut random = random(5);
    let own = calibrated(&rocking(400));
    let mut ln = |low: f64, high: f64| random.random_range(low.ln()..high.ln()).exp();
    for kind in MotionKind::VARIANTS {
        let mut largest = [0.0_f64; 5];
        for line in 0..20_000 {
            // Half of the lines begin at a tenth of the least of the domain and end at ten times the largest.
            let wide = if line % 2 == 0 { 10.0 } else { 1.0 };
            let (alpha, mw) = (ln(0.04, 0.5), (line % 3 == 0).then(|| ln(4.5, 8.0)));
            let pga = 9.81 * alpha.tan() * ln(1.0, 18.0 * wide);
            let p = ln(0.4 / wide, 8.0 * wide);
            let mut at = [p, alpha, 1.0 - ln(0.001, 0.3), pga, pga / ln(1.0 / wide, 45.0 * wide)];
            let mut last = [0.0; 3];
            for _ in 0..12 {
                let Ok(structure) = Structure::new("any", at[0], at[1], at[2]) else { break };
                let of_motion = measures(&structure, at[3], at[4]);
                let uncalibrated = Model::uncalibrated(*kind, &structure, [0.02, 0.1, 0.5, 0.9][line % 4]);
                let model = if line % 7 == 0 { &own } else { &uncalibrated };
                let given = model.probabilities(&structure, &of_motion, mw, Tau::Included).given_rocking;
                let Some(given) = given else { continue };
                let p = [given.p_ro.value, given.p_ex.unwrap().value, given.p_failure.unwrap().value];
                let fall = (0..3).map(|k| last[k] - p[k]).fold(0.0, f64::max);
                largest[line % 5] = largest[line % 5].max(fall);
                (last, at) = (p, step(line, at, 1.0 + 0.4 * wide / 10.0));
            }
        }
        assert!(largest.iter().all(|fall| *fall <= 0.001), "{kind} {largest:?}");
    }
}

#[test]
fn probabilities_go_to_0_at_uplift_and_fall_with_the_limit_state() {
    for kind in MotionKind::VARIANTS {
        for (p, eta) in [(0.5, 0.75), (2.5, 0.92), (7.8, 0.99)] {
            let structure = Structure::new("any", p, 0.2, eta).unwrap();
            let at = |im4: f64, limit_state: f64| {
                let model = Model::uncalibrated(*kind, &structure, limit_state);
                given_rocking(&model, &structure, &IntensityMeasures::from_peaks(im4, 0.2 * p), Tau::Included)
            };
            assert_eq!(at(1.0, 0.1)[..2], [Interval::exact(0.0); 2]);
            assert!(at(1.0001, 0.1)[2].value < 1e-3, "{kind} {:?}", at(1.0001, 0.1));
            let falling = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 0.9, 1.5].map(|limit| at(2.0, limit)[2].value);
            assert!(falling.is_sorted_by(|before, after| before >= after), "{kind}: {falling:?}");
        }
    }
}

/// Limits that are finite, hold the value, and are not all of 0 to 1.
fn expect_limits(p: Interval) {
    assert!(0.0 <= p.low && p.low <= p.value && p.value <= p.high && p.high <= 1.0, "{p:?}");
    // Magnitude is not known of any of these motions.
    assert!(p.high - p.low < 0.99, "{p:?}");
}

#[test]
fn limits_are_finite_without_events_with_nothing_else_and_of_eight_records() {
    for n in [8, 400] {
        for (overturns, least) in [(Outcome::SafeRocking(0.05), 1.1), (Outcome::Overturned, 1.6)] {
            // Nothing overturns at uplift.
            let strength = |k: u32| least + 0.05 * f64::from(k % 40);
            let model = calibrated(&cases(
                (0..n).map(|k| (overturns, strength(k), 2.0, if n == 8 { k } else { k % 30 })),
            ));
            let Model::Surface { overturning, .. } = &model else { panic!() };
            assert!(overturning.covariance.iter().all(|v| v.is_finite()) && overturning.covariance[0] > 1e-3);
            assert!(overturning.warnings().contains(&Warning::NoEvents));
            assert_eq!(overturning.warnings().contains(&Warning::FewClusters), n == 8);
            for im4 in [1.2, 2.0, 3.0] {
                let motion = IntensityMeasures::from_peaks(im4, im4 / 2.0);
                for p in given_rocking(&model, &equipment(), &motion, Tau::Included) {
                    expect_limits(p);
                }
            }
        }
    }
}

#[test]
fn branches_are_joined_by_the_tree_and_one_scenario_is_less_known_than_many() {
    let block = Structure::rectangular_block("block", 0.5, 2.0, None).unwrap();
    let model = Model::uncalibrated(MotionKind::Csgm, &block, 0.1);
    for (pga, pgv) in [(3.0, 0.2), (5.0, 0.6), (9.0, 1.5), (20.0, 5.0)] {
        let of = |tau| given_rocking(&model, &block, &measures(&block, pga, pgv), tau);
        let (one, many) = (of(Tau::Included), of(Tau::Averaged));
        let joined = |of: fn(Interval) -> f64| p_failure_given_rocking(of(one[0]), of(one[1]));
        close(one[2].value, joined(|p| p.value), 1e-12);
        close(one[2].low, joined(|p| p.low), 1e-12);
        close(one[2].high, joined(|p| p.high), 1e-12);
        for (one, many) in one.into_iter().zip(many) {
            assert_eq!(one.value, many.value);
            assert!(one.low < many.low && many.low < many.value);
            assert!(many.value <= many.high && many.high <= one.high);
        }
    }
    let still = model.probabilities(&block, &measures(&block, 1.0, 0.5), None, Tau::Included);
    assert_eq!(still.limit_states(), LimitStates::all(Some(Interval::exact(0.0))));
    let unknown = model.probabilities(&block, &measures(&block, 9.0, 0.0), None, Tau::Included);
    assert_eq!(unknown.limit_states().overturning, None, "no velocity");
}

#[test]
fn what_lies_outside_is_warned_once() {
    let inside = measures(&equipment(), 5.0, 0.6);
    let uncalibrated = Model::uncalibrated(MotionKind::Csgm, &equipment(), 0.1);
    let by = |model: &Model, of_motion| model.warnings(&equipment(), &of_motion);
    assert_eq!(by(&uncalibrated, inside), []);
    assert_eq!(by(&uncalibrated, measures(&equipment(), 500.0, 0.6)), [Warning::Extrapolated]);
    assert_eq!(by(&uncalibrated, measures(&equipment(), 1.0, 0.001)), [], "it does not rock");
    let beyond = Model::uncalibrated(MotionKind::Csgm, &equipment(), 2.0);
    assert_eq!(by(&beyond, inside), [Warning::Extrapolated]);
    let large = Structure::new("large", 20.0, 0.2, 0.92).unwrap();
    assert!(uncalibrated.warnings(&large, &measures(&large, 5.0, 0.1)).contains(&Warning::UnusualStructure));
    // All motions of these cases have a PGA of 1 m/s2 and a PGV of 1 m/s.
    let own = calibrated(&rocking(400));
    assert!(by(&own, inside).contains(&Warning::Extrapolated));
}

#[test]
fn limits_at_one_motion_are_1_96_standard_errors_of_the_logit() {
    let structure = Structure::new("any", 2.5, 0.2, 0.92).unwrap();
    let uncalibrated = Calibration::uncalibrated(MotionKind::Recorded, &structure, None);
    let of_motion = measures(&structure, 4.0, 0.4);
    let logit = |p: f64| (p / (1.0 - p)).ln();
    for mw in [None, Some(7.2)] {
        let of = uncalibrated.terms(&structure, &of_motion, mw).unwrap();
        let slope = of.logit * uncalibrated.ln_s.exp();
        let variance = uncalibrated.covariance[0]
            + slope * slope * uncalibrated.covariance[4]
            + of.magnitude * of.magnitude * uncalibrated.covariance[8];
        let of_magnitude = if mw.is_none() { uncalibrated.m * of.magnitude_sd } else { 0.0 };
        let spread = uncalibrated.tau * uncalibrated.tau + of_magnitude * of_magnitude;
        for (tau, between) in [(Tau::Included, spread), (Tau::Averaged, 0.0)] {
            let p = uncalibrated.probability(&structure, &of_motion, mw, tau).unwrap();
            let half_width = 1.959_963_984_540_054 * (variance + between).sqrt();
            assert!((logit(p.high) - logit(p.value) - half_width).abs() < 1e-9);
            assert!((logit(p.value) - logit(p.low) - half_width).abs() < 1e-9);
        }
    }
    // A unit of magnitude is worth m, and none beyond the magnitudes of the data.
    let of = |mw| uncalibrated.terms(&structure, &of_motion, Some(mw)).unwrap().magnitude;
    assert!((of(7.0) - of(6.0) - 1.0).abs() < 1e-12);
    assert_eq!((of(3.0), of(9.0)), (of(5.0), of(7.6)));
}

/// A block with its model on the ground.
fn block(width: f64, height: f64) -> (Structure, Model) {
    let structure = Structure::rectangular_block("block", width, height, None).unwrap();
    let model = Model::uncalibrated(MotionKind::Recorded, &structure, 0.1);
    (structure, model)
}

/// P_nr and P(overturning).
fn overturning(model: &Model, structure: &Structure, pga_m_s2: f64, pgv_m_s: f64) -> [f64; 2] {
    let motion = measures(structure, pga_m_s2, pgv_m_s);
    let probabilities = model.probabilities(structure, &motion, Some(6.9), Tau::Averaged);
    [probabilities.p_nr, probabilities.limit_states().overturning.unwrap().value]
}

#[test]
fn stronger_motions_overturn_more_and_higher_floors_rock_sooner() {
    for (width, height) in [(0.4, 1.6), (0.8, 2.2), (1.2, 4.0)] {
        let (structure, model) = block(width, height);
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
    let (structure, model) = block(0.8, 2.2);
    let floor = Floor { period_s: 0.6, level: 1.0 };
    let ground = Peaks { pga_m_s2: 2.0, pgv_m_s: 0.2 };
    let (peaks, scatter) = (floor.peaks(ground), floor.amplification(ground).sd_ln_pfa);
    let z = (peaks.pga_m_s2 / structure.uplift_acceleration_m_s2()).ln() / scatter;
    let [p_nr, _] = overturning(&model.on(Some(floor)).unwrap(), &structure, 2.0, 0.2);
    assert!((p_nr - normal::cdf(-z)).abs() < 1e-12, "{p_nr}");
}

#[test]
fn level_0_is_the_ground_and_a_rigid_building_moves_with_it() {
    let (structure, model) = block(0.5, 2.0);
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

#[test]
fn objects_fall_away_from_a_wall_as_often_as_simulated() {
    let cells: Vec<([f64; 6], [f64; 5])> = read("wall.csv");
    for (number, rebound) in [0.0, 0.3, 0.5, 0.7, 0.9].into_iter().enumerate() {
        let (mut foretold, mut counted) = (0.0, 0.0);
        for &([p, alpha, pga, pgv, mw, n], shares) in &cells {
            let free = Structure::new("block", p, alpha, 0.9).unwrap();
            let structure = Structure { rebound: Some(rebound), ..free };
            let model = Model::uncalibrated(MotionKind::Recorded, &structure, 0.1);
            let motion = measures(&structure, pga, pgv);
            let states = model.probabilities(&structure, &motion, Some(mw), Tau::Averaged).limit_states();
            foretold += n * states.overturning.unwrap().value;
            counted += n * shares[number];
        }
        assert!((foretold / counted - 1.0_f64).abs() < 0.1, "{rebound}: {foretold} {counted}");
    }
}

#[test]
fn a_wall_stands_behind_the_weaker_side_and_feet_set_eta() {
    let text = "name=cupboard,width=1.2,depth=0.4,height=1.8,wall=yes,base=rubber";
    let sides = text.parse::<Object>().unwrap().sides().unwrap();
    let [depth, width] = &sides[..] else { panic!("{sides:?}") };
    assert_eq!((depth.structure.rebound, width.structure.rebound), (Some(0.5), None));
    assert!((depth.structure.eta / housner_eta((0.4_f64 / 1.8).atan()) - 0.67).abs() < 1e-12);
    let sources: Vec<UncertaintySource> = depth.at_quantiles.iter().map(|bounds| bounds.source).collect();
    assert_eq!(sources, [UncertaintySource::Eta, UncertaintySource::Wall]);
}
