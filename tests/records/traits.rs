//! Traits of real files: each is read as the agency means it, or refused.

use rockfrag::records::{ReadOptions, RecordedMotion, read_records};
use rockfrag::units::Unit;

use crate::writers::*;

fn read(text: &str) -> Vec<RecordedMotion> {
    read_records(text.as_bytes(), &ReadOptions::default()).unwrap_or_else(|why| panic!("{why}"))
}

/// Fails unless these are the samples (m/s2), to a last digit.
#[track_caller]
fn expect_samples(motion: &RecordedMotion, samples: &[f64], digit: f64) {
    assert_eq!(motion.acceleration_m_s2.len(), samples.len());
    let off = motion.acceleration_m_s2.iter().zip(samples).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(off <= 0.51 * digit, "{off}");
}

/// AT2 whose samples in g each have this format.
fn at2_of(samples: &[f64], format: impl Fn(f64) -> String) -> String {
    let rows = samples.chunks(8).map(|row| row.iter().map(|a| format(a / G)).collect::<String>() + "\n");
    let head = "PEER NGA STRONG MOTION DATABASE RECORD\nTest, 1/2/1999, Q, 090\n";
    format!("{head}{IN_G}\nNPTS= {}, DT= {DT:.4} SEC\n{}", samples.len(), rows.collect::<String>())
}

#[test]
fn numbers_that_touch_are_parted_before_their_sign() {
    let samples = motion(400);
    for text in [
        at2_of(&samples, |a| format!("{a:9.6}")),
        at2_of(&samples, |a| format!("{a:+.6}")),
        at2_of(&samples, |a| format!("{a:13.6E}")),
    ] {
        assert!(text.lines().any(|line| line.contains("0-0.") || line.matches('.').count() == 8));
        expect_samples(&read(&text)[0], &samples, 1e-6 * G);
    }
    // Other formats of the same numbers.
    let cm: Vec<f64> = samples.iter().map(|a| (a * 1e4).round() / 1e4).collect();
    let touching = |text: String| text.replace("\n-", "-");
    expect_samples(&read(&touching(esm(&cm)))[0], &cm, 1e-6);
    // Three signs in a row are damage.
    assert!(
        read_records(at2_of(&samples, |a| format!("{a:9.6}--")).as_bytes(), &ReadOptions::default()).is_err()
    );
}

#[test]
fn exponents_of_fortran_are_read() {
    let samples = motion(400);
    for sign in ["D", "d", "E", "e"] {
        let text = at2_of(&samples, |a| format!("{a:16.7E}").replace('E', sign));
        expect_samples(&read(&text)[0], &samples, 1e-6 * G);
    }
    let text = cosmos(&samples, 90).replace("Format=(8F10.5)", "Format=(8D10.5)");
    expect_samples(&read(&text)[0], &samples, 1e-6);
    let text = nga_at2(&samples).replace("DT=   0.0100", "DT= 1.0D-02");
    assert_eq!(read(&text)[0].dt_s, 0.01);
}

#[test]
fn at2_has_its_count_under_several_names_or_none() {
    let samples = motion(403);
    for counts in [
        "NPT= 403, DT= .0100",
        "NPTS=403 DT=0.01",
        "NPTS : 403, DT : 0.01 SEC",
        "403 0.01",
        "  403    0.0100",
        "403 0.0100 NPTS, DT",
        "npts= 403, dt= .01 sec",
    ] {
        let [motion] = &read(&at2(&samples, IN_G, counts))[..] else { panic!("{counts}") };
        assert!((motion.dt_s, motion.format) == (0.01, "at2"), "{counts}");
        expect_samples(motion, &samples, 1e-6);
    }
}

#[test]
fn vertical_components_have_many_names() {
    let samples = motion(400);
    let plain = cosmos(&samples, 360);
    let azimuth = format!("{:8}", 360);
    let code = |code: u32| plain.replacen(&azimuth, &format!("{code:8}"), 1);
    let verticals = [
        code(400),
        code(401),
        code(402),
        plain.replace("1:360 deg", "1:Down   "),
        plain.replace("1:360 deg", "1: Up    "),
        plain.replace("| Recorder: QUANTERRA Q330", "|<SCNL>12345.HNZ.XX.10 <AUTH>"),
    ];
    for (index, text) in verticals.iter().enumerate() {
        assert_ne!(*text, plain, "{index}");
        assert!(read(text)[0].is_vertical(), "{index}");
    }
    let horizontals =
        [plain.clone(), plain.replace("| Recorder: QUANTERRA Q330", "|<SCNL>12345.HNN.XX.10 <AUTH>")];
    assert!(horizontals.iter().all(|text| read(text)[0].azimuth_deg == Some(360.0)));
    for name in ["DOWN", "VRT", "-UP", "DN", "UPD", "VT", "DWN", "Up", "vertical", "V", "HNZ"] {
        let text = nga_at2(&samples).replace(", 270", &format!(", {name}"));
        assert!(read(&text)[0].is_vertical(), "{name}");
    }
    for name in ["N", "090", "N90E", "H1", "TR", "LN", "E-W"] {
        let text = nga_at2(&samples).replace(", 270", &format!(", {name}"));
        assert!(!read(&text)[0].is_vertical(), "{name}");
    }
}

#[test]
fn a_borehole_is_known_by_its_direction() {
    let is_in_borehole = |direction: &str| {
        read(&knet(&motion(400)).replace("Dir.              5", &format!("Dir.              {direction}")))[0]
            .is_in_borehole
    };
    assert_eq!(
        ["1", "2", "3", "4", "5", "6", "N-S"].map(is_in_borehole),
        [true, true, true, false, false, false, false]
    );
}

#[test]
fn units_are_read_in_every_notation() {
    for (text, si) in [
        ("\u{b5}m/s\u{b2}", 1e-6),
        ("\u{3bc}m/s2", 1e-6),
        ("um/s^2", 1e-6),
        ("nm/s**2", 1e-9),
        ("mGal", 1e-5),
        ("milligal", 1e-5),
        ("\u{b5}Gal", 1e-8),
        ("m\u{b7}s\u{207b}\u{b2}", 1.0),
        ("m s\u{207b}\u{b2}", 1.0),
        ("cm\u{22c5}s-2", 0.01),
        ("mm s^-2", 0.001),
        ("Gal", 0.01),
        ("mg", 0.001 * G),
    ] {
        let unit = Unit::of_acceleration(text).unwrap_or_else(|why| panic!("{text}: {why}"));
        assert!((unit.si / si - 1.0).abs() < 1e-12, "{text}: {}", unit.si);
    }
    for text in ["m\u{b7}s\u{207b}\u{b9}", "km/s", "Gal/s", "um"] {
        assert!(Unit::of_acceleration(text).is_err(), "{text}");
    }
}
