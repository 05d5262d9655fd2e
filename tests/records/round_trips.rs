//! Each format: what is written is what is read.

use rockfrag::records::{Format, Given, RecordedMotion, read};

use crate::writers::*;

#[track_caller]
fn one(text: &str) -> RecordedMotion {
    let mut motions = read(text.as_bytes(), None, &Given::default()).unwrap();
    assert_eq!(motions.len(), 1);
    motions.remove(0)
}

/// That samples are right to half the last digit of the file, and the peak to what the header says.
#[track_caller]
fn assert_is(read: &RecordedMotion, written: &[f64], half_digit: f64) {
    assert!((read.dt_s - DT).abs() < 1e-12, "{}", read.dt_s);
    assert_eq!(read.acceleration_m_s2.len(), written.len());
    for (a, b) in read.acceleration_m_s2.iter().zip(written) {
        assert!((a - b).abs() <= half_digit * 1.001 + 1e-6 * b.abs(), "{a} {b}");
    }
}

#[track_caller]
fn assert_peak(read: &RecordedMotion) {
    read.header_pga.expect("the header gives the peak").check(&read.acceleration_m_s2, 1e-4).unwrap();
}

#[track_caller]
fn assert_words(read: &RecordedMotion, event: &str, station: &str, component: &str, azimuth: Option<f64>) {
    let text = |text: &Option<String>| text.clone().unwrap_or_default();
    assert_eq!(
        (text(&read.event), text(&read.station), text(&read.component)),
        (event.to_string(), station.to_string(), component.to_string())
    );
    assert_eq!(read.azimuth_deg, azimuth);
}

#[test]
fn at2_of_nga() {
    let samples = motion(1003);
    let read = one(&nga_at2(&samples));
    assert_is(&read, &samples, 1e-7);
    assert_words(&read, "Chi-Chi, Taiwan, 9/20/1999", "CHY101", "270", Some(270.0));
    assert_eq!(read.header_pga, None);
}

#[test]
fn at2_of_the_first_database() {
    let samples = motion(503);
    let text = nga_at2(&samples)
        .replace(
            "PEER NGA STRONG MOTION DATABASE RECORD",
            "PACIFIC ENGINEERING AND ANALYSIS STRONG-MOTION DATA",
        )
        .replace(
            "Chi-Chi, Taiwan, 9/20/1999, CHY101, 270",
            "IMPERIAL VALLEY 10/15/79 2316, El Centro Array #4, UP",
        )
        .replace(
            "ACCELERATION TIME SERIES IN UNITS OF G",
            &format!(
                "ACCELERATION TIME HISTORY IN UNITS OF G,  PGA=   {:.5} G, PGV= 1 CM/SEC",
                peak(&samples) / G
            ),
        );
    let read = one(&text);
    assert_is(&read, &samples, 1e-7);
    assert_peak(&read);
    assert_words(&read, "IMPERIAL VALLEY 10/15/79 2316", "El Centro Array #4", "UP", None);
    // The oldest files name the numbers after giving them.
    let oldest = at2(&samples, &format!(" {}   {DT:.4}    NPTS, DT", samples.len()));
    assert_is(&one(&oldest), &samples, 1e-7);
}

#[test]
fn cosmos_with_two_channels() {
    let (north, east) = (motion(1003), motion(400));
    let text = cosmos(&north, 360) + &cosmos(&east, 90);
    let motions = read(text.as_bytes(), None, &Given::default()).unwrap();
    assert_eq!(motions.len(), 2, "velocities are left out");
    assert_is(&motions[0], &north, 0.5e-7);
    assert_is(&motions[1], &east, 0.5e-7);
    motions.iter().for_each(assert_peak);
    assert_words(
        &motions[1],
        "Point MacKenzie Earthquake of Fri Nov 30, 2018 17:29 UTC",
        "AK-BMR UAF Bremner River, AK, USA",
        "90 deg",
        Some(90.0),
    );
}

#[test]
fn csmip_of_both_volumes() {
    let samples = motion(1003);
    let text = csmip_v2(&samples, " 90 Deg") + &csmip_v2(&samples, "  Up");
    let motions = read(text.as_bytes(), None, &Given::default()).unwrap();
    assert_eq!(motions.len(), 2);
    for motion in &motions {
        assert_is(motion, &samples, 0.5e-7);
        assert_peak(motion);
    }
    let (event, station) = ("Sun Aug 24, 2014 03:20:33.0 PDT", "Concord - Clayton & Ellis");
    assert_words(&motions[0], event, station, "90 Deg", Some(90.0));
    assert_words(&motions[1], event, station, "Up", None);

    let read = one(&csmip_v1(&samples));
    assert_is(&read, &samples, 0.5e-6 * G);
    assert_peak(&read);
    assert_words(&read, "Mon Feb 13, 2012 13:06:45.0 PST", "Willow Creek", "360 Deg", Some(360.0));
}

#[test]
fn esm_ascii() {
    let samples = motion(1003);
    let read = one(&esm(&samples));
    assert_is(&read, &samples, 0.5e-8);
    assert_peak(&read);
    assert_words(&read, "NORTHERN_ITALY 20120529 070002", "IT MRN MIRANDOLA", "HNE", Some(90.0));
    assert_eq!(one(&esm(&samples).replace("HNE", "HN2")).azimuth_deg, None);
}

#[test]
fn knet_ascii() {
    let samples = motion(1000);
    let mean = samples.iter().sum::<f64>() / samples.len() as f64;
    let about_mean: Vec<f64> = samples.iter().map(|a| a - mean).collect();
    let read = one(&knet(&about_mean));
    assert_is(&read, &about_mean, 2e-6);
    assert_peak(&read);
    assert_words(&read, "2011/03/11 14:46:00", "MYG004 surface", "E-W", Some(90.0));
}

#[test]
fn smc_ascii() {
    let samples = motion(1003);
    let read = one(&smc(&samples));
    assert_is(&read, &samples, 0.5e-6);
    assert_peak(&read);
    assert_words(&read, "Loma Prieta, CA", "Del Valle Dam, crest", "65", Some(65.0));
}

#[test]
fn plain_numbers() {
    let samples = motion(300);
    let in_g = |k: usize| samples[k] / G;
    let given = |dt: Option<f64>, column: Option<&str>| Given {
        dt_s: dt,
        unit: Some("g".parse().unwrap()),
        column: column.map(|column| column.parse().unwrap()),
    };
    let check = |text: String, given: Given| {
        let motions = read(text.as_bytes(), None, &given).unwrap();
        assert_is(&motions[0], &samples, 1e-8);
    };
    let table = |row: &dyn Fn(usize) -> String| (0..samples.len()).map(row).collect::<String>();
    check(table(&|k| format!("{:.9}\n", in_g(k))), given(Some(DT), None));
    check(table(&|k| format!("{:.3}\t{:.9}\r\n", k as f64 * DT, in_g(k))), given(None, None));
    let csv = "time;h1;h2\n".to_string() + &table(&|k| format!("{:.2};0.5;{:.9}\n", k as f64 * DT, in_g(k)));
    check(csv.clone(), given(None, Some("h2")));
    check(csv, given(None, Some("3")));
    let wrapped = rows(&samples, 7, |a| format!("{:13.9}", a / G));
    check("# a comment\n\n".to_string() + &wrapped, given(Some(DT), Some("all")));
    let forced = read(wrapped.as_bytes(), Some(Format::Columns), &given(Some(DT), Some("2"))).unwrap_err();
    assert!(forced.to_string().contains("line 43: 6 columns after lines of 7"), "{forced}");
}
