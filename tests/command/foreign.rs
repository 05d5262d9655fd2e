//! Tables of other programs: every type and codec is read, and what a quantity cannot be is named.

use std::path::Path;
use std::sync::Arc;

use arrow_array::builder::{FixedSizeListBuilder, Float16Builder};
use arrow_array::builder::{PrimitiveBuilder, UInt16Builder, UInt32Builder};
use arrow_array::types::{ArrowPrimitiveType, Float16Type};
use arrow_array::{ArrayRef, Decimal128Array, Float16Array, Int64Array, RecordBatch, UInt64Array};
use arrow_schema::{DataType, Field, Schema};
use parquet::basic::Compression;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{FileReader, SerializedFileReader};
use rockfrag::table::file::ParquetTable;
use serde_json::Value;

use crate::common::{
    STRUCTURE, bytes, fail, folder_with, lists, motions_of, near, numbers, objects, rows, succeed, texts,
};
use crate::common::{write, write_motions, write_with};

const SIMULATE: &str = "simulate --in m.parquet --p 2.5 --alpha 0.2 --eta 0.92 --out r.parquet --force";

/// Half a second of 2 Hz at 3 m/s2, in steps of 0.01 s.
fn sine() -> Vec<f64> {
    (0..50).map(|k| (300.0 * (std::f64::consts::TAU * 0.02 * f64::from(k)).sin()).round() / 100.0).collect()
}

/// The sine as motion `a`, with columns in place of the usual ones.
fn motion(columns: Vec<(&'static str, ArrayRef)>) -> Vec<(&'static str, ArrayRef)> {
    let mut all = motions_of(texts(&["a"]), 0.01, &[&sine()]);
    for (name, array) in columns {
        all.retain(|(other, _)| *other != name);
        all.push((name, array));
    }
    all
}

/// The response to the sine with these columns.
fn response(columns: Vec<(&'static str, ArrayRef)>) -> Value {
    let folder = tempfile::tempdir().unwrap();
    write(&folder.path().join("m.parquet"), motion(columns));
    succeed(folder.path(), SIMULATE);
    objects(folder.path(), "r.parquet").remove(0)
}

fn decimal(value: i128, precision: u8, scale: i8) -> ArrayRef {
    Arc::new(Decimal128Array::from(vec![value]).with_precision_and_scale(precision, scale).unwrap())
}

/// Numbers of this type, in a list.
fn list<T: ArrowPrimitiveType>(mut items: PrimitiveBuilder<T>, values: Vec<T::Native>) -> ArrayRef {
    items.append_slice(&values);
    let mut list = FixedSizeListBuilder::new(items, values.len() as i32);
    list.append(true);
    Arc::new(list.finish())
}

#[test]
fn half_unsigned_and_whole_numbers_stay_themselves() {
    type Half = <Float16Type as ArrowPrimitiveType>::Native;
    let half = [0.0, -2.5, 0.125].map(Half::from_f64).to_vec();
    let (samples, id) = ("acceleration_m_s2", "motion_id");
    let cases: [(&str, ArrayRef, &str, Value); 9] = [
        (samples, list(Float16Builder::new(), half), "pga_m_s2", 2.5.into()),
        (samples, list(UInt16Builder::new(), vec![0, 3, 1]), "pga_m_s2", 3.0.into()),
        (samples, list(UInt32Builder::new(), vec![0, 4, 1]), "pga_m_s2", 4.0.into()),
        ("scenario_id", Arc::new(UInt64Array::from(vec![7])), "scenario_id", 7.into()),
        ("mw", Arc::new(UInt64Array::from(vec![6])), "mw", 6.0.into()),
        ("tp_s", Arc::new(Float16Array::from(vec![Half::from_f64(0.5)])), "tp_s", 0.5.into()),
        (id, Arc::new(UInt64Array::from(vec![u64::MAX])), id, "18446744073709551615".into()),
        (id, Arc::new(Int64Array::from(vec![i64::MIN + 1])), id, "-9223372036854775807".into()),
        (id, decimal(12_345_678_901_234_567_890, 20, 0), id, "12345678901234567890".into()),
    ];
    for (column, array, shown, expected) in cases {
        assert_eq!(response(vec![(column, array)])[shown], expected, "{column}");
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.parquet");
    let large = list(UInt32Builder::new(), vec![0, u32::MAX]);
    write(&path, motion(vec![(samples, large)]));
    fail(folder.path(), SIMULATE, 1, &["row 1", "acceleration_m_s2", "4294967295"]);
    // Two numbers that are one as f64.
    let ids: ArrayRef = Arc::new(Int64Array::from(vec![1 << 53, (1 << 53) + 1]));
    write(&path, motions_of(ids, 0.01, &[&sine(), &sine()]));
    succeed(folder.path(), SIMULATE);
    assert!(rows(folder.path(), "m.parquet").contains("9007199254740993"));
}

#[test]
fn every_codec_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let batch = RecordBatch::try_from_iter(motion(Vec::new())).unwrap();
    for codec in ["UNCOMPRESSED", "SNAPPY", "GZIP(6)", "BROTLI(1)", "LZ4_RAW", "LZ4"] {
        let codec: Compression = codec.parse().unwrap();
        let properties = WriterProperties::builder().set_compression(codec).build();
        write_with(&folder.path().join("m.parquet"), &batch, properties);
        succeed(folder.path(), SIMULATE);
        assert_eq!(objects(folder.path(), "r.parquet")[0]["pga_m_s2"], 2.99, "{codec:?}");
    }
}

fn reference(name: &str) -> Vec<u8> {
    bytes(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/files").join(name))
}

#[test]
fn files_of_pandas_and_pyarrow_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.parquet");
    let motions = [1.0, 3.0, 5.0].map(|k| [0.0, k, -k, 0.0]);
    write_motions(&path, 0.0625, &motions.each_ref().map(|motion| &motion[..]));
    let edp = || {
        succeed(folder.path(), SIMULATE);
        let rows = rows(folder.path(), "r.parquet");
        rows.lines().map(|line| line.split_once(',').unwrap().1.to_string()).collect::<Vec<_>>()
    };
    let own = edp();
    // DataFrame.to_parquet: int32, float32, and an index.
    std::fs::write(&path, reference("pandas.parquet")).unwrap();
    assert_eq!(edp(), own);
    // Three motions, of which the third page of samples has none: an empty page ends no column.
    let pyarrow = ["empty_page.parquet", "page_checksums.parquet"].map(|name| {
        std::fs::write(&path, reference(name)).unwrap();
        edp()
    });
    assert!(pyarrow[0] == pyarrow[1] && pyarrow[0].len() == 4, "{pyarrow:?}");
}

#[test]
fn a_motion_that_cannot_be_is_named_with_its_row() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.parquet");
    let ida = format!("ida --in m.parquet {STRUCTURE} --out i.parquet");
    for (column, values) in
        [("pga_m_s2", vec![-1.0, f64::INFINITY]), ("tm_s", vec![0.0]), ("dt_s", vec![-0.01, 0.0, f64::NAN])]
    {
        for value in values {
            write(&path, motion(vec![("suite", texts(&["csgm"])), (column, numbers(&[value]))]));
            fail(folder.path(), SIMULATE, 1, &["m.parquet", "row 1", column, "expected"]);
            fail(folder.path(), &ida, 1, &["m.parquet", "row 1", column, "expected"]);
        }
    }
    fail(folder.path(), "floor-motions --in m.parquet --period 0.5 --level 1", 1, &["row 1", "dt_s"]);
    let fine: &[f64] = &[0.0, 1.0];
    for (motions, named) in [
        (vec![fine, &[0.0, f64::NAN]], vec!["m.parquet", "row 2", "acceleration_m_s2"]),
        (vec![&[0.0, f64::INFINITY]], vec!["row 1", "acceleration_m_s2"]),
        (vec![&[1.0]], vec!["row 1", "acceleration_m_s2"]),
        (vec![], vec!["m.parquet"]),
    ] {
        write_motions(&path, 0.01, &motions);
        fail(folder.path(), SIMULATE, 1, &named);
        assert!(!folder.path().join("r.parquet").exists());
    }
    write_motions(&path, 0.01, &[fine]);
    fail(folder.path(), &format!("{SIMULATE} --trace 7"), 1, &["m.parquet", "no motion '7' to trace"]);
    let known = response(vec![("mw", numbers(&[f64::NAN])), ("pga_m_s2", numbers(&[f64::NAN]))]);
    assert!(known["mw"].is_null() && near(known["pga_m_s2"].as_f64().unwrap(), 2.99, 1e-12), "NaN is null");
}

#[test]
fn columns_that_are_missing_double_or_of_another_type_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("m.parquet");
    for (column, array) in [
        ("acceleration_m_s2", None),
        ("dt_s", Some(texts(&["x"]))),
        ("acceleration_m_s2", Some(texts(&["x"]))),
        ("motion_id", Some(lists(&[&[0.0, 1.0]]))),
    ] {
        let mut columns = motion(Vec::new());
        columns.retain(|(name, _)| *name != column);
        columns.extend(array.map(|array| (column, array)));
        write(&path, columns);
        fail(folder.path(), SIMULATE, 1, &["m.parquet", column]);
    }
    let pga = Field::new("pga_m_s2", DataType::Float64, true);
    let schema = Arc::new(Schema::new(vec![pga.clone(), pga]));
    let batch = RecordBatch::try_new(schema, vec![numbers(&[1.0]), numbers(&[2.0])]).unwrap();
    write_with(&path, &batch, WriterProperties::default());
    for command in ["inspect m.parquet", SIMULATE, "floor-motions --in m.parquet --period 1 --level 1"] {
        fail(folder.path(), command, 1, &["m.parquet", "pga_m_s2"]);
    }
}

/// Two responses, the second with another value in a column.
fn two_responses(path: &Path, column: &str, value: ArrayRef) {
    let words = ["motion_id", "structure", "outcome"].into_iter().zip([
        texts(&["1", "2"]),
        texts(&["a", "a"]),
        texts(&["safe_rocking", "safe_rocking"]),
    ]);
    let usual = [("p_rad_s", 2.5), ("alpha_rad", 0.2), ("eta", 0.92), ("edp", 0.1), ("mw", 6.5)];
    let others = [("re_km", 10.0), ("pga_m_s2", 3.0), ("pgv_m_s", 0.5), ("im4", 1.5), ("im5", 0.6)];
    let usual = usual.into_iter().chain(others).map(|(name, value)| (name, numbers(&[value, value])));
    let columns = words.chain(usual);
    let columns = columns.map(|(name, usual)| (name, if name == column { value.clone() } else { usual }));
    write(path, columns.collect());
}

#[test]
fn columns_of_motions_that_cannot_be_measures_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    two_responses(&folder.path().join("r.parquet"), "", texts(&["", ""]));
    for (name, ids) in [("m", ["1", "2"]), ("twice", ["1", "1"]), ("other", ["1", "3"])] {
        let columns = ["energy_m", "pgv_cm_s"].map(|name| (name, numbers(&[0.2, 0.3])));
        let columns = [("motion_id", texts(&ids)), ("name", texts(&["a", "b"]))].into_iter().chain(columns);
        write(&folder.path().join(format!("{name}.parquet")), columns.collect());
    }
    for stage in ["fit-pro", "fit-pex"] {
        for (options, code, named) in [
            ("--pairs im9", 2, vec!["im9", "--motions"]),
            ("--pairs im4:im9 --motions m.parquet", 2, vec!["m.parquet", "im9", "energy_m"]),
            ("--pairs pgv_cm_s --motions m.parquet", 2, vec!["pgv_cm_s", "_m_s"]),
            ("--pairs name --motions m.parquet", 1, vec!["m.parquet", "name"]),
            ("--pairs energy_m --motions twice.parquet", 1, vec!["twice.parquet", "motion '1'"]),
            ("--pairs energy_m --motions other.parquet", 1, vec!["other.parquet", "motion '2'"]),
        ] {
            fail(folder.path(), &format!("{stage} --in r.parquet {options}"), code, &named);
        }
        succeed(folder.path(), &format!("{stage} --in r.parquet --pairs im5,energy_m --motions m.parquet"));
    }
}

#[test]
fn responses_that_cannot_be_are_named_by_all_that_read_them() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("r.parquet");
    let fits = ["fit-pro", "fit-pex", "validate"].map(|stage| format!("{stage} --in r.parquet"));
    for (column, first, second) in [("edp", 0.1, -0.5), ("im4", 1.5, f64::INFINITY), ("mw", 6.5, 0.0)] {
        two_responses(&path, column, numbers(&[first, second]));
        for call in &fits {
            fail(folder.path(), call, 1, &["r.parquet", "row 2", column]);
        }
    }
    let outcomes = |word: &str| texts(&["safe_rocking", word]);
    for (column, values, named) in [
        ("p_rad_s", numbers(&[-1.0, -1.0]), vec!["row 1", "p_rad_s", "-1"]),
        ("alpha_rad", numbers(&[0.2, 0.19]), vec!["row 2", "alpha_rad", "0.19", "own name"]),
        ("eta", numbers(&[0.92, 1.5]), vec!["row 2", "eta", "1.5"]),
        ("outcome", outcomes("falls"), vec!["row 2", "outcome", "falls"]),
        ("outcome", outcomes(""), vec!["row 2", "outcome"]),
        ("edp", numbers(&[0.1, f64::NAN]), vec!["row 2", "edp"]),
        ("motion_id", texts(&["1", "1"]), vec!["1 repeated response"]),
    ] {
        two_responses(&path, column, values);
        fail(folder.path(), &fits[0], 1, &[&["r.parquet"], &named[..]].concat());
    }
    two_responses(&path, "", outcomes(""));
    succeed(folder.path(), &fits[0]);
}

#[test]
fn damaged_motions_are_errors_that_name_their_file() {
    let folder =
        folder_with("seed: 1\nout: .\nsample-scenarios: { samples: 2 }\nsynthesize-motions: { dt: 0.02 }\n");
    succeed(folder.path(), "run");
    let path = folder.path().join("motions.parquet");
    let (whole, foreign) = (bytes(&path), reference("page_checksums.parquet"));
    let simulate = format!("simulate {STRUCTURE} --force");
    succeed(folder.path(), &simulate);
    let read = ["motion_id", "dt_s", "acceleration_m_s2", "pga_m_s2"];
    let reader = SerializedFileReader::new(std::fs::File::open(&path).unwrap()).unwrap();
    let columns = reader.metadata().row_group(0).columns().iter();
    let columns = columns.filter(|column| read.contains(&column.column_path().parts()[0].as_str()));
    let places = columns.map(|column| column.byte_range());
    let places: Vec<u64> =
        places.flat_map(|(start, length)| [start, start + length / 2, start + length - 1]).collect();
    assert_eq!(places.len(), 12);
    std::fs::write(&path, &foreign).unwrap();
    succeed(folder.path(), &simulate);
    let flipped = |of: &[u8], at: usize, bit: u8| [&of[..at], &[of[at] ^ bit], &of[at + 1..]].concat();
    let cut = [0, whole.len() / 2, whole.len() - 3].map(|end| whole[..end].to_vec());
    let mut damaged =
        [&cut[..], &[b"pga,pgv\n1,2\n".to_vec(), flipped(&foreign, foreign.len() / 4, 16)]].concat();
    damaged.extend(places.into_iter().map(|at| flipped(&whole, at as usize, 16)));
    for content in damaged {
        std::fs::write(&path, content).unwrap();
        fail(folder.path(), &simulate, 1, &["motions.parquet"]);
    }
    // Any bit of a file, that of its footer too: an offset may become negative.
    let path = folder.path().join("scenarios.parquet");
    let whole = bytes(&path);
    for at in 0..whole.len() {
        std::fs::write(&path, flipped(&whole, at, 1)).unwrap();
        let table = ParquetTable::open(&path);
        table.into_iter().for_each(|table| table.batches(|_| true).for_each(drop));
    }
}
