//! Files of earlier versions are read, those of later ones refused (scripts/reference/files.sh made the files).

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::file::metadata::KeyValue;
use rockfrag::table::motions::MotionBatches;
use rockfrag::table::store::contents::recorded;
use rockfrag::table::store::provenance::FORMAT_VERSION;

use crate::readers::read_as_everything;

fn files() -> PathBuf {
    Path::new("tests/reference/files").canonicalize().unwrap()
}

fn rockfrag(folder: &Path, arguments: &str) -> Output {
    Command::new(assert_cmd::cargo::cargo_bin("rockfrag"))
        .args(arguments.split_whitespace())
        .current_dir(folder)
        .output()
        .unwrap()
}

/// Each file, and what reads it besides `inspect`.
fn readers() -> Vec<(&'static str, Vec<&'static str>)> {
    vec![
        ("scenarios", vec!["scenarios"]),
        ("motions", vec!["motions", "motions in parts"]),
        ("records", vec!["motions", "motions in parts"]),
        ("responses", vec!["responses", "intensities"]),
        ("pex", vec!["regressions"]),
        ("pro", vec!["curves"]),
        ("paper", vec!["comparison"]),
        ("validation", vec!["validation"]),
        ("pex.scan", vec![]),
        ("pex.bootstrap", vec![]),
        ("pro.bootstrap", vec![]),
        ("traced", vec!["responses"]),
        ("traced.trace", vec![]),
        ("ida", vec![]),
        ("ida.stripes", vec!["responses"]),
        ("ida.windows", vec![]),
        ("ida.shares", vec![]),
        ("ida.fragility", vec!["capacities"]),
        ("ranking", vec!["ranking"]),
        ("ranking.reliability", vec![]),
        ("universality", vec!["universality"]),
        ("universality.pooled", vec!["pooled curves"]),
        ("evaluated", vec!["intensities"]),
    ]
}

#[test]
fn each_file_is_read_by_the_stages_that_read_it() {
    let parquet = |path: &PathBuf| path.extension().is_some_and(|end| end == "parquet");
    let there = std::fs::read_dir(files()).unwrap().map(|entry| entry.unwrap().path()).filter(parquet);
    assert_eq!(there.count(), readers().len());
    for (name, expected) in readers() {
        let path = files().join(format!("{name}.parquet"));
        assert!(recorded(&path).unwrap().is_some(), "{name}");
        let read = read_as_everything(&path);
        for reader in expected.into_iter().chain(["recorded", "content", "inspect"]) {
            let (_, result) = read.iter().find(|(what, _)| *what == reader).unwrap();
            assert!(result.is_ok(), "{name} as {reader}: {result:?}");
        }
    }
}

#[test]
fn a_folder_of_parts_is_read_as_their_rows() {
    let folder = files().join("motions");
    let motions: usize = MotionBatches::open(&folder, 64).unwrap().map(|batch| batch.unwrap().len()).sum();
    assert_eq!(motions, 2);
    let whole = MotionBatches::open(files().join("motions.parquet"), 64).unwrap();
    let pulses = whole.map(|batch| {
        batch.unwrap().into_iter().filter(|motion| motion.suite.as_deref() == Some("pulse")).count()
    });
    assert_eq!(pulses.sum::<usize>(), motions);
}

#[test]
fn old_fits_give_the_answers_that_they_gave() {
    let answer = rockfrag(
        &files(),
        "evaluate --pex pex.parquet --pro pro.parquet --structure electrical-equipment --p 2.5 --alpha 0.20 --pga 0.5 --pgv 0.6",
    );
    let then = std::fs::read_to_string(files().join("evaluate.txt")).unwrap();
    // The words above the table may change, its numbers may not.
    let table = |text: &str| text.split_once("\n\n").unwrap().1.to_string();
    assert_eq!(table(&String::from_utf8(answer.stdout).unwrap()), table(&then));
}

/// A copy of a file that says it is of another format.
fn in_format(name: &str, format: &str, copy: &Path) {
    let file = std::fs::File::open(files().join(name)).unwrap();
    let reader = ParquetRecordBatchReaderBuilder::try_new(file).unwrap();
    let mut pairs = reader.metadata().file_metadata().key_value_metadata().unwrap().clone();
    pairs.retain(|pair| pair.key != "ARROW:schema" && pair.key != "rockfrag.format");
    pairs.push(KeyValue::new("rockfrag.format".to_string(), format.to_string()));
    let reader = reader.build().unwrap();
    let schema = arrow_array::RecordBatchReader::schema(&reader);
    let mut writer = ArrowWriter::try_new(std::fs::File::create(copy).unwrap(), schema, None).unwrap();
    reader.into_iter().for_each(|batch| writer.write(&batch.unwrap()).unwrap());
    pairs.into_iter().for_each(|pair| writer.append_key_value_metadata(pair));
    writer.close().unwrap();
}

#[test]
fn a_later_format_is_refused_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let now = FORMAT_VERSION.to_string();
    let later = (FORMAT_VERSION + 1).to_string();
    for (name, call) in [
        ("motions.parquet", "simulate --in motions.parquet --structures paper --out out.parquet"),
        ("responses.parquet", "fit-pro --in responses.parquet --out out.parquet"),
        ("motions.parquet", "inspect motions.parquet"),
    ] {
        in_format(name, &now, &folder.path().join(name));
        assert!(rockfrag(folder.path(), call).status.success(), "{call}");
        std::fs::remove_file(folder.path().join("out.parquet")).ok();
        in_format(name, &later, &folder.path().join(name));
        let refused = rockfrag(folder.path(), call);
        let words = String::from_utf8(refused.stderr).unwrap();
        assert_eq!(refused.status.code(), Some(1), "{call}: {words}");
        assert!(words.contains(&format!("format {later}")) && words.contains("update"), "{words}");
        assert!(!folder.path().join("out.parquet").exists(), "{call}");
    }
}
