//! Files of a hazard as agencies and OpenQuake give them, and those that cannot be right.

use serde_json::Value;

use super::packed::{exported, rate, table};
use crate::common::{BLOCK, evaluated, fail, folder, near, number};

/// A curve as OpenQuake exports it, times a factor, for intensities of the same rates.
fn openquake(imt: &str, kind: &str, scale: f64, factor: f64) -> String {
    let engine = "generated_by='OpenQuake engine 3.26'";
    let header = format!("#,,,\"{engine}, kind='{kind}', investigation_time=50.0, imt='{imt}'\"");
    exported(&header, scale, factor)
}

/// The answer for files that are written into a folder under their names.
#[track_caller]
fn answer(files: &[(&str, &str)], options: &str) -> Value {
    let names: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
    let call = format!("{BLOCK} --hazard {} {options}", names.join(","));
    evaluated(folder(files).path(), &call).remove(0)
}

#[test]
fn fractiles_are_a_part_of_the_error() {
    let [mean, low, high] = [("mean", 1.0), ("quantile-0.16", 0.5), ("quantile-0.84", 2.0)]
        .map(|(kind, factor)| openquake("PGA", kind, 1.0, factor));
    let answer = answer(&[("mean.csv", &mean), ("low.csv", &low), ("high.csv", &high)], "");
    assert!(near(number(&answer, "error_hazard"), 2f64.ln(), 1e-6));
}

#[test]
fn a_second_curve_tells_pgv_and_narrows_the_limits() {
    let pga = openquake("PGA", "mean", 1.0, 1.0);
    // PGV of 0.6 m/s, and an SA(1.0 s) that stands for it at magnitude 6.35, as often as PGA of 1 g.
    let sa_1s = (0.6 / 0.090 / f64::exp(0.13 * 0.05) / 9.81_f64.powf(0.36)).powf(1.0 / 0.64) / 9.81;
    let (pgv, sa) = (openquake("PGV", "mean", 60.0, 1.0), openquake("SA(1.0)", "mean", sa_1s, 1.0));
    let table = table("TR,PGA (g),SA(0.2) (g),SA(1.0) (g)", |a| {
        format!("{},{a},{},{}", 1.0 / rate(a), 2.0 * a, sa_1s * a)
    });
    let one = answer(&[("pga.csv", &pga)], "");
    let velocity = answer(&[("pga.csv", &pga), ("pgv.csv", &pgv)], "");
    let spectrum = answer(&[("pga.csv", &pga), ("sa.csv", &sa)], "");
    let in_one = answer(&[("table.csv", &table)], "");
    let rate = |row: &Value| number(row, "overturning_per_year");
    let error = |row: &Value| number(row, "error_velocity");
    assert!(near(rate(&spectrum), rate(&velocity), 1e-3) && near(rate(&in_one), rate(&spectrum), 1e-6));
    assert!(error(&velocity) < error(&spectrum) && error(&spectrum) < error(&one));
    let sources = [&one, &velocity, &spectrum].map(|row| row["velocity_by"].as_str().unwrap());
    assert_eq!(sources, ["sites", "pgv", "sa"]);
}

#[test]
fn vs30_narrows_pgv_of_a_site() {
    let pga = openquake("PGA", "mean", 1.0, 1.0);
    let [usual, soft, both] =
        ["", "--vs30 250", "--vs30 250 --magnitude 7"].map(|options| answer(&[("pga.csv", &pga)], options));
    for (wider, narrower) in [(&usual, &soft), (&soft, &both)] {
        let higher = number(narrower, "overturning_per_year") > number(wider, "overturning_per_year");
        let width = |row| number(row, "overturning_per_year_high") / number(row, "overturning_per_year_low");
        assert!(higher && width(narrower) < width(wider), "{wider} {narrower}");
    }
}

#[test]
fn ground_motion_fields_are_motions_with_a_rate() {
    let fields = "#,,\"generated_by='OpenQuake engine 3.26'\"\nevent_id,gmv_PGA,gmv_PGV,site_id\n1,0.5,60,0\n2,0.1,5,0\n3,0.5,60,0\n";
    let row = answer(&[("gmf.csv", fields)], "--effective-years 1000");
    let joint = "pga_g,pgv_m_s,annual_rate_of_occurrence\n0.5,0.6,0.002\n0.1,0.05,0.001\n";
    let same = answer(&[("joint.csv", joint)], "");
    let point = &evaluated(folder(&[]).path(), &format!("{BLOCK} --pga 0.5 --pgv 0.6"))[0];
    assert_eq!(number(&row, "rocking_per_year"), 0.002);
    for (rate, p) in [("overturning_per_year", "p_overturning"), ("failure_per_year", "p_failure")] {
        assert!(near(number(&same, rate), 0.002 * number(point, p), 1e-9), "{rate}");
    }
    assert!(near(number(&row, "overturning_per_year"), number(&same, "overturning_per_year"), 1e-12));
    let two_sites = fields.replace("3,0.5,60,0", "3,0.5,60,1");
    let folder = folder(&[("gmf.csv", fields), ("two.csv", &two_sites), ("joint.csv", joint)]);
    for (options, code, named) in [
        ("gmf.csv", 1, ["gmf.csv", "--effective-years"]),
        ("two.csv --effective-years 9", 1, ["two.csv", "one site"]),
        ("joint.csv --ratio 0.1", 2, ["ratio", "hazard"]),
    ] {
        fail(folder.path(), &format!("evaluate {BLOCK} --hazard {options}"), code, &named);
    }
}
