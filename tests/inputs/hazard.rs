//! Hazard as agencies and people give it, and what is not a hazard.

use std::path::PathBuf;

use rockfrag::inputs::{InputError, Reader, Rename, hazard};
use rockfrag_core::hazard::{Hazard, PeakHazard};
use rockfrag_core::units::G_M_S2;
use rockfrag_core::warning::{Warning, Warnings};

use super::packed::{PGA_G, exported, rate, table, xlsx};

/// A curve as OpenQuake exports it, under a header.
fn openquake(header: &str) -> String {
    exported(header, 1.0, 1.0)
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
    let mut renames = Reader::new(&renames, &[]);
    let hazard = hazard::read(&paths, &mut renames, None)?;
    renames.expect_used()?;
    Ok((hazard, renames.warnings))
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
    let comma = |value: f64| value.to_string().replace('.', ",");
    let poe = |years: f64, a: f64| -(-years * rate(a)).exp_m1();
    let percent = |a: f64| format!("{a},{}%", 100.0 * poe(50.0, a));
    let engine = "#,,,\"generated_by='OpenQuake engine 3.18.0', kind='mean', investigation_time=50.0";
    for text in [
        table("pga_g,AFE", |a| format!("{a},{}", rate(a))),
        table("PGA;PoE in 50 years\n[g];[%]", |a| format!("{};{}", comma(a), comma(100.0 * poe(50.0, a)))),
        table("TR;PGA\n[a];[m/s2]", |a| format!("{};{}", 1.0 / rate(a), a * G_M_S2)),
        table("Ground Motion (g),Annual Frequency of Exceedance", |a| format!("{a},{}", rate(a))),
        table("PGA [m/s^2],AFE", |a| format!("{},{}", a * G_M_S2, rate(a))),
        table("PGA (%g),mafe", |a| format!("{},{}", a * 100.0, rate(a))),
        table("# Site 1\nReturn period (years),PGA (g)", |a| format!("{},{a}", 1.0 / rate(a))),
        table("IML (g),lambda (1/a)", |a| format!("{a},{}", rate(a))),
        table("pga_g,PE50", |a| format!("{a},{}", poe(50.0, a))),
        table("pga_g,PoE 50y (%)", |a| format!("{a},{}", 100.0 * poe(50.0, a))),
        table("pga_g,PoE in 50 years", percent),
        table("pga_g,PoE in 50 years (%)", percent),
        table("pga_g,PoE in 50 years (%)", |a| percent(a).replace('%', "")),
        table("PGA (g),probability_of_exceedance_in_1_year", |a| format!("{a},{}", poe(1.0, a))),
        table("pga_g,probability_of_exceedance_in_16_years", |a| format!("{a},{}", poe(16.0, a))),
        table("periodo de retorno (años);PGA (g)", |a| format!("{};{a}", 1.0 / rate(a))),
        table("return_period,a_g [g]", |a| format!("{},{a}", 1.0 / rate(a))),
        table("TR (years);PGA (cm/s2)", |a| format!("{};{}", comma(1.0 / rate(a)), comma(a * 981.0))),
        table("# imt: PGA [g]; investigation time: 50 years\niml;poe", |a| format!("{a};{}", poe(50.0, a))),
        table("# Peak ground acceleration [m/s2]\nPGA,AFE", |a| format!("{},{}", a * G_M_S2, rate(a))),
        table("imt,level (g),AFE", |a| format!("PGA,{a},{}", rate(a))),
        table("component,kind,PGA (g),AFE,remark", |a| format!("horizontal,mean,{a},{},{a} g", rate(a))),
        table("period (s),Ground Motion (g),AFE", |a| format!("0,{a},{}", rate(a))),
        table("PGA (g),AFE,SA(0.2) (g),AFE", |a| format!("{a},{},{},{}", rate(a), 2.0 * a, 3.0 * rate(a))),
        openquake("# kind=\"mean\", investigation_time=50.0, imt=\"PGA\""),
        openquake(&format!("{engine}, imt='PGA'\"")),
    ] {
        expect_curve(text.as_bytes(), "", "");
    }
    for (heading, size) in [("T_R [anni];ag [g];F0 [-];TC* [s]", 1.0), ("TR (anni);ag (g/10);F0;TC*", 10.0)] {
        let text = table(heading, |a| format!("{};{};2,4;0,3", comma(1.0 / rate(a)), comma(size * a)));
        expect_curve(text.as_bytes(), "", "");
    }
    let named = table("Spitze (g),wie oft", |a| format!("{a},{}", rate(a)));
    expect_curve(named.as_bytes(), "pga=Spitze (g),AFE=wie oft", "");
    let peak = table("Peak (m/s2),AFE", |a| format!("{},{}", a * G_M_S2, rate(a)));
    expect_curve(peak.as_bytes(), "pga_m_s2=Peak (m/s2)", "");
    let chance = table("pga_g,Chance[%]", |a| percent(a).replace('%', ""));
    expect_curve(chance.as_bytes(), "probability_of_exceedance_in_50_years=Chance[%]", "");
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
        ("# smlt_path=b1, gsimlt_path=b11, investigation_time=50.0, imt=PGA".to_string(), "kind"),
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
        assert!(curves(&[text.as_bytes()], "", "median").warnings.contains(&Warning::MedianHazard));
    }
    let statistic = |a: f64| if a < 1.0 { "mean" } else { "p84" };
    let mixed = table("pga_g,AFE,statistic", |a| format!("{a},{},{}", rate(a), statistic(a)));
    for text in [plain("# 84th percentile\n"), mixed] {
        assert!(read(&[text.as_bytes()], "").is_err(), "{text}");
    }
    expect_curve(plain("# mean, not the median; 16 sites, Vs30 = 760\n").as_bytes(), "", "");
}

#[test]
fn what_is_no_hazard_is_refused_for_its_reason() {
    let sized = |heading: &str, size: f64| table(heading, |a| format!("{},{}", size * a, rate(a)));
    let curve = |heading: &str| sized(heading, 1.0);
    let said = |heading: &str, cell: &str| {
        table(&format!("{heading},level (g),AFE"), |a| format!("{cell},{a},{}", rate(a)))
    };
    let exported = |rest: &str| openquake(&format!("#,,,\"kind='mean', investigation_time=50.0{rest}\""));
    let cells = [vec!["Ground motion (g)", "AFE"], vec!["0.1", "0.01"], vec!["0.4", "0.001"]];
    for (sheet, named) in [("SA(0.2)", "SA(0.2 s)"), ("vertical", "horizontal")] {
        let refusal = read(&[&xlsx(&[(sheet, &cells)])], "").unwrap_err().to_string();
        assert!(refusal.contains(named), "{sheet}: {refusal}");
    }
    let twice = "pga_g,pgv_m_s,annual_rate_of_occurrence\n0.5,0.6,0.002\n0.5,0.6,0.002\n";
    for (text, columns, named) in [
        ("pga_g,note\n", "", "found: \"pga_g\""),
        ("pga_g,AFE\n", "", "TooFewPoints(0)"),
        ("PGA (g),AFE\n0.1,0.01\n#0.3,0.001\n1,1e-4\n", "", "Cell { line: 3"),
        ("pga_g,AFE\n0.001,NA\n0.01,0.1\n0.1,0.01\n", "", "Cell { line: 2"),
        ("pga_g,AFE\n-0.1,1e-2\n0.2,2e-3\n0.4,1e-3\n", "", "Cell { line: 2"),
        ("name,lon,lat,0.01,0.02,0.05\nTown,-122,37,0.1,0.05,0.01\n", "", "heading '0.01,"),
        ("Period (s),Sa (g)\n0,0.4\n0.1,0.4\n0.5,0.4\n1,0.4\n", "", "heading 'Period (s)'"),
        ("lon,lat,0.1~PGA,0.1~SA(0.1)\n13,42,0.3,0.5\n", "", "0.1~PGA"),
        (&curve("PGA (g),AFE").replace("PGA", "# PGA in m/s2\nPGA"), "", "against a comment"),
        (&exported(""), "", "imt"),
        (&exported(", imt='SA(0.3)'"), "", "SA(0.3 s)"),
        (&curve("intensity,AFE"), "", "heading 'intensity'"),
        (&curve("SA(0.2) (g),AFE"), "", "a curve of SA(0.2 s)"),
        (&curve("SA(1.0) (g),AFE"), "", "SA(1.0 s)"),
        (&curve("vertical PGA (g),AFE"), "", "vertical"),
        (&curve("PGA rock (g),AFE"), "", "PGA rock (g)"),
        (&curve("PGA (x10 m/s2),AFE"), "", "heading 'PGA (x10 m/s2)'"),
        (&curve("pga_g,AFE (1/475 yr)"), "", "heading 'AFE (1/475 yr)'"),
        (&curve("pga_g,rate per 10 years"), "", "per 10 years"),
        (&curve("PGA (cm/s2),AFE"), "", "wrong unit"),
        (&sized("PGV (cm/s),AFE", 0.2), "", "wrong unit"),
        (&sized("pga_g,AFE", 9.81), "", "m/s2"),
        (&sized("pgv_m_s,AFE", 60.0), "", "cm/s"),
        (&table("pga_g,AFE", |a| format!("{a},{}", -(-50.0 * rate(a)).exp_m1())), "", "50 years"),
        (&curve("pga_g,AFE"), "pgv_m_s=Speed", "Renamed"),
        (&curve("Spitze (g),AFE"), "pgv_m_s=Spitze (g)", "Units"),
        // A unit that the user names does not replace that of the file.
        (&curve("Peak (m/s2),AFE"), "pga_g=Peak (m/s2)", "Units"),
        (&curve("PoE in 30 years,AFE"), "probability_of_exceedance_in_50_years=PoE in 30 years", "Units"),
        (&curve("SA(0.2) (g),AFE"), "pga_g=SA(0.2) (g)", "Units"),
        (&curve("pga_g,AFE 84th"), "AFE=AFE 84th", "Units"),
        (&curve("1.00 Second Spectral Acceleration\nGround Motion (g),AFE"), "", "SA(1.0 s) without PGA"),
        (&curve("1.00 Second Spectral Acceleration\nPGA (g),AFE"), "", "SA(1.0 s) in a comment"),
        (&curve("1.00 Second Spectral Acceleration\nIML (g),AFE"), "pga_g=IML (g)", "SA(1.0 s) in a comment"),
        (&curve("# Vertical motion\nPGA (g),AFE"), "", "horizontal"),
        (&curve("# 95th percentile\nPGA (g),AFE"), "", "median"),
        (&curve("# Vertikalbeschleunigung\nPGA (g),AFE"), "", "horizontal"),
        (&curve("# accélération spectrale à 0.2 s\nPGA (g),AFE"), "", "SA(0.2 s) in a comment"),
        (&curve("All accelerations in m/s2\nPGA (g),AFE"), "", "against a comment"),
        (&said("imt", "SA(0.5)"), "", "a curve of SA(0.5 s)"),
        (&said("component", "vertical"), "", "--ignore"),
        (&said("agg", "p95"), "", "heading 'agg'"),
        (&said("rlz", "3"), "", "heading 'rlz'"),
        ("{\"imt\": \"PGA\"}", "", "JSON"),
        ("<?xml version='1.0'?><nrml/>", "", "XML"),
        ("PGA (g),AFE\n(m/s2),\n0.1,0.01\n0.2,0.001\n", "", "Units"),
        ("pga_g,AFE\n0.4,0.01\n0.1,0.02\n0.2,0.03\n", "", "Cell { line: 4, heading: \"AFE\""),
        ("pga_g,PoE in 50 years\n0.1,60%\n0.2,0.3\n0.4,1\n", "", "Cell { line: 4"),
        ("TR,pga_g\n50,0.1\n475,0.4\n475,0.4\n", "", "Cell { line: 4, heading: \"TR\""),
        ("pga_g,AFE,TR\n0.1,1e-2,100\n0.2,2e-3,475\n0.4,1e-3,475\n", "", "contradict"),
        ("site,pga_g,AFE\na,0.1,1e-3\nb,0.2,1e-4\n", "", "one site"),
        (twice, "", "lines 2 and 3"),
    ] {
        let refusal = read(&[text.as_bytes()], columns).unwrap_err();
        let found = format!("{refusal}, {refusal:?}");
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
    let [west, south, london, zero] =
        ["139.70, lat=35.6", "10, lat=45.00", "-0.1276, lat=51.5", "0.0, lat=0.0"]
            .map(|place| with(&format!("# lon={place}\n"), "pga_g,AFE", 1.0));
    let in_rows = table("lon,lat,pga_g,AFE", |a| format!("13.4,42.3,{a},{}", 0.02 * rate(a)));
    for (first, second, named) in [
        (&pga, with("# Vs30: 360 m/s\n", "SA(1.0) (g),AFE", 0.5), "vs30 760 and 360"),
        (&pga, at("Vs30 (m/s)", "SA(1.0) (g)", "400"), "vs30 760 and 400"),
        (&in_rows, at("lon,lat", "PGV (m/s)", "13.4,42.9"), "lat 42.3 and 42.9"),
        (&pga, with("", "SA(1.0) (g),AFE", 9.81), "0.1 to 3"),
        (&pga, with("", "SA(1.0) (m/s2),AFE", 0.5), "m/s2"),
        (&pga, with("", "SA(1.0) (g),AFE", 50.0), "SA(1.0 s) of"),
        (&pga, with("", "SA(1.0) (g),AFE", 1.0), "SA(1.0 s) as PGA"),
        (&pga, with("", "PGV (cm/s),AFE", 1.0), "PGV/PGA"),
        (&pga, pga.clone(), "curves of PGA"),
        (&pga, "pga_g,pgv_m_s,annual_rate_of_occurrence\n0.5,0.6,0.002\n".to_string(), "PGA and PGV"),
        (&west, with("# lon=139.72, lat=35.6\n", "SA(1.0) (g),AFE", 0.5), "lon 139.70 and 139.72"),
        (&south, with("# lon=10, lat=45.02\n", "SA(1.0) (g),AFE", 0.5), "lat 45.00 and 45.02"),
        (&pga, with("# vs30=765\n", "SA(1.0) (g),AFE", 0.5), "vs30 760 and 765"),
    ] {
        let refusal = read(&[first.as_bytes(), second.as_bytes()], "").unwrap_err().to_string();
        assert!(refusal.contains(named), "{named}: {refusal}");
    }
    for (first, place) in
        [(&pga, "vs30=760.0"), (&london, "lon=-0.128, lat=51.5"), (&zero, "lon=0.0001, lat=0.0")]
    {
        let second = with(&format!("# {place}\n"), "SA(1.0) (g),AFE", 0.5);
        assert!(curves(&[first.as_bytes(), second.as_bytes()], "", "").pgv_pga.is_some());
    }
}

#[test]
fn fractiles_are_read_in_pairs() {
    let text = table("pga_g,AFE,AFE 84th", |a| format!("{a},{},{}", rate(a), 2.0 * rate(a)));
    assert!(read(&[text.as_bytes()], "").is_err());
    let row = |a: f64, b: f64, low: f64, high: f64| format!("{a},{b},{low},{high}");
    for text in [
        table("pga_g,AFE,AFE 16%,AFE (84 %)", |a| row(a, rate(a), 0.5 * rate(a), 2.0 * rate(a))),
        table("pga_g,AFE,AFE p16,AFE p84", |a| row(a, rate(a), 0.5 * rate(a), 2.0 * rate(a))),
        table("AFE,pga_g,pga_m_s2_16,PGA 84th (g)", |a| row(rate(a), a, 5.0 * a, 1.2 * a)),
    ] {
        assert!(curves(&[text.as_bytes()], "", "").fractiles.is_some(), "{text}");
    }
}
