//! What is kept and what is made anew: a result is kept as long as the answer would be the same, wherever it
//! and what it was read from have gone.

use std::fs;
use std::path::Path;

use crate::common::{BLOCK, SMALL, fail, folder, folder_with, objects, ran, rows, small_run, succeed};

/// Whether a command found its result up to date.
#[track_caller]
fn is_kept(folder: &Path, call: &str) -> bool {
    succeed(folder, call).1.contains("up to date")
}

/// A record in g, every 0.01 s.
fn record(peak_g: f64) -> String {
    let sample = |k: i32| peak_g * (0.2 * f64::from(k)).sin() * (-0.01 * f64::from(k)).exp();
    let lines: String = (0..400).map(|k| format!("{},{}\n", f64::from(k) * 0.01, sample(k))).collect();
    format!("time (s),acceleration (g)\n{lines}")
}

fn ids(folder: &Path, table: &str) -> Vec<String> {
    let rows = rows(folder, table);
    rows.lines().skip(1).map(|row| row.split(',').next().unwrap_or_default().to_string()).collect()
}

const IMPORT: &str = "import-motions --accept-implausible --pulses skip";

#[test]
fn records_are_known_by_name_and_content() {
    let folder = folder(&[("r.csv", &record(0.3))]);
    let path = |name: &str| folder.path().join(name);
    succeed(folder.path(), &format!("{IMPORT} r.csv --scale 0.1:0.3:0.1 --out s.parquet"));
    let steps = ids(folder.path(), "s.parquet");
    assert!(steps.iter().all(|id| id.len() < 10), "steps have the digits that were given: {steps:?}");
    succeed(folder.path(), &format!("{IMPORT} r.csv --out m.parquet"));
    fs::rename(path("r.csv"), path("q.csv")).unwrap();
    assert!(!is_kept(folder.path(), &format!("{IMPORT} q.csv --out m.parquet")), "renamed");
    assert_eq!(ids(folder.path(), "m.parquet"), ["q"]);
    fs::write(path("q.csv"), record(0.3)).unwrap();
    assert!(is_kept(folder.path(), &format!("{IMPORT} q.csv --out m.parquet --threads 1")), "touched");
    let elsewhere = format!("{IMPORT} {} --out m.parquet", path("q.csv").display());
    assert!(is_kept(folder.path(), &elsewhere), "the path is written in another way");
    fs::write(path("q.csv"), record(0.2)).unwrap();
    assert!(!is_kept(folder.path(), &format!("{IMPORT} q.csv --out m.parquet")), "another content");
}

#[test]
fn all_records_of_a_folder_are_read_and_nothing_that_was_written_there() {
    let folder = folder(&[]);
    let path = |name: &str| folder.path().join("records").join(name);
    fs::create_dir_all(path("b")).unwrap();
    fs::write(path("a.csv"), record(0.3)).unwrap();
    fs::write(path("b/a.csv"), record(0.2)).unwrap();
    // Links in circles and pipes are no records.
    let _ = ["x", "y"].map(|link| std::os::unix::fs::symlink(".", path(link)).unwrap());
    assert!(std::process::Command::new("mkfifo").arg(path("fifo")).status().unwrap().success());
    let call = format!("{IMPORT} records --out records/m.parquet --keep-going");
    succeed(folder.path(), &call);
    assert_eq!(ids(folder.path(), "records/m.parquet"), ["a.csv", "b/a.csv"]);
    assert!(is_kept(folder.path(), &call), "its own table is no record");
    fs::write(path("flat.parquet"), "no table").unwrap();
    succeed(folder.path(), &call);
    fs::write(path("a.csv"), record(0.1)).unwrap();
    assert!(!is_kept(folder.path(), &call), "a record beside a table was changed");
    let moved = folder.path().join("moved");
    fs::rename(folder.path().join("records"), &moved).unwrap();
    assert!(is_kept(&moved, &format!("{IMPORT} . --out m.parquet --keep-going")), "moved");
}

#[test]
fn a_run_is_kept_where_it_goes_and_made_anew_where_a_file_is_missing() {
    let folder = folder_with(&format!("{SMALL}report: {{}}\n"));
    succeed(folder.path(), "run");
    let moved = folder.path().join("moved");
    fs::create_dir(&moved).unwrap();
    for name in ["pipeline.yaml", "out"] {
        fs::rename(folder.path().join(name), moved.join(name)).unwrap();
    }
    assert_eq!(ran(&succeed(&moved, "run --threads 1").1), ["report"], "moved");
    assert_eq!(ran(&succeed(folder.path(), "run moved/pipeline.yaml").1), ["report"], "from another folder");
    fs::remove_file(moved.join("out/motions.parquet")).unwrap();
    let (plan, _) = succeed(&moved, "run --dry-run");
    assert_eq!(plan.matches(": run").count(), 2, "what is made again is the same: {plan}");
    assert_eq!(ran(&succeed(&moved, "run").1), ["synthesize-motions", "report"]);
    // The parts of a stage are told apart.
    let (main, part) = (moved.join("out/pro.parquet"), moved.join("out/pro.parameters.parquet"));
    let fit = "fit-pro --in out/responses.parquet --out out/pro.parquet";
    fs::copy(&part, &main).unwrap();
    assert!(!is_kept(&moved, fit), "swapped");
    fs::remove_file(&part).unwrap();
    assert!(!is_kept(&moved, fit), "a part is missing");
}

#[test]
fn what_is_read_beside_the_fits_is_what_is_needed() {
    let folder = small_run();
    let there = |name: &str| folder.path().join("alone").join(name);
    fs::create_dir(folder.path().join("alone")).unwrap();
    let out = |name: &str| folder.path().join("out").join(name);
    let _ = ["pex.parquet", "pro.parquet"].map(|name| fs::copy(out(name), there(name)).unwrap());
    // Fits say what they were made of, whether or not it is still there.
    let call = "compare-paper --pex alone/pex.parquet --pro alone/pro.parquet --out alone/paper.parquet";
    let printed = succeed(folder.path(), call).0;
    let named = ["sample-scenarios --samples 10, not 100", "synthesize-motions --dt 0.01, not 0.005"];
    assert!(named.iter().all(|named| printed.contains(named)), "{printed}");
    assert!(!printed.contains("standard deviations from the seeds"), "fewer scenarios spread more");
    // Fits that the model does not read need not be there.
    let _ = ["pro.parquet", "pex.parquet"].map(|name| fs::remove_file(out(name)).unwrap());
    let call = "evaluate --fits out --suite csgm --name frame --pga 0.4 --pgv 0.5";
    succeed(folder.path(), call);
    fail(folder.path(), &format!("{call} --model paper"), 1, &["pro.parquet"]);
}

#[test]
fn the_word_paper_is_no_folder_and_a_path_may_be_written_in_two_ways() {
    let yaml = "out: paper\nsample-scenarios: &a { mw: &m 7, re: *m, samples: 3 }\nsynthesize-motions: {}\n\
        simulate: { structures: paper, in: ../w/paper/motions.parquet }\n";
    let folder = folder(&[]);
    let work = folder.path().join("w");
    fs::create_dir(&work).unwrap();
    fs::write(work.join("pipeline.yaml"), yaml).unwrap();
    succeed(&work, "run");
    let (plan, _) = succeed(&work, "run --dry-run");
    succeed(&work, "run --check");
    assert!(!plan.contains(": run"), "{plan}");
    let (plan, _) = succeed(folder.path(), "run w/pipeline.yaml --seed 5 --dry-run");
    assert!(plan.contains("simulate: run"), "{plan}");
}

#[test]
fn an_option_stated_at_its_default_changes_nothing() {
    let folder = folder(&[]);
    let call = format!("evaluate {BLOCK} --pga 0.4 --pgv 0.5 --period 0.5 --level 0.5 --out e.parquet");
    for stated in ["--period-sd 0.25", "--centre-offset 0", "--centre-height-sd 0"] {
        succeed(folder.path(), &format!("{call} --force"));
        let plain = fs::read(folder.path().join("e.parquet")).unwrap();
        assert!(is_kept(folder.path(), &format!("{call} {stated}")), "{stated}");
        succeed(folder.path(), &format!("{call} {stated} --force"));
        assert_eq!(fs::read(folder.path().join("e.parquet")).unwrap(), plain, "{stated}");
    }
    assert!(!is_kept(folder.path(), &format!("{call} --period-sd 0.26")));
}

#[test]
fn partitions_of_different_runs_are_no_table() {
    let folder = small_run();
    let call = |part: &str, more: &str| {
        format!("synthesize-motions --in out/scenarios.parquet --out parts --partition {part} {more}")
    };
    succeed(folder.path(), &call("0/2", "--seed 1"));
    succeed(folder.path(), &call("1/2", "--seed 2"));
    let simulate = |more: &str| format!("simulate --in parts --out responses {BLOCK} {more}");
    fail(folder.path(), &simulate(""), 1, &["parts", "part-00001.parquet"]);
    // Responses to parts of different motions, each by itself.
    succeed(folder.path(), &simulate("--partition 0/2"));
    succeed(folder.path(), &simulate("--partition 1/2"));
    fail(folder.path(), "fit-pro --in responses --out f.parquet", 1, &["responses", "part-00001.parquet"]);
    succeed(folder.path(), &call("1/2", "--seed 1"));
    succeed(folder.path(), &simulate("--partition 1/2"));
    succeed(folder.path(), "fit-pro --in responses --out f.parquet");
    fs::copy(folder.path().join("out/pex.parquet"), folder.path().join("responses/z.parquet")).unwrap();
    fail(folder.path(), "fit-pro --in responses --out f.parquet", 1, &["responses", "z.parquet"]);
}

#[test]
fn paths_of_a_pipeline_are_relative_to_its_file() {
    let other = "pgv_m_s,annual_rate\n0.1,0.9\n1.0,0.5\n5,0.2\n";
    let folder = folder(&[("second.csv", other), ("h.csv", "no hazard\n")]);
    let sub = folder.path().join("sub");
    fs::create_dir_all(sub.join("fits")).unwrap();
    fs::write(sub.join("h.csv"), "pga_g,annual_rate\n0.1,0.01\n0.3,0.001\n1.0,0.00005\n").unwrap();
    fs::write(sub.join("second.csv"), "pgv_m_s,annual_rate\n0.1,0.01\n0.3,0.001\n1.0,0.00005\n").unwrap();
    let run = |yaml: &str| {
        fs::write(sub.join("pipeline.yaml"), yaml).unwrap();
        succeed(folder.path(), "run sub/pipeline.yaml");
    };
    let rate = |hazard: &str| {
        let out = "out/evaluated.parquet";
        run(&format!("evaluate: {{ width: 0.5, height: 2, hazard: {hazard}, out: {out} }}\n"));
        rows(folder.path(), "sub/out/evaluated.parquet")
    };
    let as_text = rate("\"h.csv,second.csv\"");
    assert_eq!(rate("[h.csv, second.csv]"), as_text);
    assert_ne!(rate("h.csv"), as_text, "the second curve matters");
    fs::rename(sub.join("second.csv"), sub.join("a,b.csv")).unwrap();
    assert_eq!(rate("[h.csv, \"a,b.csv\"]"), as_text, "a name may have a comma");
    let direct = |hazard: &str| succeed(&sub, &format!("evaluate {BLOCK} {hazard} --format csv")).0;
    assert_eq!(direct("--hazard h.csv --hazard a,b.csv"), direct("--hazard a,b.csv --hazard h.csv"));
    run("sample-scenarios: { mw: \"7\", re: \"5\", samples: 2, out: s.parquet }\n\
         synthesize-motions: { in: s.parquet }\n\
         export: { to: openquake, width: 0.5, height: 2 }\n");
    assert!(sub.join("s.parquet").exists() && sub.join("out/fragility.xml").exists());
    assert!(!folder.path().join("s.parquet").exists() && !folder.path().join("fragility.xml").exists());
    let fits = "export: { to: openquake, width: 0.5, height: 2, fits: fits }\n";
    fs::write(sub.join("pipeline.yaml"), fits).unwrap();
    fail(folder.path(), "run sub/pipeline.yaml", 1, &["sub/fits"]);
}

#[test]
fn names_of_a_pipeline_are_texts() {
    let names = ["007", "1e3", "yes", "\"~\"", "\"rack,height=2\""];
    let structures = names.map(|name| format!("{{ name: {name}, width: 0.6, height: 1.9 }}")).join(", ");
    let folder = folder_with(&format!(
        "evaluate: {{ pga: 0.4, pgv: 0.5, out: out/evaluated.parquet, structure: [{structures}] }}\n"
    ));
    succeed(folder.path(), "run");
    let found = objects(folder.path(), "out/evaluated.parquet");
    let mut found: Vec<&str> = found.iter().map(|row| row["structure"].as_str().unwrap()).collect();
    found.sort_unstable();
    assert_eq!(found, ["007", "1e3", "rack,height=2", "yes", "~"]);
}
