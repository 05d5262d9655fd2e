//! What the groups of tests share: the answers and motions of other programs.
#![allow(dead_code, reason = "no group needs all")]

use std::collections::HashMap;
use std::f64::consts::PI;
use std::fmt::Debug;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use parquet::file::reader::SerializedFileReader;
use parquet::record::{Field, RowAccessor};
use rand::RngExt;
use rockfrag_core::random::{Purpose, stream};
use rockfrag_core::rocking::{Record, Response, Structure, simulate};
use serde::de::DeserializeOwned;

fn reference(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference").join(name)
}

/// The rows of a CSV file of the references.
pub fn rows<T: DeserializeOwned>(name: &str) -> Vec<T> {
    csv::Reader::from_path(reference(name)).unwrap().into_deserialize().map(Result::unwrap).collect()
}

/// A row by the names of its columns.
#[derive(Debug, serde::Deserialize)]
pub struct Row(HashMap<String, String>);

impl Row {
    #[track_caller]
    pub fn get<T: FromStr<Err: Debug>>(&self, column: &str) -> T {
        self.0[column].parse().unwrap()
    }

    pub fn text(&self, column: &str) -> &str {
        &self.0[column]
    }

    pub fn structure(&self) -> Structure {
        Structure::new("any", self.get("p_rad_s"), self.get("alpha_rad"), self.get("eta")).unwrap()
    }
}

#[track_caller]
pub fn close(value: f64, expected: f64, tolerance: f64) {
    let difference = (value - expected).abs();
    assert!(difference <= tolerance * expected.abs(), "{value:e}, expected {expected:e}");
}

pub fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    0.5 * (values[(values.len() - 1) / 2] + values[values.len() / 2])
}

pub struct StoredMotion {
    pub dt_s: f64,
    pub acceleration_m_s2: Vec<f64>,
}

/// All motions, by name, of a file whose first columns are name, time step and samples.
fn motions(path: &Path) -> HashMap<String, StoredMotion> {
    let sample = |field: &Field| match field {
        Field::Float(value) => f64::from(*value),
        Field::Double(value) => *value,
        other => panic!("{other}; expected a sample"),
    };
    let name = |field: &Field| match field {
        Field::Str(name) => name.clone(),
        number => number.to_string(),
    };
    let motion = |row: parquet::record::Row| {
        let dt_s = row.get_double(1).unwrap();
        let acceleration_m_s2 = row.get_list(2).unwrap().elements().iter().map(sample).collect();
        (name(row.get_column_iter().next().unwrap().1), StoredMotion { dt_s, acceleration_m_s2 })
    };
    SerializedFileReader::try_from(path).unwrap().into_iter().map(Result::unwrap).map(motion).collect()
}

/// The sixty synthetic motions of the references.
pub fn reference_motions() -> HashMap<String, StoredMotion> {
    motions(&reference("rocking/motions.parquet"))
}

/// The near-fault pulse set of FEMA P695, which the project does not include.
pub fn near_fault_records() -> HashMap<String, StoredMotion> {
    let folder = std::env::var_os("ROCKFRAG_RECORDS").expect("ROCKFRAG_RECORDS names a folder");
    motions(&Path::new(&folder).join("fema_p695_near_fault_pulse.parquet"))
}

pub fn respond(structure: &Structure, samples: &[f64], dt_s: f64) -> Response {
    simulate(structure, &Record::new(samples, dt_s).unwrap())
}

/// Noise of up to 6 m/s2 that rises and decays.
pub fn noise(seed: u64, length: usize) -> Vec<f64> {
    let mut random = stream(seed, Purpose::Noise, 0);
    let rise = |k: usize| (PI * k as f64 / length as f64).sin();
    (0..length).map(|k| random.random_range(-6.0..6.0) * rise(k)).collect()
}
