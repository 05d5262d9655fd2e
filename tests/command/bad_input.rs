//! Bad input gets one clear message and a non-zero exit.

use std::path::Path;
use std::sync::Arc;

use crate::common::{fail, small_pipeline, succeed, write};
use arrow_array::builder::{Float64Builder, ListBuilder};
use arrow_array::{ArrayRef, Float64Array, Int64Array, StringArray};

/// A motions file as another program might write it.
fn write_motions(path: &Path, dt: f64, motions: &[Option<Vec<Option<f64>>>]) {
    let mut list = ListBuilder::new(Float64Builder::new());
    for motion in motions {
        for sample in motion.iter().flatten() {
            list.values().append_option(*sample);
        }
        list.append(motion.is_some());
    }
    let ids = Int64Array::from_iter_values(0..motions.len() as i64);
    let dts = Float64Array::from(vec![dt; motions.len()]);
    write(
        path,
        vec![
            ("motion_id", Arc::new(ids)),
            ("dt_s", Arc::new(dts)),
            ("acceleration_m_s2", Arc::new(list.finish())),
        ],
    );
}

fn samples(values: &[f64]) -> Option<Vec<Option<f64>>> {
    Some(values.iter().copied().map(Some).collect())
}

#[test]
fn motions_of_others_need_three_columns_only() {
    let folder = tempfile::tempdir().unwrap();
    write_motions(&folder.path().join("m.parquet"), 0.01, &[samples(&[0.0, 3.0, -4.0, 0.0])]);
    let told = succeed(folder.path(), "simulate --in m.parquet --p 2.5 --alpha 0.2 --eta 0.92");
    assert!(told.contains("1 responses"), "{told}");
}

#[test]
fn motions_that_cannot_be_used_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let try_motions = |dt: f64, motions: &[Option<Vec<Option<f64>>>], expected: &[&str]| {
        write_motions(&folder.path().join("m.parquet"), dt, motions);
        fail(folder.path(), "simulate --in m.parquet --p 2.5 --alpha 0.2 --eta 0.92", 1, expected);
        assert!(!folder.path().join("responses.parquet").exists());
    };
    let fine = samples(&[0.0, 1.0]);
    try_motions(0.01, &[fine.clone(), None], &["m.parquet", "row 1", "acceleration_m_s2", "null"]);
    try_motions(0.01, &[fine.clone(), Some(vec![Some(1.0), None])], &["row 1", "sample 1 is null"]);
    try_motions(0.01, &[samples(&[0.0, f64::NAN])], &["row 0", "sample 1", "NaN"]);
    try_motions(0.01, &[samples(&[f64::INFINITY, 0.0])], &["sample 0", "inf"]);
    try_motions(0.01, &[samples(&[1.0])], &["row 0", "1 sample(s)", "2 or more"]);
    try_motions(0.0, std::slice::from_ref(&fine), &["dt_s", "0", "above 0 s"]);
    try_motions(-0.01, std::slice::from_ref(&fine), &["dt_s"]);
    try_motions(f64::NAN, &[fine], &["dt_s", "NaN"]);
    try_motions(0.01, &[], &["empty"]);
}

#[test]
fn columns_that_are_missing_or_of_another_type_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.parquet");
    let ids: ArrayRef = Arc::new(Int64Array::from(vec![1]));
    let dt: ArrayRef = Arc::new(Float64Array::from(vec![0.01]));
    let text: ArrayRef = Arc::new(StringArray::from(vec!["x"]));
    write(&path, vec![("motion_id", ids.clone()), ("dt_s", dt.clone())]);
    fail(
        folder.path(),
        "simulate --in m.parquet --p 2.5 --alpha 0.2 --eta 0.92",
        1,
        &["m.parquet", "no column 'acceleration_m_s2'", "m/s2"],
    );
    write(
        &path,
        vec![("motion_id", ids.clone()), ("dt_s", text.clone()), ("acceleration_m_s2", text.clone())],
    );
    fail(
        folder.path(),
        "simulate --in m.parquet --p 2.5 --alpha 0.2 --eta 0.92",
        1,
        &["'dt_s'", "expected 64-bit floating-point"],
    );
    write(&path, vec![("motion_id", ids), ("dt_s", dt), ("acceleration_m_s2", text)]);
    fail(
        folder.path(),
        "simulate --in m.parquet --p 2.5 --alpha 0.2 --eta 0.92",
        1,
        &["'acceleration_m_s2'", "lists of floating-point"],
    );
    fail(folder.path(), "synthesize-motions --in m.parquet", 1, &["no column", "scenario_id"]);
}

#[test]
fn two_motions_of_one_name_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mut list = ListBuilder::new(Float64Builder::new());
    for _ in 0..2 {
        list.values().append_slice(&[0.0, 1.0]);
        list.append(true);
    }
    let (ids, dts) = (StringArray::from(vec!["a", "a"]), Float64Array::from(vec![0.01, 0.01]));
    write(
        &folder.path().join("m.parquet"),
        vec![
            ("motion_id", Arc::new(ids)),
            ("dt_s", Arc::new(dts)),
            ("acceleration_m_s2", Arc::new(list.finish())),
        ],
    );
    fail(
        folder.path(),
        "simulate --in m.parquet --p 2.5 --alpha 0.2 --eta 0.92",
        1,
        &["two motions are called 'a'"],
    );
}

#[test]
fn files_that_are_missing_damaged_or_of_another_stage_are_named() {
    let (folder, _) = small_pipeline();
    fail(
        folder.path(),
        "simulate --p 2.5 --alpha 0.2 --eta 0.92",
        1,
        &["motions.parquet: no such file", "run the stage that makes it"],
    );
    std::fs::write(folder.path().join("bad.parquet"), b"no parquet at all").unwrap();
    fail(
        folder.path(),
        "simulate --in bad.parquet --p 2.5 --alpha 0.2 --eta 0.92",
        1,
        &["bad.parquet", "not a Parquet file"],
    );
    std::fs::write(folder.path().join("none.parquet"), b"").unwrap();
    fail(folder.path(), "inspect none.parquet", 1, &["none.parquet", "not a Parquet file"]);
    fail(
        folder.path(),
        "simulate --in . --p 2.5 --alpha 0.2 --eta 0.92",
        1,
        &["bad.parquet", "not a Parquet file"],
    );
    succeed(folder.path(), "run");
    fail(
        folder.path(),
        "simulate --in out/scenarios.parquet --p 2.5 --alpha 0.2 --eta 0.92",
        1,
        &["made by sample-scenarios", "synthesize-motions"],
    );
    fail(folder.path(), "fit-pex --in out/motions.parquet", 1, &["made by synthesize-motions", "simulate"]);
    let whole = std::fs::read(folder.path().join("out/motions.parquet")).unwrap();
    std::fs::write(folder.path().join("cut.parquet"), &whole[..whole.len() / 2]).unwrap();
    fail(
        folder.path(),
        "simulate --in cut.parquet --p 2.5 --alpha 0.2 --eta 0.92",
        1,
        &["cut.parquet", "not a readable Parquet file"],
    );
}

#[test]
fn impossible_parameters_are_named() {
    let (folder, _) = small_pipeline();
    succeed(folder.path(), "run");
    let simulate = |flags: &str, expected: &[&str]| {
        fail(
            folder.path(),
            &format!("simulate --in out/motions.parquet --out r.parquet {flags}"),
            2,
            expected,
        );
    };
    simulate("--p 0", &["p is 0", "above 0 rad/s"]);
    simulate("--alpha 1.6", &["alpha is 1.6", "between 0 and pi/2"]);
    simulate("--eta 1.2", &["eta is 1.2", "up to 1"]);
    simulate("--p nan", &["p is not a finite number"]);
    simulate("--structures none.csv", &["none.csv"]);
    std::fs::write(folder.path().join("s.yaml"), "- { name: a, p: 1 }\n").unwrap();
    simulate("--structures s.yaml", &["s.yaml: structure 'a': found p; expected", "p, alpha and eta"]);
    std::fs::write(folder.path().join("s.csv"), "name,Width (cm),height\na,50,2\n").unwrap();
    simulate("--structures s.csv", &["s.csv", "'Width (cm)'", "expected width_m, a length in m"]);
    std::fs::write(folder.path().join("s.csv"), "name,width,height\na,0.5,2\nb,0.6,2\n").unwrap();
    let evaluate = "evaluate --structures s.csv --name c --pga 0.5 --pgv 0.5";
    fail(folder.path(), evaluate, 2, &["s.csv: no structure 'c'; expected --name with one of a, b"]);
    fail(
        folder.path(),
        "simulate --in out/motions.parquet --out r.parquet --trace 99999 --p 2.5 --alpha 0.2 --eta 0.92",
        1,
        &["no motion '99999'"],
    );
    fail(folder.path(), "synthesize-motions --in out/scenarios.parquet --dt 0", 2, &["dt is 0"]);
    fail(
        folder.path(),
        "synthesize-motions --in out/scenarios.parquet --suite puls",
        2,
        &["did you mean 'pulse'"],
    );
    fail(folder.path(), "synthesize-motions --in out/scenarios.parquet --site mud", 2, &["site is 'mud'"]);
    fail(folder.path(), "sample-scenarios --mw 7:5:0.5", 2, &["7:5:0.5", "first <= last"]);
    fail(folder.path(), "sample-scenarios --samples 0", 2, &["samples is 0"]);
    fail(folder.path(), "fit-pex --in out/responses.parquet --limit-state 0", 2, &["limit-state is 0"]);
    fail(folder.path(), "fit-pex --in out/responses.parquet --confidence 1", 2, &["confidence is 1"]);
    fail(folder.path(), "fit-pro --in out/responses.parquet --link probt", 2, &["did you mean 'probit'"]);
}

#[test]
fn mistakes_in_the_pipeline_file_are_shown_with_their_place() {
    let (folder, file) = small_pipeline();
    let try_file = |text: &str, expected: &[&str]| {
        std::fs::write(&file, text).unwrap();
        fail(folder.path(), "run", 2, expected);
    };
    try_file(
        "simulat: {}\n",
        &["pipeline.yaml", "line 1", "unknown key 'simulat'", "did you mean 'simulate'?"],
    );
    try_file("seed: 1\nsynthesize-motions:\n  diference: clamp\n", &["line 3", "did you mean 'difference'?"]);
    try_file("sample-scenarios: { samples: ten }\n", &["pipeline.yaml", "line 1"]);
    try_file("seed: [1\n", &["pipeline.yaml", "line"]);
    try_file("seed: 1\n", &["no stage"]);
    try_file("synthesize-motions: { dt: .nan }\n", &["dt is NaN"]);
    fail(folder.path(), "run none.yaml", 2, &["none.yaml"]);
}

#[test]
fn a_fit_of_nothing_says_why_and_what_would_help() {
    let folder = tempfile::tempdir().unwrap();
    write_motions(&folder.path().join("m.parquet"), 0.01, &[samples(&[0.0, 3.0, -4.0, 0.0])]);
    succeed(folder.path(), "simulate --in m.parquet --p 2.5 --alpha 0.2 --eta 0.92");
    let told = succeed(folder.path(), "fit-pex --in responses.parquet");
    for part in ["too_few_cases", "none of 9 regressions", "more motions", "0 of 9 fits ok"] {
        assert!(told.contains(part), "{part}: {told}");
    }
    let ways = [
        "too_few_events",
        "none of 7 curves",
        "overturning in 0 of",
        "expected 5",
        "--scale",
        "--estimator firth",
        "ida",
    ];
    let told = succeed(folder.path(), "fit-pro --in responses.parquet");
    for part in ways {
        assert!(told.contains(part), "{part}: {told}");
    }
    // Fits that are only found leave the answer to the surface, those that are named do not.
    let evaluate = "evaluate --p 2.5 --alpha 0.2 --eta 0.92 --pga 0.5 --pgv 0.5";
    let told = succeed(folder.path(), evaluate);
    assert!(
        told.contains("have no usable fit of this structure, so the universal surface answers"),
        "{told}"
    );
    let named = format!("{evaluate} --pex pex.parquet --pro pro.parquet");
    fail(folder.path(), &named, 2, &["too_few_cases", "--model universal"]);
}

#[test]
fn a_folder_that_cannot_be_written_is_named() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("file"), b"").unwrap();
    fail(folder.path(), "sample-scenarios --out file/scenarios.parquet", 1, &["file"]);
    fail(folder.path(), "sample-scenarios --out /proc/scenarios.parquet", 1, &["/proc"]);
}

#[test]
fn a_full_disk_leaves_nothing_behind() {
    let folder = tempfile::tempdir().unwrap();
    succeed(folder.path(), "sample-scenarios --samples 2");
    // A limit on the size of files stands in for a full disk: the write fails half-way.
    let binary = assert_cmd::cargo::cargo_bin("rockfrag");
    let script = format!("trap '' XFSZ; ulimit -f 200; exec {} synthesize-motions", binary.display());
    let output =
        std::process::Command::new("bash").args(["-c", &script]).current_dir(folder.path()).output().unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{stderr}");
    assert!(stderr.contains("motions.parquet: cannot write"), "{stderr}");
    let left: Vec<_> =
        std::fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left, ["scenarios.parquet"]);
}
