//! More row groups than a Parquet file has room for.

use std::collections::BTreeMap;
use std::sync::Arc;

use arrow_array::{Float32Array, Int64Array, ListArray, RecordBatch};
use arrow_buffer::OffsetBuffer;
use arrow_schema::DataType;
use rockfrag::table::schema::{Table, acceleration_m_s2, scenario_id};
use rockfrag::table::store::contents::footer;
use rockfrag::table::store::provenance::Provenance;
use rockfrag::table::store::reader::{OpenTable, read_any};
use rockfrag::table::store::writer::TableWriter;

const NARROW: Table = Table { name: "scenarios", stage: "sample-scenarios", columns: &[scenario_id] };

const SAMPLES: Table = Table { name: "motions", stage: "synthesize-motions", columns: &[acceleration_m_s2] };

/// The most samples of a motion, and the most motions of that length in a row group.
const LONGEST: usize = 1 << 24;
const MOST: usize = 16;

/// Writes so many batches of one row each, each to be a row group, and gives the numbers of row groups and the rows.
fn written(batches: i64) -> (usize, Vec<i64>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scenarios.parquet");
    let provenance = Provenance::new("sample-scenarios", serde_json::json!({}), BTreeMap::new());
    let mut writer = TableWriter::create(&path, &NARROW, provenance).unwrap();
    for row in 0..batches {
        let column = Arc::new(Int64Array::from(vec![row]));
        writer.write_row_group(&RecordBatch::try_new(NARROW.schema(), vec![column]).unwrap()).unwrap();
    }
    writer.finish().unwrap();
    let rows = read_any(&path, |_| true).unwrap();
    let rows = rows
        .iter()
        .flat_map(|batch| batch.column(0).as_any().downcast_ref::<Int64Array>().unwrap().values().to_vec());
    (footer(&path).unwrap().row_groups, rows.collect())
}

#[test]
fn a_file_takes_more_batches_than_row_groups() {
    // Parquet counts row groups in 16 bits.
    let (row_groups, rows) = written(40_000);
    assert!(row_groups <= 32_767, "{row_groups}");
    assert!(rows.iter().copied().eq(0..40_000));
}

#[test]
fn few_batches_are_a_row_group_each() {
    let (row_groups, rows) = written(300);
    assert_eq!(row_groups, 300);
    assert!(rows.iter().copied().eq(0..300));
}

/// So many motions of these many samples.
fn motions(rows: usize, samples: usize) -> RecordBatch {
    let schema = SAMPLES.schema();
    let DataType::List(item) = schema.field(0).data_type() else { panic!("no list") };
    let values = Arc::new(Float32Array::from(vec![0.0; rows * samples]));
    let lengths = OffsetBuffer::from_lengths(std::iter::repeat_n(samples, rows));
    let list = ListArray::new(item.clone(), lengths, values, None);
    RecordBatch::try_new(schema, vec![Arc::new(list)]).unwrap()
}

fn samples_writer(path: &std::path::Path) -> TableWriter {
    let provenance = Provenance::new("synthesize-motions", serde_json::json!({}), BTreeMap::new());
    TableWriter::create(path, &SAMPLES, provenance).unwrap()
}

#[test]
fn no_row_group_has_more_samples_than_are_read_of_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("motions.parquet");
    let mut writer = samples_writer(&path);
    // Two at once, of which one is the first that has no room.
    let (one, two) = (motions(1, LONGEST), motions(2, LONGEST));
    (0..MOST - 1).for_each(|_| writer.append(&one).unwrap());
    writer.append(&two).unwrap();
    writer.finish().unwrap();
    let table = OpenTable::open(&path, &["synthesize-motions"], SAMPLES.columns).unwrap();
    let runs = table.runs(0..u64::MAX);
    assert_eq!(runs.iter().map(|run| run.rows).collect::<Vec<_>>(), [MOST as u64, 1]);
    let last = table.batches_of(runs[1], 1).unwrap().next().unwrap().unwrap();
    assert_eq!(last.columns().samples(&acceleration_m_s2).unwrap()[0].to_vec().len(), LONGEST);
}

#[test]
fn motions_longer_than_are_read_are_not_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("motions.parquet");
    let refused = samples_writer(&path).append(&motions(1, LONGEST + 1)).unwrap_err().to_string();
    assert!(refused.contains("16777217 samples; expected 16777216 at most"), "{refused}");
    assert!(!path.exists());
}
