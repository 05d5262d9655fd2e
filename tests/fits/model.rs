//! The universal surface and its calibration, against Python's from the same file and cases
//! (scripts/universal).

use rand::RngExt;
use rockfrag::fragility::{
    Calibration, Cases, Cluster, Event, Kind, Measure, Model, Probability, Scenarios, fit_curve,
    logit_exceeding, logit_overturning, p_failure_given_rocking,
};
use rockfrag::keyword::Keyword;
use rockfrag::motion::IntensityMeasures;
use rockfrag::rocking::{Outcome, Response, Structure};
use rockfrag::warning::Warning;

use crate::common::{cases, close, equipment, random, read, rocking};

fn measures(structure: &Structure, pga_m_s2: f64, pgv_m_s: f64) -> IntensityMeasures {
    IntensityMeasures::new(structure, pga_m_s2, pgv_m_s, None, None)
}

/// As IM5 and IM4 of the equipment.
fn at(im4: f64, im5: f64) -> IntensityMeasures {
    IntensityMeasures::of_peaks(im4, im5)
}

fn calibrated(cases: &Cases) -> Model {
    let (overturning, exceeding) = (Calibration::fit(cases, None), Calibration::fit(cases, Some(0.1)));
    let peaks = overturning.peaks().unwrap();
    Model::Calibrated { overturning, exceeding, peaks, floor: None }
}

#[test]
fn logits_are_those_of_python() {
    type Row = (String, f64, f64, f64, f64, f64, f64, f64, f64, f64);
    let rows: Vec<Row> = read("universal_answers.csv");
    assert!(rows.len() >= 50);
    for (kind, p, alpha, eta, im3, im4, im5, limit, pro, pex) in rows {
        let structure = Structure::new("any", p, alpha, eta).unwrap();
        let measures = IntensityMeasures { im3: Some(im3), ..IntensityMeasures::of_peaks(im4, im5) };
        let kind: Kind = kind.parse().unwrap();
        for (ours, theirs) in [
            (logit_overturning(kind, &structure, &measures).unwrap(), pro),
            (logit_exceeding(kind, &structure, &measures, limit).unwrap(), pex),
        ] {
            assert!(
                (ours - theirs).abs() < 1e-9 * theirs.abs().max(1.0),
                "{ours} {theirs} {kind} {structure:?}"
            );
        }
    }
}

#[derive(serde::Deserialize)]
struct Case {
    kind: Kind,
    structure: String,
    p_rad_s: f64,
    alpha_rad: f64,
    eta: f64,
    pga_m_s2: f64,
    pgv_m_s: f64,
    im3: f64,
    im4: f64,
    im5: f64,
    cluster: String,
    overturned: u8,
    edp: Option<f64>,
}

#[derive(serde::Deserialize)]
struct Answer {
    kind: Kind,
    structure: String,
    event: String,
    n: i64,
    n_events: i64,
    n_clusters: i64,
    c: f64,
    ln_s: f64,
    v_cc: f64,
    v_cs: f64,
    v_ss: f64,
    clustered_cc: f64,
    clustered_cs: f64,
    clustered_ss: f64,
}

/// The cases of a structure, in their clusters or all in one.
fn of_structure(rows: &[Case], answer: &Answer, in_clusters: bool) -> Cases {
    let rows: Vec<&Case> =
        rows.iter().filter(|row| (row.kind, &row.structure) == (answer.kind, &answer.structure)).collect();
    let Case { p_rad_s, alpha_rad, eta, .. } = *rows[0];
    let structure = Structure::new("any", p_rad_s, alpha_rad, eta).unwrap();
    let suite = (answer.kind != Kind::Recorded).then(|| answer.kind.as_str());
    let mut cases = Cases::new(suite, structure);
    for row in rows {
        let Case { im3, im4, im5, pga_m_s2, pgv_m_s, .. } = *row;
        let outcome = if row.overturned == 1 { Outcome::Overturning } else { Outcome::SafeRocking };
        let response = Response { outcome, edp: row.edp.unwrap_or(f64::NAN), impacts: 0 };
        let measures = IntensityMeasures { im3: Some(im3), ..IntensityMeasures::of_peaks(im4, im5) };
        let cluster = if in_clusters { &row.cluster } else { "one" };
        cases.push(&response, &measures, [pga_m_s2, pgv_m_s], Cluster::of(Some(cluster), 0.0, 0.0));
    }
    cases
}

#[test]
fn calibrations_are_those_of_python() {
    let (rows, answers): (Vec<Case>, Vec<Answer>) =
        (read("calibration_cases.csv"), read("calibration_answers.csv"));
    assert!(answers.len() >= 4);
    for answer in &answers {
        let limit_state = (answer.event == "pex").then_some(0.1);
        let own = Calibration::fit(&of_structure(&rows, answer, true), limit_state);
        assert_eq!((own.n, own.n_events, own.n_clusters), (answer.n, answer.n_events, answer.n_clusters));
        for (ours, theirs) in [(own.c, answer.c), (own.ln_s, answer.ln_s)] {
            assert!((ours - theirs).abs() < 1e-9, "{ours} {theirs}");
        }
        let [cc, cs, _, ss] = own.covariance[..] else { panic!("{:?}", own.covariance) };
        let alone = Calibration::fit(&of_structure(&rows, answer, false), limit_state).covariance;
        for (ours, theirs) in [
            (cc, answer.clustered_cc),
            (cs, answer.clustered_cs),
            (ss, answer.clustered_ss),
            (alone[0], answer.v_cc),
            (alone[1], answer.v_cs),
            (alone[3], answer.v_ss),
        ] {
            assert!((ours - theirs).abs() < 1e-9, "{ours} {theirs}");
        }
    }
}

#[test]
fn probabilities_do_not_fall_as_a_motion_is_scaled_up() {
    let mut random = random(5);
    let own = calibrated(&rocking(400));
    for kind in Kind::ALL {
        for _ in 0..100 {
            let ln = |random: &mut rand_chacha::ChaCha8Rng, low: f64, high: f64| {
                random.random_range(low.ln()..high.ln()).exp()
            };
            let (p, alpha) = (ln(&mut random, 0.4, 8.0), ln(&mut random, 0.04, 0.5));
            let structure = Structure::new("any", p, alpha, random.random_range(0.7..0.999)).unwrap();
            let unit = structure.uplift_acceleration_m_s2();
            for motion in 0..20 {
                let ratio = ln(&mut random, 0.05, 0.5);
                let own = if motion % 2 == 0 { Some(&own) } else { None };
                let shipped = Model::shipped(*kind, &structure, 0.1);
                let mut last = [0.0; 3];
                for step in 0..60 {
                    let pga = unit * 1.0001 * (0.15 * f64::from(step)).exp();
                    let measures = measures(&structure, pga, pga * ratio);
                    let model = own.unwrap_or(&shipped);
                    let given = model.probabilities(&structure, &measures, Scenarios::One).given_rocking;
                    let given = given.unwrap();
                    let now = [given.p_ro.value, given.p_ex.value, given.p_failure.value];
                    for (now, last) in now.iter().zip(&mut last) {
                        assert!(*now > *last - 0.01, "{now} after {last}: {kind} {structure:?} {measures:?}");
                        *last = last.max(*now);
                    }
                }
            }
        }
    }
}

/// Limits that are finite, hold the value, and are not all of 0 to 1.
fn expect_limits(p: Probability) {
    assert!(0.0 <= p.low && p.low <= p.value && p.value <= p.high && p.high <= 1.0, "{p:?}");
    assert!(p.high - p.low < 0.95, "{p:?}");
}

#[test]
fn limits_are_finite_without_events_with_nothing_else_and_of_eight_records() {
    let strength = |k: u32| 1.1 + 0.05 * f64::from(k % 40);
    for n in [8, 400] {
        for overturns in [Outcome::SafeRocking, Outcome::Overturning] {
            let model = calibrated(&cases(
                (0..n).map(|k| (overturns, 0.05, strength(k), 2.0, if n == 8 { k } else { k % 30 })),
            ));
            let Model::Calibrated { overturning, .. } = &model else { panic!() };
            assert!(overturning.covariance.iter().all(|v| v.is_finite()) && overturning.covariance[0] > 1e-3);
            assert!(overturning.warnings().contains(&Warning::NoEvents));
            assert_eq!(overturning.warnings().contains(&Warning::FewClusters), n == 8);
            for im4 in [1.2, 2.0, 3.0] {
                let probabilities = model.probabilities(&equipment(), &at(im4, im4 / 2.0), Scenarios::One);
                let given = probabilities.given_rocking.unwrap();
                [given.p_ro, given.p_ex, given.p_failure].into_iter().for_each(expect_limits);
            }
        }
    }
}

#[test]
fn a_pair_that_leaves_the_probit_without_a_fit_leaves_moderate_limits() {
    let clean = |k: u32| {
        let im4 = 1.2 + 0.1 * f64::from(k);
        let outcome = if im4 > 2.95 { Outcome::Overturning } else { Outcome::SafeRocking };
        (outcome, 0.1, im4, 2.0, k)
    };
    let pair = [(Outcome::Overturning, 0.1, 2.94, 2.0, 50), (Outcome::SafeRocking, 0.1, 2.96, 2.0, 50)];
    let without: Vec<_> = (0..38).map(clean).collect();
    let with = cases([&without[..], &pair].concat());
    let probit = fit_curve(&with, Event::Overturning, Measure::Im5, None);
    assert!(probit.coefficients.get(1).is_none_or(|slope| *slope > 50.0), "{:?}", probit.coefficients);
    let (with, without) = (calibrated(&with), calibrated(&cases(without)));
    for im4 in [2.0, 3.0, 4.0] {
        let p_ro = |model: &Model| {
            let measures = at(im4, im4 / 2.0);
            model.probabilities(&equipment(), &measures, Scenarios::Many).given_rocking.unwrap().p_ro
        };
        expect_limits(p_ro(&with));
        assert!((p_ro(&with).value - p_ro(&without).value).abs() < 0.1);
    }
}

#[test]
fn branches_are_joined_by_the_tree_and_one_scenario_is_less_known_than_many() {
    let block = Structure::rectangular_block("block", 0.5, 2.0, None).unwrap();
    let model = Model::shipped(Kind::Csgm, &block, 0.1);
    for (pga, pgv) in [(3.0, 0.2), (5.0, 0.6), (9.0, 1.5), (20.0, 5.0)] {
        let of = |scenarios| {
            model.probabilities(&block, &measures(&block, pga, pgv), scenarios).given_rocking.unwrap()
        };
        let (one, many) = (of(Scenarios::One), of(Scenarios::Many));
        let joined = |of: fn(Probability) -> f64| p_failure_given_rocking(of(one.p_ro), of(one.p_ex));
        close(one.p_failure.value, joined(|p| p.value), 1e-12);
        close(one.p_failure.low, joined(|p| p.low), 1e-12);
        close(one.p_failure.high, joined(|p| p.high), 1e-12);
        for (one, many) in [(one.p_ro, many.p_ro), (one.p_ex, many.p_ex), (one.p_failure, many.p_failure)] {
            assert_eq!(one.value, many.value);
            assert!(one.low < many.low && many.low < many.value);
            assert!(many.value <= many.high && many.high <= one.high);
        }
    }
    let still = model.probabilities(&block, &measures(&block, 1.0, 0.5), Scenarios::One);
    assert_eq!(still.limit_states(), Some([Probability::exact(0.0); 3]));
    let unknown = model.probabilities(&block, &measures(&block, 9.0, 0.0), Scenarios::One);
    assert_eq!(unknown.limit_states(), None, "no velocity");
}

#[test]
fn what_lies_outside_is_warned_once() {
    let inside = measures(&equipment(), 5.0, 0.6);
    let shipped = Model::shipped(Kind::Csgm, &equipment(), 0.1);
    assert_eq!(shipped.warnings(&equipment(), &inside), []);
    assert_eq!(shipped.warnings(&equipment(), &measures(&equipment(), 500.0, 0.6)), [Warning::Extrapolated]);
    assert_eq!(shipped.warnings(&equipment(), &measures(&equipment(), 1.0, 0.001)), [], "it does not rock");
    assert_eq!(
        Model::shipped(Kind::Csgm, &equipment(), 2.0).warnings(&equipment(), &inside),
        [Warning::Extrapolated]
    );
    let large = Structure::new("large", 20.0, 0.2, 0.92).unwrap();
    assert!(shipped.warnings(&large, &measures(&large, 5.0, 0.1)).contains(&Warning::UnusualStructure));
    // All motions of these cases have a PGA of 1 m/s2 and a PGV of 1 m/s.
    let own = calibrated(&rocking(400));
    assert!(own.warnings(&equipment(), &inside).contains(&Warning::Extrapolated));
}

#[test]
fn limits_at_one_motion_are_1_96_standard_errors_of_the_logit() {
    let structure = Structure::new("any", 2.5, 0.2, 0.92).unwrap();
    let shipped = Calibration::shipped(Kind::Recorded, &structure, None);
    let slope = 0.7 * shipped.ln_s.exp();
    let variance = shipped.covariance[0] + slope * slope * shipped.covariance[3];
    let logit = |p: f64| (p / (1.0 - p)).ln();
    for (scenarios, tau) in [(Scenarios::One, shipped.tau), (Scenarios::Many, 0.0)] {
        let p = shipped.probability(0.7, scenarios);
        let half_width = 1.959_963_984_540_054 * (variance + tau * tau).sqrt();
        assert!((logit(p.high) - logit(p.value) - half_width).abs() < 1e-9);
        assert!((logit(p.value) - logit(p.low) - half_width).abs() < 1e-9);
    }
}
