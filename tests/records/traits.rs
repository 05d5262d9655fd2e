//! Traits of real files: each is read as the agency means it, or refused.

use rockfrag::inputs::InputError;
use rockfrag::inputs::records::is_vertical;
use rockfrag_core::records::RecordedMotion;
use rockfrag_core::units::Unit;

use crate::writers::*;

fn read(text: &str) -> Vec<RecordedMotion> {
    read_with(text, "").unwrap_or_else(|why| panic!("{why}"))
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
        at2_of(&samples, |a| format!("{a:13.6E}").replace('E', "D")),
    ] {
        assert!(text.lines().any(|line| line.contains("0-0.") || line.matches('.').count() == 8));
        expect_samples(&read(&text)[0], &samples, 1e-6 * G);
    }
    // Other formats of the same numbers.
    let cm: Vec<f64> = samples.iter().map(|a| (a * 1e4).round() / 1e4).collect();
    let text = esm(&cm);
    let (head, body) = text.split_once("USER5:\n").unwrap();
    expect_samples(&read(&format!("{head}USER5:\n{}", body.replace("\n-", "-")))[0], &cm, 1e-6);
    // Three signs in a row are damage.
    assert!(read_with(&at2_of(&samples, |a| format!("{a:9.6}--")), "").is_err());
}

#[test]
fn at2_has_its_count_under_several_names_or_none() {
    let samples = motion(403);
    let accelerations = at2(&samples, "Accelerations (g)", "403.0 .01 7");
    assert_eq!(read(&accelerations), read(&at2(&samples, IN_G, "403 .01")));
    for counts in [
        "NPT= 403, DT= .0100",
        "NPTS=403 DT=0.01",
        "NPTS : 403, DT : 0.01 SEC",
        "403 0.01",
        "403 0.0100 NPTS, DT",
        "npts= 403, dt= 1.0D-02 sec",
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
    let recorder = |code: &str| plain.replace("| Recorder: QUANTERRA Q330", code);
    for text in [
        code(400),
        code(401),
        code(402),
        plain.replace("1:360 deg", "1:Down   "),
        plain.replace("1:360 deg", "1: Up    "),
        recorder("|<SCNL>12345.HNZ.XX.10 <AUTH>"),
        table("# Component: UP\ntime,acc (g)", G, 1, seconds),
    ] {
        assert!(text != plain && is_vertical(&read(&text)[0].origin));
    }
    for text in [plain.clone(), recorder("|<SCNL>12345.HNN.XX.10 <AUTH>")] {
        assert_eq!(read(&text)[0].origin.azimuth_deg, Some(360.0));
    }
    let verticals = [
        "DOWN", "VRT", "-UP", "DN", "UPD", "VT", "DWN", "V1", "90V", "Up", "U-D", "vertical", "V", "HNZ",
        "CHY101-V", "Vert.", "UP1", "U-D2",
    ];
    let horizontals = ["N", "090", "N90E", "H1", "TR", "LN", "E-W", "H-Z14000", "U1"];
    for name in verticals.into_iter().chain(horizontals) {
        let text = nga_at2(&samples).replace(", 270", &format!(", {name}"));
        assert_eq!(is_vertical(&read(&text)[0].origin), verticals.contains(&name), "{name}");
    }
}

#[test]
fn a_borehole_is_known_by_its_direction() {
    let is_in_borehole = |direction: &str| {
        read(&knet(&motion(400)).replace("Dir.              5", &format!("Dir.              {direction}")))[0]
            .is_in_borehole
    };
    assert!(["1", "2", "3"].map(is_in_borehole) == [true; 3]);
    assert!(["4", "5", "6", "N-S"].map(is_in_borehole) == [false; 4]);
}

#[test]
fn units_are_read_in_every_notation() {
    for (text, si) in [
        ("\u{b5}m/s\u{b2}", 1e-6),
        ("\u{3bc}m/s2", 1e-6),
        ("nm/s**2", 1e-9),
        ("mGal", 1e-5),
        ("m\u{b7}s\u{207b}\u{b2}", 1.0),
        ("m s\u{207b}\u{b2}", 1.0),
        ("mm s^-2", 0.001),
        ("Gal", 0.01),
    ] {
        let unit = Unit::parse_acceleration(text).unwrap_or_else(|why| panic!("{text}: {why}"));
        assert!((unit.si / si - 1.0).abs() < 1e-12, "{text}: {}", unit.si);
    }
    for text in ["m\u{b7}s\u{207b}\u{b9}", "km/s", "Gal/s", "um", "furlong", "cm"] {
        assert!(Unit::parse_acceleration(text).is_err(), "{text}");
    }
}

/// A table of times and two or three columns, of the samples, half of them, and a third.
fn table(heading: &str, unit: f64, columns: usize, time: impl Fn(usize) -> String) -> String {
    let row = |(k, a): (usize, &f64)| {
        let cells = [1.0, 0.5, 1.0 / 3.0].map(|share| format!(",{:.7}", share * a / unit));
        time(k) + &cells[..columns].concat() + "\n"
    };
    heading.to_string() + "\n" + &motion(400).iter().enumerate().map(row).collect::<String>()
}

fn seconds(k: usize) -> String {
    format!("{:.2}", k as f64 * DT)
}

#[test]
fn columns_of_directions_are_motions_of_their_own() {
    for (heading, unit, azimuths) in [
        ("t,acc_N (m/s2),acc_E (m/s2),acc_Z (m/s2)", 1.0, [Some(0.0), Some(90.0)]),
        ("time,NS [g],EW [g],UD [g]", G, [Some(0.0), Some(90.0)]),
        ("time (s),acc 30 deg (g),acc 120 deg (g),acc up (g)", G, [Some(30.0), Some(120.0)]),
        ("time,ax (m/s2),ay (m/s2),Z (m/s2)", 1.0, [None, None]),
        ("time,ax (g),ay (g),az (g)", G, [None, None]),
        ("t (s),accN (g),accE (g),accZ (g)", G, [Some(0.0), Some(90.0)]),
        ("Time (s),L (g),T (g),V (g)", G, [None, None]),
        ("time,acc_1 (g),acc_2 (g),acc_up (g)", G, [None, None]),
        ("# Components: 1, 2, vertical\ntime,acc_1 (g),acc_2 (g),acc_up (g)", G, [None, None]),
        (
            "# AmplitudeUnit: gal. DC\n# MAX. E: 2~ -1\n# Data: Time N(+); E(+); U(+)",
            0.01,
            [Some(0.0), Some(90.0)],
        ),
    ] {
        let read = read_with(&table(heading, unit, 3, seconds), "").unwrap();
        let (vertical, horizontal): (Vec<_>, Vec<_>) = read.iter().partition(|one| is_vertical(&one.origin));
        assert_eq!((vertical.len(), horizontal.len()), (1, 2), "{heading}");
        assert_eq!([0, 1].map(|index: usize| horizontal[index].origin.azimuth_deg), azimuths, "{heading}");
        expect_samples(horizontal[0], &motion(400), 2e-6 * G);
        let half: Vec<f64> = motion(400).iter().map(|a| 0.5 * a).collect();
        expect_samples(horizontal[1], &half, 2e-6 * G);
    }
    // Names that are no directions, and one motion in two units, are a question.
    let in_both = |k: usize| format!("{},{:.7}", seconds(k), motion(400)[k] / G);
    for (text, options) in [
        (table("n,time,x", G, 1, |k| format!("{k},{}", seconds(k))), "unit=g"),
        (table("time,first,second", G, 2, seconds), "unit=g"),
        (table("time,Base N-S (g),Roof N-S (g)", G, 2, seconds), ""),
        (table("time,N-S1 (g),N-S2 (g)", G, 2, seconds), ""),
        (table("time,acc (g),filtered acc (g)", G, 2, seconds), ""),
        (table("time,Original Acceleration [g],Matched Acceleration [g]", G, 2, seconds), ""),
        (table("time,acc (g),acc (m/s2)", 1.0, 1, in_both), ""),
        (table("time,NS (g),EW (m/s2)", G, 2, seconds), ""),
    ] {
        let refusal = read_with(&text, options);
        assert!(matches!(refusal, Err(InputError::Column { .. })), "{}", &text[..40]);
    }
}

#[test]
fn clocks_are_times_and_no_samples() {
    let second = |k: usize| format!("{:05.2}", k as f64 * DT);
    let relative = |k: usize| format!("2020/01/20 20:13:{},{:.2}", second(k), k as f64 * DT);
    for text in [
        "#Station\n#TST001\n".to_string()
            + &table("#Time,RelativeTime(s),N-S(gal),E-W(gal),U-D(gal)", 0.01, 3, relative),
        table("Time,N-S (gal),E-W (gal),U-D (gal)", 0.01, 3, |k| format!("2020-01-20T20:13:{}", second(k))),
        table("datetime,N-S (gal),E-W (gal)", 0.01, 2, |k| format!("2020-01-20T20:13:{}Z", second(k))),
        table("time,N-S (gal),E-W (gal)", 0.01, 2, |k| format!("20:13:{} +09:00", second(k))),
        table("time,N-S (gal),E-W (gal)", 0.01, 2, |k| format!("8:13:{} PM", second(k))),
        table("time,N-S (gal),E-W (gal)", 0.01, 2, |k| format!("20:13:{:02}:{:03}", k / 100, k % 100 * 10)),
        table("Date,Time,N-S (gal),E-W (gal)", 0.01, 2, |k| format!("2020-01-20,20:13:{}", second(k))),
        // Over midnight.
        table("time,N-S (gal),E-W (gal)", 0.01, 2, |k| match k.checked_sub(200) {
            None => format!("23:59:{}", second(5800 + k)),
            Some(after) => format!("00:00:{}", second(after)),
        }),
    ] {
        let read = read_with(&text, "").unwrap_or_else(|why| panic!("{why}: {}", &text[..80]));
        assert!(read.iter().all(|motion| (motion.dt_s - DT).abs() < 1e-9));
        assert_eq!(read.iter().filter(|motion| !is_vertical(&motion.origin)).count(), 2);
        expect_samples(&read[0], &motion(400), 1e-6);
    }
    for (hours, step) in [(0, 1), (1, 0)] {
        let after = |k: usize| usize::from(k > 100);
        let gap = |k: usize| format!("{:02}:00:{}", hours * after(k), second(k + step * after(k)));
        let gap = read_with(&table("time,acc (g)", G, 1, gap), "");
        assert!(matches!(gap, Err(InputError::UnevenTime { line: 103, .. })), "{gap:?}");
    }
}

#[test]
fn a_short_line_before_the_last_shows_blocks() {
    let block = |n: usize| {
        let row = |row: &[f64]| row.iter().map(|a| format!("{a:9.5}")).collect::<String>() + "\n";
        motion(n).chunks(10).map(row).collect::<String>()
    };
    let cut: Vec<String> = block(400).lines().map(|line| line.to_string() + "\n").collect();
    let cut = cut[..20].concat() + &cut[20][..45] + "\n" + &cut[20][45..] + &cut[21..].concat();
    let options = "unit=m/s2 dt=0.01 column=all";
    expect_samples(&read_with(&block(397), options).unwrap()[0], &motion(397), 1e-5);
    expect_samples(&read_with(&block(400), options).unwrap()[0], &motion(400), 1e-5);
    for (text, line) in [
        (block(397) + &block(397), 40),
        (block(397) + "\n" + &block(400), 40),
        ("velocity\n".to_string() + &block(394) + &block(397) + &block(397), 41),
        (cut, 21),
    ] {
        let refusal = format!("{:?}", read_with(&text, options));
        assert!(refusal.starts_with(&format!("Err(ShortLine {{ line: {line},")), "{refusal}");
    }
}
