//! The pipeline as a user runs it: what runs, what is skipped, and that results depend on nothing else.

use std::path::Path;

use crate::common::{SMALL_PIPELINE, content, rockfrag, small_pipeline, succeed};

const FILES: [&str; 5] = ["scenarios", "motions", "responses", "pex", "pro"];

fn contents(folder: &Path) -> Vec<String> {
    FILES.iter().map(|name| content(&folder.join(format!("{name}.parquet")))).collect()
}

#[test]
fn a_second_run_does_nothing_and_says_so() {
    let (folder, _) = small_pipeline();
    let first = succeed(folder.path(), "run");
    assert!(first.contains("40 scenarios"), "{first}");
    let second = succeed(folder.path(), "run");
    assert_eq!(second.matches("up to date").count(), 6, "{second}");
    let forced = succeed(folder.path(), "run --force");
    assert!(!forced.contains("up to date"), "{forced}");
}

#[test]
fn a_changed_parameter_runs_its_stage_and_what_follows() {
    let (folder, file) = small_pipeline();
    succeed(folder.path(), "run");
    std::fs::write(&file, SMALL_PIPELINE.replace("p: 1.0", "p: 1.1")).unwrap();
    let plan = rockfrag(folder.path()).args(["run", "--dry-run"]).output().unwrap();
    let plan = String::from_utf8(plan.stdout).unwrap();
    assert!(plan.contains("simulate             would run: structures changed"), "{plan}");
    assert!(plan.contains("fit-pex              would run: the responses will be made again"), "{plan}");
    let again = succeed(folder.path(), "run");
    assert_eq!(again.matches("up to date").count(), 2, "{again}");
    std::fs::write(
        &file,
        SMALL_PIPELINE.replace("p: 1.0", "p: 1.1").replace("fit-pex: {}", "fit-pex: { limit-state: 0.2 }"),
    )
    .unwrap();
    let again = succeed(folder.path(), "run");
    assert_eq!(again.matches("up to date").count(), 4, "{again}");
}

#[test]
fn rows_do_not_depend_on_threads_or_row_groups() {
    let (folder, _) = small_pipeline();
    succeed(folder.path(), "run --out one --threads 1");
    succeed(folder.path(), "run --out two --threads 2");
    assert_eq!(contents(&folder.path().join("one")), contents(&folder.path().join("two")));
    let same_bytes = |name: &str| {
        let read =
            |out: &str| std::fs::read(folder.path().join(out).join(format!("{name}.parquet"))).unwrap();
        read("one") == read("two")
    };
    assert!(FILES.iter().all(|name| same_bytes(name)), "the files are the same to the byte");
    succeed(
        folder.path(),
        "synthesize-motions --config pipeline.yaml --in one/scenarios.parquet --out three.parquet --row-group 3",
    );
    assert_eq!(
        content(&folder.path().join("three.parquet")),
        content(&folder.path().join("one/motions.parquet"))
    );
}

#[test]
fn a_bootstrap_is_the_same_on_any_number_of_threads() {
    let (folder, _) = small_pipeline();
    succeed(folder.path(), "run");
    for threads in [1, 2] {
        for fit in ["fit-pex", "fit-pro"] {
            let out = format!("{fit}.{threads}.parquet");
            let call =
                format!("{fit} --in out/responses.parquet --out {out} --bootstrap 30 --threads {threads}");
            succeed(folder.path(), &call);
        }
    }
    for name in ["fit-pex.N", "fit-pex.N.bootstrap", "fit-pro.N", "fit-pro.N.bootstrap"] {
        let read = |threads: &str| {
            std::fs::read(folder.path().join(format!("{}.parquet", name.replace('N', threads)))).unwrap()
        };
        assert!(read("1") == read("2"), "{name} is the same to the byte");
    }
    let text = rockfrag(folder.path()).args(["inspect", "fit-pex.1.bootstrap.parquet"]).output().unwrap();
    let text = String::from_utf8(text.stdout).unwrap();
    assert!(text.contains("bootstrap: 30") && text.contains("seed: 42"), "{text}");
}

#[test]
fn a_scenario_and_its_motion_are_the_same_alone_and_among_others() {
    let folder = tempfile::tempdir().unwrap();
    let make = |cells: &str, out: &str| {
        succeed(folder.path(), &format!("sample-scenarios --samples 4 {cells} --out {out}.s.parquet"));
        succeed(
            folder.path(),
            &format!("synthesize-motions --dt 0.02 --in {out}.s.parquet --out {out}.parquet"),
        );
        let motions =
            rockfrag::table::motions::MotionBatches::open(folder.path().join(format!("{out}.parquet")), 64);
        motions.unwrap().flat_map(Result::unwrap).collect::<Vec<_>>()
    };
    // The cells of one magnitude come first, so a shorter list of magnitudes is a prefix.
    let (few, many) = (make("--mw 6 --re 5,10", "few"), make("--mw 6,7 --re 5,10", "many"));
    assert_eq!((few.len(), many.len()), (16, 32));
    assert_eq!(few[..], many[..16]);
}

#[test]
fn flags_win_over_the_file_and_the_file_over_defaults() {
    let (folder, _) = small_pipeline();
    succeed(folder.path(), "sample-scenarios --config pipeline.yaml --out a.parquet");
    succeed(folder.path(), "sample-scenarios --config pipeline.yaml --samples 3 --out b.parquet");
    succeed(folder.path(), "sample-scenarios --samples 2 --out c.parquet");
    let parameters = |name: &str| {
        let stamp = rockfrag::table::store::contents::recorded(&folder.path().join(name)).unwrap().unwrap();
        let get = |key: &str| stamp.provenance.parameters[key].clone();
        (get("samples"), get("seed"), get("mw").as_array().unwrap().len())
    };
    assert_eq!(parameters("a.parquet"), (10.into(), 7.into(), 2));
    assert_eq!(parameters("b.parquet"), (3.into(), 7.into(), 2));
    assert_eq!(parameters("c.parquet"), (2.into(), 42.into(), 5));
}

#[test]
fn a_traced_motion_shows_its_events() {
    let (folder, _) = small_pipeline();
    succeed(folder.path(), "run");
    succeed(
        folder.path(),
        "simulate --in out/motions.parquet --out r.parquet --p 1 --alpha 0.15 --eta 0.92 --trace 0,1",
    );
    let text = rockfrag(folder.path()).args(["inspect", "r.trace.parquet"]).output().unwrap();
    let text = String::from_utf8(text.stdout).unwrap();
    assert!(text.contains("theta_over_alpha") && text.contains("made by simulate"), "{text}");
}

#[test]
fn structures_come_from_yaml_and_csv() {
    let (folder, _) = small_pipeline();
    succeed(folder.path(), "run");
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("s.csv", "name,p,alpha,eta\nslender,2.5,0.1,0.92\nstocky,2.5,0.3,0.9\n");
    write(
        "s.yaml",
        "- { name: block, width: 0.5, height: 2.0 }\n- { name: bent, width: 1, height: 6, beam-mass-ratio: 3 }\n",
    );
    for file in ["s.csv", "s.yaml"] {
        let told = succeed(
            folder.path(),
            &format!("simulate --in out/motions.parquet --out r.parquet --structures {file}"),
        );
        assert!(told.contains("160 responses of 2 structure(s)"), "{told}");
    }
}

#[test]
fn uplift_has_curves_of_its_own() {
    let (folder, _) = small_pipeline();
    succeed(folder.path(), "run");
    let told = succeed(folder.path(), "fit-pro --in out/responses.parquet --event rocking --out pnr.parquet");
    // PGA decides uplift, so its curve is separated and says so.
    assert!(told.contains("no curve of rocking") && told.contains("im4"), "{told}");
}

#[test]
fn warnings_of_many_structures_are_told_together() {
    let (folder, _) = small_pipeline();
    succeed(folder.path(), "run");
    let row = |k: u32| format!("s{k},{},0.2,0.92\n", 1.0 + 0.1 * f64::from(k));
    let structures: String = (0..12).map(row).collect();
    std::fs::write(folder.path().join("s.csv"), format!("name,p,alpha,eta\n{structures}")).unwrap();
    succeed(folder.path(), "simulate --in out/motions.parquet --structures s.csv --out many.parquet");
    for stage in ["fit-pex", "fit-pro"] {
        let told = succeed(folder.path(), &format!("{stage} --in many.parquet --out {stage}.parquet"));
        let lines = told.lines().filter(|line| line.starts_with("warning:")).count();
        assert!(lines < 30 && told.contains("suites and structures"), "{stage}: {lines} lines\n{told}");
        assert!(told.contains("; and "), "{told}");
    }
}

#[test]
fn warnings_of_files_that_are_up_to_date_are_told_again() {
    let (folder, file) = small_pipeline();
    // Another limit state is not the paper's, of which warnings are expected.
    std::fs::write(&file, SMALL_PIPELINE.replace("fit-pex: {}", "fit-pex: { limit-state: 0.2 }")).unwrap();
    let first = succeed(folder.path(), "run");
    let of_pro = |told: &str| -> Vec<String> {
        told.lines().filter(|line| line.starts_with("warning: ")).map(str::to_string).collect()
    };
    let all = of_pro(&first);
    assert!(all.len() > 4, "{first}");
    let again = succeed(folder.path(), "run");
    assert!(again.contains(" warnings as before: rockfrag inspect out/pro.parquet"), "{again}");
    assert!(again.lines().count() <= first.lines().count(), "{again}");
    let alone = succeed(folder.path(), "fit-pro --in out/responses.parquet --config pipeline.yaml");
    assert!(alone.contains("up to date"), "{alone}");
    let told = of_pro(&alone);
    assert!(!told.is_empty() && told.iter().all(|warning| all.contains(warning)), "{alone}");
}
