//! What one sees at a terminal: words, lists, traces.

use std::path::Path;

use rockfrag::table::responses::TraceRow;
use rockfrag::table::rows;

use crate::common::{fail, succeed, write_motions};

fn trace(folder: &Path) -> Vec<TraceRow> {
    rows::read(&folder.join("responses.trace.parquet")).unwrap()
}

#[test]
fn a_trace_has_what_a_picture_needs() {
    let folder = tempfile::tempdir().unwrap();
    let (dt, omega) = (0.01, 6.0);
    let sine: Vec<f64> = (0..300).map(|k| 5.0 * (omega * dt * f64::from(k)).sin()).collect();
    write_motions(&folder.path().join("motions.parquet"), dt, &[&sine, &[0.1; 50]]);
    succeed(folder.path(), "simulate --width 0.5 --height 2 --trace 0");
    let one = trace(folder.path());
    assert!(one.iter().all(|row| row.motion_id == "0"));
    for row in one.iter().filter(|row| row.time_s < 2.99) {
        let (acceleration, velocity) = (
            5.0 * (omega * row.time_s).sin(),
            5.0 / omega * (1.0 - (omega * row.time_s).cos()),
        );
        assert!((row.ground_acceleration_m_s2 - acceleration).abs() < 3e-3, "{row:?}");
        assert!((row.ground_velocity_m_s - velocity).abs() < 1e-3, "{row:?}");
        assert!((row.block_width_m - 0.5).abs() < 1e-12 && (row.block_height_m - 2.0).abs() < 1e-12);
    }
    succeed(folder.path(), "simulate --width 0.5 --height 2 --trace all");
    let all = trace(folder.path());
    assert_eq!(all[..one.len()], one);
    assert!(all[one.len()..].iter().all(|row| row.motion_id == "1" && row.theta_rad == 0.0));
}

#[test]
fn a_motion_that_cannot_be_traced_is_told_before_anything_is_simulated() {
    let folder = tempfile::tempdir().unwrap();
    write_motions(&folder.path().join("motions.parquet"), 0.01, &[&[0.1, f64::NAN, 0.1]]);
    let simulate = "simulate --width 0.5 --height 2";
    fail(folder.path(), &format!("{simulate} --trace 7"), 1, &["motions.parquet", "no motion '7' to trace"]);
    fail(folder.path(), &format!("{simulate} --trace 0"), 1, &["NaN"]);
}

const STAGES: [&str; 14] = [
    "sample-scenarios", "synthesize-motions", "import-motions", "floor-motions", "simulate", "ida", "fit-pex",
    "fit-pro", "compare-paper", "rank-ims", "evaluate", "export", "validate", "report",
];

/// The names of the options that a help lists.
fn options(help: &str) -> Vec<&str> {
    let listed = help.lines().map(str::trim_start).filter(|line| line.starts_with('-'));
    listed.filter_map(|line| line.split([' ', ',']).find(|word| word.starts_with("--"))).collect()
}

#[test]
fn short_help_has_the_options_of_its_examples_and_long_help_all() {
    let folder = tempfile::tempdir().unwrap();
    for stage in STAGES {
        let short = succeed(folder.path(), &format!("{stage} -h")).0;
        let long = succeed(folder.path(), &format!("{stage} --help")).0;
        let (few, all) = (options(&short), options(&long));
        assert!(few.len() <= 11 && few.len() < all.len(), "{stage}: {few:?}");
        assert!(few.iter().all(|option| all.contains(option)), "{stage}");
        assert!(all.contains(&"--threads") && !few.contains(&"--threads"), "{stage}");
        let examples: Vec<&str> = short.lines().filter(|line| line.starts_with("rockfrag ")).collect();
        assert!(!examples.is_empty(), "{stage}");
        for word in examples.iter().flat_map(|line| line.split(' ')).filter(|word| word.starts_with("--")) {
            assert!(few.contains(&word), "{stage}: {word} of an example is not an option");
        }
    }
}
