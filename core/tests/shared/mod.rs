//! What the groups of tests share: the answers and motions of other programs.
#![allow(dead_code, reason = "no group needs all")]

use std::path::{Path, PathBuf};

use parquet::file::reader::SerializedFileReader;
use parquet::record::{Field, RowAccessor};
use serde::de::DeserializeOwned;

pub fn reference(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference").join(name)
}

/// The rows of a CSV file of the references.
pub fn rows<T: DeserializeOwned>(name: &str) -> Vec<T> {
    csv::Reader::from_path(reference(name)).unwrap().into_deserialize().map(Result::unwrap).collect()
}

pub struct StoredMotion {
    pub motion_id: String,
    pub dt_s: f64,
    pub acceleration_m_s2: Vec<f64>,
}

/// All motions of a file whose first columns are name, time step and samples.
pub fn motions(path: &Path) -> Vec<StoredMotion> {
    let sample = |field: &Field| match field {
        Field::Float(value) => f64::from(*value),
        Field::Double(value) => *value,
        other => panic!("{other}; expected a sample"),
    };
    let rows = SerializedFileReader::try_from(path).unwrap().into_iter().map(Result::unwrap);
    let name = |field: &Field| match field {
        Field::Str(name) => name.clone(),
        number => number.to_string(),
    };
    let motion = |row: parquet::record::Row| StoredMotion {
        motion_id: name(row.get_column_iter().next().unwrap().1),
        dt_s: row.get_double(1).unwrap(),
        acceleration_m_s2: row.get_list(2).unwrap().elements().iter().map(sample).collect(),
    };
    rows.map(motion).collect()
}

/// The sixty synthetic motions of the references.
pub fn reference_motions() -> Vec<StoredMotion> {
    motions(&reference("rocking/motions.parquet"))
}

/// A file with records that the project does not include.
pub fn known(name: &str) -> PathBuf {
    Path::new(&std::env::var_os("ROCKFRAG_RECORDS").expect("ROCKFRAG_RECORDS names a folder")).join(name)
}
