//! Measures and pulses against other programs (scripts/reference/records.py).

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use rockfrag::motion::intensity::velocity;
use rockfrag::motion::{IntensityScratch, MeasurePlan, Measured};
use rockfrag::records::pulses::FittedPulse;
use rockfrag::records::pulses::indicator::PulseIndicator;
use rockfrag::records::pulses::wavelet::WaveletScratch;
use rockfrag::table::motions::{Motion, MotionBatches};

const SA_PERIODS_S: [f64; 6] = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0];

fn reference(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference").join(name)
}

fn motions() -> HashMap<String, Motion> {
    let batches = MotionBatches::open(reference("rocking/motions.parquet"), 64).unwrap();
    batches.flat_map(Result::unwrap).map(|motion| (motion.motion_id.to_string(), motion)).collect()
}

fn rows<T: serde::de::DeserializeOwned>(name: &str) -> Vec<T> {
    csv::Reader::from_path(reference(name)).unwrap().into_deserialize().map(Result::unwrap).collect()
}

#[derive(serde::Deserialize)]
struct Answer {
    motion_id: String,
    measure: String,
    value: f64,
}

/// Our value, and by how much it may differ from the reference: a share of it, and an amount.
fn ours(measured: &Measured, measure: &str, dt_s: f64) -> (f64, f64, f64) {
    let Measured { measures: m, housner_m, sa_m_s2 } = measured;
    match measure {
        "pga_m_s2" => (m.pga_m_s2, 1e-8, 0.0),
        "pgv_m_s" => (m.pgv_m_s, 1e-8, 0.0),
        "pgd_m" => (m.pgd_m, 1e-8, 0.0),
        // Of records padded to the same length, as these are.
        "tm_s" => (m.tm_s.unwrap(), 1e-8, 0.0),
        "arias_m_s" => (m.arias_m_s, 1e-8, 0.0),
        "cav_m_s" => (m.cav_m_s, 1e-8, 0.0),
        // The reference has 64 parts of a step.
        "d5_75_s" => (m.d5_75_s, 0.0, 0.02 * dt_s),
        "d5_95_s" => (m.d5_95_s, 0.0, 0.02 * dt_s),
        "housner_m" => (housner_m.unwrap(), 1e-6, 0.0),
        _ => {
            let period: f64 = measure.strip_prefix("sa_").unwrap().parse().unwrap();
            let place = SA_PERIODS_S.iter().position(|&known| known == period).unwrap();
            (sa_m_s2[place], 1e-6, 0.0)
        }
    }
}

#[test]
fn measures_are_those_of_eqsig_and_numpy() {
    let motions = motions();
    let plan = MeasurePlan { housner: true, sa_periods_s: SA_PERIODS_S.to_vec() };
    let mut worst: HashMap<String, f64> = HashMap::new();
    for Answer { motion_id, measure, value } in rows("records/measures.csv") {
        let motion = &motions[&motion_id];
        let measured =
            plan.measure(&motion.acceleration_m_s2.to_vec(), motion.dt_s, &mut IntensityScratch::default());
        let (ours, share, amount) = ours(&measured, &measure, motion.dt_s);
        let difference = (ours - value).abs();
        assert!(difference <= share * value + amount, "motion {motion_id}, {measure}: {ours} for {value}");
        let largest = worst.entry(measure).or_default();
        *largest = largest.max(difference / value);
    }
    println!("largest relative differences: {worst:?}");
    assert_eq!(worst.len(), 15);
}

#[derive(serde::Deserialize)]
struct PulseAnswer {
    motion_id: String,
    indicator: f64,
    period_s: f64,
    r2: f64,
    tp_s: f64,
}

#[test]
fn pulses_are_those_of_full_resolution_and_global_search() {
    let motions = motions();
    let answers: Vec<PulseAnswer> = rows("records/pulses.csv");
    assert_eq!(answers.len(), 24);
    let mut same_period = 0;
    for PulseAnswer { motion_id, indicator, period_s, r2, tp_s } in &answers {
        let motion = &motions[motion_id];
        let velocity = velocity(&motion.acceleration_m_s2.to_vec(), motion.dt_s);
        let found = PulseIndicator::of(&velocity, motion.dt_s, &mut WaveletScratch::default()).unwrap();
        assert!((found.indicator - indicator).abs() < 0.01, "motion {motion_id}: {found:?} for {indicator}");
        assert!(
            (found.period_s / period_s - 1.0).abs() < 0.03,
            "motion {motion_id}: {found:?} for {period_s}"
        );
        let fitted = FittedPulse::fit(&velocity, motion.dt_s, found.period_s, found.centre_s).unwrap();
        assert!(fitted.r2 > r2 - 0.002, "motion {motion_id}: {fitted:?} for {r2}");
        same_period += usize::from((fitted.pulse.tp_s / tp_s - 1.0).abs() < 0.02);
    }
    // Where two pulses fit equally well, either may be found.
    assert!(same_period >= answers.len() - 1, "{same_period} of {}", answers.len());
}
