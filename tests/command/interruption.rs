//! A run that is killed, or has company, leaves whole files only.

use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use rockfrag::table::provenance::Provenance;

use crate::common::{FILES, SMALL, bytes, folder_with, rockfrag, succeed};

fn start(folder: &Path, arguments: &str) -> Child {
    rockfrag(folder, arguments).stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
}

#[test]
fn a_killed_run_is_simply_run_again() {
    let folder = folder_with(&SMALL.replace("samples: 10", "samples: 40").replace("dt: 0.01", "dt: 0.005"));
    succeed(folder.path(), "run --out undisturbed");
    for attempt in 0..20 {
        let mut run = start(folder.path(), "run --quiet --force");
        // Spread over what a run takes, so that each stage is hit.
        std::thread::sleep(Duration::from_millis(7 + attempt * 31));
        let signal = ["-KILL", "-INT", "-TERM"][attempt as usize % 3];
        // A run that has ended already has nothing to interrupt.
        let _ = Command::new("kill").args([signal, &run.id().to_string()]).stderr(Stdio::null()).status();
        run.wait().unwrap();
        for name in FILES {
            let path = folder.path().join(format!("out/{name}.parquet"));
            assert!(!path.exists() || Provenance::read(&path).unwrap().is_some(), "{name}");
        }
    }
    succeed(folder.path(), "run");
    for name in FILES {
        let file = |out: &str| bytes(&folder.path().join(out).join(format!("{name}.parquet")));
        assert!(file("out") == file("undisturbed"), "{name}");
    }
}

#[test]
fn two_runs_in_one_folder_leave_whole_files_of_one_or_the_other() {
    let folder = folder_with(SMALL);
    for seed in [7, 8] {
        succeed(folder.path(), &format!("run --seed {seed} --out alone{seed}"));
    }
    for _ in 0..5 {
        for run in [7, 8].map(|seed| start(folder.path(), &format!("run --force --seed {seed}"))) {
            // A run whose input was replaced meanwhile says so and fails.
            run.wait_with_output().unwrap();
        }
        for name in FILES {
            let path = |out: &str| folder.path().join(out).join(format!("{name}.parquet"));
            if path("out").exists() {
                let both = [bytes(&path("alone7")), bytes(&path("alone8"))];
                assert!(both.contains(&bytes(&path("out"))), "{name}");
            }
        }
    }
}
