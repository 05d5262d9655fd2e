//! Two runs in one folder, and inputs that change under a run.

use std::path::Path;
use std::process::{Child, Command, Stdio};

use rockfrag::pipeline::console::Console;
use rockfrag::pipeline::stage::Stage;
use rockfrag::stages::shared::structures::Structures;
use rockfrag::stages::simulate::{Simulate, SimulateOptions};

use crate::common::{small_pipeline, succeed};

fn run_with_seed(folder: &Path, seed: &str) -> Child {
    Command::new(assert_cmd::cargo::cargo_bin("rockfrag"))
        .args(["run", "--force", "--seed", seed])
        .current_dir(folder)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

#[test]
fn of_two_runs_in_one_folder_one_waits() {
    let (folder, _) = small_pipeline();
    for _ in 0..3 {
        let runs = ["7", "8"].map(|seed| run_with_seed(folder.path(), seed));
        let words = runs.map(|run| {
            let output = run.wait_with_output().unwrap();
            let words = String::from_utf8(output.stderr).unwrap();
            assert!(output.status.success(), "{words}");
            words
        });
        assert!(words.concat().contains("waiting for another run"), "{words:?}");
        let plans = ["7", "8"].map(|seed| {
            let plan = Command::new(assert_cmd::cargo::cargo_bin("rockfrag"))
                .args(["run", "--dry-run", "--seed", seed])
                .current_dir(folder.path())
                .output()
                .unwrap();
            String::from_utf8(plan.stdout).unwrap().matches("up to date").count()
        });
        assert!(plans.contains(&6), "all files are of one run, or the other: {plans:?}");
    }
}

#[test]
fn rows_of_one_file_do_not_say_that_they_come_from_another() {
    let (folder, _) = small_pipeline();
    succeed(folder.path(), "run --out one");
    succeed(folder.path(), "run --out other --seed 99");
    let motions = |out: &str| folder.path().join(out).join("motions.parquet");
    let out = folder.path().join("responses.parquet");
    let mut options = SimulateOptions::default();
    options.structure.structures = Some(Structures::Paper);
    let stage = Simulate::new(&options, motions("one"), out.clone()).unwrap();
    let planned = stage.provenance().unwrap();
    std::fs::copy(motions("other"), motions("one")).unwrap();
    let console = Console { quiet: true, ..Console::default() };
    let words = format!("{:#}", stage.execute(&planned, &console).unwrap_err());
    assert!(words.contains("motions.parquet") && words.contains("changed"), "{words}");
    assert!(!out.exists());
}
