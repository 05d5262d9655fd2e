//! A table as a workbook: numbers as numbers, names as texts, whatever they begin with.

use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, Int64Type};
use arrow_array::{Array, RecordBatch};
use rust_xlsxwriter::{DocProperties, ExcelDateTime, Format, Workbook, XlsxError};

/// Writes rows as a workbook with one sheet.
pub fn workbook(rows: &[RecordBatch]) -> Result<Vec<u8>, XlsxError> {
    let mut book = Workbook::new();
    // What is the same is the same whenever it is written.
    let created = ExcelDateTime::from_ymd(2000, 1, 1)?;
    book.set_properties(&DocProperties::new().set_creation_datetime(&created));
    let sheet = book.add_worksheet();
    sheet.set_name("rockfrag")?.set_freeze_panes(1, 1)?;
    let bold = Format::new().set_bold();
    let schema = rows.first().map(|batch| batch.schema());
    for (at, field) in schema.iter().flat_map(|schema| schema.fields()).enumerate() {
        sheet.write_string_with_format(0, at as u16, field.name(), &bold)?;
        sheet.set_column_width(at as u16, (field.name().chars().count() as f64 + 2.0).max(10.0))?;
    }
    let mut first = 1;
    for batch in rows {
        for (at, column) in batch.columns().iter().enumerate() {
            for row in (0..batch.num_rows()).filter(|row| column.is_valid(*row)) {
                let (line, at) = (first + row as u32, at as u16);
                if let Some(texts) = column.as_string_opt::<i32>() {
                    sheet.write_string(line, at, texts.value(row))?;
                } else if let Some(numbers) = column.as_primitive_opt::<Float64Type>() {
                    sheet.write_number(line, at, numbers.value(row))?;
                } else if let Some(numbers) = column.as_primitive_opt::<Int64Type>() {
                    sheet.write_number(line, at, numbers.value(row) as f64)?;
                } else if let Some(flags) = column.as_boolean_opt() {
                    sheet.write_boolean(line, at, flags.value(row))?;
                }
            }
        }
        first += batch.num_rows() as u32;
    }
    book.save_to_buffer()
}
