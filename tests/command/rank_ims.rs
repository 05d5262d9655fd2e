//! rank-ims as a user calls it.

use std::path::Path;
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, Int64Type};
use arrow_array::{Array, ArrayRef, Int64Array, RecordBatch};

use crate::clusters::{responses, rows};
use crate::common::{SMALL_PIPELINE, fail, rockfrag, succeed, write};
use crate::evaluate::run_folder;

fn text(rows: &RecordBatch, name: &str, row: usize) -> String {
    rows[name].as_string::<i32>().value(row).to_string()
}

fn number(rows: &RecordBatch, name: &str, row: usize) -> f64 {
    rows[name].as_primitive::<Float64Type>().value(row)
}

/// The first row in which all these columns hold these words.
#[track_caller]
fn row_of(rows: &RecordBatch, words: &[(&str, &str)]) -> usize {
    let holds = |row: usize| words.iter().all(|(name, word)| text(rows, name, row) == *word);
    (0..rows.num_rows()).find(|&row| holds(row)).unwrap()
}

const GROUP: [(&str, &str); 2] = [("suite", "csgm"), ("structure", "electrical-equipment")];

#[test]
fn figures_of_the_fits_are_those_of_fit_pex_and_fit_pro() {
    let (folder, run) = (tempfile::tempdir().unwrap(), run_folder());
    let call = format!("rank-ims --in {}/responses.parquet --out {{}} --terms 2", run.display());
    let out = folder.path().join("ranking.parquet");
    succeed(folder.path(), &call.replace("{}", "ranking.parquet"));
    let (ranking, pro, pex) = (rows(&out), rows(&run.join("pro.parquet")), rows(&run.join("pex.parquet")));
    let of = |more: &[(&'static str, &'static str)]| [&GROUP[..], more].concat();
    let hybrid = row_of(&ranking, &of(&[("target", "p_ro"), ("measures", "im4:im3_inv")]));
    let curve = (0..pro.num_rows()).find(|&row| {
        GROUP.iter().all(|(name, word)| text(&pro, name, row) == *word) && pro["im_y"].is_valid(row)
    });
    for name in ["log_likelihood", "aic", "bic", "auc", "brier", "beta"] {
        let (ours, expected) = (number(&ranking, name, hybrid), number(&pro, name, curve.unwrap()));
        assert!((ours - expected).abs() < 1e-9 * expected.abs(), "{name}: {ours}, {expected}");
    }
    let alone = of(&[("target", "p_ex"), ("measures", "im5"), ("form", "single")]);
    let alone = row_of(&ranking, &alone);
    let law = row_of(&pex, &of(&[("model", "univariate"), ("im_x", "im5")]));
    for (name, of_law) in [("beta", "beta"), ("zeta", "zeta"), ("b1", "b1"), ("b0", "ln_a")] {
        let (ours, expected) = (number(&ranking, name, alone), number(&pex, of_law, law));
        assert!((ours - expected).abs() < 1e-9 * expected.abs(), "{name}: {ours}, {expected}");
    }
    assert_eq!(text(&ranking, "clustered_by", 0), "cell");
    assert_eq!(ranking["terms"].as_primitive::<Int64Type>().iter().flatten().max(), Some(2));
}

#[test]
fn further_measures_compete_and_threads_do_not_matter() {
    let (folder, run) = (tempfile::tempdir().unwrap(), run_folder().display());
    let call =
        format!("rank-ims --in {run}/responses.parquet --motions {run}/motions.parquet --terms 2 --folds 4");
    let ranked = |threads: usize| {
        let call = format!("{call} --out {threads}.parquet --threads {threads}");
        let output = rockfrag(folder.path()).args(call.split_whitespace()).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let files = ["", ".reliability"]
            .map(|part| std::fs::read(folder.path().join(format!("{threads}{part}.parquet"))).unwrap());
        (String::from_utf8(output.stdout).unwrap(), files)
    };
    let ((table, files), (again, same)) = (ranked(1), ranked(2));
    assert!(files == same, "the files are the same to the byte");
    assert_eq!(table, again);
    let ranking = rows(&folder.path().join("1.parquet"));
    for name in ["pgd", "arias", "cav", "d5_75", "d5_95"] {
        row_of(&ranking, &[("target", "p_ex"), ("measures", name)]);
    }
    for said in [" cases): the paper takes im4:im3 (broken)", "the best pair", "scalar of paper"] {
        assert!(table.contains(said), "{said} is not in {table}");
    }
    let reliability = rows(&folder.path().join("1.reliability.parquet"));
    let first = row_of(&reliability, &[("target", "p_ro"), ("measures", "im5"), ("suite", "csgm")]);
    let shares = (first..first + 10).map(|row| number(&reliability, "share", row));
    let forecasts: Vec<f64> = (first..first + 10).map(|row| number(&reliability, "forecast", row)).collect();
    assert!(forecasts.is_sorted() && shares.into_iter().all(|share| (0.0..=1.0).contains(&share)));
}

#[test]
fn it_is_a_stage_of_the_pipeline() {
    let folder = tempfile::tempdir().unwrap();
    let pipeline = format!("{SMALL_PIPELINE}rank-ims: {{ terms: 1 }}\n");
    std::fs::write(folder.path().join("pipeline.yaml"), pipeline).unwrap();
    assert!(succeed(folder.path(), "run").contains("rank-ims"));
    assert!(folder.path().join("out/ranking.parquet").exists());
    assert!(succeed(folder.path(), "run").contains("rank-ims             up to date"));
}

#[test]
fn records_are_left_out_by_earthquake_and_missing_events_are_said() {
    let folder = tempfile::tempdir().unwrap();
    responses(&folder.path().join("responses.parquet"), true);
    let output = rockfrag(folder.path()).args(["rank-ims", "--transition", "1.3"]).output().unwrap();
    let table = String::from_utf8(output.stdout).unwrap();
    assert!(
        output.status.success()
            && table.contains("p_ro block (0 events in 400 cases): no predictions by the model"),
        "{table}"
    );
    let ranking = rows(&folder.path().join("ranking.parquet"));
    assert_eq!(text(&ranking, "clustered_by", 0), "earthquake");
    let overturning = row_of(&ranking, &[("target", "p_ro"), ("measures", "im4")]);
    assert_eq!(text(&ranking, "status", overturning), "too_few_events");
    assert!(ranking["log_score"].is_null(overturning));
}

#[test]
fn bad_calls_and_other_motions_are_refused() {
    let (folder, run) = (tempfile::tempdir().unwrap(), run_folder());
    let here = folder.path();
    let run_files = format!("--in {}/responses.parquet --out ranking.parquet", run.display());
    for (option, said) in [
        ("--terms 4", "terms is 4"),
        ("--folds 1", "folds is 1"),
        ("--limit-state 0", "limit-state is 0"),
        ("--transition low", "'found' or an IM4"),
    ] {
        fail(here, &format!("rank-ims {run_files} {option}"), 2, &[said]);
    }
    fail(
        here,
        &format!("rank-ims --in {}/motions.parquet", run.display()),
        1,
        &["expected the output of simulate"],
    );
    let scenarios = format!("{run_files} --motions {}/scenarios.parquet", run.display());
    fail(here, &format!("rank-ims {scenarios}"), 1, &["made by sample-scenarios"]);
    let motions = format!("rank-ims {run_files} --motions motions.parquet");
    let one: ArrayRef = Arc::new(Int64Array::from(vec![123_456]));
    write(&here.join("motions.parquet"), vec![("motion_id", one)]);
    fail(here, &motions, 1, &["motions.parquet: no motion '0'", "the motions that the responses are to"]);
    succeed(here, "sample-scenarios --mw 6,7 --re 5,10 --samples 60 --seed 43");
    succeed(here, "synthesize-motions --dt 0.01 --overwrite");
    fail(here, &motions, 1, &["column 'pga_m_s2'", "the motions that the responses are to"]);
    assert!(!Path::new(&here.join("ranking.parquet")).exists());
}
