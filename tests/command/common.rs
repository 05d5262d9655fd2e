//! What the tests of the command share.

use std::path::Path;
use std::process::Command;
use std::sync::Arc;

use arrow_array::types::Float64Type;
use arrow_array::{ArrayRef, Float64Array, Int64Array, ListArray, RecordBatch, StringArray};
use parquet::arrow::ArrowWriter;
use parquet::file::properties::WriterProperties;
use rockfrag::table::provenance::Provenance;
use serde_json::Value;

/// The hazard that is shipped, as an option.
pub const HAZARD: &str = concat!("--hazard ", env!("CARGO_MANIFEST_DIR"), "/data/hazard.csv");

pub const BLOCK: &str = "--width 0.5 --height 2.0";
pub const STRUCTURE: &str = "--p 2.5 --alpha 0.2 --eta 0.92";

/// The command, called in `folder`.
pub fn rockfrag(folder: &Path, arguments: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_rockfrag"));
    command.current_dir(folder).args(arguments.split_whitespace());
    command
}

/// Runs the command, which must succeed, and gives stdout and stderr.
#[track_caller]
pub fn succeed(folder: &Path, arguments: &str) -> (String, String) {
    let output = rockfrag(folder, arguments).output().unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{arguments}: {stderr}");
    (String::from_utf8(output.stdout).unwrap(), stderr)
}

/// Runs the command, which must fail with this exit code, name all of `named`, and not panic.
#[track_caller]
pub fn fail(folder: &Path, arguments: &str, code: i32, named: &[&str]) {
    let output = rockfrag(folder, arguments).output().unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(code), "{arguments}: {stderr}");
    // Nor do libraries give advice to programmers.
    for word in ["panicked", "DuplicateKeyPolicy", "from_str"] {
        assert!(!stderr.contains(word), "{arguments}: {stderr}");
    }
    for name in named {
        assert!(stderr.contains(name), "{arguments}: '{name}' is not in: {stderr}");
    }
}

/// The rows that a call of evaluate prints as JSON.
#[track_caller]
pub fn evaluated(folder: &Path, arguments: &str) -> Vec<Value> {
    let (printed, _) = succeed(folder, &format!("evaluate {arguments} --format json"));
    serde_json::from_str(&printed).unwrap()
}

/// A number of such a row.
#[track_caller]
pub fn number(row: &Value, column: &str) -> f64 {
    row[column].as_f64().unwrap_or_else(|| panic!("{column} of {row}"))
}

/// Whether two numbers are the same but for this share.
pub fn near(a: f64, b: f64, tolerance: f64) -> bool {
    (a / b - 1.0).abs() <= tolerance
}

/// A folder with these files.
pub fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    files.iter().for_each(|(name, text)| std::fs::write(folder.path().join(name), text).unwrap());
    folder
}

/// A small run: 12 scenarios, both suites, both structures of the paper.
pub const SMALL: &str = "\
seed: 7
out: out
sample-scenarios: { mw: \"6.5,7.5\", re: \"5,10\", samples: 10 }
synthesize-motions: { suite: [pulse, csgm], dt: 0.01 }
simulate:
  structure:
    - { name: frame, p: 1.0, alpha: 0.15, eta: 0.92 }
    - { name: electrical-equipment, p: 2.5, alpha: 0.20, eta: 0.92 }
fit-pex: {}
fit-pro: {}
compare-paper: {}
";

/// A folder where the small run is done.
pub fn small_run() -> tempfile::TempDir {
    let folder = folder_with(SMALL);
    succeed(folder.path(), "run");
    folder
}

/// The files of the small run.
pub const FILES: [&str; 6] = ["scenarios", "motions", "responses", "pex", "pro", "paper"];

pub fn folder_with(pipeline: &str) -> tempfile::TempDir {
    folder(&[("pipeline.yaml", pipeline)])
}

pub fn numbers(values: &[f64]) -> ArrayRef {
    Arc::new(Float64Array::from(values.to_vec()))
}

pub fn texts(values: &[&str]) -> ArrayRef {
    Arc::new(StringArray::from(values.to_vec()))
}

pub fn lists(rows: &[&[f64]]) -> ArrayRef {
    let row = |row: &&[f64]| Some(row.iter().map(|sample| Some(*sample)).collect::<Vec<_>>());
    Arc::new(ListArray::from_iter_primitive::<Float64Type, _, _>(rows.iter().map(row)))
}

/// A Parquet file as another program might write it.
pub fn write(path: &Path, columns: Vec<(&str, ArrayRef)>) {
    write_with(path, &RecordBatch::try_from_iter(columns).unwrap(), WriterProperties::default());
}

pub fn write_with(path: &Path, rows: &RecordBatch, properties: WriterProperties) {
    let file = std::fs::File::create(path).unwrap();
    let mut writer = ArrowWriter::try_new(file, rows.schema(), Some(properties)).unwrap();
    writer.write(rows).unwrap();
    writer.close().unwrap();
}

/// A motions file as another program might write it: number, time step and samples.
pub fn write_motions(path: &Path, dt_s: f64, motions: &[&[f64]]) {
    write(path, motions_of(Arc::new(Int64Array::from_iter_values(0..motions.len() as i64)), dt_s, motions));
}

pub fn motions_of(ids: ArrayRef, dt_s: f64, motions: &[&[f64]]) -> Vec<(&'static str, ArrayRef)> {
    let dt = numbers(&vec![dt_s; motions.len()]);
    vec![("motion_id", ids), ("dt_s", dt), ("acceleration_m_s2", lists(motions))]
}

/// The rows of a table as CSV.
pub fn rows(folder: &Path, table: &str) -> String {
    succeed(folder, &format!("inspect --head 100000 --format csv {table}")).0
}

/// The rows of a table, each as an object.
pub fn objects(folder: &Path, table: &str) -> Vec<Value> {
    let (printed, _) = succeed(folder, &format!("inspect --head 100000 --format json {table}"));
    serde_json::from_str(&printed).unwrap()
}

/// The stages that a run has run, by its lines on stderr.
pub fn ran(stderr: &str) -> Vec<&str> {
    let lines = stderr.lines().filter(|line| line.ends_with(" s"));
    lines.filter_map(|line| line.split_whitespace().next()).collect()
}

pub fn made(path: &Path) -> Provenance {
    Provenance::read(path).unwrap().unwrap()
}

pub fn bytes(path: &Path) -> Vec<u8> {
    std::fs::read(path).unwrap()
}
