//! A run that is killed or interrupted leaves no partial file at a final name, and the next run completes it.

use std::process::{Command, Stdio};
use std::time::Duration;

use crate::common::{SMALL_PIPELINE, content, small_pipeline, succeed};

#[test]
fn a_killed_run_is_simply_run_again() {
    let (folder, file) = small_pipeline();
    let text = SMALL_PIPELINE.replace("samples: 10", "samples: 40").replace("dt: 0.01", "dt: 0.005");
    std::fs::write(file, text).unwrap();
    succeed(folder.path(), "run --out undisturbed");
    for attempt in 0..20 {
        let mut run = Command::new(assert_cmd::cargo::cargo_bin("rockfrag"))
            .args(["run", "--quiet", "--force"])
            .current_dir(folder.path())
            .stdout(Stdio::null())
            .spawn()
            .unwrap();
        // Spread over what a run takes, so that each stage is hit.
        std::thread::sleep(Duration::from_millis(7 + attempt * 31));
        let signal = ["-KILL", "-INT", "-TERM"][attempt as usize % 3];
        // A run that has ended already has nothing to interrupt.
        let _ = Command::new("kill").args([signal, &run.id().to_string()]).stderr(Stdio::null()).status();
        run.wait().unwrap();
        for name in ["scenarios", "motions", "responses", "pex", "pro", "paper"] {
            let path = folder.path().join(format!("out/{name}.parquet"));
            assert!(
                !path.exists() || rockfrag::table::store::contents::recorded(&path).unwrap().is_some(),
                "{name}"
            );
        }
    }
    succeed(folder.path(), "run");
    for name in ["scenarios", "motions", "responses", "pex", "pro", "paper"] {
        let file = |out: &str| folder.path().join(out).join(format!("{name}.parquet"));
        assert_eq!(content(&file("out")), content(&file("undisturbed")), "{name}");
    }
    let force = succeed(folder.path(), "run --force");
    assert!(force.contains("motions"), "{force}");
    let strays = std::fs::read_dir(folder.path().join("out")).unwrap();
    let strays =
        strays.filter(|entry| entry.as_ref().unwrap().file_name().to_string_lossy().ends_with(".partial"));
    assert_eq!(strays.count(), 0, "strays are removed by the next run");
}
