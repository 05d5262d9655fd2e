//! Tables of other programs: every type and codec is read, and what a quantity cannot be is named.

use std::path::Path;
use std::sync::Arc;

use arrow_array::builder::{Decimal128Builder, FixedSizeListBuilder, Float64Builder, ListBuilder};
use arrow_array::builder::{Float16Builder, PrimitiveBuilder, UInt16Builder, UInt32Builder};
use arrow_array::types::{ArrowPrimitiveType, Float16Type};
use arrow_array::{
    ArrayRef, Decimal128Array, Float64Array, Int32Array, Int64Array, RecordBatch, StringArray, UInt64Array,
};
use arrow_schema::DataType;
use parquet::arrow::ArrowWriter;
use parquet::basic::{BrotliLevel, Compression, GzipLevel};
use parquet::file::properties::WriterProperties;
use serde_json::Value;

use crate::common::{bytes, fail, folder_with, near, succeed, write};

const STRUCTURE: &str = "--p 2.5 --alpha 0.2 --eta 0.92";
const SIMULATE: &str = "simulate --in m.parquet --p 2.5 --alpha 0.2 --eta 0.92 --out r.parquet --force";

fn numbers(values: &[f64]) -> ArrayRef {
    Arc::new(Float64Array::from(values.to_vec()))
}

fn texts(values: &[&str]) -> ArrayRef {
    Arc::new(StringArray::from(values.to_vec()))
}

/// Half a second of 2 Hz at 3 m/s2, in steps of 0.01 s.
fn sine() -> Vec<f64> {
    (0..50).map(|k| (300.0 * (std::f64::consts::TAU * 0.02 * f64::from(k)).sin()).round() / 100.0).collect()
}

fn list(samples: &[f64]) -> ArrayRef {
    let mut list = ListBuilder::new(Float64Builder::new());
    list.values().append_slice(samples);
    list.append(true);
    Arc::new(list.finish())
}

fn responses(folder: &Path) -> Vec<Value> {
    let (printed, _) = succeed(folder, "inspect r.parquet --head 9 --format json");
    serde_json::from_str(&printed).unwrap()
}

/// The response to the sine, as motion `id`, with columns in place of the usual ones.
fn response(columns: Vec<(&str, ArrayRef)>) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let mut all =
        vec![("motion_id", texts(&["a"])), ("dt_s", numbers(&[0.01])), ("acceleration_m_s2", list(&sine()))];
    for (name, array) in columns {
        all.retain(|(other, _)| *other != name);
        all.push((name, array));
    }
    write(&folder.path().join("m.parquet"), all);
    succeed(folder.path(), SIMULATE);
    responses(folder.path()).remove(0)
}

fn decimal(value: i128, precision: u8, scale: i8) -> ArrayRef {
    Arc::new(Decimal128Array::from(vec![value]).with_precision_and_scale(precision, scale).unwrap())
}

#[test]
fn numbers_of_every_type_are_read() {
    let expected = response(Vec::new());
    let in_hundredths: Vec<i128> = sine().iter().map(|a| (100.0 * a).round() as i128).collect();
    let decimals = |precision: u8| -> ArrayRef {
        let kind = DataType::Decimal128(precision, 2);
        let mut list = ListBuilder::new(Decimal128Builder::new().with_data_type(kind));
        in_hundredths.iter().for_each(|value| list.values().append_value(*value));
        list.append(true);
        Arc::new(list.finish())
    };
    for columns in [
        vec![("dt_s", decimal(1, 2, 2))],
        vec![("dt_s", decimal(10_000, 18, 6))],
        vec![("dt_s", decimal(1_000_000_000_000_000_000, 38, 20))],
        vec![("acceleration_m_s2", decimals(4))],
        vec![("acceleration_m_s2", decimals(12))],
        vec![("acceleration_m_s2", decimals(30))],
    ] {
        let found = response(columns);
        for column in ["pga_m_s2", "pgv_m_s", "edp", "outcome"] {
            assert_eq!(found[column], expected[column], "{column}");
        }
    }
}

/// The peak that is read of whole numbers of this type, in lists.
fn peak_of<T: ArrowPrimitiveType>(mut items: PrimitiveBuilder<T>, values: Vec<T::Native>) -> f64 {
    items.append_slice(&values);
    let mut list = FixedSizeListBuilder::new(items, values.len() as i32);
    list.append(true);
    response(vec![("acceleration_m_s2", Arc::new(list.finish()) as ArrayRef)])["pga_m_s2"].as_f64().unwrap()
}

#[test]
fn half_and_unsigned_numbers_are_read() {
    type Half = <Float16Type as ArrowPrimitiveType>::Native;
    let half = |value: f64| Half::from_f64(value);
    assert_eq!(peak_of(Float16Builder::new(), vec![half(0.0), half(-2.5), half(0.125)]), 2.5);
    assert_eq!(peak_of(UInt16Builder::new(), vec![0, 3, 1]), 3.0);
    assert_eq!(peak_of(UInt32Builder::new(), vec![0, 4, 1]), 4.0);
    let folder = tempfile::tempdir().unwrap();
    let mut large = ListBuilder::new(UInt32Builder::new());
    large.values().append_slice(&[0, u32::MAX]);
    large.append(true);
    let columns = vec![
        ("motion_id", texts(&["a"])),
        ("dt_s", numbers(&[0.01])),
        ("acceleration_m_s2", Arc::new(large.finish()) as ArrayRef),
    ];
    write(&folder.path().join("m.parquet"), columns);
    fail(folder.path(), SIMULATE, 1, &["row 1", "acceleration_m_s2", "4294967295"]);
    let half: ArrayRef = Arc::new(arrow_array::Float16Array::from(vec![half(0.5)]));
    assert_eq!(response(vec![("mw", Arc::new(UInt64Array::from(vec![6])))])["mw"], 6.0);
    assert_eq!(response(vec![("tp_s", half)])["tp_s"], 0.5);
}

#[test]
fn every_codec_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let columns =
        vec![("motion_id", texts(&["a"])), ("dt_s", numbers(&[0.01])), ("acceleration_m_s2", list(&sine()))];
    let batch = RecordBatch::try_from_iter(columns).unwrap();
    let codecs = [
        Compression::UNCOMPRESSED,
        Compression::SNAPPY,
        Compression::GZIP(GzipLevel::default()),
        Compression::BROTLI(BrotliLevel::default()),
        Compression::LZ4_RAW,
        Compression::LZ4,
    ];
    for codec in codecs {
        let file = std::fs::File::create(folder.path().join("m.parquet")).unwrap();
        let properties = WriterProperties::builder().set_compression(codec).build();
        let mut writer = ArrowWriter::try_new(file, batch.schema(), Some(properties)).unwrap();
        writer.write(&batch).unwrap();
        writer.close().unwrap();
        succeed(folder.path(), SIMULATE);
        assert_eq!(responses(folder.path())[0]["pga_m_s2"], 2.99, "{codec:?}");
    }
}

fn reference(name: &str) -> Vec<u8> {
    bytes(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/files").join(name))
}

/// Three motions of pyarrow: the third page of samples has none.
#[test]
fn empty_pages_end_no_column() {
    let folder = tempfile::tempdir().unwrap();
    let peaks = ["empty_page.parquet", "page_checksums.parquet"].map(|name| {
        std::fs::write(folder.path().join("m.parquet"), reference(name)).unwrap();
        succeed(folder.path(), SIMULATE);
        responses(folder.path()).iter().map(|row| row["pga_m_s2"].as_f64().unwrap()).collect::<Vec<_>>()
    });
    assert!(peaks[0] == peaks[1] && peaks[0].len() == 3, "{peaks:?}");
}

#[test]
fn whole_numbers_of_any_size_stay_themselves() {
    let id = |id: ArrayRef| response(vec![("motion_id", id)])["motion_id"].clone();
    assert_eq!(id(Arc::new(UInt64Array::from(vec![u64::MAX]))), "18446744073709551615");
    assert_eq!(id(Arc::new(Int64Array::from(vec![i64::MIN + 1]))), "-9223372036854775807");
    assert_eq!(id(decimal(12_345_678_901_234_567_890, 20, 0)), "12345678901234567890");
    // Two numbers that are one as f64.
    let folder = tempfile::tempdir().unwrap();
    let mut lists = ListBuilder::new(Float64Builder::new());
    for _ in 0..2 {
        lists.values().append_slice(&sine());
        lists.append(true);
    }
    let ids: ArrayRef = Arc::new(Int64Array::from(vec![1 << 53, (1 << 53) + 1]));
    let columns = vec![
        ("motion_id", ids),
        ("dt_s", numbers(&[0.01, 0.01])),
        ("acceleration_m_s2", Arc::new(lists.finish()) as ArrayRef),
    ];
    write(&folder.path().join("m.parquet"), columns);
    succeed(folder.path(), SIMULATE);
    let (printed, _) = succeed(folder.path(), "inspect m.parquet --format json --head 2");
    assert!(printed.contains("9007199254740993"), "{printed}");
}

/// Two scenarios, the second with another value in a column.
fn scenarios(column: &str, value: f64) -> Vec<(&'static str, ArrayRef)> {
    let usual =
        [("mw", 6.5), ("re_km", 10.0), ("vp_m_s", 0.5), ("tp_s", 1.2), ("gamma", 1.9), ("nu_rad", 1.8)];
    let count: ArrayRef = Arc::new(Int32Array::from(vec![0, 1]));
    let ids: ArrayRef = Arc::new(Int64Array::from(vec![0, 1]));
    let columns =
        usual.map(|(name, usual)| (name, numbers(&[usual, if name == column { value } else { usual }])));
    let counts = [("scenario_id", ids), ("cell", count.clone()), ("sample", count)];
    counts.into_iter().chain(columns).collect()
}

#[test]
fn a_scenario_that_cannot_be_is_named_with_its_row() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scenarios.parquet");
    write(&path, scenarios("mw", 6.5));
    succeed(folder.path(), "synthesize-motions --dt 0.02");
    for (column, values) in [
        ("mw", [60.0, -1.0, f64::NAN, f64::INFINITY]),
        ("re_km", [-5.0, 1e9, f64::NAN, f64::INFINITY]),
        ("vp_m_s", [-1.0, 1e300, f64::NAN, f64::NEG_INFINITY]),
        ("tp_s", [-2.0, 0.0, 1e6, f64::NAN]),
        ("gamma", [0.0, -1.0, 1e9, f64::NAN]),
        ("nu_rad", [f64::NAN, f64::INFINITY, 1e300, -1e9]),
    ] {
        for value in values {
            write(&path, scenarios(column, value));
            fail(
                folder.path(),
                "synthesize-motions --out other.parquet --dt 0.02",
                1,
                &["scenarios.parquet", "row 2", column, "expected"],
            );
            assert!(!folder.path().join("other.parquet").exists(), "{column} {value}");
        }
    }
    // Possible, but too long at this step.
    let mut long = scenarios("tp_s", 900.0);
    long.retain(|(name, _)| *name != "gamma");
    long.push(("gamma", numbers(&[1.9, 19.0])));
    write(&path, long);
    fail(folder.path(), "synthesize-motions --out other.parquet --dt 0.0005", 1, &["scenario 1", "--dt"]);
}

#[test]
fn a_motion_that_cannot_be_is_named_with_its_row() {
    let folder = tempfile::tempdir().unwrap();
    for (column, value) in [
        ("pga_m_s2", -1.0),
        ("pga_m_s2", f64::INFINITY),
        ("pgv_m_s", 1e300),
        ("pgv_m_s", -0.1),
        ("tp_s", 0.0),
        ("tm_s", -1.0),
        ("mw", 60.0),
        ("re_km", f64::NEG_INFINITY),
        ("dt_s", -0.01),
    ] {
        let columns = [
            ("motion_id", texts(&["a"])),
            ("dt_s", numbers(&[0.01])),
            ("acceleration_m_s2", list(&sine())),
            ("suite", texts(&["csgm"])),
        ];
        let others = columns.into_iter().filter(|(name, _)| *name != column);
        let columns = others.chain([(column, numbers(&[value]))]).collect();
        write(&folder.path().join("m.parquet"), columns);
        for command in [SIMULATE.to_string(), format!("ida --in m.parquet {STRUCTURE} --out i.parquet")] {
            fail(folder.path(), &command, 1, &["m.parquet", "row 1", column, "expected"]);
        }
        if column == "dt_s" {
            let command = "floor-motions --in m.parquet --period 0.5 --level 1";
            fail(folder.path(), command, 1, &["row 1", "dt_s"]);
        }
    }
}

#[test]
fn nan_is_null() {
    let known = response(vec![("mw", numbers(&[f64::NAN])), ("pga_m_s2", numbers(&[f64::NAN]))]);
    assert!(known["mw"].is_null() && near(known["pga_m_s2"].as_f64().unwrap(), 2.99, 1e-12), "{known}");
}

#[test]
fn responses_that_cannot_be_are_named_by_all_that_read_them() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("r.parquet");
    let write_with = |column: &str, value: f64| {
        let usual = [
            ("p_rad_s", 2.5),
            ("alpha_rad", 0.2),
            ("eta", 0.92),
            ("edp", 0.1),
            ("mw", 6.5),
            ("re_km", 10.0),
            ("pga_m_s2", 3.0),
            ("pgv_m_s", 0.5),
            ("im4", 1.5),
            ("im5", 0.6),
        ];
        let columns = usual.map(|(name, usual)| {
            (name, numbers(&[usual, if name == column { value } else { 1.01 * usual }]))
        });
        let same = [
            ("motion_id", texts(&["1", "2"])),
            ("structure", texts(&["a", "a"])),
            ("outcome", texts(&["safe_rocking", "safe_rocking"])),
        ];
        write(&path, same.into_iter().chain(columns).collect());
    };
    for (column, value) in [
        ("edp", -0.5),
        ("edp", f64::INFINITY),
        ("edp", 1e300),
        ("im4", f64::INFINITY),
        ("im5", 1e300),
        ("mw", 0.0),
        ("re_km", -3.0),
        ("pga_m_s2", -3.0),
        ("pgv_m_s", f64::INFINITY),
    ] {
        write_with(column, value);
        for command in ["fit-pro", "fit-pex", "rank-ims", "validate"] {
            fail(folder.path(), &format!("{command} --in r.parquet"), 1, &["r.parquet", "row 2", column]);
        }
    }
}

#[test]
fn a_flipped_bit_among_the_numbers_is_an_error() {
    let folder =
        folder_with("seed: 1\nout: .\nsample-scenarios: { samples: 2 }\nsynthesize-motions: { dt: 0.02 }\n");
    succeed(folder.path(), "run");
    let path = folder.path().join("motions.parquet");
    let whole = bytes(&path);
    let footer = u32::from_le_bytes(whole[whole.len() - 8..whole.len() - 4].try_into().unwrap()) as usize;
    let pages = whole.len() - 8 - footer;
    let simulate = format!("simulate {STRUCTURE} --force");
    succeed(folder.path(), &simulate);
    let read = ["motion_id", "dt_s", "acceleration_m_s2", "pga_m_s2"];
    let reader =
        parquet::file::reader::SerializedFileReader::new(std::fs::File::open(&path).unwrap()).unwrap();
    let columns = parquet::file::reader::FileReader::metadata(&reader).row_group(0).columns();
    let columns = columns.iter().filter(|column| read.contains(&column.column_path().parts()[0].as_str()));
    let mut tries = 0;
    for (start, length) in columns.map(|column| column.byte_range()) {
        for at in [start, start + length / 2, start + length - 1] {
            assert!((at as usize) < pages);
            let mut damaged = whole.clone();
            damaged[at as usize] ^= 16;
            std::fs::write(&path, damaged).unwrap();
            fail(folder.path(), &simulate, 1, &["motions.parquet"]);
            tries += 1;
        }
    }
    assert_eq!(tries, 12);
    // Of another program, with a checksum of each page.
    let mut foreign = reference("page_checksums.parquet");
    std::fs::write(&path, &foreign).unwrap();
    succeed(folder.path(), &simulate);
    let at = foreign.len() / 4;
    foreign[at] ^= 16;
    std::fs::write(&path, &foreign).unwrap();
    fail(folder.path(), &simulate, 1, &["motions.parquet"]);
}

#[test]
fn two_columns_of_one_name_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let batch = RecordBatch::try_new(
        Arc::new(arrow_schema::Schema::new(vec![
            arrow_schema::Field::new("pga_m_s2", DataType::Float64, true),
            arrow_schema::Field::new("pga_m_s2", DataType::Float64, true),
        ])),
        vec![numbers(&[1.0]), numbers(&[2.0])],
    );
    let batch = batch.unwrap();
    let file = std::fs::File::create(folder.path().join("m.parquet")).unwrap();
    let mut writer = ArrowWriter::try_new(file, batch.schema(), None).unwrap();
    writer.write(&batch).unwrap();
    writer.close().unwrap();
    for command in [
        "inspect m.parquet",
        "simulate --in m.parquet --p 2.5 --alpha 0.2 --eta 0.9",
        "floor-motions --in m.parquet --period 1 --level 1",
    ] {
        fail(folder.path(), command, 1, &["m.parquet", "pga_m_s2"]);
    }
}
