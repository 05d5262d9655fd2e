//! Formats of the agencies: reading returns what was written, and damage causes no harm.

use proptest::prelude::*;
use rockfrag::inputs::InputError;
use rockfrag::inputs::records::{ReadOptions, RecordFormat, is_vertical, read_records};
use rockfrag_core::records::RecordedMotion;
use rockfrag_core::units::Unit;
use strum::VariantArray;

use crate::writers::*;

fn read(text: &str) -> Result<Vec<RecordedMotion>, InputError> {
    read_with(text, "")
}

/// A file of 1000 samples, half a unit of their last digit (m/s2), and its labels.
struct SampleFile {
    format: RecordFormat,
    text: String,
    half_digit: f64,
    labels: [&'static str; 3],
}

fn each_format() -> [SampleFile; 5] {
    let samples = motion(1000);
    let pga = peak(&samples) / G;
    let unit = format!("ACCELERATION TIME HISTORY IN UNITS OF G,  PGA=   {pga:.5} G, PGV= 1 CM/SEC");
    let old = at2(&samples, &unit, "  1000   0.0100    NPTS, DT");
    let taiwan = ["Chi-Chi, Taiwan, 9/20/1999", "CHY101", "270"];
    let alaska = "Point MacKenzie Earthquake of Fri Nov 30, 2018 17:29 UTC";
    let alaska = [alaska, "AK-BMR UAF Bremner River, AK, USA", "90 deg"];
    let italy = ["NORTHERN_ITALY 20120529 070002", "IT MRN MIRANDOLA", "HNE"];
    let japan = ["2011/03/11 14:46:00", "MYG004 surface", "E-W"];
    let of = |format, text, half_digit, labels| SampleFile { format, text, half_digit, labels };
    [
        of(RecordFormat::PeerAt2, nga_at2(&samples), 0.5e-7 * G, taiwan),
        of(RecordFormat::PeerAt2, old, 0.5e-7 * G, taiwan),
        of(RecordFormat::Cosmos, cosmos(&samples, 90), 0.5e-7, alaska),
        of(RecordFormat::Esm, esm(&samples), 0.5e-8, italy),
        of(RecordFormat::Knet, knet(&samples), 2e-6, japan),
    ]
}

#[test]
fn what_is_written_is_read() {
    let mean = motion(1000).iter().sum::<f64>() / 1000.0;
    for SampleFile { format, text, half_digit, labels } in each_format() {
        let [read_motion] = &read(&text).unwrap()[..] else { panic!("{format:?}: one motion") };
        let RecordedMotion { origin, acceleration_m_s2, .. } = read_motion;
        let azimuth_deg = if format == RecordFormat::PeerAt2 { 270.0 } else { 90.0 };
        assert_eq!((read_motion.format, origin.azimuth_deg), (format.into(), Some(azimuth_deg)));
        let mw =
            [(RecordFormat::Esm, 6.0), (RecordFormat::Knet, 9.0)].into_iter().find(|(of, _)| *of == format);
        assert_eq!(origin.mw, mw.map(|(_, mw)| mw));
        assert!((read_motion.dt_s - DT).abs() < 1e-12 && acceleration_m_s2.len() == 1000);
        let offset = if format == RecordFormat::Knet { mean } else { 0.0 };
        for (a, b) in acceleration_m_s2.iter().zip(motion(1000)) {
            assert!((a - b + offset).abs() <= half_digit * 1.001, "{format:?}: {a} {b}");
        }
        let found = [&origin.earthquake, &origin.station, &origin.component].map(|text| text.as_deref());
        assert_eq!(found, labels.map(Some));
        // Line ends, blanks, an end-of-file mark, Latin-1.
        for other in [text.replace('\n', "\r\n"), text.replace('\n', "   \n"), text.clone() + "\n \n\x1a"] {
            assert_eq!(read(&other).unwrap(), read(&text).unwrap(), "{format:?}");
        }
        let accented = text.replacen(&labels[1][labels[1].len() - 3..], "\u{e7}\u{e1}o", 1);
        let latin_1: Vec<u8> = accented.chars().map(|c| c as u8).collect();
        assert_eq!(read_records(&latin_1, &ReadOptions::default()), read(&accented), "{format:?}");
    }
}

#[test]
fn cosmos_holds_channels_whose_numbers_may_touch() {
    let loud: Vec<f64> = motion(400).iter().map(|a| 40.0 + 0.1 * a).collect();
    let text = cosmos(&motion(1003), 360) + &cosmos(&loud, 90);
    assert!(text.lines().any(|line| line.matches('.').count() == 8 && !line.contains(' ')));
    let [first, second] = &read(&text).unwrap()[..] else { panic!("velocities are left out") };
    assert_eq!([first, second].map(|motion| motion.origin.azimuth_deg), [Some(360.0), Some(90.0)]);
    assert!(second.acceleration_m_s2.iter().zip(&loud).all(|(a, b)| (a - b).abs() < 1e-6));
}

#[test]
fn what_is_cut_off_or_overwritten_is_refused() {
    for SampleFile { format, text, .. } in each_format() {
        let lines: Vec<&str> = text.lines().collect();
        for kept in [1, 12, lines.len() * 4 / 10] {
            assert!(read(&lines[..kept].join("\n")).is_err(), "{format:?}: {kept} lines");
        }
        let (start, end) = (text.len() / 2, text.len() * 3 / 4);
        let zeros = text[..start].to_string() + &"\0".repeat(end - start) + &text[end..];
        assert!(read(&zeros).is_err(), "{format:?} with zeros is read");
        assert!(read(&text.replace(|c: char| c.is_ascii_digit(), "*")).is_err(), "{format:?} without digits");
    }
}

/// Files of each format with bytes changed, inserted or cut off.
fn damaged() -> impl Strategy<Value = Vec<u8>> {
    let samples = motion(40);
    let csv = "t;a (g)\n0;1\n0.1;2\n".to_string();
    let files = vec![nga_at2(&samples), cosmos(&samples, 90), esm(&samples), knet(&samples), csv];
    let words = [
        "9999999999999999999",
        "(",
        "1e999",
        "-1",
        "\u{feff}",
        "\0",
        "NPTS=",
        "\n\n",
        "(4294967296F9999999999",
    ];
    let insert = prop::sample::select(words.to_vec()).prop_map(|text| text.as_bytes().to_vec());
    let edit = prop_oneof![any::<u8>().prop_map(|byte| vec![byte]), insert];
    let edits = prop::collection::vec((any::<prop::sample::Index>(), edit), 0..8);
    (prop::sample::select(files), edits, any::<prop::sample::Index>()).prop_map(|(file, edits, end)| {
        let mut bytes = file.into_bytes();
        for (place, insert) in edits {
            let at = place.index(bytes.len());
            bytes.splice(at..at + usize::from(insert.len() == 1), insert);
        }
        bytes.truncate(if end.index(2) == 0 { bytes.len() } else { end.index(bytes.len()) });
        bytes
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn any_bytes_are_records_or_an_error(
        bytes in prop_oneof![4 => damaged(), 1 => ".{0,400}".prop_map(String::into_bytes)],
        format in prop::option::of(prop::sample::select(RecordFormat::VARIANTS.to_vec())),
        is_given in any::<bool>(),
        column in prop::option::of(prop::sample::select(vec!["all", "2", "0", "a"])),
    ) {
        let (dt_s, unit) = (Some(0.01).filter(|_| is_given), Unit::parse("g").filter(|_| is_given));
        let column = column.map(str::to_string);
        let options = ReadOptions { format, dt_s, unit, column };
        for motion in read_records(&bytes, &options).into_iter().flatten() {
            prop_assert!(motion.acceleration_m_s2.iter().all(|a| a.is_finite()));
            prop_assert!(motion.dt_s > 0.0 && (2..=bytes.len()).contains(&motion.acceleration_m_s2.len()));
        }
    }
}

#[test]
fn headers_must_agree_with_options() {
    for SampleFile { format, text, .. } in each_format() {
        let [motion] = &read(&text).unwrap()[..] else { panic!("{format:?}: one motion") };
        assert!(!is_vertical(&motion.origin), "{format:?}");
        for options in ["dt=0.02", "unit=ft/s2"] {
            let refusal = read_with(&text, options).unwrap_err();
            assert!(matches!(refusal, InputError::Contradiction { .. }), "{format:?}: {refusal}");
        }
    }
}
