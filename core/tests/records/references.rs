//! Measures and pulses against other programs (scripts/reference/records.py).

use std::collections::HashMap;

use rockfrag_core::motion::measures::velocity;
use rockfrag_core::motion::{MeasurePlan, MotionMeasures};
use rockfrag_core::records::pulses::{FittedPulse, PulseIndicator};

use crate::shared::{StoredMotion, reference_motions, rows};

const SA_PERIODS_S: [f64; 6] = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0];

/// Motions of the references, by name.
fn by_name() -> HashMap<String, StoredMotion> {
    reference_motions().into_iter().map(|motion| (motion.motion_id.clone(), motion)).collect()
}

/// Our value of a column, or of a period of the plan.
fn ours(measures: &MotionMeasures, measure: &str) -> f64 {
    match measure.strip_prefix("sa_").map(|period| period.parse::<f64>().unwrap()) {
        Some(period) => measures.sa_m_s2[SA_PERIODS_S.iter().position(|known| *known == period).unwrap()],
        None => serde_json::to_value(measures).unwrap()[measure].as_f64().unwrap(),
    }
}

/// Relative and absolute tolerance; the durations of the reference are in 64 substeps.
fn tolerance(measure: &str, dt_s: f64) -> (f64, f64) {
    match measure {
        "d5_75_s" | "d5_95_s" => (0.0, 0.02 * dt_s),
        _ if measure.starts_with("sa_") || measure == "housner_m" => (1e-6, 0.0),
        _ => (1e-8, 0.0),
    }
}

#[test]
fn measures_are_those_of_eqsig_and_numpy() {
    let motions = by_name();
    let plan = MeasurePlan { housner: true, sa_periods_s: SA_PERIODS_S.to_vec() };
    let answers: Vec<(String, String, f64)> = rows("records/measures.csv");
    assert_eq!(answers.len(), 24 * 15);
    for (motion_id, measure, value) in answers {
        let StoredMotion { acceleration_m_s2, dt_s, .. } = &motions[&motion_id];
        let measured = plan.measure(acceleration_m_s2, *dt_s);
        let (ours, (share, amount)) = (ours(&measured, &measure), tolerance(&measure, *dt_s));
        assert!(
            (ours - value).abs() <= share * value + amount,
            "motion {motion_id}, {measure}: {ours} for {value}"
        );
    }
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
    let motions = by_name();
    let answers: Vec<PulseAnswer> = rows("records/pulses.csv");
    assert_eq!(answers.len(), 24);
    let mut same_period = 0;
    for PulseAnswer { motion_id, indicator, period_s, r2, tp_s } in &answers {
        let StoredMotion { acceleration_m_s2, dt_s, .. } = &motions[motion_id];
        let velocity = velocity(acceleration_m_s2, *dt_s);
        let found = PulseIndicator::of(&velocity, *dt_s).unwrap();
        assert!((found.indicator - indicator).abs() < 0.01, "motion {motion_id}: {found:?} for {indicator}");
        assert!(
            (found.period_s / period_s - 1.0).abs() < 0.03,
            "motion {motion_id}: {found:?} for {period_s}"
        );
        let fitted = FittedPulse::fit(&velocity, *dt_s, found.period_s, found.centre_s).unwrap();
        assert!(fitted.r2 > r2 - 0.002, "motion {motion_id}: {fitted:?} for {r2}");
        same_period += usize::from((fitted.pulse.tp_s / tp_s - 1.0).abs() < 0.02);
    }
    // If two pulses fit equally well, either is right.
    assert!(same_period >= answers.len() - 1, "{same_period} of {}", answers.len());
}
