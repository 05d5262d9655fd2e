//! universality as a user calls it.

use crate::common::{content, fail, rockfrag, succeed};
use crate::evaluate::run_folder;

#[test]
fn the_curve_of_one_structure_is_judged_on_the_other() {
    let (folder, run) = (tempfile::tempdir().unwrap(), run_folder().display());
    let call = format!("universality --in {run}/responses.parquet --out u.parquet");
    let output = rockfrag(folder.path()).args(call.split_whitespace()).output().unwrap();
    let (text, told) = (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    assert!(output.status.success(), "{told}");
    for expected in ["csgm, overturning: the curve of electrical-equipment on 1 other", "one line for all"] {
        assert!(text.contains(expected), "{text}");
    }
    // Both structures have the same eta, so that nothing can be said of it.
    assert!(told.contains("no pooled curve, constant: restitution of overturning"), "{told}");
    let again = rockfrag(folder.path()).args(call.split_whitespace()).output().unwrap();
    assert!(String::from_utf8_lossy(&again.stderr).contains("up to date"));
    assert_eq!(String::from_utf8_lossy(&again.stdout), text);
    for (threads, file) in [(1, "one"), (2, "two")] {
        let call =
            format!("universality --in {run}/responses.parquet --out {file}.parquet --threads {threads}");
        succeed(folder.path(), &call);
    }
    for part in ["", ".pooled"] {
        let [one, two] =
            ["one", "two"].map(|file| content(&folder.path().join(format!("{file}{part}.parquet"))));
        assert_eq!(one, two);
    }
}

#[test]
fn what_cannot_be_transferred_is_explained() {
    let (folder, run) = (tempfile::tempdir().unwrap(), run_folder().display());
    let ask = |rest: &str, code, expected: &[&str]| {
        let call = format!("universality --in {run}/responses.parquet --out u.parquet {rest}");
        fail(folder.path(), &call, code, expected);
    };
    ask("--reference fram", 2, &["no structure 'fram'", "frame, electrical-equipment"]);
    ask("--measure im5", 2, &["needs --model univariate"]);
    ask("--transition 0.5", 2, &["transition is 0.5"]);
    ask("--limit-state 0", 2, &["limit-state is 0"]);
}

#[test]
fn a_run_ends_with_it_if_the_file_says_so() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("out")).unwrap();
    let responses = folder.path().join("out/responses.parquet");
    std::fs::copy(run_folder().join("responses.parquet"), responses).unwrap();
    std::fs::write(folder.path().join("pipeline.yaml"), "universality: { limit-state: 0.2 }\n").unwrap();
    let output = rockfrag(folder.path()).arg("run").output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("the curve of electrical-equipment on 1 other structures"), "{text}");
    assert!(folder.path().join("out/universality.pooled.parquet").exists());
}

#[test]
fn structures_without_levels_are_told_of_in_ranges() {
    let folder = tempfile::tempdir().unwrap();
    let row = |n: usize| format!("b{n},{:.3},{:.3},housner\n", 0.2 + 0.02 * n as f64, 0.9 + 0.05 * n as f64);
    let rows = (0..10).map(row).collect::<String>();
    std::fs::write(folder.path().join("s.csv"), format!("name,width,height,eta\n{rows}")).unwrap();
    succeed(folder.path(), "sample-scenarios --mw 6.5,7 --re 5,10 --samples 30 --seed 5");
    succeed(folder.path(), "synthesize-motions --suite csgm --dt 0.01");
    succeed(folder.path(), "simulate --structures s.csv");
    let output = rockfrag(folder.path()).args(["universality", "--reference", "b4"]).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    for parameter in ["p", "alpha", "eta"] {
        let ranges = text.lines().filter(|line| line.starts_with(&format!("  {parameter} ")));
        let ranges = ranges.filter(|line| line.contains(" to ")).count();
        assert_eq!(ranges, 8, "{parameter}: {text}");
    }
    // Too few motions for the curves of the reference: the way out names those that have them, if any.
    succeed(folder.path(), "sample-scenarios --mw 6 --re 15 --samples 3 --out few.parquet");
    succeed(folder.path(), "synthesize-motions --suite csgm --dt 0.01 --in few.parquet --out f.parquet");
    succeed(folder.path(), "simulate --structures s.csv --in f.parquet --out r.parquet");
    let call = "universality --in r.parquet --out u.parquet --reference b4";
    fail(folder.path(), call, 1, &["too_few_events", "no structure has all curves"]);
}
