//! What the groups of tests share: the answers and motions of other programs.
#![allow(dead_code, reason = "no group needs all")]

use std::path::{Path, PathBuf};

use rockfrag::table::motions::{Motion, is_of_motion, open, parts};
use serde::de::DeserializeOwned;

pub fn reference(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference").join(name)
}

/// The rows of a CSV file of the references.
pub fn rows<T: DeserializeOwned>(name: &str) -> Vec<T> {
    csv::Reader::from_path(reference(name)).unwrap().into_deserialize().map(Result::unwrap).collect()
}

/// All motions of a file.
pub fn motions(path: &Path) -> Vec<Motion> {
    let table = open(path, None).unwrap();
    let read = parts(&table, is_of_motion, 64).flat_map(|part| part().unwrap());
    read.flat_map(|some| some.motions).collect()
}

/// The sixty synthetic motions of the references.
pub fn reference_motions() -> Vec<Motion> {
    motions(&reference("rocking/motions.parquet"))
}

/// A file with records that the project does not include.
pub fn known(name: &str) -> PathBuf {
    Path::new(&std::env::var_os("ROCKFRAG_RECORDS").expect("ROCKFRAG_RECORDS names a folder")).join(name)
}
