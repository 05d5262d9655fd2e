//! Hazard as agencies and people give it, and what is not a hazard.

use std::path::PathBuf;

use rockfrag::inputs::{InputError, Rename, Renames, hazard};
use rockfrag_core::hazard::{Hazard, PeakHazard};
use rockfrag_core::units::G_M_S2;
use rockfrag_core::warning::Warnings;

use super::packed::utf_16;

const PGA_G: [f64; 7] = [0.1, 0.2, 0.4, 0.8, 1.6, 3.2, 4.5];

/// 1e-3 (PGA / 1 g)^-2 a year.
fn rate(pga_g: f64) -> f64 {
    1e-3 / (pga_g * pga_g)
}

/// A table under a heading, with a line for each PGA.
fn table(heading: &str, line: impl Fn(f64) -> String) -> String {
    let lines: String = PGA_G.iter().map(|&pga_g| line(pga_g) + "\n").collect();
    format!("{heading}\n{lines}")
}

/// A curve as OpenQuake exports it, under a header.
fn openquake(header: &str) -> String {
    let join = |cell: fn(f64) -> String| PGA_G.map(cell).join(",");
    let levels = join(|pga_g| format!("poe-{pga_g}"));
    let poes = join(|pga_g| (-(-50.0 * rate(pga_g)).exp_m1()).to_string());
    format!("{header}\nlon,lat,depth,{levels}\n13.4,42.3,0.0,{poes}\n")
}

fn read(files: &[&[u8]], columns: &str) -> Result<(Hazard, Warnings), InputError> {
    let folder = tempfile::tempdir().unwrap();
    let write = |(at, bytes): (usize, &&[u8])| {
        let path = folder.path().join(format!("{at}.csv"));
        std::fs::write(&path, bytes).unwrap();
        path
    };
    let paths: Vec<PathBuf> = files.iter().enumerate().map(write).collect();
    let renames: Vec<Rename> = columns.split_terminator(',').map(|text| text.parse().unwrap()).collect();
    let mut renames = Renames::new(&renames);
    let read = hazard::read(&paths, &mut renames, None)?;
    renames.expect_used()?;
    Ok(read)
}

/// The hazard of one peak in files that are read without a warning, or with this part of one.
#[track_caller]
fn curves(files: &[&[u8]], columns: &str, warning: &str) -> PeakHazard {
    let (hazard, warnings) = read(files, columns).unwrap_or_else(|why| panic!("{why}"));
    let lines = warnings.lines().join("\n");
    assert!(lines.contains(warning) && lines.is_empty() == warning.is_empty(), "{lines}");
    let Hazard::Curve(hazard) = hazard else { panic!("a joint hazard") };
    hazard
}

#[track_caller]
fn expect_curve(bytes: &[u8], columns: &str, warning: &str) {
    let found = curves(&[bytes], columns, warning).curve;
    assert_eq!(found.points().len(), PGA_G.len(), "{}", String::from_utf8_lossy(bytes));
    for (&(pga_m_s2, found), pga_g) in found.points().iter().zip(PGA_G) {
        assert!((pga_m_s2 / (pga_g * G_M_S2) - 1.0).abs() < 1e-9, "{pga_m_s2}");
        assert!((found / rate(pga_g) - 1.0).abs() < 1e-9, "{found} at {pga_g}");
    }
}

#[test]
fn one_curve_is_one_curve_however_it_is_written() {
    let plain = table("pga_g,AFE", |a| format!("{a},{}", rate(a)));
    let comma = |value: f64| value.to_string().replace('.', ",");
    let poe = |years: f64, a: f64| -(-years * rate(a)).exp_m1();
    for bytes in [
        plain.clone().into_bytes(),
        utf_16(&plain.replace(',', "\t"), true, false),
        table("\"pga_g\",\"AFE\"", |a| format!("\"{}\",\"{}\"", comma(a), comma(rate(a)))).into_bytes(),
        table("PGA,AFE\n(g),(1/yr)", |a| format!("{a},{}", rate(a))).into_bytes(),
        table("PGA;PoE in 50 years\n[g];[%]", |a| format!("{};{}", comma(a), comma(100.0 * poe(50.0, a))))
            .into_bytes(),
        table("TR;PGA\n[a];[m/s2]", |a| format!("{};{}", 1.0 / rate(a), a * G_M_S2)).into_bytes(),
        table("Ground Motion (g),AFE PGA", |a| format!("{a},{}", rate(a))).into_bytes(),
        table("IML (g),lambda (1/a)", |a| format!("{a},{}", rate(a))).into_bytes(),
        table("pga_g,PE50", |a| format!("{a},{}", poe(50.0, a))).into_bytes(),
        table("pga_g,PoE 50y (%)", |a| format!("{a},{}", 100.0 * poe(50.0, a))).into_bytes(),
        table("pga_g,probability_of_exceedance_in_16_years", |a| format!("{a},{}", poe(16.0, a)))
            .into_bytes(),
        table("pga_g,PoE in 84 years", |a| format!("{a},{}", poe(84.0, a))).into_bytes(),
        table("periodo de retorno (años);PGA (g)", |a| format!("{};{a}", 1.0 / rate(a))).into_bytes(),
        table("TR (years);PGA (cm/s2)", |a| {
            let years = format!("{:.3}", 1.0 / rate(a));
            let (whole, rest) = years.split_once('.').unwrap();
            let (start, end) = whole.split_at(whole.len().saturating_sub(3));
            let point = if start.is_empty() { "" } else { "." };
            format!("{start}{point}{end},{rest};{}", comma(a * 981.0))
        })
        .into_bytes(),
        openquake("# mean, investigation_time=50.0, imt=PGA").into_bytes(),
        openquake("# kind=\"mean\", investigation_time=50.0, imt=\"PGA\"").into_bytes(),
        openquake(
            "#,,,\"generated_by='OpenQuake engine 3.18.0', kind='mean', investigation_time=50.0, imt='PGA'\"",
        )
        .into_bytes(),
    ] {
        expect_curve(&bytes, "", "");
    }
    let named = table("Spitze (g),wie oft", |a| format!("{a},{}", rate(a)));
    expect_curve(named.as_bytes(), "pga=Spitze (g),AFE=wie oft", "");
}

#[test]
fn a_table_of_one_motion_and_several_measures_has_their_curves() {
    let text = table("Ground Motion (g),AFE PGA,AFE SA(0.2),AFE SA1.0", |a| {
        format!("{a},{},{},{}", rate(a), 4.0 * rate(a), 0.8 * rate(a))
    });
    let hazard = curves(&[text.as_bytes()], "", "");
    assert!(hazard.pgv_pga.is_some());
    assert!((hazard.curve.points()[0].1 / rate(0.1) - 1.0).abs() < 1e-9);
}

#[test]
fn what_is_not_known_to_be_a_mean_is_not_taken_for_it() {
    let header = |kind: &str| format!("#,,,\"kind='{kind}', investigation_time=50.0, imt='PGA'\"");
    for (header, named) in [
        (header("std"), "std"),
        (header("rlz-003"), "rlz-003"),
        (header("max"), "max"),
        (header("quantile-0.85"), "quantile-0.85"),
        ("# quantile-0.85, investigation_time=50.0, imt=PGA".to_string(), "quantile-0.85"),
        ("# max, investigation_time=50.0, imt=PGA".to_string(), "max"),
        ("# smlt_path=b1, gsimlt_path=b11, investigation_time=50.0, imt=PGA".to_string(), "smlt_path"),
        ("# investigation_time=50.0, imt=PGA".to_string(), "kind"),
    ] {
        let refusal = read(&[openquake(&header).as_bytes()], "").unwrap_err().to_string();
        assert!(refusal.contains(named) && refusal.contains("mean"), "{refusal}");
    }
    expect_curve(openquake(&header("quantile-0.5")).as_bytes(), "", "median");
    let median = table("pga_g,AFE median", |a| format!("{a},{}", rate(a)));
    expect_curve(median.as_bytes(), "", "median");
    let plain = |notes: &str| notes.to_string() + &table("pga_g,AFE", |a| format!("{a},{}", rate(a)));
    for text in [
        plain("# median hazard curve\n"),
        plain("statistic,median\n"),
        plain("# 50th percentile\n"),
        table("pga_g,AFE,statistic", |a| format!("{a},{},median", rate(a))),
    ] {
        expect_curve(text.as_bytes(), "", "median");
        assert!(curves(&[text.as_bytes()], "", "median").is_median);
    }
    assert!(read(&[plain("# 84th percentile\n").as_bytes()], "").is_err());
    let mixed =
        table("pga_g,AFE,statistic", |a| format!("{a},{},{}", rate(a), if a < 1.0 { "mean" } else { "p84" }));
    assert!(read(&[mixed.as_bytes()], "").is_err());
    expect_curve(plain("# mean, not the median; 16 sites, Vs30 = 760\n").as_bytes(), "", "");
}

#[test]
fn what_is_no_hazard_is_refused_for_its_reason() {
    let kind = |text: &str, columns: &str| match read(&[text.as_bytes()], columns).unwrap_err() {
        InputError::File { error, .. } => format!("{error:?}"),
        error => format!("{error:?}"),
    };
    let curve = |heading: &str| table(heading, |a| format!("{a},{}", rate(a)));
    for (text, columns, named) in [
        ("hello\n".to_string(), "", "Heading { heading: \"hello\""),
        ("pga_g,note\n".to_string(), "", "Heading { heading: \"note\""),
        ("pga_g,AFE\n".to_string(), "", "TooFewPoints(0)"),
        ("pga_g,AFE\nNA,NA\nNaN,null\n".to_string(), "", "Cell { line: 2"),
        ("pga_g,AFE\n0.001,NA\n0.01,0.1\n0.1,0.01\n".to_string(), "", "Cell { line: 2"),
        ("<!DOCTYPE html>\n<html><body>504</body></html>\n".to_string(), "", "a web page"),
        ("pga_g,AFE\n\"0.1,0.01\n0.2,0.001\n".to_string(), "", "Quote { line: 2"),
        (
            "name,lon,lat,0.01,0.02,0.05\nTown,-122,37,0.1,0.05,0.01\n".to_string(),
            "",
            "each level from 0.01 to 0.05",
        ),
        (curve("PGA (x10 m/s2),AFE"), "", "Heading { heading: \"PGA (x10 m/s2)\""),
        (curve("pga_g,AFE (1/475 yr)"), "", "Heading { heading: \"AFE (1/475 yr)\""),
        (table("PGA (cm/s2),AFE", |a| format!("{a},{}", rate(a))), "", "wrong unit"),
        (curve("pga_g,monthly rate"), "", "Heading { heading: \"monthly rate\""),
        (curve("pga_g,AFE"), "pgv_m_s=Speed", "Renamed"),
        (curve("Spitze (g),AFE"), "pgv_m_s=Spitze (g)", "Units"),
        ("PGA (g),AFE\n(m/s2),\n0.1,0.01\n0.2,0.001\n".to_string(), "", "Units"),
        ("pga_g,AFE\n0.4,0.01\n0.1,0.02\n0.2,0.03\n".to_string(), "", "Cell { line: 4, heading: \"AFE\""),
        ("pga_g,PoE in 50 years\n0.1,60%\n0.2,0.3\n0.4,1\n".to_string(), "", "Cell { line: 4"),
        (table("PGV (cm/s),AFE", |a| format!("{},{}", 0.2 * a, rate(a))), "", "wrong unit"),
        ("TR,pga_g\n50,0.1\n475,0.4\n475,0.4\n".to_string(), "", "Cell { line: 4, heading: \"TR\""),
    ] {
        let found = kind(&text, columns);
        assert!(found.contains(named), "{named}: {found}");
    }
}

#[test]
fn curves_given_together_are_of_one_site_and_in_their_units() {
    let with = |notes: &str, heading: &str, factor: f64| {
        notes.to_string() + &table(heading, |a| format!("{},{}", factor * a, 0.02 * rate(a)))
    };
    let at = |place: &str, heading: &str, values: &str| {
        table(&format!("{place},{heading},AFE"), |a| format!("{values},{},{}", 0.5 * a, 0.02 * rate(a)))
    };
    let pga = with("# vs30 = 760, lon=13.4\n", "pga_g,AFE", 1.0);
    let in_rows = table("lon,lat,pga_g,AFE", |a| format!("13.4,42.3,{a},{}", 0.02 * rate(a)));
    for (first, second, named) in [
        (&pga, with("# Vs30: 360 m/s\n", "SA(1.0) (g),AFE", 0.5), "vs30 760 and 360"),
        (&pga, with("# lon=13.9\n", "SA(1.0) (g),AFE", 0.5), "lon 13.4 and 13.9"),
        (&pga, at("Vs30 (m/s)", "SA(1.0) (g)", "400"), "vs30 760 and 400"),
        (&in_rows, at("lon,lat", "PGV (m/s)", "13.4,42.9"), "lat 42.3 and 42.9"),
        (&pga, with("", "SA(1.0) (g),AFE", 9.81), "1.csv: SA(1.0 s) is not 0.1 to 3 times PGA"),
        (&pga, with("", "SA(1.0) (m/s2),AFE", 0.5), "in g, beside PGA in m/s2"),
        (&pga, with("", "SA(1.0) (g),AFE", 50.0), "SA(1.0 s) of"),
        (&pga, with("", "SA(1.0) (g),AFE", 1.0), "SA(1.0 s) as PGA"),
    ] {
        let refusal = read(&[first.as_bytes(), second.as_bytes()], "").unwrap_err().to_string();
        assert!(refusal.contains(named), "{named}: {refusal}");
    }
    let same = with("# vs30=760.0\n", "SA(1.0) (g),AFE", 0.5);
    assert!(curves(&[pga.as_bytes(), same.as_bytes()], "", "").pgv_pga.is_some());
}

#[test]
fn a_curve_that_is_not_used_is_named() {
    let text = table("pga_g,AFE,AFE 84th", |a| format!("{a},{},{}", rate(a), 2.0 * rate(a)));
    assert!(curves(&[text.as_bytes()], "", "PGA (84 %)").fractiles.is_none());
    let both = table("pga_g,AFE,AFE p16,AFE p84", |a| {
        format!("{a},{},{},{}", rate(a), 0.5 * rate(a), 2.0 * rate(a))
    });
    assert!(curves(&[both.as_bytes()], "", "").fractiles.is_some());
    let values =
        table("AFE,pga_g,pga_m_s2_16,PGA 84th (g)", |a| format!("{},{a},{},{}", rate(a), 5.0 * a, 1.2 * a));
    assert!(curves(&[values.as_bytes()], "", "").fractiles.is_some());
}
