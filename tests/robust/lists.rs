//! Lists of samples beside the library's own reader, whatever their lengths, pages and encodings.

use std::fs::File;
use std::path::Path;
use std::sync::Arc;

use arrow_array::{Array, Float32Array, Float64Array, Int64Array, ListArray, RecordBatch};
use arrow_buffer::{NullBuffer, OffsetBuffer};
use arrow_schema::{DataType, Field, Schema};
use parquet::arrow::ArrowWriter;
use parquet::arrow::arrow_reader::ParquetRecordBatchReaderBuilder;
use parquet::basic::{Compression, Encoding, ZstdLevel};
use parquet::file::properties::{WriterProperties, WriterVersion};
use parquet::schema::types::ColumnPath;
use proptest::prelude::*;
use rockfrag::table::schema::{acceleration_m_s2, motion_id, tm_s};
use rockfrag::table::store::reader::OpenTable;

/// How a file holds its lists.
#[derive(Debug, Clone)]
struct Layout {
    double: bool,
    nullable: bool,
    dictionary: bool,
    split: bool,
    compressed: bool,
    later_pages: bool,
    rows_of_page: usize,
    rows_of_group: usize,
}

fn layouts() -> impl Strategy<Value = Layout> {
    let choices = (any::<[bool; 4]>(), any::<[bool; 2]>(), 1..20usize, 1..70usize);
    choices.prop_map(|(choices, pages, rows_of_page, rows_of_group)| {
        let [double, nullable, dictionary, split] = choices;
        let [compressed, later_pages] = pages;
        let dictionary = dictionary && !split;
        Layout { double, nullable, dictionary, split, compressed, later_pages, rows_of_page, rows_of_group }
    })
}

impl Layout {
    /// Rows with lists of these lengths; where lists may be null, those of length 13 are, and samples here and there.
    fn rows(&self, lengths: &[usize]) -> RecordBatch {
        let count = lengths.iter().sum();
        let number = |at: usize| (!self.nullable || at % 11 != 7).then_some(at as f64);
        let samples: Arc<dyn Array> = match self.double {
            true => Arc::new((0..count).map(number).collect::<Float64Array>()),
            false => Arc::new((0..count).map(|at| number(at).map(|v| v as f32)).collect::<Float32Array>()),
        };
        let item = Arc::new(Field::new("item", samples.data_type().clone(), self.nullable));
        let present = NullBuffer::from_iter(lengths.iter().map(|&length| length != 13));
        let offsets = OffsetBuffer::from_lengths(lengths.iter().copied());
        let lists = ListArray::new(item, offsets, samples, self.nullable.then_some(present));
        let numbers = Int64Array::from_iter_values(0..lengths.len() as i64);
        let periods = Float64Array::from_iter_values((0..lengths.len()).map(|row| row as f64));
        let schema = Schema::new(vec![
            Field::new(motion_id.name, DataType::Int64, false),
            Field::new(acceleration_m_s2.name, lists.data_type().clone(), self.nullable),
            Field::new(tm_s.name, DataType::Float64, true),
        ]);
        let columns: Vec<Arc<dyn Array>> = vec![Arc::new(numbers), Arc::new(lists), Arc::new(periods)];
        RecordBatch::try_new(Arc::new(schema), columns).unwrap()
    }

    fn write(&self, path: &Path, rows: &RecordBatch) {
        let samples = ColumnPath::new([acceleration_m_s2.name, "list", "item"].map(String::from).to_vec());
        let zstd = Compression::ZSTD(ZstdLevel::try_new(1).unwrap());
        let encoding = if self.split { Encoding::BYTE_STREAM_SPLIT } else { Encoding::PLAIN };
        let version = if self.later_pages { WriterVersion::PARQUET_2_0 } else { WriterVersion::PARQUET_1_0 };
        let properties = WriterProperties::builder()
            .set_writer_version(version)
            .set_compression(if self.compressed { zstd } else { Compression::UNCOMPRESSED })
            .set_dictionary_enabled(self.dictionary)
            .set_column_encoding(samples, encoding)
            .set_write_batch_size(1)
            .set_data_page_row_count_limit(self.rows_of_page)
            .set_max_row_group_row_count(Some(self.rows_of_group))
            .build();
        let file = File::create(path).unwrap();
        let mut writer = ArrowWriter::try_new(file, rows.schema(), Some(properties)).unwrap();
        writer.write(rows).unwrap();
        writer.close().unwrap();
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn lists_are_read_as_the_library_reads_them(
        layout in layouts(),
        lengths in prop::collection::vec(prop_oneof![3 => 0..5usize, 2 => 0..300usize, 1 => Just(13)], 1..60),
        (first, share) in (0.0..1.0f64, 0.0..=1.0f64),
        at_once in 1..40usize,
    ) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("motions.parquet");
        layout.write(&path, &layout.rows(&lengths));
        let first = (first * lengths.len() as f64) as usize;
        let rows = 1 + (share * (lengths.len() - first - 1) as f64) as usize;

        let builder = ParquetRecordBatchReaderBuilder::try_new(File::open(&path).unwrap()).unwrap();
        let whole = builder.with_batch_size(lengths.len()).build().unwrap();
        let whole: Vec<RecordBatch> = whole.map(Result::unwrap).collect();
        let [whole] = &whole[..] else { panic!("{} batches", whole.len()) };
        let whole = whole.slice(first, rows);

        let table = OpenTable::open(&path, &[], &[motion_id, acceleration_m_s2, tm_s]).unwrap();
        let mut next = 0;
        for run in table.runs(first as u64..(first + rows) as u64) {
            for batch in table.batches_of(run, at_once).unwrap() {
                let batch = batch.unwrap();
                let expected = whole.slice(next, batch.rows.num_rows());
                prop_assert_eq!(batch.rows.columns(), expected.columns());
                prop_assert_eq!(batch.first_row as usize, first + next);
                next += batch.rows.num_rows();
            }
        }
        prop_assert_eq!(next, rows);
    }
}
