//! Files of records as people have them, with what is easily wrong: each is read as it is meant, or refused with the reason.

use std::f64::consts::PI;
use std::fmt::Write;
use std::path::Path;

use crate::common::{fail, rockfrag, succeed};
use crate::snapshot::{check_each, redact};

const G: f64 = 9.81;
const DT: f64 = 0.01;

/// What must become of a file.
#[derive(Clone, Copy)]
enum Is {
    /// Read as the motion that it is.
    Read,
    /// Refused, with these words.
    Refused(&'static str),
}
use Is::{Read, Refused};

/// A motion of about 0.3 g and 0.28 m/s that begins and ends at rest, in units of so many m/s2.
fn samples(unit: f64) -> Vec<f64> {
    let motion = |k: usize| {
        let t = k as f64 * DT - 8.0;
        3.0 * (-(t / 3.0).powi(2)).exp() * (2.0 * PI * 1.7 * t).sin()
    };
    (0..1601).map(|k| motion(k) / unit).collect()
}

/// Lines of the fields that `row` makes of place and sample.
fn lines(heading: &str, unit: f64, row: impl Fn(usize, f64) -> String) -> Vec<u8> {
    let rows = samples(unit).into_iter().enumerate().map(|(k, a)| row(k, a) + "\n");
    (heading.to_string() + &rows.collect::<String>()).into_bytes()
}

fn time(k: usize) -> f64 {
    k as f64 * DT
}

/// A CSV file of times and samples under this heading.
fn csv(heading: &str, unit: f64) -> Vec<u8> {
    lines(&format!("{heading}\n"), unit, |k, a| format!("{:.2},{a:.6}", time(k)))
}

/// A CSV file in g, changed.
fn changed(heading: &str, change: impl Fn(String) -> String) -> Vec<u8> {
    change(String::from_utf8(csv(heading, G)).unwrap()).into_bytes()
}

fn at2(line: &str, dt: &str, samples: &[f64]) -> Vec<u8> {
    let mut text = format!(
        "PEER NGA STRONG MOTION DATABASE RECORD\nChi-Chi, Taiwan, 9/20/1999, CHY101, 270\n{line}\nNPTS= {}, DT= {dt} SEC\n",
        samples.len()
    );
    for row in samples.chunks(5) {
        row.iter().for_each(|a| write!(text, "{a:15.7E}").unwrap());
        text.push('\n');
    }
    text.into_bytes()
}

const IN_G: &str = "ACCELERATION TIME SERIES IN UNITS OF G";

/// AT2 in g, with a change of the samples.
fn at2_of(dt: &str, change: impl Fn(usize, f64) -> f64) -> Vec<u8> {
    let samples: Vec<f64> = samples(G).into_iter().enumerate().map(|(k, a)| change(k, a)).collect();
    at2(IN_G, dt, &samples)
}

fn utf_16(text: &[u8]) -> Vec<u8> {
    let text = std::str::from_utf8(text).unwrap();
    [0xfeff].into_iter().chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect()
}

fn latin_1(text: &[u8]) -> Vec<u8> {
    std::str::from_utf8(text).unwrap().chars().map(|c| c as u8).collect()
}

/// What is wrong, the file, the options, and what must become of it.
fn slips() -> Vec<(&'static str, Vec<u8>, &'static str, Is)> {
    let swapped = |k: usize, a: f64| format!("{a:.6},{:.2}", time(k));
    let numbered = |k: usize, a: f64| format!("{k},{:.2},{a:.6}", time(k));
    let three = |k: usize, a: f64| format!("{:.2},{a:.6},{:.6},{:.6}", time(k), -a, 0.5 * a);
    let unit_row = "time,acc\ns,cm/s2";
    vec![
        // Units.
        (
            "unit in the heading against --unit",
            csv("time,acc_cm_s2", 0.01),
            "--unit g",
            Refused("the unit is cm/s2, --unit says g"),
        ),
        (
            "unit in brackets against --unit",
            csv("time,acceleration (m/s2)", 1.0),
            "--unit g",
            Refused("the unit is m/s2"),
        ),
        ("unit in the heading", csv("time,acc_g", G), "", Read),
        ("unit in the heading and --unit", csv("time,acc_g", G), "--unit g", Read),
        ("cm/s^2", csv("t (s),a [cm/s^2]", 0.01), "", Read),
        ("gal", csv("time,Acc. [Gal]", 0.01), "", Read),
        ("mg", csv("time,acc_mg", 1e-3 * G), "", Read),
        ("percent of g", csv("time,acc (%g)", 0.01 * G), "", Read),
        ("m/s/s", csv("time,acc m/s/s", 1.0), "", Read),
        ("inches", csv("time,acc_in_s2", 0.0254), "", Read),
        ("feet", csv("time,ag [ft/s2]", 0.3048), "", Read),
        ("millimetres", csv("time,acc (mm/s2)", 0.001), "", Read),
        ("exponent above, in quotes with a comma", csv("time,\"acc, cm/sec\u{b2}\"", 0.01), "", Read),
        ("negative exponent", csv("time,acc (m s^-2)", 1.0), "", Read),
        ("counts", csv("time,acc (counts)", 1e-4), "--unit g", Refused("acceleration in 'counts'")),
        ("acceleration in cm/s", csv("time,acc (cm/s)", 0.01), "--unit g", Refused("acceleration in 'cm/s'")),
        ("a row of units", csv(unit_row, 0.01), "", Read),
        ("a row of units against --unit", csv(unit_row, 0.01), "--unit g", Refused("the unit is cm/s2")),
        ("unit in a comment", csv("# acceleration in cm/s2", 0.01), "", Read),
        (
            "unit in a comment against --unit",
            csv("# units: cm/s2", 0.01),
            "--unit g",
            Refused("the unit is cm/s2"),
        ),
        ("no unit", csv("time,acc", G), "", Refused("no unit")),
        // Contents.
        ("velocity", csv("time,vel", G), "--unit g", Refused("velocity, not acceleration")),
        ("velocity by its unit", csv("time,x (cm/s)", G), "--unit g", Refused("velocity, not acceleration")),
        ("displacement", csv("time,disp [cm]", G), "--unit g", Refused("displacement, not acceleration")),
        (
            "velocity in a comment",
            csv("# velocity in cm/s", G),
            "--unit g",
            Refused("velocity, not acceleration"),
        ),
        (
            "velocity in a comment with commas",
            lines("# Velocity, filtered\n", G, |_, a| format!("{a:.6},{:.6}", -a)),
            "--unit g --dt 0.01",
            Refused("velocity, not acceleration"),
        ),
        (
            "velocity further on in a comment",
            csv("# time history of velocity (cm/s)", G),
            "--unit g",
            Refused("velocity, not acceleration"),
        ),
        (
            "velocity, chosen",
            csv("time,vel", G),
            "--unit g --column vel",
            Refused("velocity, not acceleration"),
        ),
        (
            "AT2 of velocity",
            at2("VELOCITY TIME HISTORY (CM/S)", ".01", &samples(G)),
            "--unit g",
            Refused("velocity, as in a VT2 file"),
        ),
        (
            "times alone",
            lines("time\n", G, |k, _| format!("{:.2}", time(k))),
            "--unit g --dt 0.01",
            Refused("time, not acceleration"),
        ),
        // Times.
        ("time_ms", lines("time_ms,acc_g\n", G, |k, a| format!("{},{a:.6}", 10 * k)), "", Read),
        ("Time [ms]", lines("Time [ms],Acc [g]\n", G, |k, a| format!("{},{a:.6}", 10 * k)), "", Read),
        (
            "milliseconds, unsaid",
            lines("time,acc_g\n", G, |k, a| format!("{},{a:.6}", 10 * k)),
            "",
            Refused("dt 10 s"),
        ),
        ("times in percent", csv("time (%),acc_g", G), "", Refused("times in '%'")),
        ("index of pandas", lines(",time,acc\n", G, numbered), "--unit g --column acc", Read),
        (
            "index of pandas, no times",
            lines(",acc\n", G, |k, a| format!("{k},{a:.6}")),
            "--unit g",
            Refused("no time step"),
        ),
        ("sample numbers", lines("", G, |k, a| format!("{k} {a:.6}")), "--unit g", Refused("no time step")),
        (
            "row names of R",
            lines("time acc\n", G, |k, a| numbered(k + 1, a).replace(',', " ")),
            "--unit g --column acc",
            Refused("2 headings over 3 columns"),
        ),
        ("--dt against times", csv("time,acc_g", G), "--dt 0.005", Refused("--dt says 0.005 s")),
        (
            "--dt against a comment",
            lines("# dt = 0.01 s\n", G, |_, a| format!("{a:.6}")),
            "--unit g --dt 0.005",
            Refused("--dt says 0.005 s"),
        ),
        ("dt in a comment", lines("# dt = 0.01 s\n", G, |_, a| format!("{a:.6}")), "--unit g", Read),
        (
            "hours, minutes, seconds",
            lines("time,acc_g\n", G, |k, a| format!("00:00:{:05.2},{a:.6}", time(k))),
            "",
            Refused("a time of day"),
        ),
        (
            "times backwards",
            lines("time,acc_g\n", G, |k, a| format!("{:.2},{a:.6}", -time(k))),
            "",
            Refused("time step -0.01"),
        ),
        (
            "times twice",
            lines("time,acc_g\n", G, |k, a| format!("{:.2},{a:.6}", time(k / 2 * 2))),
            "",
            Refused("expected even ones"),
        ),
        // Columns.
        ("acceleration first", lines("acc_g,time\n", G, swapped), "", Read),
        ("velocity and displacement beside it", lines("time,acc_g,vel,disp\n", G, three), "", Read),
        ("three components", lines("time,N,E,Z\n", G, three), "--unit g", Refused("(time, N, E, Z)")),
        (
            "two components, no times",
            lines("", G, |_, a| format!("{a:.6} {:.6}", -0.5 * a)),
            "--unit g --dt 0.01",
            Refused("2 columns"),
        ),
        ("no such column", csv("time,acc_g", G), "--column a", Refused("(time, acc_g)")),
        (
            "an empty field",
            lines("time,vel,acc\n", G, |k, a| format!("{:.2},,{a:.6}", time(k))),
            "--unit g --column 2",
            Refused("nothing in column 2"),
        ),
        ("headings twice", csv("time,acc_g\ntime,acc_g", G), "", Read),
        (
            "two files in one",
            [csv("time,acc_g", G), csv("time,acc_g", G)].concat(),
            "",
            Refused("line 1603: 'time' is not a number"),
        ),
        ("commas at the ends", changed("time,acc_g", |text| text.replace('\n', ",\n")), "", Read),
        ("lines of commas at the end", changed("time,acc_g", |text| text + ",\n,\n"), "", Read),
        // Numbers.
        (
            "semicolons and decimal commas",
            changed("time,acc_g", |text| text.replace(',', ";").replace('.', ",")),
            "",
            Read,
        ),
        (
            "decimal commas among commas",
            changed("time,acc_g", |text| text.replace('.', ",")),
            "",
            Refused("are there decimal commas"),
        ),
        (
            "decimal commas among blanks",
            changed("time,acc_g", |text| text.replace(',', " ").replace('.', ",")),
            "",
            Refused("has decimal commas"),
        ),
        (
            "thousands",
            lines("time,acc (mm/s2)\n", 0.001, |k, a| {
                format!("{:.2},\"{},{:03}.0\"", time(k), a as i64 / 1000, (a as i64 % 1000).abs())
            }),
            "",
            Refused("without thousands separators"),
        ),
        (
            "exponents of Fortran",
            lines("time,acc_g\n", G, |k, a| format!("{:.2},{a:.6E}", time(k)).replace('E', "D")),
            "",
            Read,
        ),
        ("minus signs of typesetters", changed("time,acc_g", |text| text.replace('-', "\u{2212}")), "", Read),
        (
            "NaN",
            changed("time,acc_g", |text| text.replacen("0.30", "NaN", 1)),
            "",
            Refused("'NaN' is not a number"),
        ),
        (
            "words at the end",
            changed("time,acc_g", |text| text + "end of record\n"),
            "",
            Refused("'end' is not a number"),
        ),
        // Bytes.
        ("UTF-16", utf_16(&csv("time,acc_g", G)), "", Read),
        (
            "byte-order mark and returns",
            changed("\u{feff}time,acc_g", |text| text.replace('\n', "\r\n")),
            "",
            Read,
        ),
        ("returns alone", changed("time,acc_g", |text| text.replace('\n', "\r")), "", Read),
        ("Latin-1 with degrees and squares", latin_1(&csv("Zeit,acc 90\u{b0} (m/s\u{b2})", 1.0)), "", Read),
        ("non-breaking blanks", changed("time,acc\u{a0}(g)", |text| text.replace(',', ",\u{a0}")), "", Read),
        ("an Excel workbook", b"PK\x03\x04\x14\x00\x06\x00".to_vec(), "", Refused("save it as CSV")),
        ("an archive", b"\x1f\x8b\x08\x00".to_vec(), "", Refused("gzip archive; expected")),
        ("nothing", Vec::new(), "", Refused("the file is empty")),
        ("headings alone", b"time,acc_g\n".to_vec(), "", Refused("begins no known format")),
        // What was never recorded.
        ("cm/s2 called g", at2(IN_G, ".01", &samples(0.01)), "", Refused("PGA 299 g")),
        ("g called cm/s2", csv("time,acc_cm_s2", G), "", Refused("too weak to rock anything")),
        ("dt in milliseconds", at2_of("10.0", |_, a| a), "", Refused("dt 10 s")),
        ("dt of twenty times", at2_of(".2", |_, a| a), "", Refused("dt 0.2 s")),
        ("dt of a fiftieth", at2_of(".0002", |_, a| a), "", Refused("mean frequency 85 Hz")),
        (
            "a spike of 50 g",
            at2_of(".01", |k, a| if k == 700 { 50.0 } else { a }),
            "",
            Refused("sample 701 of 50 g"),
        ),
        (
            "a spike of 2 g",
            at2_of(".01", |k, a| if k == 700 { 2.0 } else { a }),
            "",
            Refused("sample 701 of 2 g"),
        ),
        ("an offset of 0.05 g", at2_of(".01", |_, a| a + 0.05), "", Refused("--baseline linear")),
        ("an offset, removed", at2_of(".01", |_, a| a + 0.05), "--baseline linear", Read),
        ("zeros", at2_of(".01", |_, _| 0.0), "", Refused("0 throughout")),
    ]
}

#[test]
fn each_slip_is_read_as_meant_or_refused_with_the_reason() {
    let folder = tempfile::tempdir().unwrap();
    let mut all = String::new();
    for (what, content, options, is) in slips() {
        std::fs::write(folder.path().join("r.csv"), content).unwrap();
        let call = format!("import-motions r.csv --force {options}");
        let output = rockfrag(folder.path()).args(call.split_whitespace()).output().unwrap();
        let told = String::from_utf8(output.stderr).unwrap();
        let (code, words): (i32, &[&str]) = match is {
            Read => (0, &["dt 0.01 s", "PGA 0.305 g (r), PGV 0.281 m/s"]),
            Refused(words) if words.contains("too weak") => (0, &[words]),
            Refused(ref words) => (1, std::slice::from_ref(words)),
        };
        assert_eq!(output.status.code(), Some(code), "{what}: {told}");
        words.iter().for_each(|word| assert!(told.contains(word), "{what}: '{word}' is not in: {told}"));
        writeln!(all, "## {what}\n$ rockfrag {call}\n{told}").unwrap();
    }
    check_each("message", [("slips.each".to_string(), redact(&all))]);
}

fn write(folder: &Path, name: &str, content: &[u8]) {
    std::fs::write(folder.join(name), content).unwrap();
}

#[test]
fn equal_refusals_are_told_once_and_what_is_accepted_is_named() {
    let folder = tempfile::tempdir().unwrap();
    for k in 0..13 {
        write(folder.path(), &format!("{k:02}.csv"), &csv("time,acc", G));
    }
    let all = (0..13).map(|k| format!("{k:02}.csv ")).collect::<String>();
    fail(
        folder.path(),
        &format!("import-motions {all}"),
        1,
        &["13 of 13 files refused", "13 files: line 2: no unit", "00.csv, 01.csv", "and 3 more"],
    );
    write(folder.path(), "a.at2", &at2(IN_G, ".01", &samples(0.01)));
    write(folder.path(), "b.at2", &at2(IN_G, ".01", &samples(0.02)));
    write(folder.path(), "c.at2", &at2(IN_G, ".01", &samples(G)));
    let call = "import-motions a.at2 b.at2 c.at2";
    fail(
        folder.path(),
        call,
        1,
        &["2 files: the largest ever recorded", "a.at2 (PGA 299 g), b.at2 (PGA 150 g)"],
    );
    let told = succeed(folder.path(), &format!("{call} --accept-implausible"));
    assert!(told.contains("3 records: at2 (3); unit g (3 by the file)"), "{told}");
    assert!(told.contains("warning: 2 motions: the largest ever recorded"), "{told}");
    assert_eq!(succeed(folder.path(), &format!("{call} --accept-implausible --force --quiet")), "");
    write(folder.path(), "two.csv", b"time,acc_g\n0,0.1\n0.01,0.2\n");
    fail(
        folder.path(),
        "import-motions two.csv",
        1,
        &["two.csv: 2 samples", "25 or more", "--accept-implausible"],
    );
    // What is scaled is judged as it was recorded.
    succeed(folder.path(), "import-motions c.at2 --scale 100 --force");
    let section = "import-motions: { files: [a.at2, b.at2], accept-implausible: true }\n";
    write(folder.path(), "pipeline.yaml", section.as_bytes());
    assert!(succeed(folder.path(), "run").contains("2 motions of 2 files"));
}

#[test]
fn a_record_in_place_of_motions_leads_to_import_motions() {
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), "r.csv", &csv("time,acc_g", G));
    for stage in ["simulate", "ida"] {
        let call = format!("{stage} --structures paper --in r.csv");
        fail(folder.path(), &call, 1, &["r.csv: not a Parquet file", "import-motions of records and CSV"]);
    }
}

#[test]
fn motions_of_others_are_judged_with_a_warning() {
    use std::sync::Arc;

    use arrow_array::{ArrayRef, Float64Array, Int64Array, ListArray, types::Float64Type};

    let folder = tempfile::tempdir().unwrap();
    let list = |samples: Vec<f64>| Some(samples.into_iter().map(Some).collect::<Vec<_>>());
    let motions = vec![list(samples(1.0)), list(samples(0.01)), list(samples(0.02)), list(samples(1.0))];
    let columns: Vec<(&str, ArrayRef)> = vec![
        ("motion_id", Arc::new(Int64Array::from(vec![1, 2, 3, 4]))),
        ("dt_s", Arc::new(Float64Array::from(vec![DT; 4]))),
        ("acceleration_m_s2", Arc::new(ListArray::from_iter_primitive::<Float64Type, _, _>(motions))),
        ("pga_m_s2", Arc::new(Float64Array::from(vec![None, None, None, Some(0.305)]))),
    ];
    crate::common::write(&folder.path().join("m.parquet"), columns);
    for stage in ["simulate", "ida"] {
        let told = succeed(folder.path(), &format!("{stage} --in m.parquet --structures paper"));
        assert!(told.contains("warning: 2 motions: the largest ever recorded"), "{told}");
        assert!(told.contains("2 (PGA 30.5 g), 3 (PGA 15.2 g)"), "{told}");
        assert!(told.contains("warning: 4: 0.305 m/s2 for 2.991 m/s2; column 'pga_m_s2'"), "{told}");
        assert_eq!(told.matches("warning").count(), 2, "{told}");
    }
}
