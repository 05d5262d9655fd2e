//! validate as a user calls it.

use arrow_array::Array;
use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, Int64Type};
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;

use crate::common::{content, fail, rockfrag, succeed};
use crate::evaluate::{fitted, run_folder};

#[test]
fn fitted_curves_predict_the_counts_they_were_fitted_to() {
    let (folder, fits) = fitted();
    let run = run_folder().display();
    let call = format!("validate --in {run}/responses.parquet {fits} --out own.parquet");
    let output = rockfrag(folder.path()).args(call.split_whitespace()).output().unwrap();
    let table = String::from_utf8(output.stdout).unwrap();
    let told = String::from_utf8(output.stderr).unwrap();
    assert_eq!(told.matches("was fitted to these responses").count(), 2, "{told}");
    assert!(output.status.success() && table.contains("overturning"), "{table}");
    let file = std::fs::File::open(folder.path().join("own.parquet")).unwrap();
    let rows =
        ParquetRecordBatchReaderBuilder::try_new(file).unwrap().build().unwrap().next().unwrap().unwrap();
    let text = |name: &str, row| rows[name].as_string::<i32>().value(row).to_string();
    let count = |name: &str, row| rows[name].as_primitive::<Int64Type>().value(row);
    let number = |name: &str, row| rows[name].as_primitive::<Float64Type>().value(row);
    for row in 0..rows.num_rows() {
        assert_eq!(text("structure", row), "electrical-equipment");
        assert_eq!((count("without_measure", row), count("impossible", row)), (0, 0));
        // Cases of the fit itself lie within its data; of failure, those of the other fit may not.
        let is_own = text("suite", row) == text("fits_suite", row);
        if is_own && text("event", row) == "overturning" {
            assert_eq!(count("extrapolated", row), 0);
        }
        assert!(number("expected_low", row) < number("expected", row));
        // Maximum likelihood makes the expected count nearly the seen one on the cases of the fit itself.
        if text("suite", row) == text("fits_suite", row) && text("event", row) == "overturning" {
            let difference = number("expected", row) - count("seen", row) as f64;
            assert!(difference.abs() < 0.05 * count("n", row) as f64, "{difference}");
        }
    }
    assert_eq!(rows.num_rows(), 2 * 3);
}

#[test]
fn the_order_of_the_threads_does_not_matter() {
    let (folder, fits) = fitted();
    let run = run_folder().display();
    for threads in [1, 2] {
        let out = format!("--out {threads}.parquet --threads {threads}");
        succeed(folder.path(), &format!("validate --in {run}/responses.parquet {fits} {out}"));
    }
    let [one, two] = ["1.parquet", "2.parquet"].map(|file| content(&folder.path().join(file)));
    assert_eq!(one, two);
}

#[test]
fn responses_of_other_structures_are_refused() {
    let (folder, fits) = fitted();
    let run = run_folder().display();
    let motions = format!("--in {run}/motions.parquet --out other.parquet");
    succeed(folder.path(), &format!("simulate {motions} --p 1.7 --alpha 0.2 --eta 0.92"));
    fail(folder.path(), &format!("validate --in other.parquet {fits}"), 1, &["same structures"]);
    // Responses to other motions are a test of the fits.
    std::fs::write(folder.path().join("s.csv"), "name,p,alpha,eta\nelectrical-equipment,2.5,0.2,0.92\n")
        .unwrap();
    succeed(folder.path(), "sample-scenarios --mw 7 --re 5 --samples 9 --seed 5");
    succeed(folder.path(), "synthesize-motions --suite csgm --dt 0.01");
    succeed(folder.path(), "simulate --structures s.csv");
    let told = succeed(folder.path(), &format!("validate {fits}"));
    assert!(!told.contains("was fitted to") && told.contains("counts of"), "{told}");
    let pex = format!("--pex {run}/pex.parquet --pro {run}/pro.parquet");
    let call = format!("validate --in {run}/responses.parquet {pex} --suite csmg");
    fail(folder.path(), &call, 2, &["--suite csgm"]);
}

#[test]
fn a_hazard_counts_rates_without_a_curve() {
    let (folder, fits) = fitted();
    let run = run_folder().display();
    let hazard = format!("{}/data/hazard.csv", env!("CARGO_MANIFEST_DIR"));
    let call = format!("validate --in {run}/responses.parquet {fits} --hazard {hazard} --out v.parquet");
    let told = succeed(folder.path(), &call);
    assert!(told.contains("annual rates agree with those counted"), "{told}");
    let file = std::fs::File::open(folder.path().join("v.parquet")).unwrap();
    let rows =
        ParquetRecordBatchReaderBuilder::try_new(file).unwrap().build().unwrap().next().unwrap().unwrap();
    for row in 0..rows.num_rows() {
        let event = rows["event"].as_string::<i32>().value(row).to_string();
        let rate = |name: &str| {
            let rates = rows[name].as_primitive::<Float64Type>();
            (!rates.is_null(row)).then(|| rates.value(row))
        };
        let rates = ["counted_rate_low", "counted_rate", "counted_rate_high", "expected_rate"].map(rate);
        match rates {
            [Some(low), Some(counted), Some(high), Some(_)] => assert!(low < counted && counted < high),
            rates => assert!(event == "exceeding" && rates == [None; 4], "{event}: {rates:?}"),
        }
    }
    std::fs::copy(hazard.replace("hazard.csv", "hazard_joint.csv"), folder.path().join("joint.csv")).unwrap();
    let call = format!("validate --in {run}/responses.parquet {fits} --hazard joint.csv --out j.parquet");
    fail(folder.path(), &call, 1, &["joint hazard", "expected one of PGA"]);
}

#[test]
fn a_rate_of_fits_is_counted_where_their_responses_are() {
    let (folder, fits) = fitted();
    let hazard = format!("{}/data/hazard.csv", env!("CARGO_MANIFEST_DIR"));
    let ask = |fits: &str, rest: &str| {
        let call = format!("evaluate {fits} --p 2.5 --alpha 0.2 --hazard {hazard} {rest}");
        let output = rockfrag(folder.path()).args(call.split_whitespace()).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    };
    let counted = "counted without a curve in";
    assert!(ask(&fits, "").contains(counted));
    // With another ratio than that of the motions, or of another structure, a count says nothing.
    assert!(!ask(&fits, "--ratio 0.3").contains("counted"));
    assert!(!ask(&fits, "--eta 0.8").contains("counted"));
    let run = run_folder();
    for file in ["pex.parquet", "pro.parquet"] {
        std::fs::copy(run.join(file), folder.path().join(file)).unwrap();
    }
    let alone = fits.replace(&format!("{}/", run.display()), "");
    assert!(ask(&alone, "").contains("rockfrag validate --in RESPONSES --hazard"));
    // By what it holds, not by its name.
    std::fs::copy(run.join("responses.parquet"), folder.path().join("others.parquet")).unwrap();
    assert!(ask(&alone, "").contains(&format!("{counted} ")) && ask(&alone, "").contains("others.parquet"));
}

#[test]
fn rates_from_few_overturnings_say_that_their_limits_are_too_narrow() {
    let (folder, fits) = fitted();
    let hazard = format!("{}/data/hazard.csv", env!("CARGO_MANIFEST_DIR"));
    let ask = |fits: &str| succeed(folder.path(), &format!("evaluate {fits} --hazard {hazard}"));
    let few = fits.replace("electrical-equipment", "frame --model univariate --p 1.0 --alpha 0.15");
    let told = ask(&few);
    assert!(
        told.contains("from 6 overturnings of 240 motions") && told.contains("annual rates from so few"),
        "{told}"
    );
    assert!(told.contains("by the universal surface") && told.contains("too high on average"), "{told}");
    let told = ask(&format!("{fits} --p 2.5 --alpha 0.2"));
    assert!(!told.contains("annual rates from so few"), "{told}");
}

/// Blocks of a CSV file, from those that fall often to those that never do.
fn many_structures(folder: &std::path::Path) {
    let row = |n: usize| format!("b{n},{:.3},1.5,0.9\n", 0.15 + 0.02 * n as f64);
    let rows = (0..60).map(row).collect::<String>();
    std::fs::write(folder.join("s.csv"), format!("name,width,height,eta\n{rows}")).unwrap();
}

#[test]
fn fits_that_are_left_out_are_summed_up_and_all_named_in_the_file() {
    let folder = tempfile::tempdir().unwrap();
    many_structures(folder.path());
    succeed(folder.path(), "sample-scenarios --mw 7 --re 5,10 --samples 12 --seed 5");
    succeed(folder.path(), "synthesize-motions --suite csgm --dt 0.01");
    succeed(folder.path(), "simulate --structures s.csv");
    succeed(folder.path(), "fit-pex");
    succeed(folder.path(), "fit-pro --estimator firth");
    succeed(folder.path(), "sample-scenarios --mw 7.5 --re 5 --samples 8 --seed 6 --out other.parquet");
    succeed(
        folder.path(),
        "synthesize-motions --suite csgm --dt 0.01 --in other.parquet --out others.parquet",
    );
    succeed(folder.path(), "simulate --structures s.csv --in others.parquet --out r.parquet");
    let told = succeed(folder.path(), "validate --in r.parquet --model univariate");
    let lines: Vec<&str> = told.lines().filter(|line| line.contains("left out")).collect();
    assert!((1..=6).contains(&lines.len()), "{told}");
    assert!(lines.iter().any(|line| line.contains(" more, which the file written names")), "{told}");
    // A file that is up to date tells it again, and for programs in full.
    let output = rockfrag(folder.path())
        .args("validate --in r.parquet --model univariate --format json".split_whitespace())
        .output()
        .unwrap();
    assert!(String::from_utf8_lossy(&output.stderr).contains("warning: fits left out"));
    let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let all = json["warnings"].as_array().unwrap().iter().map(|warning| warning.as_str().unwrap());
    let all = all.filter(|warning| warning.contains("left out")).collect::<Vec<_>>().join("; ");
    let rows = json["rows"].as_array().unwrap();
    let is_there = |name: &str| rows.iter().any(|row| row["structure"] == name);
    for name in (0..60).map(|n| format!("b{n}")).filter(|name| !is_there(name)) {
        let is_named = all.split([';', ':']).any(|named| named.trim() == format!("csgm, {name}"));
        assert!(is_named, "{name}: {all}");
    }
}
