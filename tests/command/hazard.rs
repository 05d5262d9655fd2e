//! Files of a hazard as agencies and OpenQuake give them, and those that cannot be right.

use serde_json::Value;

use crate::common::{evaluated, fail, folder, near, number};

const BLOCK: &str = "--width 0.5 --height 2.0";
const PGA_G: [f64; 8] = [0.05, 0.1, 0.2, 0.4, 0.8, 1.6, 3.2, 4.5];

/// 1e-3 (PGA / 1 g)^-2 a year.
fn rate(pga_g: f64) -> f64 {
    1e-3 / (pga_g * pga_g)
}

/// A table under a heading, with a line for each PGA.
fn table(heading: &str, line: impl Fn(f64) -> String) -> String {
    let lines: String = PGA_G.iter().map(|&pga_g| line(pga_g) + "\n").collect();
    format!("{heading}\n{lines}")
}

/// A curve as OpenQuake exports it, times a factor, for intensities of the same rates.
fn openquake(imt: &str, kind: &str, scale: f64, factor: f64) -> String {
    let join = |cell: &dyn Fn(f64) -> f64| PGA_G.map(|pga_g| cell(pga_g).to_string()).join(",");
    let levels = PGA_G.map(|pga_g| format!("poe-{}", pga_g * scale)).join(",");
    let poes = join(&|pga_g| -(-50.0 * factor * rate(pga_g)).exp_m1());
    format!(
        "#,,,\"generated_by='OpenQuake engine 3.26', kind='{kind}', investigation_time=50.0, imt='{imt}'\"\n\
         lon,lat,depth,{levels}\n13.4,42.3,0.0,{poes}\n"
    )
}

/// The answer for files that are written into a folder under their names.
#[track_caller]
fn answer(files: &[(&str, &str)], options: &str) -> Value {
    let names: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
    let call = format!("{BLOCK} --hazard {} {options}", names.join(","));
    evaluated(folder(files).path(), &call).remove(0)
}

#[track_caller]
fn refused(files: &[(&str, &str)], options: &str, named: &[&str]) {
    let names: Vec<&str> = files.iter().map(|(name, _)| *name).collect();
    let call = format!("evaluate {BLOCK} --hazard {} {options}", names.join(","));
    fail(folder(files).path(), &call, 1, named);
}

#[test]
fn a_curve_is_the_same_however_agencies_write_it() {
    let comma = |value: f64| value.to_string().replace('.', ",");
    let percent = |pga_g: f64| format!("{pga_g},{}%", -100.0 * (-50.0 * rate(pga_g)).exp_m1());
    let files = [
        table("pga_g,annual_rate_of_exceedance", |a| format!("{a},{}", rate(a))),
        table("Ground Motion (g);Annual Frequency of Exceedance", |a| {
            format!("{};{}", comma(a), comma(rate(a)))
        }),
        table("PGA [m/s^2],AFE", |a| format!("{},{}", a * 9.81, rate(a))),
        table("PGA (%g),mafe", |a| format!("{},{}", a * 100.0, rate(a))),
        table("# Site 1\nReturn period (years),PGA (g)", |a| format!("{},{a}", 1.0 / rate(a))),
        table("pga_g,PoE in 50 years", percent),
        table("pga_g,PoE in 50 years (%)", percent),
        table("pga_g,PoE in 50 years (%)", |a| percent(a).replace('%', "")),
        table("# 42.35, 13.40\npga_g,AFE", |a| format!("{a},{}", rate(a))),
        table("PGA (g),probability_of_exceedance_in_1_year", |a| format!("{a},{}", -(-rate(a)).exp_m1())),
        table("T_R [anni];ag [g];F0 [-];TC* [s]", |a| {
            format!("{};{};2,4;0,3", comma(1.0 / rate(a)), comma(a))
        }),
        table("TR (anni);ag (g/10);F0;TC*", |a| {
            format!("{};{};2,4;0,3", comma(1.0 / rate(a)), comma(a * 10.0))
        }),
        table("return_period,a_g [g]", |a| format!("{},{a}", 1.0 / rate(a))),
        openquake("PGA", "mean", 1.0, 1.0),
    ];
    let rate_by =
        |text: &str| number(&answer(&[("hazard.csv", text)], "--ratio 0.1"), "overturning_per_year");
    let expected = rate_by(&files[0]);
    for text in &files {
        assert!(near(rate_by(text), expected, 1e-6), "{text}");
    }
    let chance = table("pga_g,Chance[%]", |a| percent(a).replace('%', ""));
    let renamed = "--ratio 0.1 --columns probability_of_exceedance_in_50_years=Chance[%]";
    let by_name = number(&answer(&[("hazard.csv", &chance)], renamed), "overturning_per_year");
    assert!(near(by_name, expected, 1e-6), "{by_name}");
}

#[test]
fn fractiles_are_a_part_of_the_error() {
    let columns = table("pga_g,AFE,AFE_16,AFE_84", |a| {
        format!("{a},{0},{1},{2}", rate(a), rate(a) / 2.0, rate(a) * 2.0)
    });
    let [mean, low, high] = [("mean", 1.0), ("quantile-0.16", 0.5), ("quantile-0.84", 2.0)]
        .map(|(kind, factor)| openquake("PGA", kind, 1.0, factor));
    for files in
        [vec![("all.csv", &*columns)], vec![("mean.csv", &*mean), ("low.csv", &*low), ("high.csv", &*high)]]
    {
        assert!(near(number(&answer(&files, ""), "error_hazard"), 2f64.ln(), 1e-6));
    }
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
    let pgv = openquake("PGV", "mean", 60.0, 1.0);
    let folder = folder(&[("pga.csv", &*pga), ("pgv.csv", &*pgv)]);
    for options in
        ["--hazard pga.csv,pgv.csv --vs30 250", "--hazard pga.csv --vs30 90", "--pga 1 --pgv 1 --vs30 250"]
    {
        fail(folder.path(), &format!("evaluate {BLOCK} {options}"), 2, &["vs30"]);
    }
}

#[test]
fn ground_motion_fields_are_motions_with_a_rate() {
    let fields = "#,,\"generated_by='OpenQuake engine 3.26'\"\nevent_id,gmv_PGA,gmv_PGV,site_id\n1,0.5,60,0\n2,0.1,5,0\n3,0.5,60,0\n";
    let row = answer(&[("gmf.csv", fields)], "--effective-years 1000");
    let joint = "pga_g,pgv_m_s,annual_rate_of_occurrence\n0.5,0.6,0.002\n0.1,0.05,0.001\n";
    let same = answer(&[("joint.csv", joint)], "");
    assert_eq!(number(&row, "rocking_per_year"), 0.002);
    assert!(near(number(&row, "overturning_per_year"), number(&same, "overturning_per_year"), 1e-12));
    let two_sites = fields.replace("3,0.5,60,0", "3,0.5,60,1");
    refused(&[("gmf.csv", fields)], "", &["gmf.csv", "--effective-years"]);
    refused(&[("two.csv", &two_sites)], "--effective-years 9", &["two.csv", "one site"]);
}

#[test]
fn files_that_cannot_be_right_are_refused_by_what_they_are() {
    let uniform: String = [0.0, 0.1, 0.5, 1.0].map(|t| format!("{t},0.4\n")).concat();
    let uniform = format!("Period (s),Sa (g)\n{uniform}");
    let curve = |heading: &str, size: f64| table(heading, |a| format!("{},{}", size * a, rate(a)));
    let in_50_years = table("pga_g,AFE", |a| format!("{a},{}", -(-50.0 * rate(a)).exp_m1()));
    for (text, named) in [
        (&*uniform, ["a.csv", "uniform hazard spectrum"]),
        ("lon,lat,0.1~PGA,0.1~SA(0.1)\n13,42,0.3,0.5\n", ["a.csv", "uniform hazard spectrum"]),
        (&openquake("PGA", "mean", 1.0, 1.0).replace(", imt='PGA'", ""), ["a.csv", "imt"]),
        (&openquake("SA(0.3)", "mean", 1.0, 1.0), ["SA(0.3)", "SA(1.0)"]),
        (&openquake("PGA", "quantile-0.95", 1.0, 1.0), ["quantile-0.95", "mean"]),
        (&curve("intensity,AFE", 1.0), ["intensity", "PGA"]),
        (&curve("SA(0.2) (g),AFE", 1.0), ["SA(0.2)", "1 s"]),
        (&curve("SA(1.0) (g),AFE", 1.0), ["SA(1.0 s)", "PGA"]),
        (&in_50_years, ["a.csv", "probabilities in 50 years"]),
        (&curve("pga_g,AFE", 9.81), ["a.csv", "m/s2"]),
        (&curve("pgv_m_s,AFE", 60.0), ["a.csv", "cm/s"]),
        (&curve("pga_g,monthly_rate", 1.0), ["a.csv", "monthly_rate"]),
        (&curve("pga_g,rate per 10 years", 1.0), ["a.csv", "per 10 years"]),
        (&curve("vertical PGA (g),AFE", 1.0), ["a.csv", "vertical"]),
        ("site,pga_g,AFE\na,0.1,1e-3\nb,0.2,1e-4\n", ["a.csv", "one site"]),
        ("pga_g,AFE,TR\n0.1,1e-2,100\n0.2,2e-3,475\n0.4,1e-3,475\n", ["a.csv", "contradict"]),
        ("pga_g,AFE\n0.1,1e-3\n0.2,2e-3\n", ["a.csv", "line 3"]),
        ("pga_g,AFE\n-0.1,1e-2\n0.2,2e-3\n0.4,1e-3\n", ["a.csv", "intensity of 0 or more"]),
        (&curve("PGA rock (g),AFE", 1.0), ["a.csv", "PGA rock (g)"]),
        (
            "pga_g,pgv_m_s,annual_rate_of_occurrence\n0.5,0.6,0.002\n0.5,0.6,0.002\n",
            ["lines 2 and 3", "same"],
        ),
    ] {
        refused(&[("a.csv", text)], "", &named);
    }
    let pga = curve("pga_g,AFE", 1.0);
    let joint = "pga_g,pgv_m_s,annual_rate_of_occurrence\n0.5,0.6,0.002\n";
    for (other, named) in [
        (&*curve("PGV (cm/s),AFE", 1.0), ["PGV/PGA", "s at"]),
        (&pga, ["two curves of PGA", "b.csv"]),
        (joint, ["PGA and PGV", "alone"]),
    ] {
        refused(&[("a.csv", &pga), ("b.csv", other)], "", &named);
    }
}
