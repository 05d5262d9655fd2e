//! What real files do to their formats, and what broken ones are told.

use proptest::prelude::*;
use rockfrag::keyword::Keyword;
use rockfrag::records::{AccelerationUnit, Format, Given, RecordedMotion, read};
use rockfrag::units::G_M_S2;

use crate::writers::*;

fn parse(text: &str) -> Result<Vec<RecordedMotion>, String> {
    read(text.as_bytes(), None, &Given::default()).map_err(|error| error.to_string())
}

#[track_caller]
fn same(text: &str, as_in: &str) {
    assert_eq!(parse(text).unwrap(), parse(as_in).unwrap());
}

#[track_caller]
fn refused(text: &str, parts: &[&str]) {
    let message = parse(text).unwrap_err();
    parts.iter().for_each(|part| assert!(message.contains(part), "'{part}' is not in: {message}"));
}

#[test]
fn line_ends_tabs_and_blanks_do_not_matter() {
    let samples = motion(103);
    for text in [
        nga_at2(&samples),
        cosmos(&samples, 90),
        csmip_v2(&samples, " 90 Deg"),
        csmip_v1(&samples),
        esm(&samples),
        knet(&samples[..100]),
        smc(&samples),
    ] {
        same(&text.replace('\n', "\r\n"), &text);
        same(&text.replace('\n', "   \n"), &text);
        same(&(text.clone() + "\n\n \n\x1a"), &text);
    }
    let text = nga_at2(&samples);
    same(&text.replace("    ", "\t"), &text);
    same(&text.replace("   ", " ").replace("  ", " "), &text);
    same(&("\u{feff}".to_string() + &text), &text);
}

#[test]
fn numbers_as_fortran_writes_them() {
    let samples = motion(103);
    let text = nga_at2(&samples);
    let with = |letter| {
        let in_g: Vec<f64> = samples.iter().map(|a| a / G).collect();
        rows(&in_g, 5, |a| fortran_e(a, 15, 7, letter))
    };
    same(&text.replace(&with('E'), &with('D')), &text);
    same(&text.replace(&with('E'), &with('e')), &text);
    // Run together wherever a sign allows it.
    let run_together = with('E').replace(" -", "-").replace(" -", "-");
    assert!(run_together.contains("-.") && !run_together.contains(" -."));
    same(&text.replace(&with('E'), &run_together), &text);
}

#[test]
fn fields_without_a_gap_are_read_by_their_width() {
    let samples: Vec<f64> = motion(103).iter().map(|a| 40.0 + 0.1 * a).collect();
    let text = cosmos(&samples, 90);
    assert!(text.lines().any(|line| line.matches('.').count() == 8 && !line.contains(' ')));
    let read = parse(&text).unwrap();
    for (a, b) in read[0].acceleration_m_s2.iter().zip(&samples) {
        assert!((a - b).abs() < 1e-6, "{a} {b}");
    }
}

#[test]
fn latin_1_is_text() {
    let text = nga_at2(&motion(103)).replace("CHY101", "Cura\u{e7}ao");
    let latin: Vec<u8> = text.chars().map(|c| c as u8).collect();
    let motions = read(&latin, None, &Given::default()).unwrap();
    assert_eq!(motions[0].station.as_deref(), Some("Curaçao"));
    assert_eq!(motions, parse(&text).unwrap());
}

/// A file of each format, by name, with a word of its header that may be any other.
fn each_format() -> [(&'static str, String, &'static str); 7] {
    let samples = motion(103);
    [
        ("at2", nga_at2(&samples), "CHY101"),
        ("cosmos", cosmos(&samples, 90), "Bremner"),
        ("csmip v2", csmip_v2(&samples, " 90 Deg"), "Concord"),
        ("csmip v1", csmip_v1(&samples), "Willow"),
        ("esm", esm(&samples), "MIRANDOLA"),
        ("knet", knet(&samples[..100]), "MYG004"),
        ("smc", smc(&samples), "Valle"),
    ]
}

#[test]
fn each_format_is_read_in_latin_1() {
    for (format, text, word) in each_format() {
        let accented = text.replacen(word, "Cura\u{e7}\u{e1}", 1);
        let latin: Vec<u8> = accented.chars().map(|c| c as u8).collect();
        let motions = read(&latin, None, &Given::default()).unwrap_or_else(|why| panic!("{format}: {why}"));
        assert_eq!(motions, parse(&accented).unwrap(), "{format}");
        let words = [&motions[0].event, &motions[0].station].map(|text| text.clone().unwrap_or_default());
        assert!(words.concat().contains("Curaçá"), "{format}: {words:?}");
    }
}

#[test]
fn each_format_refuses_what_is_cut_off_empty_or_junk() {
    for (format, text, _) in each_format() {
        let lines: Vec<&str> = text.lines().collect();
        // One line, part of the header, and the header with part of the samples.
        for kept in [1, lines.len() / 3, lines.len() * 7 / 10] {
            let cut = lines[..kept].join("\n");
            let refused = parse(&cut);
            assert!(refused.is_err(), "{format}: {kept} of {} lines are read", lines.len());
        }
        let mut bytes = text.clone().into_bytes();
        let end = bytes.len();
        bytes[end / 2..end * 3 / 4].fill(0);
        assert!(read(&bytes, None, &Given::default()).is_err(), "{format} with zeros is read");
        assert!(parse(&text.replace(|c: char| c.is_ascii_digit(), "*")).is_err(), "{format} without digits");
    }
}

#[test]
fn velocity_and_displacement_are_refused_with_the_reason() {
    let text = nga_at2(&motion(103));
    let vt2 = text.replace("ACCELERATION TIME SERIES IN UNITS OF G", "VELOCITY TIME SERIES IN UNITS OF CM/S");
    refused(&vt2, &["line 3", "velocity", "VT2", "import the acceleration"]);
    let dt2 =
        text.replace("ACCELERATION TIME SERIES IN UNITS OF G", "DISPLACEMENT TIME SERIES IN UNITS OF CM");
    refused(&dt2, &["line 3", "displacement", "DT2"]);
    refused(&cosmos(&motion(103), 90).replace("acceleration pts", "velocity pts"), &["velocity"]);
    refused(&esm(&motion(103)).replace(": ACCELERATION", ": VELOCITY"), &["velocity"]);
    refused(&smc(&motion(103)).replace("2 CORRECTED ACCELEROGRAM", "3 VELOCITY"), &["line 1", "velocity"]);
}

#[test]
fn a_wrong_count_is_named() {
    let samples = motion(103);
    let counted = |n: &str| at2(&samples, &format!("NPTS= {n}, DT= .0100 SEC"));
    refused(&counted("104"), &["announces 104", "103 follow"]);
    refused(&counted("90"), &["announces 90", "103 follow"]);
    refused(&counted("1000000000000"), &["announces 1000000000000"]);
    refused(&counted("1"), &["1 sample"]);
    // The last line may be filled up.
    assert_eq!(parse(&counted("101")).unwrap()[0].acceleration_m_s2.len(), 101);
    let hostile = |text: String| text.replace("103", "999999999999");
    refused(&hostile(cosmos(&samples, 90)), &["announces 999999999999"]);
    refused(&hostile(csmip_v2(&samples, " 90 Deg")), &["announces"]);
    refused(&hostile(esm(&samples)), &["announces"]);
    refused(&knet(&samples[..100]).replace("Duration Time(s)  1", "Duration Time(s)  1e15"), &["announces"]);
}

#[test]
fn missing_parts_are_named_with_their_line() {
    let samples = motion(103);
    refused(&at2(&samples, "NPTS= 103"), &["line 4", "no DT", "--dt"]);
    let given = Given { dt_s: Some(0.02), ..Given::default() };
    let motions = read(at2(&samples, "NPTS= 103").as_bytes(), None, &given).unwrap();
    assert_eq!(motions[0].dt_s, 0.02);
    refused(&at2(&samples, "NPTS= 103, DT= 0.0"), &["line 4", "time step 0 s"]);
    refused(&at2(&samples, "NPTS= 103, DT= 500"), &["time step 500 s"]);
    refused(&nga_at2(&samples).replace("UNITS OF G", "UNITS OF FURLONGS"), &["line 3", "FURLONGS", "--unit"]);
    refused(&knet(&samples[..100]).replace("Memo.", ""), &["Memo."]);
    refused(&knet(&samples[..100]).replace("/8388608", "/0"), &["line 14"]);
    refused(&esm(&samples).replace("NDATA", "MDATA"), &["no NDATA"]);
    refused(&smc(&samples).replace(" 1.0000000E2", "1.7000000E38"), &["uneven"]);
    refused(&cosmos(&samples, 90).replace("cm/sec2(04)", "counts (50)"), &["counts"]);
    refused("1.0\n2.0\n", &["line 1", "--unit"]);
    let given = Given { unit: Some("g".parse().unwrap()), ..Given::default() };
    let error = |text: &str| read(text.as_bytes(), None, &given).unwrap_err().to_string();
    assert!(error("1.0\n2.0\n").contains("--dt"));
    assert!(error("0 1 2\n1 2 3\n").contains("--column"));
    assert!(error("0 1\n0.01 2\n0.02 2\n0.06 2\n").contains("line 4: a gap of 0.04 s"));
    let uneven = "0 1\n0.01 2\n0.02 2\n0.03 2\n0.04 2\n0.08 1\n0.11 1\n";
    assert!(error(uneven).contains("line 6: a time step of 0.04 s"));
    assert!(error("0 1\n0.01 2\n0.02 **\n").contains("line 3: '**' is not a number"));
}

#[test]
fn a_time_step_that_is_given_stands_for_rounded_times_and_for_no_gap() {
    let rows = |times: &dyn Fn(usize) -> String| -> String {
        let row = |k: usize| format!("{},{:.4}\n", times(k), 0.3 * (0.1 * k as f64).sin());
        "time (s),acc (g)\n".to_string() + &(0..400).map(row).collect::<String>()
    };
    let read = |text: &str, dt_s: Option<f64>| {
        let given = Given { unit: Some("g".parse().unwrap()), dt_s, ..Given::default() };
        let motions = read(text.as_bytes(), None, &given).map_err(|error| error.to_string())?;
        Ok::<f64, String>(motions[0].dt_s)
    };
    // The mean step of even times, as their decimals bear it.
    assert_eq!(read(&rows(&|k| format!("{:.3}", k as f64 * 0.005)), None), Ok(0.005));
    let rounded = read(&rows(&|k| format!("{:.7}", k as f64 / 256.0)), None).unwrap();
    assert!((rounded - 1.0 / 256.0).abs() < 2e-10, "{rounded}");
    let rounded = rows(&|k| format!("{:.2}", k as f64 * 0.005));
    assert!(read(&rounded, None).unwrap_err().contains("give --dt if the times are only rounded"));
    assert_eq!(read(&rounded, Some(0.005)), Ok(0.005));
    let said = read(&rounded, Some(0.01)).unwrap_err();
    assert!(said.contains("where steps of --dt 0.01 s lead to"), "{said}");
    for missing in [1, 19] {
        let gap = rows(&|k| format!("{:.3}", (k + if k > 200 { missing } else { 0 }) as f64 * 0.005));
        for dt_s in [None, Some(0.005)] {
            let said = read(&gap, dt_s).unwrap_err();
            let gap_s = ((missing + 1) * 5) as f64 / 1e3;
            assert!(said.starts_with(&format!("line 203: a gap of {gap_s} s")), "{said}");
        }
    }
}

#[test]
fn files_of_other_programs_are_named() {
    let mut sac = vec![0_u8; 700];
    sac[304] = 6;
    let begins = |magic: &[u8]| [magic, &[0; 600]].concat();
    for (bytes, what) in [
        (begins(b"\x93NUMPY\x01\x00v\x00{'descr': '<f8'"), "a NumPy array"),
        (begins(b"MATLAB 5.0 MAT-file, Platform: GLNXA64"), "a MAT-file"),
        (begins(b"000001D STJ    HNEXX"), "miniSEED"),
        (sac, "a SAC file"),
    ] {
        let said = read(&bytes, None, &Given::default()).unwrap_err().to_string();
        assert!(said.starts_with(what) && said.contains("acceleration_m_s2"), "{said}");
    }
    // Words are none.
    refused("MATLAB export\n", &["begins no known format"]);
}

#[test]
fn what_is_no_record_is_told_so() {
    refused("", &["empty"]);
    refused(" \n\n", &["empty"]);
    refused("Dear colleague,\nplease find attached\n", &["line 1", "Dear colleague", "--format"]);
    let junk: Vec<u8> = (0..5000u32).map(|k| (k.wrapping_mul(2_654_435_761) >> 13) as u8).collect();
    assert!(read(&junk, None, &Given::default()).unwrap_err().to_string().contains("binary"));
    refused(&nga_at2(&motion(103)).replace("E-0", "X-0"), &["is not a number", "line"]);
    refused(
        &nga_at2(&motion(103)).replacen("E+0", "E+9999", 1).replacen("E-0", "E+999", 1),
        &["is not a number"],
    );
}

/// Any bytes, and files of each format with some bytes changed or cut off.
fn damaged() -> impl Strategy<Value = Vec<u8>> {
    let samples = motion(40);
    let files = vec![
        nga_at2(&samples),
        cosmos(&samples, 90),
        csmip_v2(&samples, " 90 Deg"),
        csmip_v1(&samples),
        esm(&samples),
        knet(&samples),
        smc(&samples),
        "t;a\n0;1\n0.1;2\n".to_string(),
    ];
    let damages = prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..8);
    (prop::sample::select(files), damages, any::<prop::sample::Index>()).prop_map(|(file, damages, end)| {
        let mut bytes = file.into_bytes();
        for (at, byte) in damages {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        let whole = end.index(2) == 0;
        bytes.truncate(if whole { bytes.len() } else { end.index(bytes.len()) });
        bytes
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn no_bytes_panic(bytes in prop_oneof![damaged(), prop::collection::vec(any::<u8>(), 0..400), ".{0,400}".prop_map(String::into_bytes)]) {
        let given = Given { dt_s: Some(0.01), unit: Some("g".parse().unwrap()), column: None };
        for given in [Given::default(), given] {
            let _ = read(&bytes, None, &given);
            for format in Format::ALL {
                if let Ok(motions) = read(&bytes, Some(*format), &given) {
                    for motion in motions {
                        prop_assert!(motion.acceleration_m_s2.iter().all(|a| a.is_finite()));
                        prop_assert!(motion.dt_s > 0.0 && motion.acceleration_m_s2.len() >= 2);
                    }
                }
            }
        }
    }
}

#[test]
fn units_are_what_they_are_called() {
    for (names, in_m_s2) in [
        (&["g"][..], G_M_S2),
        (&["mg", "milli-g"], 1e-3 * G_M_S2),
        (&["m/s2", "m/s/s", "m/s^2"], 1.0),
        (&["cm/s2", "gal", "GAL", " cm/s^2 "], 0.01),
        (&["mm/s2"], 0.001),
    ] {
        for name in names {
            let unit: AccelerationUnit = name.parse().unwrap();
            assert!((unit.in_m_s2() / in_m_s2 - 1.0).abs() < 1e-15, "{name}");
            assert_eq!(unit.to_string().parse(), Ok(unit), "{name}");
        }
    }
    assert!("furlong".parse::<AccelerationUnit>().unwrap_err().contains("expected g, mg, m/s2"));
}
