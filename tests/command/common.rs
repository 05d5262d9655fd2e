//! What the tests of the command share.

use std::cell::Cell;
use std::path::{Path, PathBuf};

use arrow_array::{ArrayRef, RecordBatch};
use assert_cmd::Command;
use parquet::arrow::ArrowWriter;

use crate::snapshot::{check_each, redact};

/// The command, called in `folder`.
pub fn rockfrag(folder: &Path) -> Command {
    let mut command = Command::cargo_bin("rockfrag").unwrap();
    command.current_dir(folder);
    command
}

/// Runs the command and gives its stderr.
#[track_caller]
pub fn succeed(folder: &Path, arguments: &str) -> String {
    let output = rockfrag(folder).args(arguments.split_whitespace()).output().unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{arguments}: {stderr}");
    stderr
}

thread_local! {
    /// How many messages this test has kept; each test runs in a thread of its own.
    static KEPT: Cell<usize> = const { Cell::new(0) };
}

/// Compares a message with the snapshot of its place in the test, in tests/guard/snapshots/message.
fn keep(folder: &Path, arguments: &str, stderr: &str) {
    let place = KEPT.replace(KEPT.get() + 1) + 1;
    let test = std::thread::current().name().unwrap().replace("::", ".");
    let text = format!("$ rockfrag {arguments}\n{stderr}");
    let text = text
        .replace(env!("CARGO_TARGET_TMPDIR"), "[target]")
        .replace(&folder.display().to_string(), "[folder]");
    check_each("message", [(format!("{test}.{place:02}"), redact(&text))]);
}

/// Runs the command, which must fail with this exit code and one line that says all of `expected`.
#[track_caller]
pub fn fail(folder: &Path, arguments: &str, code: i32, expected: &[&str]) {
    let output = rockfrag(folder).args(arguments.split_whitespace()).output().unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(code), "{arguments}: {stderr}");
    assert!(!stderr.contains("panicked"), "{stderr}");
    for part in expected {
        assert!(stderr.contains(part), "'{part}' is not in: {stderr}");
    }
    keep(folder, arguments, &stderr);
}

/// A folder with a small pipeline file: 12 scenarios, both suites, both structures of the paper.
pub fn small_pipeline() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("pipeline.yaml");
    std::fs::write(&file, SMALL_PIPELINE).unwrap();
    (folder, file)
}

pub const SMALL_PIPELINE: &str = "\
seed: 7
out: out
sample-scenarios: { mw: \"6.5,7.5\", re: \"5,10\", samples: 10 }
synthesize-motions: { suite: [pulse, csgm], dt: 0.01 }
simulate:
  structures:
    - { name: frame, p: 1.0, alpha: 0.15, eta: 0.92 }
    - { name: electrical-equipment, p: 2.5, alpha: 0.20, eta: 0.92 }
fit-pex: {}
fit-pro: {}
compare-paper: {}
";

/// A Parquet file as another program might write it.
pub fn write(path: &Path, columns: Vec<(&str, ArrayRef)>) {
    let batch = RecordBatch::try_from_iter(columns).unwrap();
    let mut writer =
        ArrowWriter::try_new(std::fs::File::create(path).unwrap(), batch.schema(), None).unwrap();
    writer.write(&batch).unwrap();
    writer.close().unwrap();
}

/// The content fingerprint of a file.
pub fn content(path: &Path) -> String {
    rockfrag::table::store::contents::recorded(path).unwrap().unwrap().content
}
