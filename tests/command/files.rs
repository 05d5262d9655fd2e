//! Files: what is damaged, foreign or in the way is named, and nothing of the user's is lost.

use std::path::Path;
use std::sync::Arc;

use arrow_array::types::Float32Type;
use arrow_array::{ArrayRef, Float64Array, ListArray, RecordBatch, StringArray};
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;

use crate::common::{SMALL, bytes, fail, folder_with, made, succeed, write, write_motions};

const STRUCTURE: &str = "--p 2.5 --alpha 0.2 --eta 0.92";

#[test]
fn motions_that_cannot_be_used_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let nan: &[f64] = &[0.0, f64::NAN];
    let (fine, short, huge): (&[f64], &[f64], &[f64]) = (&[0.0, 1.0], &[1.0], &[0.0, f64::INFINITY]);
    for (dt, motions, named) in [
        (0.01, vec![fine, nan], vec!["m.parquet", "row 2", "acceleration_m_s2"]),
        (0.01, vec![huge], vec!["row 1", "acceleration_m_s2"]),
        (0.01, vec![short], vec!["row 1", "acceleration_m_s2"]),
        (0.0, vec![fine], vec!["row 1", "dt_s"]),
        (f64::NAN, vec![fine], vec!["row 1", "dt_s"]),
        (0.01, vec![], vec!["m.parquet"]),
    ] {
        write_motions(&folder.path().join("m.parquet"), dt, &motions);
        fail(folder.path(), &format!("simulate --in m.parquet {STRUCTURE}"), 1, &named);
        assert!(!folder.path().join("responses.parquet").exists());
    }
}

#[test]
fn columns_that_are_missing_or_of_another_type_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.parquet");
    let column = |column: &str| -> ArrayRef {
        match column {
            "text" => Arc::new(StringArray::from(vec!["x"])),
            "number" => Arc::new(Float64Array::from(vec![0.01])),
            _ => Arc::new(ListArray::from_iter_primitive::<Float32Type, _, _>([Some(vec![
                Some(0.0),
                Some(1.0),
            ])])),
        }
    };
    for (columns, named) in [
        (["text", "number", ""], vec!["acceleration_m_s2", "m/s2"]),
        (["text", "text", "list"], vec!["dt_s"]),
        (["text", "number", "text"], vec!["acceleration_m_s2"]),
        (["list", "number", "list"], vec!["motion_id"]),
    ] {
        let names = ["motion_id", "dt_s", "acceleration_m_s2"];
        let some = names.into_iter().zip(columns).filter(|(_, kind)| !kind.is_empty());
        write(&path, some.map(|(name, kind)| (name, column(kind))).collect());
        fail(
            folder.path(),
            &format!("simulate --in m.parquet {STRUCTURE}"),
            1,
            &[&["m.parquet"], &named[..]].concat(),
        );
    }
}

/// One response, of which some columns are of another type or value, is refused by fit-pro; the rest is fine.
#[test]
fn responses_that_cannot_be_right_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let text = |word: &str| -> ArrayRef { Arc::new(StringArray::from(vec!["safe_rocking", word])) };
    let numbers = |first: f64, second: f64| -> ArrayRef { Arc::new(Float64Array::from(vec![first, second])) };
    let write = |column: &str, values: ArrayRef| {
        let texts = |name, words| (name, Arc::new(StringArray::from(words)) as ArrayRef);
        let same = [texts("motion_id", vec!["1", "2"]), texts("structure", vec!["a", "a"])];
        let usual = [("p_rad_s", 2.5), ("alpha_rad", 0.2), ("eta", 0.92), ("edp", 0.1), ("pga_m_s2", 3.0)];
        let others = [("pgv_m_s", 0.5), ("im4", 1.5), ("im5", 0.6)];
        let usual = usual.into_iter().chain(others).map(|(name, value)| (name, numbers(value, value)));
        let all = same.into_iter().chain([("outcome", text("safe_rocking"))]).chain(usual);
        let all = all.map(|(name, usual)| (name, if name == column { values.clone() } else { usual }));
        crate::common::write(&folder.path().join("responses.parquet"), all.collect());
    };
    for (column, values, named) in [
        ("p_rad_s", numbers(-1.0, -1.0), vec!["row 1", "p_rad_s", "-1"]),
        ("p_rad_s", numbers(2.5, f64::NAN), vec!["row 2", "p_rad_s"]),
        ("alpha_rad", numbers(0.2, 0.19), vec!["row 2", "alpha_rad", "0.19", "own name"]),
        ("eta", numbers(0.92, 1.5), vec!["row 2", "eta", "1.5"]),
        ("outcome", text("falls"), vec!["row 2", "outcome", "falls"]),
        ("outcome", text(""), vec!["row 2", "outcome"]),
        ("edp", numbers(0.1, f64::NAN), vec!["row 2", "edp"]),
        ("motion_id", Arc::new(StringArray::from(vec!["1", "1"])), vec!["1 repeated response"]),
    ] {
        write(column, values);
        fail(folder.path(), "fit-pro", 1, &[&["responses.parquet"], &named[..]].concat());
    }
    write("", text(""));
    succeed(folder.path(), "fit-pro");
}

/// The first rows of a file, and its metadata.
fn first_batch(path: &Path) -> (RecordBatch, Option<Vec<KeyValue>>) {
    let reader = ParquetRecordBatchReaderBuilder::try_new(std::fs::File::open(path).unwrap()).unwrap();
    let pairs = reader.metadata().file_metadata().key_value_metadata().cloned();
    (reader.build().unwrap().next().unwrap().unwrap(), pairs)
}

#[test]
fn a_fit_without_a_status_is_refused() {
    let folder = folder_with(SMALL);
    succeed(folder.path(), "run");
    let path = folder.path().join("out/pro.parquet");
    let (batch, _) = first_batch(&path);
    let schema = batch.schema();
    let columns = schema.fields().iter().zip(batch.columns()).map(|(field, column)| {
        let nothing: ArrayRef = Arc::new(StringArray::from(vec![""; batch.num_rows()]));
        (field.name().as_str(), if field.name() == "status" { nothing } else { column.clone() })
    });
    write(&path, columns.collect());
    let call = "evaluate --fits out --model paper --suite csgm --name frame --pga 0.4 --pgv 0.5";
    fail(folder.path(), call, 1, &["pro.parquet", "status"]);
}

#[test]
fn a_file_of_pandas_is_read() {
    // DataFrame.to_parquet: int32, float32, and an index.
    let folder = tempfile::tempdir().unwrap();
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/reference/files/pandas.parquet");
    let (own, foreign) = (folder.path().join("own.parquet"), folder.path().join("pandas.parquet"));
    std::fs::copy(path, foreign).unwrap();
    write_motions(
        &own,
        0.0625,
        &[1.0, 3.0, 5.0].map(|k| [0.0, k, -k, 0.0]).each_ref().map(|motion| &motion[..]),
    );
    let edp = |name: &str| {
        let call = format!("simulate --in {name}.parquet --out {name}.responses.parquet {STRUCTURE}");
        succeed(folder.path(), &call);
        let rows =
            succeed(folder.path(), &format!("inspect --head 5 --format csv {name}.responses.parquet")).0;
        rows.lines().map(|line| line.split_once(',').unwrap().1.to_string()).collect::<Vec<_>>()
    };
    assert_eq!(edp("pandas"), edp("own"));
}

#[test]
fn damaged_files_are_errors_that_name_them() {
    let folder = folder_with(SMALL);
    succeed(folder.path(), "run");
    let motions = bytes(&folder.path().join("out/motions.parquet"));
    let size = motions.len();
    let flipped = |at: usize| [&motions[..at], &[motions[at] ^ 0x55], &motions[at + 1..]].concat();
    let damaged =
        [vec![], motions[..size / 2].to_vec(), motions[..size - 3].to_vec(), b"pga,pgv\n1,2\n".to_vec()];
    let flips = (1..60).map(|k| flipped(size - 7 * k * k % size - 1));
    for (number, content) in damaged.into_iter().chain(flips).enumerate() {
        std::fs::write(folder.path().join("m.parquet"), content).unwrap();
        let call = format!("simulate --in m.parquet --out r.parquet --quiet {STRUCTURE}");
        let output = crate::common::rockfrag(folder.path(), &call).output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        // A flipped bit of a sample is a sample: only what cannot be read is an error.
        assert!(number >= 4 || !output.status.success(), "{number}");
        assert!(output.status.success() || stderr.contains("m.parquet"), "{number}: {stderr}");
        assert!(!stderr.contains("panicked") && output.status.code().is_some(), "{number}: {stderr}");
        let _ = std::fs::remove_file(folder.path().join("r.parquet"));
    }
}

#[test]
fn what_is_in_the_way_is_kept_unless_it_is_given_up() {
    let folder = folder_with(SMALL);
    succeed(folder.path(), "run");
    let simulate =
        |out: &str, more: &str| format!("simulate --in out/motions.parquet --out {out} {STRUCTURE} {more}");
    fail(folder.path(), &simulate("out/motions.parquet", "--force"), 2, &["out/motions.parquet"]);
    std::fs::create_dir(folder.path().join("folder")).unwrap();
    fail(folder.path(), &simulate("folder", ""), 2, &["folder"]);
    let other = folder.path().join("other.parquet");
    write_motions(&other, 0.01, &[&[0.0, 1.0]]);
    std::fs::write(folder.path().join("notes.parquet"), "my notes").unwrap();
    for name in ["other.parquet", "notes.parquet"] {
        let before = bytes(&folder.path().join(name));
        fail(folder.path(), &simulate(name, ""), 1, &[name, "--force"]);
        assert_eq!(bytes(&folder.path().join(name)), before);
        succeed(folder.path(), &simulate(name, "--force"));
    }
    succeed(folder.path(), &simulate("out/responses.parquet", ""));
}

#[test]
fn a_file_that_another_program_rewrote_is_not_taken_for_ours() {
    let folder = folder_with(SMALL);
    succeed(folder.path(), "run");
    let path = folder.path().join("out/motions.parquet");
    let (batch, pairs) = first_batch(&path);
    let properties = WriterProperties::builder().set_key_value_metadata(pairs).build();
    let file = std::fs::File::create(&path).unwrap();
    let mut writer = ArrowWriter::try_new(file, batch.schema(), Some(properties)).unwrap();
    writer.write(&batch.slice(0, 5)).unwrap();
    writer.close().unwrap();
    let (plan, _) = succeed(folder.path(), "run --dry-run");
    assert!(plan.contains("synthesize-motions: run"), "{plan}");
    fail(folder.path(), "run", 1, &["motions.parquet", "--force"]);
    let before = made(&folder.path().join("out/responses.parquet"));
    succeed(
        folder.path(),
        "simulate --config pipeline.yaml --in out/motions.parquet --out out/responses.parquet",
    );
    let after = made(&folder.path().join("out/responses.parquet"));
    assert!(before.key() != after.key() && before.arguments == after.arguments);
}
