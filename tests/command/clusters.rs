//! Clustered errors of records go by their earthquake.

use std::path::Path;
use std::sync::Arc;

use arrow_array::builder::{Float64Builder, ListBuilder};
use arrow_array::cast::AsArray;
use arrow_array::types::Float64Type;
use arrow_array::{ArrayRef, Float64Array, Int32Array, Int64Array, RecordBatch, StringArray};
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;

use crate::common::{succeed, write};

/// All rows of a file.
pub fn rows(path: &Path) -> RecordBatch {
    let file = std::fs::File::open(path).unwrap();
    let all = ParquetRecordBatchReaderBuilder::try_new(file).unwrap().with_batch_size(usize::from(u16::MAX));
    all.build().unwrap().next().unwrap().unwrap()
}

fn reference<T: serde::de::DeserializeOwned>(name: &str) -> Vec<T> {
    let path = format!("{}/tests/reference/fits/{name}", env!("CARGO_MANIFEST_DIR"));
    csv::Reader::from_path(path).unwrap().into_deserialize().map(Result::unwrap).collect()
}

/// Safe responses with the measures and demands of the reference, 20 to an earthquake.
pub fn responses(path: &Path, with_earthquakes: bool) {
    let cases: Vec<(f64, f64, f64, u8)> = reference("cases.csv");
    let number = |value: fn(&(f64, f64, f64, u8)) -> f64| -> ArrayRef {
        Arc::new(Float64Array::from_iter_values(cases.iter().map(value)))
    };
    let text = |value: &dyn Fn(usize) -> String| -> ArrayRef {
        Arc::new(StringArray::from_iter_values((0..cases.len()).map(value)))
    };
    let mut columns = vec![
        ("motion_id", text(&|row| format!("record {row}"))),
        ("structure", text(&|_| "block".to_string())),
        ("p_rad_s", number(|_| 2.0)),
        ("alpha_rad", number(|_| 0.2)),
        ("eta", number(|_| 0.9)),
        ("outcome", text(&|_| "safe_rocking".to_string())),
        ("edp", number(|case| case.2.exp())),
        ("impacts", Arc::new(Int32Array::from_iter_values(cases.iter().map(|_| 0))) as ArrayRef),
        ("pga_m_s2", number(|_| 1.0)),
        ("pgv_m_s", number(|_| 1.0)),
        ("im4", number(|case| case.0.exp())),
        ("im5", number(|_| 1.0)),
    ];
    if with_earthquakes {
        columns.push(("earthquake", text(&|row| format!("earthquake {}", row / 20))));
    }
    write(path, columns);
}

#[test]
fn clustered_errors_by_earthquake_equal_those_of_statsmodels() {
    let answers: std::collections::HashMap<String, f64> =
        reference::<(String, f64)>("uncertainty_answers.csv").into_iter().collect();
    let folder = tempfile::tempdir().unwrap();
    for (with_earthquakes, answer) in [(true, "ols_x_clustered1"), (false, "ols_x_hc1_1")] {
        responses(&folder.path().join("responses.parquet"), with_earthquakes);
        succeed(folder.path(), "fit-pex --force");
        let fits = rows(&folder.path().join("pex.parquet"));
        let measures = fits["im_x"].as_string::<i32>();
        let row = (0..fits.num_rows()).find(|&row| measures.value(row) == "im4").unwrap();
        let error = fits["se_b1_clustered"].as_primitive::<Float64Type>().value(row);
        let expected = answers[answer];
        assert!((error - expected).abs() < 1e-9 * expected, "{answer}: {error}, expected {expected}");
    }
}

#[test]
fn simulate_carries_the_earthquake_by_name_or_number() {
    let folder = tempfile::tempdir().unwrap();
    let names: ArrayRef = Arc::new(StringArray::from(vec![Some("Kobe"), None]));
    let numbers: ArrayRef = Arc::new(Int64Array::from(vec![Some(17), None]));
    for (events, expected) in [(names, "Kobe"), (numbers, "17")] {
        let mut list = ListBuilder::new(Float64Builder::new());
        for _ in 0..2 {
            list.values().append_slice(&[0.0, 3.0, -2.0, 1.0, 0.0]);
            list.append(true);
        }
        let columns: Vec<(&str, ArrayRef)> = vec![
            ("motion_id", Arc::new(StringArray::from(vec!["a", "b"]))),
            ("earthquake", events),
            ("dt_s", Arc::new(Float64Array::from(vec![0.1, 0.1]))),
            ("acceleration_m_s2", Arc::new(list.finish())),
        ];
        write(&folder.path().join("motions.parquet"), columns);
        succeed(folder.path(), "simulate --force --p 2.5 --alpha 0.2 --eta 0.92");
        let responses = rows(&folder.path().join("responses.parquet"));
        let events: Vec<Option<&str>> = responses["earthquake"].as_string::<i32>().iter().collect();
        assert_eq!(events, [Some(expected), None]);
    }
}
