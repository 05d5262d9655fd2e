//! evaluate, export and validate as users run them: numbers against closed forms, slips, fragilities.

use rockfrag_core::units::G_M_S2;
use rockfrag_core::warning::Warning;
use serde_json::Value;

use crate::common::{BLOCK, bytes, evaluated, fail, folder, folder_with, near, number, succeed};

/// 1e-3 (PGA / 1 g)^-2 a year.
const CURVE: &str = "pga_g,annual_rate_of_exceedance\n0.05,0.4\n4.5,4.938271604938e-5\n";

#[test]
fn rates_over_a_power_law_are_those_of_closed_forms() {
    let folder = folder(&[("hazard.csv", CURVE)]);
    let over = "--hazard hazard.csv --ratio 0.1 --years 100 --magnitude 6.5";
    let row = &evaluated(folder.path(), &format!("{BLOCK} {over}"))[0];
    // Rocking: the curve at g tan(alpha) = 0.25 g; what has less friction than tan(alpha) slides.
    assert!(near(number(row, "friction"), 0.25, 1e-12));
    let rocking = 1e-3 / 0.25_f64.powi(2);
    assert!(near(number(row, "rocking_per_year"), rocking, 1e-9));
    assert!(near(number(row, "p_rocking"), -(-rocking * 100.0).exp_m1(), 1e-9));
    // Overturning: the sum of P_ro at the middles of narrow bins times their rates; beyond 4.5 g as at 4.5
    // g. The motions' magnitude is above the mean of the disaggregation.
    let mw = 6.5 + 0.25;
    let edges: Vec<f64> = (0..=400).map(|k| 0.25 * 18_f64.powf(f64::from(k) / 400.0)).collect();
    let middles = edges.windows(2).map(|edge| (edge[0] * edge[1]).sqrt()).chain([4.5]);
    let lines = middles.map(|pga| format!("{pga},{},{mw}\n", 0.1 * pga * G_M_S2));
    let table = format!("pga_g,pgv_m_s,mw\n{}", lines.collect::<String>());
    std::fs::write(folder.path().join("table.csv"), table).unwrap();
    let points = evaluated(folder.path(), &format!("{BLOCK} --in table.csv --out t.csv"));
    let p: Vec<f64> = points.iter().map(|row| number(row, "p_ro")).collect();
    let h = |pga: f64| 1e-3 / (pga * pga);
    let bins = edges.windows(2).zip(&p).map(|(edge, p)| p * (h(edge[0]) - h(edge[1]))).sum::<f64>();
    let expected = bins + p[400] * h(4.5);
    assert!(near(number(row, "overturning_per_year"), expected, 1e-4), "{row}: {expected}");
    assert!(near(number(row, "return_period_years"), 1.0 / expected, 1e-4));
    assert!(near(number(row, "p_overturning"), -(-expected * 100.0).exp_m1(), 1e-4));
}

#[test]
fn slips_are_refused_or_warned() {
    let folder = folder(&[
        ("hazard.csv", CURVE),
        ("short.csv", "pga_g,annual_rate_of_exceedance\n0.05,0.4\n0.5,4e-3\n"),
        ("impossible.csv", "pga_g,annual_rate_of_exceedance\n0.05,1e299\n1,2e296\n"),
        ("both.csv", "pga_g,pgv_m_s,p_rad_s,alpha_rad,eta\n0.5,0.6,2.5,0.2,0.92\n"),
        ("sign.csv", "pga_g,annual rate (%)\n0.1,1.8\n1,0.02\n"),
        ("units.csv", "PGA (g),PGV (m/s)\n4,0.5\n5,0.6\n6,0.7\n"),
        ("mean.csv", "station,PGA (g),PGV (m/s),component\na,0.4,0.5,NS\nmean,0.45,0.55,\n"),
        ("more.csv", "PGA (g),PGV (m/s),PGD (cm)\n0.4,0.5,6\n"),
        ("up.csv", "station,PGA (g),PGV (m/s),component\na,0.4,0.5,NS\nb,0.5,0.6,UD\n"),
    ]);
    for (arguments, code, named) in [
        (&format!("{BLOCK} --pga 4.9 --pgv 0.6") as &str, 2, vec!["--pga", "4.9", "m/s2"]),
        ("--p 0.2 --alpha 2.5 --eta 0.9 --pga 0.5 --pgv 0.6", 2, vec!["alpha", "2.5", "p"]),
        (&format!("{BLOCK} --hazard impossible.csv"), 1, vec!["impossible.csv", "1000"]),
        (&format!("{BLOCK} --hazard sign.csv"), 1, vec!["sign.csv", "1.8"]),
        (&format!("{BLOCK} --pga 0.5 --pgv 0.6 --out answer.txt"), 2, vec!["answer.txt"]),
        (&format!("{BLOCK} --pga 0 --pgv 0.6"), 2, vec!["PGA is 0 g", "0.6 m/s"]),
        // Before anything is read.
        ("--in missing.csv --out page.html", 2, vec!["page.html", ".parquet"]),
        ("--pga 0.5 --pgv 0.6", 2, vec!["--width"]),
        (&format!("{BLOCK} --in both.csv"), 2, vec!["both.csv", "p_rad_s"]),
        (&format!("{BLOCK} --in units.csv"), 1, vec!["units.csv", "m/s2"]),
        (&format!("{BLOCK} --in mean.csv"), 1, vec!["line 3", "mean"]),
        (&format!("{BLOCK} --in more.csv"), 1, vec!["PGD (cm)", "--ignore"]),
        (&format!("{BLOCK} --in up.csv"), 1, vec!["line 3", "UD"]),
        (&format!("{BLOCK} --pga 0.4 --columns pga_g=PGA"), 2, vec!["--columns"]),
        (&format!("{BLOCK} --hazard hazard.csv --over pgv"), 2, vec!["over", "pgv"]),
    ] {
        fail(folder.path(), &format!("evaluate {arguments}"), code, &named);
    }
    let warned = |arguments: &str| succeed(folder.path(), &format!("evaluate {arguments}")).1;
    assert_eq!(warned(&format!("{BLOCK} --hazard hazard.csv")), "");
    let short = &evaluated(folder.path(), &format!("{BLOCK} --hazard short.csv"))[0];
    assert!(number(short, "share_extrapolated") > 0.1 && short["warnings"].is_string());
    let low = "--p 2.5 --alpha 0.2 --eta 0.09 --pga 0.5 --pgv 0.6";
    assert!(warned(low).contains(Warning::LowRestitution.text()));
    assert!(warned(&format!("{low} --quiet")).contains(Warning::LowRestitution.text()));
    let exchanged = "--p 0.25 --alpha 0.3 --eta 0.9 --pga 0.5 --pgv 0.6";
    assert!(warned(exchanged).contains(Warning::ImplausibleSize.text()));
}

#[test]
fn a_run_ends_with_the_rate_and_its_fits_answer_validate_and_export() {
    let folder = folder_with(
        "seed: 3\nsample-scenarios: { mw: \"6.5,7.5\", re: \"5,10\", samples: 15 }\n\
         synthesize-motions: { suite: [csgm], dt: 0.02 }\n\
         simulate: { structure: [{ name: cabinet, width: 0.8, height: 2.2 }] }\n\
         fit-pex: {}\nfit-pro: {}\n\
         evaluate: { hazard: hazard.csv, fits: out, out: out/evaluated.parquet,\n\
         \x20 structure: [{ name: cabinet, width: 0.8, height: 2.2 }] }\n\
         validate: { fits: out }\n",
    );
    std::fs::write(folder.path().join("hazard.csv"), CURVE).unwrap();
    let (printed, _) = succeed(folder.path(), "run");
    assert!(printed.starts_with("cabinet"), "{printed}");
    assert_eq!(succeed(folder.path(), "run").0, printed, "what is up to date is printed as before");
    let cabinet = "--structure name=cabinet,width=0.8,height=2.2";
    let row = &evaluated(folder.path(), &format!("--fits out {cabinet} --hazard hazard.csv"))[0];
    let all = evaluated(folder.path(), "--fits out --hazard hazard.csv");
    assert_eq!(all.len(), 1, "without a structure, all that are fitted");
    assert!(near(number(&all[0], "overturning_per_year"), number(row, "overturning_per_year"), 1e-12));
    let other = "evaluate --fits out --name cabinet --width 0.4 --height 1.6 --pga 0.8 --pgv 0.9";
    assert!(succeed(folder.path(), other).1.contains(Warning::OtherStructure.text()));
    succeed(folder.path(), &format!("export --to pelicun --over pgv --fits out {cabinet} --out curve.csv"));
    assert!(folder.path().join("curve.json").exists() && folder.path().join("curve.csv").exists());
}

#[test]
fn an_exported_curve_is_that_of_evaluate_and_rises() {
    let folder = folder(&[]);
    let here = folder.path();
    let both_ways = "--width 0.5 --depth 0.4 --height 1.9";
    let upstairs = &format!("{both_ways} --period 0.6 --level 0.6");
    let [pga, pgv] = [("pga", 1.0), ("pgv", 100.0)];
    for (object, (peak, unit)) in [(BLOCK, pga), (both_ways, pga), (upstairs, pga), (upstairs, pgv)] {
        succeed(here, &format!("export --to openquake --over {peak} {object} --force"));
        let xml = std::fs::read_to_string(here.join("fragility.xml")).unwrap();
        let numbers = |opening: &str| -> Vec<f64> {
            let after = xml.split_once(opening).unwrap().1.split_once('>').unwrap().1;
            after.split('<').next().unwrap().split(' ').map(|number| number.parse().unwrap()).collect()
        };
        let levels = numbers("<imls");
        assert!(levels.is_sorted() && (object != BLOCK || near(levels[0], 0.25, 1e-9)), "{levels:?}");
        for at in [0, 1, 2, 3, 4].map(|part| part * (levels.len() - 1) / 4) {
            let row = &evaluated(here, &format!("{object} --{peak} {}", levels[at] / unit))[0];
            for (state, p) in [("LS1", "p_rocking"), ("LS2", "p_failure"), ("LS3", "p_overturning")] {
                let exported = numbers(&format!("<poes ls=\"{state}\""));
                let difference = (exported[at] - number(row, p)).abs();
                assert!(exported.is_sorted() && difference < 1e-9, "{object}: {p} at {}", levels[at]);
            }
        }
    }
}

#[test]
fn an_export_names_each_structure_once_with_its_own_description() {
    let list = "name,width,height,storey,storeys\na b,0.5,1.9,3,5\na-b,0.6,1.9,0,5\n\u{8868},0.7,1.9,0,5\n\
                \u{67b6},0.8,1.9,5,5\nunknown,0.8,1.9,2,\n";
    let folder = folder(&[("list.csv", list)]);
    let (_, warned) = succeed(folder.path(), "export --to openquake --over pga --structures list.csv");
    assert!(warned.contains(Warning::NoAnswer.text()) && warned.contains("unknown"), "{warned}");
    let xml = std::fs::read_to_string(folder.path().join("fragility.xml")).unwrap();
    let ids: Vec<&str> =
        xml.split("<fragilityFunction id=\"").skip(1).map(|rest| rest.split('"').next().unwrap()).collect();
    assert!(ids.len() == 4 && xml.contains("floor 3 of 5") && xml.contains("on the ground"));
    assert!(ids.iter().all(|id| xml.matches(&format!("{id}: ")).count() == 1), "each is described: {xml}");
    succeed(folder.path(), "export --to pelicun --over pga --structures list.csv --out curves");
    let parameters = std::fs::read_to_string(folder.path().join("curves.csv")).unwrap();
    let alone = parameters.matches("deterministic").count();
    assert_eq!(alone, 2, "PGA alone decides on the ground: {parameters}");
}

#[test]
fn nothing_rocks_below_uplift_or_where_nothing_moves() {
    let folder = folder(&[("still.csv", "pga_g,pgv_m_s\n0,0\n")]);
    for motion in [
        "--pga 0.24 --pgv 0.5",
        "--pgv 0",
        "--pga 0",
        "--pga 0 --pgv 0",
        "--pga 0 --pgv 0 --period 0.5 --level 1",
        "--in still.csv",
    ] {
        let row = &evaluated(folder.path(), &format!("{BLOCK} {motion}"))[0];
        assert_eq!((number(row, "p_rocking"), number(row, "p_failure")), (0.0, 0.0), "{motion}: {row}");
        assert!(row["p_ro"].is_null(), "nothing is given rocking");
        let (text, _) = succeed(folder.path(), &format!("evaluate {BLOCK} {motion}"));
        assert!(!text.contains("NaN") && !text.contains(" - %"), "{text}");
    }
}

#[test]
fn rows_beyond_any_record_are_answered_at_the_rim() {
    let table = "PGA (g),PGV (m/s)\n0.4,0.5\n0.5,0.6\n6,0.9\n0.3,9\n0.5,0.001\n0.2,0.2\n";
    let at_rim = "PGA (g),PGV (m/s)\n0.4,0.5\n0.5,0.6\n4.5,0.9\n0.3,5\n0.5,0.0245250\n0.2,0.2\n";
    let folder = folder(&[("table.csv", table), ("rim.csv", at_rim)]);
    let rows = |arguments: &str| evaluated(folder.path(), &format!("{BLOCK} --in {arguments} --force"));
    let (found, expected) = (rows("table.csv"), rows("rim.csv"));
    for (row, (found, expected)) in found.iter().zip(&expected).enumerate() {
        let [found_p, expected_p] = [found, expected].map(|row| number(row, "p_failure"));
        assert!(found_p == expected_p || near(found_p, expected_p, 1e-6), "row {row}");
        let is_warned = found["warnings"].as_str().is_some_and(|text| text.contains(Warning::AtRim.text()));
        assert_eq!(is_warned, (2..5).contains(&row), "row {row}");
    }
    let stations = "station,PGA,PGV,PGD,distance (km)\n,g,m/s,,\na,0.4,0.5,8,12\nb,0.4,-999,,\n";
    std::fs::write(folder.path().join("stations.csv"), stations).unwrap();
    let stations = rows("stations.csv --ignore PGD");
    assert!(number(&stations[0], "p_failure") > 0.0 && stations[1]["p_failure"].is_null());
    // A magnitude holds for rows without one.
    let with = evaluated(folder.path(), &format!("{BLOCK} --pga 0.4 --pgv 0.5 --magnitude 7.5"));
    let of_row = number(&rows("table.csv --magnitude 7.5")[0], "p_failure");
    assert!(
        near(of_row, number(&with[0], "p_failure"), 1e-9)
            && !near(of_row, number(&found[0], "p_failure"), 1e-3)
    );
}

#[test]
fn a_block_without_motion_or_hazard_has_a_fragility() {
    let list = "name,width_m,height_m\nthin,0.3,1.9\nsquat,1.5,1.9\n";
    let folder = folder(&[("list.csv", list), ("hazard.csv", CURVE)]);
    for (row, peak) in evaluated(folder.path(), BLOCK).iter().zip(["pgv", "pga"]) {
        let theta = number(row, "overturning_theta");
        let at = &evaluated(folder.path(), &format!("{BLOCK} --{peak} {theta}"))[0];
        assert!((number(at, "p_overturning") - 0.5).abs() < 1e-6 && row["magnitude_by"] == "usual");
    }
    // A list has its curves by name, one below the other.
    succeed(folder.path(), "evaluate --structures list.csv --out curve.json");
    let curve: Vec<Value> = serde_json::from_slice(&bytes(&folder.path().join("curve.json"))).unwrap();
    let names: Vec<&str> = curve.iter().map(|point| point["structure"].as_str().unwrap()).collect();
    assert_eq!([names[0], names[names.len() - 1]], ["thin", "squat"]);
    assert!(curve.iter().all(|point| number(point, "p_overturning") <= number(point, "p_failure") + 1e-9));
    // At a site as a figure; of several objects as a page, by the call and by the file of the curves.
    succeed(folder.path(), &format!("evaluate {BLOCK} --hazard hazard.csv --over pga --out fragility.svg"));
    assert!(std::fs::read_to_string(folder.path().join("fragility.svg")).unwrap().contains("Fragility"));
    succeed(folder.path(), "evaluate --structures list.csv --out curves.parquet");
    succeed(folder.path(), "report --in curves.parquet --out read.html");
    succeed(folder.path(), "evaluate --structures list.csv --out page.html");
    let cells = |page: &str| -> Vec<String> {
        let page = std::fs::read_to_string(folder.path().join(page)).unwrap();
        let rows = page.split("<tr>").filter(|row| row.starts_with("<td") && row.contains("=\"16 %\""));
        rows.map(|row| row.split("</td>").take(5).collect()).collect()
    };
    assert!(cells("read.html").len() == 2 && cells("read.html") == cells("page.html"));
}
