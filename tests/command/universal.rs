//! evaluate without fits: the surface that is shipped answers, and says so.

use std::path::Path;
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, Int64Type};
use arrow_array::{Array, ArrayRef, Float64Array};

use crate::clusters::rows as rows_of;
use crate::common::{fail, rockfrag, succeed, write};
use crate::evaluate::{fitted, run_folder};

const BLOCK: &str = "evaluate --width 0.5 --height 2.0";

fn json(folder: &Path, arguments: &str) -> serde_json::Value {
    let arguments = format!("{arguments} --format json");
    let output = rockfrag(folder).args(arguments.split_whitespace()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice::<serde_json::Value>(&output.stdout).unwrap()["rows"].take()
}

fn value(answer: &serde_json::Value, quantity: &str, column: &str) -> f64 {
    let row = answer.as_array().unwrap().iter().find(|row| row["quantity"] == quantity).unwrap();
    row[column].as_f64().unwrap()
}

fn words(folder: &Path, arguments: &str) -> String {
    let output = rockfrag(folder).args(arguments.split_whitespace()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn one_command_and_no_file_answer() {
    let folder = tempfile::tempdir().unwrap();
    let said = words(folder.path(), &format!("{BLOCK} --pga 0.5 --pgv 0.6"));
    assert!(said.starts_with("universal fragility surface, of motions csgm"), "{said}");
    let answer = json(folder.path(), &format!("{BLOCK} --pga 0.5 --pgv 0.6"));
    let [p, low, high] = ["value", "low", "high"].map(|column| value(&answer, "p_f", column));
    assert!(0.0 < low && low < p && p < high && high < 1.0, "{answer}");
    assert_eq!(answer.as_array().unwrap().last().unwrap()["quantity"], "model");
    // More is exceeded of a smaller limit, and overturning does not know it.
    let smaller = json(folder.path(), &format!("{BLOCK} --pga 0.5 --pgv 0.6 --limit-state 0.03"));
    assert!(value(&smaller, "p_ex", "value") > value(&answer, "p_ex", "value"));
    assert_eq!(value(&smaller, "p_ro", "value"), value(&answer, "p_ro", "value"));
    assert!(std::fs::read_dir(folder.path()).unwrap().next().is_none());
}

#[test]
fn fits_answer_where_they_are_or_are_asked_for() {
    let (folder, fits) = fitted();
    let structure = "--p 2.5 --alpha 0.2 --eta 0.92 --pga 0.5 --pgv 0.6";
    assert!(words(folder.path(), &format!("evaluate {fits} {structure}")).starts_with("fits of"));
    let universal = words(folder.path(), &format!("evaluate {fits} --model universal {structure}"));
    assert!(universal.starts_with("universal fragility surface"), "{universal}");
    for asked in ["--model bivariate", "--measure im5", "--structure frame"] {
        fail(
            folder.path(),
            &format!("evaluate {asked} {structure}"),
            2,
            &["no pex.parquet and pro.parquet here", "universal"],
        );
    }
    fail(
        folder.path(),
        &format!("evaluate {fits} {structure} --limit-state 0.1"),
        2,
        &["fit-pex --limit-state"],
    );
}

#[test]
fn fits_that_only_lie_there_answer_for_their_own_structures() {
    let folder = tempfile::tempdir().unwrap();
    for file in ["pex.parquet", "pro.parquet"] {
        std::fs::copy(run_folder().join(file), folder.path().join(file)).unwrap();
    }
    // The README's first command.
    let told = succeed(folder.path(), &format!("{BLOCK} --pga 0.5 --pgv 0.6"));
    assert!(told.contains("not of this structure, so the universal surface answers"), "{told}");
    fail(folder.path(), &format!("{BLOCK} --pga 0.5 --pgv 0.6 --pex pex.parquet"), 2, &["--model universal"]);
    let own = "--p 2.5 --alpha 0.2 --eta 0.92 --pga 0.5 --pgv 0.6";
    fail(folder.path(), &format!("evaluate {own}"), 2, &["expected the choice", "--model universal"]);
}

#[test]
fn own_fits_say_how_far_they_are_from_the_surface() {
    let (folder, fits) = fitted();
    let structure = "--p 2.5 --alpha 0.2 --eta 0.92 --pga 0.5 --pgv 0.6";
    let own = json(folder.path(), &format!("evaluate {fits} {structure}"));
    let surface = json(folder.path(), &format!("evaluate --model universal {structure}"));
    let besides = value(&own, "p_ro_universal", "value");
    assert_eq!(besides, value(&surface, "p_ro", "value"));
    let apart = besides - value(&own, "p_ro", "value");
    assert!(own.to_string().contains(&format!("{apart:+.3} from the fits")), "{own}");
    assert!(!surface.to_string().contains("p_ro_universal"));
}

#[test]
fn responses_validate_the_surface() {
    let folder = tempfile::tempdir().unwrap();
    let run = run_folder().display();
    let told = succeed(folder.path(), &format!("validate --in {run}/responses.parquet --out v.parquet"));
    assert!(told.contains("by the universal surface"), "{told}");
    let table = rows_of(&folder.path().join("v.parquet"));
    let [seen, expected] = ["seen", "expected"].map(|name| table.column_by_name(name).unwrap().clone());
    let seen = seen.as_primitive::<Int64Type>();
    let expected = expected.as_primitive::<Float64Type>();
    for row in 0..table.num_rows() {
        // Motions of the same kind: what is seen is what is expected, within the limits of the surface.
        let (seen, expected) = (seen.value(row) as f64, expected.value(row));
        assert!((seen - expected).abs() < 0.25 * expected + 6.0, "row {row}: {seen} for {expected}");
    }
}

#[test]
fn what_the_surface_does_not_know_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let motion = "--pga 0.5 --pgv 0.6";
    fail(folder.path(), &format!("evaluate --p 2.5 --alpha 0.2 {motion}"), 2, &["expected p, alpha and eta"]);
    fail(folder.path(), &format!("{BLOCK} {motion} --limit-state 0.9"), 2, &["from 0.02 to 0.5"]);
    fail(folder.path(), &format!("{BLOCK} {motion} --suite record"), 2, &["pulse, csgm or hfc"]);
    fail(folder.path(), &format!("{BLOCK} {motion} --limits bc"), 2, &["universal surface has its own"]);
    assert_eq!(succeed(folder.path(), &format!("{BLOCK} {motion}")), "");
    let small = succeed(folder.path(), &format!("evaluate --p 20 --alpha 0.2 --eta 0.9 {motion}"));
    assert!(small.contains("p is 20.0000, outside of 0.4 to 8"), "{small}");
    // Three questions of which it knows nothing, and how far they are.
    for (question, outside) in [
        ("--p 2.5 --alpha 0.6 --eta 0.9 --pga 0.9 --pgv 0.6", "alpha is 0.6000, outside of 0.04 to 0.5"),
        ("--p 2.5 --alpha 0.2 --eta 0.5 --pga 0.5 --pgv 0.6", "eta is 0.5000, outside of 0.7 to 0.999"),
        ("--p 2.5 --alpha 0.2 --eta 0.9 --pga 0.5 --pgv 0.02", "im3 is 98.1000, outside of 0.233 to 72.52"),
    ] {
        let told = succeed(folder.path(), &format!("evaluate {question}"));
        assert!(told.contains(outside), "{told}");
        let answer = json(folder.path(), &format!("evaluate {question}"));
        assert!(value(&answer, "distance", "value") > 1.0, "{answer}");
    }
    assert!(value(&json(folder.path(), &format!("{BLOCK} {motion}")), "distance", "value") < 1.0);
    let strong = succeed(folder.path(), &format!("{BLOCK} --pga 19 --pgv 19"));
    assert!(strong.contains("im4 is") && strong.contains("extrapolated"), "{strong}");
}

#[test]
fn a_table_is_answered_row_by_row() {
    let folder = tempfile::tempdir().unwrap();
    let column = |values: &[f64]| Arc::new(Float64Array::from(values.to_vec())) as ArrayRef;
    let rows = [(2.5, 0.2, 0.92, 0.5, 0.6), (1.0, 0.15, 0.92, 0.3, 0.9)];
    let of = |k: fn(&(f64, f64, f64, f64, f64)) -> f64| column(&rows.iter().map(k).collect::<Vec<_>>());
    write(
        &folder.path().join("t.parquet"),
        vec![
            ("p_rad_s", of(|row| row.0)),
            ("alpha_rad", of(|row| row.1)),
            ("eta", of(|row| row.2)),
            ("pga_m_s2", of(|row| row.3 * 9.81)),
            ("pgv_m_s", of(|row| row.4)),
        ],
    );
    let said = succeed(folder.path(), "evaluate --in t.parquet --out e.parquet");
    assert!(said.contains("2 rows by the universal fragility surface"), "{said}");
    let (_, fits) = fitted();
    succeed(folder.path(), &format!("evaluate {fits} --in t.parquet --out own.parquet"));
    for (file, fits) in [("e.parquet", ""), ("own.parquet", &fits)] {
        let table = rows_of(&folder.path().join(file));
        let column = |name: &str| table.column_by_name(name).unwrap().as_primitive::<Float64Type>().clone();
        for (row, (p, alpha, eta, pga, pgv)) in rows.into_iter().enumerate() {
            let asked =
                format!("evaluate {fits} --p {p} --alpha {alpha} --eta {eta} --pga {pga} --pgv {pgv}");
            let answer = json(folder.path(), &asked);
            for name in ["p_ro", "distance"] {
                let difference = value(&answer, name, "value") - column(name).value(row);
                assert!(difference.abs() < 1e-12, "{name} of row {row} of {file}: {difference}");
            }
            let surface = column("p_ro_universal");
            assert_eq!(
                surface.is_null(row),
                fits.is_empty(),
                "the surface is beside fits, and not beside itself"
            );
            if !fits.is_empty() {
                let difference = value(&answer, "p_ro_universal", "value") - surface.value(row);
                assert!(difference.abs() < 1e-12, "row {row}: {difference}");
            }
        }
    }
}

#[test]
fn a_hazard_gives_rates() {
    let folder = tempfile::tempdir().unwrap();
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/data");
    for hazard in [
        format!("{data}/hazard.csv --ratio 0.25"),
        format!("{data}/hazard.csv"),
        format!("{data}/hazard_joint.csv"),
    ] {
        let answer =
            json(folder.path(), &format!("evaluate --p 2.5 --alpha 0.2 --eta 0.92 --hazard {hazard}"));
        let rates: Vec<f64> = (0..3).map(|k| answer[k]["annual_rate"].as_f64().unwrap()).collect();
        assert!(rates[0] > rates[1] && rates[1] > rates[2] && rates[2] > 0.0, "{rates:?}");
        let [low, high] =
            ["annual_rate_low", "annual_rate_high"].map(|limit| answer[2][limit].as_f64().unwrap());
        assert!(low < rates[2] && rates[2] < high);
    }
}

#[test]
fn what_the_surface_says_is_told_in_its_own_words() {
    let (folder, fits) = fitted();
    let surface = words(folder.path(), "evaluate --p 2.5 --alpha 0.2 --eta 0.92 --pga 0.3 --pgv 0.2");
    assert!(!surface.contains("Eq. 14") && !surface.contains("Eq. 20"), "{surface}");
    assert!(surface.contains("recorded motions overturned 7 to 18 % more often"), "{surface}");
    let structure = format!("evaluate {fits} --p 2.5 --alpha 0.2");
    let own = words(folder.path(), &format!("{structure} --pga 0.3 --pgv 0.2"));
    assert!(own.contains("Eq. 20") && own.contains("times the fits"), "{own}");
    let near = words(folder.path(), &format!("{structure} --pga 0.5 --pgv 0.6"));
    assert!(near.contains(" from the fits"), "{near}");
    std::fs::write(
        folder.path().join("h.csv"),
        "pga_g,annual_rate_of_exceedance\n0.1,0.01\n0.5,0.001\n2,0.000001\n",
    )
    .unwrap();
    let by_both = |ratio: &str| words(folder.path(), &format!("{structure} --hazard h.csv {ratio}"));
    assert!(by_both("").contains("over PGV / PGA as in the motions of the fits"));
    assert!(!by_both("--ratio 0.3").contains("over PGV / PGA"));
}

#[test]
fn fits_of_a_run_are_offered_to_their_own_structure() {
    let folder = run_folder().parent().unwrap();
    let told = |structure: &str| succeed(folder, &format!("evaluate {structure} --pga 0.5 --pgv 0.6"));
    assert!(told("--p 2.5 --alpha 0.2 --eta 0.92").contains("there are fits in out"));
    for other in ["--p 2.5 --alpha 0.2 --eta 0.85", "--p 3.5 --alpha 0.2 --eta 0.92"] {
        assert!(!told(other).contains("there are fits"), "{other}");
    }
}
