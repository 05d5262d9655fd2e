//! What is printed: tables for a reader, the same for a program, findings in words.

use std::path::Path;
use std::sync::Arc;

use arrow_array::types::Float32Type;
use arrow_array::{ArrayRef, Float32Array, Float64Array, Int64Array, ListArray, StringArray};
use rockfrag::table::paper::PaperRow;
use rockfrag::table::row::ReadRow;
use serde_json::Value;

use crate::common::{fail, rockfrag, small_pipeline, write};
use crate::evaluate::{fitted, run_folder};

/// What a command prints, and what it says besides.
fn call(folder: &Path, arguments: &str) -> (String, String) {
    let output = rockfrag(folder).args(arguments.split_whitespace()).output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{arguments}: {said}");
    (String::from_utf8(output.stdout).unwrap(), said)
}

fn json(folder: &Path, arguments: &str) -> Value {
    let (printed, _) = call(folder, &format!("{arguments} --format json"));
    serde_json::from_str(&printed).unwrap_or_else(|error| panic!("{arguments}: {error}: {printed}"))
}

#[test]
fn every_table_is_printed_for_programs_with_its_warnings() {
    let (folder, run) = (tempfile::tempdir().unwrap(), run_folder().display());
    let fits = format!("--pex {run}/pex.parquet --pro {run}/pro.parquet");
    for (arguments, column) in [
        (
            format!("compare-paper {fits} --responses {run}/responses.parquet --out paper.parquet"),
            "published",
        ),
        (format!("validate {fits} --in {run}/responses.parquet --out validation.parquet"), "expected"),
        (format!("rank-ims --in {run}/responses.parquet --out ranking.parquet --terms 1"), "log_score"),
        (format!("universality --in {run}/responses.parquet --out universality.parquet"), "verdict"),
        (
            format!(
                "ida --in {run}/motions.parquet --out ida.parquet --structures paper --steps 8 --halvings 0"
            ),
            "theta",
        ),
        (format!("inspect {run}/pro.parquet"), "column"),
        (format!("inspect {run}/pro.parquet --head 4"), "im_x"),
    ] {
        let printed = json(folder.path(), &arguments);
        let rows = printed["rows"].as_array().unwrap();
        assert!(
            !rows.is_empty() && rows.iter().all(|row| row.get(column).is_some()),
            "{arguments}: {printed}"
        );
        let warnings = printed["warnings"].as_array().unwrap();
        // Fits tested on their own responses prove nothing, and that is said in the object too.
        if arguments.starts_with("validate") {
            assert!(warnings.iter().any(|warning| warning.as_str().unwrap().contains("proves nothing")));
        }
        // The same again, from a file that is up to date.
        assert_eq!(json(folder.path(), &arguments), printed);
    }
}

#[test]
fn a_run_is_printed_for_programs() {
    let (folder, _) = small_pipeline();
    let printed = json(folder.path(), "run");
    let rows = printed["compare-paper"]["rows"].as_array().unwrap();
    assert!(rows.iter().any(|row| row["quantity"] == "hybrid_lambda"), "{printed}");
    assert!(!printed["fit-pro"]["warnings"].as_array().unwrap().is_empty(), "{printed}");
    // The published numbers are compared with those of the paper's set-up, which this is not.
    assert!(!printed["findings"].to_string().contains("published numbers"), "{printed}");
}

#[test]
fn the_first_rows_of_any_file_are_shown_under_their_units() {
    let folder = tempfile::tempdir().unwrap();
    let (printed, _) =
        call(folder.path(), &format!("inspect {}/motions.parquet --head 2", run_folder().display()));
    let lines: Vec<&str> = printed.lines().collect();
    assert_eq!(lines.len(), 4, "{printed}");
    let place = |word: &str, line: &str| line.find(word).map(|at| at + word.len());
    // Numbers stand to the right, names and units over them.
    let end = place("pga_m_s2", lines[0]).unwrap();
    assert!(lines[1][..end].ends_with("m/s2"), "{printed}");
    assert!(lines[2].contains("samples"), "{printed}");
    let lists = ListArray::from_iter_primitive::<Float32Type, _, _>([Some(vec![Some(0.5); 3]), None]);
    let columns: Vec<(&str, ArrayRef)> = vec![
        ("id", Arc::new(Int64Array::from(vec![1, 2]))),
        ("x", Arc::new(Float64Array::from(vec![Some(0.25), None]))),
        ("half", Arc::new(Float32Array::from(vec![0.5, 1.5]))),
        ("name", Arc::new(StringArray::from(vec!["one", "two"]))),
        ("a", Arc::new(lists)),
    ];
    write(&folder.path().join("any.parquet"), columns);
    let rows = json(folder.path(), "inspect any.parquet --head 9");
    let expected = serde_json::json!([
        { "id": 1, "x": 0.25, "half": 0.5, "name": "one", "a": "3 samples" },
        { "id": 2, "x": null, "half": 1.5, "name": "two", "a": null }
    ]);
    assert_eq!(rows["rows"], expected);
    let one = json(folder.path(), "inspect any.parquet --head 1");
    assert_eq!(one["rows"][0], expected[0], "a table of one row has its words");
    fail(folder.path(), "inspect missing.parquet --head 1", 1, &["missing.parquet", "no such file"]);
}

#[test]
fn a_run_of_the_paper_says_last_what_it_found() {
    let folder = tempfile::tempdir().unwrap();
    call(folder.path(), "init");
    let (printed, said) = call(folder.path(), "run");
    let expected = said.lines().filter(|line| line.contains("expected of the paper's set-up")).count();
    assert_eq!((expected, said.matches("warning:").count()), (1, 0), "{said}");
    let all: Vec<&str> = printed.lines().collect();
    // Below the table, where they stay in sight.
    let (table, lines) = all.split_at(all.len() - 2);
    assert!(table[0].starts_with("quantity") && table[table.len() - 1].is_empty(), "{printed}");
    // As anyone counts them in the table.
    let rows = PaperRow::read(folder.path().join("out/paper.parquet")).unwrap();
    let deviations: Vec<f64> = rows.iter().filter_map(|row| row.z).collect();
    let within = deviations.iter().filter(|z| z.abs() <= 2.0).count();
    assert!(
        lines[0].starts_with(&format!("{within} of {} published numbers", deviations.len())),
        "{}",
        lines[0]
    );
    assert!(lines[0].contains("of the 8 planes of Table II, 5 are reproduced"), "{}", lines[0]);
    // The probability is that of evaluate.
    let answer = json(
        folder.path(),
        "evaluate --pex out/pex.parquet --pro out/pro.parquet --suite csgm --structure electrical-equipment --p 2.5 --alpha 0.2 --pga 0.5 --pgv 0.6",
    );
    let p_ro = answer["rows"].as_array().unwrap().iter().find(|row| row["quantity"] == "p_ro").unwrap();
    let [value, low, high] = ["value", "low", "high"].map(|name| p_ro[name].as_f64().unwrap());
    let sentence =
        format!("{value:.2} for electrical-equipment ({low:.2} to {high:.2}; by a curve that bends");
    assert!(lines[1].contains(&sentence), "{} has no '{sentence}'", lines[1]);
    // What is not shown one by one is kept in the files.
    let kept = json(folder.path(), "inspect out/pro.parquet");
    assert!(kept["warnings"].as_array().unwrap().len() > 3, "{kept}");
    // Any other set-up has its warnings one by one.
    let (printed, said) = call(folder.path(), "run --seed 7 --out other");
    let last = printed.lines().last().unwrap();
    assert!(
        last.starts_with("at PGA 0.5 g and PGV 0.6 m/s") && !printed.contains("published numbers"),
        "{printed}"
    );
    assert!(said.contains("warning: ") && !said.contains("expected of the paper's"), "{said}");
}

/// Rows of probabilities of a table, and of a hazard.
#[test]
fn headings_of_others_stand_for_columns() {
    let (folder, fits) = fitted();
    let at = |path: &str| folder.path().join(path);
    let columns = |names: [&'static str; 2]| -> Vec<(&str, ArrayRef)> {
        let peaks = [vec![3.0, 5.0], vec![0.3, 0.6]];
        names
            .into_iter()
            .zip(peaks)
            .map(|(name, peaks)| (name, Arc::new(Float64Array::from(peaks)) as ArrayRef))
            .collect()
    };
    write(&at("own.parquet"), columns(["pga_m_s2", "pgv_m_s"]));
    write(&at("other.parquet"), columns(["PGA (m/s2)", "vel"]));
    let ask = |rest: &str| format!("evaluate {fits} --p 2.5 --alpha 0.2 {rest}");
    call(folder.path(), &ask("--in own.parquet --out a.parquet"));
    let renamed = "--columns pga_m_s2=PGA (m/s2),pgv_m_s=vel";
    let arguments = ask("--in other.parquet --out b.parquet");
    let output = rockfrag(folder.path())
        .args(arguments.split_whitespace())
        .args(renamed.splitn(2, ' '))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let [a, b] = ["a", "b"]
        .map(|name| json(folder.path(), &format!("inspect {name}.parquet --head 2"))["rows"].clone());
    assert_eq!(a, b);
    fail(folder.path(), &ask("--in other.parquet --columns pgv_m_s=speed"), 1, &["'speed'", "vel"]);
    fail(folder.path(), &ask("--in other.parquet --columns pgv_m_s"), 2, &["COLUMN=HEADING"]);
}

#[test]
fn a_hazard_is_the_same_however_it_is_written() {
    let (folder, fits) = fitted();
    let rates = |text: &str, rest: &str| -> Value {
        std::fs::write(folder.path().join("h.csv"), text).unwrap();
        json(folder.path(), &format!("evaluate {fits} --p 2.5 --alpha 0.2 --ratio 0.3 --hazard h.csv {rest}"))
            ["rows"]
            .clone()
    };
    // Poisson: p = 1 - exp(-50 rate).
    let points = [(0.1_f64, 0.02_f64), (0.4, 0.002), (1.0, 0.0001)];
    let p = |rate: f64| 1.0 - (-50.0 * rate).exp();
    let lines = |head: &str, line: &dyn Fn(f64, f64) -> String| {
        points.iter().fold(format!("{head}\n"), |text, &(im, rate)| text + &line(im, rate) + "\n")
    };
    let plain = rates(&lines("pga_g,annual_rate_of_exceedance", &|im, rate| format!("{im},{rate}")), "");
    let comma = |number: String| number.replace('.', ",");
    let ways = [
        (lines("pga_g,probability_of_exceedance_in_50_years", &|im, rate| format!("{im},{}", p(rate))), ""),
        (
            lines("pga_g,probability_of_exceedance_in_50_years", &|im, rate| {
                format!("{}%,{} %", 100.0 * im, 100.0 * p(rate))
            }),
            "",
        ),
        (
            lines("PGA_g;Probability of exceedance in 50 years", &|im, rate| {
                format!("{};{}%", comma(im.to_string()), comma((100.0 * p(rate)).to_string()))
            }),
            "",
        ),
        (
            lines("T;PGA;lambda", &|im, rate| {
                format!("x;{};{}", comma(im.to_string()), comma(rate.to_string()))
            }),
            "--columns pga_g=PGA,annual_rate_of_exceedance=lambda",
        ),
        // As a spreadsheet leaves it, with an empty row at the end.
        (
            lines("PGA (g);PoE in 50 years (%)", &|im, rate| {
                format!("{};{}", comma(im.to_string()), comma((100.0 * p(rate)).to_string()))
            }) + ";\n",
            "--columns pga_g=PGA_(g),probability_of_exceedance_in_50_years=PoE_in_50_years_(%)",
        ),
        (lines("pga_m_s2,annual_rate_of_exceedance", &|im, rate| format!("{},{rate}", 9.81 * im)), ""),
        (lines("pga_g,return_period", &|im, rate| format!("{im},{}", 1.0 / rate)), ""),
        // Titles, a unit in brackets, rows of empty cells.
        (
            lines("Hazard of a site, near a fault\n\nPGA (g);Return period (years)", &|im, rate| {
                format!("{};{}\n;", comma(im.to_string()), comma((1.0 / rate).to_string()))
            }),
            "",
        ),
        (
            lines("Site 5,,\nPGA [g],Annual rate of exceedance,Return period", &|im, rate| {
                format!("{im},{rate},-\n,,")
            }),
            "",
        ),
        (
            lines("Site 5\nT\tMy PGA\trate", &|im, rate| format!("x\t{im}\t{rate}")),
            "--columns pga_g=my_pga,annual_rate_of_exceedance=Rate",
        ),
    ];
    for (text, rest) in ways {
        let other = rates(&text, rest);
        for (row, expected) in other.as_array().unwrap().iter().zip(plain.as_array().unwrap()) {
            for column in ["annual_rate", "annual_rate_low", "p", "p_high"] {
                let [one, other] = [row, expected].map(|row| row[column].as_f64());
                let (Some(one), Some(other)) = (one, other) else {
                    assert!(one.is_none() && other.is_none() && row["state"] == "LS1", "{text}: {column}");
                    continue;
                };
                assert!((one / other - 1.0).abs() < 1e-9, "{text}: {column} {one}, not {other}");
            }
        }
    }
}

#[test]
fn a_hazard_that_is_not_clear_is_refused_with_the_reason() {
    let (folder, fits) = fitted();
    for (text, expected) in [
        ("pga_g,annual_rate_of_exceedance\n0.1,5%\n", ["'5%'", "probability_of_exceedance_in_50_years"]),
        ("pga_g,annual_rate_of_exceedance\n0,1,0,05\n", ["4 cells under 2 headings", "semicolons"]),
        ("pga_g,annual_rate_of_exceedance\n0.1,\"0,05\"\n", ["'0,05'", "semicolons"]),
        ("pga_g,probability_of_exceedance_in_50_years\n0.1,50\n", ["'50'", "10%"]),
        ("pga_g,probability_of_exceedance_in_50_years\n0.1,101%\n", ["'101%'", "from 0 to 1"]),
        (
            "pga_g,probability_of_exceedance_in_0_years\n0.1,0.5\n",
            ["probability_of_exceedance_in_0_years", "expected pga_g"],
        ),
        ("pgv_m_s,annual_rate_of_exceedance\n10%,0.05\n", ["'10%'", "pga_g"]),
        ("PGA,rate\n0.1,0.05\n", ["columns PGA, rate", "--columns"]),
        ("PGA_g,Return period (yr)\n0.1,0\n", ["line 2, column 'Return period (yr)': '0'", "years above 0"]),
        ("Site 5\n\nPGA_g,Return period\n0.1,x\n", ["line 4, column 'Return period': 'x'", "number"]),
        ("", ["empty", "expected pga_g"]),
    ] {
        std::fs::write(folder.path().join("h.csv"), text).unwrap();
        let call = format!("evaluate {fits} --p 2.5 --alpha 0.2 --ratio 0.3 --hazard h.csv");
        fail(folder.path(), &call, 1, &expected);
    }
    std::fs::write(folder.path().join("h.csv"), "PGA,rate\n0.1,0.05\n").unwrap();
    let call = format!("evaluate {fits} --p 2.5 --alpha 0.2 --ratio 0.3 --hazard h.csv --columns pga_g=pgv");
    fail(folder.path(), &call, 1, &["no heading 'pgv'", "PGA, rate"]);
    let call = format!("evaluate {fits} --p 2.5 --alpha 0.2 --hazard h.csv");
    let utf_16 = |order: fn(u16) -> [u8; 2]| -> Vec<u8> {
        "\u{feff}PGA_g\tReturn period\n0.1\t50\n".encode_utf16().flat_map(order).collect()
    };
    for text in [utf_16(u16::to_le_bytes), utf_16(u16::to_be_bytes)] {
        std::fs::write(folder.path().join("h.csv"), text).unwrap();
        fail(folder.path(), &call, 1, &["h.csv: UTF-16", "Unicode text", "save it", "CSV UTF-8"]);
    }
    std::fs::write(folder.path().join("h.csv"), b"PK\x03\x04\xff").unwrap();
    fail(folder.path(), &call, 1, &["h.csv: an Excel workbook", "CSV UTF-8"]);
}
