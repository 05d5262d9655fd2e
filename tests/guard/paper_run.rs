//! The paper's whole run from `pipeline.yaml`.

use std::path::Path;

use assert_cmd::Command;

use crate::snapshot::check_each;
use crate::tables::fingerprints;

#[test]
#[ignore = "takes half a minute in release"]
fn paper_run_fingerprints() {
    let folder = tempfile::tempdir().unwrap();
    let pipeline = Path::new(env!("CARGO_MANIFEST_DIR")).join("pipeline.yaml");
    std::fs::copy(pipeline, folder.path().join("pipeline.yaml")).unwrap();
    Command::cargo_bin("rockfrag").unwrap().current_dir(folder.path()).arg("run").assert().success();
    let names = ["scenarios", "motions", "responses", "pex", "pex.scan", "pro", "paper"];
    check_each(
        "paper_run",
        names.map(|name| {
            let path = folder.path().join(format!("out/{name}.parquet"));
            (name.to_string(), fingerprints(&path))
        }),
    );
}
