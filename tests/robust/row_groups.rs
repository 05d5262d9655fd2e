//! More row groups than a Parquet file has room for.

use std::collections::BTreeMap;
use std::sync::Arc;

use arrow_array::{Int64Array, RecordBatch};
use rockfrag::table::footer::footer;
use rockfrag::table::provenance::Provenance;
use rockfrag::table::reader::read_any;
use rockfrag::table::schema::{SCENARIO_ID, Table};
use rockfrag::table::writer::TableWriter;

const NARROW: Table = Table { name: "scenarios", stage: "sample-scenarios", columns: &[SCENARIO_ID] };

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
    let rows = read_any(&path).unwrap();
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
